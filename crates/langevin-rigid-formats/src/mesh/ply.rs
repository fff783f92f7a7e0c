//! Stanford PLY: positions of the element `vertex`, polygons of the element `face`, strips of triangles of
//! the element `tristrips`.

mod header;
mod source;

use std::collections::BTreeMap;

use header::{Element, Encoding, Header, Kind, Property};
use source::Source;

use super::polygon::Polygons;
use super::{ParseError, Place, RawMesh, text};

/// Whether the bytes begin as a PLY file does.
pub(super) fn is_ply(bytes: &[u8]) -> bool {
    let line = bytes.split(|b| *b == b'\n' || *b == b'\r').next();
    line.is_some_and(|line| line.trim_ascii().eq_ignore_ascii_case(b"ply"))
}

/// Reads the positions and polygons; other elements and properties are passed over.
pub(super) fn parse(bytes: &[u8]) -> Result<RawMesh, ParseError> {
    if !text::is_utf16(bytes) {
        let bytes = text::without_mark(bytes);
        let (header, body) = Header::parse(bytes)?;
        if header.encoding != Encoding::Text {
            return binary(&header, bytes, body);
        }
    }
    let file = text::decode(bytes);
    let (header, body) = Header::parse(file.text.as_bytes())?;
    if header.encoding != Encoding::Text {
        let reason = "it is binary, but was saved as UTF-16 text";
        return Err(ParseError::at(Place::File, reason));
    }
    let mut mesh = ascii(&header, file.text.as_bytes(), body)?;
    mesh.notices.splice(0..0, file.notices);
    Ok(mesh)
}

fn binary(header: &Header, bytes: &[u8], body: usize) -> Result<RawMesh, ParseError> {
    let mut source = Source::new(header.encoding, bytes, body, header.lines);
    let soup = Soup::read(header, &mut source)?;
    let left = bytes.len() - source.position();
    let mut mesh = soup.finish(&source)?;
    if left > 0 {
        mesh.note(format!("passed over {left} bytes after its last element"));
    }
    Ok(mesh)
}

/// Text with a row a line, with values at the ends of lines that no property is for, or else all values one
/// after another, wherever lines end; an error where a file could be either.
fn ascii(header: &Header, bytes: &[u8], body: usize) -> Result<RawMesh, ParseError> {
    let source = || Source::new(Encoding::Text, bytes, body, header.lines);
    let mut lines = source().by_line();
    let by_line = Soup::read(header, &mut lines).and_then(|soup| soup.finish(&lines));
    if by_line.is_ok() && lines.extra() == 0 {
        let rest = (!lines.is_at_end()).then_some("passed over the lines after its last element");
        return by_line.map(|mesh| noted(mesh, rest, lines));
    }
    let mut values = source();
    let by_value = Soup::read(header, &mut values).and_then(|soup| {
        if values.is_at_end() {
            soup.finish(&values)
        } else {
            let reason = "there are more values than the header says, and lines are not rows";
            Err(values.error(reason.to_owned()))
        }
    });
    match (by_line, by_value) {
        (Ok(_), Ok(_)) => {
            let reason = "its lines have more values than the header says and could be read in two ways: \
                          declare all properties in the header";
            Err(ParseError::at(Place::Line(header.lines), reason))
        }
        (Ok(mesh), Err(_)) => {
            let extra =
                "passed over values at the ends of lines that no property of the header is for";
            Ok(noted(mesh, Some(extra), lines))
        }
        (Err(_), Ok(mesh)) => {
            let wrapped = "its rows are not lines: took its values one after another";
            Ok(noted(mesh, Some(wrapped), values))
        }
        (Err(error), Err(_)) if lines.position() > values.position() => Err(error),
        (Err(_), Err(error)) => Err(error),
    }
}

fn noted(mut mesh: RawMesh, notice: Option<&str>, source: Source<'_>) -> RawMesh {
    mesh.notices.extend(notice.map(str::to_owned));
    mesh.notices.extend(source.notice());
    mesh
}

/// What is read, in the order of the file.
#[derive(Default)]
struct Soup {
    vertices: Vec<[f64; 3]>,
    polygons: Polygons,
    /// Where vertices are that have a coordinate that is not finite.
    broken: BTreeMap<u32, Place>,
}

impl Soup {
    fn read(header: &Header, source: &mut Source<'_>) -> Result<Soup, ParseError> {
        let mut soup = Soup::default();
        for element in &header.elements {
            match element.name.as_str() {
                "vertex" => soup.read_vertices(element, source)?,
                "face" => soup.read_faces(element, source, Soup::add_face)?,
                "tristrips" => soup.read_faces(element, source, Soup::add_strips)?,
                _ => skip(element, source)?,
            }
        }
        Ok(soup)
    }

    fn read_vertices(
        &mut self,
        element: &Element,
        source: &mut Source<'_>,
    ) -> Result<(), ParseError> {
        let is = |p: &Property, name: &str| p.name == name && matches!(p.kind, Kind::Scalar(_));
        let column = |name: &str| element.properties.iter().position(|p| is(p, name));
        let [Some(x), Some(y), Some(z)] = ["x", "y", "z"].map(column) else {
            return Err(source.error("the vertices have no properties x, y, z".to_owned()));
        };
        let mut row = Vec::new();
        for _ in 0..element.count {
            row.clear();
            source.begin_row();
            let place = source.place();
            for property in &element.properties {
                row.push(match property.kind {
                    Kind::Scalar(scalar) => source.scalar(scalar)?,
                    Kind::List(..) => {
                        source.list(property.kind, |_| ())?;
                        f64::NAN
                    }
                });
            }
            source.end_row();
            let position = [row[x], row[y], row[z]];
            if !position.iter().all(|x| x.is_finite()) {
                self.broken.insert(self.vertices.len() as u32, place);
            }
            self.vertices.push(position);
        }
        Ok(())
    }

    /// Passes the vertex numbers of each row to `add`, which takes them or not.
    fn read_faces(
        &mut self,
        element: &Element,
        source: &mut Source<'_>,
        add: fn(&mut Soup, &[f64]) -> Option<()>,
    ) -> Result<(), ParseError> {
        let is_corners = |p: &Property| p.name == "vertex_indices" || p.name == "vertex_index";
        if !element.properties.iter().any(is_corners) {
            let name = &element.name;
            let reason = format!("the element `{name}` has no property vertex_indices");
            return Err(source.error(reason));
        }
        let mut corners = Vec::new();
        for _ in 0..element.count {
            source.begin_row();
            for property in &element.properties {
                if !is_corners(property) {
                    source.list(property.kind, |_| ())?;
                    continue;
                }
                corners.clear();
                source.list(property.kind, |number| corners.push(number))?;
                let broken = || source.error("a vertex number is negative or broken".to_owned());
                add(self, &corners).ok_or_else(broken)?;
            }
            source.end_row();
        }
        Ok(())
    }

    fn add_face(&mut self, corners: &[f64]) -> Option<()> {
        let numbers: Option<Vec<u32>> = corners.iter().map(|&x| whole(x)).collect();
        self.polygons.push(numbers?);
        Some(())
    }

    /// Strips of triangles one after another, with a −1 after each. Corners that repeat only join parts.
    fn add_strips(&mut self, corners: &[f64]) -> Option<()> {
        for strip in corners.split(|&x| x == -1.0) {
            let numbers: Option<Vec<u32>> = strip.iter().map(|&x| whole(x)).collect();
            for (at, corners) in numbers?.windows(3).enumerate() {
                let [a, b, c] = [corners[0], corners[1], corners[2]];
                if a != b && b != c && c != a {
                    self.polygons
                        .push(if at % 2 == 0 { [a, b, c] } else { [b, a, c] });
                }
            }
        }
        Some(())
    }

    /// The triangles. Faces may come before vertices, so their numbers are checked here.
    fn finish(self, source: &Source<'_>) -> Result<RawMesh, ParseError> {
        let count = self.vertices.len();
        let corners = self.polygons.corners();
        if let Some(v) = corners.iter().find(|&&v| v as usize >= count) {
            return Err(source.error(format!("a face has vertex {v}, there are {count}")));
        }
        if let Some((v, place)) = corners.iter().find_map(|v| self.broken.get_key_value(v)) {
            let reason =
                format!("a face has vertex {v}, which has a coordinate that is not a number");
            return Err(ParseError::at(*place, reason));
        }
        let (triangles, notice) = self.polygons.triangles(&self.vertices);
        let mut mesh = RawMesh {
            vertices: self.vertices,
            triangles,
            notices: notice.into_iter().collect(),
            ..RawMesh::default()
        };
        if !self.broken.is_empty() {
            mesh.drop_unused();
            mesh.note("dropped vertices that have no position and no face");
        }
        Ok(mesh)
    }
}

fn skip(element: &Element, source: &mut Source<'_>) -> Result<(), ParseError> {
    if element.properties.is_empty() {
        // Nothing in the file, however many there are said to be.
        return Ok(());
    }
    for _ in 0..element.count {
        source.begin_row();
        for property in &element.properties {
            source.list(property.kind, |_| ())?;
        }
        source.end_row();
    }
    Ok(())
}

/// A number of a vertex or of list entries, if it is one.
fn whole(x: f64) -> Option<u32> {
    let n = x as u32;
    (f64::from(n) == x).then_some(n)
}
