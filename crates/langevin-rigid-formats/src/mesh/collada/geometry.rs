//! The triangles of a geometry, in its own frame.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::super::ParseError;
use super::super::polygon::{Polygons, renumber_used, strip};
use super::document::{
    Document, Element, child, children, elements, fault, integer, integers, part, required, whole,
    words,
};
use super::source;

/// Triangles, and the vertices they use.
pub(super) struct Surface {
    /// Numbers of the vertices that triangles use, increasing.
    pub(super) used: Vec<u32>,
    /// Where those are.
    pub(super) places: Vec<[f64; 3]>,
    /// Triangles over `used`.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Reads geometries; arrays that several of them use once.
pub(super) struct Geometries<'d, 'a> {
    document: &'d Document<'a>,
    sources: BTreeMap<u32, Rc<Vec<[f64; 3]>>>,
}

impl<'d, 'a> Geometries<'d, 'a> {
    pub(super) fn new(document: &'d Document<'a>) -> Self {
        Geometries {
            document,
            sources: BTreeMap::new(),
        }
    }

    /// The surface of a geometry; one of no triangles where it has none.
    pub(super) fn surface(&mut self, geometry: Element<'a>) -> Result<Surface, ParseError> {
        let Some(mesh) = child(geometry, "mesh") else {
            self.pass_over("curves and exact surfaces");
            return Ok(Surface {
                used: Vec::new(),
                places: Vec::new(),
                triangles: Vec::new(),
            });
        };
        let polygons = self.polygons(mesh)?;
        let corners = polygons.corners().to_vec();
        if corners.is_empty() {
            return Ok(Surface {
                used: corners,
                places: Vec::new(),
                triangles: Vec::new(),
            });
        }
        let vertices = self.vertices(mesh)?;
        if let Some(v) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
            let reason = format!("a face has vertex {v}, there are {}", vertices.len());
            return Err(fault(mesh, &reason));
        }
        let place = |v: &u32| vertices[*v as usize];
        if let Some(v) = corners
            .iter()
            .find(|v| !place(v).iter().all(|x| x.is_finite()))
        {
            let reason =
                format!("a face has vertex {v}, which has a coordinate that is not a number");
            return Err(fault(mesh, &reason));
        }
        let (mut triangles, notice) = polygons.triangles(&vertices);
        if let Some(notice) = notice {
            self.document.note(&notice);
        }
        let used = renumber_used(corners, &mut triangles);
        Ok(Surface {
            places: used.iter().map(place).collect(),
            used,
            triangles,
        })
    }

    /// Where all vertices of a mesh are.
    pub(super) fn vertices(&mut self, mesh: Element<'a>) -> Result<Rc<Vec<[f64; 3]>>, ParseError> {
        let vertices = part(mesh, "vertices")?;
        let position =
            children(vertices, "input").find(|i| i.attribute("semantic") == Some("POSITION"));
        let position = position.ok_or_else(|| fault(vertices, "it has no input POSITION"))?;
        let source = self.document.referred(position, "source", &["source"])?;
        if let Some(known) = self.sources.get(&source.id().get()) {
            return Ok(known.clone());
        }
        let read = Rc::new(source::columns(self.document, source)?);
        self.sources.insert(source.id().get(), read.clone());
        Ok(read)
    }

    /// The faces of all primitives of a mesh.
    fn polygons(&self, mesh: Element<'a>) -> Result<Polygons, ParseError> {
        let mut polygons = Polygons::default();
        for primitive in elements(mesh) {
            match primitive.tag_name().name() {
                "triangles" | "polylist" | "polygons" | "tristrips" | "trifans" => {
                    self.add(primitive, mesh, &mut polygons)?;
                }
                "lines" | "linestrips" if child(primitive, "p").is_some() => {
                    self.pass_over("lines");
                }
                _ => {}
            }
        }
        Ok(polygons)
    }

    fn add(
        &self,
        primitive: Element<'a>,
        mesh: Element<'a>,
        polygons: &mut Polygons,
    ) -> Result<(), ParseError> {
        let mut lists = elements(primitive).filter(|e| matches!(e.tag_name().name(), "p" | "ph"));
        let Some(first) = lists.next() else {
            return match whole(primitive, "count")?.unwrap_or(0) {
                0 => Ok(()),
                count => Err(fault(primitive, &format!("it says {count} and has none"))),
            };
        };
        let input = VertexInput::of(primitive, mesh)?;
        let mut faces = 0;
        for list in std::iter::once(first).chain(lists) {
            faces += match primitive.tag_name().name() {
                "triangles" => add_triangles(list, &input.corners(list)?, polygons)?,
                "polylist" => add_polylist(primitive, &input.corners(list)?, polygons)?,
                "polygons" => add_polygon(list, &input, polygons)?,
                "tristrips" => add_strip(&input.corners(list)?, polygons),
                _ => add_fan(&input.corners(list)?, polygons),
            };
        }
        match whole(primitive, "count")? {
            Some(count) if count != faces => Err(fault(
                primitive,
                &format!("it says {count} faces and has {faces}"),
            )),
            _ => Ok(()),
        }
    }

    fn pass_over(&self, what: &str) {
        let notice = format!("the {what} in it were passed over: they enclose nothing");
        self.document.note(&notice);
    }
}

/// Where in the numbers of a corner that of its vertex is.
struct VertexInput {
    offset: usize,
    stride: usize,
}

impl VertexInput {
    fn of(primitive: Element<'_>, mesh: Element<'_>) -> Result<VertexInput, ParseError> {
        let mut vertex = None;
        let mut stride = 1;
        for input in children(primitive, "input") {
            let offset = whole(input, "offset")?;
            let offset = offset.ok_or_else(|| fault(input, "it has no attribute `offset`"))?;
            stride = stride.max(offset.saturating_add(1));
            if input.attribute("semantic") == Some("VERTEX") {
                let id = part(mesh, "vertices")?.attribute("id");
                if required(input, "source")?.strip_prefix('#') != id {
                    return Err(fault(input, "its source is not the `vertices` of its mesh"));
                }
                vertex = Some(offset);
            }
        }
        let offset = vertex.ok_or_else(|| fault(primitive, "it has no input VERTEX"))?;
        Ok(VertexInput { offset, stride })
    }

    /// The vertices of the corners in a list.
    fn corners(&self, list: Element<'_>) -> Result<Vec<u32>, ParseError> {
        let mut corners = Vec::new();
        let mut at = 0;
        for word in words(list) {
            if at == self.offset {
                corners.push(integer(list, word)?);
            }
            at = if at + 1 == self.stride { 0 } else { at + 1 };
        }
        if at == 0 {
            Ok(corners)
        } else {
            let reason = format!("its numbers are no multiple of {} a corner", self.stride);
            Err(fault(list, &reason))
        }
    }
}

fn add_triangles(
    list: Element<'_>,
    corners: &[u32],
    polygons: &mut Polygons,
) -> Result<usize, ParseError> {
    let (triangles, []) = corners.as_chunks::<3>() else {
        return Err(fault(list, "its corners are no multiple of three"));
    };
    triangles.iter().for_each(|t| polygons.push(*t));
    Ok(triangles.len())
}

fn add_polylist(
    primitive: Element<'_>,
    corners: &[u32],
    polygons: &mut Polygons,
) -> Result<usize, ParseError> {
    let counts: Vec<usize> = integers(part(primitive, "vcount")?)?;
    let mut rest = corners;
    let mismatch = || {
        fault(
            primitive,
            "its `vcount` and its `p` have not as many corners",
        )
    };
    for &count in &counts {
        let (face, others) = rest.split_at_checked(count).ok_or_else(mismatch)?;
        polygons.push(face.iter().copied());
        rest = others;
    }
    if rest.is_empty() {
        Ok(counts.len())
    } else {
        Err(mismatch())
    }
}

/// A polygon, with holes where the element is `ph`.
fn add_polygon(
    list: Element<'_>,
    input: &VertexInput,
    polygons: &mut Polygons,
) -> Result<usize, ParseError> {
    if list.tag_name().name() == "p" {
        polygons.push(input.corners(list)?);
        return Ok(1);
    }
    polygons.push(input.corners(part(list, "p")?)?);
    for hole in children(list, "h") {
        polygons.push_hole(input.corners(hole)?);
    }
    Ok(1)
}

/// Triangles of a strip; corners that repeat only join parts.
fn add_strip(corners: &[u32], polygons: &mut Polygons) -> usize {
    let apart = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    strip(corners).filter(apart).for_each(|t| polygons.push(t));
    1
}

fn add_fan(corners: &[u32], polygons: &mut Polygons) -> usize {
    super::super::polygon::fan(corners).for_each(|t| polygons.push(t));
    1
}
