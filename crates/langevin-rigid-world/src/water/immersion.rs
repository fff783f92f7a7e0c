//! A body between air and water, made ready to step.

use langevin_rigid::linalg::vector::{add, cross, norm, scale, sub};
use langevin_rigid::linalg::{Mat6, Quat, Vec3, quat_from_rotation_vector, rotate, rotate_back};
use langevin_rigid::{
    Body, Flow, Fluid, Input, Model, NoiseStream, Settings, SetupError, State, StepError, Stepper,
    TurbulenceHistory,
};

use super::hull::{FloatingHull, HullError};
use super::radiation::heave_damping;
use super::rungs::{Rungs, relative, set_relative, times};
use super::surface::{Plane, WaterSurface};

/// A body that is partly in air and partly in water, made ready to step.
///
/// Holds what stays the same from step to step and is shared by any number of bodies of that shape; the state is the
/// caller's. Wholly in one fluid the body takes the step of the [`Stepper`] in that fluid, to the same bits.
///
/// # Method
///
/// The share s of the volume that is in the water, and its centroid, are exact for the polyhedron of the body and the plane
/// that touches the surface over the centre of mass. So are the forces of the undisturbed fluids on the two parts: buoyancy,
/// and where the fluid accelerates, the Froude-Krylov force (Newman, Marine Hydrodynamics, 1977, chapters 4 and 6). They are
/// taken in the middle of the step, which makes it a leapfrog: a body that bobs gains no energy from steps.
///
/// Everything else is that of a body in a mixture of the fluids by volume: density and dynamic viscosity are means, and so
/// is the momentum of the undisturbed fluid. The added mass is thus in proportion to the share, M(s) = M_body + rho(s) A.
/// That is an approximation: the true one depends on the pose, and on the frequency where a body makes waves. Drag is that of
/// the whole body in the mixture. Of the waves that a body makes only what they take out of heave is here, after Haskind
/// and Hulme, so that a float comes to rest as it does in life; the waves themselves are not, nor those of a body that rolls.
/// [`Model::Kirchhoff`], which has no resistances, has not this one either. The flow in waves is that at the centre of mass,
/// and the surface is plane as far as the body reaches: waves should be long beside it.
///
/// Where the share grows in a step, the momentum M(s) xi of body and moved fluid relative to the water stays (von Karman, The
/// impact on seaplane floats during landing, NACA TN 321, 1929): the body is slowed down to xi' = M(s')^-1 M(s) xi. Where
/// it falls, the velocity stays and the water that is left behind takes its momentum along. As M grows with s, neither
/// adds energy: 1/2 p . M^-1 p falls with M at the same p, 1/2 xi . M xi grows with M at the same xi.
///
/// A step near the surface is taken in parts, such that none takes the body through it by more than a fraction of its size,
/// the smaller the lighter it is, or turns the phase of its bobbing by more than a radian.
#[derive(Debug, Clone)]
pub struct Immersion {
    rungs: Rungs,
    hull: FloatingHull,
    air: Fluid,
    water: Fluid,
    gravity: Vec3,
    /// Bounds on the acceleration by weight and buoyancy in air and in water (m/s^2).
    gains: [f64; 2],
    /// How far a part of a step may move the body relative to the surface (m).
    stride: f64,
    /// Whether the waves that it makes resist it.
    radiates: bool,
}

/// Why a body cannot be made ready to step between two fluids.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImmersionError {
    /// It cannot be made ready to step in one of them.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Its surface cannot be cut.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// Gravity is not along -y.
    #[error(
        "gravity is {0:?} m/s^2; with a water surface it must be along -y, such as [0, -9.81, 0]"
    )]
    Gravity(Vec3),
    /// The water is not denser than the air.
    #[error(
        "the lower fluid has a density of {water} kg/m^3 and the upper one of {air} kg/m^3; the lower one must be denser"
    )]
    Densities {
        /// Of the lower fluid (kg/m^3).
        water: f64,
        /// Of the upper fluid (kg/m^3).
        air: f64,
    },
    /// The water's velocity is given beside that of its surface.
    #[error(
        "the water has a velocity of {0:?} m/s; give it to its surface, by `WaterSurface::with_current`"
    )]
    Current(Vec3),
}

/// Parts that a step is taken in at most.
const MOST_PARTS: u32 = 256;
/// How far a part may move the body relative to the surface, in radii of the body; times [`LIGHT`] times its density over
/// that of the water where this is below one, as water weighs much against such a body.
const STRIDE: f64 = 0.1;
const LIGHT: f64 = 5.0;

/// How a body lies in the water.
#[derive(Debug, Clone, Copy)]
struct Wetting {
    /// Of the volume in the water; exactly 0 or 1 if it is wholly in one fluid.
    share: f64,
    /// First moments about the centre of mass of the volumes in water and in air, world frame (m^4).
    in_water: Vec3,
    in_air: Vec3,
    waterplane: f64,
}

impl Immersion {
    /// Makes `body` ready to step between `air`, the upper fluid, and `water`, the lower one, each with the history of the
    /// turbulence in it. In between the turbulence is that of the water, which outweighs the air's, or of the air if the water
    /// has no history.
    ///
    /// # Errors
    /// [`ImmersionError`]: the surface must be closed, gravity along -y, the water denser and without a velocity of its own.
    pub fn new(
        body: &Body,
        air: (&Fluid, Option<&TurbulenceHistory>),
        water: (&Fluid, Option<&TurbulenceHistory>),
        settings: &Settings,
    ) -> Result<Self, ImmersionError> {
        let [x, y, z] = settings.gravity;
        if !(x == 0.0 && z == 0.0 && y < 0.0) {
            return Err(ImmersionError::Gravity(settings.gravity));
        }
        if water.0.velocity != [0.0; 3] {
            return Err(ImmersionError::Current(water.0.velocity));
        }
        let rungs = Rungs::new(body, air, water, settings)?;
        if water.0.density <= air.0.density {
            return Err(ImmersionError::Densities {
                water: water.0.density,
                air: air.0.density,
            });
        }
        let hull = FloatingHull::new(body)?;
        let ratio = body.density() / water.0.density;
        let gain = |stepper: &Stepper, fluid: &Fluid| {
            let net = (body.mass - fluid.density * body.volume).abs();
            -y * net * trace(stepper.inverse_total_mass(), 0)
        };
        Ok(Self {
            gains: [gain(rungs.air(), air.0), gain(rungs.water(), water.0)],
            rungs,
            stride: STRIDE * hull.radius() * (LIGHT * ratio).min(1.0),
            hull,
            air: *air.0,
            water: *water.0,
            gravity: settings.gravity,
            radiates: settings.model != Model::Kirchhoff,
        })
    }

    /// The body in the upper fluid.
    pub fn in_air(&self) -> &Stepper {
        self.rungs.air()
    }

    /// The body in the lower fluid.
    pub fn in_water(&self) -> &Stepper {
        self.rungs.water()
    }

    /// The body's surface as it is cut.
    pub fn hull(&self) -> &FloatingHull {
        &self.hull
    }

    /// Share of the body's volume that is in the water, at the state's time: exactly 0 or 1 away from the surface.
    pub fn share(&self, state: &State, surface: &WaterSurface) -> f64 {
        self.wetting(state.position, state.orientation, state.time, surface)
            .share
    }

    /// Mass of body and fluid together with this share in the water, body frame, about the centre of mass: as
    /// [`Stepper::total_mass`], which it is for 0 and 1.
    pub fn total_mass(&self, share: f64) -> Mat6 {
        self.rungs.total_mass(share)
    }

    /// Inverse of [`Immersion::total_mass`].
    pub fn inverse_total_mass(&self, share: f64) -> Mat6 {
        self.rungs.inverse_total_mass(share)
    }

    /// Advances `state` by `dt` (s) with the noise of its step number.
    ///
    /// `input` is as for [`Stepper::step`] in the upper fluid: its flow is that of the air, on top of the air's
    /// [`Fluid::velocity`]; that of the water is the surface's. Wrench and noise are the body's wherever it is.
    ///
    /// Away from the surface this is one step of a [`Stepper`]. At the surface it is taken in up to 256 parts, each of which
    /// cuts the hull twice, steps two steppers and has noise of its own.
    ///
    /// # Errors
    /// [`StepError`], with `state` left as it was before the step.
    pub fn step(
        &self,
        state: &mut State,
        dt: f64,
        input: &Input,
        surface: &WaterSurface,
    ) -> Result<(), StepError> {
        if !(state.is_finite() && input.is_finite() && dt >= 0.0 && dt.is_finite()) {
            // It says what is wrong.
            return self.in_air().step(state, dt, input);
        }
        let mut body = *state;
        let mut wet = self.wetting(body.position, body.orientation, body.time, surface);
        let mut left = dt;
        for number in 0..MOST_PARTS {
            let h = self.part(&body, &wet, left, dt, surface);
            let mut input = *input;
            input.noise = stream_of_part(input.noise, number);
            (body, wet) = self.advance(&body, &wet, h, &input, surface)?;
            left -= h;
            if left <= 1e-9 * dt {
                break;
            }
            body.step = state.step;
        }
        body.step = state.step.wrapping_add(1);
        body.time = state.time + dt;
        *state = body;
        Ok(())
    }

    /// How long the next part may be (s).
    fn part(
        &self,
        body: &State,
        wet: &Wetting,
        left: f64,
        whole: f64,
        surface: &WaterSurface,
    ) -> f64 {
        let radius = self.hull.radius();
        let velocity = body.world_velocity();
        let spin = norm(body.angular_velocity);
        let clear = (body.position[1] - surface.level()).abs() - surface.reach() - radius;
        let gain = if wet.share == 0.0 {
            self.gains[0]
        } else {
            self.gains[1]
        };
        if clear > (norm(velocity) + 0.5 * gain * left) * left {
            return left;
        }
        let water = surface.flow(body.position, body.time).velocity;
        let speed = norm(sub(velocity, water)) + spin * radius;
        // At its speed, and from rest at about the acceleration of gravity.
        let stride = self.stride;
        let mut most = (stride / speed).min((stride / norm(self.gravity)).sqrt());
        if wet.waterplane > 0.0 {
            // Bound on the square of the frequencies at which it bobs, rolls and pitches.
            let inverse = self.inverse_total_mass(wet.share);
            let volume = wet.share * self.hull.volume();
            let turning = radius * (wet.waterplane * radius + volume);
            let stiffness = wet.waterplane * trace(&inverse, 0) + turning * trace(&inverse, 3);
            let weight = self.water.density * norm(self.gravity);
            most = most.min(1.0 / (weight * stiffness).sqrt());
        }
        let h = most.max(whole / f64::from(MOST_PARTS)).min(left);
        // What rounding leaves is no part.
        if left - h <= 1e-9 * whole { left } else { h }
    }

    /// One part of a step: the body after it, and how it lies in the water then.
    fn advance(
        &self,
        body: &State,
        before: &Wetting,
        h: f64,
        input: &Input,
        surface: &WaterSurface,
    ) -> Result<(State, Wetting), StepError> {
        // Where it is half way if nothing acts: forces taken there make the step a leapfrog, which keeps the energy.
        let half = 0.5 * h;
        let position = add(body.position, scale(half, body.world_velocity()));
        let turned = quat_from_rotation_vector(scale(half, body.angular_velocity));
        let orientation = product(body.orientation, turned);
        let amid = self.wetting(position, orientation, body.time + half, surface);
        let mut after = *body;
        if before.share == 0.0 && amid.share == 0.0 {
            self.in_air().step(&mut after, h, input)?;
        } else if before.share == 1.0 && amid.share == 1.0 {
            let flow = over_step(surface, body, position, half);
            self.in_water()
                .step(&mut after, h, &Input { flow, ..*input })?;
        } else {
            let water = over_step(surface, body, position, half);
            after = self.between(body, &amid, h, input, &water)?;
        }
        let wet = self.wetting(after.position, after.orientation, after.time, surface);
        if wet.share > before.share {
            let water = surface.flow(after.position, after.time).velocity;
            let momentum = times(&self.total_mass(before.share), &relative(&after, water));
            let slowed = times(&self.inverse_total_mass(wet.share), &momentum);
            set_relative(&mut after, &slowed, water);
        }
        if self.radiates && wet.waterplane > 0.0 {
            self.radiate(&mut after, &wet, h, surface);
        }
        Ok((after, wet))
    }

    /// Takes out of the velocity what the waves of a bobbing body take in `h` (s): an impulse at the centre of the submerged
    /// part against its vertical velocity relative to the water.
    fn radiate(&self, body: &mut State, wet: &Wetting, h: f64, surface: &WaterSurface) {
        let volume = wet.share * self.hull.volume();
        let arm = rotate_back(body.orientation, scale(1.0 / volume, wet.in_water));
        let up = rotate_back(body.orientation, [0.0, 1.0, 0.0]);
        let [a, b, c] = cross(arm, up);
        let heave = [up[0], up[1], up[2], a, b, c];
        let answer = times(&self.inverse_total_mass(wet.share), &heave);
        let inner = |a: &[f64; 6], b: &[f64; 6]| -> f64 { (0..6).map(|i| a[i] * b[i]).sum() };
        let mobility = inner(&heave, &answer);
        // Of the waves that it makes if it bobs freely: omega^2 / g.
        let number = self.water.density * wet.waterplane * mobility;
        let frequency = (number * norm(self.gravity)).sqrt();
        let damping = heave_damping(number, wet.waterplane, volume);
        let rate = self.water.density * frequency * damping * mobility;
        let water = surface.flow(body.position, body.time).velocity;
        let mut velocity = relative(body, water);
        let lost = -libm::expm1(-rate * h) * inner(&heave, &velocity) / mobility;
        for i in 0..6 {
            velocity[i] -= lost * answer[i];
        }
        set_relative(body, &velocity, water);
    }

    /// A part of a step partly in the water, as `wet` says.
    fn between(
        &self,
        body: &State,
        wet: &Wetting,
        h: f64,
        input: &Input,
        water: &Flow,
    ) -> Result<State, StepError> {
        let [in_air, in_water] = [
            (1.0 - wet.share) * self.air.density,
            wet.share * self.water.density,
        ];
        let density = in_air + in_water;
        let mut air = input.flow;
        air.velocity = add(air.velocity, self.air.velocity);
        let flow = mean(&air, in_air / density, water, in_water / density);
        // Forces on a unit of mass of the fluids, by their pressure.
        let [lift_air, lift_water, lift] =
            [&air, water, &flow].map(|flow| sub(flow.acceleration, self.gravity));
        let volume = self.hull.volume();
        let whole = add(wet.in_air, wet.in_water);
        let force = scale(density * volume, lift);
        let torque = add(
            scale(self.air.density, cross(wet.in_air, lift_air)),
            scale(self.water.density, cross(wet.in_water, lift_water)),
        );
        let fluid = add(flow.velocity, scale(h, flow.acceleration));
        self.rungs.between(wet.share, fluid, |stepper, mixture| {
            // What the mixture itself does, at the centre of buoyancy.
            let own_force = scale(mixture.density * volume, lift);
            let own_torque = scale(mixture.density, cross(whole, lift));
            let mut input = Input { flow, ..*input };
            input.flow.velocity = sub(flow.velocity, mixture.velocity);
            input.wrench.force = add(input.wrench.force, sub(force, own_force));
            input.wrench.torque = add(input.wrench.torque, sub(torque, own_torque));
            let mut after = *body;
            stepper.step(&mut after, h, &input)?;
            Ok(after)
        })
    }

    /// How a body lies in the water.
    fn wetting(
        &self,
        position: Vec3,
        orientation: Quat,
        time: f64,
        surface: &WaterSurface,
    ) -> Wetting {
        let hull = &self.hull;
        let height = position[1] - surface.level();
        let far = hull.radius() + surface.reach();
        let (volume, centroid, waterplane) = if height >= far {
            (0.0, [0.0; 3], 0.0)
        } else if height <= -far {
            (hull.volume(), hull.centroid(), 0.0)
        } else {
            let tangent = surface.tangent(position[0], position[2], time);
            let below = hull.below(&Plane {
                normal: rotate_back(orientation, tangent.normal),
                offset: -tangent.height(position),
            });
            (below.volume, below.centroid, below.waterplane)
        };
        let in_water = scale(volume, centroid);
        let in_air = sub(scale(hull.volume(), hull.centroid()), in_water);
        Wetting {
            share: volume / hull.volume(),
            in_water: rotate(orientation, in_water),
            in_air: rotate(orientation, in_air),
            waterplane,
        }
    }
}

/// The water over a step that has the body at `amid` after the time `half`: its velocity at the start, and the acceleration
/// that leads to its velocity at the end.
fn over_step(surface: &WaterSurface, body: &State, amid: Vec3, half: f64) -> Flow {
    Flow {
        acceleration: surface.flow(amid, body.time + half).acceleration,
        ..surface.flow(body.position, body.time)
    }
}

/// The mean of two flows.
fn mean(a: &Flow, of_a: f64, b: &Flow, of_b: f64) -> Flow {
    let mix = |a: Vec3, b: Vec3| add(scale(of_a, a), scale(of_b, b));
    Flow {
        velocity: mix(a.velocity, b.velocity),
        gradient: std::array::from_fn(|i| mix(a.gradient[i], b.gradient[i])),
        acceleration: mix(a.acceleration, b.acceleration),
    }
}

/// Sum of the diagonal of the linear (from 0) or the angular block (from 3): no less than its largest eigenvalue.
fn trace(m: &Mat6, from: usize) -> f64 {
    (from..from + 3).map(|i| m[i][i]).sum()
}

/// The noise of a part of a step: the first has that of the step.
fn stream_of_part(noise: NoiseStream, number: u32) -> NoiseStream {
    let away = u64::from(number).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    NoiseStream {
        seed: noise.seed ^ away,
        ..noise
    }
}

/// The quaternion of first the turn `b`, then `a`.
fn product(a: Quat, b: Quat) -> Quat {
    let [u, v] = [[a[0], a[1], a[2]], [b[0], b[1], b[2]]];
    let across = cross(u, v);
    let [x, y, z]: Vec3 = std::array::from_fn(|i| a[3] * v[i] + b[3] * u[i] + across[i]);
    [
        x,
        y,
        z,
        a[3] * b[3] - (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]),
    ]
}
