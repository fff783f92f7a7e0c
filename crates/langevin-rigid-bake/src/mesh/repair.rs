//! Making a body of a mesh that is none.
//!
//! [`repair`] takes triangles as they come and does to them, in a fixed order, what [`Step`] lists. A
//! body comes out as it went in.

mod balance;
mod degenerate;
mod duplicates;
mod holes;
mod orient;
mod parts;
mod report;
mod split;
mod weld;

pub use balance::Balance;
pub(super) use duplicates::first_copies;
pub(super) use orient::{minority, signed_volumes};
pub(super) use parts::areas;
pub use report::{Repaired, Step, Unrepaired};

use super::boundary::open_sides;
use super::edges::sorted_sides;
use super::parts::components;
use super::vector::{bounding_box, cross, norm, sub};
use super::wrap::{Wrap, wrap};
use super::{MeshError, TriMesh, check, weld as welding};
use crate::progress::Progress;

/// Share of the diagonal of the bounding box within which open vertices are welded by default: a hundred
/// times the rounding of single precision, and below what matters to any load.
pub const WELD: f64 = 1e-6;
/// Most edges of a hole that is filled by default.
pub const FILL: usize = 100;
/// A hole is filled where a disc of its perimeter has less than this share of the surface around it. A
/// flat sheet and its rim are at 1 or more, a hemispherical bowl at 0.5, a cube without a face at 0.25.
pub const SMALL_HOLE: f64 = 0.3;
/// The share where [`Options::fill`] says how many edges: all but flat sheets are closed.
pub const WIDE_HOLE: f64 = 0.9;

/// Choices of [`repair`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Options {
    /// Vertices of open edges this close (m) are welded; by default [`WELD`] of the box's diagonal.
    pub weld: Option<f64>,
    /// Most edges of a hole that is filled, up to [`WIDE_HOLE`]; by default [`FILL`] up to [`SMALL_HOLE`],
    /// or none for a sheet with a thickness.
    pub fill: Option<usize>,
    /// Thickness (m) given to what is an open sheet after that.
    pub thickness: Option<f64>,
    /// Triangles to simplify to.
    pub triangles: Option<usize>,
    /// In place of all this wrap the triangles: one closed surface around them that closes gaps up to about
    /// this size (m) and leaves out what is inside. Closed parts that meet are wrapped unasked.
    pub wrap: Option<f64>,
    /// Keep the component with the largest surface and drop the others.
    pub largest: bool,
}

/// What is done to them on the way.
type Stage = fn(&mut Soup, &Options);

/// Triangles on their way.
struct Soup {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    steps: Vec<Step>,
}

/// Mends a mesh (positions in m) until it is a body, and says how.
///
/// ```
/// use langevin_rigid_bake::mesh::{Options, Step, repair};
/// use langevin_rigid_bake::shapes::Shape;
///
/// let cube = Shape::Box { size: [0.1; 3] }.mesh(300)?;
/// let mut triangles = cube.triangles().to_vec();
/// triangles.remove(7);
/// triangles[20].swap(0, 1);
/// let repaired = repair(cube.vertices(), &triangles, &Options::default(), &());
/// assert_eq!(repaired.steps[0], Step::Turned { triangles: 1 });
/// assert!(matches!(repaired.steps[1], Step::Filled { holes: 1, edges: 3, triangles: 1, .. }));
/// assert!(repaired.balance.unwrap().made_share() < 0.01);
/// assert!((repaired.body?.volume() / cube.volume() - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A sheet is thickened only where `thickness` is given, and components are dropped only where `largest`
/// is: which of them is the body, nobody can know from the triangles. A triangle with a coordinate that
/// is not finite, or beyond 1e60 m, or with a vertex that does not exist is dropped as one without area.
pub fn repair(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &Options,
    progress: &dyn Progress,
) -> Repaired {
    let mut soup = Soup {
        vertices: vertices.to_vec(),
        triangles: triangles.to_vec(),
        steps: Vec::new(),
    };
    let given = sound_area(vertices, triangles);
    let body = mend(&mut soup, options, progress);
    let balance = body.as_ref().ok();
    Repaired {
        balance: balance.map(|body| Balance::new(given, &soup.steps, body)),
        steps: soup.steps,
        body,
    }
}

fn mend(
    soup: &mut Soup,
    options: &Options,
    progress: &dyn Progress,
) -> Result<TriMesh, Unrepaired> {
    if let Some(size) = options.wrap {
        progress.report("wrapping", 0.0);
        drop_unusable(soup, options);
        let body = soup.wrapped(size, None)?;
        return soup.simplified(body, options.triangles);
    }
    let stages: [(&str, Stage); 11] = [
        ("dropping the unusable", drop_unusable),
        ("welding", weld::weld),
        ("triangles without area", degenerate::resolve),
        ("duplicates", duplicates::drop),
        ("orientation", orient::agree),
        ("holes", holes::fill),
        ("triangles without area", degenerate::resolve),
        ("duplicates", duplicates::drop),
        ("orientation", orient::agree),
        ("components", parts::keep_largest),
        ("splitting", split::split),
    ];
    let closed = check::closed_manifold(&soup.vertices, &soup.triangles).is_ok();
    if !closed || options.largest {
        for (at, (name, stage)) in stages.iter().enumerate() {
            if progress.cancelled() {
                return Err(Unrepaired::Cancelled);
            }
            progress.report(name, at as f64 / stages.len() as f64);
            stage(soup, options);
        }
    }
    let body = match soup.thickened(options.thickness) {
        Err(Unrepaired::NoBody(MeshError::PartsMeet { wrap, .. })) if soup.is_closed() => {
            progress.report("wrapping", 0.0);
            soup.wrapped(wrap, Some(soup.volume_of_parts()))?
        }
        body => body?,
    };
    soup.simplified(body, options.triangles)
}

impl Soup {
    fn weld_distance(&self, options: &Options) -> f64 {
        let [low, high] = bounding_box(&self.vertices);
        options.weld.unwrap_or(WELD * norm(sub(high, low)))
    }

    fn did(&mut self, step: Step) {
        if step.count() > 0 {
            self.steps.push(step);
        }
    }

    /// The body these triangles are, or the body of the sheet that they are.
    fn thickened(&mut self, thickness: Option<f64>) -> Result<TriMesh, Unrepaired> {
        let (vertices, triangles) = (self.vertices.clone(), self.triangles.clone());
        let open = open_sides(&sorted_sides(&triangles)).len();
        let body = match thickness.filter(|_| open > 0) {
            Some(thickness) => {
                self.did(Step::Thickened {
                    edges: open,
                    thickness,
                });
                TriMesh::from_sheet(vertices, triangles, thickness)
            }
            None => TriMesh::new(vertices, triangles),
        };
        let body = body.map_err(|error| report::left(&self.vertices, &self.triangles, error))?;
        self.did(Step::InsideOut {
            triangles: body.turned,
        });
        Ok(body)
    }

    fn is_closed(&self) -> bool {
        open_sides(&sorted_sides(&self.triangles)).is_empty()
    }

    /// Sum of the volumes of the components (m³), each turned outward.
    fn volume_of_parts(&self) -> f64 {
        let roots = components(self.triangles.len(), &sorted_sides(&self.triangles));
        let volumes = signed_volumes(&self.vertices, &self.triangles, &roots);
        volumes.iter().map(|v| v.abs()).sum()
    }

    fn wrapped(&mut self, size: f64, parts: Option<f64>) -> Result<TriMesh, Unrepaired> {
        let Wrap { body, made, leak } = wrap(&self.vertices, &self.triangles, size)?;
        self.did(Step::Wrapped {
            size,
            triangles: body.triangles().len(),
            made,
            volume: body.volume(),
            parts,
            leak,
        });
        Ok(body)
    }

    fn simplified(
        &mut self,
        body: TriMesh,
        triangles: Option<usize>,
    ) -> Result<TriMesh, Unrepaired> {
        let from = body.triangles().len();
        let Some(wanted) = triangles.filter(|&n| n < from) else {
            return Ok(body);
        };
        let body = body.proxy(wanted)?;
        let to = body.triangles().len();
        self.did(Step::Simplified { from, to });
        Ok(body)
    }
}

/// The surface without triangles that have no area or lie back to back.
#[cfg(feature = "meshopt")]
pub(super) fn without_remnants(
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut soup = Soup {
        vertices,
        triangles,
        steps: Vec::new(),
    };
    let stages: [Stage; 6] = [
        drop_unusable,
        degenerate::resolve,
        duplicates::drop,
        degenerate::resolve,
        duplicates::drop,
        split::split,
    ];
    for stage in stages {
        stage(&mut soup, &Options::default());
    }
    (soup.vertices, soup.triangles)
}

/// Drops triangles whose corners are no places, and all vertices without a triangle.
fn drop_unusable(soup: &mut Soup, _: &Options) {
    let before = [soup.triangles.len(), soup.vertices.len()];
    let vertices = std::mem::take(&mut soup.vertices);
    soup.triangles
        .retain(|t| t.iter().all(|&v| is_place(&vertices, v)));
    (soup.vertices, soup.triangles) =
        welding::drop_unused(vertices, std::mem::take(&mut soup.triangles));
    soup.did(Step::Unusable {
        triangles: before[0] - soup.triangles.len(),
    });
    soup.did(Step::Unused {
        vertices: before[1] - soup.vertices.len(),
    });
}

/// Diagonal of the box around what can be used of a mesh (m), 0 where that is nothing.
pub fn diagonal(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    let used = triangles
        .iter()
        .flatten()
        .filter(|&&v| is_place(vertices, v));
    let places: Vec<[f64; 3]> = used.map(|&v| vertices[v as usize]).collect();
    if places.is_empty() {
        return 0.0;
    }
    let [low, high] = bounding_box(&places);
    norm(sub(high, low))
}

/// Area of the triangles that can be used, each once (m²).
fn sound_area(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    let first = first_copies(triangles);
    let is_sound =
        |t: &usize| first[*t] == *t && triangles[*t].iter().all(|&v| is_place(vertices, v));
    let sound = (0..triangles.len()).filter(is_sound);
    sound
        .map(|t| area_of(triangles[t].map(|v| vertices[v as usize])))
        .sum()
}

/// Area of a triangle (m²).
fn area_of([a, b, c]: [[f64; 3]; 3]) -> f64 {
    0.5 * norm(cross(sub(b, a), sub(c, a)))
}

/// Whether a vertex exists and its coordinates can be multiplied with each other.
pub(super) fn is_place(vertices: &[[f64; 3]], v: u32) -> bool {
    let place = vertices.get(v as usize);
    place.is_some_and(|p| p.iter().all(|x| x.abs() < 1e60))
}

#[cfg(test)]
mod tests;
