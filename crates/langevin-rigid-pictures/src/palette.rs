//! The colours of the picture, as sRGB bytes.

pub(super) type Colour = [u8; 3];

pub(super) const PAGE: Colour = [255, 255, 255];
pub(super) const PLOT: Colour = [249, 250, 251];
pub(super) const GRID: Colour = [228, 231, 236];
pub(super) const FRAME: Colour = [184, 190, 199];
pub(super) const TEXT: Colour = [32, 37, 46];
pub(super) const FAINT_TEXT: Colour = [98, 107, 120];
pub(super) const OUTLINE: Colour = [38, 42, 52];
pub(super) const GROUND: Colour = [222, 213, 198];
pub(super) const GROUND_LINE: Colour = [122, 106, 82];
/// Arrows of the fluid, behind everything.
pub(super) const ARROW: Colour = [166, 190, 214];
pub(super) const SHADOW: Colour = [60, 64, 74];

/// The face of the body on the positive side of its thin axis, the other face, and the rim.
pub(super) const UPPER_FACE: Colour = [247, 157, 48];
pub(super) const LOWER_FACE: Colour = [38, 148, 168];
pub(super) const RIM: Colour = [205, 208, 214];

/// Water that is seen through, its surface; walls; what bodies meet.
pub(super) const WATER: Colour = [74, 150, 214];
pub(super) const WATER_LINE: Colour = [46, 118, 184];
pub(super) const WALL: Colour = [120, 130, 146];
pub(super) const STONE: Colour = [206, 199, 188];
pub(super) const STONE_EDGE: Colour = [138, 128, 113];
/// The paths of many bodies.
pub(super) const FAINT_PATH: Colour = [203, 193, 228];

/// What a solid is painted with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paints {
    /// The face on the positive side of the thin axis, the other, and the rim.
    pub upper: Colour,
    pub lower: Colour,
    pub rim: Colour,
    pub edge: Colour,
}

impl Paints {
    /// The face whose normal makes an angle with cosine `side` with the thin axis.
    pub(super) fn face(&self, side: f64) -> Colour {
        if side > 0.0 { self.upper } else { self.lower }
    }
}

/// Those of bodies.
pub(super) const BODY: Paints = Paints {
    upper: UPPER_FACE,
    lower: LOWER_FACE,
    rim: RIM,
    edge: OUTLINE,
};

/// Those of what stays where it is.
pub(super) const SCENERY: Paints = Paints {
    upper: STONE,
    lower: STONE,
    rim: STONE,
    edge: STONE_EDGE,
};

/// Colour of the path from start to end: light to dark, so that order in time reads in grey too.
const PATH: [Colour; 4] = [
    [196, 181, 233],
    [159, 118, 214],
    [121, 55, 178],
    [68, 12, 108],
];

/// Colour of the path a fraction `w` of the time from its start, 0 to 1.
pub(super) fn path(w: f64) -> Colour {
    let along = w.clamp(0.0, 1.0) * (PATH.len() - 1) as f64;
    let from = (along as usize).min(PATH.len() - 2);
    mix(PATH[from], PATH[from + 1], along - from as f64)
}

/// The colour a fraction `w` of the way from `a` to `b`.
pub(super) fn mix(a: Colour, b: Colour, w: f64) -> Colour {
    std::array::from_fn(|i| {
        let (a, b) = (f64::from(a[i]), f64::from(b[i]));
        (a + (b - a) * w + 0.5) as u8
    })
}
