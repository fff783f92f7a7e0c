//! What the nodes of a scene show, copied into a document of its own.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use serde_json::{Map, Value, json};

use super::Part;
use super::image::media_type;
use super::references::{List, MESHOPT, keep_known_extensions, of_member, of_node};
use crate::mesh::ParseError;
use crate::mesh::gltf;

/// What a node keeps.
const OF_NODE: [&str; 8] = [
    "name",
    "mesh",
    "matrix",
    "translation",
    "rotation",
    "scale",
    "weights",
    "extensions",
];

/// Integers for positions and normals, an extension that no object has.
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Bytes of views for each byte read, and beyond these.
const MOST_GROWTH: usize = 16;
const ALWAYS: usize = 1 << 20;

/// The nodes below `roots`, which are a tree, and all that they use.
pub(super) fn gather(
    document: &Value,
    roots: &[usize],
    chunk: Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<Part, ParseError> {
    let mut gathering = Gathering {
        document,
        chunk,
        folder,
        part: Part::default(),
        numbers: HashMap::new(),
        waiting: Vec::new(),
        buffers: HashMap::new(),
        read: 0,
    };
    gathering.nodes(roots)?;
    while let Some((list, number)) = gathering.waiting.pop() {
        gathering.member(list, number)?;
    }
    gathering.extensions();
    Ok(gathering.part)
}

struct Gathering<'a> {
    document: &'a Value,
    chunk: Option<&'a [u8]>,
    folder: Option<&'a Path>,
    part: Part,
    /// The number in the part of each member of a list.
    numbers: HashMap<(&'static str, usize), usize>,
    /// Members whose own references are still those of the file.
    waiting: Vec<(List, usize)>,
    /// Buffers that were used, by number.
    buffers: HashMap<usize, Cow<'a, [u8]>>,
    /// Bytes of buffers and images.
    read: usize,
}

impl Gathering<'_> {
    /// Copies the nodes that show something or hold others that do, parents before children.
    fn nodes(&mut self, roots: &[usize]) -> Result<(), ParseError> {
        let all = self.document["nodes"]
            .as_array()
            .map_or(&[][..], Vec::as_slice);
        let children = |number: usize| -> Vec<usize> {
            let list = all.get(number).and_then(|node| node["children"].as_array());
            let numbers = list.into_iter().flatten().filter_map(Value::as_u64);
            numbers.map(|child| child as usize).collect()
        };
        let mut order = roots.to_vec();
        let mut next = 0;
        while let Some(&number) = order.get(next) {
            order.extend(children(number));
            next += 1;
        }
        // Children come after their parents, so backwards all of a node's are known.
        let mut shown = BTreeSet::new();
        for &number in order.iter().rev() {
            let has_mesh = all
                .get(number)
                .is_some_and(|node| node.get("mesh").is_some());
            if has_mesh || children(number).iter().any(|child| shown.contains(child)) {
                shown.insert(number);
            }
        }
        let order: Vec<usize> = order.into_iter().filter(|n| shown.contains(n)).collect();
        let places: HashMap<usize, usize> = order.iter().copied().zip(0..).collect();
        let place = |numbers: &[usize]| -> Vec<usize> {
            numbers
                .iter()
                .filter_map(|n| places.get(n))
                .copied()
                .collect()
        };
        self.part.roots = place(roots);
        for &number in &order {
            let mut node = self.node(&all[number])?;
            let children = place(&children(number));
            if !children.is_empty() {
                node["children"] = children.into();
            }
            self.part.nodes.push(node);
        }
        Ok(())
    }

    fn node(&mut self, node: &Value) -> Result<Value, ParseError> {
        let members = node.as_object().into_iter().flatten();
        let kept: Map<String, Value> = members
            .filter(|(key, _)| OF_NODE.contains(&key.as_str()))
            .map(|(key, value)| (key.clone(), value.clone()))
            .collect();
        let mut node = Value::Object(kept);
        keep_known_extensions(&mut node, &mut self.part.used);
        of_node(&mut node, &mut |list, number| self.renumber(list, number))?;
        Ok(node)
    }

    /// Puts the number in the part in place of that in the file.
    fn renumber(&mut self, list: List, number: &mut Value) -> Result<(), ParseError> {
        let old = number.as_u64().and_then(|n| usize::try_from(n).ok());
        let found = old.and_then(|n| Some((n, self.document[list.key()].get(n)?)));
        let found = found.filter(|(_, member)| member.is_object());
        let (old, member) = found.ok_or_else(|| {
            ParseError::damaged(format!("there is no {} {number}", list.member()))
        })?;
        let members = &mut self.part.lists[list];
        let new = *self.numbers.entry((list.key(), old)).or_insert_with(|| {
            members.push(member.clone());
            self.waiting.push((list, members.len() - 1));
            members.len() - 1
        });
        *number = new.into();
        Ok(())
    }

    /// Copies what a member needs and renumbers what it names.
    fn member(&mut self, list: List, number: usize) -> Result<(), ParseError> {
        let mut member = self.part.lists[list][number].take();
        keep_known_extensions(&mut member, &mut self.part.used);
        match list {
            List::BufferViews => self.view(&mut member)?,
            List::Accessors => self.check_accessor(&member)?,
            List::Meshes => self.check_mesh(&member)?,
            _ => {}
        }
        of_member(list, &mut member, &mut |list, number| {
            self.renumber(list, number)
        })?;
        if list == List::Images {
            self.image(&mut member)?;
        }
        self.part.lists[list][number] = member;
        Ok(())
    }

    /// Copies the bytes of a view, compressed ones as they are.
    fn view(&mut self, view: &mut Value) -> Result<(), ParseError> {
        let length = whole(view, "byteLength")?;
        let packed = MESHOPT
            .into_iter()
            .find(|name| view.pointer(&format!("/extensions/{name}")).is_some());
        let source = match packed {
            Some(name) => view.pointer_mut(&format!("/extensions/{name}")),
            None => Some(&mut *view),
        };
        let source = source.filter(|source| source.is_object());
        let source = source.ok_or_else(|| ParseError::damaged("a buffer view is no object"))?;
        let buffer = whole(source, "buffer")?;
        let (start, size) = (whole(source, "byteOffset")?, whole(source, "byteLength")?);
        self.load(buffer)?;
        let bytes = self.buffers[&buffer].get(start..start.saturating_add(size));
        let bytes = bytes.ok_or_else(|| {
            ParseError::damaged(format!("a buffer view reaches beyond buffer {buffer}"))
        })?;
        let most = MOST_GROWTH.saturating_mul(self.read).saturating_add(ALWAYS);
        if self.part.bytes.len().saturating_add(size) > most {
            let reason = "its buffer views overlap out of proportion";
            return Err(ParseError::damaged(reason));
        }
        source["buffer"] = 0.into();
        source["byteOffset"] = append(&mut self.part.bytes, bytes).into();
        if packed.is_some() {
            view["buffer"] = 1.into();
            view["byteOffset"] = self.part.decompressed.into();
            let end = self.part.decompressed.saturating_add(length);
            self.part.decompressed = end.next_multiple_of(4);
        }
        Ok(())
    }

    /// Reads a buffer when it is first used.
    fn load(&mut self, number: usize) -> Result<(), ParseError> {
        if self.buffers.contains_key(&number) {
            return Ok(());
        }
        let buffer = self.document["buffers"].get(number);
        let buffer =
            buffer.ok_or_else(|| ParseError::damaged(format!("there is no buffer {number}")))?;
        let length = whole(buffer, "byteLength")?;
        let uri = buffer["uri"].as_str();
        let failed = |reason| ParseError::Buffer {
            uri: gltf::shortened(uri),
            reason,
        };
        let bytes = match (uri, self.chunk) {
            (Some(uri), _) => {
                let bytes = gltf::resource(uri, Some(length), self.folder);
                Cow::Owned(bytes.map_err(failed)?)
            }
            (None, Some(chunk)) if number == 0 => Cow::Borrowed(chunk),
            (None, _) => return Err(failed("there is no binary chunk".to_owned())),
        };
        if bytes.len() < length {
            return Err(failed(format!("{} bytes instead of {length}", bytes.len())));
        }
        self.read += bytes.len();
        self.buffers.insert(number, bytes);
        Ok(())
    }

    /// Puts an image that is a file or text of the document into a view.
    fn image(&mut self, image: &mut Value) -> Result<(), ParseError> {
        let Some(uri) = image["uri"].as_str().map(str::to_owned) else {
            let whole = image.get("bufferView").is_some() && image.get("mimeType").is_some();
            return match whole {
                true => Ok(()),
                false => Err(ParseError::damaged(
                    "an image has neither an address nor a buffer view with its media type",
                )),
            };
        };
        let failed = |reason: String| ParseError::Image {
            uri: gltf::shortened(Some(&uri)),
            reason,
        };
        let bytes = gltf::resource(&uri, None, self.folder).map_err(failed)?;
        let kind = media_type(&bytes)
            .ok_or_else(|| failed("it is no PNG, JPEG, WebP or KTX2 image".to_owned()))?;
        self.read += bytes.len();
        let start = append(&mut self.part.bytes, &bytes);
        let views = &mut self.part.lists[List::BufferViews];
        views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() }));
        image["bufferView"] = (views.len() - 1).into();
        image["mimeType"] = kind.into();
        if let Some(members) = image.as_object_mut() {
            members.remove("uri");
        }
        Ok(())
    }

    /// Checks that the items of an accessor are in their views.
    fn check_accessor(&self, accessor: &Value) -> Result<(), ParseError> {
        let component = component_size(accessor)?;
        let width = match accessor["type"].as_str() {
            Some("SCALAR") => 1,
            Some("VEC2") => 2,
            Some("VEC3") => 3,
            Some("VEC4" | "MAT2") => 4,
            Some("MAT3") => 9,
            Some("MAT4") => 16,
            _ => return Err(ParseError::damaged("an accessor is of no known type")),
        };
        let count = whole(accessor, "count")?;
        self.check_items(accessor, count, width * component)?;
        let sparse = &accessor["sparse"];
        if sparse.is_null() {
            return Ok(());
        }
        let replaced = whole(sparse, "count")?;
        if replaced > count {
            let reason = "a sparse accessor has more values than items";
            return Err(ParseError::damaged(reason));
        }
        let indices = &sparse["indices"];
        self.check_items(indices, replaced, component_size(indices)?)?;
        self.check_items(&sparse["values"], replaced, width * component)
    }

    /// Checks that so many items of a size are in the view that is named, if one is.
    fn check_items(&self, place: &Value, count: usize, size: usize) -> Result<(), ParseError> {
        let Some(number) = place.get("bufferView") else {
            return Ok(());
        };
        let view = number.as_u64().and_then(|n| {
            let views = &self.document[List::BufferViews.key()];
            views.get(usize::try_from(n).ok()?)
        });
        let view =
            view.ok_or_else(|| ParseError::damaged(format!("there is no buffer view {number}")))?;
        let stride = match whole(view, "byteStride")? {
            0 => size,
            stride => stride,
        };
        let end = whole(place, "byteOffset")?
            .saturating_add(stride.saturating_mul(count.saturating_sub(1)))
            .saturating_add(size);
        if count > 0 && end > whole(view, "byteLength")? {
            let reason = format!("an accessor reaches beyond buffer view {number}");
            return Err(ParseError::damaged(reason));
        }
        Ok(())
    }

    /// Checks that all attributes of a primitive are of the same number of vertices.
    fn check_mesh(&self, mesh: &Value) -> Result<(), ParseError> {
        let primitives = mesh["primitives"].as_array();
        for primitive in primitives.into_iter().flatten() {
            let attributes = primitive["attributes"].as_object();
            let attributes = attributes
                .ok_or_else(|| ParseError::damaged("a primitive of a mesh has no attributes"))?;
            let targets = primitive["targets"].as_array().into_iter().flatten();
            let mut counts = targets
                .filter_map(Value::as_object)
                .chain([attributes])
                .flat_map(Map::values)
                .filter_map(|n| self.document["accessors"].get(usize::try_from(n.as_u64()?).ok()?))
                .map(|accessor| &accessor["count"]);
            let first = counts.next();
            if counts.any(|count| Some(count) != first) {
                let reason = "the attributes of a primitive differ in number";
                return Err(ParseError::damaged(reason));
            }
        }
        Ok(())
    }

    /// Which extensions the document has to name.
    fn extensions(&mut self) {
        let names = |key: &str| -> Vec<String> {
            let list = self.document[key].as_array().into_iter().flatten();
            list.filter_map(Value::as_str).map(str::to_owned).collect()
        };
        if names("extensionsUsed").iter().any(|n| n == QUANTIZATION) {
            self.part.used.insert(QUANTIZATION.to_owned());
        }
        let required = names("extensionsRequired");
        // What a reader would find uncompressed is not copied.
        let needed = |name: &&String| required.contains(name) || MESHOPT.contains(&name.as_str());
        self.part.required = self.part.used.iter().filter(needed).cloned().collect();
    }
}

/// Ends the bytes where numbers of four bytes may begin, and gives that place.
pub(crate) fn align(bytes: &mut Vec<u8>) -> usize {
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    bytes.len()
}

/// Appends bytes, and gives the place where they begin.
pub(crate) fn append(all: &mut Vec<u8>, bytes: &[u8]) -> usize {
    let start = align(all);
    all.extend_from_slice(bytes);
    start
}

/// A whole number, zero where there is none.
fn whole(value: &Value, key: &str) -> Result<usize, ParseError> {
    let Some(number) = value.get(key) else {
        return Ok(0);
    };
    let whole = number.as_u64().and_then(|n| usize::try_from(n).ok());
    whole.ok_or_else(|| ParseError::damaged(format!("`{key}` is {number}, no whole number")))
}

/// Bytes of a component.
fn component_size(value: &Value) -> Result<usize, ParseError> {
    match value["componentType"].as_u64() {
        Some(5120 | 5121) => Ok(1),
        Some(5122 | 5123) => Ok(2),
        Some(5125 | 5126) => Ok(4),
        _ => Err(ParseError::damaged(
            "an accessor has no known component type",
        )),
    }
}
