//! Separated flow: a closure on top of Kirchhoff's equations that flutters and tumbles.
//!
//! Potential flow turns a moving body with the couple tau = -v x A11 v (Munk). In real flow the
//! separated wake leaves a fraction of it, the attachment `a`, and that fraction is the couple of a
//! normal force at the quarter chord. The attachment falls with incidence (stall), and it rises
//! while incidence grows and falls while it shrinks (dynamic stall); that lag is the negative
//! damping which drives tumbling. Rotation carries a circulation, whose lift does no work. Drag is
//! a tensor. Everything is written with the structure of the added-mass tensor, so it holds for
//! bodies of any shape and needs no panels.

use arrayvec::ArrayVec;

use crate::body::{Body, MOST_SLICES, Slice, shift_added_mass};
use crate::elementary::exp;
use crate::input::rotation_rate;
use crate::kirchhoff::Load;
use crate::linalg::{
    Mat3, Mat6, Vec3, Vec6, add, cholesky, cross, dot, each, eigen_symmetric, join, lift, mat_vec,
    mul, norm, scale, split, sub,
};
use crate::real::Real;
use crate::symmetry::{Block, General, Symmetry};

/// The constants of the closure, the same for all bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct SeparatedFlow {
    /// Attachment at small incidence. 1/2 gives a plate the lift slope pi and the normal force of
    /// thin-plate measurements; not fitted.
    pub attachment: f64,
    /// Attachment near broadside, 0.1 to 0.25: sets the centre of pressure at 45 to 60 degrees.
    pub broadside_attachment: f64,
    /// Gain of dynamic stall, 3 to 6; larger values change nothing.
    pub dynamic_stall: f64,
    /// Rotational lift in units of that of attached flow (Theodorsen 1935), which is 1.
    pub rotational_lift: f64,
    /// Rotational damping, 0.5 to 0.8. Above 1.27 (discs) and 1.66 (strips) heavy plates stop
    /// tumbling.
    pub rotational_damping: f64,
    /// Intensity of the turbulence shed by the body, fluctuation over speed: 0.1.
    pub turbulence_intensity: f64,
    /// Whether the flow stays attached: Kirchhoff's equations alone.
    pub attached: bool,
}

impl Default for SeparatedFlow {
    fn default() -> Self {
        Self {
            attachment: 0.5,
            broadside_attachment: 0.15,
            dynamic_stall: 6.0,
            rotational_lift: 1.0,
            rotational_damping: 0.75,
            turbulence_intensity: 0.1,
            attached: false,
        }
    }
}

/// Attachment never quite reaches its ceiling, which keeps dynamic stall finite.
const FULLEST: f64 = 0.98;
/// Attachment of a slender wing relative to a two-dimensional one (R. T. Jones 1946).
const SLENDER: f64 = 0.25;

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
        let slice = |slice: &Slice| SliceClosure::new(slice, body, density, &constants);
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
    /// relative to the fluid and the gradient of the fluid's velocity, body frame; none where the flow stays attached.
    ///
    /// It never feeds energy: its power on the motion relative to the fluid is negative or zero in every state.
    #[inline(always)]
    pub(crate) fn load(&self, xi: &Vec6<R>, gradient: Option<&Mat3<R>>) -> Option<Load<R>> {
        if self.constants.attached {
            return None;
        }
        let relative = Relative::new(xi, gradient);
        let spin = norm(relative.omega);
        let (mut sum, mut fed) = self.friction(&relative);
        for slice in &self.slices {
            let at_slice = relative.at(slice.centre);
            let stream = slice.stream(&self.constants, at_slice, relative.omega, spin);
            let loads = slice.loads(&stream).together();
            if gradient.is_some() {
                fed = fed + relative.fed(slice.centre, loads.force, loads.torque);
            }
            sum.add(slice.centre, &loads);
        }
        let (v, omega) = split(xi);
        // The rotational lift does no work, so this is the power of the resistances.
        let mut power = dot(sum.force, v) + dot(sum.torque, omega);
        if gradient.is_some() {
            power = power - fed;
        }
        let separation = limited(sum.lost, relative.omega, power);
        if gradient.is_some() {
            fed = fed + dot(separation, relative.turning);
        }
        Some(Load {
            force: join(sum.force, add(sum.torque, separation)),
            fed,
        })
    }

    /// The resistances D of [`Closure::load`], which contains them as -D xi: Stokes resistance, pressure
    /// drag, normal force and rotational damping, about the centre of mass. Symmetric and positive.
    #[inline(always)]
    pub(crate) fn resistance(&self, xi: &Vec6<R>, gradient: Option<&Mat3<R>>) -> Mat6<R> {
        let relative = Relative::new(xi, gradient);
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
        gradient: Option<&Mat3<R>>,
    ) -> Option<(Load<R>, Mat6<R>)> {
        let load = self.load(xi, gradient)?;
        let resistance = self.resistance(xi, gradient);
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
            let force = negative(translation.times(relative.v));
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

/// The motion of a body relative to the fluid around it, body frame.
struct Relative<'a, R> {
    /// Velocity of the centre of mass (m/s).
    v: Vec3<R>,
    /// Angular velocity of the body (rad/s), and that relative to the fluid.
    spin: Vec3<R>,
    omega: Vec3<R>,
    /// Rotation rate of the fluid (rad/s), zero without a gradient.
    turning: Vec3<R>,
    /// Gradient of the fluid's velocity (1/s).
    gradient: Option<&'a Mat3<R>>,
}

impl<'a, R: Real> Relative<'a, R> {
    #[inline(always)]
    fn new(xi: &Vec6<R>, gradient: Option<&'a Mat3<R>>) -> Self {
        let (v, spin) = split(xi);
        let (mut omega, mut turning) = (spin, [v[0].of(0.0); 3]);
        if let Some(gradient) = gradient {
            turning = rotation_rate(gradient);
            omega = sub(spin, turning);
        }
        Self {
            v,
            spin,
            omega,
            turning,
            gradient,
        }
    }

    /// Velocity of the point `centre` of the body relative to the fluid there.
    #[inline(always)]
    fn at(&self, centre: Vec3<R>) -> Vec3<R> {
        let velocity = add(self.v, cross(self.spin, centre));
        match self.gradient {
            Some(gradient) => sub(velocity, mat_vec(gradient, centre)),
            None => velocity,
        }
    }

    /// Power (W) that a force at `centre` and a couple have on the motion of the body beyond that on its motion
    /// relative to the fluid: what the fluid's own rotation and strain feed.
    #[inline(always)]
    fn fed(&self, centre: Vec3<R>, force: Vec3<R>, couple: Vec3<R>) -> R {
        match self.gradient {
            Some(gradient) => dot(force, mat_vec(gradient, centre)) + dot(couple, self.turning),
            None => self.v[0].of(0.0),
        }
    }
}

impl Closure {
    /// [`Closure::load`] by cause, in the body frame, about the centre of mass.
    pub(crate) fn causes(&self, xi: &Vec6, gradient: Option<&Mat3>) -> Causes {
        let mut causes = Causes::default();
        let Some(load) = self.load(xi, gradient) else {
            return causes;
        };
        let relative = Relative::new(xi, gradient);
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

/// The body as its only slice.
fn whole(body: &Body) -> Slice {
    let about_centre = shift_added_mass(&body.added_mass, body.centre_of_buoyancy);
    let block = |k: usize| -> Mat3 {
        std::array::from_fn(|i| std::array::from_fn(|j| about_centre[k + i][k + j]))
    };
    Slice {
        centre: body.centre_of_buoyancy,
        translation: block(0),
        rotation: block(3),
        drag_area: body.separation.drag_area,
        extents: body.separation.extents,
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
    /// Adds `loads` about `centre`.
    #[inline(always)]
    fn add(&mut self, centre: Vec3<R>, loads: &Self) {
        self.force = add(self.force, loads.force);
        self.torque = add(self.torque, add(loads.torque, cross(centre, loads.force)));
        self.lost = add(self.lost, loads.lost);
    }
}

/// What a slice sees of the fluid.
struct Stream<R: Real> {
    /// Velocity relative to the fluid at its centre (m/s), and angular velocity relative to it (rad/s).
    v: Vec3<R>,
    omega: Vec3<R>,
    speed: R,
    direction: Vec3<R>,
    incidence: Incidence<R>,
    attachment: R,
    /// Factor of the rotational damping (1/s).
    damping: R,
}

/// Loads of a slice, at and about its centre.
struct SliceLoads<R> {
    /// Rotational lift (N).
    lift: Vec3<R>,
    /// Pressure drag and normal force, reversed (N).
    drag: Vec3<R>,
    normal: Vec3<R>,
    /// Rotational damping (N m).
    damping: Vec3<R>,
    /// The part of the couple that separation takes away (N m).
    lost: Vec3<R>,
}

impl<R: Real> SliceLoads<R> {
    #[inline(always)]
    fn together(&self) -> Loads<R> {
        Loads {
            force: sub(self.lift, add(self.drag, self.normal)),
            torque: self.damping,
            lost: self.lost,
        }
    }
}

/// A slice with its tensors in the fluid.
#[derive(Debug, Clone)]
struct SliceClosure<F: Symmetry = General, R: Real = f64> {
    centre: Vec3<R>,
    /// (A11 - mu 1) / lam, mu and lam the least and largest eigenvalue of A11.
    directed: F::Block<R>,
    /// lam (kg).
    largest: R,
    /// 2 lam / (lam - mu); zero for a body without a direction.
    turning: R,
    /// tr(A11) 1 - A11, times the rotational lift (kg).
    circulation: F::Block<R>,
    /// A22 about the centre, times the rotational damping (kg m^2).
    rotation: F::Block<R>,
    /// Drag areas P times half the fluid's density (kg/m).
    drag_area: F::Block<R>,
    /// Squared half-extents of the slice and of the body (m^2).
    extents: F::Block<R>,
    body_extents: F::Block<R>,
    /// One over the second-largest half-extent L of the body (1/m).
    per_length: R,
}

impl SliceClosure {
    fn new(slice: &Slice, body: &Body, density: f64, constants: &SeparatedFlow) -> Self {
        let translation = scaled(density, &slice.translation);
        let ([mu, _, lam], _) = eigen_symmetric(&translation);
        let trace = translation[0][0] + translation[1][1] + translation[2][2];
        let spread = lam - mu;
        let per_largest = if lam > 0.0 { 1.0 / lam } else { 0.0 };
        let directed = spread > f64::NEGLIGIBLE * lam;
        Self {
            centre: slice.centre,
            directed: shifted(&translation, per_largest, -mu * per_largest),
            largest: lam,
            turning: if directed { 2.0 * lam / spread } else { 0.0 },
            circulation: scaled(
                constants.rotational_lift,
                &shifted(&translation, -1.0, trace),
            ),
            rotation: scaled(constants.rotational_damping * density, &slice.rotation),
            drag_area: scaled(0.5 * density, &slice.drag_area),
            extents: slice.extents,
            body_extents: body.separation.extents,
            per_length: 1.0 / body.half_extents[1],
        }
    }

    fn lift<G: Symmetry, R: Real>(&self, like: R) -> SliceClosure<G, R> {
        SliceClosure {
            centre: lift(like, &self.centre),
            directed: G::block(like, &self.directed),
            largest: like.of(self.largest),
            turning: like.of(self.turning),
            circulation: G::block(like, &self.circulation),
            rotation: G::block(like, &self.rotation),
            drag_area: G::block(like, &self.drag_area),
            extents: G::block(like, &self.extents),
            body_extents: G::block(like, &self.body_extents),
            per_length: like.of(self.per_length),
        }
    }
}

impl<F: Symmetry, R: Real> SliceClosure<F, R> {
    /// What a slice sees, from the velocity relative to the fluid at its centre; `spin` is |omega|.
    #[inline(always)]
    fn stream(&self, c: &SeparatedFlow, v: Vec3<R>, omega: Vec3<R>, spin: R) -> Stream<R> {
        let (zero, one) = (spin.of(0.0), spin.of(1.0));
        let speed = norm(v);
        let per_speed = R::choose(zero.less(speed), one / speed, zero);
        let direction = scale(per_speed, v);
        let incidence = self.incidence(direction);
        let attachment = self.attachment(c, &incidence, dot(omega, incidence.couple) * per_speed);
        Stream {
            v,
            omega,
            speed,
            direction,
            incidence,
            attachment,
            damping: speed * self.per_length + spin,
        }
    }

    #[inline(always)]
    fn loads(&self, stream: &Stream<R>) -> SliceLoads<R> {
        let attachment = stream.attachment;
        let incidence = &stream.incidence;
        let couple = self.largest * (stream.speed * stream.speed);
        let normal = (attachment + attachment) * couple * incidence.leverage;
        let lift = cross(self.circulation.times(stream.omega), stream.v);
        SliceLoads {
            lift: scale(attachment, lift),
            drag: self.drag(stream.direction, stream.speed),
            normal: scale(normal, incidence.pull),
            damping: scale(-stream.damping, self.rotation.times(stream.omega)),
            lost: scale((attachment - attachment.of(1.0)) * couple, incidence.couple),
        }
    }

    /// What resists in `loads`, as a tensor about the centre of mass.
    #[inline(always)]
    fn resistance(&self, stream: &Stream<R>) -> Mat6<R> {
        let (attachment, speed) = (stream.attachment, stream.speed);
        let normal = (attachment + attachment) * self.largest * speed * stream.incidence.leverage;
        let along = self.drag_area.times(stream.direction);
        let size = norm(along);
        let drag = speed * dot(stream.direction, along) / size;
        let zero = size.of(0.0);
        let drag = R::choose(zero.less(size), drag, zero);

        let (directed, areas) = (self.directed.matrix(), self.drag_area.matrix());
        let (mut translation, mut rotation) = (areas, self.rotation.matrix());
        for i in 0..3 {
            for j in 0..3 {
                translation[i][j] = normal * directed[i][j] + drag * areas[i][j];
                rotation[i][j] = stream.damping * rotation[i][j];
            }
        }
        about_centre_of_mass(self.centre, &translation, &rotation)
    }

    /// Direction and size of the potential couple, and the chord and span that belong to it, from the
    /// direction of motion.
    #[inline(always)]
    fn incidence(&self, direction: Vec3<R>) -> Incidence<R> {
        let pull = self.directed.times(direction);
        let couple = cross(pull, direction);
        let (couple2, pull2) = (dot(couple, couple), dot(pull, pull));
        let (zero, one) = (pull2.of(0.0), pull2.of(1.0));
        let negligible = pull2.of(R::NEGLIGIBLE * R::NEGLIGIBLE);
        let turns = negligible.less(couple2);

        // Chord times |couple| |pull|, span times |couple|.
        let chord = cross(couple, pull);
        let half_chord = dot(chord, self.extents.times(chord)).sqrt();
        let half_span = (dot(couple, self.body_extents.times(couple)) * pull2).sqrt();
        let edgewise = zero.less(self.turning) & !negligible.less(pull2);
        // One division for the three quotients couple2 / half_chord, couple2 / pull2 and
        // half_chord / (|couple| |pull|).
        let lengths = (couple2 * pull2).sqrt();
        let quotient = R::choose(turns, one / (half_chord * pull2 * lengths), zero);
        let by_lengths = lengths * quotient;
        Incidence {
            couple,
            pull,
            leverage: couple2 * pull2 * by_lengths,
            cos2: R::choose(
                turns,
                couple2 * half_chord * by_lengths,
                R::choose(edgewise, one, zero),
            ),
            turning: self.turning * (half_chord * half_chord) * pull2 * quotient,
            half_chord,
            half_span,
            turns,
        }
    }

    /// The fraction of the potential couple that survives; `turn` is omega . couple / |v|.
    #[inline(always)]
    fn attachment(&self, c: &SeparatedFlow, incidence: &Incidence<R>, turn: R) -> R {
        let broadside = turn.of(c.broadside_attachment);
        let still = broadside + turn.of(c.attachment - c.broadside_attachment) * incidence.cos2;
        // The ceiling is b / a, the fraction of it without lag g / b.
        let a = incidence.half_span + incidence.half_chord;
        let b = incidence.half_span + turn.of(SLENDER) * incidence.half_chord;
        let g = (still * a).min(turn.of(FULLEST) * b);
        // Reduced rate of growing incidence: omega l sin(2 alpha) / V for a plate.
        let rate = incidence.turning * turn;
        let lag = exp(turn.of(-2.0 * c.dynamic_stall) * rate);
        let lagged = b * g / (a * (g + (b - g) * lag));
        R::choose(incidence.turns, lagged, still)
    }

    /// Pressure drag along P v of a motion at `speed` in `direction`, reversed.
    #[inline(always)]
    fn drag(&self, direction: Vec3<R>, speed: R) -> Vec3<R> {
        let along = self.drag_area.times(direction);
        let size = norm(along);
        let zero = size.of(0.0);
        let strength = speed * speed * dot(direction, along) / size;
        scale(R::choose(zero.less(size), strength, zero), along)
    }
}

/// The body's attitude to the stream, for unit speed; no leverage where there is no couple.
struct Incidence<R: Real> {
    /// tau / lam = -v x A11 v / lam.
    couple: Vec3<R>,
    /// (A11 - mu 1) v / lam, along the normal force.
    pull: Vec3<R>,
    /// The normal force per attachment and `pull`: that of the couple at the quarter chord.
    leverage: R,
    /// Squared cosine of the incidence: 1 edgewise, 0 broadside.
    cos2: R,
    /// From omega . couple to the reduced rate of growing incidence (m).
    turning: R,
    /// Half chord and half span, in the same unit.
    half_chord: R,
    half_span: R,
    /// Whether there is a couple.
    turns: R::Mask,
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
mod tests {
    use super::*;
    use crate::body::{Separation, Surface};

    fn diagonal(d: [f64; 3]) -> Mat3 {
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
    }

    /// A flat body, thin along y, in a fluid of density 1 without viscosity.
    fn plate(added: [f64; 6], drag: [f64; 3], half_extents: [f64; 3]) -> Closure {
        let mut added_mass = [[0.0; 6]; 6];
        for i in 0..6 {
            added_mass[i][i] = added[i];
        }
        let mut sorted = half_extents;
        sorted.sort_by(|a, b| b.total_cmp(a));
        let body = Body {
            mass: 1.0,
            inertia: diagonal([1.0; 3]),
            volume: 1.0,
            centre_of_buoyancy: [0.0; 3],
            added_mass,
            half_extents: sorted,
            thickness: 1.0,
            length: 1.0,
            separation: Separation {
                drag_area: diagonal(drag),
                extents: diagonal(half_extents.map(|e| e * e)),
                ..Separation::default()
            },
            slices: vec![],
            surface: Surface::default(),
        };
        Closure::new(&body, 1.0, 0.0, SeparatedFlow::default()).unwrap()
    }

    fn disc() -> Closure {
        let face = std::f64::consts::PI;
        let (broadside, turning) = (8.0 / 3.0, 16.0 / 45.0);
        plate(
            [0.0, broadside, 0.0, turning, 0.0, turning],
            [0.05 * face, 1.12 * face, 0.05 * face],
            [1.0, 0.02, 1.0],
        )
    }

    /// A strip of chord 2 along x and unit span, with the aspect ratio of a long one.
    fn strip() -> Closure {
        let pi = std::f64::consts::PI;
        plate(
            [0.0, pi, 0.0, 0.0, 0.0, pi / 8.0],
            [0.02 * 2.0, 1.95 * 2.0, 0.0],
            [1.0, 0.01, 1e6],
        )
    }

    /// Normal force coefficient and centre of pressure (chords from the middle) at rest in a stream.
    fn statics(closure: &Closure, area: f64, degrees: f64) -> (f64, f64) {
        let (sin, cos) = (degrees.to_radians().sin(), degrees.to_radians().cos());
        let v = [cos, -sin, 0.0];
        let (force, torque) = split(&closure.load(&join(v, [0.0; 3]), None).unwrap().force);
        // With the Munk couple that Kirchhoff's terms contribute.
        let slice = &closure.slices[0];
        let munk = scale(slice.largest, slice.incidence(v).couple);
        let normal = force[1];
        (normal / (0.5 * area), (torque[2] + munk[2]) / normal / 2.0)
    }

    #[test]
    fn normal_force_and_centre_of_pressure_follow_the_incidence() {
        // (incidence, strip CN, strip x_cp, disc CN, disc x_cp)
        let table = [
            (5.0, 0.31, 0.215, 0.20, 0.184),
            (10.0, 0.61, 0.214, 0.36, 0.195),
            (20.0, 1.18, 0.196, 0.67, 0.185),
            (30.0, 1.63, 0.172, 0.92, 0.164),
            (45.0, 2.01, 0.127, 1.13, 0.121),
            (60.0, 2.12, 0.076, 1.20, 0.072),
            (90.0, 1.95, 0.0, 1.12, 0.0),
        ];
        for (degrees, strip_cn, strip_cp, disc_cn, disc_cp) in table {
            let (cn, cp) = statics(&strip(), 2.0, degrees);
            assert!((cn - strip_cn).abs() < 0.02, "strip {degrees}: CN {cn}");
            assert!((cp - strip_cp).abs() < 0.01, "strip {degrees}: x_cp {cp}");
            let (cn, cp) = statics(&disc(), std::f64::consts::PI, degrees);
            assert!((cn - disc_cn).abs() < 0.02, "disc {degrees}: CN {cn}");
            assert!((cp - disc_cp).abs() < 0.01, "disc {degrees}: x_cp {cp}");
        }
    }

    #[test]
    fn the_attached_switch_is_kirchhoff() {
        let mut closure = disc();
        closure.constants.attached = true;
        assert!(
            closure
                .load(&[1.0, -2.0, 0.5, 3.0, 1.0, -1.0], None)
                .is_none()
        );
    }

    /// A body without any symmetry, with a centre of mass off its centroid.
    fn general() -> Closure {
        let mut closure = plate(
            [0.4, 2.0, 0.9, 0.3, 0.5, 0.2],
            [0.3, 2.2, 0.7],
            [1.5, 0.1, 0.8],
        );
        let slice = &mut closure.slices[0];
        slice.centre = [0.2, -0.1, 0.3];
        let (s, c) = (0.6, 0.8);
        let turn = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        for tensor in [
            &mut slice.directed,
            &mut slice.circulation,
            &mut slice.drag_area,
            &mut slice.extents,
            &mut slice.body_extents,
        ] {
            let transposed = crate::linalg::transpose(&turn);
            *tensor = crate::linalg::product(&crate::linalg::product(&turn, tensor), &transposed);
        }
        closure
    }

    #[test]
    fn the_closure_never_feeds_energy() {
        let closure = general();
        let stream = crate::noise::NoiseStream { seed: 3, body: 0 };
        for n in 0..2000 {
            let z = stream.normals(n);
            let xi: Vec6 = std::array::from_fn(|i| if i < 3 { z[i] } else { 4.0 * z[i] });
            let load = closure.load(&xi, None).unwrap().force;
            let (v, omega) = split(&xi);
            let at_centre = add(v, cross(omega, closure.slices[0].centre));
            let power: f64 = (0..6).map(|i| load[i] * xi[i]).sum();
            let scale = norm(at_centre).powi(3) + norm(omega).powi(3);
            assert!(power <= 1e-12 * scale, "state {n}: power {power}");
        }
    }

    #[test]
    fn the_resistances_are_a_positive_tensor_and_the_rest_does_no_work() {
        let closure = general();
        let stream = crate::noise::NoiseStream { seed: 4, body: 0 };
        for n in 0..500 {
            let z = stream.normals(n);
            let xi: Vec6 = std::array::from_fn(|i| if i < 3 { z[i] } else { 4.0 * z[i] });
            let (free, resistance) = closure.resisted_load(&xi, None).unwrap();
            let free = free.force;
            let (values, _) = eigen_symmetric(&resistance);
            assert!(values[0] >= -1e-12 * values[5], "{values:?}");
            // What is left is the rotational lift and the lost couple, of which the first does no work.
            let slice = &closure.slices[0];
            let (v, omega) = split(&xi);
            let at_centre = add(v, cross(omega, slice.centre));
            let stream = slice.stream(&closure.constants, at_centre, omega, norm(omega));
            let fed = dot(slice.loads(&stream).lost, omega);
            let power: f64 = (0..6).map(|i| free[i] * xi[i]).sum();
            let size = norm(at_centre).powi(3) + norm(omega).powi(3);
            let left = power - fed;
            assert!(
                left.abs() <= 1e-12 * size || (fed > 0.0 && left < 0.0),
                "state {n}: {left}"
            );
        }
    }

    #[test]
    fn a_spinning_sphere_bends_to_the_magnus_side() {
        let sphere = plate([0.5, 0.5, 0.5, 0.0, 0.0, 0.0], [0.45; 3], [1.0; 3]);
        // Moving along x with the spin along z: backspin lifts a ball that flies with its top
        // moving backwards, omega x v along +y.
        let (force, _) = split(
            &sphere
                .load(&[1.0, 0.0, 0.0, 0.0, 0.0, 1.0], None)
                .unwrap()
                .force,
        );
        assert!(force[1] > 0.0 && force[0] < 0.0, "{force:?}");
    }

    #[test]
    fn rest_and_pure_motions_have_no_direction_to_fail_on() {
        for closure in [disc(), strip(), general()] {
            for xi in [
                [0.0; 6],
                [0.0, 0.0, 0.0, 1.0, 2.0, 3.0],
                [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, 1e-300, 0.0, 0.0, 0.0, 1.0],
            ] {
                assert!(
                    closure
                        .load(&xi, None)
                        .unwrap()
                        .force
                        .iter()
                        .all(|f| f.is_finite()),
                    "{xi:?}"
                );
            }
        }
    }
}
