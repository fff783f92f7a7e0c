//! Everything there is to know of a mesh before it is a body, good or bad, in one go.

mod findings;

pub use findings::Finding;

use super::boundary::{Hole, loops, open_sides};
use super::edges::{Side, by_edge, sorted_sides};
use super::intersect::meetings;
use super::nesting::around;
use super::parts::{fans, windings};
use super::repair::{WELD, areas, first_copies, is_place, minority, signed_volumes};
use super::seams::twins;
use super::vector::{bounding_box, norm, sub};
use super::weld::drop_unused;
use super::{EdgeSite, MeshError, TriMesh, check};
use crate::progress::Progress;

/// What a mesh is and what is wrong with it.
///
/// Topology is that of the sound triangles: those that can be used, have area and are there for the first
/// time.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// Triangles given.
    pub triangles: usize,
    /// Vertices given.
    pub vertices: usize,
    /// Lowest and highest corner of the box around the triangles that can be used (m); zero without any.
    pub bounds: [[f64; 3]; 2],
    /// Area of all sound triangles (m²).
    pub area: f64,
    /// Volume of the solid (m³), cavities subtracted; it means nothing while there are holes or parts meet (see
    /// [`Survey::closed_volume`]).
    pub volume: f64,
    /// Triangles with a vertex that does not exist, or a coordinate that is not finite or beyond 1e60 m.
    pub unusable: usize,
    /// Vertices that no triangle uses.
    pub unused_vertices: usize,
    /// Triangles without area.
    pub degenerate: usize,
    /// Triangles that repeat the vertices of another.
    pub duplicates: usize,
    /// Holes, the longest perimeter first.
    pub holes: Vec<Hole>,
    /// Open vertices that lie at the place of another, or nearly so.
    pub seams: Seams,
    /// Edges where more than two triangles meet.
    pub non_manifold_edges: Faults,
    /// Vertices where parts of the surface touch in a point.
    pub non_manifold_vertices: Faults,
    /// Triangles to turn for neighbours to agree, the fewer of each component.
    pub flipped: usize,
    /// An edge at which a surface of one side only runs into itself.
    pub one_sided: Option<EdgeSite>,
    /// Triangles that meet others, passing through them or lying on them.
    pub meeting: Faults,
    /// Components, the largest area first.
    pub components: Vec<Component>,
    /// Why it is no body, or the body.
    pub body: Result<TriMesh, MeshError>,
}

/// Faults of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Faults {
    /// How many there are.
    pub count: usize,
    /// Where the first is (m).
    pub first: Option<[f64; 3]>,
}

/// Vertices that should be one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seams {
    /// How many could be welded to another.
    pub vertices: usize,
    /// The farthest apart (m).
    pub distance: f64,
    /// How far was looked (m).
    pub tolerance: f64,
}

/// Triangles that hang together by edges of two triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Component {
    /// How many triangles.
    pub triangles: usize,
    /// Their area (m²).
    pub area: f64,
    /// Volume under them (m³), negative where the normals point inward; nothing where it is open.
    pub volume: Option<f64>,
    /// How many closed components are around it: the walls of cavities have an odd number.
    pub depth: usize,
    /// The smallest of them, by its place in [`Survey::components`].
    pub inside: Option<usize>,
}

impl Component {
    /// Whether its normals point into the solid.
    pub fn is_inside_out(&self) -> bool {
        self.volume
            .is_some_and(|volume| (volume < 0.0) != (self.depth % 2 == 1))
    }

    /// What it adds to the solid (m³), negative for a cavity; nothing where it is open.
    fn solid(&self) -> Option<f64> {
        let sign = if self.depth % 2 == 1 { -1.0 } else { 1.0 };
        self.volume.map(|volume| sign * volume.abs())
    }
}

impl Survey {
    /// The volume of the solid (m³), where the surface is closed and does not meet itself.
    pub fn closed_volume(&self) -> Option<f64> {
        let faults = [&self.non_manifold_edges, &self.meeting];
        let closed = self.holes.is_empty() && faults.iter().all(|faults| faults.count == 0);
        closed.then_some(self.volume)
    }
}

/// Surveys triangles over vertices (m), whatever they are; nothing where `progress` was cancelled.
///
/// ```
/// use langevin_rigid_bake::mesh::survey;
/// use langevin_rigid_bake::shapes::Shape;
///
/// let cube = Shape::Box { size: [0.1; 3] }.mesh(12)?;
/// let survey = survey(cube.vertices(), &cube.triangles()[1..], &()).unwrap();
/// assert_eq!((survey.holes.len(), survey.holes[0].edges), (1, 3));
/// assert!(survey.body.is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn survey(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    progress: &dyn Progress,
) -> Option<Survey> {
    let step = |stage: &str, fraction: f64| {
        progress.report(stage, fraction);
        (!progress.cancelled()).then_some(())
    };
    step("triangles", 0.0)?;
    let sound = Sound::new(vertices, triangles);
    step("edges", 0.2)?;
    let sides = sorted_sides(&sound.triangles);
    let open = open_sides(&sides);
    let mut holes: Vec<Hole> = loops(sound.vertices.len(), &open)
        .iter()
        .map(|rim| Hole::new(&sound.vertices, rim))
        .collect();
    holes.sort_by(|a, b| b.perimeter.total_cmp(&a.perimeter));
    step("components", 0.5)?;
    let (parts, one_sided) = windings(sound.triangles.len(), &sides);
    let turned = minority(&parts);
    let components = components(&sound, &parts, &turned, &sides);
    step("body", 0.6)?;
    let body = TriMesh::new(vertices.to_vec(), triangles.to_vec());
    step("intersections", 0.8)?;
    let meeting = match &body {
        Ok(_) => Faults::default(),
        Err(_) => meeting(&sound),
    };
    Some(Survey {
        triangles: triangles.len(),
        vertices: vertices.len(),
        bounds: sound.bounds,
        area: components.iter().map(|c| c.area).sum(),
        volume: components.iter().filter_map(Component::solid).sum(),
        unusable: sound.unusable,
        unused_vertices: sound.unused,
        degenerate: sound.degenerate,
        duplicates: sound.duplicates,
        holes,
        seams: seams(&sound, &open),
        non_manifold_edges: non_manifold_edges(&sound.vertices, &sides),
        non_manifold_vertices: non_manifold_vertices(&sound, &sides),
        flipped: turned.iter().filter(|turn| **turn).count(),
        one_sided: one_sided.map(|side| check::site(&sound.vertices, &side)),
        meeting,
        components,
        body,
    })
}

/// The triangles that have a topology, and how many have none.
struct Sound {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    bounds: [[f64; 3]; 2],
    unusable: usize,
    unused: usize,
    degenerate: usize,
    duplicates: usize,
}

impl Sound {
    fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Sound {
        let exist = |t: &&[u32; 3]| t.iter().all(|&v| is_place(vertices, v));
        let usable: Vec<[u32; 3]> = triangles.iter().filter(exist).copied().collect();
        let (placed, mut kept) = drop_unused(vertices.to_vec(), usable);
        let place = |t: &[u32; 3]| t.map(|v| placed[v as usize]);
        let unusable = triangles.len() - kept.len();
        let usable = kept.len();
        kept.retain(|t| !check::has_no_area(place(t)));
        let with_area = kept.len();
        let first = first_copies(&kept);
        let originals = (0..with_area).filter(|&t| first[t] == t);
        let sound: Vec<[u32; 3]> = originals.map(|t| kept[t]).collect();
        let empty = placed.is_empty();
        Sound {
            bounds: if empty {
                [[0.0; 3]; 2]
            } else {
                bounding_box(&placed)
            },
            unusable,
            unused: unused(vertices.len(), triangles),
            degenerate: usable - with_area,
            duplicates: with_area - sound.len(),
            vertices: placed,
            triangles: sound,
        }
    }
}

fn unused(vertices: usize, triangles: &[[u32; 3]]) -> usize {
    let mut unused = vec![true; vertices];
    for &v in triangles.as_flattened() {
        if let Some(flag) = unused.get_mut(v as usize) {
            *flag = false;
        }
    }
    unused.iter().filter(|flag| **flag).count()
}

fn seams(sound: &Sound, open: &[Side]) -> Seams {
    let [low, high] = sound.bounds;
    let tolerance = WELD * norm(sub(high, low));
    let twins = twins(&sound.vertices, open, tolerance);
    Seams {
        vertices: twins.len(),
        distance: twins.iter().map(|t| t.distance).fold(0.0, f64::max),
        tolerance,
    }
}

fn non_manifold_edges(vertices: &[[f64; 3]], sides: &[Side]) -> Faults {
    let bad: Vec<&[Side]> = by_edge(sides).filter(|edge| edge.len() > 2).collect();
    Faults {
        count: bad.len(),
        first: bad
            .first()
            .map(|edge| check::site(vertices, &edge[0]).position),
    }
}

fn meeting(sound: &Sound) -> Faults {
    let meetings = meetings(&sound.vertices, &sound.triangles);
    Faults {
        count: meetings.len(),
        first: meetings.first().map(|meeting| meeting.position),
    }
}

/// Vertices with more than one fan, where those that only meet at a non-manifold edge count as one.
fn non_manifold_vertices(sound: &Sound, sides: &[Side]) -> Faults {
    let joined = by_edge(sides).flat_map(|edge| edge.windows(2).map(|pair| [&pair[0], &pair[1]]));
    let fans = fans(&sound.triangles, joined);
    let mut count = vec![0u32; sound.vertices.len()];
    for (corner, &v) in sound.triangles.as_flattened().iter().enumerate() {
        count[v as usize] += u32::from(fans[corner] == corner);
    }
    let bad: Vec<usize> = (0..count.len()).filter(|&v| count[v] > 1).collect();
    Faults {
        count: bad.len(),
        first: bad.first().map(|&v| sound.vertices[v]),
    }
}

/// The components, their triangles wound as most of them are.
fn components(
    sound: &Sound,
    parts: &[(usize, bool)],
    turned: &[bool],
    sides: &[Side],
) -> Vec<Component> {
    let mut agreeing = sound.triangles.clone();
    for (t, _) in agreeing.iter_mut().zip(turned).filter(|(_, turn)| **turn) {
        t.swap(1, 2);
    }
    let roots: Vec<usize> = parts.iter().map(|part| part.0).collect();
    let areas = areas(&sound.vertices, &agreeing, &roots);
    let volumes = signed_volumes(&sound.vertices, &agreeing, &roots);
    let mut closed = vec![true; roots.len()];
    for edge in by_edge(sides).filter(|edge| edge.len() != 2) {
        edge.iter()
            .for_each(|side| closed[roots[side.triangle as usize]] = false);
    }
    let mut counts = vec![0; roots.len()];
    roots.iter().for_each(|&root| counts[root] += 1);
    let mut order: Vec<usize> = (0..roots.len()).filter(|&r| counts[r] > 0).collect();
    order.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]));
    let around = around(&sound.vertices, &agreeing, &roots, &order, |root| {
        closed[root]
    });
    order
        .iter()
        .zip(around)
        .map(|(&root, around)| Component {
            triangles: counts[root],
            area: areas[root],
            volume: closed[root].then_some(volumes[root]),
            depth: around.len(),
            inside: around.last().copied(),
        })
        .collect()
}

#[cfg(test)]
mod tests;
