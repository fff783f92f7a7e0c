//! What the page calls.
//!
//! Whatever has names comes as JSON, whatever is long as arrays of numbers. Errors are of JavaScript's `Error`, in the words
//! of the library.

use std::path::Path;

use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::export::{Format, Options, Recording, read_bodies, write};
use langevin_rigid_formats::files;
use langevin_rigid_formats::trajectory::read_csv;
use langevin_rigid_scenes::cast::Cast;
use langevin_rigid_scenes::scene::BUILT_IN;
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::curves::causes;
use crate::{landings, many, meshes, run, session, skin};

type Outcome<T> = Result<T, JsError>;

/// Where bakes are kept, among the files of the page.
const BAKES: &str = "/bakes";

#[wasm_bindgen]
extern "C" {
    /// What the worker does with progress.
    #[wasm_bindgen(js_namespace = globalThis, js_name = reportProgress)]
    fn report_progress(stage: &str, fraction: f64);
}

struct PageProgress;

impl Progress for PageProgress {
    fn report(&self, stage: &str, fraction: f64) {
        report_progress(stage, fraction);
    }
}

fn json<T: Serialize>(value: &T) -> Outcome<String> {
    Ok(serde_json::to_string(value)?)
}

/// Version of the library.
#[wasm_bindgen]
pub fn version() -> String {
    langevin_rigid::VERSION.to_owned()
}

/// The built-in scenes, as JSON: name and text of each.
#[wasm_bindgen]
pub fn built_in_scenes() -> Outcome<String> {
    #[derive(Serialize)]
    struct Text {
        name: &'static str,
        text: &'static str,
    }
    let scenes = BUILT_IN.iter().map(|scene| Text {
        name: scene.name,
        text: scene.text,
    });
    json(&scenes.collect::<Vec<_>>())
}

/// Hands a file over, under a path that scenes name.
#[wasm_bindgen]
pub fn put_file(path: &str, bytes: &[u8]) -> Outcome<()> {
    Ok(files::write(Path::new(path), bytes)?)
}

/// Checks the mesh at `path` and mends it, if need be into a file beside it, `path` with `.mended.obj` added. As JSON; see
/// [`meshes::Checked`].
#[wasm_bindgen]
pub fn check_mesh(path: &str, unit: Option<String>, thickness: Option<f64>) -> Outcome<String> {
    let unit = unit.map(|unit| unit.parse()).transpose()?;
    let checked = meshes::check(Path::new(path), unit, thickness, &PageProgress)?;
    if let Some(obj) = &checked.obj {
        put_file(&format!("{path}.mended.obj"), obj)?;
    }
    json(&checked)
}

/// The bytes of a file that was handed over or made.
#[wasm_bindgen]
pub fn get_file(path: &str) -> Outcome<Vec<u8>> {
    Ok(files::read(Path::new(path))?)
}

/// [`session::Session`].
#[wasm_bindgen]
pub struct Session(session::Session);

/// [`run::Run`].
#[wasm_bindgen]
pub struct Run(run::Run);

/// [`skin::Skin`].
#[wasm_bindgen]
pub struct Skin(skin::Skin);

/// [`many::Many`].
#[wasm_bindgen]
pub struct Many(many::Many);

#[wasm_bindgen]
impl Session {
    /// Reads a scene and bakes its body; see [`session::Session::open`].
    #[wasm_bindgen(constructor)]
    pub fn open(name: &str, text: &str) -> Outcome<Session> {
        Ok(Self(session::Session::open(
            name,
            text,
            Some(Path::new(BAKES)),
            &PageProgress,
        )?))
    }

    /// The scene in words and numbers, as JSON: [`crate::describe::Description`].
    pub fn describe(&self) -> Outcome<String> {
        json(&self.0.describe())
    }

    /// The skin of one of its kinds of bodies.
    pub fn skin(&self, kind: usize) -> Outcome<Skin> {
        let body = self.0.kinds().nth(kind).map(|(_, body)| body);
        let body = body.ok_or_else(|| JsError::new("there is no such kind of body"))?;
        Ok(Skin(skin::Skin::new(body)))
    }

    /// The skin of its own body for drawing many of it.
    pub fn coarse_skin(&self) -> Skin {
        Skin(skin::Skin::coarse(self.0.prepared().body()))
    }

    /// See [`session::Session::drop`].
    pub fn drop(&self) -> Outcome<Run> {
        Ok(Run(self.0.drop(&PageProgress)?))
    }

    /// See [`session::Session::replay`]; from the tables as text.
    pub fn replay(&self, trajectory: &str, bodies: Option<String>) -> Outcome<Run> {
        let rows = bodies.as_deref().map(read_bodies).transpose()?;
        let trajectories = read_csv(trajectory)?;
        Ok(Run(self
            .0
            .replay(trajectories, &rows.unwrap_or_default())?))
    }

    /// The curves of a run, one after the other, in the order of [`crate::curves::Curves`].
    pub fn curves(&self, run: &Run) -> Vec<f32> {
        let curves = self.0.curves(&run.0);
        let columns = [
            curves.speed,
            curves.tilt,
            curves.spin,
            curves.energy,
            curves.attachment,
        ];
        columns.concat()
    }

    /// See [`session::Session::loads`].
    pub fn loads(&self, run: &Run) -> Vec<f32> {
        self.0.loads(&run.0)
    }

    /// Pressures (Pa) at a frame, at the vertices of the skin; empty where there is no such frame.
    pub fn pressures(&self, skin: &Skin, run: &Run, frame: usize) -> Vec<f32> {
        let state = run.0.states().get(frame);
        state.map_or_else(Vec::new, |state| self.0.pressures(&skin.0, state))
    }

    /// The ends of the falls of some runs of the scene's ensemble, as JSON: [`landings::Landing`].
    pub fn landings(&self, from: u32, to: u32) -> Outcome<String> {
        let landings: Vec<landings::Landing> = self.0.landings(from..to);
        json(&landings)
    }

    /// The run as a file: `glb`, `csv` or `usd`.
    pub fn export(&self, run: &Run, format: &str, fps: f64) -> Outcome<Vec<u8>> {
        let format: Format = format.parse()?;
        let cast = Cast::new(self.0.prepared())?;
        let kinds = cast.kinds();
        let bodies = run.0.recorded();
        let recording = Recording {
            conditions: self.0.prepared().scene().conditions(),
            kinds: &kinds,
            bodies: &bodies,
        };
        let folder = Path::new("/export");
        let how = Options {
            fps,
            ..Options::default()
        };
        write(&recording, format, folder, &how)?;
        let made = files::take(&folder.join(format.file_name()));
        made.ok_or_else(|| JsError::new("nothing was written"))
    }
}

#[wasm_bindgen]
impl Run {
    /// Its bodies, as JSON: [`crate::run::Body`].
    pub fn bodies(&self) -> Outcome<String> {
        json(&self.0.bodies())
    }

    /// Time of each frame (s).
    pub fn times(&self) -> Vec<f64> {
        self.0.frames().times.clone()
    }

    /// Poses of the body in this place: seven numbers a frame from its first.
    pub fn poses(&self, place: usize) -> Vec<f32> {
        let poses = self.0.frames().poses.get(place);
        poses.map_or_else(Vec::new, |poses| poses.as_flattened().to_vec())
    }
}

#[wasm_bindgen]
impl Skin {
    /// Three numbers a vertex.
    pub fn positions(&self) -> Vec<f32> {
        self.0.positions.as_flattened().to_vec()
    }

    /// Three numbers a vertex.
    pub fn normals(&self) -> Vec<f32> {
        self.0.normals.as_flattened().to_vec()
    }

    /// Three numbers a triangle.
    pub fn triangles(&self) -> Vec<u32> {
        self.0.triangles.as_flattened().to_vec()
    }
}

#[wasm_bindgen]
impl Many {
    /// See [`many::Many::new`].
    #[wasm_bindgen(constructor)]
    pub fn new(session: &Session, count: u32) -> Outcome<Many> {
        Ok(Self(many::Many::new(&session.0, count)?))
    }

    /// See [`many::Many::advance`].
    pub fn advance(&mut self, session: &Session, duration: f64) {
        self.0.advance(&session.0, duration);
    }

    /// See [`many::Many::poses`].
    pub fn poses(&self) -> Vec<f32> {
        self.0.poses().to_vec()
    }

    /// See [`many::Many::room`]: sides, then the middle on the ground.
    pub fn room(&self) -> Vec<f64> {
        self.0.room().as_flattened().to_vec()
    }
}

/// Names of the loads by cause, in their order.
#[wasm_bindgen]
pub fn cause_names() -> Vec<String> {
    causes().into_iter().map(str::to_owned).collect()
}
