//! Files of Langevin Rigid: meshes come in; trajectories, animations and added mass go out.
//!
//! Tools use it to read the meshes that people have, and to hand runs to the programs that they work with: Blender,
//! Houdini, game engines, NumPy, pandas, robot simulators. A game does not need it: the run time reads a
//! [`Bake`](langevin_rigid::Bake) by itself.
//!
//! ```
//! use langevin_rigid::{Fluid, NoiseStream, Settings, State, Stepper};
//! use langevin_rigid_bake::body::{BodySpec, bake_body};
//! use langevin_rigid_formats::files;
//! use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat, parse_mesh};
//! use langevin_rigid_formats::trajectory::{Trajectory, csv, read_csv};
//!
//! // In: a sheet of paper, drawn in centimetres. `read_mesh` takes the path of a file instead.
//! let file = b"v 0 0 0\nv 12 0 0\nv 12 0 8\nv 0 0 8\nf 4 3 2 1\n";
//! let sheet = parse_mesh(file, MeshFormat::Obj, Some(LengthUnit::Cm), None)?.sheet(1e-4)?;
//!
//! let spec = BodySpec { density: Some(800.0), ..BodySpec::default() };
//! let (body, _) = bake_body(&sheet, &spec, &())?;
//! let stepper = Stepper::new(&body, &Fluid::AIR, None, &Settings::default())?;
//! let noise = NoiseStream { seed: 1, body: 0 };
//! let mut state = State::default();
//! let mut states = vec![state];
//! for _ in 0..60 {
//!     stepper.step(&mut state, 1.0 / 60.0, &noise.into())?;
//!     states.push(state);
//! }
//!
//! // Out: a table whose numbers read back to the bit.
//! let fall = Trajectory::new(0, &states);
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("sheet.csv");
//! files::write(&path, csv(&fall).as_bytes())?;
//! assert_eq!(read_csv(&std::fs::read_to_string(&path)?)?, [fall]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Modules
//!
//! - [`mesh`]: OBJ, STL, PLY, glTF and Collada, read from files or bytes; OBJ and STL, written.
//! - [`trajectory`]: where a body went, and the table of it as CSV, written and read.
//! - [`track`]: where a body is between its recorded poses.
//! - [`export`]: runs as CSV, NumPy, Parquet, glTF or USD.
//! - [`table`](mod@table): tables of any columns, as CSV and Parquet.
//! - [`visual`]: what a body looks like, from glTF to an exported GLB.
//! - [`wind_table`]: velocities of a wind on a grid, from NumPy.
//! - [`added_mass`]: the tensor for Gazebo, UUV Simulator, MuJoCo and Capytaine, as JSON, CSV or a table for people.
//! - [`files`]: writes files whole or not at all, and claims a place before the work begins.
//! - [`budget`]: refuses work that would not fit into memory or would not finish in reasonable time.
//!
//! # Conventions
//!
//! - Everything in memory is in SI units. A mesh file that does not state its unit is read with the one that the caller
//!   gives, and refused if there is none.
//! - Tables and animations are in the world frame, right-handed; up is +Y, or +Z where
//!   [`export::Options::up`] asks for it, but always +Y in glTF. Quaternions are x, y, z, w and turn body vectors into world vectors.
//! - Files for other programs follow the conventions of those programs, and state them where the format has comments.
//! - Readers trust nothing. A damaged or hostile file gives an error that says where the fault is and what to do, never a
//!   panic, and takes no more memory than its length calls for. [`RawMesh::notices`](mesh::RawMesh::notices) lists what
//!   was skipped.
//! - Numbers in tables have as many digits as it takes to read back the same bits.
//!
//! # Features
//!
//! On by default:
//!
//! - `meshopt` reads glTF files that meshoptimizer compressed. It needs a C++ compiler; without the
//!   feature the crate builds for `wasm32-unknown-unknown`, where files are not written.
//! - `draco` reads glTF files that Draco compressed.
//! - `collada` reads Collada files.
//! - `npz` writes [`Format::Npz`](export::Format::Npz) and reads [`wind_table`]s.
//!
//! Not by default:
//!
//! - `parquet` writes [`Format::Parquet`](export::Format::Parquet) and tables. Its library takes long to build.

pub mod added_mass;
pub mod budget;
pub mod export;
pub mod files;
pub mod mesh;
pub mod table;
pub mod track;
pub mod trajectory;
pub mod visual;
pub mod wind_table;
