//! Steps for a host that solves contacts itself: a physics engine of a game.
//!
//! Such an engine moves a body by its velocities and changes them where it touches something. It knows one mass and a
//! 3x3 inertia a body, and no added mass.

use crate::input::Input;
use crate::linalg::{
    Mat3, Quat, Vec3, add, add_scaled, dot, invert_spd, mat_vec, norm, quat_mul, rotation_matrix,
    scale, sub,
};
use crate::state::State;
use crate::stepper::{StepError, Stepper};

/// A step in the fluid alone, as velocities that take a body there.
///
/// ```
/// use langevin_rigid::{Body, Fluid, Input, Settings, State, Stepper};
/// let leaf = Body::disc(0.03, 0.0005, 400.0)?;
/// let stepper = Stepper::new(&leaf, &Fluid::AIR, None, &Settings::default())?;
/// let mut state = State::default();
/// let dt = 1.0 / 60.0;
///
/// let flight = stepper.fly(&state, dt, &Input::default())?;
/// // The engine moves the body by these velocities, and finds that it cannot go down:
/// let [x, _, z] = flight.velocity();
/// let solved = [x, 0.0, z];
/// let position = [x * dt, 0.0, z * dt];
/// state = flight.met(None, position, state.orientation, solved, flight.angular_velocity());
/// // It lies on the ground.
/// assert!(state.world_velocity()[1].abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeFlight {
    end: State,
    velocity: Vec3,
    angular_velocity: Vec3,
}

/// Mass and inertia that an engine takes for a body in a fluid while it solves a contact along a normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactMass {
    /// What an impulse along the normal through the centre of mass divides by (kg).
    pub mass: f64,
    /// What a moment about the centre of mass divides by, body frame (kg m^2).
    pub inertia: Mat3,
    /// What it is along (world frame).
    normal: Vec3,
    /// Velocity that an impulse through the centre of mass gives, world frame (1/kg).
    mobility: Mat3,
}

impl FreeFlight {
    /// The step of `dt` (s), above zero, that led from `start` to `end`.
    pub fn between(start: &State, end: &State, dt: f64) -> Self {
        let [x, y, z, w] = start.orientation;
        let turned = rotation_vector(quat_mul(end.orientation, [-x, -y, -z, w]));
        Self {
            end: *end,
            velocity: scale(1.0 / dt, sub(end.position, start.position)),
            angular_velocity: scale(1.0 / dt, turned),
        }
    }

    /// Where the body is after the step if it meets nothing.
    pub fn end(&self) -> &State {
        &self.end
    }

    /// Mean velocity of the centre of mass over the step, world frame (m/s).
    pub fn velocity(&self) -> Vec3 {
        self.velocity
    }

    /// Mean angular velocity over the step, world frame (rad/s): its rotation vector over `dt`, of half a turn at most.
    pub fn angular_velocity(&self) -> Vec3 {
        self.angular_velocity
    }

    /// The state of a body that contacts have moved to `position` (centre of mass, m) and `orientation`, with the
    /// velocities that they left of [`FreeFlight::velocity`] and [`FreeFlight::angular_velocity`] (world frame).
    ///
    /// It has these and what the step would have gained over its mean velocities, but for a gain against what contacts did:
    /// a body at rest on the ground stays at rest.
    ///
    /// Of a body in a fluid `contact` is what the engine took for its mass. That is right along the normal; along the surface
    /// the body may be lighter, and what holds it up also holds it against the gain of the step. Both make friction larger
    /// than the engine knows: a coin on the bed of a tank has a third of the mass along the bed that it has towards it.
    /// Friction never turns a body back.
    #[must_use]
    pub fn met(
        &self,
        contact: Option<&ContactMass>,
        position: Vec3,
        orientation: Quat,
        velocity: Vec3,
        angular_velocity: Vec3,
    ) -> State {
        let end = self.end.world_velocity();
        let v = match contact {
            Some(contact) => contact.left(end, self.velocity, velocity),
            None => left(end, self.velocity, velocity),
        };
        let spin = self.end.world_angular_velocity();
        let omega = left(spin, self.angular_velocity, angular_velocity);
        let mut state = State {
            position,
            orientation,
            ..self.end
        };
        state.set_world_velocities(v, omega);
        state
    }
}

impl ContactMass {
    /// What contacts leave of a velocity that has this mean over a step and this one at its `end`, if they turn the mean into
    /// `solved`: that, the gain over the mean but for what pushes the body against the surface, and the friction that the
    /// engine left out.
    fn left(&self, end: Vec3, mean: Vec3, solved: Vec3) -> Vec3 {
        let (gain, change) = (sub(end, mean), sub(solved, mean));
        let push = dot(change, self.normal);
        let held = (-dot(gain, self.normal)).min(push).max(0.0);
        let velocity = add_scaled(add(solved, gain), held, self.normal);
        // The push that holds the body against the gain brings friction like that of the engine.
        let share = if held > 0.0 { held / push } else { 0.0 };
        let along = |a: Vec3| add_scaled(a, -dot(a, self.normal), self.normal);
        let friction = along(scale(self.mass, mat_vec(&self.mobility, change)));
        let more = sub(scale(1.0 + share, friction), along(change));
        let squared = dot(more, more);
        if squared == 0.0 {
            return velocity;
        }
        let until_it_stops = -dot(velocity, more) / squared;
        add_scaled(velocity, until_it_stops.clamp(0.0, 1.0), more)
    }
}

/// What contacts leave of a velocity that has this mean over a step and this one at its `end`, if they turn the mean into
/// `solved`: that, and of the gain over the mean what they do not act against.
fn left(end: Vec3, mean: Vec3, solved: Vec3) -> Vec3 {
    let (gain, change) = (sub(end, mean), sub(solved, mean));
    let squared = dot(gain, gain);
    let held = if squared > 0.0 {
        (-dot(gain, change) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    add_scaled(solved, 1.0 - held, gain)
}

impl Stepper {
    /// A step of `dt` (s) from `state` as [`Stepper::step`] takes it, for a host that moves the body itself.
    ///
    /// # Errors
    /// As [`Stepper::step`]; and a step of no length, which has no mean velocity.
    pub fn fly(&self, state: &State, dt: f64, input: &Input) -> Result<FreeFlight, StepError> {
        if dt == 0.0 {
            return Err(StepError::TimeStep(dt));
        }
        let mut end = *state;
        self.step(&mut end, dt, input)?;
        Ok(FreeFlight::between(state, &end, dt))
    }

    /// Mass and inertia of the body with the fluid that it moves, for a contact with a unit `normal` (world frame) while
    /// it has `orientation`.
    ///
    /// ```
    /// use langevin_rigid::{Body, Fluid, Settings, Stepper};
    /// // A coin in water is nearly twice as heavy flat as on edge.
    /// let coin = Body::disc(0.01, 0.0015, 2700.0)?;
    /// let stepper = Stepper::new(&coin, &Fluid::WATER, None, &Settings::default())?;
    /// let upright = [0.0, 0.0, 0.0, 1.0];
    /// let flat = stepper.contact_mass(upright, [0.0, 1.0, 0.0]).mass;
    /// let on_edge = stepper.contact_mass(upright, [1.0, 0.0, 0.0]).mass;
    /// assert!(flat > 1.5 * on_edge && on_edge > coin.mass);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn contact_mass(&self, orientation: Quat, normal: Vec3) -> ContactMass {
        let inverse = self.inverse_total_mass();
        let block = |k: usize| -> Mat3 {
            std::array::from_fn(|i| std::array::from_fn(|j| inverse[k + i][k + j]))
        };
        let turn = rotation_matrix(orientation);
        let mobility = turned(&turn, &block(0));
        ContactMass {
            mass: 1.0 / dot(normal, mat_vec(&mobility, normal)),
            // A block on the diagonal of a positive definite matrix is one too.
            inertia: invert_spd(&block(3)).unwrap_or_default(),
            normal,
            mobility,
        }
    }
}

/// A tensor of the body frame in the world frame.
fn turned(turn: &Mat3, tensor: &Mat3) -> Mat3 {
    let rows = turn.map(|row| mat_vec(tensor, row));
    turn.map(|row| rows.map(|column| dot(row, column)))
}

/// The rotation vector of a unit quaternion, no longer than half a turn.
fn rotation_vector([x, y, z, w]: Quat) -> Vec3 {
    let (axis, sign) = ([x, y, z], if w < 0.0 { -1.0 } else { 1.0 });
    let sine = norm(axis);
    let angle_over_sine = if sine < 1e-9 {
        2.0
    } else {
        2.0 * libm::atan2(sine, sign * w) / sine
    };
    scale(sign * angle_over_sine, axis)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;
    use crate::linalg::{quat_from_rotation_vector, rotate};
    use crate::{Body, Fluid, Settings};

    const DT: f64 = 1.0 / 60.0;

    fn leaf() -> Stepper {
        let body = Body::cuboid([0.03, 0.0002, 0.05], 400.0).unwrap();
        Stepper::new(&body, &Fluid::AIR, None, &Settings::default()).unwrap()
    }

    fn tumbling() -> State {
        let mut state = State {
            orientation: quat_from_rotation_vector([0.3, -1.2, 0.8]),
            ..State::default()
        };
        state.set_world_velocities([0.4, -1.0, 0.2], [3.0, 2.0, -9.0]);
        state
    }

    #[test]
    fn the_mean_velocities_take_a_body_where_the_step_does() {
        let (stepper, mut state) = (leaf(), tumbling());
        for _ in 0..50 {
            let flight = stepper.fly(&state, DT, &Input::default()).unwrap();
            let end = flight.end();
            let position = add(state.position, scale(DT, flight.velocity()));
            let turn = quat_from_rotation_vector(scale(DT, flight.angular_velocity()));
            let orientation = quat_mul(turn, state.orientation);
            let moved = flight.met(
                None,
                position,
                orientation,
                flight.velocity(),
                flight.angular_velocity(),
            );
            for axis in 0..3 {
                assert!((moved.position[axis] - end.position[axis]).abs() < 1e-12);
                assert!((moved.velocity[axis] - end.velocity[axis]).abs() < 1e-9);
                let unit = std::array::from_fn(|i| f64::from(u8::from(i == axis)));
                let apart = sub(rotate(orientation, unit), rotate(end.orientation, unit));
                assert!(norm(apart) < 1e-9, "{apart:?}");
            }
            assert_eq!(moved.step, end.step);
            state = *end;
        }
    }

    #[test]
    fn a_contact_that_stops_a_body_leaves_it_at_rest_and_one_aside_leaves_it_falling() {
        let state = State::default();
        let flight = leaf().fly(&state, DT, &Input::default()).unwrap();
        let (mean, spin) = (flight.velocity(), flight.angular_velocity());
        let after = |velocity| {
            let met = flight.met(None, state.position, state.orientation, velocity, spin);
            met.world_velocity()
        };
        // The ground takes all of the fall.
        assert!(norm(after([mean[0], 0.0, mean[2]])) < 1e-12);
        // It is thrown up from the ground.
        assert!((after([0.0, 0.5, 0.0])[1] - 0.5).abs() < 1e-12);
        // Friction stops its slide as well, and does not turn it back.
        let sliding = add(mean, [0.02, 0.0, 0.0]);
        let gain = sub(flight.end().world_velocity(), mean);
        let end = add(sliding, gain);
        assert!(norm(left(end, sliding, [0.0; 3])) < 1e-12);
        // A wall pushes it aside, and it falls on.
        let aside = after(add(mean, [0.3, 0.0, 0.0]));
        let end = flight.end().world_velocity();
        assert!((aside[1] - end[1]).abs() < 1e-12 && (aside[0] - end[0] - 0.3).abs() < 1e-12);
    }

    #[test]
    fn a_step_of_no_length_and_a_state_that_is_no_number_are_told() {
        let stepper = leaf();
        let error = |state, dt| stepper.fly(&state, dt, &Input::default()).unwrap_err();
        assert_eq!(error(tumbling(), 0.0), StepError::TimeStep(0.0));
        let mut lost = tumbling();
        lost.position[1] = f64::NAN;
        assert!(matches!(error(lost, DT), StepError::State { .. }));
    }

    #[test]
    fn an_impulse_along_the_normal_divides_by_the_contact_mass() {
        let (stepper, state) = (leaf(), tumbling());
        let normal = scale(1.0 / 3.0, [1.0, 2.0, -2.0]);
        let contact = stepper.contact_mass(state.orientation, normal);
        // A short, strong push, beside which the fluid and the weight are nothing.
        let (dt, impulse) = (1e-9, 1e-4);
        let input = Input {
            wrench: crate::Wrench {
                force: scale(impulse / dt, normal),
                ..Default::default()
            },
            ..Input::default()
        };
        let mut pushed = state;
        stepper.step(&mut pushed, dt, &input).unwrap();
        let gained = dot(sub(pushed.world_velocity(), state.world_velocity()), normal);
        assert!((gained * contact.mass / impulse - 1.0).abs() < 1e-6);
    }

    #[test]
    fn friction_slows_a_body_by_its_mass_along_the_surface_and_by_all_that_holds_it() {
        let coin = Body::disc(0.0125, 0.00175, 2700.0).unwrap();
        let settings = Settings {
            model: crate::Model::Kirchhoff,
            ..Settings::default()
        };
        let stepper = Stepper::new(&coin, &Fluid::WATER, None, &settings).unwrap();
        // It lies flat on a bed, and slides along it, too slowly for the couple of its added mass to lift it.
        let speed = 0.06;
        let (normal, along) = ([0.0, 1.0, 0.0], [0.6, 0.0, 0.8]);
        let mut state = State::default();
        state.set_world_velocities(scale(speed, along), [0.0; 3]);
        let contact = stepper.contact_mass(state.orientation, normal);
        let light = stepper.contact_mass(state.orientation, along).mass;
        assert!(contact.mass > 1.5 * light);
        let flight = stepper.fly(&state, DT, &Input::default()).unwrap();
        let weight = 9.81 * (coin.mass - Fluid::WATER.density * coin.volume);
        let mu = 0.3;
        // The engine holds it against the mean velocity towards the bed, with friction.
        let push = -dot(flight.velocity(), normal);
        let solved = add_scaled(flight.velocity(), push, normal);
        let solved = add_scaled(solved, -mu * push, along);
        let after = |before: &FreeFlight, solved| {
            let met = before.met(
                Some(&contact),
                state.position,
                state.orientation,
                solved,
                [0.0; 3],
            );
            met.world_velocity()
        };
        // Coulomb: mu times the weight in water over the step, on the mass along the bed.
        let expected = scale(speed - mu * weight * DT / light, along);
        let slower = after(&flight, solved);
        assert!(
            norm(sub(slower, expected)) < 0.01 * norm(sub(scale(speed, along), expected)),
            "{slower:?} {expected:?}"
        );
        // What friction has stopped stays so; what more of it would turn back, it stops.
        assert!(norm(after(&flight, [0.0; 3])) < 1e-3);
        assert!(norm(after(&flight, scale(1e-3, along))) < 1e-3);
        // A push along the normal alone brings no friction.
        let held = add_scaled(flight.velocity(), push, normal);
        assert!(norm(sub(after(&flight, held), scale(speed, along))) < 1e-3);
    }

    #[test]
    fn the_inertia_is_that_of_body_and_fluid() {
        let stepper = leaf();
        let inertia = stepper
            .contact_mass([0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0])
            .inertia;
        let total = stepper.total_mass();
        for i in 0..3 {
            // Symmetric about its centre: nothing couples turning to moving.
            assert!((inertia[i][i] / total[3 + i][3 + i] - 1.0).abs() < 1e-9);
        }
        assert!(inertia[0][0] > 1.05 * leaf_alone());
    }

    /// Moment of inertia about x of the leaf without air (kg m^2).
    fn leaf_alone() -> f64 {
        let body = Body::cuboid([0.03, 0.0002, 0.05], 400.0).unwrap();
        body.inertia[0][0]
    }
}
