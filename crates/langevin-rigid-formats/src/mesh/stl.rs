//! STL, text and binary.

use std::io;

use langevin_rigid_bake::TriMesh;

use super::text::{self, Numbers};
use super::{ParseError, Place, RawMesh};

/// Length of the header of a binary file, its count included.
const HEADER: usize = 84;
/// Length of a facet in a binary file: normal, three corners, two bytes of attributes.
const FACET: usize = 50;
/// Coordinates of a file that is taken for binary by its looks are below this.
const LIKELY: f64 = 1e12;

/// Whether this is a binary file: its length is what its count of facets says, or, where the count was never
/// filled in or something follows the facets, all of them look like facets.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    let Some(count) = facet_count(bytes) else {
        return false;
    };
    let body = (bytes.len() - HEADER) as u64;
    let facets = FACET as u64 * count;
    if body == facets {
        return count > 0;
    }
    let unfilled = is_unfilled(count) && body > 0 && body.is_multiple_of(FACET as u64);
    let trailing = count > 0 && body > facets;
    let facets = if unfilled { body } else { facets };
    (unfilled || trailing) && look_like_facets(&bytes[HEADER..HEADER + facets as usize])
}

/// What stands for a count that the program did not know when it wrote the header.
fn is_unfilled(count: u64) -> bool {
    count == 0 || count == u64::from(u32::MAX)
}

fn look_like_facets(bytes: &[u8]) -> bool {
    let mut corners = bytes.chunks_exact(FACET).flat_map(corners);
    corners.all(|p| p.iter().all(|x| x.abs() < LIKELY)) && bytes.iter().any(|&b| b != 0)
}

/// Whether this is the text form. Binary headers may begin with "solid" too, but have zero bytes.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let end = bytes.iter().rposition(|&b| b != 0).map_or(0, |at| at + 1);
    let bytes = text::without_mark(&bytes[..end]);
    if text::is_utf16(bytes) {
        return begins_as_text(&text::decode(bytes).text);
    }
    // Only a file that may be text is decoded.
    let start = bytes.trim_ascii_start();
    let begins = start.starts_with(b"#")
        || begins_as_text(&String::from_utf8_lossy(&start[..start.len().min(8)]));
    begins && !bytes.contains(&0) && begins_as_text(&String::from_utf8_lossy(bytes))
}

fn begins_as_text(text: &str) -> bool {
    let first = text::words(text).next().unwrap_or_default().1;
    first.eq_ignore_ascii_case("solid") || first.eq_ignore_ascii_case("facet")
}

fn facet_count(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u64::from(u32::from_le_bytes(count.try_into().ok()?)))
}

/// Reads the facets, three vertices each; the normals in the file are not used.
pub(super) fn parse(bytes: &[u8]) -> Result<RawMesh, ParseError> {
    let (corners, notices) = if !is_binary(bytes) && is_text(bytes) {
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
        notices,
        ..RawMesh::default()
    })
}

/// Corners, three a facet, and what had to be tolerated.
type Corners = (Vec<[f64; 3]>, Vec<String>);

fn binary_corners(bytes: &[u8]) -> Result<Corners, ParseError> {
    let Some(count) = facet_count(bytes) else {
        let reason = "the file ends within the header of a binary STL file";
        return Err(ParseError::at(Place::Byte(bytes.len()), reason));
    };
    let facets = bytes[HEADER..].chunks_exact(FACET);
    let mut notices = Vec::new();
    let count = if is_unfilled(count) && facets.remainder().is_empty() && facets.len() > 0 {
        notices.push(format!(
            "its header says {count} facets: took the {} that are there",
            facets.len()
        ));
        facets.len()
    } else if count > facets.len() as u64 {
        let reason = format!("the file ends at facet {} of {count}", facets.len());
        return Err(ParseError::at(Place::Byte(bytes.len()), reason));
    } else {
        count as usize
    };
    let after = bytes.len() - HEADER - FACET * count;
    if after > 0 && count == 0 {
        let reason = format!(
            "the header says 0 facets, but {after} bytes follow, which are not whole facets"
        );
        return Err(ParseError::at(Place::Byte(HEADER), reason));
    }
    if after > 0 {
        notices.push(format!(
            "passed over {after} bytes after the last of its {count} facets"
        ));
    }
    Ok((facets.take(count).flat_map(corners).collect(), notices))
}

fn corners(facet: &[u8]) -> [[f64; 3]; 3] {
    [12, 24, 36].map(|at| position(&facet[at..at + 12]))
}

fn position(bytes: &[u8]) -> [f64; 3] {
    [0, 4, 8].map(|k| {
        let x = [bytes[k], bytes[k + 1], bytes[k + 2], bytes[k + 3]];
        f64::from(f32::from_le_bytes(x))
    })
}

fn text_corners(bytes: &[u8]) -> Result<Corners, ParseError> {
    let file = text::decode(bytes);
    let mut reader = TextReader {
        words: text::words(&file.text).peekable(),
        line: 1,
        corners: Vec::new(),
        numbers: Numbers::default(),
        pending: 0,
        in_facet: false,
        ended: false,
    };
    reader
        .read()
        .map_err(|reason| ParseError::at(Place::Line(reader.line), reason))?;
    let mut notices = file.notices;
    if !reader.ended {
        notices.push("it ends without `endsolid`: check that it is whole".to_owned());
    }
    notices.extend(reader.numbers.notice());
    Ok((reader.corners, notices))
}

/// Reads word by word: where lines end matters to names only.
struct TextReader<'a, I: Iterator<Item = (usize, &'a str)>> {
    words: std::iter::Peekable<I>,
    /// Line of the last word.
    line: usize,
    corners: Vec<[f64; 3]>,
    numbers: Numbers,
    /// Corners of the facet being read.
    pending: usize,
    in_facet: bool,
    /// Whether the last solid has been closed.
    ended: bool,
}

impl<'a, I: Iterator<Item = (usize, &'a str)>> TextReader<'a, I> {
    fn read(&mut self) -> Result<(), String> {
        while let Some(keyword) = self.keyword() {
            match keyword.as_str() {
                "solid" | "endsolid" if self.in_facet => {
                    return Err("a facet is not closed".to_owned());
                }
                "solid" | "endsolid" => {
                    self.ended = keyword == "endsolid";
                    self.skip_name();
                }
                "facet" if self.in_facet => return Err("a facet is not closed".to_owned()),
                "facet" => {
                    self.in_facet = true;
                    self.ended = false;
                    self.skip_normal();
                }
                "outer" | "loop" => {}
                "vertex" => self.vertex()?,
                "endloop" => self.end_loop()?,
                "endfacet" if self.pending > 0 => return Err("a loop is not closed".to_owned()),
                "endfacet" => self.in_facet = false,
                _ => return Err(format!("`{keyword}` does not belong in an STL file")),
            }
        }
        if self.in_facet || self.pending > 0 {
            return Err("the file ends within a facet".to_owned());
        }
        Ok(())
    }

    fn word(&mut self) -> Option<&'a str> {
        let (line, word) = self.words.next()?;
        self.line = line;
        Some(word)
    }

    /// The next word in lower case; `end solid` is `endsolid`.
    fn keyword(&mut self) -> Option<String> {
        let mut keyword = self.word()?.to_ascii_lowercase();
        if keyword == "end" {
            keyword += &self.word().unwrap_or_default().to_ascii_lowercase();
        }
        Some(keyword)
    }

    /// Passes over the name of a solid: the rest of the line, or what comes before `facet normal` on it.
    fn skip_name(&mut self) {
        let line = self.line;
        let mut facet = None;
        while let Some(&(at, word)) = self.words.peek() {
            if at != line {
                break;
            }
            if word.eq_ignore_ascii_case("normal") && facet.take().is_some() {
                self.in_facet = true;
                self.ended = false;
                self.skip_normal();
                return;
            }
            facet = word.eq_ignore_ascii_case("facet").then_some(());
            self.words.next();
        }
    }

    /// Passes over `normal` and its three numbers, which may be broken.
    fn skip_normal(&mut self) {
        let is_loop = |word: &str| {
            ["outer", "loop", "vertex"]
                .iter()
                .any(|k| word.eq_ignore_ascii_case(k))
        };
        for _ in 0..4 {
            if self.words.next_if(|(_, word)| !is_loop(word)).is_none() {
                return;
            }
        }
    }

    fn vertex(&mut self) -> Result<(), String> {
        let mut position = [0.0; 3];
        for x in &mut position {
            let word = self.word().ok_or("a vertex needs three coordinates")?;
            *x = self.numbers.finite(word)?;
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
