//! The command line: its words are a contract with scripts.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use langevin_rigid::{Model, TurbulenceSource};
use langevin_rigid_formats::export::{Format as TrajectoryFormat, Up};
use langevin_rigid_formats::mesh::LengthUnit;
use langevin_rigid_report::Part;

use crate::size::{Size, size};

const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    the input or the run failed; what had been computed is kept
  2    the command line was not understood
  129, 130, 143  ended by SIGHUP, Ctrl-C, SIGTERM; what had been computed is kept. A second one ends at once

Bakes are kept in the platform's cache folder, or in LANGEVIN_RIGID_CACHE if that is set.";

/// Light bodies immersed in air or water: from a mesh and a fluid to a trajectory.
#[derive(Parser)]
#[command(version, after_help = EXIT_CODES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    Simulate(Simulate),
    Export(Export),
    Ensemble(Ensemble),
    Direct(Direct),
    Regimes(Regimes),
    AddedMass(AddedMass),
    Check(Check),
    Repair(Repair),
    Turbulence(Turbulence),
    Bake(Bake),
    Reproduce(Reproduce),
    Bench(Bench),
    Crowd(Crowd),
    View(View),
    /// List the built-in scenes.
    Scenes,
}

/// Run a scene and write its trajectory, a summary and a picture.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid simulate
  langevin-rigid simulate paper-75
  langevin-rigid simulate paper-75 --seed 7 --out drop7
  langevin-rigid simulate my-scene.toml --duration 3 --json
  langevin-rigid simulate ellipsoid-water --model kirchhoff
  langevin-rigid simulate business-card --picture strobe --view iso
  langevin-rigid simulate business-card --view front --frames frames
  langevin-rigid simulate leaf --bodies 100 --format glb,usd

Writes into DIR: the trajectory in each FORMAT, trajectory.png, summary.json and scene.toml, the
scene with every choice spelled out.

Formats: csv, npz and parquet are tables of every step (world frame, +Y up; metres, seconds,
radians); glb (glTF) and usd (OpenUSD) are animations with the body's mesh.")]
pub(crate) struct Simulate {
    /// A built-in scene (see `langevin-rigid scenes`) or a scene file.
    #[arg(default_value = "leaf")]
    pub(crate) scene: String,
    /// Folder for the results [default: out/SCENE].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Seed of the noise.
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// End after this time (s) at the latest.
    #[arg(long, value_name = "S", value_parser = positive)]
    pub(crate) duration: Option<f64>,
    /// Time step (s).
    #[arg(long, value_name = "S", value_parser = positive)]
    pub(crate) dt: Option<f64>,
    #[arg(long, value_name = "NAME", help = models())]
    pub(crate) model: Option<Model>,
    /// Source of turbulence: body-driven, wake-age=LENGTHS or history.
    #[arg(long, value_name = "SOURCE")]
    pub(crate) turbulence: Option<TurbulenceSource>,
    /// What the picture shows: the body at equal times, its path, or both.
    #[arg(long, value_name = "WHAT", default_value = "both")]
    pub(crate) picture: Shown,
    /// Where it is seen from [default: front and side next to each other].
    #[arg(long, value_name = "SIDE")]
    pub(crate) view: Option<Viewpoint>,
    /// Write a film into this folder as frame-00001.png, frame-00002.png, ...
    #[arg(long, value_name = "DIR")]
    pub(crate) frames: Option<PathBuf>,
    /// Bodies to drop: of a scene's [crowd] so many in place of its count, else side by side, scattered as the scene says.
    /// They meet where the scene is a world (docs/worlds.md); where it is none, picture and film are of the first. The summary
    /// is always of the first.
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) bodies: u32,
    #[arg(
        long,
        help = formats("Formats of the trajectory"),
        value_name = "FORMAT",
        default_value = "csv,glb",
        value_delimiter = ','
    )]
    pub(crate) format: Vec<TrajectoryFormat>,
    /// Frames a second of the film, of glb and of usd.
    #[arg(long, value_name = "N", default_value = "60", value_parser = positive)]
    pub(crate) fps: f64,
    /// Print the summary as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Write a run that was made in other formats.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid export out/leaf
  langevin-rigid export out/leaf --format usd --fps 24 --up z
  langevin-rigid export out/leaf --format npz,parquet --out tables

Reads trajectory.csv and scene.toml, which `simulate` wrote into RUN. The formats are those of
`simulate`: csv, npz and parquet have every step, glb and usd have frames. glb has +Y up by
definition, which programs turn to their own axes; --up is for the others.")]
pub(crate) struct Export {
    /// Folder that `simulate` wrote.
    pub(crate) run: PathBuf,
    #[arg(
        long,
        help = formats("Formats"),
        value_name = "FORMAT",
        default_value = "glb,usd",
        value_delimiter = ','
    )]
    pub(crate) format: Vec<TrajectoryFormat>,
    /// Frames a second of glb and usd.
    #[arg(long, value_name = "N", default_value = "60", value_parser = positive)]
    pub(crate) fps: f64,
    /// The axis that points up in the world: y or z.
    #[arg(long, value_name = "AXIS", default_value = "y")]
    pub(crate) up: Up,
    /// Folder for the files [default: RUN].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Shown {
    Strobe,
    Path,
    Both,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Viewpoint {
    Front,
    Side,
    Top,
    Iso,
}

/// Drop the body of a scene many times and write the statistics of its falls.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid ensemble paper-75 --runs 100
  langevin-rigid ensemble my-coin.toml --runs 150 --seed 7 --json
  langevin-rigid ensemble my-coin.toml --runs 100000 --resume

Each run has its own noise, release, body and fluid, as the scene's [scatter] says; all depend on the
seed and the number of the run alone. The walls and the floor are those of its [tank].

Writes into DIR: landings.csv and landings.parquet (one row per run: what was drawn, seconds, metres
from the release point), statistics.json and scene.toml. Falls are kept in falls.journal until all have
ended, so that a run that was stopped or killed goes on with --resume, to the same bits. Columns against time stop where fewer than half the drops are still
falling.")]
pub(crate) struct Ensemble {
    /// A built-in scene (see `langevin-rigid scenes`) or a scene file.
    pub(crate) scene: String,
    /// Number of runs.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: u32,
    /// Folder for the results [default: out/SCENE-ensemble].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Seed of the noise and of the releases.
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    #[arg(long, value_name = "NAME", help = models())]
    pub(crate) model: Option<Model>,
    /// Go on with the runs that an ensemble in DIR has not finished.
    #[arg(long)]
    pub(crate) resume: bool,
    /// Print the statistics as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Find releases, noise and forces whose fall does what the scene asks.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid direct direct-leaf
  langevin-rigid direct my-scene.toml --falls 100000 --best 20 --json
  langevin-rigid simulate out/direct-leaf-direct/best-1.toml

What is asked and what is free stands under [direct] in the scene; docs/directing.md has it. The same
scene gives the same falls on any machine.

Writes into DIR: best.csv (one row per fall; seconds, metres, degrees, world frame), best.json, and of
each fall best-N.toml, the scene that `simulate` runs to the same bits, and best-N.png.")]
pub(crate) struct Direct {
    /// A built-in scene (see `langevin-rigid scenes`) or a scene file.
    pub(crate) scene: String,
    /// Most falls to try [default: the scene's].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000_000))]
    pub(crate) falls: Option<u32>,
    /// How many falls are wanted, different from each other [default: the scene's].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) best: Option<u32>,
    /// Folder for the results [default: out/SCENE-direct].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Seed of the noise and of the draws.
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// Print best.json as well.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Measure what a step and the precomputation cost on this machine.
#[derive(Args)]
#[command(after_help = "\
Medians of repeated runs; with --json in nanoseconds, unless a name says otherwise. Quiet the machine
first: other work shows.")]
pub(crate) struct Bench {
    /// Print the figures as JSON.
    #[arg(long)]
    pub(crate) json: bool,
    /// Write the table of the figures into the pages (*.md) of this folder that have the line
    /// `<!-- table: bench/main -->`, up to `<!-- end -->`.
    #[arg(long, value_name = "DIR")]
    pub(crate) update: Option<PathBuf>,
}

/// Step many bodies of a scene in real time and count the frames that are missed.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid crowd
  langevin-rigid crowd coin --bodies 20000 --seconds 5

All bodies begin at the scene's release, each with noise of its own; walls, floors and other bodies do
not act.")]
pub(crate) struct Crowd {
    /// A built-in scene (see `langevin-rigid scenes`) or a scene file.
    #[arg(default_value = "paper-75")]
    pub(crate) scene: String,
    /// Number of bodies.
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) bodies: u32,
    /// How long, at 60 frames a second.
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = positive)]
    pub(crate) seconds: f64,
    #[arg(long, value_name = "NAME", help = models())]
    pub(crate) model: Option<Model>,
    /// Print the figures as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Drop discs and strips over a grid of Reynolds number and inertia, and map how they fall.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid regimes
  langevin-rigid regimes --grid 20x12 --out fine --json

Every plate is released from three tilts with the model `separated`, without turbulence; each fall is
classified by itself, and the map compared with published measurements.

Writes into DIR: regimes.csv (one row per run), regimes.json (the grid, the published boundaries and
the agreement), regimes.png (the map) and strobe-MOTION.png, one fall of each motion.")]
pub(crate) struct Regimes {
    /// Values of I* and of Re, each from 2 to 100, from end to end of the map.
    #[arg(long, value_name = "NxM", default_value = "10x6", value_parser = grid)]
    pub(crate) grid: [u32; 2],
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = "out/regimes")]
    pub(crate) out: PathBuf,
    /// Print regimes.json as well.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Compute the added-mass tensor of a mesh.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid added-mass hull.stl --unit mm
  langevin-rigid added-mass leaf.obj --unit cm --thickness 0.0002 --fluid-density 1.2
  langevin-rigid added-mass hull.glb --about origin --format json
  langevin-rigid added-mass scan.ply --proxy 5000
  langevin-rigid added-mass hull.stl --format sdf
  langevin-rigid added-mass hull.stl --format mujoco > hull_fluid.py

The tensor is 6 x 6, linear part first, axes of the mesh, in SI (kg, kg m, kg m^2). Every format
states its conventions; docs/destinations says what to do with it.
Reads OBJ, STL, PLY, glTF, GLB and Collada.")]
pub(crate) struct AddedMass {
    /// The mesh file.
    pub(crate) mesh: PathBuf,
    /// Unit of its coordinates (m, cm, mm, um, in, ft) [default: that of the file, or m].
    #[arg(long, value_name = "UNIT")]
    pub(crate) unit: Option<LengthUnit>,
    /// Thicken an open sheet to this thickness (m).
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    pub(crate) thickness: Option<f64>,
    /// Simplify to about N triangles first, keeping the volume, and say what that may cost.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(4..))]
    pub(crate) proxy: Option<u32>,
    /// Density of the fluid (kg/m^3).
    #[arg(long, value_name = "RHO", default_value = "1000", value_parser = positive)]
    pub(crate) fluid_density: f64,
    /// Reference point of the tensor: the centre of mass of the homogeneous body, or the origin of
    /// the mesh's coordinates [default: com, but origin for sdf and uuv].
    #[arg(long, value_name = "POINT")]
    pub(crate) about: Option<About>,
    /// How to print the result.
    #[arg(long, value_name = "FORMAT", default_value = "table")]
    pub(crate) format: Format,
}

/// Report what a mesh is, what is wrong with it, and what mends it.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid check hull.stl --unit mm
  langevin-rigid check scan.ply --json

A mesh never fails to be checked because it is bad: everything is reported in one go.
Reads OBJ, STL, PLY, glTF, GLB and Collada. Lengths are in metres unless it or UNIT
says otherwise.

Exit codes:
  0    ready for `added-mass` and scenes
  1    not ready, or the file cannot be read")]
pub(crate) struct Check {
    /// The mesh file.
    pub(crate) mesh: PathBuf,
    /// Unit of its coordinates (m, cm, mm, um, in, ft) [default: that of the file, or m].
    #[arg(long, value_name = "UNIT")]
    pub(crate) unit: Option<LengthUnit>,
    /// Print the report as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Make a body of a mesh that is none: weld, orient, fill, thicken, simplify, and say what was done.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid repair scan.ply --out scan.obj
  langevin-rigid repair hull.stl --unit mm --largest --out hull.obj
  langevin-rigid repair leaf.obj --unit cm --thickness 0.0002 --out leaf.stl
  langevin-rigid repair scan.ply --triangles 5000 --out proxy.obj
  langevin-rigid repair assembly.glb --wrap 2% --out skin.obj

FILE is OBJ or STL by its extension, in metres, and is written only if it holds a body. A mesh
that is one already is written as it is.")]
pub(crate) struct Repair {
    /// The mesh file.
    pub(crate) mesh: PathBuf,
    /// File to write, .obj (all digits) or .stl (single precision).
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// Unit of the mesh's coordinates (m, cm, mm, um, in, ft) [default: that of the file, or m].
    #[arg(long, value_name = "UNIT")]
    pub(crate) unit: Option<LengthUnit>,
    /// Weld vertices of open edges this close (m) [default: 1e-6 of the diagonal of the mesh's box].
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    pub(crate) weld: Option<f64>,
    /// Fill holes of at most this many edges that are small beside the body [default: 100, with
    /// --thickness 0].
    #[arg(long, value_name = "EDGES")]
    pub(crate) fill: Option<usize>,
    /// Thicken what is an open sheet after that to this thickness (m).
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    pub(crate) thickness: Option<f64>,
    /// Simplify to about N triangles, keeping the volume.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(4..))]
    pub(crate) triangles: Option<u32>,
    /// In place of all this, wrap everything in one closed surface that closes gaps up to about this size (m,
    /// or such as 2% of the diagonal of the mesh's box) and leaves out what is inside: for open shells and inner
    /// walls. Closed parts that meet are wrapped at 2% unasked.
    #[arg(long, value_name = "SIZE", value_parser = size, conflicts_with_all = ["weld", "fill", "thickness", "largest"])]
    pub(crate) wrap: Option<Size>,
    /// Of several components keep the one of the largest surface.
    #[arg(long)]
    pub(crate) largest: bool,
    /// Print what was done as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum About {
    Com,
    Origin,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Table,
    Json,
    Csv,
    /// SDFormat's `<fluid_added_mass>`, for Gazebo.
    Sdf,
    /// `<hydrodynamic_model>` of UUV Simulator and DAVE.
    Uuv,
    /// A Python program that sets MuJoCo's fluid numbers and buoyancy.
    Mujoco,
    /// A Python program that makes the array as Capytaine labels it.
    Capytaine,
}

/// Compute the turbulence history of a scene as CSV: t,k,epsilon,chi in SI.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid turbulence paper-75
  langevin-rigid turbulence paper-75 --out history.csv")]
pub(crate) struct Turbulence {
    /// A built-in scene or a scene file.
    pub(crate) scene: String,
    /// File to write instead of printing.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// Precompute a scene's body and turbulence into a file that the run time loads by itself.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid bake paper-75 --out sheet.lrbake

In a program: langevin_rigid::Bake::from_bytes(&std::fs::read(\"sheet.lrbake\")?)")]
pub(crate) struct Bake {
    /// A built-in scene or a scene file.
    pub(crate) scene: String,
    /// File to write [default: SCENE.lrbake].
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// Compute the paper's results again and write them as one page beside what the paper states.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid reproduce
  langevin-rigid reproduce --only fig3,fig5 --seeds 20
  langevin-rigid reproduce --only validation --update docs

Writes into DIR: report.html, which needs no other file and no network, and a folder of raw data for
each part: numbers.json with every number of the page, tables as Markdown, curves as CSV, pictures as
PNG. Each part is written when it is finished; Ctrl-C keeps those that are.

--update replaces what stands between the lines `<!-- table: PART/NAME -->` and `<!-- end -->` of the
pages (*.md) in DIR by the tables of the parts that were computed.")]
pub(crate) struct Reproduce {
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = "out/reproduce")]
    pub(crate) out: PathBuf,
    /// Parts to compute, with commas between them [default: all].
    #[arg(long, value_name = "PART", value_delimiter = ',', value_parser = Part::named)]
    pub(crate) only: Vec<Part>,
    /// Seeds of each ensemble.
    #[arg(long, value_name = "N", default_value = "100", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) seeds: u32,
    /// The first seed.
    #[arg(long, value_name = "N", default_value = "1")]
    pub(crate) seed: u64,
    /// Write the tables into the pages of this folder as well.
    #[arg(long, value_name = "DIR")]
    pub(crate) update: Option<PathBuf>,
}

/// Show a scene or a run in the browser.
#[derive(Args)]
#[command(after_help = "\
Examples:
  langevin-rigid view
  langevin-rigid view leaf
  langevin-rigid view my-scene.toml
  langevin-rigid view out/leaf
  langevin-rigid view out/leaf --no-open --port 9000

Prints the address of the page and serves it to this machine alone, until Ctrl-C. The page needs no
network. What it shows is read at the start: begin again to see what has changed since.")]
pub(crate) struct View {
    /// A built-in scene (see `langevin-rigid scenes`), a scene file, or a folder that `simulate` wrote, with csv among its
    /// formats.
    #[arg(value_name = "SCENE | RUN")]
    pub(crate) what: Option<String>,
    /// Port of the page; 0 takes any that is free [default: 8420, or any that is free].
    #[arg(long, value_name = "N")]
    pub(crate) port: Option<u16>,
    /// Do not open the page, only print its address.
    #[arg(long)]
    pub(crate) no_open: bool,
}

fn models() -> String {
    let names = Model::ALL.map(Model::name);
    format!("Equations of motion: {}", names.join(", "))
}

fn formats(what: &str) -> String {
    let names = TrajectoryFormat::ALL.map(TrajectoryFormat::name);
    format!("{what}, with commas between them: {}", names.join(", "))
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("it must be a positive number".into()),
    }
}

fn grid(text: &str) -> Result<[u32; 2], String> {
    let count = |part: &str| part.parse().ok().filter(|n| (2..=100).contains(n));
    text.split_once('x')
        .and_then(|(n, m)| Some([count(n)?, count(m)?]))
        .ok_or_else(|| "it must be two whole numbers from 2 to 100, such as 10x6".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }
}
