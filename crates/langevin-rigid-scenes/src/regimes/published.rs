//! Where experiments put the boundaries of the regimes. Nothing here is fitted to the model.

use serde::Serialize;

use super::plates::Plate;
use crate::ensemble::MotionClass;

/// Grid points within this factor of a boundary, in Re or I*, are not compared: about what the
/// measurements differ by among each other.
pub const UNCERTAINTY: f64 = 1.5;

/// The measured map of one kind of plate.
///
/// Below the onset every plate falls steadily; above it the regime depends on I* alone, as far as
/// is measured.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Published {
    /// Reynolds number of the onset of motion, on diameter or chord.
    pub onset: f64,
    /// Where the onset is from.
    pub onset_source: &'static str,
    /// Boundaries in I*, ascending.
    pub boundaries: &'static [Boundary],
    /// The regime above the last of them.
    pub above: MotionClass,
    /// Single measured plates.
    pub measured: &'static [Measured],
}

/// A value of I* at which the regime changes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Boundary {
    /// I* of the boundary.
    pub inertia_ratio: f64,
    /// The regime below it.
    pub below: MotionClass,
    /// Where it is from.
    pub source: &'static str,
}

/// One plate whose regime was observed; drawn in the map, not part of the agreement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measured {
    /// Its Reynolds number.
    pub reynolds: f64,
    /// Its I*.
    pub inertia_ratio: f64,
    /// What it did.
    pub motion: MotionClass,
    /// Where it is from.
    pub source: &'static str,
}

const FIELD: &str =
    "Field, Klaus, Moore & Nori 1997, Nature 388:252 (read off a diagram, approximate)";
const ANDERSEN: &str = "Andersen, Pesavento & Wang 2005, J. Fluid Mech. 541:65, aluminium in water";

/// Field et al. had few discs between Re 100 and 2000; their boundaries in I* are continued there.
const DISC: Published = Published {
    onset: 100.0,
    onset_source: FIELD,
    boundaries: &[
        Boundary {
            inertia_ratio: 0.01,
            below: MotionClass::Flutter,
            source: FIELD,
        },
        Boundary {
            inertia_ratio: 0.04,
            below: MotionClass::Chaotic,
            source: FIELD,
        },
    ],
    above: MotionClass::Tumble,
    measured: &[],
};

/// The Froude number of Belmonte et al. is the ratio of two times: L/U with the speed U at which drag
/// balances the weight, and the period of a pendulum of length L under the same reduced gravity. The
/// weight cancels, and Fr^2 = M / (rho L^2 w), with mass M, chord L and span w. For a strip of
/// thickness h, M = rho_s h L w, so Fr^2 = rho_s h / (rho L) = I*, and Fr = 0.67 +- 0.05 is I* = 0.45,
/// from 0.38 to 0.52.
const STRIP: Published = Published {
    onset: 100.0,
    onset_source: "taken from discs (Willmarth, Hawk & Harvey 1964, Phys. Fluids 7:197; Field et al. 1997); strips \
                   are hardly measured there",
    boundaries: &[Boundary {
        inertia_ratio: 0.67 * 0.67,
        below: MotionClass::Flutter,
        source: "Belmonte, Eisenberg & Moses 1998, Phys. Rev. Lett. 81:345 (Fr = 0.67 +- 0.05)",
    }],
    above: MotionClass::Tumble,
    // Density 2.70 times the thickness over the width, 1/14 and 1/5.
    measured: &[
        Measured {
            reynolds: 1000.0,
            inertia_ratio: 2.70 / 14.0,
            motion: MotionClass::Flutter,
            source: ANDERSEN,
        },
        Measured {
            reynolds: 1000.0,
            inertia_ratio: 2.70 / 5.0,
            motion: MotionClass::Tumble,
            source: ANDERSEN,
        },
    ],
};

impl Published {
    /// What is known about these plates.
    pub fn of(plate: Plate) -> &'static Self {
        match plate {
            Plate::Disc => &DISC,
            Plate::Strip => &STRIP,
        }
    }

    /// The published regime.
    ///
    /// ```
    /// use langevin_rigid_scenes::ensemble::MotionClass;
    /// use langevin_rigid_scenes::regimes::{Plate, Published};
    /// let discs = Published::of(Plate::Disc);
    /// assert_eq!(discs.regime(50.0, 0.1), MotionClass::Steady);
    /// assert_eq!(discs.regime(5000.0, 0.1), MotionClass::Tumble);
    /// assert!(discs.certain(5000.0, 0.1) && !discs.certain(5000.0, 0.05));
    /// ```
    pub fn regime(&self, reynolds: f64, inertia_ratio: f64) -> MotionClass {
        if reynolds < self.onset {
            return MotionClass::Steady;
        }
        let mut below = self.boundaries.iter();
        below
            .find(|b| inertia_ratio < b.inertia_ratio)
            .map_or(self.above, |b| b.below)
    }

    /// Whether the published regime stays the same when Re and I* change by [`UNCERTAINTY`].
    pub fn certain(&self, reynolds: f64, inertia_ratio: f64) -> bool {
        let here = self.regime(reynolds, inertia_ratio);
        let factors = [1.0 / UNCERTAINTY, 1.0, UNCERTAINTY];
        // Bands are wider than the factor squared, so that corners tell of everything between.
        factors.iter().all(|f| {
            factors
                .iter()
                .all(|g| self.regime(f * reynolds, g * inertia_ratio) == here)
        })
    }
}
