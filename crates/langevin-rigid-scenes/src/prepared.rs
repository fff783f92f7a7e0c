//! A scene made ready, and the loop that drops its body.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{add, scale};
use langevin_rigid::wind::Wind;
use langevin_rigid::{
    Body, BodyError, Ending, Fluid, Hull, NoiseStream, SetupError, State, StepError, Stepper, run,
};
use langevin_rigid_bake::progress::{Progress, Silent};
use langevin_rigid_formats::budget;
use langevin_rigid_formats::export::RecordedBody;
use langevin_rigid_formats::track::Pose;
use langevin_rigid_formats::trajectory::Trajectory;
use rayon::prelude::*;

use crate::advance::advance;
use crate::baking::{Baked, SceneBakeError, bake_scene, stepper};
use crate::ensemble::{Change, side_by_side};
use crate::scene::{Scene, SceneWindError};
use crate::together::{Surroundings, SurroundingsError, TogetherError};

/// A scene with its bake, its stepper and the hull that touches the ground: all that a run needs.
///
/// ```
/// use langevin_rigid_scenes::{prepared::Prepared, scene::Scene};
/// let scene = Scene::parse("ball", "ball.toml", r#"
///     fluid.preset = "water"
///     run = { time_step = 0.002, duration = 0.5 }
///     body = { shape = "ellipsoid", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 1100.0 }
/// "#)?;
/// let ball = Prepared::new(scene, None, &())?;
/// let fall = ball.drop(&ball.release(0), &());
/// assert_eq!(fall.states.len(), 251); // the release, and 250 steps
/// assert!(fall.states[250].position[1] < 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Prepared {
    scene: Scene,
    baked: Arc<Baked>,
    stepper: Stepper,
    wind: Wind,
    hull: Hull,
    /// What bodies meet, in a scene where they meet anything.
    surroundings: Option<Arc<Surroundings>>,
}

/// Why a scene could not be made ready.
#[derive(Debug, thiserror::Error)]
pub enum PrepareError {
    /// It could not be baked.
    #[error(transparent)]
    Bake(#[from] SceneBakeError),
    /// A body of that mass cannot be.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// Body, fluid and settings do not go together.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Its wind is none.
    #[error(transparent)]
    Wind(#[from] SceneWindError),
    /// What its bodies meet is none.
    #[error(transparent)]
    Surroundings(#[from] SurroundingsError),
}

/// Why a run would be none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReleaseError {
    /// It would end before it begins.
    #[error(
        "the body already touches the ground at release (its lowest point is at {lowest:.4} m, the ground at \
         {ground} m); release it higher"
    )]
    OnGround {
        /// Height of the lowest point at release (m).
        lowest: f64,
        /// Height of the ground (m).
        ground: f64,
    },
    /// It might never end.
    #[error(
        "the body is no heavier than the fluid and may never reach the ground; give the run a duration \
         (`--duration S`, or `duration` under [run])"
    )]
    Floats,
}

/// Where a run begins, and its noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Release {
    /// The first state.
    pub state: State,
    /// The stream of the run.
    pub noise: NoiseStream,
}

/// What a body did, from its release to how it ended.
#[derive(Debug, Clone)]
pub struct Fall {
    /// Number of the body: that of its noise.
    pub body: u32,
    /// Its kind, in a [crowd](crate::scene::Crowd) of several.
    pub kind: usize,
    /// Its size, as a multiple of its kind's.
    pub scale: f64,
    /// The release, and the state after each step.
    pub states: Vec<State>,
    /// How it ended; [`Ending::Stopped`] where it was cancelled or `full`.
    pub ended: Result<Ending, StepError>,
    /// Whether it was stopped because no more states were to be kept.
    pub full: bool,
}

impl Fall {
    /// How it ended, in a word: ground, time, rest, memory, interrupted or diverged.
    pub fn ending(&self) -> &'static str {
        match self.ended {
            Ok(Ending::Ground) => "ground",
            Ok(Ending::Time) => "time",
            Ok(Ending::Rest) => "rest",
            Ok(Ending::Stopped) if self.full => "memory",
            Ok(Ending::Stopped) => "interrupted",
            Err(_) => "diverged",
        }
    }

    /// Where it went.
    pub fn trajectory(&self) -> Trajectory {
        Trajectory::new(self.body, &self.states)
    }

    /// Itself for exports and pictures; `trajectory` is its own.
    pub fn recorded<'a>(&self, trajectory: &'a Trajectory) -> RecordedBody<'a> {
        RecordedBody {
            kind: self.kind,
            scale: self.scale,
            trajectory,
        }
    }
}

/// Memory of a state that is kept (bytes): itself, in a list that grows, and its row in a trajectory and in a table.
pub const STATE_MEMORY: usize =
    2 * size_of::<State>() + size_of::<Pose>() + 2 * size_of::<Vec3>() + 220;

impl Prepared {
    /// Drops so many bodies and keeps as many of their states as there is memory for: together where the scene is a
    /// [world](Scene::is_world), else side by side.
    ///
    /// # Errors
    /// As [`Prepared::drop_together`].
    pub fn drop_bodies(
        &self,
        bodies: u32,
        progress: &dyn Progress,
    ) -> Result<Vec<Fall>, TogetherError> {
        let most = budget::spare() / STATE_MEMORY as u64;
        let most = |share: u64| usize::try_from(most / share).unwrap_or(usize::MAX);
        match self.surroundings() {
            Some(_) => self.drop_together(bodies, most(1), progress),
            None => Ok(self.drop_side_by_side(bodies, most(u64::from(bodies)), progress)),
        }
    }

    /// Drops so many bodies on all cores and keeps their states, `most` of them for each body; without those that had not
    /// begun when `progress` cancelled.
    pub fn drop_side_by_side(
        &self,
        bodies: u32,
        most: usize,
        progress: &dyn Progress,
    ) -> Vec<Fall> {
        if bodies == 1 {
            return vec![self.drop_within(&self.release(0), most, progress)];
        }
        let done = AtomicU32::new(0);
        let falls: Vec<Option<Fall>> = (0..bodies)
            .into_par_iter()
            .with_max_len(1)
            .map(|body| {
                if body > 0 && progress.cancelled() {
                    return None;
                }
                let fall = self.drop_within(&self.release(body), most, &Silent(progress));
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress.report("simulating", f64::from(done) / f64::from(bodies));
                Some(fall)
            })
            .collect();
        falls.into_iter().flatten().collect()
    }
}

/// Steps between two looks at whether to go on.
const PATIENCE: u64 = 256;
/// Steps between two reports.
const REPORTED: u64 = 4096;

impl Prepared {
    /// Bakes `scene`, or takes its bake from the folder `cache`, and makes it ready.
    ///
    /// # Errors
    /// [`PrepareError`].
    pub fn new(
        scene: Scene,
        cache: Option<&Path>,
        progress: &dyn Progress,
    ) -> Result<Self, PrepareError> {
        let baked = bake_scene(&scene, cache, progress)?;
        Self::with_bake(scene, Arc::new(baked), cache, progress)
    }

    /// From a bake that is there: the scene's own, or that of a scene of the same body whose turbulence serves both.
    ///
    /// # Errors
    /// [`PrepareError`].
    pub fn of(scene: Scene, baked: Arc<Baked>) -> Result<Self, PrepareError> {
        Self::with_bake(scene, baked, None, &())
    }

    /// The same; the bodies of other scenes in its crowd are baked, or taken from the folder `cache`.
    ///
    /// # Errors
    /// [`PrepareError`].
    pub fn with_bake(
        scene: Scene,
        baked: Arc<Baked>,
        cache: Option<&Path>,
        progress: &dyn Progress,
    ) -> Result<Self, PrepareError> {
        let surroundings = scene
            .is_world()
            .then(|| Surroundings::new(&scene, &baked, cache, progress));
        Ok(Self {
            surroundings: surroundings.transpose()?.map(Arc::new),
            stepper: stepper(&scene, &baked.bake)?,
            wind: scene.make_wind()?,
            hull: Hull::new(&baked.bake.body.surface.vertices),
            scene,
            baked,
        })
    }

    /// The same with another size, mass or fluid. What does not depend on these is not made again; the bake's turbulence
    /// history stays as it is.
    ///
    /// # Errors
    /// [`PrepareError`], for a body that cannot be.
    pub fn changed(&self, change: &Change) -> Result<Self, PrepareError> {
        let mut scene = self.scene.clone();
        // Others that would be let go with it.
        scene.crowd = None;
        scene.fluid = Fluid {
            density: change.density.unwrap_or(scene.fluid.density),
            viscosity: change.viscosity.unwrap_or(scene.fluid.viscosity),
            velocity: change.wind.unwrap_or(scene.fluid.velocity),
        };
        let mut baked = Arc::clone(&self.baked);
        if change.size.is_some() || change.mass.is_some() {
            let mut body = baked.bake.body.scaled(change.size.unwrap_or(1.0));
            if let Some(mass) = change.mass {
                let inertia = body.inertia.map(|row| row.map(|x| x * (mass / body.mass)));
                body = body.with_mass_properties(mass, [0.0; 3], inertia)?;
            }
            Arc::make_mut(&mut baked).bake.body = body;
        }
        let surroundings = self.surroundings.as_ref();
        let surroundings = surroundings.map(|_| Surroundings::new(&scene, &baked, None, &()));
        Ok(Self {
            surroundings: surroundings.transpose()?.map(Arc::new),
            stepper: stepper(&scene, &baked.bake)?,
            wind: self.wind.clone(),
            hull: Hull::new(&baked.bake.body.surface.vertices),
            scene,
            baked,
        })
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Its bake, and how it was come by.
    pub fn baked(&self) -> &Arc<Baked> {
        &self.baked
    }

    /// The kinds of its bodies with their bakes, its own first.
    pub fn kinds(&self) -> impl Iterator<Item = (&Scene, &Arc<Baked>)> {
        let own = (&self.scene, &self.baked);
        let others = self
            .surroundings()
            .and_then(|surroundings| surroundings.kinds().get(1..));
        let others = others.into_iter().flatten();
        std::iter::once(own).chain(others.map(|kind| (&kind.scene, &kind.baked)))
    }

    /// Its body.
    pub fn body(&self) -> &Body {
        &self.baked.bake.body
    }

    /// Its stepper.
    pub fn stepper(&self) -> &Stepper {
        &self.stepper
    }

    /// Its wind.
    pub fn wind(&self) -> &Wind {
        &self.wind
    }

    /// Whether its fluid is at rest everywhere.
    pub fn is_still(&self) -> bool {
        self.wind.is_empty() && self.scene.fluid.velocity == [0.0; 3]
    }

    /// Mean velocity of the fluid at a place (m, world frame) between two times (s), m/s: for a picture of it.
    pub fn mean_flow(&self, place: Vec3, [from, to]: [f64; 2]) -> Vec3 {
        const MOMENTS: u32 = 16;
        let stream = self.scene.fluid.velocity;
        let winds = (0..MOMENTS).map(|moment| {
            let share = (f64::from(moment) + 0.5) / f64::from(MOMENTS);
            let time = from + share * (to - from);
            self.wind.flow(place, time, stream).velocity
        });
        let sum = winds.fold([0.0; 3], add);
        add(stream, scale(1.0 / f64::from(MOMENTS), sum))
    }

    /// What its bodies meet, if the scene is a [world](Scene::is_world).
    pub fn surroundings(&self) -> Option<&Surroundings> {
        self.surroundings.as_deref()
    }

    /// What touches the ground.
    pub fn hull(&self) -> &Hull {
        &self.hull
    }

    /// Refuses a run that ends before it begins, or never.
    ///
    /// # Errors
    /// [`ReleaseError`].
    pub fn check_release(&self) -> Result<(), ReleaseError> {
        let Some(ground) = self.scene.stop.ground else {
            return Ok(());
        };
        let lowest = self.hull.lowest(&self.scene.release);
        if lowest <= ground {
            return Err(ReleaseError::OnGround { lowest, ground });
        }
        if self.surroundings.is_some() {
            return Ok(());
        }
        let body = self.body();
        let floats = body.mass <= self.scene.fluid.density * body.volume;
        if self.scene.stop.time.is_none() && floats {
            return Err(ReleaseError::Floats);
        }
        Ok(())
    }

    /// The release of body `number` among many that fall side by side; body 0 has the scene's own, with the stream of noise
    /// that the scene names.
    pub fn release(&self, number: u32) -> Release {
        Release {
            state: side_by_side(&self.scene, self.body(), number),
            noise: NoiseStream {
                seed: self.scene.seed,
                body: self.scene.stream.wrapping_add(number),
            },
        }
    }

    /// Follows a body from `release` to its end, showing each state after the first to `observe`.
    ///
    /// # Errors
    /// [`StepError`] where a step failed; all states until then were shown.
    pub fn follow(
        &self,
        release: &Release,
        observe: impl FnMut(&State) -> ControlFlow<()>,
    ) -> Result<Ending, StepError> {
        let mut state = release.state;
        run(
            |state| advance(self, release, state),
            &mut state,
            self.scene.time_step,
            &self.hull,
            &self.scene.stop,
            observe,
        )
    }

    /// Drops a body and keeps its states. `progress` hears how far it is, and may cancel.
    pub fn drop(&self, release: &Release, progress: &dyn Progress) -> Fall {
        self.drop_within(release, usize::MAX, progress)
    }

    /// The same, keeping so many states at most.
    pub fn drop_within(&self, release: &Release, most: usize, progress: &dyn Progress) -> Fall {
        let mut states = vec![release.state];
        let ended = self.follow(release, |state| {
            states.push(*state);
            if state.step.is_multiple_of(REPORTED) {
                progress.report("simulating", self.fraction(release, state));
            }
            let asked = state.step.is_multiple_of(PATIENCE) && progress.cancelled();
            if asked || states.len() >= most {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        Fall {
            body: release.noise.body,
            kind: 0,
            scale: 1.0,
            full: states.len() >= most,
            states,
            ended,
        }
    }

    /// How much of the run is over, of its time or its way.
    fn fraction(&self, release: &Release, state: &State) -> f64 {
        let stop = &self.scene.stop;
        let of_time = stop.time.map_or(0.0, |end| state.time / end);
        let of_way = stop.ground.map_or(0.0, |ground| {
            let start = release.state.position[1];
            (start - state.position[1]) / (start - ground)
        });
        of_time.max(of_way)
    }
}
