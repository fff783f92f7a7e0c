//! Steps by the paper's own integrator, in place of the default one.

use crate::equations::{Equations, is_unit, possible};
use crate::input::{Forcing, Input, rotation_rate};
use crate::kirchhoff::{Kirchhoff, Motion};
use crate::langevin::Langevin;
use crate::linalg::{Quat, Vec6, join, mul, rotate_back, split, sub};
use crate::noise::Counter;
use crate::published::Published;
use crate::runge_kutta;
use crate::state::State;

/// What the paper's integrator is given.
#[derive(Debug, Clone)]
pub(crate) enum Paper {
    RungeKutta4(Option<Box<Langevin>>),
    Published(Box<Published>),
}

impl Paper {
    pub(super) fn step(
        &self,
        equations: &Equations,
        before: &Motion,
        state: &State,
        dt: f64,
        input: &Input,
        forcing: Option<&Forcing>,
    ) -> (Motion, bool) {
        let normals = Counter::new(state.step, input.noise.body).normals(input.noise.seed);
        let mut motion = equations.relative_to_fluid(before, forcing);
        match self {
            Paper::RungeKutta4(langevin) => {
                let langevin = langevin.as_deref();
                runge_kutta_step(
                    &equations.kirchhoff,
                    &mut motion,
                    langevin,
                    state.time,
                    dt,
                    &normals,
                    forcing,
                );
            }
            Paper::Published(published) => {
                let load = |m: &Motion| outside(&equations.kirchhoff, m, forcing);
                published.step(&mut motion, state.time, dt, &normals, load);
            }
        }
        let after = equations.in_the_world(motion, dt, forcing);
        let sound = possible(&after) && is_unit(before.orientation);
        (after, sound)
    }
}

/// The generalized force of the forcing alone (body frame).
fn outside(kirchhoff: &Kirchhoff, motion: &Motion, forcing: Option<&Forcing>) -> Vec6 {
    let Some(forcing) = forcing else {
        return [0.0; 6];
    };
    let into_body = |a| rotate_back(motion.orientation, a);
    let with = kirchhoff.static_load(&kirchhoff.statics(Some(forcing)), into_body);
    let without = kirchhoff.static_load(&kirchhoff.statics(None), into_body);
    std::array::from_fn(|i| with[i] - without[i])
}

fn runge_kutta_step(
    kirchhoff: &Kirchhoff,
    motion: &mut Motion,
    langevin: Option<&Langevin>,
    time: f64,
    dt: f64,
    normals: &[f64; 6],
    forcing: Option<&Forcing>,
) {
    let statics = kirchhoff.statics(forcing);
    let start = motion.xi;
    runge_kutta::step(motion, time, dt, |m, t| {
        let mut rate = kirchhoff.momentum_rate(&m.xi);
        accumulate(
            &mut rate,
            &kirchhoff.static_load(&statics, |a| rotate_back(m.orientation, a)),
        );
        if let Some(langevin) = langevin {
            let relative = relative_to_turning(&m.xi, m.orientation, forcing);
            accumulate(&mut rate, &langevin.relaxation(&relative, t));
        }
        mul(&kirchhoff.inverse, &rate)
    });
    if let Some(langevin) = langevin {
        accumulate(&mut motion.xi, &langevin.kick(&start, time, dt, normals));
    }
}

/// The velocity `xi` less the spin of the fluid (body frame).
pub(crate) fn relative_to_turning(xi: &Vec6, orientation: Quat, forcing: Option<&Forcing>) -> Vec6 {
    let Some(gradient) = forcing.and_then(|forcing| forcing.gradient) else {
        return *xi;
    };
    let (v, omega) = split(xi);
    join(
        v,
        sub(omega, rotate_back(orientation, rotation_rate(&gradient))),
    )
}

fn accumulate(sum: &mut Vec6, term: &Vec6) {
    for i in 0..6 {
        sum[i] += term[i];
    }
}
