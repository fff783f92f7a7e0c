//! Visuals in the file: their objects once a kind, their nodes once a body.

use std::convert::Infallible;

use serde_json::{Value, json};

use super::File;
use crate::visual::Visual;
use crate::visual::append;
use crate::visual::references::{List, MESHOPT, of_member, of_node};

/// Where the objects of a visual begin in the lists of the file.
pub(super) struct Look<'a> {
    visual: &'a Visual,
    starts: [usize; List::ALL.len()],
}

impl File {
    /// Takes up the meshes, materials and textures of a visual.
    pub(super) fn look<'a>(&mut self, visual: &'a Visual) -> Look<'a> {
        let part = &visual.part;
        let starts = List::ALL.map(|list| self.lists[list].len());
        let look = Look { visual, starts };
        let start = append(&mut self.bytes, &part.bytes);
        for list in List::ALL {
            for member in &part.lists[list] {
                let mut member = member.clone();
                if list == List::BufferViews {
                    place(&mut member, start, self.decompressed);
                }
                shifted(of_member(list, &mut member, &mut |list, number| {
                    look.shift(list, number)
                }));
                self.lists[list].push(member);
            }
        }
        self.decompressed += part.decompressed;
        self.used.extend(part.used.iter().cloned());
        self.required.extend(part.required.iter().cloned());
        look
    }
}

impl Look<'_> {
    /// Hangs the visual below a body's node.
    pub(super) fn hang(&self, body: usize, nodes: &mut Vec<Value>) {
        let Visual {
            scale,
            centre_of_mass,
            part,
            ..
        } = self.visual;
        let first = nodes.len() + 1;
        nodes[body]["children"] = json!([nodes.len()]);
        let roots: Vec<usize> = part.roots.iter().map(|root| first + root).collect();
        let mut top = json!({
            "name": "visual",
            "translation": centre_of_mass.map(|x| 0.0 - x),
            "children": roots,
        });
        if *scale != 1.0 {
            top["scale"] = vec![*scale; 3].into();
        }
        nodes.push(top);
        for node in &part.nodes {
            let mut node = node.clone();
            shifted(of_node(&mut node, &mut |list, number| {
                self.shift(list, number)
            }));
            let children = node.get_mut("children").and_then(Value::as_array_mut);
            for child in children.into_iter().flatten() {
                add(child, first);
            }
            nodes.push(node);
        }
    }

    fn shift(&self, list: List, number: &mut Value) -> Result<(), Infallible> {
        add(number, self.starts[list as usize]);
        Ok(())
    }
}

/// Moves the bytes of a view: those in the buffer, and those that are there once they are decompressed.
fn place(view: &mut Value, start: usize, decompressed: usize) {
    let mut compressed = false;
    for extension in MESHOPT {
        if let Some(offset) = view.pointer_mut(&format!("/extensions/{extension}/byteOffset")) {
            add(offset, start);
            compressed = true;
        }
    }
    let start = if compressed { decompressed } else { start };
    if let Some(offset) = view.get_mut("byteOffset") {
        add(offset, start);
    }
}

fn add(number: &mut Value, start: usize) {
    *number = (number.as_u64().unwrap_or(0) + start as u64).into();
}

/// Shifting numbers cannot fail.
fn shifted(done: Result<(), Infallible>) {
    match done {
        Ok(()) => {}
        Err(never) => match never {},
    }
}
