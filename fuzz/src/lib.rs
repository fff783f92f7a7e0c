//! What is fuzzed: every reader, and what follows from a mesh and from a scene.
//!
//! A [`Target`] takes bytes and panics where they show a fault: a panic of what is tested, a broken
//! promise, or more time and memory than `meter.rs` allows. `fuzz/run` lets `cargo fuzz` look for such bytes;
//! `tests/replay.rs` runs those that are kept, on any compiler.

mod bake;
mod mass;
mod mesh;
mod meter;
mod numbers;
mod run;
mod scene;
mod steps;

use langevin_rigid::Model;
use langevin_rigid_formats::mesh::MeshFormat;

/// Something that takes bytes from anywhere.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Its name, which its folders of `corpus` and `crashes` have.
    pub name: &'static str,
    /// What it does with the bytes.
    body: fn(&[u8]),
    /// What it wants before its first input, which no input is charged with.
    prepare: fn(),
    /// Processor time that an input may take (s).
    seconds: f64,
}

/// All of them. One more needs a file in `fuzz_targets` and an entry in `Cargo.toml` besides its line.
pub const TARGETS: [Target; 14] = [
    Target::new("obj", |bytes| mesh::read(bytes, MeshFormat::Obj)),
    Target::new("stl", |bytes| mesh::read(bytes, MeshFormat::Stl)),
    Target::new("ply", |bytes| mesh::read(bytes, MeshFormat::Ply)),
    Target::new("gltf", |bytes| mesh::read(bytes, MeshFormat::Gltf)),
    Target::new("glb", |bytes| mesh::read(bytes, MeshFormat::Glb)),
    Target::new("collada", |bytes| mesh::read(bytes, MeshFormat::Collada)),
    Target::new("scene", scene::read),
    Target::new("bake", bake::read_sealed),
    Target::new("bake_raw", bake::read),
    Target::new("table", run::read),
    Target::new("export", run::export).after(run::prepare),
    // Parts that meet are wrapped by some 50,000 triangles, however few they have.
    Target::new("mass", mass::repair_and_solve)
        .after(mass::prepare)
        .within(5.0),
    Target::new("steps", |bytes| {
        steps::fall(bytes, &[Model::Separated, Model::Kirchhoff]);
    })
    .after(steps::prepare),
    Target::new("consistent", |bytes| {
        steps::fall(bytes, &[Model::Consistent]);
    })
    .after(steps::prepare),
];

impl Target {
    const fn new(name: &'static str, body: fn(&[u8])) -> Self {
        Self {
            name,
            body,
            prepare: || (),
            seconds: 1.0,
        }
    }

    const fn after(self, prepare: fn()) -> Self {
        Self { prepare, ..self }
    }

    const fn within(self, seconds: f64) -> Self {
        Self { seconds, ..self }
    }

    /// The target of that name.
    pub fn named(name: &str) -> Option<Self> {
        TARGETS.into_iter().find(|target| target.name == name)
    }

    /// Takes `bytes`, within the limits.
    ///
    /// # Panics
    /// Where they show a fault.
    pub fn run(&self, bytes: &[u8]) {
        (self.prepare)();
        meter::within_limits(bytes.len(), self.seconds, || (self.body)(bytes));
    }
}

/// The program of a target: what `cargo fuzz` runs, or without it one that takes the files it is given.
#[macro_export]
macro_rules! target {
    ($name:literal) => {
        #[cfg(fuzzing)]
        libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
            static TARGET: std::sync::LazyLock<$crate::Target> =
                std::sync::LazyLock::new(|| $crate::Target::named($name).unwrap());
            TARGET.run(bytes);
        });

        #[cfg(not(fuzzing))]
        fn main() -> std::io::Result<()> {
            for path in std::env::args().skip(1) {
                let bytes = std::fs::read(path)?;
                $crate::Target::named($name).unwrap().run(&bytes);
            }
            Ok(())
        }
    };
}
