//! The loads of separated flow on one slice of a body, or on a body that is its only slice.

use super::{FULLEST, SLENDER, SeparatedFlow, negative, scaled, shifted};
use crate::body::{Body, Slice};
use crate::elementary::exp;
use crate::linalg::{
    Mat3, Mat6, Vec3, add, cross, dot, eigen_symmetric, lift, mat_vec, norm, scale, sub,
};
use crate::real::Real;
use crate::symmetry::{Block, General, Symmetry};

/// A slice with its tensors in the fluid.
#[derive(Debug, Clone)]
pub(super) struct SliceClosure<F: Symmetry = General, R: Real = f64> {
    pub(super) centre: Vec3<R>,
    /// (A11 - mu 1) / lam, mu and lam the least and largest eigenvalue of A11.
    directed: F::Block<R>,
    /// lam (kg).
    pub(super) largest: R,
    /// 2 lam / (lam - mu); zero for a body without a direction.
    turning: R,
    /// tr(A11) 1 - A11, times the rotational lift (kg).
    circulation: F::Block<R>,
    /// 8 A22 / lam (m^2): |omega|^2 times it is the squared speed of the tips of a plate.
    tips: F::Block<R>,
    damping: Damping<F, R>,
    /// p = 1/2 rho times the least drag area, and the rest P - p 1 (kg/m).
    least_drag: R,
    drag: F::Block<R>,
    /// By how much the drag rises towards high Reynolds numbers, and the speed at half of the rise (m/s).
    rise: R,
    rise_speed: R,
    /// Skin friction by the root of the speed (kg/(m s)^(1/2)).
    friction: F::Block<R>,
    /// Squared half-extents of the slice, with the body's along it, and of the body (m^2).
    extents: F::Block<R>,
    body_extents: F::Block<R>,
    /// Squared half-thickness, across the axis of lam (m^2).
    thickness2: R,
    /// Squared half-extents of the slice alone, taken from their trace (m^2).
    across: F::Block<R>,
    /// One over the second-largest half-extent L of the body (1/m).
    pub(super) per_length: R,
}

/// Resistance to rotation about the centre of a slice.
#[derive(Debug, Clone)]
struct Damping<F: Symmetry, R: Real> {
    /// c_q D (kg m^2): by |omega|.
    spinning: F::Block<R>,
    /// c_0 Dl / L (kg m): by V.
    passing: F::Block<R>,
}

impl SliceClosure {
    pub(super) fn new(
        slice: &Slice,
        body: &Body,
        density: f64,
        viscosity: f64,
        constants: &SeparatedFlow,
        friction: &Mat3,
    ) -> Self {
        let translation = scaled(density, &slice.translation);
        let ([mu, _, lam], axes) = eigen_symmetric(&translation);
        let across: Vec3 = std::array::from_fn(|i| axes[i][2]);
        let trace = |m: &Mat3| m[0][0] + m[1][1] + m[2][2];
        let spread = lam - mu;
        let per_largest = if lam > 0.0 { 1.0 / lam } else { 0.0 };
        let directed = spread > f64::NEGLIGIBLE * lam;
        let drag_area = scaled(0.5 * density, &slice.drag_area);
        let least_drag = eigen_symmetric(&drag_area).0[0].max(0.0);
        let own = own_extents(slice, body);
        Self {
            centre: slice.centre,
            directed: shifted(&translation, per_largest, -mu * per_largest),
            largest: lam,
            turning: if directed { 2.0 * lam / spread } else { 0.0 },
            circulation: scaled(
                constants.rotational_lift,
                &shifted(&translation, -1.0, trace(&translation)),
            ),
            tips: scaled(8.0 * density * per_largest, &slice.rotation),
            damping: Damping::new(slice, body, &own, density, constants),
            least_drag,
            drag: shifted(&drag_area, 1.0, -least_drag),
            rise: round_rise(body),
            rise_speed: RISE_REYNOLDS * viscosity / (2.0 * body.half_extents[1]),
            friction: *friction,
            extents: slice.extents,
            body_extents: body.separation.extents,
            thickness2: dot(across, mat_vec(&slice.extents, across)),
            across: shifted(&own, -1.0, trace(&own)),
            per_length: 1.0 / body.half_extents[1],
        }
    }

    pub(super) fn lift<G: Symmetry, R: Real>(&self, like: R) -> SliceClosure<G, R> {
        let block = |m: &Mat3| G::block(like, m);
        SliceClosure {
            centre: lift(like, &self.centre),
            directed: block(&self.directed),
            largest: like.of(self.largest),
            turning: like.of(self.turning),
            circulation: block(&self.circulation),
            tips: block(&self.tips),
            damping: Damping {
                spinning: block(&self.damping.spinning),
                passing: block(&self.damping.passing),
            },
            least_drag: like.of(self.least_drag),
            drag: block(&self.drag),
            rise: like.of(self.rise),
            rise_speed: like.of(self.rise_speed),
            friction: block(&self.friction),
            extents: block(&self.extents),
            body_extents: block(&self.body_extents),
            thickness2: like.of(self.thickness2),
            across: block(&self.across),
            per_length: like.of(self.per_length),
        }
    }
}

/// Rise of the drag of a round body from Reynolds numbers of some thousands to 1e5, and where half of it is done: the
/// shear layers that leave it become turbulent ever closer to it, and the suction at its base grows (spheres, Clift,
/// Grace & Weber 1978; cylinders, Norberg 1994). Edges see none of it. A body is as round as its drag coefficient,
/// broadside, is below 1.
const ROUND_RISE: f64 = 0.4;
const RISE_REYNOLDS: f64 = 3e4;

fn round_rise(body: &Body) -> f64 {
    let [_, chord, span] = body.half_extents;
    let broadside = eigen_symmetric(&body.separation.drag_area).0[2];
    let coefficient = broadside / (std::f64::consts::PI * chord * span);
    ROUND_RISE * (1.0 - coefficient).max(0.0)
}

/// Skin friction of each slice: that of a laminar boundary layer over the surface along which the fluid flows,
/// C_f = 1.328 Re^(-1/2) on the chord (Blasius 1908), each panel by its share along the motion.
///
/// By the root of the speed (kg/(m s)^(1/2)).
pub(super) fn skin_friction(body: &Body, density: f64, viscosity: f64) -> Mat3 {
    let mut along = [[0.0; 3]; 3];
    for corners in &body.surface.triangles {
        let [a, b, c] = corners.map(|v| body.surface.vertices[v as usize]);
        let normal = scale(0.5, cross(sub(b, a), sub(c, a)));
        let area = norm(normal);
        if area == 0.0 {
            continue;
        }
        for i in 0..3 {
            for j in 0..3 {
                let kept = if i == j { area } else { 0.0 };
                along[i][j] += kept - normal[i] * normal[j] / area;
            }
        }
    }
    let slices = body.slices.len().max(1) as f64;
    let chord = 2.0 * body.half_extents[1];
    let factor = 0.5 * density * 1.328 * (viscosity / chord).sqrt() / slices;
    scaled(factor, &along)
}

/// Squared half-extents of a slice with its own length along the body (m^2).
fn own_extents(slice: &Slice, body: &Body) -> Mat3 {
    let count = body.slices.len().max(1) as f64;
    let (_, axes) = eigen_symmetric(&body.separation.extents);
    let along: Vec3 = std::array::from_fn(|i| axes[i][2]);
    let excess = (1.0 - 1.0 / (count * count)) * dot(along, mat_vec(&slice.extents, along));
    std::array::from_fn(|i| {
        std::array::from_fn(|j| slice.extents[i][j] - excess * along[i] * along[j])
    })
}

impl Damping<General, f64> {
    fn new(
        slice: &Slice,
        body: &Body,
        own: &Mat3,
        density: f64,
        constants: &SeparatedFlow,
    ) -> Self {
        let (rotation, axes) = eigen_symmetric(&slice.rotation);
        let axis = |i: usize| -> Vec3 { std::array::from_fn(|k| axes[k][i % 3]) };
        let along = |m: &Mat3, i: usize| dot(axis(i), mat_vec(m, axis(i)));
        let mut diagonals = [[0.0; 3]; 2];
        for i in 0..3 {
            let larger = |m: &Mat3| along(m, i + 1).max(along(m, i + 2));
            let smaller = |m: &Mat3| along(m, i + 1).min(along(m, i + 2));
            let chord2 = larger(own);
            let plate = larger(&slice.translation) * chord2 / 8.0;
            let d = density * (rotation[i].max(0.0) * plate.max(0.0)).sqrt();
            let roundness = (smaller(own).max(0.0) / chord2).sqrt();
            let span = along(&body.separation.extents, i).sqrt();
            let ceiling = (span + SLENDER * chord2.sqrt()) / (span + chord2.sqrt());
            let edge = 1.0 - roundness;
            let passing =
                constants.damping * (1.0 - ceiling * edge * edge * edge) * d / body.half_extents[1];
            diagonals[0][i] = constants.rotational_damping * d;
            diagonals[1][i] = passing;
        }
        let tensor = |d: Vec3| -> Mat3 {
            std::array::from_fn(|k| {
                std::array::from_fn(|l| (0..3).map(|i| d[i] * axis(i)[k] * axis(i)[l]).sum())
            })
        };
        let [spinning, passing] = diagonals.map(tensor);
        Self { spinning, passing }
    }
}

/// What a slice sees of the fluid.
pub(super) struct Stream<R: Real> {
    /// Velocity relative to the fluid at its centre (m/s), and angular velocity relative to it (rad/s).
    v: Vec3<R>,
    omega: Vec3<R>,
    speed: R,
    /// The root of the speed, and |omega|.
    root: R,
    spin: R,
    direction: Vec3<R>,
    incidence: Incidence<R>,
    pub(super) attachment: R,
    /// Factor by which a turning body loses the relief round its ends.
    relief: R,
    /// Factor by which the drag of a round body has risen with the Reynolds number.
    risen: R,
}

/// Loads of a slice, at and about its centre.
pub(super) struct SliceLoads<R> {
    /// Rotational lift (N).
    pub(super) lift: Vec3<R>,
    /// Pressure drag and normal force, reversed (N).
    pub(super) drag: Vec3<R>,
    pub(super) normal: Vec3<R>,
    /// Rotational damping (N m).
    pub(super) damping: Vec3<R>,
    /// The part of the couple that separation takes away (N m).
    pub(super) lost: Vec3<R>,
}

impl<F: Symmetry, R: Real> SliceClosure<F, R> {
    /// What a slice sees, from the velocity relative to the fluid at its centre; `spin` is |omega|.
    #[inline(always)]
    pub(super) fn stream(
        &self,
        c: &SeparatedFlow,
        v: Vec3<R>,
        omega: Vec3<R>,
        spin: R,
    ) -> Stream<R> {
        let (zero, one) = (spin.of(0.0), spin.of(1.0));
        let speed2 = dot(v, v);
        let speed = speed2.sqrt();
        let per_speed = R::choose(zero.less(speed), one / speed, zero);
        let direction = scale(per_speed, v);
        let incidence = self.incidence(c, direction);
        let attachment = self.attachment(c, &incidence, dot(omega, incidence.couple) * per_speed);
        Stream {
            v,
            omega,
            speed,
            root: speed.sqrt(),
            spin,
            direction,
            attachment,
            relief: self.relief(c, omega, speed2),
            risen: one + self.rise / (one + self.rise_speed * per_speed),
            incidence,
        }
    }

    #[inline(always)]
    pub(super) fn loads(&self, stream: &Stream<R>) -> SliceLoads<R> {
        let (attachment, relief) = (stream.attachment, stream.relief);
        let incidence = &stream.incidence;
        let couple = self.largest * (stream.speed * stream.speed);
        let lift = cross(self.circulation.times(stream.omega), stream.v);
        SliceLoads {
            lift: scale(relief * attachment, lift),
            drag: self.drag(stream),
            normal: scale(attachment * couple * incidence.leverage, incidence.pull),
            damping: negative(self.damping.torque(stream)),
            lost: scale((attachment - attachment.of(1.0)) * couple, incidence.couple),
        }
    }

    /// What resists in `loads`, as a tensor about the centre of mass.
    #[inline(always)]
    pub(super) fn resistance(&self, stream: &Stream<R>) -> Mat6<R> {
        let (attachment, speed) = (stream.attachment, stream.speed);
        let normal = attachment * self.largest * speed * stream.incidence.leverage;
        let (least, drag) = self.drag_factors(stream);

        let (directed, areas) = (self.directed.matrix(), self.drag.matrix());
        let friction = self.friction.matrix();
        let (mut translation, rotation) = (areas, self.damping.tensor(stream));
        for i in 0..3 {
            for j in 0..3 {
                translation[i][j] =
                    normal * directed[i][j] + drag * areas[i][j] + stream.root * friction[i][j];
            }
            translation[i][i] = translation[i][i] + least;
        }
        super::about_centre_of_mass(self.centre, &translation, &rotation)
    }

    /// The relief round the ends needs a steady wake: a body whose tips are as fast as its centre has lost it, and has
    /// the drag and the lift of a strip.
    #[inline(always)]
    fn relief(&self, c: &SeparatedFlow, omega: Vec3<R>, speed2: R) -> R {
        let (zero, one) = (speed2.of(0.0), speed2.of(1.0));
        let tips = dot(omega, self.tips.times(omega));
        let span = dot(omega, self.body_extents.times(omega)).max(zero).sqrt();
        let chord = dot(omega, self.across.times(omega)).max(zero).sqrt();
        let gain = one.of(1.0 - SLENDER) * chord;
        let steady = span + one.of(SLENDER) * chord;
        let whole = steady * (tips + one.of(c.relief_speed * c.relief_speed) * speed2);
        let turns = zero.less(whole);
        R::choose(turns, one + gain * tips / whole, one)
    }

    /// Direction and size of the potential couple, and the chord and span that belong to it, from the
    /// direction of motion.
    #[inline(always)]
    pub(super) fn incidence(&self, c: &SeparatedFlow, direction: Vec3<R>) -> Incidence<R> {
        let pull = self.directed.times(direction);
        let couple = cross(pull, direction);
        let (couple2, pull2) = (dot(couple, couple), dot(pull, pull));
        let (zero, one) = (pull2.of(0.0), pull2.of(1.0));
        let negligible = pull2.of(R::NEGLIGIBLE * R::NEGLIGIBLE);
        let turns = negligible.less(couple2);

        // Chord times |couple| |pull|, span times |couple|, thickness times |pull|.
        let chord = cross(couple, pull);
        let half_chord = dot(chord, self.extents.times(chord)).sqrt();
        let half_span = (dot(couple, self.body_extents.times(couple)) * pull2).sqrt();
        let thick2 = dot(pull, self.extents.times(pull)) * couple2;
        let edgewise = zero.less(self.turning) & !negligible.less(pull2);
        // One division for the quotients couple2 / half_chord, couple2 / pull2 and half_chord / (|couple| |pull|).
        let lengths = (couple2 * pull2).sqrt();
        let quotient = R::choose(turns, one / (half_chord * pull2 * lengths), zero);
        let by_lengths = lengths * quotient;
        // Edgewise there is no couple to tell the normal by.
        let chord2 = dot(direction, self.extents.times(direction));
        let roundness = R::choose(turns, thick2, self.thickness2)
            / R::choose(turns, half_chord * half_chord, chord2);
        Incidence {
            couple,
            pull,
            leverage: one.of(0.5 / c.normal_force_arm) * couple2 * pull2 * by_lengths,
            cos2: R::choose(
                turns,
                couple2 * half_chord * by_lengths,
                R::choose(edgewise, one, zero),
            ),
            turning: self.turning * (half_chord * half_chord) * pull2 * quotient,
            half_chord,
            half_span,
            roundness: R::choose(turns | edgewise, roundness.min(one), one),
            turns,
        }
    }

    /// The fraction of the potential couple that survives; `turn` is omega . couple / |v|.
    #[inline(always)]
    fn attachment(&self, c: &SeparatedFlow, incidence: &Incidence<R>, turn: R) -> R {
        let one = turn.of(1.0);
        // A round nose separates as a broadside does, and has no leading-edge vortex.
        let flat = one - incidence.roundness;
        let broadside = turn.of(c.broadside_attachment);
        let edgewise = turn.of(c.attachment - c.broadside_attachment) * incidence.cos2;
        let still = broadside + edgewise * (flat * flat);
        let edge = one - incidence.roundness.sqrt();
        // The ceiling is b / a, the fraction of it without lag g / b.
        let a = incidence.half_span + incidence.half_chord;
        let b = incidence.half_span + turn.of(SLENDER) * incidence.half_chord;
        let g = (still * a).min(turn.of(FULLEST) * b);
        // Reduced rate of growing incidence: omega l sin(2 alpha) / V for a plate.
        let rate = incidence.turning * turn * (edge * edge * edge);
        let lag = exp(turn.of(-2.0 * c.dynamic_stall) * rate);
        let lagged = b * g / (a * (g + (b - g) * lag));
        R::choose(incidence.turns, lagged, still)
    }

    /// Pressure drag, reversed: the least along the motion, what is more along the normal.
    #[inline(always)]
    fn drag(&self, stream: &Stream<R>) -> Vec3<R> {
        let (least, rest) = self.drag_factors(stream);
        let pressure = add(
            scale(least, stream.v),
            scale(rest, self.drag.times(stream.v)),
        );
        let friction = scale(stream.root, self.friction.times(stream.v));
        add(pressure, friction)
    }

    /// What multiplies the velocity, and the velocity times P - p 1.
    #[inline(always)]
    fn drag_factors(&self, stream: &Stream<R>) -> (R, R) {
        let along = self.drag.times(stream.direction);
        let size = norm(along);
        let zero = size.of(0.0);
        let dynamic = stream.relief * stream.risen * stream.speed;
        let rest = dynamic * dot(stream.direction, along) / size;
        (
            dynamic * self.least_drag,
            R::choose(zero.less(size), rest, zero),
        )
    }
}

impl<F: Symmetry, R: Real> Damping<F, R> {
    #[inline(always)]
    fn torque(&self, stream: &Stream<R>) -> Vec3<R> {
        let omega = stream.omega;
        add(
            scale(stream.relief * stream.spin, self.spinning.times(omega)),
            scale(stream.speed, self.passing.times(omega)),
        )
    }

    #[inline(always)]
    fn tensor(&self, stream: &Stream<R>) -> Mat3<R> {
        let mut sum = self.spinning.matrix();
        let passing = self.passing.matrix();
        let spun = stream.relief * stream.spin;
        for i in 0..3 {
            for j in 0..3 {
                sum[i][j] = spun * sum[i][j] + stream.speed * passing[i][j];
            }
        }
        sum
    }
}

/// The body's attitude to the stream, for unit speed; no leverage where there is no couple.
pub(super) struct Incidence<R: Real> {
    /// tau / lam = -v x A11 v / lam.
    pub(super) couple: Vec3<R>,
    /// (A11 - mu 1) v / lam, along the normal force.
    pub(super) pull: Vec3<R>,
    /// The normal force per attachment and `pull`: that of the couple at its place on the chord.
    pub(super) leverage: R,
    /// Squared cosine of the incidence: 1 edgewise, 0 broadside.
    pub(super) cos2: R,
    /// From omega . couple to the reduced rate of growing incidence (m).
    turning: R,
    /// Half chord and half span, in the same unit.
    pub(super) half_chord: R,
    pub(super) half_span: R,
    /// Square of thickness over chord, 1 at most.
    roundness: R,
    /// Whether there is a couple.
    turns: R::Mask,
}

#[cfg(test)]
impl SliceClosure {
    /// Turns all its tensors by the rotation matrix `turn`.
    pub(super) fn turn(&mut self, turn: &Mat3) {
        use crate::linalg::{product, transpose};
        for tensor in [
            &mut self.directed,
            &mut self.circulation,
            &mut self.tips,
            &mut self.damping.spinning,
            &mut self.damping.passing,
            &mut self.drag,
            &mut self.extents,
            &mut self.body_extents,
            &mut self.across,
        ] {
            *tensor = product(&product(turn, tensor), &transpose(turn));
        }
    }
}
