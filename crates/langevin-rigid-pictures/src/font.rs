//! Text as outlines, from the font in `assets/`, so that a machine without fonts draws the same.

use tiny_skia::{Path, PathBuilder};
use ttf_parser::{Face, OutlineBuilder};

use crate::PictureError;

const REGULAR: &[u8] = include_bytes!("../assets/Inter-Regular.subset.otf");
const SEMI_BOLD: &[u8] = include_bytes!("../assets/Inter-SemiBold.subset.otf");

/// Height of a capital as a fraction of the font size.
pub(super) const CAPITAL: f64 = 0.73;

/// How heavy the strokes of a text are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Weight {
    Regular,
    SemiBold,
}

/// Both weights of the font, parsed.
pub(super) struct Fonts {
    regular: Face<'static>,
    semi_bold: Face<'static>,
}

impl Fonts {
    pub(super) fn new() -> Result<Self, PictureError> {
        let parse = |data| Face::parse(data, 0).map_err(|_| PictureError::Font);
        Ok(Self {
            regular: parse(REGULAR)?,
            semi_bold: parse(SEMI_BOLD)?,
        })
    }

    fn face(&self, weight: Weight) -> &Face<'static> {
        match weight {
            Weight::Regular => &self.regular,
            Weight::SemiBold => &self.semi_bold,
        }
    }

    /// Length of a line of text, in units of `size`.
    pub(super) fn width(&self, text: &str, size: f64, weight: Weight) -> f64 {
        let face = self.face(weight);
        let em = f64::from(face.units_per_em());
        let units: f64 = text
            .chars()
            .map(|c| f64::from(face.glyph_hor_advance(glyph(face, c)).unwrap_or(0)))
            .sum();
        units * size / em
    }

    /// Outlines of a line of text that starts at `origin` on its base line; nothing for blanks.
    pub(super) fn outline(
        &self,
        text: &str,
        origin: [f64; 2],
        size: f64,
        weight: Weight,
    ) -> Option<Path> {
        let face = self.face(weight);
        let scale = size / f64::from(face.units_per_em());
        let mut pen = Pen {
            builder: PathBuilder::new(),
            origin,
            scale,
        };
        for c in text.chars() {
            let id = glyph(face, c);
            face.outline_glyph(id, &mut pen);
            pen.origin[0] += scale * f64::from(face.glyph_hor_advance(id).unwrap_or(0));
        }
        pen.builder.finish()
    }
}

fn glyph(face: &Face<'_>, c: char) -> ttf_parser::GlyphId {
    face.glyph_index(c)
        .or_else(|| face.glyph_index('?'))
        .unwrap_or_default()
}

/// Takes outlines in font units, y up, to pixels, y down.
struct Pen {
    builder: PathBuilder,
    origin: [f64; 2],
    scale: f64,
}

impl Pen {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        (
            (self.origin[0] + self.scale * f64::from(x)) as f32,
            (self.origin[1] - self.scale * f64::from(y)) as f32,
        )
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.builder.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.builder.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.builder.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2)) = (self.place(x1, y1), self.place(x2, y2));
        let (x, y) = self.place(x, y);
        self.builder.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.builder.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_every_sign_the_picture_writes() {
        let fonts = Fonts::new().unwrap();
        for face in [&fonts.regular, &fonts.semi_bold] {
            for c in "0123456789 xyz+\u{2212}.,×=°µ()/%αΩωρ?I*;:".chars() {
                assert!(face.glyph_index(c).is_some(), "{c:?} is not in the font");
            }
        }
    }
}
