//! glTF 2.0 in one binary file: +Y up, metres, seconds, x y z w.
//!
//! One mesh that all bodies of a kind share, or the meshes of its visual; one node a body, with those of the visual
//! below it; one animation. Bodies that end together share their times.

mod looks;

use std::collections::{BTreeSet, HashMap};

use serde_json::{Map, Value, json};

use super::animation::{Animation, Keyframes};
use super::frames::Frames;
use super::parameters::{KEY, of_body, of_kind, of_run};
use super::shading::{COLOUR, corner_normals};
use super::{ExportError, Kind, RecordedBody, Recording, Up};
use crate::visual::align;
use crate::visual::references::{List, Lists, MESHOPT};
use looks::Look;

/// Nodes that a file may have; each takes about a kilobyte until it is written.
const MOST_NODES: usize = 1_000_000;

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
    check_nodes(recording)?;
    let mut file = File::default();
    let shapes: Vec<Shape<'_>> = recording
        .kinds
        .iter()
        .map(|kind| match kind.visual {
            Some(visual) => Shape::Look(file.look(visual)),
            None => Shape::Mesh(file.mesh(recording, kind)),
        })
        .collect();
    let animations = file.animation(
        recording.conditions.scene,
        recording.bodies,
        &animation,
        frames,
    );
    let mut run = of_run(recording, Up::Y, fps, animation.deviation);
    let dressed = recording.kinds.iter().filter(|kind| kind.visual.is_some());
    let dressed: Map<String, Value> = dressed
        .map(|kind| (kind.name.to_owned(), of_kind(recording, kind).into()))
        .collect();
    if !dressed.is_empty() {
        run.insert("kinds".to_owned(), dressed.into());
    }
    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("Langevin Rigid ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{
            "name": recording.conditions.scene,
            "nodes": (0..animation.bodies.len()).collect::<Vec<_>>(),
            "extras": { KEY: run },
        }],
        "nodes": nodes(recording, &shapes, &animation.bodies),
        "animations": [animations],
    });
    let binary = file.finish(&mut document);
    Ok((container(&document, &binary)?, animation))
}

/// Refuses more nodes than fit into memory.
fn check_nodes(recording: &Recording<'_>) -> Result<(), ExportError> {
    let of_body = |body: &RecordedBody<'_>| {
        let visual = recording.kind_of(body).visual;
        1 + visual.map_or(0, |visual| 1 + visual.part.nodes.len())
    };
    let bodies = recording.bodies;
    let nodes = bodies.iter().map(of_body).fold(0, usize::saturating_add);
    // Bodies alone have been counted by their frames.
    match nodes > MOST_NODES.max(bodies.len()) {
        true => Err(ExportError::TooManyNodes {
            nodes,
            bodies: bodies.len(),
            most: MOST_NODES,
        }),
        false => Ok(()),
    }
}

/// What bodies of a kind show.
enum Shape<'a> {
    /// A mesh, by its number.
    Mesh(usize),
    /// The nodes of a visual.
    Look(Look<'a>),
}

/// To single precision and back.
fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

/// Nodes of the bodies, and after them those of their visuals.
fn nodes(recording: &Recording<'_>, shapes: &[Shape<'_>], keyframes: &[Keyframes]) -> Vec<Value> {
    let node = |(body, keyframes): (&RecordedBody<'_>, &Keyframes)| {
        let name = recording.kind_of(body).name;
        let mut node = json!({
            "name": match recording.bodies.len() {
                1 => name.to_owned(),
                _ => format!("{name}.{:04}", keyframes.body),
            },
            "translation": keyframes.positions[0],
            "rotation": keyframes.orientations[0],
            "extras": { KEY: of_body(recording, body) },
        });
        if body.scale != 1.0 {
            node["scale"] = vec![body.scale; 3].into();
        }
        node
    };
    let mut nodes: Vec<Value> = recording.bodies.iter().zip(keyframes).map(node).collect();
    for (number, body) in recording.bodies.iter().enumerate() {
        match &shapes[body.kind] {
            Shape::Mesh(mesh) => nodes[number]["mesh"] = (*mesh).into(),
            Shape::Look(look) => look.hang(number, &mut nodes),
        }
    }
    nodes
}

/// What the document points into.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    lists: Lists,
    /// Bytes of what is compressed by meshoptimizer, once it is not.
    decompressed: usize,
    used: BTreeSet<String>,
    required: BTreeSet<String>,
    /// The material of surfaces.
    matt: Option<usize>,
}

impl File {
    /// Puts all lists into the document, and gives the bytes of its buffer.
    fn finish(self, document: &mut Value) -> Vec<u8> {
        let mut lists = self.lists;
        for list in List::ALL {
            let members = std::mem::take(&mut lists[list]);
            if !members.is_empty() {
                document[list.key()] = members.into();
            }
        }
        let mut buffers = vec![json!({ "byteLength": self.bytes.len() })];
        if self.decompressed > 0 {
            let fallback = json!({ "fallback": true });
            let names = self.used.iter().filter(|n| MESHOPT.contains(&n.as_str()));
            let extensions: Map<String, Value> =
                names.map(|name| (name.clone(), fallback.clone())).collect();
            buffers.push(json!({ "byteLength": self.decompressed, "extensions": extensions }));
        }
        document["buffers"] = buffers.into();
        let names = [
            ("extensionsUsed", self.used),
            ("extensionsRequired", self.required),
        ];
        for (key, names) in names.into_iter().filter(|(_, names)| !names.is_empty()) {
            document[key] = names.into_iter().collect::<Vec<_>>().into();
        }
        self.bytes
    }

    /// The number of the material of surfaces.
    fn matt(&mut self) -> usize {
        let materials = &mut self.lists[List::Materials];
        *self.matt.get_or_insert_with(|| {
            let [red, green, blue] = COLOUR;
            materials.push(json!({
                "name": "matt",
                "pbrMetallicRoughness": {
                    "baseColorFactor": [red, green, blue, 1.0],
                    "metallicFactor": 0.0,
                    "roughnessFactor": 0.8,
                },
            }));
            materials.len() - 1
        })
    }

    /// The number of a kind's mesh.
    fn mesh(&mut self, recording: &Recording<'_>, kind: &Kind<'_>) -> usize {
        let surface = &kind.bake.body.surface;
        let corners = split_at_edges(&surface.vertices, &surface.triangles);
        let positions = self.vectors(&corners.positions, Some(ARRAY_BUFFER));
        self.bounds(positions, &corners.positions);
        let normals = self.vectors(&corners.normals, Some(ARRAY_BUFFER));
        let indices = self.indices(&corners.triangles);
        let material = self.matt();
        self.lists[List::Meshes].push(json!({
            "name": kind.name,
            "primitives": [{
                "attributes": { "POSITION": positions, "NORMAL": normals },
                "indices": indices,
                "material": material,
            }],
            "extras": { KEY: of_kind(recording, kind) },
        }));
        self.lists[List::Meshes].len() - 1
    }

    fn animation(
        &mut self,
        name: &str,
        bodies: &[RecordedBody<'_>],
        animation: &Animation,
        frames: Frames,
    ) -> Value {
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
            if let Some(time) = keyframes.appears.map(|number| frames.time(number)) {
                // Until then it has no size: the format has no other way to hide it.
                let scale = bodies[node].scale;
                let input = self.vectors(&[[frames.start], [time]], None);
                self.bounds(input, &[[frames.start], [time]]);
                let output = self.vectors(&[[0.0; 3], [scale; 3]], None);
                channels.push(json!({
                    "sampler": samplers.len(), "target": { "node": node, "path": "scale" },
                }));
                samplers.push(json!({
                    "input": input, "output": output, "interpolation": "STEP",
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
        let start = align(&mut self.bytes);
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
        let start = align(&mut self.bytes);
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
        self.lists[List::BufferViews].push(view);
    }

    /// An accessor of all of the last view.
    fn accessor(&mut self, component: u32, count: usize, kind: &str) -> usize {
        let view = self.lists[List::BufferViews].len() - 1;
        let accessors = &mut self.lists[List::Accessors];
        accessors.push(json!({
            "bufferView": view,
            "componentType": component,
            "count": count,
            "type": kind,
        }));
        accessors.len() - 1
    }

    /// Says between which numbers an accessor's are, as positions and times must.
    fn bounds<const N: usize>(&mut self, accessor: usize, vectors: &[[f64; N]]) {
        let bound = |f: fn(f64, f64) -> f64, start: f64| -> Vec<f64> {
            let component = |i: usize| vectors.iter().map(|v| single(v[i])).fold(start, f);
            (0..N).map(component).collect()
        };
        self.lists[List::Accessors][accessor]["min"] = bound(f64::min, f64::INFINITY).into();
        self.lists[List::Accessors][accessor]["max"] = bound(f64::max, f64::NEG_INFINITY).into();
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
