//! Morphs and skins: vertices that follow other meshes, or joints as these stand in the scene (linear-blend
//! skinning).

use std::collections::BTreeMap;

use super::super::ParseError;
use super::super::transform::Transform;
use super::document::{Document, Element, child, children, fault, integers, part, whole, words};
use super::geometry::{Geometries, Surface};
use super::placement;
use super::source;

/// The surface that an instance of a controller shows, and whether its joints have placed it in the scene.
pub(super) fn surface<'a>(
    document: &Document<'a>,
    geometries: &mut Geometries<'_, 'a>,
    instance: Element<'a>,
) -> Result<(Surface, bool), ParseError> {
    let controller = document.referred(instance, "url", &["controller"])?;
    document.charge_reading(controller)?;
    let Some(skin) = child(controller, "skin") else {
        let surface = morphed(document, geometries, part(controller, "morph")?)?;
        return Ok((surface, false));
    };
    let source = document.referred(skin, "source", &["geometry", "controller"])?;
    let mut surface = match child(source, "morph") {
        Some(morph) => morphed(document, geometries, morph)?,
        None if source.tag_name().name() == "geometry" => {
            document.charge_reading(source)?;
            geometries.surface(source)?
        }
        None => {
            return Err(ParseError::Unsupported {
                feature: "a skin on a skin".to_owned(),
                remedy: "apply one of the armatures before exporting",
            });
        }
    };
    let joints = Joints::read(document, instance, skin)?;
    joints.place(document, skin, &mut surface)?;
    Ok((surface, true))
}

/// The input of a meaning in an element.
fn input<'a>(of: Element<'a>, semantic: &str) -> Result<Element<'a>, ParseError> {
    children(of, "input")
        .find(|input| input.attribute("semantic") == Some(semantic))
        .ok_or_else(|| fault(of, &format!("it has no input {semantic}")))
}

/// A geometry moved towards others by their weights.
fn morphed<'a>(
    document: &Document<'a>,
    geometries: &mut Geometries<'_, 'a>,
    morph: Element<'a>,
) -> Result<Surface, ParseError> {
    let base = document.referred(morph, "source", &["geometry"])?;
    document.charge_reading(morph)?;
    document.charge_reading(base)?;
    let mut surface = geometries.surface(base)?;
    let targets = part(morph, "targets")?;
    let source = |semantic| document.referred(input(targets, semantic)?, "source", &["source"]);
    let (names, _) = source::names(document, source("MORPH_TARGET")?)?;
    let weights = source::columns::<1>(document, source("MORPH_WEIGHT")?)?;
    if names.len() != weights.len() || weights.iter().any(|[w]| !w.is_finite()) {
        return Err(fault(targets, "it has not one weight for each target"));
    }
    let normalized = morph.attribute("method") != Some("RELATIVE");
    let total: f64 = weights.iter().map(|[w]| w).sum();
    let own = if normalized { 1.0 - total } else { 1.0 };
    let vertices = match child(base, "mesh").filter(|_| !surface.used.is_empty()) {
        Some(mesh) => geometries.vertices(mesh)?.len(),
        None => return Ok(surface),
    };
    for x in surface.places.as_flattened_mut() {
        *x *= own;
    }
    for (name, [weight]) in names.into_iter().zip(weights).filter(|(_, [w])| *w != 0.0) {
        document.charge(surface.triangles.len().max(1))?;
        let target = document.of_id(targets, name, &["geometry"])?;
        let places = geometries.vertices(part(target, "mesh")?)?;
        if places.len() != vertices {
            let reason = format!(
                "its mesh has {} vertices, that it morphs {vertices}",
                places.len()
            );
            return Err(fault(target, &reason));
        }
        for (place, &v) in surface.places.iter_mut().zip(&surface.used) {
            let target = places[v as usize];
            *place = [0, 1, 2].map(|k| place[k] + weight * target[k]);
        }
    }
    Ok(surface)
}

/// The joints of a skin: the map of each from the mesh to the scene.
struct Joints {
    /// Of a vertex that follows no joint.
    bind_shape: Transform,
    maps: Vec<Transform>,
}

impl Joints {
    fn read<'a>(
        document: &Document<'a>,
        instance: Element<'a>,
        skin: Element<'a>,
    ) -> Result<Joints, ParseError> {
        let bind_shape = match child(skin, "bind_shape_matrix") {
            Some(matrix) => Transform::of_rows(&placement::numbers(document, matrix)?),
            None => Transform::IDENTITY,
        };
        let joints = part(skin, "joints")?;
        let source = |semantic| document.referred(input(joints, semantic)?, "source", &["source"]);
        let (names, are_ids) = source::names(document, source("JOINT")?)?;
        let inverse = source::columns::<16>(document, source("INV_BIND_MATRIX")?)?;
        if inverse.len() < names.len() {
            return Err(fault(
                joints,
                "it has fewer inverse bind matrices than joints",
            ));
        }
        let mut skeleton = Skeleton::read(document, instance)?;
        let map = |(name, inverse): (&'a str, &[f64; 16])| {
            let joint = match are_ids {
                true => document.of_id(joints, name, &["node"])?,
                false => skeleton.joint(joints, name)?,
            };
            let inverse = Transform::of_rows(inverse).after(&bind_shape);
            Ok(skeleton.world(document, joint)?.after(&inverse))
        };
        let maps: Result<_, ParseError> = names.into_iter().zip(&inverse).map(map).collect();
        Ok(Joints {
            bind_shape,
            maps: maps?,
        })
    }

    /// Moves the vertices of a surface with their joints.
    fn place<'a>(
        &self,
        document: &Document<'a>,
        skin: Element<'a>,
        surface: &mut Surface,
    ) -> Result<(), ParseError> {
        let influences = part(skin, "vertex_weights")?;
        let weights = document.referred(input(influences, "WEIGHT")?, "source", &["source"])?;
        let weights = source::columns::<1>(document, weights)?;
        let offset = |semantic| Ok(whole(input(influences, semantic)?, "offset")?.unwrap_or(0));
        let (joint, weight): (usize, usize) = (offset("JOINT")?, offset("WEIGHT")?);
        let stride = 1 + joint.max(weight);
        let counts: Vec<usize> = integers(part(influences, "vcount")?)?;
        let pairs: Vec<i64> = integers(part(influences, "v")?)?;
        let mut ends = Vec::with_capacity(counts.len());
        let mut end = 0_usize;
        for count in counts {
            end = end.saturating_add(count.saturating_mul(stride));
            ends.push(end);
        }
        if end != pairs.len() {
            return Err(fault(
                influences,
                "its `vcount` and its `v` have not as many joints",
            ));
        }
        for (place, &vertex) in surface.places.iter_mut().zip(&surface.used) {
            let fault =
                |reason: &str| fault(influences, &format!("vertex {vertex} of the skin {reason}"));
            let v = vertex as usize;
            let end = *ends.get(v).ok_or_else(|| fault("has no weights"))?;
            let begin = v.checked_sub(1).map_or(0, |before| ends[before]);
            let mut parts = Vec::new();
            let mut total = 0.0;
            for pair in pairs[begin..end].chunks_exact(stride) {
                let at = usize::try_from(pair[weight]).ok();
                let [w] = at
                    .and_then(|at| weights.get(at))
                    .ok_or_else(|| fault("has no weight"))?;
                let map = match usize::try_from(pair[joint]) {
                    Ok(number) => self.maps.get(number),
                    Err(_) => Some(&self.bind_shape),
                };
                parts.push((
                    *w,
                    *map.ok_or_else(|| fault("follows a joint that there is not"))?,
                ));
                total += w;
            }
            if !(total > 0.0 && total.is_finite()) {
                return Err(fault("follows no joint: bind it to one"));
            }
            let parts = parts.into_iter().map(|(w, map)| (w / total, map));
            *place = Transform::blend(parts).apply(*place);
        }
        Ok(())
    }
}

/// Nodes that can be joints, by their scoped ids, and where they are.
struct Skeleton<'a> {
    joints: BTreeMap<&'a str, Element<'a>>,
    worlds: BTreeMap<u32, Transform>,
}

impl<'a> Skeleton<'a> {
    /// The nodes below the roots that an instance names, or all.
    fn read(document: &Document<'a>, instance: Element<'a>) -> Result<Skeleton<'a>, ParseError> {
        let mut roots = Vec::new();
        for skeleton in children(instance, "skeleton") {
            let address = words(skeleton).next().unwrap_or_default();
            let id = address.strip_prefix('#').unwrap_or(address);
            roots.push(document.of_id(skeleton, id, &["node"])?);
        }
        if roots.is_empty() {
            roots.push(document.root());
        }
        let mut joints = BTreeMap::new();
        for root in roots {
            document.charge_reading(root)?;
            for node in root
                .descendants()
                .filter(|node| node.tag_name().name() == "node")
            {
                if let Some(sid) = node.attribute("sid") {
                    joints.entry(sid).or_insert(node);
                }
            }
        }
        Ok(Skeleton {
            joints,
            worlds: BTreeMap::new(),
        })
    }

    fn joint(&self, from: Element<'a>, sid: &str) -> Result<Element<'a>, ParseError> {
        let missing = || {
            let sid = super::document::shortened(sid);
            fault(
                from,
                &format!("there is no node with the sid `{sid}` in its skeleton"),
            )
        };
        self.joints.get(sid).copied().ok_or_else(missing)
    }

    /// The map of a node to the scene, by the nodes around it.
    fn world(
        &mut self,
        document: &Document<'a>,
        node: Element<'a>,
    ) -> Result<Transform, ParseError> {
        let mut inner = Vec::new();
        let mut at = node;
        let mut world = loop {
            if let Some(known) = self.worlds.get(&at.id().get()) {
                break *known;
            }
            if at.tag_name().name() != "node" {
                break Transform::IDENTITY;
            }
            inner.push(at);
            match at.parent() {
                Some(parent) => at = parent,
                None => break Transform::IDENTITY,
            }
        };
        for node in inner.into_iter().rev() {
            world = world.after(&placement::of_node(document, node)?);
            self.worlds.insert(node.id().get(), world);
        }
        Ok(world)
    }
}
