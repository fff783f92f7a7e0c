//! A force that steers the body of a scene.

use langevin_rigid::Wrench;
use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{add, norm, scale};
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{FORCE, TIME_STEP};
use super::raw::{RawSteering, given};

/// Most control points of a force.
const MOST: usize = 4096;

/// A force at the centre of mass, world frame, that varies smoothly: a uniform cubic B-spline in time.
///
/// Its weights are positive and sum up to no more than one, so it is nowhere larger than its largest control point.
/// Before the first and after the last of them it fades over two intervals.
///
/// ```
/// use langevin_rigid_scenes::scene::Steering;
/// let steering = Steering { every: 0.5, force: vec![[6.0, 0.0, 0.0]; 5] };
/// assert!((steering.at(1.0)[0] - 6.0).abs() < 1e-12);
/// assert!((steering.at(0.0)[0] - 5.0).abs() < 1e-12);
/// assert_eq!(steering.at(3.0), [0.0; 3]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Steering {
    /// Time between two control points, of which the first is at zero (s).
    pub every: f64,
    /// The control points (N).
    pub force: Vec<Vec3>,
}

impl Steering {
    /// The force at a time of the body (s), N.
    pub fn at(&self, time: f64) -> Vec3 {
        let place = time / self.every;
        // Control points more than two intervals away have no weight.
        let first = (place.floor() - 1.0).max(0.0) as usize;
        let near = self.force.iter().enumerate().skip(first).take(4);
        near.fold([0.0; 3], |sum, (number, force)| {
            add(sum, scale(weight(place - number as f64), *force))
        })
    }

    /// Adds it to what acts on a body.
    pub(crate) fn push(&self, time: f64, wrench: &mut Wrench) {
        wrench.force = add(wrench.force, self.at(time));
    }

    /// Its largest and its root mean square over the first `seconds` (N).
    pub fn largest_and_rms(&self, seconds: f64) -> [f64; 2] {
        const MOMENTS: u32 = 1000;
        let sizes =
            (0..=MOMENTS).map(|i| norm(self.at(seconds * f64::from(i) / f64::from(MOMENTS))));
        let (most, squares) = sizes.fold((0.0, 0.0), |(most, squares): (f64, f64), size| {
            (most.max(size), squares + size * size)
        });
        [most, (squares / f64::from(MOMENTS + 1)).sqrt()]
    }
}

/// The cubic B-spline around zero.
fn weight(away: f64) -> f64 {
    let away = away.abs();
    let rest = (2.0 - away).max(0.0);
    match away < 1.0 {
        true => 2.0 / 3.0 - away * away + 0.5 * away * away * away,
        false => rest * rest * rest / 6.0,
    }
}

pub(super) fn resolve(
    doc: &Document,
    raw: Option<&Spanned<RawSteering>>,
) -> Result<Option<Steering>, SceneError> {
    let Some(raw) = raw else { return Ok(None) };
    let RawSteering { every, force } = raw.get_ref();
    let (Some(every), Some(force)) = (every, force) else {
        let message = "[steering] needs `force` (N), a list of control points [x, y, z], and `every` (s), the time between them";
        return Err(doc.error(raw.span(), message));
    };
    if !(1..=MOST).contains(&force.get_ref().len()) {
        let message = format!("`force` takes 1 to {MOST} control points");
        return Err(doc.error(force.span(), message));
    }
    let points = force.get_ref().iter();
    let points = points.map(|point| doc.numbers(point, "force", FORCE));
    Ok(Some(Steering {
        every: doc.number(every, "every", TIME_STEP)?,
        force: points.collect::<Result<_, _>>()?,
    }))
}

/// The section of a resolved scene.
pub(super) fn write(steering: &Steering) -> Spanned<RawSteering> {
    let points = steering.force.iter();
    let points = points.map(|point| Spanned::new(0..0, point.to_vec()));
    let raw = RawSteering {
        every: given(steering.every),
        force: given(points.collect()),
    };
    Spanned::new(0..0, raw)
}
