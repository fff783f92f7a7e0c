//! Stanford PLY: positions of the element `vertex`, polygons of the element `face`.

mod header;
mod source;

use header::{Element, Header, Kind};
use source::Source;

use super::{ParseError, RawMesh, fan};

/// Reads the positions and polygons; other elements and properties are passed over.
pub(super) fn parse(bytes: &[u8]) -> Result<RawMesh, ParseError> {
    let (header, body) = Header::parse(bytes)?;
    let mut source = Source::new(header.encoding, bytes, body, header.lines);
    let mut mesh = RawMesh::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut source, &mut mesh)?,
            "face" => read_faces(element, &mut source, &mut mesh)?,
            "tristrips" => {
                return Err(ParseError::Unsupported {
                    feature: "triangle strips".to_owned(),
                    remedy: "export it with faces",
                });
            }
            _ => skip(element, &mut source)?,
        }
    }
    // Faces may come before vertices, so their numbers are checked last.
    match mesh
        .triangles
        .as_flattened()
        .iter()
        .find(|&&v| v as usize >= mesh.vertices.len())
    {
        None => Ok(mesh),
        Some(v) => Err(source.error(format!(
            "a face has vertex {v}, there are {}",
            mesh.vertices.len()
        ))),
    }
}

fn read_vertices(
    element: &Element,
    source: &mut Source<'_>,
    mesh: &mut RawMesh,
) -> Result<(), ParseError> {
    let is = |p: &header::Property, name: &str| p.name == name && matches!(p.kind, Kind::Scalar(_));
    let column = |name: &str| element.properties.iter().position(|p| is(p, name));
    let [Some(x), Some(y), Some(z)] = ["x", "y", "z"].map(column) else {
        return Err(source.error("the vertices have no properties x, y, z".to_owned()));
    };
    let mut row = Vec::new();
    for _ in 0..element.count {
        row.clear();
        for property in &element.properties {
            row.push(match property.kind {
                Kind::Scalar(scalar) => source.scalar(scalar)?,
                Kind::List(..) => {
                    source.list(property.kind, |_| ())?;
                    f64::NAN
                }
            });
        }
        mesh.vertices.push([row[x], row[y], row[z]]);
    }
    Ok(())
}

fn read_faces(
    element: &Element,
    source: &mut Source<'_>,
    mesh: &mut RawMesh,
) -> Result<(), ParseError> {
    let is_corners = |name: &str| name == "vertex_indices" || name == "vertex_index";
    if !element.properties.iter().any(|p| is_corners(&p.name)) {
        return Err(source.error("the faces have no property vertex_indices".to_owned()));
    }
    let mut corners = Vec::new();
    for _ in 0..element.count {
        for property in &element.properties {
            if !is_corners(&property.name) {
                source.list(property.kind, |_| ())?;
                continue;
            }
            corners.clear();
            source.list(property.kind, |number| corners.push(number))?;
            let numbers: Option<Vec<u32>> = corners.iter().map(|&x| whole(x)).collect();
            let numbers = numbers
                .ok_or_else(|| source.error("a vertex number is negative or broken".to_owned()))?;
            mesh.triangles.extend(fan(&numbers));
        }
    }
    Ok(())
}

fn skip(element: &Element, source: &mut Source<'_>) -> Result<(), ParseError> {
    if element.properties.is_empty() {
        // Nothing in the file, however many there are said to be.
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            source.list(property.kind, |_| ())?;
        }
    }
    Ok(())
}

/// A number of a vertex or of list entries, if it is one.
fn whole(x: f64) -> Option<u32> {
    let n = x as u32;
    (f64::from(n) == x).then_some(n)
}
