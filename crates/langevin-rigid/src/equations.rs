//! One step of the default integrator, for one body or for lanes of bodies: Algorithm 2.

use crate::ambient::Ambient;
use crate::input::{Forcing, rotation_rate};
use crate::kirchhoff::{Kirchhoff, Motion, Statics};
use crate::langevin::Langevin;
use crate::linalg::{
    Quat, Vec3, Vec6, add, add_scaled, dot, each, join, lift, matrix_of, scale, split, sub,
    transposed_mat_vec,
};
use crate::modes::Modes;
use crate::noise::Counter;
use crate::pace::{MOST_PARTS, Pace, Substep};
use crate::real::Real;
use crate::separated::{Closure, Eddies};
use crate::symmetry::{General, Symmetry, Tensor};

/// Speed (m/s) and spin (rad/s) beyond which a run has diverged: no light body in a fluid comes near.
pub const SPEED_LIMIT: f64 = 1e6;

/// What stays the same from step to step.
#[derive(Debug, Clone)]
pub(crate) struct Equations<F: Symmetry = General, R: Real = f64> {
    pub(crate) kirchhoff: Kirchhoff<F, R>,
    pub(crate) loads: FluidLoads<F, R>,
    pub(crate) pace: Pace<R>,
    /// Uniform velocity of the fluid, world frame; none in fluid at rest.
    pub(crate) current: Option<Vec3<R>>,
}

/// What acts beyond Kirchhoff's terms; inline, so that putting it into lanes allocates nothing.
#[derive(Debug, Clone)]
pub(crate) enum FluidLoads<F: Symmetry = General, R: Real = f64> {
    None,
    /// The Langevin loads, by Strang's splitting.
    Langevin(Langevin<F, R>),
    /// The closure for separated flow, in the turbulence that the body sheds.
    Separated(Separated<F, R>),
}

impl<F: Symmetry, R: Real> FluidLoads<F, R> {
    /// Whether they move [`Motion::fluctuation`].
    pub(crate) fn fluctuates(&self) -> bool {
        matches!(self, FluidLoads::Separated(_))
    }
}

#[derive(Debug, Clone)]
pub(crate) struct Separated<F: Symmetry = General, R: Real = f64> {
    pub(crate) closure: Closure<F, R>,
    pub(crate) eddies: Eddies<F, R>,
}

/// What a step made.
pub(crate) struct Stepped<R: Real> {
    pub(crate) motion: Motion<R>,
    /// Whether the motion is one that a body can have: finite and within [`SPEED_LIMIT`].
    pub(crate) sound: R::Mask,
    /// Lanes whose resistances are too stiff for the explicit scheme. Each must take the step alone; what is
    /// here of them is of no use. The code for many lanes would double for what is seldom met.
    pub(crate) alone: R::Mask,
}

/// The bodies' streams of noise, and where they are in them.
pub(crate) struct Noise<R: Real> {
    pub(crate) seed: u64,
    pub(crate) counter: Counter<R::Words>,
}

impl Equations {
    /// The same for a body of shape `G` in the lanes of `like`.
    pub(crate) fn lift<G: Symmetry, R: Real>(&self, like: R) -> Equations<G, R> {
        let total = &self.kirchhoff.total;
        Equations {
            kirchhoff: self.kirchhoff.lift(like),
            loads: match &self.loads {
                FluidLoads::None => FluidLoads::None,
                FluidLoads::Langevin(langevin) => FluidLoads::Langevin(langevin.lift(like, total)),
                FluidLoads::Separated(separated) => FluidLoads::Separated(Separated {
                    closure: separated.closure.lift(like),
                    eddies: separated.eddies.lift(like),
                }),
            },
            pace: self.pace.lift(like),
            current: self.current.map(|u| lift(like, &u)),
        }
    }
}

impl<F: Symmetry, R: Real> Equations<F, R> {
    /// The motion after `dt` (s), in the world.
    #[inline(always)]
    pub(crate) fn step(
        &self,
        before: &Motion<R>,
        time: R,
        dt: f64,
        noise: &Noise<R>,
        forcing: Option<&Forcing<R>>,
    ) -> Stepped<R> {
        let relative = self.relative_to_fluid(before, forcing);
        let (motion, alone) = self.in_parts(relative, time, dt, noise, forcing);
        let after = self.in_the_world(motion, time.of(dt), forcing);
        let timed = time.abs().less(time.of(f64::INFINITY));
        let sound = possible(&after) & is_unit(before.orientation) & timed;
        Stepped {
            motion: after,
            sound,
            alone,
        }
    }

    /// The motion after `dt` (s), in as many parts as the body's rates want, and which lanes must take it
    /// alone.
    #[inline(always)]
    fn in_parts(
        &self,
        mut motion: Motion<R>,
        start: R,
        dt: f64,
        noise: &Noise<R>,
        forcing: Option<&Forcing<R>>,
    ) -> (Motion<R>, R::Mask) {
        let statics = self.kirchhoff.statics(forcing);
        let forced = forcing.map(
            #[inline(always)]
            |forcing| self.forced(forcing),
        );
        let whole = start.of(dt);
        let least = start.of(dt / f64::from(MOST_PARTS));
        // What rounding leaves is no part.
        let end = start.of(1e-9 * dt.abs());
        let mut left = whole;
        let mut alone = whole.less(whole);
        for number in 0..MOST_PARTS {
            let time = start + (whole - left);
            let mut part = self.part(&motion.xi, time, left, least, forced);
            if !R::ALONE {
                alone = alone | part.stiff;
                part.h = R::choose(alone, left, part.h);
            }
            let next = self.take(&motion, time, &part, number, noise, &statics);
            if number == 0 && !R::any(end.less((left - part.h).abs())) {
                return (next, alone);
            }
            let moves = end.less(left.abs());
            motion = chosen(moves, &next, &motion);
            left = R::choose(moves, left - part.h, left);
            if !R::any(end.less(left.abs())) {
                return (motion, alone);
            }
        }
        (motion, alone)
    }

    /// What [`Pace::part`] wants to know of the forcing.
    #[inline(always)]
    fn forced(&self, forcing: &Forcing<R>) -> [R; 3] {
        let (faster, spun) = self.kirchhoff.gains(forcing);
        let squares = |[x, y, z]: &[Vec3<R>; 3]| dot(*x, *x) + dot(*y, *y) + dot(*z, *z);
        let gradient = match &forcing.gradient {
            Some(gradient) => squares(gradient).sqrt(),
            None => faster.of(0.0),
        };
        [faster, spun, gradient]
    }

    /// The part of `left` that comes next, not under `least`.
    #[inline(always)]
    fn part(&self, xi: &Vec6<R>, time: R, left: R, least: R, forced: Option<[R; 3]>) -> Substep<R> {
        let left = match &self.loads {
            FluidLoads::Langevin(langevin) => langevin.part(xi, time, left, least),
            FluidLoads::None | FluidLoads::Separated(_) => left,
        };
        self.pace.part(xi, left, least, forced)
    }

    #[inline(always)]
    fn take(
        &self,
        before: &Motion<R>,
        time: R,
        part: &Substep<R>,
        number: u32,
        noise: &Noise<R>,
        statics: &Statics<R>,
    ) -> Motion<R> {
        match &self.loads {
            FluidLoads::None => {
                let mut motion = *before;
                self.kirchhoff
                    .step(&mut motion, part.h, statics, |_, _| None);
                motion
            }
            FluidLoads::Langevin(langevin) => {
                let normals = noise.counter.normals_of_part(noise.seed, number);
                self.strang(langevin, before, time, part.h, &normals, statics)
            }
            FluidLoads::Separated(separated) => {
                let normals = noise.counter.normals_of_part(noise.seed, number).0;
                self.separated(separated, before, time, part, &normals, statics)
            }
        }
    }

    /// Half a step of the Langevin part, one of Kirchhoff's, half a step of the Langevin part.
    #[inline(always)]
    fn strang(
        &self,
        langevin: &Langevin<F, R>,
        before: &Motion<R>,
        time: R,
        h: R,
        (first, second): &([R; 6], [R; 6]),
        statics: &Statics<R>,
    ) -> Motion<R> {
        let half = h * h.of(0.5);
        let mut motion = *before;
        // Relaxation is towards the fluid, which may turn.
        let fluid = self.fluid_spin(statics, motion.orientation);
        let mut modes = langevin.modes.of_velocity(&motion.xi);
        if let Some(fluid) = &fluid {
            modes = langevin.modes.of_velocity(&minus(&motion.xi, fluid));
        }
        let relaxed = langevin.step(&modes, time, half, first);
        motion.xi = langevin.modes.velocity(&relaxed);
        let mut momentum = langevin.modes.momentum(&relaxed);
        if let Some(fluid) = &fluid {
            motion.xi = plus(&motion.xi, fluid);
            momentum = plus(&momentum, &self.kirchhoff.total.times(fluid));
        }
        let momentum = self
            .kirchhoff
            .step_momentum(&mut motion, &momentum, h, statics, |_, _| None);
        let fluid = self.fluid_spin(statics, motion.orientation);
        let mut turned = langevin.modes.of_momentum(&momentum);
        if let Some(fluid) = &fluid {
            let carried = self.kirchhoff.total.times(fluid);
            turned = langevin.modes.of_momentum(&minus(&momentum, &carried));
        }
        let relaxed = langevin.step(&turned, time + half, half, second);
        motion.xi = langevin.modes.velocity(&relaxed);
        if let Some(fluid) = &fluid {
            motion.xi = plus(&motion.xi, fluid);
        }
        motion
    }

    /// The motion of the fluid as a spin of the body, body frame, where it turns.
    #[inline(always)]
    fn fluid_spin(&self, statics: &Statics<R>, orientation: Quat<R>) -> Option<Vec6<R>> {
        let gradient = statics.ambient.gradient?;
        let turning = in_the_body(orientation, rotation_rate(&gradient));
        Some(join([turning[0].of(0.0); 3], turning))
    }

    #[inline(always)]
    fn separated(
        &self,
        separated: &Separated<F, R>,
        before: &Motion<R>,
        time: R,
        part: &Substep<R>,
        normals: &[R; 6],
        statics: &Statics<R>,
    ) -> Motion<R> {
        let (h, closure) = (part.h, &separated.closure);
        let mut before = *before;
        let mut ambient = Ambient {
            fluctuation: separated.eddies.step(&mut before, time, h, normals),
            ..statics.ambient
        };
        if let Some(seen) = &mut ambient.fluctuation {
            // A motion that is not resolved would feed on turbulence of its own.
            let none = [h.of(0.0); 6];
            *seen = choose(part.rough, &none, seen);
        }
        let mut statics = *statics;
        statics.ambient = ambient;
        let mut motion = before;
        if !R::ALONE || R::any(!part.stiff) {
            self.kirchhoff.step(
                &mut motion,
                h,
                &statics,
                #[inline(always)]
                |xi, ambient| {
                    h.apart(
                        #[inline(always)]
                        || closure.load(xi, ambient),
                    )
                },
            );
        }
        if R::ALONE && R::any(part.stiff) {
            let mut resisted = before;
            self.kirchhoff.step_resisted(
                &mut resisted,
                h,
                &statics,
                #[inline(always)]
                |xi, ambient| {
                    h.apart(
                        #[inline(always)]
                        || closure.resisted_load(xi, ambient),
                    )
                },
            );
            motion = chosen(part.stiff, &resisted, &motion);
        }
        motion
    }

    /// The motion in the frame that moves with the undisturbed fluid.
    #[inline(always)]
    pub(crate) fn relative_to_fluid(
        &self,
        motion: &Motion<R>,
        forcing: Option<&Forcing<R>>,
    ) -> Motion<R> {
        let mut relative = *motion;
        if let Some(velocity) = self.fluid_velocity(forcing) {
            let (v, omega) = split(&motion.xi);
            relative.xi = join(sub(v, in_the_body(motion.orientation, velocity)), omega);
        }
        relative
    }

    /// Back into the world after `h`, over which the fluid went on and became faster.
    #[inline(always)]
    pub(crate) fn in_the_world(
        &self,
        mut motion: Motion<R>,
        h: R,
        forcing: Option<&Forcing<R>>,
    ) -> Motion<R> {
        let Some(mut velocity) = self.fluid_velocity(forcing) else {
            return motion;
        };
        motion.position = add_scaled(motion.position, h, velocity);
        if let Some(forcing) = forcing {
            let gained = scale(h, forcing.acceleration);
            motion.position = add_scaled(motion.position, h * h.of(0.5), gained);
            velocity = add(velocity, gained);
        }
        let (v, omega) = split(&motion.xi);
        motion.xi = join(add(v, in_the_body(motion.orientation, velocity)), omega);
        motion
    }

    /// Velocity of the undisturbed fluid at the body (m/s), world frame; none where it is at rest.
    #[inline(always)]
    fn fluid_velocity(&self, forcing: Option<&Forcing<R>>) -> Option<Vec3<R>> {
        match (self.current, forcing) {
            (Some(current), Some(forcing)) => Some(add(current, forcing.velocity)),
            (None, Some(forcing)) => Some(forcing.velocity),
            (current, None) => current,
        }
    }
}

#[inline(always)]
fn plus<R: Real>(a: &Vec6<R>, b: &Vec6<R>) -> Vec6<R> {
    each(
        a[0],
        #[inline(always)]
        |i| a[i] + b[i],
    )
}

#[inline(always)]
fn minus<R: Real>(a: &Vec6<R>, b: &Vec6<R>) -> Vec6<R> {
    each(
        a[0],
        #[inline(always)]
        |i| a[i] - b[i],
    )
}

/// Whether a body can move so: finite, and within [`SPEED_LIMIT`].
#[inline(always)]
pub(crate) fn possible<R: Real>(motion: &Motion<R>) -> R::Mask {
    let (v, omega) = split(&motion.xi);
    let limit = v[0].of(SPEED_LIMIT * SPEED_LIMIT);
    // Zero where all are finite, not a number otherwise.
    let whole = add(motion.position, [motion.orientation[0]; 3]);
    let nothing = dot(sub(whole, whole), [v[0].of(1.0); 3]);
    (dot(v, v) + nothing).less(limit) & dot(omega, omega).less(limit)
}

/// Whether a quaternion is one to half a percent: other engines keep theirs in single precision.
#[inline(always)]
pub(crate) fn is_unit<R: Real>(q: Quat<R>) -> R::Mask {
    let excess = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - q[0].of(1.0);
    excess.abs().less(q[0].of(0.01))
}

#[inline(always)]
fn in_the_body<R: Real>(orientation: Quat<R>, a: Vec3<R>) -> Vec3<R> {
    transposed_mat_vec(&matrix_of(orientation), a)
}

#[inline(always)]
fn choose<R: Real, const N: usize>(mask: R::Mask, yes: &[R; N], no: &[R; N]) -> [R; N] {
    each(
        yes[0],
        #[inline(always)]
        |i| R::choose(mask, yes[i], no[i]),
    )
}

#[inline(always)]
fn chosen<R: Real>(mask: R::Mask, yes: &Motion<R>, no: &Motion<R>) -> Motion<R> {
    Motion {
        position: choose(mask, &yes.position, &no.position),
        orientation: choose(mask, &yes.orientation, &no.orientation),
        xi: choose(mask, &yes.xi, &no.xi),
        fluctuation: choose(mask, &yes.fluctuation, &no.fluctuation),
    }
}
