//! What the viewer of Langevin Rigid shows, computed: a scene opened and dropped, as frames, curves, loads by cause and
//! pressures.
//!
//! ```
//! use langevin_rigid_viewer::session::Session;
//! let text = r#"
//!     fluid.preset = "air"
//!     body = { shape = "box", size = [0.085, 0.0003, 0.055], triangles = 300, density = 900.0 }
//!     release = { position = [0.0, 1.0, 0.0], tilt = 20.0 }
//!     run = { time_step = 0.002, duration = 10.0, ground = 0.0 }
//! "#;
//! let session = Session::open("card", text, None, &())?;
//! let run = session.drop(&())?;
//! let frames = run.frames();
//! let curves = session.curves(&run);
//! assert_eq!(frames.times.len(), curves.speed.len());
//! assert_eq!(run.bodies()[0].ending, "ground");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Modules
//!
//! - [`session`]: a scene made ready, and its runs.
//! - [`run`]: one run, as poses at common times.
//! - [`curves`]: what a body did, as numbers over time, and the loads on it by cause.
//! - [`skin`]: the surface of a body as it is drawn, and the pressure on it.
//! - [`mod@describe`]: what a page says of a scene, and what stands around its bodies.
//! - [`landings`]: where many falls end.
//! - [`many`]: thousands of bodies that fall without end.
//! - [`meshes`]: files that are dropped onto the page.
//!
//! For `wasm32-unknown-unknown` the crate is also the module that a page calls, by JSON for what has names and by arrays of
//! numbers for what is long. Files are those that the page [handed over](langevin_rigid_formats::files).

#[cfg(target_arch = "wasm32")]
pub mod binding;
pub mod curves;
pub mod describe;
pub mod landings;
pub mod many;
pub mod meshes;
pub mod run;
pub mod session;
pub mod skin;
