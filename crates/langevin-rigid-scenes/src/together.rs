//! Bodies that touch, float, and are many: the run of a scene that is a [world](Scene::is_world).

mod crowd;
mod surroundings;

use std::sync::Arc;

use langevin_rigid::{Ending, NoiseStream, State};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_world::{Kind, Overlap, World};

use crate::ensemble::side_by_side;
use crate::prepared::{Fall, Prepared};
use crate::scene::Scene;
pub use crowd::anywhere;
pub use surroundings::{CrowdBody, Surroundings, SurroundingsError};

/// Of many bodies the states are kept so often (Hz): several of any frame of a film.
const KEPT: f64 = 240.0;

/// Moves that make room for a body; the last ones are thousands of its radii long.
const MOST_MOVES: u32 = 100;

/// Steps between two looks at whether to go on.
const PATIENCE: u64 = 16;

/// Why bodies cannot be let go together.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TogetherError {
    /// A body begins inside something.
    #[error(transparent)]
    Inside(#[from] Overlap),
    /// A body of a crowd found no room.
    #[error("the [crowd] has no room: {0}, by a larger `over` or a longer `during`")]
    Crowded(Overlap),
    /// No body was let go.
    #[error(
        "no body was let go before the run ended: lengthen the `duration` beyond the first release, which `carried` or the \
         `during` of the [crowd] puts off"
    )]
    Nobody,
    /// A body of another size is none.
    #[error(transparent)]
    Size(#[from] SurroundingsError),
}

/// A body that is to be let go.
#[derive(Debug, Clone, Copy)]
struct Release {
    /// When (s).
    time: f64,
    kind: usize,
    scale: f64,
    state: State,
}

impl Prepared {
    /// Lets bodies go together in the world of the scene: those of its [crowd](crate::scene::Crowd), or so many
    /// [side by side](crate::ensemble::side_by_side), and follows them until all have come to rest or the time is up.
    ///
    /// Of one body every state is kept; of many those of 240 moments a second, and none while they rest. `most` states
    /// are kept in all.
    ///
    /// # Errors
    /// [`TogetherError`]: a body would begin inside an obstacle or another.
    ///
    /// No body falls in a scene that is no [world](Scene::is_world).
    pub fn drop_together(
        &self,
        bodies: u32,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Vec<Fall>, TogetherError> {
        let Some(surroundings) = self.surroundings() else {
            return Ok(Vec::new());
        };
        let mut run = Run::new(self.scene(), surroundings, &self.releases(bodies), most)?;
        run.begin()?;
        run.go_on(progress);
        match run.falls.is_empty() {
            true => Err(TogetherError::Nobody),
            false => Ok(run.falls),
        }
    }

    fn releases(&self, bodies: u32) -> Vec<Release> {
        let scene = self.scene();
        if let Some(crowd) = &scene.crowd {
            return crowd::releases(scene, crowd);
        }
        let release = |number: u32| Release {
            time: scene.carried,
            kind: 0,
            scale: 1.0,
            state: side_by_side(scene, self.body(), number),
        };
        (0..bodies).map(release).collect()
    }
}

/// Bodies under way.
struct Run<'a> {
    scene: &'a Scene,
    surroundings: &'a Surroundings,
    world: World,
    /// Those that are still to be let go, the next one last.
    waiting: Vec<(Release, Arc<Kind>)>,
    falls: Vec<Fall>,
    /// Steps between two states that are kept.
    stride: u64,
    /// States that may still be kept.
    left: usize,
}

impl<'a> Run<'a> {
    fn new(
        scene: &'a Scene,
        surroundings: &'a Surroundings,
        releases: &[Release],
        most: usize,
    ) -> Result<Self, SurroundingsError> {
        let with_kind = |release: &Release| {
            let kind = surroundings.kind(release.kind, release.scale)?;
            Ok((*release, kind))
        };
        let stride = match releases.len() {
            1 => 1,
            _ => ((1.0 / (KEPT * scene.time_step)).floor() as u64).max(1),
        };
        let waiting = releases.iter().rev().map(with_kind);
        Ok(Self {
            scene,
            surroundings,
            world: surroundings.world().clone(),
            waiting: waiting.collect::<Result<_, SurroundingsError>>()?,
            falls: Vec::new(),
            stride,
            left: most,
        })
    }

    /// Lets the first ones go.
    fn begin(&mut self) -> Result<(), TogetherError> {
        self.let_go();
        let first = 0..self.world.len();
        let overlap = first.into_iter().find_map(|body| self.world.overlap(body));
        match overlap {
            Some(overlap) if self.scene.crowd.is_some() => {
                Err(TogetherError::Crowded(self.surroundings.named(overlap)))
            }
            Some(overlap) => Err(self.surroundings.named(overlap).into()),
            None => Ok(()),
        }
    }

    /// Lets go those whose time has come.
    fn let_go(&mut self) {
        let now = self.world.time() + 0.5 * self.scene.time_step;
        while let Some((release, kind)) = self.waiting.pop_if(|(release, _)| release.time <= now) {
            self.add(&release, kind);
        }
    }

    fn add(&mut self, release: &Release, kind: Arc<Kind>) {
        let number = self.world.len() as u32;
        let noise = NoiseStream {
            seed: self.scene.seed,
            body: number,
        };
        let radius = kind.shape().radius();
        // Until it is let go it is carried along.
        let (mut state, mut states) = (release.state, Vec::new());
        let carried = if self.scene.crowd.is_none() {
            release.time
        } else {
            0.0
        };
        while state.time < carried - 0.5 * self.scene.time_step {
            states.push(state);
            state.carry(self.scene.time_step);
        }
        let body = self.world.add(kind, state, noise);
        if self.scene.crowd.is_some() {
            make_room(&mut self.world, body, radius);
        }
        states.push(*self.world.state(body));
        self.falls.push(Fall {
            body: number,
            kind: release.kind,
            scale: release.scale,
            states,
            ended: Ok(Ending::Stopped),
            full: false,
        });
    }

    fn go_on(&mut self, progress: &dyn Progress) {
        let scene = self.scene;
        let end = scene.stop.time.unwrap_or(f64::INFINITY);
        let mut steps = 0u64;
        let ended = loop {
            if self.world.time() > end - 0.5 * scene.time_step {
                break Ending::Time;
            }
            if self.waiting.is_empty()
                && (0..self.world.len()).all(|body| self.world.is_still(body))
            {
                break Ending::Rest;
            }
            if steps.is_multiple_of(PATIENCE) {
                progress.report("simulating", self.world.time() / end);
                if progress.cancelled() {
                    break Ending::Stopped;
                }
            }
            self.let_go();
            if let Err(error) = self.world.step(scene.time_step) {
                self.falls[error.body].ended = Err(error.error);
                break Ending::Stopped;
            }
            steps += 1;
            if steps.is_multiple_of(self.stride) && !self.keep() {
                for fall in &mut self.falls {
                    fall.full = true;
                }
                break Ending::Stopped;
            }
        };
        self.finish(ended);
    }

    /// Keeps the states of all that moved; whether there was room.
    fn keep(&mut self) -> bool {
        for (body, fall) in self.falls.iter_mut().enumerate() {
            let state = self.world.state(body);
            let rests = |last: &State| {
                last.position == state.position && last.orientation == state.orientation
            };
            let count = fall.states.len();
            if count >= 2 && fall.states[count - 2..].iter().all(rests) {
                // It rests: the last of equal states moves on.
                fall.states[count - 1] = *state;
            } else if self.left == 0 {
                return false;
            } else {
                self.left -= 1;
                fall.states.push(*state);
            }
        }
        true
    }

    fn finish(&mut self, ended: Ending) {
        for (body, fall) in self.falls.iter_mut().enumerate() {
            let state = self.world.state(body);
            if fall
                .states
                .last()
                .is_some_and(|last| last.time < state.time)
            {
                fall.states.push(*state);
            }
            if fall.ended.is_ok() {
                fall.ended = Ok(ended);
            }
        }
    }
}

/// Moves a body up until it is in no other, by ever longer steps; leaves it where it was if that does not help.
fn make_room(world: &mut World, body: usize, radius: f64) {
    let first = *world.state(body);
    let mut state = first;
    let mut up = 0.5 * radius;
    for _ in 0..MOST_MOVES {
        if world.overlap(body).is_none() {
            return;
        }
        state.position[1] += up;
        up *= 1.1;
        world.set_state(body, &state);
    }
    world.set_state(body, &first);
}
