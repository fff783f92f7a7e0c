//! Bodies, obstacles and wind, and the steps of all of them.

mod impulses;
mod near;
mod overlap;
mod rest;
mod solve;

use std::sync::Arc;

use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::norm;
use langevin_rigid::wind::Wind;
use langevin_rigid::{Input, NoiseStream, State, StepError};
use parry3d_f64::math::Pose;
use rayon::prelude::*;

use self::impulses::Impulses;
pub use self::overlap::Overlap;
use crate::kind::Kind;
use crate::obstacle::{Obstacle, pose};
use crate::sleep::Rest;
use crate::water::WaterSurface;

/// Bodies in a fluid that meet obstacles and each other.
///
/// A step moves every body by its own [`Stepper`](langevin_rigid::Stepper), under the wind, and then gives impulses where bodies would enter
/// others: against the full 6x6 mass of body and fluid, with Coulomb's friction, Newton's restitution and no gain of
/// energy. Bodies that have come to rest sleep until they are disturbed.
///
/// The same bodies, added in the same order, have the same bits on any number of threads.
///
/// ```
/// use std::sync::Arc;
/// use langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};
/// use langevin_rigid_world::{Kind, Material, Obstacle, Shape, World};
///
/// let card = Body::plate(0.09, 0.06, 0.003, 700.0)?;
/// let stepper = Stepper::new(&card, &Fluid::AIR, None, &Settings::default())?;
/// let shape = Shape::cuboid([0.045, 0.0015, 0.03])?;
/// let kind = Arc::new(Kind::new(stepper, shape, Material::default())?);
///
/// let mut world = World::new([0.0, -9.81, 0.0]);
/// world.add_obstacle(Obstacle::half_space([0.0, 1.0, 0.0], 0.0, Material::default())?);
/// let noise = NoiseStream { seed: 1, body: 0 };
/// world.add(kind, State { position: [0.0, 0.3, 0.0], ..State::default() }, noise);
/// while !world.is_asleep(0) && world.time() < 10.0 {
///     world.step(0.002)?;
/// }
/// assert!((world.state(0).position[1] - 0.0015).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct World {
    gravity: f64,
    time: f64,
    wind: Wind,
    stream: Vec3,
    water: Option<WaterSurface>,
    obstacles: Vec<Obstacle>,
    members: Vec<Member>,
    /// Of the last step.
    impulses: Impulses,
}

#[derive(Debug, Clone)]
struct Member {
    kind: Arc<Kind>,
    state: State,
    noise: NoiseStream,
    rest: Rest,
}

/// Why a step was not taken. No body has moved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("body {body}: {error}")]
pub struct WorldError {
    /// Number of the body.
    pub body: usize,
    /// Why it could not step.
    pub error: StepError,
}

impl World {
    /// An empty world with this gravity (m/s^2), which must be that of the steppers of its bodies.
    pub fn new(gravity: Vec3) -> Self {
        Self {
            gravity: norm(gravity),
            time: 0.0,
            wind: Wind::default(),
            stream: [0.0; 3],
            water: None,
            obstacles: Vec::new(),
            members: Vec::new(),
            impulses: Impulses::default(),
        }
    }

    /// Sets the wind, on top of the velocity `stream` (m/s) of the fluid that the steppers have.
    pub fn set_wind(&mut self, wind: Wind, stream: Vec3) {
        (self.wind, self.stream) = (wind, stream);
    }

    /// Sets the surface of the water, for the bodies whose [kind](Kind::between) is made for two fluids.
    pub fn set_water(&mut self, surface: WaterSurface) {
        self.water = Some(surface);
    }

    /// The surface of the water.
    pub fn water(&self) -> Option<&WaterSurface> {
        self.water.as_ref()
    }

    /// Adds what does not move.
    pub fn add_obstacle(&mut self, obstacle: Obstacle) {
        self.obstacles.push(obstacle);
    }

    /// Adds a body, whose number this gives: 0, 1, 2, ... Its `state.time` becomes the world's.
    pub fn add(&mut self, kind: Arc<Kind>, state: State, noise: NoiseStream) -> usize {
        self.members.push(Member {
            kind,
            state: State {
                time: self.time,
                ..state
            },
            noise,
            rest: Rest::default(),
        });
        self.members.len() - 1
    }

    /// Sets the clock (s) of a world without bodies.
    pub fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    /// Time since the begin (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// How many bodies there are.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// Whether there is no body.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// The state of a body.
    pub fn state(&self, body: usize) -> &State {
        &self.members[body].state
    }

    /// What a body shares with others of its kind.
    pub fn kind(&self, body: usize) -> &Arc<Kind> {
        &self.members[body].kind
    }

    /// Moves a body, and wakes it.
    pub fn set_state(&mut self, body: usize, state: &State) {
        self.wake(body);
        self.members[body].state = State {
            time: self.time,
            ..*state
        };
    }

    /// Whether a body has come to rest.
    pub fn is_asleep(&self, body: usize) -> bool {
        self.members[body].rest.is_asleep()
    }

    /// Whether a body has stayed where it is for a second, asleep on others or afloat.
    pub fn is_still(&self, body: usize) -> bool {
        self.members[body].rest.is_still(1.0)
    }

    /// Wakes a body; those that sleep against it wake when it moves.
    pub fn wake(&mut self, body: usize) {
        self.members[body].rest.wake();
    }

    /// Advances all bodies that are awake by `dt` (s).
    ///
    /// # Errors
    /// [`WorldError`], with all bodies as they were.
    pub fn step(&mut self, dt: f64) -> Result<(), WorldError> {
        self.wake_the_blown();
        let met = loop {
            let met = self.meet(dt);
            if !self.wake_the_hit(&met, dt) {
                break met;
            }
        };
        let free = self.free_step(dt)?;
        let solved = self.solve(free, &met, dt);
        self.settle(solved, dt);
        self.time += dt;
        Ok(())
    }

    /// The states of all after a step without contact.
    fn free_step(&self, dt: f64) -> Result<Vec<State>, WorldError> {
        let results: Vec<Result<State, WorldError>> = self
            .members
            .par_iter()
            .enumerate()
            .with_min_len(16)
            .map(|(body, member)| {
                let mut state = member.state;
                if member.rest.is_asleep() {
                    state.time += dt;
                    state.step += 1;
                    return Ok(state);
                }
                let mut input = Input::with_noise(member.noise);
                let wind = member.kind.wind().unwrap_or(&self.wind);
                if !wind.is_empty() {
                    input.flow = wind.flow(state.position, state.time, self.stream);
                }
                match member
                    .kind
                    .step(&mut state, dt, &input, self.water.as_ref())
                {
                    Ok(()) => Ok(state),
                    Err(error) => Err(WorldError { body, error }),
                }
            })
            .collect();
        results.into_iter().collect()
    }
}

fn placed(state: &State) -> Pose {
    pose(state.position, state.orientation)
}
