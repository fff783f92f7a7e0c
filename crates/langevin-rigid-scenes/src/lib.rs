//! Scenes of Langevin Rigid: what to simulate, as text, and what is done with it.
//!
//! A scene names a body, a fluid, a release and a run, in TOML. This crate reads it, bakes its body and keeps the bake,
//! drops the body once or a thousand times, and tells how it fell. Use it for experiments, batch work and tools. A game
//! with bodies and a loop of its own needs only `langevin-rigid`.
//!
//! ```
//! use langevin_rigid::Ending;
//! use langevin_rigid_scenes::ensemble::{self, Statistics};
//! use langevin_rigid_scenes::prepared::Prepared;
//! use langevin_rigid_scenes::scene::Scene;
//!
//! let scene = Scene::parse("card", "card.toml", r#"
//!     fluid.preset = "air"
//!     body = { shape = "box", size = [0.085, 0.0003, 0.055], triangles = 300, density = 900.0 }
//!     release = { position = [0.0, 1.0, 0.0], tilt = 20.0 }
//!     run = { time_step = 0.002, duration = 10.0, ground = 0.0 }
//!     scatter.tilt = 5.0
//! "#)?;
//! // A folder in place of `None` keeps the bake for the next time.
//! let card = Prepared::new(scene, None, &())?;
//! card.check_release()?;
//!
//! // Once, with every state on the way.
//! let fall = card.drop(&card.release(0), &());
//! assert_eq!(fall.ended?, Ending::Ground);
//!
//! // Again and again, on all cores.
//! let statistics = Statistics::new(&ensemble::run(&card, 0..16, &()));
//! assert_eq!(statistics.landed, 16);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The examples go on from here: `drop_a_scene` writes the table and the picture of a fall, `landings_of_many`
//! has the mean and spread of an ensemble, `added_mass_of_a_mesh` needs no scene at all.
//!
//! # From a text to a fall
//!
//! 1. [`Scene::parse`](scene::Scene::parse) reads a text, [`scene::find`] a file or one of the scenes that are
//!    [built in](scene::BUILT_IN). A [`Scene`](scene::Scene) is complete: each choice that the text left out has its default.
//! 2. [`Prepared`](prepared::Prepared) is the scene with its bake, its stepper and the hull that touches the ground.
//! 3. [`Prepared::drop`](prepared::Prepared::drop) keeps the states of one run;
//!    [`Prepared::follow`](prepared::Prepared::follow) passes each on as it comes and keeps none.
//! 4. [`ensemble::run`] drops the body once for each run of a range, from scattered releases.
//!
//! # Modules
//!
//! - [`scene`]: scenes as values and as text.
//! - [`baking`]: from a scene to its mesh, its bake and its stepper.
//! - [`prepared`]: a scene made ready, and the loop that drops its body.
//! - [`advance`](mod@advance): one step of a scene, for hosts with a loop of their own.
//! - [`look`](mod@look): how bodies look in exports; [`cast`]: all bodies of a run with their looks.
//! - [`together`]: bodies that touch, float, and are many.
//! - [`shot`]: pictures and films of a run.
//! - [`ensemble`]: many falls, what kind of motion each is, and their statistics.
//! - [`sweep`]: ensembles of many scenes, in parts that any process can do.
//! - [`summary`]: what a run comes to.
//! - [`real_time`](mod@real_time): many bodies at 60 frames a second, and the frames that are missed.
//! - [`direct`]: releases whose fall does what is asked.
//! - [`regimes`]: how discs and strips fall over Reynolds number and inertia, against experiments.
//!
//! # Conventions
//!
//! - SI units throughout. Angles are degrees in a scene's text, in [`Scatter`](scene::Scatter) and in [`regimes::Case`],
//!   radians everywhere else.
//! - World and body frame are those of the run time: +Y is up, the body's origin is its centre of mass, plates have
//!   their thin axis along y. Landings and samples of an [`ensemble::Fall`] are x, depth and z from the release point.
//! - A mistake in a scene is an error with its line and column. A run that fails is not an error of the ensemble: its
//!   fall says that it diverged, and why.
//! - A fall depends only on its scene and its number, to the bit: not on threads, nor on the runs beside it, nor on
//!   whether the bake was kept.
//! - A kept bake is used again if mesh, options and code are the same, and made anew if it is damaged. Trouble with the
//!   folder is reported in [`Baked`](baking::Baked) and does not stop the work.
//!
//! # Features
//!
//! `collada`, `draco`, `meshopt` and `npz`, on by default: passed on to `langevin-rigid-formats`, and `meshopt` to
//! `langevin-rigid-bake`. Without `meshopt` the crate builds for `wasm32-unknown-unknown`.

pub mod advance;
pub mod baking;
pub mod cast;
pub mod direct;
pub mod ensemble;
mod lanes;
pub mod look;
pub mod prepared;
pub mod real_time;
pub mod regimes;
pub mod scene;
pub mod shot;
mod stage;
pub mod summary;
pub mod sweep;
pub mod together;
