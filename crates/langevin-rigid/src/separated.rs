//! Separated flow: a closure on top of Kirchhoff's equations that flutters and tumbles.
//!
//! Potential flow turns a moving body with the couple tau = -v x A11 v (Munk). In real flow the
//! separated wake leaves a fraction of it, the attachment `a`, and that fraction is the couple of a
//! normal force ahead of the middle. The attachment falls with incidence (stall), and it rises
//! while incidence grows and falls while it shrinks (dynamic stall); that lag is the negative
//! damping which drives tumbling. Rotation carries a circulation, whose lift does no work. Drag is
//! a tensor. Everything is written with the structure of the added-mass tensor, so it holds for
//! bodies of any shape and needs no panels.

mod eddies;
mod slice;

use arrayvec::ArrayVec;

use crate::ambient::{Ambient, Relative};
use crate::body::{Body, MOST_SLICES, Slice, shift_added_mass};
use crate::kirchhoff::Load;
use crate::linalg::{
    Mat3, Mat6, Vec3, Vec6, add, cholesky, cross, dot, each, invert_spd, join, lift, mat_vec, mul,
    norm, scale, split, sub,
};
use crate::real::Real;
use crate::symmetry::{Block, General, Symmetry};
pub(crate) use eddies::Eddies;
use slice::{SliceClosure, SliceLoads};

/// The constants of the closure, the same for all bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct SeparatedFlow {
    /// Attachment at small incidence, 0.45 to 0.8: a lift slope of pi for a thin plate, whose normal force acts at
    /// `normal_force_arm`.
    pub attachment: f64,
    /// Attachment near broadside, 0.05 to 0.2: sets the centre of pressure at 45 to 60 degrees.
    pub broadside_attachment: f64,
    /// Where the normal force acts, in chords ahead of the middle, 0.25 to 0.3: 1/4 in theory, 0.3 as measured (Li,
    /// Goodwill, Wang & Ristroph 2022).
    pub normal_force_arm: f64,
    /// Gain of dynamic stall at a sharp edge, 2 to 6; larger values change nothing.
    pub dynamic_stall: f64,
    /// Rotational lift in units of that of attached flow (Theodorsen 1935), which is 1.
    pub rotational_lift: f64,
    /// Rotational damping of a thick body that moves on, 0.7 to 1.2, in units of that of the local crossflow on a rod.
    pub damping: f64,
    /// Rotational damping of a body that spins, 0.5 to 1, in units of the added inertia of a plate.
    pub rotational_damping: f64,
    /// Speed of the tips over that of the centre at which half of the relief round the ends is lost, 0.25 to 1.
    pub relief_speed: f64,
    /// Intensity of the turbulence that the body sheds, fluctuation over speed at a drag coefficient of 1: 0.05 to 0.2.
    pub turbulence_intensity: f64,
    /// Memory of that turbulence, in the time that the body takes for half its width: 0.3 to 3.
    pub turbulence_memory: f64,
    /// Whether the flow stays attached: Kirchhoff's equations alone.
    pub attached: bool,
}

impl Default for SeparatedFlow {
    fn default() -> Self {
        Self {
            attachment: 0.6,
            broadside_attachment: 0.1,
            normal_force_arm: 0.3,
            dynamic_stall: 4.0,
            rotational_lift: 1.0,
            damping: 1.0,
            rotational_damping: 0.75,
            relief_speed: 0.8,
            turbulence_intensity: 0.1,
            turbulence_memory: 1.0,
            attached: false,
        }
    }
}

/// Attachment never quite reaches its ceiling, which keeps dynamic stall finite.
const FULLEST: f64 = 0.98;
/// Attachment of a slender wing relative to a two-dimensional one (Helmbold, at an aspect ratio of 4/pi).
const SLENDER: f64 = 0.08;

/// The closure of one body in one fluid.
#[derive(Debug, Clone)]
pub(crate) struct Closure<F: Symmetry = General, R: Real = f64> {
    constants: SeparatedFlow,
    /// Slices; inline, so that putting them into lanes allocates nothing.
    slices: ArrayVec<SliceClosure<F, R>, MOST_SLICES>,
    /// Hydrodynamic centre: the centroid of the volume, from the centre of mass (m).
    centre: Vec3<R>,
    /// Stokes resistance to translation and rotation about the centroid (kg/s, kg m^2/s).
    stokes: [F::Block<R>; 2],
}

impl Closure {
    /// `None` if the body has no extents.
    pub(crate) fn new(
        body: &Body,
        density: f64,
        viscosity: f64,
        constants: SeparatedFlow,
    ) -> Option<Self> {
        cholesky(&body.separation.extents)?;
        let friction = slice::skin_friction(body, density, viscosity);
        let slice = |slice: &Slice| {
            SliceClosure::new(slice, body, density, viscosity, &constants, &friction)
        };
        let stokes = [
            body.separation.stokes_translation,
            body.separation.stokes_rotation,
        ];
        Some(Self {
            constants,
            slices: if body.slices.is_empty() {
                [slice(&whole(body))].into_iter().collect()
            } else {
                body.slices.iter().map(slice).collect()
            },
            centre: body.centre_of_buoyancy,
            stokes: stokes.map(|tensor| scaled(density * viscosity, &tensor)),
        })
    }

    /// The second-largest half-extent of the body (m).
    pub(crate) fn length(&self) -> f64 {
        1.0 / self.slices[0].per_length
    }

    /// The same for a body of shape `G` in the lanes of `like`.
    pub(crate) fn lift<G: Symmetry, R: Real>(&self, like: R) -> Closure<G, R> {
        Closure {
            constants: self.constants,
            slices: self.slices.iter().map(|slice| slice.lift(like)).collect(),
            centre: lift(like, &self.centre),
            stokes: self.stokes.map(|tensor| G::block(like, &tensor)),
        }
    }
}

impl<F: Symmetry, R: Real> Closure<F, R> {
    /// The closure's generalized force about the centre of mass, body frame, from the velocity
    /// relative to the mean flow and what else the fluid does, body frame; none where the flow stays attached.
    ///
    /// It never feeds energy: its power on the motion relative to the fluid is negative or zero in every state.
    #[inline(always)]
    pub(crate) fn load(&self, xi: &Vec6<R>, ambient: &Ambient<R>) -> Option<Load<R>> {
        if self.constants.attached {
            return None;
        }
        let relative = Relative::new(xi, ambient);
        let spin = norm(relative.omega);
        let (mut sum, mut fed) = self.friction(&relative);
        for slice in &self.slices {
            let at_slice = relative.at(slice.centre);
            let stream = slice.stream(&self.constants, at_slice, relative.omega, spin);
            let loads = Loads::of(&slice.loads(&stream));
            if ambient.gradient.is_some() {
                fed = fed + relative.fed(slice.centre, loads.force, loads.torque);
            }
            sum.add(slice.centre, &loads);
        }
        // The rotational lift does no work, so this is the power of the resistances.
        let mut power = relative.power(sum.force, sum.torque);
        if ambient.gradient.is_some() {
            power = power - fed;
        }
        let separation = limited(sum.lost, relative.omega, power);
        if ambient.gradient.is_some() {
            fed = fed + relative.fed([power.of(0.0); 3], [power.of(0.0); 3], separation);
        }
        Some(Load {
            force: join(sum.force, add(sum.torque, separation)),
            fed,
        })
    }

    /// The resistances D of [`Closure::load`], which contains them as -D xi: Stokes resistance, skin friction, pressure
    /// drag, normal force and rotational damping, about the centre of mass. Symmetric and positive.
    #[inline(always)]
    pub(crate) fn resistance(&self, xi: &Vec6<R>, ambient: &Ambient<R>) -> Mat6<R> {
        let relative = Relative::new(xi, ambient);
        let spin = norm(relative.omega);
        let [translation, rotation] = &self.stokes;
        let mut sum = about_centre_of_mass(self.centre, &translation.matrix(), &rotation.matrix());
        for slice in &self.slices {
            let at_slice = relative.at(slice.centre);
            let stream = slice.stream(&self.constants, at_slice, relative.omega, spin);
            let resistance = slice.resistance(&stream);
            for i in 0..6 {
                for j in 0..6 {
                    sum[i][j] = sum[i][j] + resistance[i][j];
                }
            }
        }
        sum
    }

    /// [`Closure::load`] in two: the resistances D, and the rest, load + D xi; none where the flow stays
    /// attached.
    #[inline(always)]
    pub(crate) fn resisted_load(
        &self,
        xi: &Vec6<R>,
        ambient: &Ambient<R>,
    ) -> Option<(Load<R>, Mat6<R>)> {
        let load = self.load(xi, ambient)?;
        let resistance = self.resistance(xi, ambient);
        let resisted = mul(&resistance, xi);
        let force = each(
            xi[0],
            #[inline(always)]
            |i| load.force[i] + resisted[i],
        );
        Some((Load { force, ..load }, resistance))
    }

    /// Stokes resistance, about the centre of mass, and what the fluid's rotation and strain feed through it.
    #[inline(always)]
    fn friction(&self, relative: &Relative<'_, R>) -> (Loads<R>, R) {
        let [translation, rotation] = &self.stokes;
        let torque = negative(rotation.times(relative.omega));
        let lost = [torque[0].of(0.0); 3];
        if F::CENTRED {
            let force = negative(translation.times(relative.at_centre_of_mass()));
            let fed = relative.fed(self.centre, force, torque);
            return (
                Loads {
                    force,
                    torque,
                    lost,
                },
                fed,
            );
        }
        let force = negative(translation.times(relative.at(self.centre)));
        let fed = relative.fed(self.centre, force, torque);
        let torque = add(torque, cross(self.centre, force));
        (
            Loads {
                force,
                torque,
                lost,
            },
            fed,
        )
    }
}

impl Closure {
    /// Fraction of the potential couple that separation leaves: the mean of the slices, each by its added mass.
    pub(crate) fn attachment(&self, xi: &Vec6, ambient: &Ambient) -> f64 {
        if self.constants.attached {
            return 1.0;
        }
        let relative = Relative::new(xi, ambient);
        let spin = norm(relative.omega);
        let (mut sum, mut whole) = (0.0, 0.0);
        for slice in &self.slices {
            let at_slice = relative.at(slice.centre);
            let stream = slice.stream(&self.constants, at_slice, relative.omega, spin);
            sum += slice.largest * stream.attachment;
            whole += slice.largest;
        }
        if whole > 0.0 { sum / whole } else { 1.0 }
    }

    /// [`Closure::load`] by cause, in the body frame, about the centre of mass.
    pub(crate) fn causes(&self, xi: &Vec6, ambient: &Ambient) -> Causes {
        let mut causes = Causes::default();
        let Some(load) = self.load(xi, ambient) else {
            return causes;
        };
        let relative = Relative::new(xi, ambient);
        let (friction, _) = self.friction(&relative);
        causes.friction = join(friction.force, friction.torque);
        let mut rest: Vec6 = std::array::from_fn(|i| load.force[i] - causes.friction[i]);
        for slice in &self.slices {
            let at_slice = relative.at(slice.centre);
            let spin = norm(relative.omega);
            let stream = slice.stream(&self.constants, at_slice, relative.omega, spin);
            let loads = slice.loads(&stream);
            for (cause, force, torque) in [
                (&mut causes.rotational_lift, loads.lift, [0.0; 3]),
                (&mut causes.drag, negative(loads.drag), [0.0; 3]),
                (&mut causes.normal_force, negative(loads.normal), [0.0; 3]),
                (&mut causes.damping, [0.0; 3], loads.damping),
            ] {
                let about_mass = join(force, add(torque, cross(slice.centre, force)));
                for i in 0..6 {
                    cause[i] += about_mass[i];
                    rest[i] -= about_mass[i];
                }
            }
        }
        causes.lost_couple = join([0.0; 3], split(&rest).1);
        causes
    }
}

/// The loads of the closure by cause: force and torque about the centre of mass, body frame.
#[derive(Default)]
pub(crate) struct Causes {
    pub(crate) drag: Vec6,
    pub(crate) normal_force: Vec6,
    pub(crate) rotational_lift: Vec6,
    pub(crate) damping: Vec6,
    pub(crate) lost_couple: Vec6,
    pub(crate) friction: Vec6,
}

/// The body as its only slice, whose loads act at the centre of its added mass.
fn whole(body: &Body) -> Slice {
    let centre = added_centre(body);
    let about_centre = shift_added_mass(&body.added_mass, centre);
    let block = |k: usize| -> Mat3 {
        std::array::from_fn(|i| std::array::from_fn(|j| about_centre[k + i][k + j]))
    };
    Slice {
        centre,
        translation: block(0),
        rotation: block(3),
        drag_area: body.separation.drag_area,
        extents: body.separation.extents,
    }
}

/// The point about which the coupling block of the added mass is symmetric, from the centre of mass (m).
///
/// Along the normal of a plate, where it may lie anywhere, it stays near the centroid of the volume.
fn added_centre(body: &Body) -> Vec3 {
    const STAY: f64 = 1e-3;
    let centroid = body.centre_of_buoyancy;
    let about = shift_added_mass(&body.added_mass, centroid);
    let trace = about[0][0] + about[1][1] + about[2][2];
    let turning: Mat3 = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let diagonal = if i == j { (1.0 + STAY) * trace } else { 0.0 };
            diagonal - about[i][j]
        })
    });
    let coupling = |i: usize, j: usize| about[i][3 + j] - about[j][3 + i];
    let axial = [coupling(2, 1), coupling(0, 2), coupling(1, 0)];
    match invert_spd(&turning) {
        Some(inverse) => sub(centroid, mat_vec(&inverse, axial)),
        None => centroid,
    }
}

/// Loads about a point.
struct Loads<R> {
    /// Rotational lift, normal force and drag (N).
    force: Vec3<R>,
    /// Their moment and the rotational damping (N m).
    torque: Vec3<R>,
    /// The part of the couple that separation takes away (N m).
    lost: Vec3<R>,
}

impl<R: Real> Loads<R> {
    #[inline(always)]
    fn of(slice: &SliceLoads<R>) -> Self {
        Self {
            force: sub(slice.lift, add(slice.drag, slice.normal)),
            torque: slice.damping,
            lost: slice.lost,
        }
    }

    /// Adds `loads` about `centre`.
    #[inline(always)]
    fn add(&mut self, centre: Vec3<R>, loads: &Self) {
        self.force = add(self.force, loads.force);
        self.torque = add(self.torque, add(loads.torque, cross(centre, loads.force)));
        self.lost = add(self.lost, loads.lost);
    }
}

/// The lost couple, limited to what the other loads dissipate where it would feed energy.
#[inline(always)]
fn limited<R: Real>(lost: Vec3<R>, omega: Vec3<R>, power: R) -> Vec3<R> {
    let zero = power.of(0.0);
    let fed = dot(lost, omega);
    let dissipated = power.min(zero);
    let feeds = zero.less(fed + dissipated);
    if !R::any(feeds) {
        return lost;
    }
    scale(R::choose(feeds, -dissipated / fed, power.of(1.0)), lost)
}

/// A resistance to the velocity of the point `centre` and one to rotation, as a tensor about the centre
/// of mass: that velocity is v - [centre] omega.
#[inline(always)]
fn about_centre_of_mass<R: Real>(
    centre: Vec3<R>,
    translation: &Mat3<R>,
    rotation: &Mat3<R>,
) -> Mat6<R> {
    let zero = centre[0].of(0.0);
    let [x, y, z] = centre;
    let arm = [[zero, -z, y], [z, zero, -x], [-y, x, zero]];
    let mut sum = [[zero; 6]; 6];
    for i in 0..3 {
        let carried = cross(translation[i], centre);
        for j in 0..3 {
            sum[i][j] = translation[i][j];
            // translation (omega x centre) = (centre x translation_i) . omega
            sum[i][3 + j] = -carried[j];
            sum[3 + j][i] = -carried[j];
        }
    }
    for i in 0..3 {
        for j in 0..3 {
            let moment =
                arm[i][0] * sum[0][3 + j] + arm[i][1] * sum[1][3 + j] + arm[i][2] * sum[2][3 + j];
            sum[3 + i][3 + j] = rotation[i][j] + moment;
        }
    }
    sum
}

#[inline(always)]
fn negative<R: Real>(a: Vec3<R>) -> Vec3<R> {
    [-a[0], -a[1], -a[2]]
}

fn scaled(factor: f64, m: &Mat3) -> Mat3 {
    shifted(m, factor, 0.0)
}

/// `s m + d 1`.
fn shifted(m: &Mat3, s: f64, d: f64) -> Mat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| s * m[i][j] + if i == j { d } else { 0.0 }))
}

#[cfg(test)]
mod tests;
