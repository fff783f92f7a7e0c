//! OpenUSD as text: metres, seconds, quaternions w x y z.
//!
//! One shape a kind, which its bodies reference; one transform a body with samples of translation and orientation.

use std::fmt::{Display, Write as _};
use std::io;

use rayon::prelude::*;
use serde_json::{Map, Value};

use super::animation::{Animation, Keyframes};
use super::frames::Frames;
use super::parameters::{KEY, of_body, of_kind, of_run};
use super::shading::{COLOUR, corner_normals};
use super::{ExportError, Kind, Options, RecordedBody, Recording};

/// Decimals of quaternions.
const TURN_DECIMALS: i32 = 7;

/// Share of the body's size that positions are rounded to.
const FINE: f64 = 1e-5;

/// Bodies that are put into words at a time.
const BATCH: usize = 32;

/// A layer, ready to be written.
pub(super) struct Layer<'a> {
    recording: &'a Recording<'a>,
    options: Options,
    frames: Frames,
    pub(super) animation: Animation,
    /// Decimals of positions.
    decimals: i32,
}

impl<'a> Layer<'a> {
    pub(super) fn new(
        recording: &'a Recording<'a>,
        options: &Options,
    ) -> Result<Self, ExportError> {
        let trajectories = recording.trajectories(options.up);
        let frames = Frames::of(&trajectories, options.fps)?;
        let lengths = recording.lengths();
        let size = 0.5 * lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let decimals = (-libm::log10(FINE * size)).ceil().clamp(6.0, 15.0) as i32;
        let animation = Animation::new(&trajectories, &lengths, frames, |time| time)?
            .rounded(rounding(decimals), rounding(TURN_DECIMALS))
            .compared(&trajectories, &lengths);
        Ok(Self {
            recording,
            options: *options,
            frames,
            animation,
            decimals,
        })
    }

    pub(super) fn write(&self, out: &mut impl io::Write) -> io::Result<()> {
        write!(out, "{}{}", self.head(), self.shapes())?;
        let (bodies, keyframes) = (self.recording.bodies, &self.animation.bodies);
        for (bodies, keyframes) in bodies.chunks(BATCH).zip(keyframes.chunks(BATCH)) {
            let bodies: Vec<String> = bodies
                .par_iter()
                .zip(keyframes)
                .map(|(body, keyframes)| self.body(body, keyframes))
                .collect();
            bodies
                .iter()
                .try_for_each(|body| out.write_all(body.as_bytes()))?;
        }
        writeln!(out, "}}")
    }

    /// The layer's metadata, and the beginning of the prim that holds all others.
    fn head(&self) -> String {
        let Frames { fps, start, .. } = self.frames;
        let ends = self.animation.bodies.iter().flat_map(|t| t.numbers.last());
        let first = fps * start;
        let last = first + ends.fold(0.0, |last: f64, end| last.max(*end));
        let run = of_run(
            self.recording,
            self.options.up,
            fps,
            self.animation.deviation,
        );
        format!(
            "#usda 1.0\n(\n    \
             defaultPrim = \"World\"\n    \
             doc = \"Langevin Rigid {version}: {scene}\"\n    \
             endTimeCode = {last}\n    \
             framesPerSecond = {fps}\n    \
             kilogramsPerUnit = 1\n    \
             metersPerUnit = 1\n    \
             startTimeCode = {first}\n    \
             timeCodesPerSecond = {fps}\n    \
             upAxis = \"{up}\"\n)\n\n\
             def Xform \"World\" (\n{data})\n{{\n",
            version = env!("CARGO_PKG_VERSION"),
            scene = escaped(self.recording.conditions.scene),
            up = self.options.up.to_string().to_uppercase(),
            data = custom_data(&run, 1),
        )
    }

    /// The surface of each kind: a class, which is seen only where it is referenced.
    fn shapes(&self) -> String {
        if let [kind] = self.recording.kinds {
            return self.shape("Shape", kind, 1);
        }
        let kinds = self.recording.kinds.iter().enumerate();
        let shapes: String = kinds
            .map(|(number, kind)| self.shape(&shape_name(number, kind), kind, 2))
            .collect();
        format!("    class Scope \"Shapes\"\n    {{\n{shapes}    }}\n")
    }

    /// The path of what a body references.
    fn shape_of(&self, body: &RecordedBody<'_>) -> String {
        match self.recording.kinds {
            [_] => "/World/Shape".to_owned(),
            kinds => {
                let name = shape_name(body.kind, &kinds[body.kind]);
                format!("/World/Shapes/{name}")
            }
        }
    }

    /// The surface of a kind, `depth` levels in.
    fn shape(&self, name: &str, kind: &Kind<'_>, depth: usize) -> String {
        let surface = &kind.bake.body.surface;
        let used = surface.triangles.as_flattened().iter().max();
        let count = used.map_or(0, |v| *v as usize + 1);
        let vertices = &surface.vertices[..count];
        let normals = corner_normals(vertices, &surface.triangles);
        let extent = bounds(vertices);
        let indent = "    ".repeat(depth);
        let text = format!(
            "class Xform \"{name}\" (\n{data})\n{{\n    \
             def Mesh \"{mesh}\"\n    {{\n        \
             uniform bool doubleSided = 0\n        \
             float3[] extent = {extent}\n        \
             int[] faceVertexCounts = {counts}\n        \
             int[] faceVertexIndices = {indices}\n        \
             normal3f[] normals = {normals} (\n            interpolation = \"faceVarying\"\n        )\n        \
             uniform token orientation = \"rightHanded\"\n        \
             point3f[] points = {points}\n        \
             color3f[] primvars:displayColor = [{colour}]\n        \
             uniform token subdivisionScheme = \"none\"\n    }}\n}}\n",
            mesh = identifier(kind.name),
            data = custom_data(&of_kind(self.recording, kind), 1),
            colour = tuple(&COLOUR),
            extent = list(extent.iter().map(|v| tuple(&v.map(single)))),
            counts = list(surface.triangles.iter().map(|_| 3)),
            indices = list(surface.triangles.as_flattened()),
            normals = list(normals.as_flattened().iter().map(|v| tuple(&v.map(single)))),
            points = list(vertices.iter().map(|v| tuple(&v.map(single)))),
        );
        text.lines()
            .map(|line| format!("{indent}{line}\n"))
            .collect()
    }

    fn body(&self, body: &RecordedBody<'_>, keyframes: &Keyframes) -> String {
        let mut text = String::with_capacity(128 * keyframes.positions.len());
        let name = identifier(self.recording.kind_of(body).name);
        let (metres, turns) = (self.decimals as usize, TURN_DECIMALS as usize);
        let first = self.frames.fps * self.frames.start;
        let codes = || keyframes.numbers.iter().map(|number| first + number);
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n    def Xform \"{name}_{number}\" (\n{data}        \
             instanceable = {several}\n        \
             references = <{shape}>\n    )\n    {{\n        \
             double3 xformOp:translate.timeSamples = {{",
            number = keyframes.body,
            data = custom_data(&of_body(self.recording, body), 2),
            // Programs show an instance as a whole; one body alone is a mesh like any other.
            several = self.animation.bodies.len() > 1,
            shape = self.shape_of(body),
        );
        for (code, [x, y, z]) in codes().zip(&keyframes.positions) {
            let _ = write!(text, "{code}:({x:.metres$},{y:.metres$},{z:.metres$}),");
        }
        text.push_str("}\n        quatd xformOp:orient.timeSamples = {");
        for (code, [x, y, z, w]) in codes().zip(&keyframes.orientations) {
            let _ = write!(
                text,
                "{code}:({w:.turns$},{x:.turns$},{y:.turns$},{z:.turns$}),"
            );
        }
        text.push_str("}\n");
        let mut order = vec!["\"xformOp:translate\"", "\"xformOp:orient\""];
        if body.scale != 1.0 {
            let scale = tuple(&[body.scale; 3]);
            let _ = writeln!(text, "        double3 xformOp:scale = {scale}");
            order.push("\"xformOp:scale\"");
        }
        if let Some(number) = keyframes.appears {
            let appears = first + number;
            let _ = writeln!(
                text,
                "        token visibility.timeSamples = {{{first}:\"invisible\",{appears}:\"inherited\"}}"
            );
        }
        let _ = writeln!(
            text,
            "        uniform token[] xformOpOrder = {}\n    }}",
            list(order)
        );
        text
    }
}

/// A kind's prim, which no other kind's is called.
fn shape_name(number: usize, kind: &Kind<'_>) -> String {
    format!("{}_{number}", identifier(kind.name))
}

/// To so many decimals, as they are printed.
fn rounding(decimals: i32) -> impl Fn(f64) -> f64 + Sync {
    let scale = libm::pow(10.0, f64::from(decimals));
    move |x| (x * scale).round() / scale
}

/// Shorter to print than a double, and all that a float keeps.
fn single(x: f64) -> f32 {
    x as f32
}

fn bounds(points: &[[f64; 3]]) -> [[f64; 3]; 2] {
    let bound = |f: fn(f64, f64) -> f64, start: f64| {
        std::array::from_fn(|i| points.iter().map(|p| p[i]).fold(start, f))
    };
    [
        bound(f64::min, f64::INFINITY),
        bound(f64::max, f64::NEG_INFINITY),
    ]
}

fn list<T: Display>(items: impl IntoIterator<Item = T>) -> String {
    let items: Vec<String> = items.into_iter().map(|item| item.to_string()).collect();
    format!("[{}]", items.join(", "))
}

fn tuple<T: Display, const N: usize>(items: &[T; N]) -> String {
    let items: Vec<String> = items.iter().map(ToString::to_string).collect();
    format!("({})", items.join(", "))
}

/// Letters, digits and underscores, no digit first: what prims may be called.
fn identifier(name: &str) -> String {
    let mut name = name.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name.insert(0, '_');
    }
    name
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// `customData` of a prim, `depth` levels in.
fn custom_data(parameters: &Map<String, Value>, depth: usize) -> String {
    let indent = "    ".repeat(depth);
    let mut text = format!("{indent}customData = {{\n{indent}    dictionary {KEY} = {{\n");
    for (name, value) in parameters {
        let (kind, value) = typed(value);
        let _ = writeln!(text, "{indent}        {kind} {name} = {value}");
    }
    let _ = writeln!(text, "{indent}    }}\n{indent}}}");
    text
}

fn typed(value: &Value) -> (&'static str, String) {
    match value {
        Value::String(text) => ("string", format!("\"{}\"", escaped(text))),
        Value::Array(numbers) => ("double[]", list(numbers)),
        Value::Number(count) if count.is_u64() => ("int", count.to_string()),
        number => ("double", number.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_identifiers() {
        assert_eq!(identifier("paper-75"), "paper_75");
        assert_eq!(identifier("75 leaves"), "_75_leaves");
        assert_eq!(identifier(""), "_");
    }
}
