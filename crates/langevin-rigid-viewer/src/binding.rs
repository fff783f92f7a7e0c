//! What the page calls.
//!
//! Whatever has names comes as JSON, whatever is long as arrays of numbers. Errors are of JavaScript's `Error`, in the words
//! of the library.

use std::path::Path;

use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::export::{
    Format, Options, RecordedBody, Recording, read_bodies, write,
};
use langevin_rigid_formats::files;
use langevin_rigid_formats::trajectory::{Trajectory, read_csv};
use langevin_rigid_scenes::cast::Cast;
use langevin_rigid_scenes::scene::{BUILT_IN, Scene};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::curves::causes;
use crate::many::Many;
use crate::run::Run;
use crate::session::Session;
use crate::skin::Skin;
use crate::{landings, meshes};

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

/// The text of a scene with every choice spelled out.
#[wasm_bindgen]
pub fn spelled_out(name: &str, text: &str) -> Outcome<String> {
    Ok(Scene::parse(name, name, text)?.to_toml()?)
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

#[wasm_bindgen]
impl Session {
    /// Reads a scene and bakes its body; see [`Session::open`].
    #[wasm_bindgen(constructor)]
    pub fn of_text(name: &str, text: &str) -> Outcome<Session> {
        Ok(Self::open(
            name,
            text,
            Some(Path::new(BAKES)),
            &PageProgress,
        )?)
    }

    /// The scene in words and numbers, as JSON: [`crate::describe::Description`].
    #[wasm_bindgen(js_name = describe)]
    pub fn described(&self) -> Outcome<String> {
        json(&self.describe())
    }

    /// The skin of one of its kinds of bodies.
    #[wasm_bindgen(js_name = skin)]
    pub fn skin_of(&self, kind: usize) -> Outcome<Skin> {
        let body = self.kinds().nth(kind).map(|(_, body)| body);
        Ok(Skin::new(body.ok_or_else(|| {
            JsError::new("there is no such kind of body")
        })?))
    }

    /// See [`Session::drop`].
    #[wasm_bindgen(js_name = drop)]
    pub fn dropped(&self) -> Outcome<Run> {
        Ok(self.drop(&PageProgress)?)
    }

    /// See [`Session::replay`]; from the tables as text.
    #[wasm_bindgen(js_name = replay)]
    pub fn replayed(&self, trajectory: &str, bodies: Option<String>) -> Outcome<Run> {
        let rows = bodies.as_deref().map(read_bodies).transpose()?;
        Ok(self.replay(read_csv(trajectory)?, &rows.unwrap_or_default())?)
    }

    /// The curves of a run, one after the other, in the order of [`crate::curves::Curves`].
    #[wasm_bindgen(js_name = curves)]
    pub fn curve_numbers(&self, run: &Run) -> Vec<f32> {
        let curves = self.curves(run);
        let columns = [
            curves.speed,
            curves.tilt,
            curves.spin,
            curves.kinetic,
            curves.energy,
            curves.attachment,
        ];
        columns.concat()
    }

    /// See [`Session::loads`].
    #[wasm_bindgen(js_name = loads)]
    pub fn load_numbers(&self, run: &Run) -> Vec<f32> {
        self.loads(run)
    }

    /// See [`Session::flow`].
    #[wasm_bindgen(js_name = flow)]
    pub fn flow_numbers(&self, run: &Run) -> Vec<f32> {
        self.flow(run)
    }

    /// Pressures (Pa) at a frame, at the vertices of the skin; empty where there is no such frame.
    #[wasm_bindgen(js_name = pressures)]
    pub fn pressures_at(&self, skin: &Skin, run: &Run, frame: usize) -> Vec<f32> {
        let state = run.states().get(frame);
        state.map_or_else(Vec::new, |state| self.pressures(skin, state))
    }

    /// The ends of the falls of some runs of the scene's ensemble, as JSON: [`landings::Landing`].
    #[wasm_bindgen(js_name = landings)]
    pub fn landings_of(&self, from: u32, to: u32) -> Outcome<String> {
        let landings: Vec<landings::Landing> = self.landings(from..to);
        json(&landings)
    }

    /// The run as a file: `glb`, `csv` or `usd`.
    #[wasm_bindgen(js_name = export)]
    pub fn exported(&self, run: &Run, format: &str, fps: f64) -> Outcome<Vec<u8>> {
        let format: Format = format.parse()?;
        let cast = Cast::new(self.prepared())?;
        let kinds = cast.kinds();
        let bodies = run.bodies().iter().zip(run.trajectories());
        let bodies: Vec<RecordedBody<'_>> = bodies
            .map(|(body, trajectory): (_, &Trajectory)| RecordedBody {
                kind: body.kind,
                scale: body.scale,
                trajectory,
            })
            .collect();
        let recording = Recording {
            conditions: self.prepared().scene().conditions(),
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
    #[wasm_bindgen(js_name = bodies)]
    pub fn bodies_told(&self) -> Outcome<String> {
        json(&self.bodies())
    }

    /// Time of each frame (s).
    #[wasm_bindgen(js_name = times)]
    pub fn frame_times(&self) -> Vec<f64> {
        self.frames().times.clone()
    }

    /// Poses of the body in this place: seven numbers a frame from its first.
    #[wasm_bindgen(js_name = poses)]
    pub fn poses_of(&self, place: usize) -> Vec<f32> {
        let poses = self.frames().poses.get(place);
        poses.map_or_else(Vec::new, |poses| poses.as_flattened().to_vec())
    }
}

#[wasm_bindgen]
impl Skin {
    /// Three numbers a vertex.
    #[wasm_bindgen(js_name = positions)]
    pub fn position_numbers(&self) -> Vec<f32> {
        self.positions.as_flattened().to_vec()
    }

    /// Three numbers a vertex.
    #[wasm_bindgen(js_name = normals)]
    pub fn normal_numbers(&self) -> Vec<f32> {
        self.normals.as_flattened().to_vec()
    }

    /// Three numbers a triangle.
    #[wasm_bindgen(js_name = triangles)]
    pub fn triangle_numbers(&self) -> Vec<u32> {
        self.triangles.as_flattened().to_vec()
    }
}

#[wasm_bindgen]
impl Many {
    /// See [`Many::new`].
    #[wasm_bindgen(constructor)]
    pub fn of_session(session: &Session, count: u32) -> Many {
        Self::new(session, count)
    }

    /// See [`Many::advance`].
    #[wasm_bindgen(js_name = advance)]
    pub fn advanced(&mut self, session: &Session, duration: f64) {
        self.advance(session, duration);
    }

    /// See [`Many::poses`].
    #[wasm_bindgen(js_name = poses)]
    pub fn pose_numbers(&self) -> Vec<f32> {
        self.poses().to_vec()
    }

    /// See [`Many::room`]: sides, then the middle on the ground.
    #[wasm_bindgen(js_name = room)]
    pub fn room_numbers(&self) -> Vec<f64> {
        self.room().as_flattened().to_vec()
    }
}

/// Names of the loads by cause, in their order.
#[wasm_bindgen]
pub fn cause_names() -> Vec<String> {
    causes().into_iter().map(str::to_owned).collect()
}
