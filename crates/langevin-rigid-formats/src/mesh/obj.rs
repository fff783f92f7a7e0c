//! Wavefront OBJ: vertex positions and faces; everything else is passed over.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;

use langevin_rigid_bake::TriMesh;

use super::polygon::Polygons;
use super::text::{self, Numbers};
use super::{ParseError, Place, RawMesh};

/// Whether a line of the file is a vertex.
pub(super) fn has_vertices(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|b| *b == b'\n' || *b == b'\r');
    lines.any(|line| {
        let line = line.trim_ascii_start();
        matches!(line, [b'v' | b'V', b' ' | b'\t', ..])
    })
}

/// Reads the positions and polygons of all objects and groups.
pub(super) fn parse(bytes: &[u8]) -> Result<RawMesh, ParseError> {
    let file = text::decode(bytes);
    let keywords = logical_lines(&file.text).map(|(_, line)| keyword(&line));
    let mut reader = Reader {
        total: keywords.filter(|k| *k == Keyword::Vertex).count(),
        ..Reader::default()
    };
    for (number, line) in logical_lines(&file.text) {
        let words = line.split_ascii_whitespace().skip(1);
        let result = match keyword(&line) {
            Keyword::Vertex => reader.vertex(number, words),
            Keyword::Face => reader.face(words),
            Keyword::Curved => {
                reader.curved = true;
                Ok(())
            }
            Keyword::Other => Ok(()),
        };
        result.map_err(|reason| ParseError::at(Place::Line(number), reason))?;
    }
    reader.finish(file.notices)
}

#[derive(Clone, Copy, PartialEq)]
enum Keyword {
    Vertex,
    Face,
    /// A free-form curve or surface.
    Curved,
    Other,
}

fn keyword(line: &str) -> Keyword {
    let word = line.split_ascii_whitespace().next().unwrap_or_default();
    let is = |name: &str| word.eq_ignore_ascii_case(name);
    if is("v") {
        Keyword::Vertex
    } else if is("f") || is("fo") {
        Keyword::Face
    } else if is("curv") || is("curv2") || is("surf") {
        Keyword::Curved
    } else {
        Keyword::Other
    }
}

/// Lines with their numbers, without comments, joined where one ends in a backslash.
fn logical_lines(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut lines = text::lines(text).map(|(n, line)| (n, text::without_comment(line).trim_end()));
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let Some(begun) = line.strip_suffix('\\') else {
            return Some((number, Cow::Borrowed(line)));
        };
        let mut whole = begun.to_owned();
        for (_, line) in lines.by_ref() {
            let body = line.strip_suffix('\\').unwrap_or(line);
            whole.push(' ');
            whole.push_str(body);
            if body.len() == line.len() {
                break;
            }
        }
        Some((number, Cow::Owned(whole)))
    })
}

#[derive(Default)]
struct Reader {
    vertices: Vec<[f64; 3]>,
    polygons: Polygons,
    /// Number of vertices of the whole file.
    total: usize,
    numbers: Numbers,
    /// Vertices with a coordinate that is not finite, with what is wrong and where.
    broken: BTreeMap<u32, (usize, String)>,
    /// Whether vertices have numbers beside their position.
    extra: bool,
    curved: bool,
}

impl Reader {
    fn vertex<'a>(
        &mut self,
        line: usize,
        mut words: impl Iterator<Item = &'a str>,
    ) -> Result<(), String> {
        let mut position = [0.0; 3];
        for x in &mut position {
            let word = words.next().ok_or("a vertex needs three coordinates")?;
            *x = self.numbers.any(word)?;
            if !x.is_finite() {
                let reason = format!("a face has this vertex, and `{word}` is not a number");
                self.broken
                    .insert(self.vertices.len() as u32, (line, reason));
            }
        }
        for word in words {
            self.numbers.any(word)?;
            self.extra = true;
        }
        self.vertices.push(position);
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let corners: Vec<u32> = words
            .map(|w| vertex_number(w, self.vertices.len(), self.total))
            .collect::<Result<_, _>>()?;
        if corners.len() < 3 {
            return Err(format!("a face needs three corners, not {}", corners.len()));
        }
        self.polygons.push(corners);
        Ok(())
    }

    fn finish(self, notices: Vec<String>) -> Result<RawMesh, ParseError> {
        let mut used = self.polygons.corners().iter();
        if let Some((line, reason)) = used.find_map(|v| self.broken.get(v)) {
            return Err(ParseError::at(Place::Line(*line), reason));
        }
        let (triangles, faces) = self.polygons.triangles(&self.vertices);
        let mut mesh = RawMesh {
            vertices: self.vertices,
            triangles,
            notices,
            ..RawMesh::default()
        };
        mesh.notices.extend(faces);
        mesh.notices.extend(self.numbers.notice());
        if self.extra {
            mesh.note("passed over what vertices have beside x, y, z (weights or colours)");
        }
        if self.curved {
            mesh.note("passed over its free-form curves and surfaces: export them as polygons to have them");
        }
        if !self.broken.is_empty() {
            mesh.drop_unused();
            mesh.note("dropped vertices that have no position and no face");
        }
        Ok(mesh)
    }
}

/// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or back from the last vertex
/// so far if negative.
fn vertex_number(word: &str, so_far: usize, total: usize) -> Result<u32, String> {
    let first = word.split('/').next().unwrap_or_default();
    let number: i64 = first
        .parse()
        .map_err(|_| format!("`{word}` is not a vertex number"))?;
    let index = match number {
        1.. => Some(number - 1),
        0 => None,
        _ => number.checked_add(so_far as i64),
    };
    let index = index
        .and_then(|i| u32::try_from(i).ok())
        .filter(|&i| (i as usize) < total);
    index.ok_or_else(|| format!("there is no vertex {number}, the file has {total}"))
}

/// Writes a mesh as Wavefront OBJ, positions in metres with all their digits.
///
/// ```
/// use langevin_rigid_bake::shapes::Shape;
/// use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat, parse_mesh, write_obj};
///
/// let brick = Shape::Box { size: [0.2, 0.1, 0.05] }.mesh(12)?;
/// let mut file = Vec::new();
/// write_obj(&brick, &mut file)?;
/// assert_eq!(parse_mesh(&file, MeshFormat::Obj, Some(LengthUnit::M), None)?.body()?, brick);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// What `out` reports.
pub fn write_obj(mesh: &TriMesh, mut out: impl io::Write) -> io::Result<()> {
    for [x, y, z] in mesh.vertices() {
        writeln!(out, "v {x} {y} {z}")?;
    }
    for [a, b, c] in mesh.triangles().iter().map(|t| t.map(|v| v + 1)) {
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}
