//! Thousands of bodies that fall without end: one that reaches the ground begins again at the top.

use langevin_rigid::linalg::Vec3;
use langevin_rigid::{Batch, Settings, SetupError, Stepper};
use langevin_rigid_scenes::baking::settings;
use langevin_rigid_scenes::scene::Scene;
use langevin_rigid_scenes::together::anywhere;

use crate::session::Session;

/// They are seen from afar: their steps are as coarse as can be.
const LONGEST_PART: f64 = 1.6;

/// Horizontal room of a body, in squares of its length.
const ROOM: f64 = 3.0;

/// Bodies under way in a box that stands on the ground. They meet the fluid and its wind, not each other.
#[derive(Debug)]
pub struct Many {
    stepper: Stepper,
    batch: Batch<f32>,
    /// Number of the release of each.
    releases: Vec<u32>,
    poses: Vec<f32>,
    /// Centre of the box at the height of the top, its sides, and the height of the ground (m).
    top: Vec3,
    over: Vec3,
    ground: f64,
}

impl Many {
    /// So many of the scene's own bodies, anywhere between its release and the ground (3 m below where there is none).
    ///
    /// # Errors
    /// [`SetupError`], for settings that are none.
    pub fn new(session: &Session, count: u32) -> Result<Self, SetupError> {
        let (scene, body) = (session.prepared().scene(), session.prepared().body());
        let top = scene.release.position;
        let ground = scene.stop.ground.filter(|ground| *ground < top[1]);
        let ground = ground.unwrap_or(top[1] - 3.0);
        let side = (ROOM * f64::from(count)).sqrt() * 2.0 * body.half_extents[0];
        // The poorest seat is taken: all heights as likely.
        let height = top[1] - ground;
        let over = [side, height, side];
        let settings = Settings {
            longest_part: LONGEST_PART,
            ..settings(scene)
        };
        let history = session.prepared().baked().bake.history.as_ref();
        let mut many = Self {
            stepper: Stepper::new(body, &scene.fluid, history, &settings)?,
            batch: Batch::new(scene.seed),
            releases: (0..count).collect(),
            poses: Vec::new(),
            top,
            over,
            ground,
        };
        for release in 0..count {
            let mut state = anywhere(scene, over, release);
            state.position[1] -= 0.5 * height;
            many.batch.push(&state);
        }
        many.place();
        Ok(many)
    }

    /// Sides of the box (m), and its middle on the ground.
    pub fn room(&self) -> [Vec3; 2] {
        [self.over, [self.top[0], self.ground, self.top[2]]]
    }

    /// Moves them on by a frame of `duration` (s).
    pub fn advance(&mut self, session: &Session, duration: f64) {
        let wind = session.prepared().wind();
        let stuck = self
            .stepper
            .step_batch_in(&mut self.batch, duration, wind, 0.0);
        // One that cannot go on stays where it is and begins again.
        for body in stuck.err().into_iter().flat_map(|error| error.bodies) {
            self.begin(session.prepared().scene(), body as usize);
        }
        for body in 0..self.batch.len() {
            let state = self.batch.state(body);
            if state.is_some_and(|state| state.position[1] < self.ground) {
                self.begin(session.prepared().scene(), body);
            }
        }
        self.place();
    }

    /// Begins again at the top.
    fn begin(&mut self, scene: &Scene, body: usize) {
        let Some(before) = self.batch.state(body) else {
            return;
        };
        self.releases[body] = self.releases[body].wrapping_add(self.batch.len() as u32);
        let mut state = anywhere(scene, self.over, self.releases[body]);
        state.position[1] = self.top[1];
        // Its time and its noise go on.
        (state.time, state.step) = (before.time, before.step);
        self.batch.set(body, &state);
    }

    fn place(&mut self) {
        self.poses.clear();
        for body in 0..self.batch.len() {
            let state = self.batch.state(body).unwrap_or_default();
            self.poses.extend(state.position.map(|x| x as f32));
            self.poses.extend(state.orientation.map(|x| x as f32));
        }
    }

    /// Position (m) and orientation (x, y, z, w) of each, world frame.
    pub fn poses(&self) -> &[f32] {
        &self.poses
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_stay_in_their_box_and_begin_again() {
        let text = r#"
            fluid.preset = "air"
            body = { shape = "box", size = [0.05, 0.0005, 0.05], triangles = 80, density = 500.0 }
            release = { position = [1.0, 2.0, 0.0] }
            run = { time_step = 0.002, duration = 10.0, ground = 0.5 }
        "#;
        let session = Session::open("card", text, None, &()).unwrap();
        let mut many = Many::new(&session, 100).unwrap();
        for _ in 0..240 {
            many.advance(&session, 1.0 / 60.0);
        }
        assert_eq!(many.poses().len(), 700);
        for pose in many.poses().chunks(7) {
            assert!((0.5..=2.01).contains(&pose[1]), "{pose:?}");
        }
        // In 4 s all of them came down once.
        assert!(many.releases.iter().all(|release| *release >= 100));
    }
}
