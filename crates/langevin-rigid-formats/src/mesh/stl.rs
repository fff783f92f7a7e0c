//! STL, text and binary.

use std::io;

use langevin_rigid_bake::TriMesh;

use super::{ParseError, Place, RawMesh};

/// Length of the header of a binary file, its count included.
const HEADER: usize = 84;
/// Length of a facet in a binary file: normal, three corners, two bytes of attributes.
const FACET: usize = 50;

/// Whether the length is what a binary file's count of facets says.
pub(super) fn has_binary_length(bytes: &[u8]) -> bool {
    facet_count(bytes)
        .is_some_and(|n| n > 0 && bytes.len() as u64 == HEADER as u64 + FACET as u64 * n)
}

/// Whether this is the text form. Binary headers may begin with "solid" too, but have zero bytes.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"solid") && !bytes.contains(&0)
}

fn facet_count(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u64::from(u32::from_le_bytes(count.try_into().ok()?)))
}

/// Reads the facets, three vertices each; the normals in the file are not used.
pub(super) fn parse(bytes: &[u8]) -> Result<RawMesh, ParseError> {
    let corners = if !has_binary_length(bytes) && is_text(bytes) {
        text_corners(bytes)?
    } else {
        binary_corners(bytes)?
    };
    let count = corners.len() as u32;
    let triangles = (0..count / 3)
        .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
        .collect();
    Ok(RawMesh {
        vertices: corners,
        triangles,
        ..RawMesh::default()
    })
}

fn binary_corners(bytes: &[u8]) -> Result<Vec<[f64; 3]>, ParseError> {
    let Some(count) = facet_count(bytes) else {
        let reason = "the file ends within the header of a binary STL file";
        return Err(ParseError::at(Place::Byte(bytes.len()), reason));
    };
    let facets = bytes[HEADER..].chunks_exact(FACET);
    if (facets.len() as u64) < count {
        let reason = format!("the file ends at facet {} of {count}", facets.len());
        return Err(ParseError::at(Place::Byte(bytes.len()), reason));
    }
    // Bytes after the last facet, which some programs add, are passed over.
    let facets = facets.take(count as usize);
    Ok(facets
        .flat_map(|facet| [12, 24, 36].map(|at| position(&facet[at..at + 12])))
        .collect())
}

fn position(bytes: &[u8]) -> [f64; 3] {
    [0, 4, 8].map(|k| {
        let x = [bytes[k], bytes[k + 1], bytes[k + 2], bytes[k + 3]];
        f64::from(f32::from_le_bytes(x))
    })
}

fn text_corners(bytes: &[u8]) -> Result<Vec<[f64; 3]>, ParseError> {
    let text = String::from_utf8_lossy(bytes);
    let mut reader = TextReader::default();
    let mut lines = 0;
    for (index, line) in text.lines().enumerate() {
        lines = index + 1;
        reader
            .line(line)
            .map_err(|reason| ParseError::at(Place::Line(lines), reason))?;
    }
    if !reader.ended {
        return Err(ParseError::at(
            Place::Line(lines),
            "the file ends before `endsolid`",
        ));
    }
    Ok(reader.corners)
}

#[derive(Default)]
struct TextReader {
    corners: Vec<[f64; 3]>,
    /// Corners of the facet being read.
    pending: usize,
    /// Whether the last solid has been closed.
    ended: bool,
}

impl TextReader {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_ascii_whitespace();
        let Some(keyword) = words.next() else {
            return Ok(());
        };
        match keyword.to_ascii_lowercase().as_str() {
            "vertex" => self.vertex(words),
            "endloop" => self.end_loop(),
            "solid" | "endsolid" if self.pending > 0 => Err("a facet is not closed".to_owned()),
            "solid" => {
                self.ended = false;
                Ok(())
            }
            "endsolid" => {
                self.ended = true;
                Ok(())
            }
            "facet" | "outer" | "endfacet" => Ok(()),
            _ => Err(format!("`{keyword}` does not belong in an STL file")),
        }
    }

    fn vertex<'a>(&mut self, mut words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let mut position = [0.0; 3];
        for x in &mut position {
            let word = words.next().ok_or("a vertex needs three coordinates")?;
            *x = word
                .parse()
                .map_err(|_| format!("`{word}` is not a number"))?;
        }
        self.corners.push(position);
        self.pending += 1;
        Ok(())
    }

    fn end_loop(&mut self) -> Result<(), String> {
        if self.pending != 3 {
            return Err(format!(
                "a facet has {} corners instead of three",
                self.pending
            ));
        }
        self.pending = 0;
        Ok(())
    }
}

/// Writes a mesh as binary STL, positions in metres rounded to single precision.
///
/// # Errors
///
/// What `out` reports.
pub fn write_stl(mesh: &TriMesh, mut out: impl io::Write) -> io::Result<()> {
    out.write_all(&[0; HEADER - 4])?;
    out.write_all(&(mesh.triangles().len() as u32).to_le_bytes())?;
    for t in 0..mesh.triangles().len() {
        let [a, b, c] = mesh.corners(t);
        for x in [mesh.normal(t), a, b, c].as_flattened() {
            out.write_all(&(*x as f32).to_le_bytes())?;
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}
