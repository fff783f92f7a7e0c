//! The parametric shapes by name, with the keys of their dimensions.

use langevin_rigid_bake::for_shapes;
use langevin_rigid_bake::shapes::Shape;
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{HOLE, Kind, RADIUS, SIZE};
use super::raw::{Given, RawBody, given};

/// A shape as scenes have it.
struct Entry {
    name: &'static str,
    /// The keys of its dimensions, which are the fields of its [`Shape`].
    keys: &'static [&'static str],
    read: fn(&Dimensions) -> Result<Shape, SceneError>,
}

/// Makes of the rows of shapes the table that is read by and the function that writes.
macro_rules! shapes {
    ($($name:literal: $shape:ident { $($key:ident),* },)*) => {
        /// All shapes, as messages list them.
        const SHAPES: &[Entry] = &[$(Entry {
            name: $name,
            keys: &[$(stringify!($key)),*],
            read: |given| Ok(Shape::$shape { $($key: given.$key()?),* }),
        }),*];

        /// The keys of a resolved shape.
        pub(super) fn write(shape: &Shape) -> RawBody {
            match *shape {
                $(Shape::$shape { $($key),* } => RawBody {
                    shape: given($name.to_owned()),
                    $($key: given($key.into_raw()),)*
                    ..RawBody::default()
                },)*
            }
        }
    };
}

for_shapes!(shapes);

/// A dimension as a scene file has it: arrays are lists there.
trait IntoRaw {
    type Raw;
    fn into_raw(self) -> Self::Raw;
}

impl IntoRaw for f64 {
    type Raw = f64;
    fn into_raw(self) -> f64 {
        self
    }
}

impl<const N: usize> IntoRaw for [f64; N] {
    type Raw = Vec<f64>;
    fn into_raw(self) -> Vec<f64> {
        self.to_vec()
    }
}

/// The names of all shapes.
pub(super) fn names() -> String {
    let names: Vec<&str> = SHAPES.iter().map(|shape| shape.name).collect();
    names.join(", ")
}

/// The shape of that name with the dimensions of the section.
pub(super) fn resolve(
    doc: &Document,
    body: &RawBody,
    name: &Spanned<String>,
) -> Result<Shape, SceneError> {
    let shape = doc.choose(
        "shape",
        name,
        SHAPES.iter().map(|shape| (shape.name, shape)),
    )?;
    allow(doc, body, shape.name, &allowed(shape.keys))?;
    (shape.read)(&Dimensions { doc, body, name })
}

/// These keys, and the diameter that may stand for a radius.
fn allowed(keys: &[&'static str]) -> Vec<&'static str> {
    let diameter = keys.contains(&"radius").then_some("diameter");
    diameter.into_iter().chain(keys.iter().copied()).collect()
}

/// The dimensions in the section of a shape, each by its key.
struct Dimensions<'a> {
    doc: &'a Document<'a>,
    body: &'a RawBody,
    name: &'a Spanned<String>,
}

impl Dimensions<'_> {
    fn semi_axes<const N: usize>(&self) -> Result<[f64; N], SceneError> {
        self.lengths("semi_axes", &self.body.semi_axes, RADIUS)
    }

    fn size(&self) -> Result<[f64; 3], SceneError> {
        self.lengths("size", &self.body.size, SIZE)
    }

    /// The radius, or half the diameter.
    fn radius(&self) -> Result<f64, SceneError> {
        match (&self.body.radius, &self.body.diameter) {
            (Some(_), Some(diameter)) => {
                let message = "give the `radius` or the `diameter`, not both";
                Err(self.doc.error(diameter.span(), message))
            }
            (Some(radius), None) => self.doc.number(radius, "radius", RADIUS),
            (None, _) => Ok(0.5 * self.diameter()?),
        }
    }

    fn diameter(&self) -> Result<f64, SceneError> {
        self.length_of("diameter", &self.body.diameter)
    }

    fn inner_diameter(&self) -> Result<f64, SceneError> {
        self.length_of("inner_diameter", &self.body.inner_diameter)
    }

    /// The diameter of the hole, 0 where none is given.
    fn hole(&self) -> Result<f64, SceneError> {
        let hole = self.doc.given(&self.body.hole, "hole", HOLE)?;
        Ok(hole.unwrap_or(0.0))
    }

    fn height(&self) -> Result<f64, SceneError> {
        self.length_of("height", &self.body.height)
    }

    fn length(&self) -> Result<f64, SceneError> {
        self.length_of("length", &self.body.length)
    }

    fn width(&self) -> Result<f64, SceneError> {
        self.length_of("width", &self.body.width)
    }

    fn side(&self) -> Result<f64, SceneError> {
        self.length_of("side", &self.body.side)
    }

    fn thickness(&self) -> Result<f64, SceneError> {
        self.length_of("thickness", &self.body.thickness)
    }

    fn length_of(&self, key: &str, value: &Given<f64>) -> Result<f64, SceneError> {
        match value {
            Some(value) => self.doc.number(value, key, SIZE),
            None => Err(self.missing(key)),
        }
    }

    fn lengths<const N: usize>(
        &self,
        key: &str,
        values: &Given<Vec<f64>>,
        kind: Kind,
    ) -> Result<[f64; N], SceneError> {
        match values {
            Some(values) => self.doc.numbers(values, key, kind),
            None => Err(self.missing(key)),
        }
    }

    fn missing(&self, key: &str) -> SceneError {
        let message = format!("the shape `{}` needs `{key}` (m)", self.name.get_ref());
        self.doc.error(self.name.span(), message)
    }
}

/// Refuses dimensions that the body does not have.
pub(super) fn allow(
    doc: &Document,
    body: &RawBody,
    name: &str,
    keys: &[&str],
) -> Result<(), SceneError> {
    for (key, span) in dimensions(body) {
        if let Some(span) = span.filter(|_| !keys.contains(&key)) {
            let message = format!(
                "`{key}` does not belong to `{name}`, which takes {}",
                keys.join(", ")
            );
            return Err(doc.error(span, message));
        }
    }
    Ok(())
}

/// The keys that give dimensions, with the value of each.
fn dimensions(raw: &RawBody) -> [(&'static str, Option<std::ops::Range<usize>>); 11] {
    fn at<T>(value: &Given<T>) -> Option<std::ops::Range<usize>> {
        value.as_ref().map(Spanned::span)
    }
    [
        ("semi_axes", at(&raw.semi_axes)),
        ("size", at(&raw.size)),
        ("radius", at(&raw.radius)),
        ("diameter", at(&raw.diameter)),
        ("inner_diameter", at(&raw.inner_diameter)),
        ("hole", at(&raw.hole)),
        ("height", at(&raw.height)),
        ("length", at(&raw.length)),
        ("width", at(&raw.width)),
        ("side", at(&raw.side)),
        ("thickness", at(&raw.thickness)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_reads_back_as_written() {
        let all = RawBody {
            semi_axes: given(vec![0.1, 0.2, 0.3]),
            size: given(vec![0.1, 0.2, 0.3]),
            diameter: given(0.2),
            inner_diameter: given(0.1),
            hole: given(0.05),
            height: given(0.3),
            length: given(0.3),
            width: given(0.1),
            side: given(0.2),
            thickness: given(0.01),
            ..RawBody::default()
        };
        let plane = RawBody {
            semi_axes: given(vec![0.1, 0.2]),
            thickness: given(0.01),
            ..RawBody::default()
        };
        let doc = Document { file: "", text: "" };
        for entry in SHAPES {
            let name = Spanned::new(0..0, entry.name.to_owned());
            let body = if entry.name == "elliptical-plate" {
                &plane
            } else {
                &all
            };
            let (doc, name) = (&doc, &name);
            let shape = (entry.read)(&Dimensions { doc, body, name }).unwrap();
            let written = write(&shape);
            assert_eq!(
                written.shape.as_ref().map(Spanned::get_ref),
                Some(name.get_ref())
            );
            assert_eq!(resolve(doc, &written, name).unwrap(), shape);
        }
    }
}
