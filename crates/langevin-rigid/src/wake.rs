//! The wake of a body in steady flow, and the pressure that it leaves.

/// Constants of the model. All of them are set to steady drag at Reynolds numbers of 1e3 to 1e5 and
/// are the same for all bodies.
mod constant {
    /// Share of the potential left by the wake of a bluff body. From 0.5 to 0.75 the Cd of
    /// a sphere goes from 0.63 to 0.52.
    pub(super) const WAKE_SHARE: f64 = 2.0 / 3.0;
    /// Base suction of a sharp-edged body whose silhouette is round: discs.
    pub(super) const ROUND_SUCTION: f64 = 0.4;
    /// Base suction of a two-dimensional one.
    pub(super) const LONG_SUCTION: f64 = 1.1;
    /// Excess aspect ratio of the silhouette at which the base suction is half-way between: normal
    /// plates and cylinders of finite span.
    pub(super) const ASPECT_SCALE: f64 = 30.0;
    /// Without sharp edges the base suction is less, the more so the slower the fluid passes the body: by
    /// `1 - (GENTLE / largest squared slip)^3`. A sphere (2.25) gets a third of a disc's suction and a Cd of 0.36; a
    /// circular cylinder (4) nine tenths of a flat strip's.
    pub(super) const GENTLE: f64 = 1.94;
    /// Share of the largest squared speed that is lost where the flow separates.
    pub(super) const RECOVERY: f64 = 0.2;
}
use constant::{ASPECT_SCALE, GENTLE, LONG_SUCTION, RECOVERY, ROUND_SUCTION, WAKE_SHARE};

/// Share of the surface that counts for the largest speed of [`Wake::new`]; the rest lies at edges,
/// where it has no bound.
pub const SLIP_QUANTILE: f64 = 0.995;

/// What the wake of a body in steady flow does to the pressure of potential flow.
///
/// Pressure follows Bernoulli's equation on the windward side. Where potential flow would have
/// given back a part of its suction the boundary layer leaves the surface, and a base pressure holds
/// from there on. A bluff body, whose suction at separation exceeds what a wake sustains, has the
/// base pressure on all of its lee, and a wake that acts as an afterbody and slows the flow around it.
///
/// The slip is the speed of the fluid along the surface relative to the body, over the body's speed.
///
/// ```
/// use langevin_rigid::Wake;
///
/// // A sphere: the squared slip is (1 + share / 2)^2 sin^2 of the angle from the axis.
/// let largest = |share: f64| (1.0 + 0.5 * share).powi(2);
/// let wake = Wake::new(1.0, largest);
/// let drag: f64 = (0..100)
///     .map(|n| (n as f64 + 0.5) / 100.0) // sin^2, even steps of the silhouette
///     .map(|sine2| wake.pressure_drop(largest(wake.potential_share()) * sine2) / 100.0)
///     .sum();
/// assert!((drag - 0.36).abs() < 0.01); // the drag coefficient at Reynolds numbers of some thousands
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wake {
    /// Base suction -Cpb.
    suction: f64,
    /// 0 for a streamlined body, 1 for a bluff one.
    bluffness: f64,
    /// Share of the potential that is left.
    share: f64,
    /// Pressure coefficient behind separation.
    base: f64,
    /// Squared slip at separation.
    separated_slip: f64,
}

impl Wake {
    /// The wake of a body whose silhouette has the ratio `aspect` (at least 1) of its principal radii of
    /// gyration.
    ///
    /// `largest_slip` gives the squared slip that [`SLIP_QUANTILE`] of the surface stays below, with the
    /// potential of the body's motion taken as many times as its argument says.
    pub fn new(aspect: f64, largest_slip: impl Fn(f64) -> f64) -> Self {
        let sharp = base_suction(aspect);
        let attached_slip = largest_slip(1.0);
        let bluffness = smoothstep(-separation_pressure(attached_slip) / sharp);
        let gentle = GENTLE / attached_slip;
        let suction = sharp * (1.0 - gentle * gentle * gentle).max(0.0);
        let share = 1.0 - (1.0 - WAKE_SHARE) * bluffness;
        let largest_slip = largest_slip(share);
        Self {
            suction,
            bluffness,
            share,
            base: separation_pressure(largest_slip).max(-suction),
            separated_slip: (1.0 - RECOVERY) * largest_slip,
        }
    }

    /// How many times the potential counts: less than once where the wake slows the flow.
    pub fn potential_share(&self) -> f64 {
        self.share
    }

    /// Pressure coefficient on the windward side less that on the lee, at a place of this squared slip;
    /// never negative. Its mean over the silhouette is the drag coefficient.
    pub fn pressure_drop(&self, squared_slip: f64) -> f64 {
        self.windward(squared_slip) - self.leeward(squared_slip)
    }

    fn windward(&self, squared_slip: f64) -> f64 {
        (1.0 - squared_slip).max(-self.suction)
    }

    /// Never above the windward pressure, so that drag has the right sign for every body.
    fn leeward(&self, squared_slip: f64) -> f64 {
        let windward = self.windward(squared_slip);
        // The lee of a streamlined body stays attached until it is slower than at separation.
        let attached = if squared_slip < self.separated_slip {
            self.base
        } else {
            windward
        };
        self.bluffness * self.base.min(windward) + (1.0 - self.bluffness) * attached
    }
}

pub(crate) fn base_suction(aspect: f64) -> f64 {
    ROUND_SUCTION + (LONG_SUCTION - ROUND_SUCTION) / (1.0 + ASPECT_SCALE / (aspect - 1.0))
}

/// Pressure coefficient at separation.
fn separation_pressure(largest_squared_slip: f64) -> f64 {
    1.0 - (1.0 - RECOVERY) * largest_squared_slip
}

fn smoothstep(x: f64) -> f64 {
    let t = x.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
