//! What the nodes of the scene show, and where.

use std::collections::{BTreeMap, BTreeSet};

use super::super::transform::Transform;
use super::super::{ParseError, RawMesh};
use super::controller;
use super::document::{Document, Element, child, children, elements, fault};
use super::geometry::{Geometries, Surface};
use super::placement;

/// A node, made ready to be shown many times.
struct Node<'a> {
    element: Element<'a>,
    transform: Transform,
    items: Vec<Item>,
}

/// What a node holds, by number.
enum Item {
    Node(usize),
    Surface(usize),
}

/// What is left to do on the way through the nodes.
enum Step {
    Enter(usize, Transform),
    Leave(usize),
}

/// The nodes that the scene reaches.
pub(super) struct Scene<'d, 'a> {
    document: &'d Document<'a>,
    geometries: Geometries<'d, 'a>,
    nodes: Vec<Node<'a>>,
    roots: Vec<usize>,
    /// Surfaces, and whether they are in the scene's frame already.
    surfaces: Vec<(Surface, bool)>,
    /// Numbers of nodes, geometries and instances of controllers by their elements.
    numbers: BTreeMap<u32, usize>,
}

impl<'d, 'a> Scene<'d, 'a> {
    /// Reads everything once and counts what it shows.
    pub(super) fn read(document: &'d Document<'a>) -> Result<Self, ParseError> {
        let mut scene = Scene {
            document,
            geometries: Geometries::new(document),
            nodes: Vec::new(),
            roots: Vec::new(),
            surfaces: Vec::new(),
            numbers: BTreeMap::new(),
        };
        let mut waiting: Vec<usize> = Vec::new();
        for root in scene.tops()? {
            let root = match root.tag_name().name() {
                "node" => scene.node(root, &mut waiting)?,
                _ => scene.bare(root)?,
            };
            scene.roots.push(root);
        }
        while let Some(node) = waiting.pop() {
            scene.fill(node, &mut waiting)?;
        }
        scene.count()?;
        Ok(scene)
    }

    /// The triangles, placed.
    pub(super) fn mesh(&self) -> Result<RawMesh, ParseError> {
        let mut mesh = RawMesh::default();
        self.walk(&mut || Ok(()), &mut |number, transform| {
            let (surface, is_placed) = &self.surfaces[number];
            let map = if *is_placed {
                Transform::IDENTITY
            } else {
                transform
            };
            let places = surface.places.iter().map(|&p| map.apply(p));
            mesh.append(places, &surface.triangles, map.mirrors());
            Ok(())
        })?;
        Ok(mesh)
    }

    /// The nodes of the scene that the file names, else of all its scenes, else of its libraries; the
    /// geometries where there is no node.
    fn tops(&self) -> Result<Vec<Element<'a>>, ParseError> {
        let root = self.document.root();
        let named = child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene"));
        if let Some(instance) = named {
            let scene = self.document.referred(instance, "url", &["visual_scene"])?;
            return Ok(children(scene, "node").collect());
        }
        let all = |library: &'static str, kind: &'static str| -> Vec<Element<'a>> {
            let libraries = children(root, library);
            libraries
                .flat_map(|library| children(library, kind))
                .collect()
        };
        let in_scenes: Vec<_> = all("library_visual_scenes", "visual_scene")
            .into_iter()
            .flat_map(|scene| children(scene, "node"))
            .collect();
        if !in_scenes.is_empty() {
            self.document
                .note("it names no scene: took all nodes of all its scenes");
            return Ok(in_scenes);
        }
        let instances = root
            .descendants()
            .filter(|e| e.tag_name().name() == "instance_node");
        let shown: BTreeSet<&str> = instances.filter_map(|i| i.attribute("url")).collect();
        let mut nodes = all("library_nodes", "node");
        nodes.retain(|node| {
            !node
                .attribute("id")
                .is_some_and(|id| shown.contains(&*format!("#{id}")))
        });
        if !nodes.is_empty() {
            self.document
                .note("it has no scene: took all nodes of its library");
            return Ok(nodes);
        }
        let geometries = all("library_geometries", "geometry");
        if !geometries.is_empty() {
            self.document
                .note("it has no scene: took all geometries as they are, unplaced");
        }
        Ok(geometries)
    }

    /// The number of a node, which waits to be filled when it is new.
    fn node(
        &mut self,
        element: Element<'a>,
        waiting: &mut Vec<usize>,
    ) -> Result<usize, ParseError> {
        if let Some(&known) = self.numbers.get(&element.id().get()) {
            return Ok(known);
        }
        let number = self.nodes.len();
        self.numbers.insert(element.id().get(), number);
        self.nodes.push(Node {
            element,
            transform: placement::of_node(self.document, element)?,
            items: Vec::new(),
        });
        waiting.push(number);
        Ok(number)
    }

    /// A node of nothing but a geometry.
    fn bare(&mut self, geometry: Element<'a>) -> Result<usize, ParseError> {
        let surface = self.geometry(geometry)?;
        self.nodes.push(Node {
            element: geometry,
            transform: Transform::IDENTITY,
            items: vec![Item::Surface(surface)],
        });
        Ok(self.nodes.len() - 1)
    }

    fn fill(&mut self, number: usize, waiting: &mut Vec<usize>) -> Result<(), ParseError> {
        let document = self.document;
        for element in elements(self.nodes[number].element) {
            let item = match element.tag_name().name() {
                "node" => Item::Node(self.node(element, waiting)?),
                "instance_node" => {
                    let node = document.referred(element, "url", &["node"])?;
                    Item::Node(self.node(node, waiting)?)
                }
                "instance_geometry" => {
                    let geometry = document.referred(element, "url", &["geometry"])?;
                    Item::Surface(self.geometry(geometry)?)
                }
                "instance_controller" => {
                    let surface = controller::surface(document, &mut self.geometries, element)?;
                    self.surfaces.push(surface);
                    Item::Surface(self.surfaces.len() - 1)
                }
                _ => continue,
            };
            self.nodes[number].items.push(item);
        }
        Ok(())
    }

    fn geometry(&mut self, element: Element<'a>) -> Result<usize, ParseError> {
        if let Some(&known) = self.numbers.get(&element.id().get()) {
            return Ok(known);
        }
        self.surfaces
            .push((self.geometries.surface(element)?, false));
        self.numbers
            .insert(element.id().get(), self.surfaces.len() - 1);
        Ok(self.surfaces.len() - 1)
    }

    /// Counts what is shown before any of it is made.
    fn count(&self) -> Result<(), ParseError> {
        let charge = |number: usize, _| {
            let triangles = self.surfaces[number].0.triangles.len();
            self.document.charge(triangles.max(1))
        };
        self.walk(&mut || self.document.charge(1), &mut { charge })
    }

    /// Goes through the nodes in the order of the file, showing each surface where it is.
    fn walk(
        &self,
        step: &mut dyn FnMut() -> Result<(), ParseError>,
        show: &mut dyn FnMut(usize, Transform) -> Result<(), ParseError>,
    ) -> Result<(), ParseError> {
        let mut around = vec![false; self.nodes.len()];
        let enter = |&root: &usize| Step::Enter(root, Transform::IDENTITY);
        let mut waiting: Vec<Step> = self.roots.iter().rev().map(enter).collect();
        while let Some(next) = waiting.pop() {
            let (number, parent) = match next {
                Step::Enter(number, parent) => (number, parent),
                Step::Leave(number) => {
                    around[number] = false;
                    continue;
                }
            };
            step()?;
            let node = &self.nodes[number];
            if std::mem::replace(&mut around[number], true) {
                return Err(fault(node.element, "it is inside itself"));
            }
            let transform = parent.after(&node.transform);
            waiting.push(Step::Leave(number));
            for item in &node.items {
                if let Item::Surface(surface) = item {
                    show(*surface, transform)?;
                }
            }
            let inner = node.items.iter().rev().filter_map(|item| match item {
                Item::Node(inner) => Some(Step::Enter(*inner, transform)),
                Item::Surface(_) => None,
            });
            waiting.extend(inner);
        }
        Ok(())
    }
}
