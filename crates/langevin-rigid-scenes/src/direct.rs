//! Directing: releases, streams of noise and steering forces whose fall does what a scene asks.
//!
//! What a body in turbulent flow does cannot be prescribed, but it can be chosen. [`search`] draws releases within the
//! freedom of the scene's [`Direct`], each with noise of its own, drops them all in lanes, and scores each fall by what it
//! misses. Then it draws again around the best, nearer and nearer, keeping their noise, until there are enough falls that
//! do what is asked or as many were tried as may be. What is found is a scene that `simulate` runs to the same bits.
//!
//! ```
//! use langevin_rigid_scenes::direct;
//! use langevin_rigid_scenes::prepared::Prepared;
//! use langevin_rigid_scenes::scene::Scene;
//!
//! let scene = Scene::parse("card", "card.toml", r#"
//!     fluid.preset = "air"
//!     body = { shape = "box", size = [0.085, 0.0003, 0.055], triangles = 300, density = 900.0 }
//!     release = { position = [0.0, 0.5, 0.0], tilt = 20.0 }
//!     run = { time_step = 0.002, duration = 10.0, ground = 0.0 }
//!     direct.land = { at = [0.1, 0.0, 0.0], within = 0.1 }
//!     direct.free = { tilt = 30.0, heading = 180.0 }
//!     direct.falls = 256
//!     direct.best = 1
//! "#)?;
//! let card = Prepared::new(scene, None, &())?;
//! let found = direct::search(&card, &())?;
//! let best = &found.best[0];
//! assert!(best.is_hit());
//!
//! // The same fall again, from its scene.
//! let again = Prepared::of(best.scene(&card), card.baked().clone())?;
//! let fall = again.drop(&again.release(0), &());
//! assert_eq!(fall.states.last(), Some(&best.last));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod asks;
mod glimpses;
mod motion;
mod path;
mod search;
mod space;
#[cfg(test)]
mod tests;

use langevin_rigid::State;
use langevin_rigid_bake::progress::Progress;

use crate::ensemble::{FallEnding, SAMPLES_PER_SECOND, TOGETHER};
use crate::prepared::{Prepared, Release};
use crate::scene::{Direct, Scene, Steering};
pub use motion::Motion;
pub use path::DrawnPathError;

/// Why nothing could be searched for.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DirectError {
    /// The scene asks for nothing.
    #[error(
        "the scene `{0}` does not say what its fall shall do: give it a [direct] (docs/directing.md)"
    )]
    NothingAsked(String),
    /// What is asked is of one body, and ends at the ground.
    #[error(
        "the scene `{0}` is a world (docs/worlds.md), and `direct` knows falls of one body that end at the ground: leave out \
         [contact], [[obstacle]], [water] and [crowd]"
    )]
    World(String),
    /// The drawn path cannot be used.
    #[error(transparent)]
    Path(#[from] DrawnPathError),
}

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The best falls, different from each other, the best first; without those that diverged.
    pub best: Vec<Directed>,
    /// What is asked, by name, in the order of [`Directed::misses`].
    pub asks: Vec<String>,
    /// Falls that were made.
    pub falls: u32,
    /// How many of them were drawn from all the freedom there is, without steering.
    pub drawn: u32,
    /// How many of those do what is asked: their share is the chance of it.
    pub drawn_hits: u32,
    /// Falls of any kind that do what is asked.
    pub hits: u32,
}

/// A fall that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Directed {
    /// Where it begins, and its noise.
    pub release: Release,
    /// The force that steers it, if any.
    pub steering: Option<Steering>,
    /// How far it is from each thing asked, in units of the tolerance: up to one is what is asked.
    pub misses: Vec<f64>,
    /// Its last state.
    pub last: State,
    /// Why it ended.
    pub ending: FallEnding,
}

impl Directed {
    /// By how much it misses what is asked: zero for a fall that does it.
    pub fn score(&self) -> f64 {
        asks::score(&self.misses)
    }

    /// Whether it does what is asked.
    pub fn is_hit(&self) -> bool {
        self.score() == 0.0
    }

    /// The scene of this fall alone: its body 0 falls to the same bits.
    ///
    /// `prepared` is what was searched. The speed of the run is that of the search, whatever the release: it goes into the
    /// Reynolds number and into a precomputed turbulence.
    pub fn scene(&self, prepared: &Prepared) -> Scene {
        space::scene(prepared, &self.release, self.steering.as_ref())
    }
}

/// Finds falls that do what the scene asks.
///
/// The same scene gives the same falls, on any number of threads. Of work that `progress` cancels, the best so far is
/// given.
///
/// # Errors
/// [`DirectError`].
pub fn search(prepared: &Prepared, progress: &dyn Progress) -> Result<Found, DirectError> {
    let direct = asked(prepared)?;
    search::search(prepared, direct, progress)
}

/// Memory that a search over falls of so many seconds takes at once, about (bytes).
pub fn memory(seconds: f64) -> f64 {
    // Lists grow to twice what they hold.
    let fall =
        2.0 * seconds * f64::from(SAMPLES_PER_SECOND) * size_of::<glimpses::Glimpse>() as f64;
    fall * TOGETHER as f64 * rayon::current_num_threads() as f64
}

/// How far a fall is from each thing that the scene asks, as in [`Directed::misses`].
///
/// # Errors
/// [`DirectError`].
pub fn misses(
    prepared: &Prepared,
    states: &[State],
    ending: &FallEnding,
) -> Result<Vec<f64>, DirectError> {
    let asks = asks::Asks::new(prepared, asked(prepared)?)?;
    let Some((first, rest)) = states.split_first() else {
        return Ok(Vec::new());
    };
    let mut glimpses = glimpses::Glimpses::new(prepared, first);
    let mut last = first;
    for state in rest {
        crate::lanes::Watch::see(&mut glimpses, last, state);
        last = state;
    }
    Ok(asks.misses(glimpses, last, ending))
}

fn asked(prepared: &Prepared) -> Result<&Direct, DirectError> {
    let scene = prepared.scene();
    if scene.is_world() {
        return Err(DirectError::World(scene.name.clone()));
    }
    let direct = scene.direct.as_ref();
    direct.ok_or_else(|| DirectError::NothingAsked(scene.name.clone()))
}
