//! Whether a coarser wrap would enclose more.

use std::fmt;

use super::grid::Corners;
use super::surround;
use crate::mesh::vector::{bounding_box, norm, sub};

/// Growth of the volume from a wrap to one of twice the size that rounding and grooves do not explain.
const NOTABLE: f64 = 1.1;
/// The coarsest wrap that is looked at, as a share of the diagonal of the box: coarser ones have lost the shape.
const COARSEST: f64 = 0.25;

/// A wrap of twice the size encloses notably more: the outside reaches the inside, or open sheets stand in the
/// fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leak {
    /// Size of the wrap (m).
    pub size: f64,
    /// Volume that it encloses (m³).
    pub volume: f64,
    /// Volume that one of twice the size encloses (m³).
    pub coarser: f64,
    /// The least of its doubles (m) that encloses about what its own double does.
    pub advised: Option<f64>,
}

impl Leak {
    /// Compares with coarser wraps, of which each costs an eighth of the one before. Nothing is known of those
    /// coarser than an eighth of the diagonal of the box.
    pub(super) fn find(corners: &[Corners], size: f64, volume: f64) -> Option<Leak> {
        if 2.0 * size > coarsest(corners) {
            return None;
        }
        let coarser = surround(corners, 2.0 * size).ok()?.1.volume();
        (coarser > NOTABLE * volume).then(|| Leak {
            size,
            volume,
            coarser,
            advised: tight(corners, 2.0 * size, coarser),
        })
    }
}

/// The first size of those that double from `size` on whose volume grows no more.
fn tight(corners: &[Corners], mut size: f64, mut volume: f64) -> Option<f64> {
    while 2.0 * size <= coarsest(corners) {
        let coarser = surround(corners, 2.0 * size).ok()?.1.volume();
        if coarser <= NOTABLE * volume {
            return Some(size);
        }
        (size, volume) = (2.0 * size, coarser);
    }
    None
}

fn coarsest(corners: &[Corners]) -> f64 {
    let [low, high] = bounding_box(corners.as_flattened());
    COARSEST * norm(sub(high, low))
}

impl fmt::Display for Leak {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Leak {
            size,
            volume,
            coarser,
            advised,
        } = self;
        write!(
            f,
            "the wrap encloses {volume:.3e} m^3, one of twice the size {coarser:.3e} m^3: the outside may reach the inside through a gap wider than {} m, or open sheets have become thin walls; ",
            short(*size)
        )?;
        match advised {
            Some(size) => write!(f, "try --wrap {}", short(*size)),
            None => write!(
                f,
                "compare the volumes at other sizes, or close the gaps in the program that made them"
            ),
        }
    }
}

/// A number of four digits.
fn short(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}
