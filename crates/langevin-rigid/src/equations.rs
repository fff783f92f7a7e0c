//! One step of the default integrator, for one body or for lanes of bodies: Algorithm 2.

use crate::kirchhoff::{Kirchhoff, Motion};
use crate::langevin::Langevin;
use crate::linalg::{
    Quat, Vec3, add, add_scaled, dot, each, join, lift, matrix_of, split, sub, transposed_mat_vec,
};
use crate::modes::Modes;
use crate::noise::Counter;
use crate::real::Real;
use crate::separated::Closure;
use crate::shape::{General, Shape};

/// A step is taken in no more parts.
const MOST_PARTS: u32 = 256;

/// Speed (m/s) and spin (rad/s) beyond which a run has diverged: no light body in a fluid comes near.
pub const SPEED_LIMIT: f64 = 1e6;

/// What stays the same from step to step.
#[derive(Debug, Clone)]
pub(crate) struct Equations<F: Shape = General, R: Real = f64> {
    pub(crate) kirchhoff: Kirchhoff<F, R>,
    pub(crate) loads: Loads<F, R>,
    /// Uniform velocity of the fluid, world frame; none in fluid at rest.
    pub(crate) current: Option<Vec3<R>>,
}

/// What acts beyond Kirchhoff's terms.
#[derive(Debug, Clone)]
pub(crate) enum Loads<F: Shape = General, R: Real = f64> {
    None,
    /// The Langevin loads, by Strang's splitting.
    Langevin(Box<Langevin<F, R>>),
    /// The closure for separated flow, and the turbulence that the body sheds as noise.
    Separated(Box<Separated<F, R>>),
}

#[derive(Debug, Clone)]
pub(crate) struct Separated<F: Shape = General, R: Real = f64> {
    pub(crate) closure: Closure<F, R>,
    pub(crate) noise: Langevin<F, R>,
}

/// The bodies' streams of noise, and where they are in them.
pub(crate) struct Noise<R: Real> {
    pub(crate) seed: u64,
    pub(crate) counter: Counter<R::Words>,
}

impl Equations {
    /// The same for a body of shape `G` in the lanes of `like`.
    pub(crate) fn lift<G: Shape, R: Real>(&self, like: R) -> Equations<G, R> {
        let total = &self.kirchhoff.total;
        Equations {
            kirchhoff: self.kirchhoff.lift(like),
            loads: match &self.loads {
                Loads::None => Loads::None,
                Loads::Langevin(langevin) => Loads::Langevin(Box::new(langevin.lift(like, total))),
                Loads::Separated(separated) => Loads::Separated(Box::new(Separated {
                    closure: separated.closure.lift(like),
                    noise: separated.noise.lift(like, total),
                })),
            },
            current: self.current.map(|u| lift(like, &u)),
        }
    }
}

impl<F: Shape, R: Real> Equations<F, R> {
    /// The motion after `dt` (s), in the world, and whether it is one that a body can have: finite
    /// and within [`SPEED_LIMIT`].
    #[inline(always)]
    pub(crate) fn step(
        &self,
        before: &Motion<R>,
        time: R,
        dt: f64,
        noise: &Noise<R>,
    ) -> (Motion<R>, R::Mask) {
        let h = time.of(dt);
        let mut motion = self.relative_to_fluid(before);
        match &self.loads {
            Loads::None => self.kirchhoff.step(&mut motion, h, |_| None),
            Loads::Langevin(langevin) => self.strang(langevin, &mut motion, time, dt, noise),
            Loads::Separated(separated) => self.separated(separated, &mut motion, time, h, noise),
        }
        let after = self.in_the_world(motion, h);
        let sound = possible(&after);
        (after, sound)
    }

    /// Half a step of the Langevin part, one of Kirchhoff's, half a step of the Langevin part; in
    /// parts where a body moves so fast that the coefficients would not hold over the step.
    #[inline(always)]
    fn strang(
        &self,
        langevin: &Langevin<F, R>,
        motion: &mut Motion<R>,
        start: R,
        dt: f64,
        noise: &Noise<R>,
    ) {
        let (whole, half) = (start.of(dt), start.of(0.5));
        let least = start.of(dt / f64::from(MOST_PARTS));
        // What rounding leaves is no part.
        let end = start.of(1e-9 * dt.abs());
        let mut modes = langevin.modes.of_velocity(&motion.xi);
        let mut left = whole;
        for part in 0..MOST_PARTS {
            let time = start + (whole - left);
            let h = langevin.part(&motion.xi, time, left, least);
            let (first, second) = noise.counter.normals_of_part(noise.seed, part);

            let mut next = *motion;
            let relaxed = langevin.step(&modes, time, h * half, &first);
            next.xi = langevin.modes.velocity(&relaxed);
            let momentum = langevin.modes.momentum(&relaxed);
            let momentum = self
                .kirchhoff
                .step_momentum(&mut next, &momentum, h, |_| None);
            let turned = langevin.modes.of_momentum(&momentum);
            let relaxed = langevin.step(&turned, time + h * half, h * half, &second);
            next.xi = langevin.modes.velocity(&relaxed);

            if part == 0 && !R::any(end.less((left - h).abs())) {
                *motion = next;
                return;
            }
            let moves = end.less(left.abs());
            *motion = chosen(moves, &next, motion);
            modes = choose(moves, &relaxed, &modes);
            left = R::choose(moves, left - h, left);
            if !R::any(end.less(left.abs())) {
                return;
            }
        }
    }

    #[inline(always)]
    fn separated(
        &self,
        separated: &Separated<F, R>,
        motion: &mut Motion<R>,
        time: R,
        h: R,
        noise: &Noise<R>,
    ) {
        let normals = noise.counter.normals(noise.seed);
        let kick = separated.noise.kick(&motion.xi, time, h, &normals);
        self.kirchhoff.step(
            motion,
            h,
            #[inline(always)]
            |xi| separated.closure.load(xi),
        );
        motion.xi = each(
            h,
            #[inline(always)]
            |i| motion.xi[i] + kick[i],
        );
    }

    /// The motion in the inertial frame that the undisturbed fluid is at rest in.
    #[inline(always)]
    pub(crate) fn relative_to_fluid(&self, motion: &Motion<R>) -> Motion<R> {
        let mut relative = *motion;
        if let Some(current) = self.current {
            let (v, omega) = split(&motion.xi);
            relative.xi = join(sub(v, in_the_body(motion.orientation, current)), omega);
        }
        relative
    }

    #[inline(always)]
    pub(crate) fn in_the_world(&self, mut motion: Motion<R>, h: R) -> Motion<R> {
        if let Some(current) = self.current {
            let (v, omega) = split(&motion.xi);
            motion.xi = join(add(v, in_the_body(motion.orientation, current)), omega);
            motion.position = add_scaled(motion.position, h, current);
        }
        motion
    }
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
    }
}
