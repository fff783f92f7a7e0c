//! Wavefront OBJ: vertex positions and faces; everything else is passed over.

use std::io;

use langevin_rigid_bake::TriMesh;

use super::{ParseError, Place, RawMesh, fan};

/// Reads the positions and polygons of all objects and groups.
pub(super) fn parse(bytes: &[u8]) -> Result<RawMesh, ParseError> {
    let text = String::from_utf8_lossy(bytes);
    let lines = logical_lines(&text);
    let total = lines
        .iter()
        .filter(|(_, line)| keyword(line) == Some("v"))
        .count();
    let mut mesh = RawMesh::default();
    for (number, line) in &lines {
        let words = line.split_ascii_whitespace().skip(1);
        let result = match keyword(line) {
            Some("v") => add_vertex(&mut mesh, words),
            Some("f") => add_face(&mut mesh, words, total),
            _ => Ok(()),
        };
        result.map_err(|reason| ParseError::at(Place::Line(*number), reason))?;
    }
    Ok(mesh)
}

fn keyword(line: &str) -> Option<&str> {
    line.split_ascii_whitespace().next()
}

/// Lines with their numbers, without comments, joined where one ends in a backslash.
fn logical_lines(text: &str) -> Vec<(usize, String)> {
    let mut lines: Vec<(usize, String)> = Vec::new();
    let mut continued = false;
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim_end();
        let body = line.strip_suffix('\\').unwrap_or(line);
        match lines.last_mut() {
            Some((_, last)) if continued => {
                last.push(' ');
                last.push_str(body);
            }
            _ => lines.push((index + 1, body.to_owned())),
        }
        continued = body.len() < line.len();
    }
    lines
}

fn add_vertex<'a>(
    mesh: &mut RawMesh,
    mut words: impl Iterator<Item = &'a str>,
) -> Result<(), String> {
    let mut position = [0.0; 3];
    for x in &mut position {
        let word = words.next().ok_or("a vertex needs three coordinates")?;
        *x = word
            .parse()
            .map_err(|_| format!("`{word}` is not a number"))?;
    }
    mesh.vertices.push(position);
    Ok(())
}

fn add_face<'a>(
    mesh: &mut RawMesh,
    words: impl Iterator<Item = &'a str>,
    total: usize,
) -> Result<(), String> {
    let so_far = mesh.vertices.len();
    let corners: Vec<u32> = words
        .map(|w| vertex_number(w, so_far, total))
        .collect::<Result<_, _>>()?;
    if corners.len() < 3 {
        return Err(format!("a face needs three corners, not {}", corners.len()));
    }
    mesh.triangles.extend(fan(&corners));
    Ok(())
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
