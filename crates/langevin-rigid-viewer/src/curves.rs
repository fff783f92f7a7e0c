//! What a body did, as numbers over time, and the loads on it by cause.

use langevin_rigid::linalg::rotate;
use langevin_rigid::linalg::vector::{dot, norm};
use langevin_rigid::{Input, Loads, State, falling_speed};
use langevin_rigid_scenes::advance::input;
use langevin_rigid_scenes::prepared::Release;

use crate::run::Run;
use crate::session::Session;

/// A body that is slower than this share of its falling speed has no direction.
const RESTING: f64 = 1e-2;

/// Numbers of a body at each frame of its run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curves {
    /// Speed of the centre of mass (m/s).
    pub speed: Vec<f32>,
    /// Angle between the body's y axis and the vertical (degrees), 0 to 180.
    pub tilt: Vec<f32>,
    /// Turns a second.
    pub spin: Vec<f32>,
    /// Kinetic energy of body and fluid, relative to the undisturbed fluid, and potential energy above the lowest place of the
    /// run (J); NaN in a scene with water, into which bodies dip.
    pub energy: Vec<f32>,
    /// Attachment of the flow, 0 to 1; NaN in models without it, in a scene with water, and of a body that hardly moves.
    pub attachment: Vec<f32>,
}

/// Names of the [loads](Loads), in the order of [`Session::loads`].
pub fn causes() -> Vec<&'static str> {
    let causes = Loads::default().causes();
    causes.iter().map(|(name, _)| *name).collect()
}

impl Session {
    pub(crate) fn input(&self, state: &State) -> Input {
        let release: Release = self.prepared().release(0);
        input(self.prepared(), &release, state)
    }

    /// What the only body of a run did; empty of several.
    pub fn curves(&self, run: &Run) -> Curves {
        let (stepper, scene) = (self.prepared().stepper(), self.prepared().scene());
        let body = self.prepared().body();
        let gravity = scene.settings.gravity;
        // What gravity pulls at: mass less that of the displaced fluid.
        let heavy = body.mass - scene.fluid.density * body.volume;
        let height = |state: &State| -dot(gravity, state.position);
        let lowest = run
            .states()
            .iter()
            .map(height)
            .fold(f64::INFINITY, f64::min);
        let up = match norm(gravity) {
            pull if pull > 0.0 => gravity.map(|g| -g / pull),
            _ => [0.0, 1.0, 0.0],
        };
        let falls = falling_speed(body, &scene.fluid, gravity);
        let mut curves = Curves::default();
        for state in run.states() {
            let kinetic = match self.has_water() {
                true => f64::NAN,
                false => stepper.kinetic_energy(state),
            };
            let axis = rotate(state.orientation, [0.0, 1.0, 0.0]);
            let tilt = dot(axis, up).clamp(-1.0, 1.0).acos().to_degrees();
            let input = self.input(state);
            let [through, _] = stepper.relative_velocities(state, &input);
            let told = !self.has_water() && norm(through) > RESTING * falls;
            let attachment = told.then(|| stepper.attachment(state, &input)).flatten();
            let turns = norm(state.angular_velocity) / std::f64::consts::TAU;
            curves.speed.push(norm(state.velocity) as f32);
            curves.tilt.push(tilt as f32);
            curves.spin.push(turns as f32);
            let potential = heavy * (height(state) - lowest);
            curves.energy.push((kinetic + potential) as f32);
            curves
                .attachment
                .push(attachment.unwrap_or(f64::NAN) as f32);
        }
        curves
    }

    /// Whether bodies dip into water: their loads are then not those of their stepper.
    fn has_water(&self) -> bool {
        self.prepared().scene().water.is_some()
    }

    /// The loads on the only body of a run at each frame: for each of the [`causes`] force (N) and torque (N m) about the
    /// centre of mass, world frame. What obstacles push with is not among them; empty in a scene with water.
    pub fn loads(&self, run: &Run) -> Vec<f32> {
        if self.has_water() {
            return Vec::new();
        }
        let stepper = self.prepared().stepper();
        let mut numbers = Vec::new();
        for state in run.states() {
            let loads = stepper.loads(state, &self.input(state));
            for (_, wrench) in loads.causes() {
                numbers.extend(wrench.force.map(|x| x as f32));
                numbers.extend(wrench.torque.map(|x| x as f32));
            }
        }
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn card(more: &str) -> Session {
        let text = format!(
            r#"
            fluid.preset = "air"
            body = {{ shape = "box", size = [0.05, 0.001, 0.05], triangles = 80, density = 500.0 }}
            release = {{ position = [0.0, 2.0, 0.0], tilt = 30.0, velocity = [0.5, 0.0, 0.0] }}
            {more}
            "#
        );
        Session::open("card", &text, None, &()).unwrap()
    }

    #[test]
    fn what_nothing_resists_keeps_its_energy() {
        let session = card(r#"run = { time_step = 0.001, duration = 0.3, model = "kirchhoff" }"#);
        let run = session.drop(&()).unwrap();
        let curves = session.curves(&run);
        assert_eq!(curves.energy.len(), 301);
        for energy in &curves.energy {
            assert!((energy / curves.energy[0] - 1.0).abs() < 1e-5, "{energy}");
        }
        assert!((curves.tilt[0] - 30.0).abs() < 1e-3 && (curves.speed[0] - 0.5).abs() < 1e-6);
        assert!(curves.attachment.iter().all(|a| a.is_nan()));
    }

    #[test]
    fn loads_are_those_of_the_frames() {
        let session = card(r#"run = { time_step = 0.001, duration = 0.3 }"#);
        let run = session.drop(&()).unwrap();
        let loads = session.loads(&run);
        let causes = causes();
        assert_eq!(loads.len(), run.states().len() * causes.len() * 6);
        // Weight is the same at every frame, drag grows.
        let of = |cause: &str, frame: usize| {
            let place = causes.iter().position(|name| *name == cause).unwrap();
            let first = (frame * causes.len() + place) * 6;
            loads[first..first + 3]
                .iter()
                .map(|x| x * x)
                .sum::<f32>()
                .sqrt()
        };
        let weight = 9.81 * 0.05f32 * 0.001 * 0.05 * 500.0;
        for frame in [0, 300] {
            assert!((of("weight", frame) / weight - 1.0).abs() < 1e-3);
        }
        assert!(of("drag", 300) > of("drag", 0));
    }

    #[test]
    fn in_water_there_are_no_loads_of_air() {
        let session = card(
            r#"
            run = { time_step = 0.002, duration = 0.2 }
            water = { level = 0.0 }
            "#,
        );
        let run = session.drop(&()).unwrap();
        assert!(session.loads(&run).is_empty());
        assert!(session.curves(&run).energy.iter().all(|e| e.is_nan()));
    }
}
