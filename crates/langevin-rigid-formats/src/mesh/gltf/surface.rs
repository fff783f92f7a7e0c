//! The triangles of one primitive, in the mesh's own frame.

use super::super::polygon::{fan, renumber_used, strip};
use super::super::{ParseError, Place};
use super::accessor::{Accessors, Component, INDICES, Items};
use super::document::{Draco, Primitive};
use super::draco::Decoded;

/// Triangles, and the attributes of the vertices they use.
pub(super) struct Surface<'a> {
    /// Numbers of the vertices that triangles use, increasing.
    pub(super) used: Vec<u32>,
    /// Triangles over `used`.
    pub(super) triangles: Vec<[u32; 3]>,
    position: Items<'a>,
    targets: Vec<Option<Items<'a>>>,
    /// Joints and weights of the skin, four of each a vertex.
    influences: Vec<[Items<'a>; 2]>,
}

/// Floats, or the integers of KHR_mesh_quantization.
const POSITION: [Component; 5] = [
    Component::Float,
    Component::Byte,
    Component::UnsignedByte,
    Component::Short,
    Component::UnsignedShort,
];
const JOINTS: [Component; 2] = [Component::UnsignedByte, Component::UnsignedShort];
const WEIGHTS: [Component; 3] = [
    Component::Float,
    Component::UnsignedByte,
    Component::UnsignedShort,
];

/// Corners and vertices of a primitive, by its accessors; none if it is no surface.
fn counts(
    primitive: &Primitive,
    accessors: &Accessors<'_>,
) -> Result<Option<[usize; 2]>, ParseError> {
    let Some(&position) = primitive.attributes.get("POSITION") else {
        return Ok(None);
    };
    let count = |index, shape, allowed: &[Component]| match primitive.draco() {
        Some(_) => Ok(accessors.get(index)?.count),
        None => Ok(accessors.items(index, shape, allowed)?.count),
    };
    let vertices = count(position, "VEC3", &POSITION)?;
    let corners = match primitive.indices {
        Some(index) => count(index, "SCALAR", &INDICES)?,
        None => vertices,
    };
    Ok(Some([corners, vertices]))
}

/// Triangles of a primitive, or the third of its vertices where these will be made too.
pub(super) fn expected(
    primitive: &Primitive,
    accessors: &Accessors<'_>,
) -> Result<Option<usize>, ParseError> {
    let counts = counts(primitive, accessors)?;
    Ok(counts.map(|[corners, vertices]| match primitive {
        _ if primitive.draco().is_some() => corners.max(vertices) / 3,
        Primitive { mode: 4, .. } => corners / 3,
        _ => corners.saturating_sub(2),
    }))
}

impl<'a> Surface<'a> {
    pub(super) fn read(
        primitive: &'a Primitive,
        accessors: &Accessors<'a>,
        skinned: bool,
    ) -> Result<Option<Surface<'a>>, ParseError> {
        let Some([corners, vertices]) = counts(primitive, accessors)? else {
            return Ok(None);
        };
        let source = Source::read(primitive, accessors, [corners, vertices])?;
        let position = source.attribute("POSITION", "VEC3", &POSITION)?;
        let target = |index| accessors.items(index, "VEC3", &POSITION);
        let targets: Vec<Option<Items<'a>>> = primitive
            .targets
            .iter()
            .map(|t| t.position.map(target).transpose())
            .collect::<Result<_, _>>()?;
        let influences = match skinned {
            true => source.influences()?,
            false => Vec::new(),
        };
        let others = targets.iter().flatten().chain(influences.iter().flatten());
        if others.into_iter().any(|items| items.count != vertices) {
            let reason = "the attributes of a primitive differ in number";
            return Err(ParseError::at(Place::File, reason));
        }
        let (used, triangles) = source.triangles(vertices)?;
        Ok(Some(Surface {
            used,
            triangles,
            position,
            targets,
            influences,
        }))
    }

    /// Positions of the vertices used, moved by the morph targets.
    pub(super) fn positions(&self, weights: &[f64]) -> Vec<[f64; 3]> {
        let targets = self.targets.iter().zip(weights);
        let active: Vec<(&Items<'_>, f64)> = targets
            .filter_map(|(target, &w)| Some((target.as_ref()?, w)).filter(|_| w != 0.0))
            .collect();
        let position = |&vertex: &u32| {
            let mut position = self.position.at(vertex as usize);
            for &(target, weight) in &active {
                let offset: [f64; 3] = target.at(vertex as usize);
                position = [0, 1, 2].map(|k| position[k] + weight * offset[k]);
            }
            position
        };
        self.used.iter().map(position).collect()
    }

    /// Joints of a vertex with their weights.
    pub(super) fn influences(&self, vertex: u32) -> impl Iterator<Item = (f64, f64)> {
        self.influences.iter().flat_map(move |[joints, weights]| {
            let joints: [f64; 4] = joints.at(vertex as usize);
            joints.into_iter().zip(weights.at::<4>(vertex as usize))
        })
    }
}

/// Where the attributes of a primitive come from.
struct Source<'s, 'a> {
    primitive: &'a Primitive,
    accessors: &'s Accessors<'a>,
    decoded: Option<(&'a Draco, Decoded)>,
}

impl<'a> Source<'_, 'a> {
    fn read<'s>(
        primitive: &'a Primitive,
        accessors: &'s Accessors<'a>,
        [corners, vertices]: [usize; 2],
    ) -> Result<Source<'s, 'a>, ParseError> {
        let decode = |draco: &'a Draco| {
            let (bytes, _) = accessors.buffers.view(draco.buffer_view)?;
            Ok((draco, Decoded::new(bytes, corners, vertices)?))
        };
        Ok(Source {
            primitive,
            accessors,
            decoded: primitive.draco().map(decode).transpose()?,
        })
    }

    fn attribute(
        &self,
        name: &str,
        shape: &str,
        allowed: &[Component],
    ) -> Result<Items<'a>, ParseError> {
        let index = self.primitive.attributes.get(name).ok_or_else(|| {
            ParseError::at(Place::File, format!("a primitive has no attribute {name}"))
        })?;
        let decoded = self
            .decoded
            .as_ref()
            .and_then(|(draco, decoded)| Some((decoded, *draco.attributes.get(name)?)));
        match decoded {
            Some((decoded, id)) => self
                .accessors
                .decoded(*index, shape, allowed, |width| decoded.attribute(id, width)),
            None => self.accessors.items(*index, shape, allowed),
        }
    }

    fn influences(&self) -> Result<Vec<[Items<'a>; 2]>, ParseError> {
        let sets = (0..).map(|n| [format!("JOINTS_{n}"), format!("WEIGHTS_{n}")]);
        sets.take_while(|[joints, _]| self.primitive.attributes.contains_key(joints))
            .map(|[joints, weights]| {
                Ok([
                    self.attribute(&joints, "VEC4", &JOINTS)?,
                    self.attribute(&weights, "VEC4", &WEIGHTS)?,
                ])
            })
            .collect()
    }

    /// The vertices used, and triangles over them.
    fn triangles(&self, vertices: usize) -> Result<(Vec<u32>, Vec<[u32; 3]>), ParseError> {
        let (corners, mode) = match (&self.decoded, self.primitive.indices) {
            (Some((_, decoded)), _) => (decoded.corners(), 4),
            (None, Some(index)) => {
                let items = self.accessors.items(index, "SCALAR", &INDICES)?;
                let numbers = (0..items.count).map(|k| items.at::<1>(k)[0] as u32);
                (numbers.collect(), self.primitive.mode)
            }
            (None, None) => ((0..vertices as u32).collect(), self.primitive.mode),
        };
        if let Some(v) = corners.iter().find(|&&v| v as usize >= vertices) {
            let reason = format!("a triangle has vertex {v}, there are {vertices}");
            return Err(ParseError::at(Place::File, reason));
        }
        let mut triangles = triangles(&corners, mode);
        let used = renumber_used(corners, &mut triangles);
        Ok((used, triangles))
    }
}

/// Triangles of a list (mode 4), strip (5) or fan (6) of corners.
fn triangles(corners: &[u32], mode: u32) -> Vec<[u32; 3]> {
    match mode {
        4 => corners.as_chunks::<3>().0.to_vec(),
        5 => strip(corners).collect(),
        _ => fan(corners).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_wind_alternately_and_fans_share_a_corner() {
        assert_eq!(triangles(&[5, 6, 7, 8, 9, 10], 4), [[5, 6, 7], [8, 9, 10]]);
        assert_eq!(
            triangles(&[5, 6, 7, 8, 9], 5),
            [[5, 6, 7], [6, 8, 7], [7, 8, 9]]
        );
        assert_eq!(triangles(&[5, 6, 7, 8], 6), [[5, 6, 7], [5, 7, 8]]);
    }
}
