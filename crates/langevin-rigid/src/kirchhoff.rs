//! Kirchhoff's equations: a body in ideal fluid under its weight and buoyancy.
//!
//! With T the total tensor and (p, l) = T (v, omega) the momenta in the body frame,
//!
//! ```text
//! p' = p x omega + F,    l' = l x omega + p x v + Gamma
//! ```
//!
//! which is Eq. (4) in full 6x6 form, its first line read as omega x (M v). In the world frame the
//! same equations say that the linear impulse R p and the angular impulse R l + x x R p change by the
//! loads alone. [`Kirchhoff::step`] integrates those impulses, so they stay exact to rounding where
//! nothing acts.

use crate::ambient::Ambient;
use crate::body::Body;
use crate::fluid::Fluid;
use crate::input::Forcing;
use crate::linalg::{
    Mat3, Mat6, Quat, Vec3, Vec6, add, add_scaled, cross, dot, dot6, each, eigen_symmetric,
    invert_spd, join, lift, mat_vec, matrix_of, mul, norm, quat_mul, quat_normalize, scale,
    solve_spd, split, sub, transposed_mat_vec, turn,
};
use crate::real::Real;
use crate::symmetry::{General, Symmetry, Tensor};

/// Pose, and velocity relative to the fluid in the body frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion<R = f64> {
    pub(crate) position: Vec3<R>,
    pub(crate) orientation: Quat<R>,
    /// (v - R^T u, omega), body frame.
    pub(crate) xi: Vec6<R>,
    /// See [`State::fluctuation`](crate::State::fluctuation).
    pub(crate) fluctuation: Vec6<R>,
}

/// The total tensor and the static loads of a body in a fluid.
#[derive(Debug, Clone)]
pub(crate) struct Kirchhoff<F: Symmetry = General, R: Real = f64> {
    /// T = diag(m, J0) + A.
    pub(crate) total: F::Tensor<R>,
    pub(crate) inverse: F::Tensor<R>,
    /// Gravity less buoyancy, world frame (N), Eq. (5).
    pub(crate) weight: Vec3<R>,
    /// Buoyancy, world frame (N), acting at `centre_of_buoyancy`.
    pub(crate) buoyancy: Vec3<R>,
    pub(crate) centre_of_buoyancy: Vec3<R>,
    /// Mass of the displaced fluid, and that of the body less it (kg).
    pub(crate) displaced: R,
    pub(crate) net_mass: R,
    /// Largest eigenvalues of the linear (1/kg) and the angular (1/(kg m^2)) block of T^-1.
    mobility: R,
    rotational_mobility: R,
    /// Bound on how fast weight and buoyancy change the root of twice the energy (kg^(1/2) m/s^2).
    push: R,
}

/// What acts on a body whatever its motion, over one step. World frame; the velocity of the fluid is in none of
/// it, as the equations are in the frame that moves with the fluid.
#[derive(Clone, Copy)]
pub(crate) struct Statics<R = f64> {
    /// Gravity less buoyancy, with the fluid's acceleration taken off gravity, and the force from outside (N).
    weight: Vec3<R>,
    /// Buoyancy (N), with the same gravity.
    buoyancy: Vec3<R>,
    /// Torque from outside (N m).
    torque: Option<Vec3<R>>,
    /// Gradient and fluctuation of the fluid's velocity.
    pub(crate) ambient: Ambient<R>,
    /// Bound on how fast all this changes the root of twice the energy (kg^(1/2) m/s^2).
    push: R,
}

/// A load that depends on the motion, and the power with which the gradient of the fluid's velocity feeds the body
/// through it (W).
#[derive(Clone, Copy)]
pub(crate) struct Load<R = f64> {
    pub(crate) force: Vec6<R>,
    pub(crate) fed: R,
}

/// What changes over one step, in the body frame of its start: rotation vector and displacement since
/// then, the linear impulse, the angular impulse about the place where the centre of mass was, and the work of the
/// torque from outside and of the fluid's own rotation and strain.
#[derive(Clone, Copy)]
struct Increment<R> {
    theta: Vec3<R>,
    displacement: Vec3<R>,
    linear: Vec3<R>,
    angular: Vec3<R>,
    work: R,
}

impl<R: Real> Increment<R> {
    /// From the momenta at the start, after `h` at `rate`.
    #[inline(always)]
    fn new(momentum: &Vec6<R>, h: R, rate: &Self) -> Self {
        let (linear, angular) = split(momentum);
        Self {
            theta: scale(h, rate.theta),
            displacement: scale(h, rate.displacement),
            linear: add_scaled(linear, h, rate.linear),
            angular: add_scaled(angular, h, rate.angular),
            work: h * rate.work,
        }
    }

    #[inline(always)]
    fn plus(self, h: R, rate: &Self) -> Self {
        Self {
            theta: add_scaled(self.theta, h, rate.theta),
            displacement: add_scaled(self.displacement, h, rate.displacement),
            linear: add_scaled(self.linear, h, rate.linear),
            angular: add_scaled(self.angular, h, rate.angular),
            work: self.work + h * rate.work,
        }
    }
}

impl Kirchhoff {
    /// `None` if the total tensor is not positive definite.
    pub(crate) fn new(body: &Body, fluid: &Fluid, gravity: Vec3) -> Option<Self> {
        let total = body.total_mass(fluid.density);
        let inverse = invert_spd(&total)?;
        let displaced = fluid.density * body.volume;
        let weight = scale(body.mass - displaced, gravity);
        let buoyancy = scale(-displaced, gravity);
        let mobility = |first: usize| -> f64 {
            let block: Mat3 =
                std::array::from_fn(|i| std::array::from_fn(|j| inverse[first + i][first + j]));
            eigen_symmetric(&block).0[2]
        };
        let torque = norm(buoyancy) * norm(body.centre_of_buoyancy);
        let (linear, angular) = (mobility(0), mobility(3));
        Some(Self {
            total,
            inverse,
            weight,
            buoyancy,
            centre_of_buoyancy: body.centre_of_buoyancy,
            displaced,
            net_mass: body.mass - displaced,
            mobility: linear,
            rotational_mobility: angular,
            push: norm(weight) * linear.sqrt() + torque * angular.sqrt(),
        })
    }

    /// The same for a body of shape `G` in the lanes of `like`.
    pub(crate) fn lift<G: Symmetry, R: Real>(&self, like: R) -> Kirchhoff<G, R> {
        Kirchhoff {
            total: G::tensor(like, &self.total),
            inverse: G::tensor(like, &self.inverse),
            weight: lift(like, &self.weight),
            buoyancy: lift(like, &self.buoyancy),
            centre_of_buoyancy: lift(like, &self.centre_of_buoyancy),
            displaced: like.of(self.displaced),
            net_mass: like.of(self.net_mass),
            mobility: like.of(self.mobility),
            rotational_mobility: like.of(self.rotational_mobility),
            push: like.of(self.push),
        }
    }

    /// Largest acceleration by weight (m/s^2).
    pub(crate) fn gain(&self) -> f64 {
        norm(self.weight) * self.mobility
    }

    /// Kinetic energy of body and fluid, 1/2 xi . T xi (J), in the frame of the undisturbed fluid.
    pub(crate) fn energy(&self, xi: &Vec6) -> f64 {
        0.5 * dot6(xi, &mul(&self.total, xi))
    }
}

impl<F: Symmetry, R: Real> Kirchhoff<F, R> {
    /// What acts whatever the motion, under `forcing`.
    ///
    /// In the frame that accelerates with the fluid by a, gravity is g - a: the body is pushed by its displaced mass
    /// times a as by a buoyancy, and falls behind by its own mass. Added to the momentum T a that the frame itself
    /// gains this is the force (rho V + A) a.
    #[inline(always)]
    pub(crate) fn statics(&self, forcing: Option<&Forcing<R>>) -> Statics<R> {
        let Some(forcing) = forcing else {
            return Statics {
                weight: self.weight,
                buoyancy: self.buoyancy,
                torque: None,
                ambient: Ambient {
                    gradient: None,
                    fluctuation: None,
                },
                push: self.push,
            };
        };
        let acceleration = norm(forcing.acceleration);
        let (force, torque) = (norm(forcing.force), norm(forcing.torque));
        let arm = norm(self.centre_of_buoyancy);
        let pushed = force + self.net_mass.abs() * acceleration;
        let turned = torque + self.displaced * acceleration * arm;
        Statics {
            weight: add(
                add_scaled(self.weight, -self.net_mass, forcing.acceleration),
                forcing.force,
            ),
            buoyancy: add_scaled(self.buoyancy, self.displaced, forcing.acceleration),
            torque: Some(forcing.torque),
            ambient: Ambient {
                gradient: forcing.gradient,
                fluctuation: None,
            },
            push: self.push
                + pushed * self.mobility.sqrt()
                + turned * self.rotational_mobility.sqrt(),
        }
    }

    /// What the forcing adds to speed (m/s) and spin (rad/s) in a second, at most.
    #[inline(always)]
    pub(crate) fn gains(&self, forcing: &Forcing<R>) -> (R, R) {
        let acceleration = norm(forcing.acceleration);
        let arm = norm(self.centre_of_buoyancy);
        let force = norm(forcing.force) + self.net_mass.abs() * acceleration;
        let torque = norm(forcing.torque) + self.displaced * acceleration * arm;
        (force * self.mobility, torque * self.rotational_mobility)
    }

    /// Generalized force of `statics` in the body frame, which `into_body` turns vectors into: gravity, buoyancy and its torque, Eqs. (5) and (6), and
    /// what acts from outside.
    ///
    /// The torque is r x R^T (-rho_f V g): a body whose centre of buoyancy lies above its centre of
    /// mass is stable. Eq. (6) is printed with the opposite sign.
    #[inline(always)]
    pub(crate) fn static_load(
        &self,
        statics: &Statics<R>,
        into_body: impl Fn(Vec3<R>) -> Vec3<R>,
    ) -> Vec6<R> {
        let mut torque = cross(self.centre_of_buoyancy, into_body(statics.buoyancy));
        if let Some(outside) = statics.torque {
            torque = add(torque, into_body(outside));
        }
        join(into_body(statics.weight), torque)
    }

    /// The rate of the momenta (p, l) in the body frame from Kirchhoff's terms alone.
    #[inline(always)]
    pub(crate) fn momentum_rate(&self, xi: &Vec6<R>) -> Vec6<R> {
        let (v, omega) = split(xi);
        let (p, l) = split(&self.total.times(xi));
        join(cross(p, omega), add(cross(l, omega), cross(p, v)))
    }

    /// One step whose resistances may be as stiff as they like: they are taken implicitly, with the
    /// coefficients that they have in the middle of the step, the rest by the midpoint rule.
    ///
    /// `load` gives the further force as in [`Kirchhoff::step`], less the resistances -D xi, and D, a
    /// symmetric positive tensor. Where resistances alone hold the weight the velocity is exact.
    #[inline(always)]
    pub(crate) fn step_resisted(
        &self,
        motion: &mut Motion<R>,
        h: R,
        statics: &Statics<R>,
        load: impl Fn(&Vec6<R>, &Ambient<R>) -> Option<(Load<R>, Mat6<R>)>,
    ) {
        let start = *motion;
        let (momentum, total) = (self.total.times(&start.xi), self.total.matrix());
        // The velocity after `h` with the loads and resistances of `from`, and the power that these feed.
        let implicit = |h: R, from: &Motion<R>| -> (Vec6<R>, R) {
            let mut rate = self.momentum_rate(&from.xi);
            let matrix = matrix_of(from.orientation);
            let still = self.static_load(
                statics,
                #[inline(always)]
                |a| transposed_mat_vec(&matrix, a),
            );
            let (mut system, mut fed) = (total, h.of(0.0));
            for i in 0..6 {
                rate[i] = momentum[i] + h * (rate[i] + still[i]);
            }
            if let Some(torque) = statics.torque {
                fed = dot(transposed_mat_vec(&matrix, torque), split(&from.xi).1);
            }
            let ambient = statics.ambient.seen_from(&matrix);
            if let Some((moving, resisted)) = load(&from.xi, &ambient) {
                fed = fed + moving.fed;
                for i in 0..6 {
                    rate[i] = rate[i] + h * moving.force[i];
                    for j in 0..6 {
                        system[i][j] = system[i][j] + h * resisted[i][j];
                    }
                }
            }
            (solve_spd(&system, &rate), fed)
        };
        let half = h * h.of(0.5);
        let mut middle = start;
        (middle.xi, _) = implicit(half, &start);
        let (v, omega) = split(&middle.xi);
        middle.orientation = turned(start.orientation, half, omega);
        let fed;
        (motion.xi, fed) = implicit(h, &middle);
        motion.orientation = turned(start.orientation, h, omega);
        let displacement = mat_vec(&matrix_of(middle.orientation), v);
        motion.position = add_scaled(start.position, h, displacement);
        let after = self.total.times(&motion.xi);
        let share = self.passive(&start, &momentum, motion, &after, h, statics, h * fed);
        motion.xi = each(
            h,
            #[inline(always)]
            |i| share * motion.xi[i],
        );
    }

    /// The share of the momenta `after` a step of `h` from the momenta `before` with which the body has no
    /// more energy than it had and `statics` gave it. Loads never feed the body beyond the work `fed` of a torque from outside and of fluid that turns, and a step
    /// that is too long must not do so for them. `end` is the motion after the step; where it went further than any
    /// body with that energy can, it goes as far as it can.
    #[expect(clippy::too_many_arguments, reason = "a step, from both ends")]
    #[inline(always)]
    fn passive(
        &self,
        start: &Motion<R>,
        before: &Vec6<R>,
        end: &mut Motion<R>,
        after: &Vec6<R>,
        h: R,
        statics: &Statics<R>,
        fed: R,
    ) -> R {
        let (zero, one) = (h.of(0.0), h.of(1.0));
        // Twice the energies.
        let had = dot6(before, &self.inverse.times(before));
        let has = dot6(after, &self.inverse.times(after));
        let given = (fed + fed).max(zero);
        let mut carried = had.max(zero);
        // Turbulence takes a body along, no faster than itself; what it feeds a faster one, drag has taken.
        if statics.ambient.fluctuation.is_some() {
            let ambient = statics.ambient.seen_from(&matrix_of(start.orientation));
            if let Some(turbulence) = &ambient.fluctuation {
                carried = carried.max(dot6(turbulence, &self.total.times(turbulence)));
            }
        }
        let most = (carried + given).sqrt() + statics.push * h;
        let furthest = most * h * self.mobility.sqrt();
        let displacement = sub(end.position, start.position);
        let distance = norm(displacement);
        let too_far = furthest.less(distance);
        let share = R::choose(too_far, furthest / distance, one);
        for i in 0..3 {
            let reached = start.position[i] + share * displacement[i];
            end.position[i] = R::choose(too_far, reached, end.position[i]);
        }

        let (mut lifted, mut work) = (share * dot(statics.weight, displacement), fed);
        if !F::CENTRED {
            let arm = |orientation| mat_vec(&matrix_of(orientation), self.centre_of_buoyancy);
            let moved = sub(arm(end.orientation), arm(start.orientation));
            work = work + dot(statics.buoyancy, moved);
        }
        let half = h.of(0.5);
        // No body climbs higher than its energy takes it.
        let too_high = lifted.less(zero) & (half * carried + (lifted + work)).less(zero);
        if R::any(too_high) {
            let share = ((half * carried + work) / -lifted).max(zero);
            for i in 0..3 {
                let reached = start.position[i] + share * (end.position[i] - start.position[i]);
                end.position[i] = R::choose(too_high, reached, end.position[i]);
            }
            lifted = R::choose(too_high, share * lifted, lifted);
        }
        let work = lifted + work;
        let allowed = (carried + (work + work)).max(zero).min(most * most);
        // Rounding, and what a sound step errs by.
        let tolerated = allowed + h.of(1e-6) * (had + most * most * h.of(1e-3));
        let gained = tolerated.less(has);
        R::choose(gained, (tolerated / has).sqrt(), one)
    }

    /// One step by the fourth-order Runge-Kutta-Munthe-Kaas scheme on the rotation group.
    ///
    /// `load` is a further generalized force about the centre of mass, body frame, from the velocity
    /// relative to the fluid and the gradient of the fluid's velocity, body frame, if there is one.
    #[inline(always)]
    pub(crate) fn step(
        &self,
        motion: &mut Motion<R>,
        h: R,
        statics: &Statics<R>,
        load: impl Fn(&Vec6<R>, &Ambient<R>) -> Option<Load<R>>,
    ) {
        let momentum = self.total.times(&motion.xi);
        let momentum = self.step_momentum(motion, &momentum, h, statics, load);
        motion.xi = self.velocity(&momentum);
    }

    /// T^-1 of the momenta, corrected once: the rounding of the inverse is the same in every step, so
    /// that its errors would add up.
    #[inline(always)]
    fn velocity(&self, momentum: &Vec6<R>) -> Vec6<R> {
        let xi = self.inverse.times(momentum);
        let carried = self.total.times(&xi);
        let rest = each(
            xi[0],
            #[inline(always)]
            |i| momentum[i] - carried[i],
        );
        let correction = self.inverse.times(&rest);
        each(
            xi[0],
            #[inline(always)]
            |i| xi[i] + correction[i],
        )
    }

    /// The same from the momenta (p, l) at the start to those at the end, which it returns; of the
    /// motion only the pose is moved.
    #[inline(always)]
    pub(crate) fn step_momentum(
        &self,
        motion: &mut Motion<R>,
        momentum: &Vec6<R>,
        h: R,
        statics: &Statics<R>,
        load: impl Fn(&Vec6<R>, &Ambient<R>) -> Option<Load<R>>,
    ) -> Vec6<R> {
        let start = matrix_of(motion.orientation);
        let loads = statics.seen_from(&start);
        let (half, third, sixth) = (h * h.of(0.5), h * h.of(1.0 / 3.0), h * h.of(1.0 / 6.0));
        let mut rate = self.first_rate(&motion.xi, &loads, &load);
        let mut end = Increment::new(momentum, sixth, &rate);
        // A loop, for a load that is compiled once and not three times.
        for (ahead, share) in [(half, third), (half, third), (h, sixth)] {
            rate = self.rate(&Increment::new(momentum, ahead, &rate), &loads, &load);
            end = end.plus(share, &rate);
        }

        let turned = turn(end.theta);
        let before = *motion;
        motion.orientation = quat_normalize(quat_mul(motion.orientation, turned));
        motion.position = add(motion.position, mat_vec(&start, end.displacement));
        let after = momentum_after(&matrix_of(turned), &end);
        let share = self.passive(&before, momentum, motion, &after, h, statics, end.work);
        each(
            h,
            #[inline(always)]
            |i| share * after[i],
        )
    }

    /// The rate at the start of a step, where nothing has turned yet.
    #[inline(always)]
    fn first_rate(
        &self,
        xi: &Vec6<R>,
        statics: &Statics<R>,
        load: &impl Fn(&Vec6<R>, &Ambient<R>) -> Option<Load<R>>,
    ) -> Increment<R> {
        let (v, omega) = split(xi);
        let mut linear = statics.weight;
        let mut angular = [omega[0].of(0.0); 3];
        let mut work = omega[0].of(0.0);
        if !F::CENTRED {
            angular = cross(self.centre_of_buoyancy, statics.buoyancy);
        }
        if let Some(torque) = statics.torque {
            angular = add(angular, torque);
            work = dot(torque, omega);
        }
        if let Some(load) = load(xi, &statics.ambient) {
            let (force, couple) = split(&load.force);
            linear = add(linear, force);
            angular = add(angular, couple);
            if statics.ambient.gradient.is_some() {
                work = work + load.fed;
            }
        }
        Increment {
            theta: omega,
            displacement: v,
            linear,
            angular,
            work,
        }
    }

    /// The rate within a step, where the body is at `y`.
    #[inline(always)]
    fn rate(
        &self,
        y: &Increment<R>,
        statics: &Statics<R>,
        load: &impl Fn(&Vec6<R>, &Ambient<R>) -> Option<Load<R>>,
    ) -> Increment<R> {
        y.work.apart(
            #[inline(always)]
            || self.rate_inlined(y, statics, load),
        )
    }

    #[inline(always)]
    fn rate_inlined(
        &self,
        y: &Increment<R>,
        statics: &Statics<R>,
        load: &impl Fn(&Vec6<R>, &Ambient<R>) -> Option<Load<R>>,
    ) -> Increment<R> {
        let turned = matrix_of(turn(y.theta));
        let xi = self.inverse.times(&momentum_after(&turned, y));
        let (v, omega) = split(&xi);
        let mut linear = statics.weight;
        let mut angular = cross(y.displacement, linear);
        let mut work = y.work.of(0.0);
        if !F::CENTRED {
            let arm = mat_vec(&turned, self.centre_of_buoyancy);
            angular = add(angular, cross(arm, statics.buoyancy));
        }
        if let Some(torque) = statics.torque {
            angular = add(angular, torque);
            work = dot(torque, mat_vec(&turned, omega));
        }
        let ambient = statics.ambient.seen_from(&turned);
        if let Some(load) = load(&xi, &ambient) {
            let (force, couple) = split(&load.force);
            let force = mat_vec(&turned, force);
            linear = add(linear, force);
            let couple = add(mat_vec(&turned, couple), cross(y.displacement, force));
            angular = add(angular, couple);
            if statics.ambient.gradient.is_some() {
                work = work + load.fed;
            }
        }
        Increment {
            theta: rotation_vector_rate(y.theta, omega),
            displacement: mat_vec(&turned, v),
            linear,
            angular,
            work,
        }
    }
}

impl<R: Real> Statics<R> {
    /// The same in the frame whose axes are the columns of `matrix`.
    #[inline(always)]
    fn seen_from(&self, matrix: &Mat3<R>) -> Self {
        Self {
            weight: transposed_mat_vec(matrix, self.weight),
            buoyancy: transposed_mat_vec(matrix, self.buoyancy),
            torque: self.torque.map(
                #[inline(always)]
                |torque| transposed_mat_vec(matrix, torque),
            ),
            ambient: self.ambient.seen_from(matrix),
            push: self.push,
        }
    }
}

/// R^T G R: a tensor in the frame whose axes are the columns of `matrix`.
#[inline(always)]
pub(crate) fn seen_from<R: Real>(matrix: &Mat3<R>, tensor: &Mat3<R>) -> Mat3<R> {
    let row = |i: usize| transposed_mat_vec(matrix, tensor[i]);
    let half = [row(0), row(1), row(2)];
    let column = |j: usize| transposed_mat_vec(matrix, [half[0][j], half[1][j], half[2][j]]);
    let [x, y, z] = [column(0), column(1), column(2)];
    [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]
}

/// The orientation after a turn at `omega` (body frame) for `h`.
#[inline(always)]
fn turned<R: Real>(orientation: Quat<R>, h: R, omega: Vec3<R>) -> Quat<R> {
    quat_normalize(quat_mul(orientation, turn(scale(h, omega))))
}

/// The momenta (p, l) in the frame that the body has turned to.
#[inline(always)]
fn momentum_after<R: Real>(turned: &[Vec3<R>; 3], y: &Increment<R>) -> Vec6<R> {
    let about_body = sub(y.angular, cross(y.displacement, y.linear));
    join(
        transposed_mat_vec(turned, y.linear),
        transposed_mat_vec(turned, about_body),
    )
}

/// theta' for R = R0 exp(theta) and R' = R omega: the inverse of the exponential's differential.
#[inline(always)]
fn rotation_vector_rate<R: Real>(theta: Vec3<R>, omega: Vec3<R>) -> Vec3<R> {
    let twist = cross(theta, omega);
    let two = dot(theta, theta);
    let c = two.of(1.0 / 12.0) + two * two.of(1.0 / 720.0);
    add_scaled(
        add_scaled(omega, two.of(0.5), twist),
        c,
        cross(theta, twist),
    )
}
