//! Where the objects of a glTF document name others by number.

use std::collections::BTreeSet;
use std::ops::{Index, IndexMut};

use serde_json::Value;

/// A list of a document whose members others name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum List {
    Accessors,
    BufferViews,
    Images,
    Materials,
    Meshes,
    Samplers,
    Textures,
}

impl List {
    pub(crate) const ALL: [Self; 7] = [
        Self::Accessors,
        Self::BufferViews,
        Self::Images,
        Self::Materials,
        Self::Meshes,
        Self::Samplers,
        Self::Textures,
    ];

    /// Its name in the document.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Accessors => "accessors",
            Self::BufferViews => "bufferViews",
            Self::Images => "images",
            Self::Materials => "materials",
            Self::Meshes => "meshes",
            Self::Samplers => "samplers",
            Self::Textures => "textures",
        }
    }

    /// What a member is called.
    pub(crate) fn member(self) -> &'static str {
        match self {
            Self::Accessors => "accessor",
            Self::BufferViews => "buffer view",
            Self::Images => "image",
            Self::Materials => "material",
            Self::Meshes => "mesh",
            Self::Samplers => "sampler",
            Self::Textures => "texture",
        }
    }
}

/// The members of all lists.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Lists([Vec<Value>; List::ALL.len()]);

impl Index<List> for Lists {
    type Output = Vec<Value>;

    fn index(&self, list: List) -> &Vec<Value> {
        &self.0[list as usize]
    }
}

impl IndexMut<List> for Lists {
    fn index_mut(&mut self, list: List) -> &mut Vec<Value> {
        &mut self.0[list as usize]
    }
}

/// What is to be done with the number of a member of a list.
pub(crate) type Visit<'v, E> = &'v mut dyn FnMut(List, &mut Value) -> Result<(), E>;

/// Visits each number by which a member of `list` names others.
pub(crate) fn of_member<E>(list: List, member: &mut Value, visit: Visit<'_, E>) -> Result<(), E> {
    match list {
        List::Meshes => {
            let primitives = member.get_mut("primitives").and_then(Value::as_array_mut);
            for primitive in primitives.into_iter().flatten() {
                of_primitive(primitive, visit)?;
            }
            Ok(())
        }
        List::Materials => of_material(member, visit),
        List::Textures => {
            number(member, "/sampler", List::Samplers, visit)?;
            number(member, "/source", List::Images, visit)?;
            for extension in values(member, "/extensions") {
                number(extension, "/source", List::Images, visit)?;
            }
            Ok(())
        }
        List::Images => number(member, "/bufferView", List::BufferViews, visit),
        List::Accessors => {
            for place in [
                "/bufferView",
                "/sparse/indices/bufferView",
                "/sparse/values/bufferView",
            ] {
                number(member, place, List::BufferViews, visit)?;
            }
            Ok(())
        }
        List::BufferViews | List::Samplers => Ok(()),
    }
}

/// Visits the numbers of a node's mesh and of the accessors of its instances.
pub(crate) fn of_node<E>(node: &mut Value, visit: Visit<'_, E>) -> Result<(), E> {
    number(node, "/mesh", List::Meshes, visit)?;
    for accessor in values(node, "/extensions/EXT_mesh_gpu_instancing/attributes") {
        visit(List::Accessors, accessor)?;
    }
    Ok(())
}

fn of_primitive<E>(primitive: &mut Value, visit: Visit<'_, E>) -> Result<(), E> {
    number(primitive, "/indices", List::Accessors, visit)?;
    number(primitive, "/material", List::Materials, visit)?;
    for accessor in values(primitive, "/attributes") {
        visit(List::Accessors, accessor)?;
    }
    let targets = primitive.get_mut("targets").and_then(Value::as_array_mut);
    for target in targets.into_iter().flatten() {
        for accessor in values(target, "") {
            visit(List::Accessors, accessor)?;
        }
    }
    let draco = "/extensions/KHR_draco_mesh_compression/bufferView";
    number(primitive, draco, List::BufferViews, visit)
}

/// Textures are named under keys that end so, in materials and in all their extensions.
fn of_material<E>(value: &mut Value, visit: Visit<'_, E>) -> Result<(), E> {
    let Some(members) = value.as_object_mut() else {
        return Ok(());
    };
    for (key, value) in members.iter_mut().filter(|(key, _)| *key != "extras") {
        if key.ends_with("Texture") {
            number(value, "/index", List::Textures, visit)?;
        }
        of_material(value, visit)?;
    }
    Ok(())
}

fn number<E>(value: &mut Value, place: &str, list: List, visit: Visit<'_, E>) -> Result<(), E> {
    match value.pointer_mut(place) {
        Some(number) => visit(list, number),
        None => Ok(()),
    }
}

fn values<'v>(value: &'v mut Value, place: &str) -> impl Iterator<Item = &'v mut Value> {
    let members = value.pointer_mut(place).and_then(Value::as_object_mut);
    members.into_iter().flat_map(|members| members.values_mut())
}

/// Extensions whose numbers are known here, or which have none.
const KEPT: [&str; 7] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "KHR_draco_mesh_compression",
    "KHR_meshopt_compression",
    "EXT_meshopt_compression",
    "EXT_mesh_gpu_instancing",
];

/// Those of them that compress a view.
pub(crate) const MESHOPT: [&str; 2] = ["KHR_meshopt_compression", "EXT_meshopt_compression"];

/// Of these there are lists of their own at the top of a document.
const VARIANTS: &str = "KHR_materials_variants";

/// Drops other extensions from an object, and notes the names of those that stay.
pub(crate) fn keep_known_extensions(value: &mut Value, used: &mut BTreeSet<String>) {
    match value {
        Value::Array(items) => {
            for item in items {
                keep_known_extensions(item, used);
            }
        }
        Value::Object(members) => {
            if let Some(Value::Object(extensions)) = members.get_mut("extensions") {
                extensions.retain(|name, _| {
                    name != VARIANTS && KEPT.iter().any(|kept| name.starts_with(kept))
                });
                used.extend(extensions.keys().cloned());
                if extensions.is_empty() {
                    members.remove("extensions");
                }
            }
            let members = members.iter_mut().filter(|(key, _)| *key != "extras");
            for (_, member) in members {
                keep_known_extensions(member, used);
            }
        }
        _ => {}
    }
}
