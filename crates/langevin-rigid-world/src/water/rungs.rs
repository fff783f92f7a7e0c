//! A body in mixtures of two fluids, from the one to the other.

use langevin_rigid::linalg::vector::{add, cross, scale, sub};
use langevin_rigid::linalg::{Mat6, Vec3, Vec6, invert_spd, rotate, rotate_back};
use langevin_rigid::{Body, Fluid, Settings, SetupError, State, Stepper, TurbulenceHistory};

/// Intervals between the steppers.
const INTERVALS: usize = 16;

/// The same body in mixtures with the shares (n/N)^2 of water: close to each other where little water moves with a body that
/// may weigh little itself.
#[derive(Debug, Clone)]
pub(super) struct Rungs {
    steppers: Vec<Stepper>,
    fluids: Vec<Fluid>,
}

/// A fluid, and the history of the turbulence in it.
pub(super) type Surroundings<'a> = (&'a Fluid, Option<&'a TurbulenceHistory>);

impl Rungs {
    /// Mixtures have the turbulence of the water, which outweighs that of the air, and no current of their own.
    pub(super) fn new(
        body: &Body,
        (air, in_air): Surroundings,
        (water, in_water): Surroundings,
        settings: &Settings,
    ) -> Result<Self, SetupError> {
        let mut rungs = Self {
            steppers: Vec::with_capacity(INTERVALS + 1),
            fluids: Vec::with_capacity(INTERVALS + 1),
        };
        for n in 0..=INTERVALS {
            let (fluid, history) = match n {
                0 => (*air, in_air),
                INTERVALS => (*water, in_water),
                _ => (mixture(air, water, share_of(n)), in_water.or(in_air)),
            };
            rungs
                .steppers
                .push(Stepper::new(body, &fluid, history, settings)?);
            rungs.fluids.push(fluid);
        }
        Ok(rungs)
    }

    pub(super) fn air(&self) -> &Stepper {
        &self.steppers[0]
    }

    pub(super) fn water(&self) -> &Stepper {
        &self.steppers[INTERVALS]
    }

    /// Mass of body and fluid together at this share of water: linear in it.
    pub(super) fn total_mass(&self, share: f64) -> Mat6 {
        if share <= 0.0 {
            return *self.air().total_mass();
        }
        if share >= 1.0 {
            return *self.water().total_mass();
        }
        let [air, water] = [self.air().total_mass(), self.water().total_mass()];
        std::array::from_fn(|i| {
            std::array::from_fn(|j| (1.0 - share) * air[i][j] + share * water[i][j])
        })
    }

    /// Its inverse.
    pub(super) fn inverse_total_mass(&self, share: f64) -> Mat6 {
        if share <= 0.0 {
            return *self.air().inverse_total_mass();
        }
        let water = self.water().inverse_total_mass();
        if share >= 1.0 {
            return *water;
        }
        // Both ends are positive definite, and so is what is between.
        invert_spd(&self.total_mass(share)).unwrap_or(*water)
    }

    /// The state that the two steppers about a share lead to, which `step` takes with each.
    ///
    /// Momenta are what is linear in the share: the same impulse on both makes the same impulse on the body between them.
    /// `fluid` is the velocity of the fluid after the step (m/s, world frame), which they are relative to.
    pub(super) fn between<E>(
        &self,
        share: f64,
        fluid: Vec3,
        step: impl Fn(&Stepper, &Fluid) -> Result<State, E>,
    ) -> Result<State, E> {
        let lower = ((share.sqrt() * INTERVALS as f64) as usize).min(INTERVALS - 1);
        let [from, to] = [share_of(lower), share_of(lower + 1)];
        let weight = (share - from) / (to - from);
        let end = |n: usize| step(&self.steppers[n], &self.fluids[n]);
        let ends = [end(lower)?, end(lower + 1)?];
        let weights = [1.0 - weight, weight];
        let [low, high] = &ends;
        let mut state = *low;
        let mix = |a: &[f64], b: &[f64], i: usize| weights[0] * a[i] + weights[1] * b[i];
        state.position = std::array::from_fn(|i| mix(&low.position, &high.position, i));
        state.fluctuation = std::array::from_fn(|i| mix(&low.fluctuation, &high.fluctuation, i));
        let [p, q] = [low.orientation, high.orientation];
        let same: f64 = (0..4).map(|i| p[i] * q[i]).sum();
        let q = if same < 0.0 { q.map(|x| -x) } else { q };
        let between: [f64; 4] = std::array::from_fn(|i| mix(&p, &q, i));
        let length = between.iter().map(|x| x * x).sum::<f64>().sqrt();
        state.orientation = between.map(|x| x / length);
        // About the place between, in the world.
        let (mut linear, mut angular) = ([0.0; 3], [0.0; 3]);
        for n in 0..2 {
            let end = &ends[n];
            let (p, l) = split(&times(
                self.steppers[lower + n].total_mass(),
                &relative(end, fluid),
            ));
            let [p, l] = [p, l].map(|a| rotate(end.orientation, a));
            let l = add(l, cross(sub(end.position, state.position), p));
            linear = add(linear, scale(weights[n], p));
            angular = add(angular, scale(weights[n], l));
        }
        let [p, l] = [linear, angular].map(|a| rotate_back(state.orientation, a));
        let velocity = times(&self.inverse_total_mass(share), &join(p, l));
        set_relative(&mut state, &velocity, fluid);
        Ok(state)
    }
}

/// Share of water in the `n`th mixture.
fn share_of(n: usize) -> f64 {
    let root = n as f64 / INTERVALS as f64;
    root * root
}

/// The fluid whose density and dynamic viscosity are the means of both, at rest.
fn mixture(air: &Fluid, water: &Fluid, share: f64) -> Fluid {
    let mix = |a: f64, w: f64| (1.0 - share) * a + share * w;
    let density = mix(air.density, water.density);
    let dynamic = mix(air.density * air.viscosity, water.density * water.viscosity);
    Fluid {
        density,
        viscosity: dynamic / density,
        velocity: [0.0; 3],
    }
}

/// The velocities of a body relative to a fluid that moves at `fluid` (m/s, world frame); body frame.
pub(super) fn relative(state: &State, fluid: Vec3) -> Vec6 {
    let fluid = rotate_back(state.orientation, fluid);
    join(sub(state.velocity, fluid), state.angular_velocity)
}

/// Sets velocities that are relative to a fluid.
pub(super) fn set_relative(state: &mut State, velocity: &Vec6, fluid: Vec3) {
    let (linear, angular) = split(velocity);
    state.velocity = add(linear, rotate_back(state.orientation, fluid));
    state.angular_velocity = angular;
}

pub(super) fn times(m: &Mat6, a: &Vec6) -> Vec6 {
    std::array::from_fn(|i| (0..6).map(|j| m[i][j] * a[j]).sum())
}

fn join([a, b, c]: Vec3, [d, e, f]: Vec3) -> Vec6 {
    [a, b, c, d, e, f]
}

fn split(&[a, b, c, d, e, f]: &Vec6) -> (Vec3, Vec3) {
    ([a, b, c], [d, e, f])
}
