//! glTF 2.0 in one binary file: +Y up, metres, seconds, x y z w.
//!
//! One mesh that all bodies of a kind share, one node a body, one animation; bodies that end together
//! share their times.

use std::collections::HashMap;

use serde_json::{Value, json};

use super::animation::{Animation, Keyframes};
use super::frames::Frames;
use super::parameters::{KEY, of_body, of_kind, of_run};
use super::shading::{COLOUR, corner_normals};
use super::{ExportError, Kind, RecordedBody, Recording, Up};

/// Frames that single precision can tell apart.
const SINGLES: usize = 1 << 24;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The bytes of the file, and the animation in it.
pub(super) fn glb(
    recording: &Recording<'_>,
    fps: f64,
) -> Result<(Vec<u8>, Animation), ExportError> {
    let trajectories = recording.trajectories(Up::Y);
    let frames = Frames::of(&trajectories, fps)?;
    let lengths = recording.lengths();
    let animation = Animation::new(&trajectories, &lengths, frames, single)?
        .rounded(single, single)
        .compared(&trajectories, &lengths);
    let apart = |keyframes: &Keyframes| keyframes.times.windows(2).all(|pair| pair[0] < pair[1]);
    if !animation.bodies.iter().all(apart) {
        return Err(frames.too_many(SINGLES));
    }
    let mut file = File::default();
    let meshes: Vec<Value> = recording
        .kinds
        .iter()
        .map(|kind| file.mesh(recording, kind))
        .collect();
    let animations = file.animation(recording.conditions.scene, &animation);
    let [red, green, blue] = COLOUR;
    let document = json!({
        "asset": { "version": "2.0", "generator": concat!("Langevin Rigid ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{
            "name": recording.conditions.scene,
            "nodes": (0..animation.bodies.len()).collect::<Vec<_>>(),
            "extras": { KEY: of_run(recording, Up::Y, fps, animation.deviation) },
        }],
        "nodes": nodes(recording, &animation.bodies),
        "meshes": meshes,
        "materials": [{
            "name": "matt",
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": 0.8,
            },
        }],
        "animations": [animations],
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{ "byteLength": file.bytes.len() }],
    });
    Ok((container(&document, &file.bytes)?, animation))
}

/// To single precision and back.
fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

fn nodes(recording: &Recording<'_>, keyframes: &[Keyframes]) -> Vec<Value> {
    let node = |(body, keyframes): (&RecordedBody<'_>, &Keyframes)| {
        let name = recording.kind_of(body).name;
        let mut node = json!({
            "name": match recording.bodies.len() {
                1 => name.to_owned(),
                _ => format!("{name}.{:04}", keyframes.body),
            },
            "mesh": body.kind,
            "translation": keyframes.positions[0],
            "rotation": keyframes.orientations[0],
            "extras": { KEY: of_body(recording, body) },
        });
        if body.scale != 1.0 {
            node["scale"] = vec![body.scale; 3].into();
        }
        node
    };
    recording.bodies.iter().zip(keyframes).map(node).collect()
}

/// What the document points into.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl File {
    fn mesh(&mut self, recording: &Recording<'_>, kind: &Kind<'_>) -> Value {
        let surface = &kind.bake.body.surface;
        let corners = split_at_edges(&surface.vertices, &surface.triangles);
        let positions = self.vectors(&corners.positions, Some(ARRAY_BUFFER));
        self.bounds(positions, &corners.positions);
        let normals = self.vectors(&corners.normals, Some(ARRAY_BUFFER));
        let indices = self.indices(&corners.triangles);
        json!({
            "name": kind.name,
            "primitives": [{
                "attributes": { "POSITION": positions, "NORMAL": normals },
                "indices": indices,
                "material": 0,
            }],
            "extras": { KEY: of_kind(recording, kind) },
        })
    }

    fn animation(&mut self, name: &str, animation: &Animation) -> Value {
        let mut shared = HashMap::new();
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for (node, keyframes) in animation.bodies.iter().enumerate() {
            let input = self.times(keyframes, &mut shared);
            let outputs = [
                ("translation", self.vectors(&keyframes.positions, None)),
                ("rotation", self.vectors(&keyframes.orientations, None)),
            ];
            for (path, output) in outputs {
                channels.push(json!({
                    "sampler": samplers.len(), "target": { "node": node, "path": path },
                }));
                samplers.push(json!({
                    "input": input, "output": output, "interpolation": "LINEAR",
                }));
            }
        }
        json!({ "name": name, "samplers": samplers, "channels": channels })
    }

    /// Bodies with the same frames share their times.
    fn times(&mut self, keyframes: &Keyframes, shared: &mut HashMap<Vec<u64>, usize>) -> usize {
        let bits = keyframes.times.iter().map(|time| time.to_bits()).collect();
        *shared.entry(bits).or_insert_with(|| {
            let times: Vec<[f64; 1]> = keyframes.times.iter().map(|t| [*t]).collect();
            let accessor = self.vectors(&times, None);
            self.bounds(accessor, &times);
            accessor
        })
    }

    /// An accessor of single-precision numbers, with its view.
    fn vectors<const N: usize>(&mut self, vectors: &[[f64; N]], target: Option<u32>) -> usize {
        let start = self.bytes.len();
        self.bytes.reserve(4 * N * vectors.len());
        for x in vectors.as_flattened() {
            self.bytes.extend((*x as f32).to_le_bytes());
        }
        self.view(start, target);
        let kind = match N {
            1 => "SCALAR",
            3 => "VEC3",
            _ => "VEC4",
        };
        self.accessor(FLOAT, vectors.len(), kind)
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let start = self.bytes.len();
        for v in triangles.as_flattened() {
            self.bytes.extend(v.to_le_bytes());
        }
        self.view(start, Some(ELEMENT_ARRAY_BUFFER));
        self.accessor(UNSIGNED_INT, 3 * triangles.len(), "SCALAR")
    }

    fn view(&mut self, start: usize, target: Option<u32>) {
        let mut view = json!({
            "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start,
        });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
    }

    /// An accessor of all of the last view.
    fn accessor(&mut self, component: u32, count: usize, kind: &str) -> usize {
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": component,
            "count": count,
            "type": kind,
        }));
        self.accessors.len() - 1
    }

    /// Says between which numbers an accessor's are, as positions and times must.
    fn bounds<const N: usize>(&mut self, accessor: usize, vectors: &[[f64; N]]) {
        let bound = |f: fn(f64, f64) -> f64, start: f64| -> Vec<f64> {
            let component = |i: usize| vectors.iter().map(|v| single(v[i])).fold(start, f);
            (0..N).map(component).collect()
        };
        self.accessors[accessor]["min"] = bound(f64::min, f64::INFINITY).into();
        self.accessors[accessor]["max"] = bound(f64::max, f64::NEG_INFINITY).into();
    }
}

/// A mesh with a vertex for each normal of a vertex.
struct Corners {
    positions: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

fn split_at_edges(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Corners {
    let mut known: HashMap<(u32, [u32; 3]), u32> = HashMap::new();
    let mut corners = Corners {
        positions: Vec::new(),
        normals: Vec::new(),
        triangles: Vec::with_capacity(triangles.len()),
    };
    for (triangle, normals) in triangles.iter().zip(corner_normals(vertices, triangles)) {
        corners.triangles.push(std::array::from_fn(|k| {
            let key = (triangle[k], normals[k].map(|x| (x as f32).to_bits()));
            *known.entry(key).or_insert_with(|| {
                corners.positions.push(vertices[triangle[k] as usize]);
                corners.normals.push(normals[k]);
                corners.positions.len() as u32 - 1
            })
        }));
    }
    corners
}

/// Header, JSON chunk and binary chunk.
fn container(document: &Value, binary: &[u8]) -> Result<Vec<u8>, ExportError> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let binary_length = binary.len().next_multiple_of(4);
    let total = 12 + 8 + json.len() + 8 + binary_length;
    let length = |n: usize| {
        u32::try_from(n)
            .map(u32::to_le_bytes)
            .map_err(|_| ExportError::TooLarge {
                bytes: total as u64,
            })
    };
    let mut bytes = Vec::with_capacity(total);
    bytes.extend(b"glTF");
    bytes.extend(2u32.to_le_bytes());
    bytes.extend(length(total)?);
    bytes.extend(length(json.len())?);
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend(length(binary_length)?);
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes.resize(total, 0);
    Ok(bytes)
}
