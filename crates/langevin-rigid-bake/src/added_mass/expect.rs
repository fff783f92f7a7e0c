//! What the added mass of a body will cost, and how accurate it will be, without solving for it.

use rayon::prelude::*;

use super::discretize::Discretized;
use super::edges::{Edges, Fold, folds};
use super::flow::HIERARCHICAL;
use super::near::{self, NearPairs, facing};
use super::outcome::FACETING;
use super::panels::{Panel, Panels};
use super::report::Cancel;
use super::{AddedMassError, Options, check_size};
use crate::mesh::TriMesh;
use crate::mesh::vector::{bounding_box, cross, norm, sub};

/// Seconds on two idle cores of a Xeon of 2026, from the tables of docs/performance.md: with a matrix they
/// grow with the triangles and their square, with clusters with a power of them.
const PER_TRIANGLE: f64 = 6.7e-6;
const PER_PAIR: f64 = 6.7e-9;
/// The near pairs of a triangle that these figures hold, and what each more of them takes, seen both ways.
const USUAL_NEAR: f64 = 80.0;
const PER_NEAR_PAIR: f64 = 1e-7;
const CLUSTERS: f64 = 2.9e-5;
const CLUSTERS_POWER: f64 = 1.16;
/// Allowance for the second solve, without the edge layer, and slower convergence of bodies with edges: not
/// fitted, but forecasts with it are within a factor of two of what docs/meshes.md lists.
const WITH_EDGES: f64 = 1.5;

/// Change of the tensor by the extrapolation at sharp edges, over the sum of length × height^p over
/// area^((1 + p)/2), with p twice the exponent of potentials at the edge, 4/3 at a right angle: 0.18 to 0.28 over boxes from a cube to
/// 1 : 1 : 0.1 and rods 1 : 15 of 1700 to 39,000 triangles. Where the body is thinner than the triangles are
/// high, the potentials are those of a plate, with the first power.
const EDGES: f64 = 0.25;
/// An edge sharper than a right angle, whose power p is below 4/3, changes it this to the power 4/3 - p times as
/// much: 1.05, 1.7 and 3 times at base angles of a cone of 84, 72 and 45 degrees, less again for flat ones.
const SHARPER: f64 = 200.0;

/// What the integrals over pairs of panels miss of the volume, seen from 3e-5 to 1e-4.
const QUADRATURE: f64 = 5e-5;

/// Largest added mass over (largest projected area)^(3/2) (width / length)^(1/2): 0.48 for a disc, 0.58 for
/// a square, 0.64 for a cube, 0.79 for a long strip.
const BROADSIDE: f64 = 0.65;

/// What to expect of [`added_mass`](super::added_mass()) on a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// Triangles solved on.
    pub triangles_solved: usize,
    /// Relative error, of the order of [`AddedMass::error_estimate`](super::AddedMass::error_estimate).
    pub error_estimate: f64,
    /// Time on as many idle cores as there are threads (s).
    pub seconds: f64,
    /// [`MeshQuality::thickness_ratio`](super::MeshQuality::thickness_ratio), exactly.
    pub thickness_ratio: f64,
    /// The wall that is thinnest beside its triangles; nothing where none is thinner than they are long.
    pub thinnest: Option<Thinnest>,
}

/// A wall of the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thinnest {
    /// How thick it is (m).
    pub thickness: f64,
    /// Its thickness over the longest edge of its triangles.
    pub ratio: f64,
    /// Where it is (m).
    pub position: [f64; 3],
}

/// Looks at a body as [`added_mass`](super::added_mass()) would divide it, and foretells what that will
/// give: mostly good to a factor of two, of errors below 0.1 % to three.
///
/// # Errors
///
/// [`AddedMassError::TooLarge`] for more triangles than `options` allow.
pub fn expected(mesh: &TriMesh, options: &Options) -> Result<Expected, AddedMassError> {
    let mesh = &*mesh.wetted();
    check_size(mesh.triangles().len(), options)?;
    let body = Discretized::new(mesh, options, &())?;
    check_size(body.triangles.len(), options)?;
    let panels = Panels::new(&body.vertices, &body.triangles);
    let pairs = NearPairs::find(&panels.panels, &Cancel::new(&(), "near pairs", 1))?;
    let missed = FACETING * body.faceting() + QUADRATURE * body.frame.volume;
    let broadside = broadside(&body, &panels.panels);
    Ok(Expected {
        triangles_solved: body.triangles.len(),
        error_estimate: EDGES * at_edges(&body) + missed / broadside,
        seconds: seconds(&body, pairs.count()),
        thickness_ratio: near::thickness(&panels.panels, &pairs).ratio,
        thinnest: thinnest(&body, &panels.panels, &pairs),
    })
}

fn seconds(body: &Discretized, pairs: usize) -> f64 {
    let n = body.triangles.len() as f64;
    let crowded = PER_NEAR_PAIR * (pairs as f64 - USUAL_NEAR * n).max(0.0);
    let alone = crowded
        + if body.vertices.len() < HIERARCHICAL {
            n * (PER_TRIANGLE + PER_PAIR * n)
        } else {
            CLUSTERS * libm::pow(n, CLUSTERS_POWER)
        };
    let edges = if body.inserted.is_empty() {
        1.0
    } else {
        WITH_EDGES
    };
    alone * edges * 2.0 / rayon::current_num_threads() as f64
}

/// Sum over the sharp edges for [`EDGES`].
fn at_edges(body: &Discretized) -> f64 {
    let area = body.frame.area;
    let thickness = 2.0 * body.frame.volume / area;
    let of_fold = |fold: &Fold| {
        let [s, t] = fold.triangles.map(|t| area_of(body, t));
        let (length, height) = (fold.length, (s + t) / fold.length);
        let power = 2.0 * std::f64::consts::PI / (std::f64::consts::PI + fold.turn);
        let plate = libm::cbrt((height / thickness).max(1.0));
        let sharper = libm::pow(SHARPER, 4.0 / 3.0 - power);
        sharper * length * libm::pow(height, power) / libm::pow(area, 0.5 + 0.5 * power) * plate
    };
    let folds = folds(
        &Edges::new(&body.triangles),
        &body.vertices,
        &body.triangles,
    );
    let sharp = folds.iter().filter(|fold| fold.is_sharp());
    sharp.map(of_fold).sum()
}

fn area_of(body: &Discretized, triangle: usize) -> f64 {
    let [a, b, c] = body.triangles[triangle].map(|v| body.vertices[v as usize]);
    0.5 * norm(cross(sub(b, a), sub(c, a)))
}

/// Roughly the largest entry of the translation block (in units).
fn broadside(body: &Discretized, panels: &[Panel]) -> f64 {
    let [low, high] = bounding_box(&body.vertices);
    let size = sub(high, low);
    let along = |k: usize| {
        let projected: f64 = panels
            .iter()
            .map(|p| 0.5 * p.area * p.normal[k].abs())
            .sum();
        let (u, v) = (size[(k + 1) % 3], size[(k + 2) % 3]);
        let slender = u.min(v) / u.max(v);
        BROADSIDE * projected * (projected * slender).sqrt()
    };
    (0..3).map(along).fold(0.0, f64::max)
}

fn thinnest(body: &Discretized, panels: &[Panel], pairs: &NearPairs) -> Option<Thinnest> {
    let of_panel = |a: usize| {
        facing(a, panels, pairs)
            .filter(|f| f.through_body)
            .map(|f| {
                let longest = panels[a].longest2.max(panels[f.panel].longest2).sqrt();
                (f.gap / longest, f.gap, a)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let walls = (0..panels.len()).into_par_iter().filter_map(of_panel);
    // Of equals the first, whatever the threads.
    let (ratio, gap, a) = walls.min_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)))?;
    Some(Thinnest {
        thickness: gap * body.frame.unit,
        ratio,
        position: body.frame.outside(panels[a].centroid),
    })
}

#[cfg(test)]
mod tests {
    use super::super::added_mass;
    use super::*;
    use crate::shapes::Shape;

    fn check(shape: &Shape, triangles: usize) {
        let mesh = shape.mesh(triangles).unwrap();
        // As from a file, which does not say that it is smooth.
        let mesh = TriMesh::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).unwrap();
        let foretold = expected(&mesh, &Options::default()).unwrap();
        let found = added_mass(&mesh, &Options::default(), &()).unwrap();
        assert_eq!(foretold.triangles_solved, found.quality.triangles_solved);
        assert_eq!(foretold.thickness_ratio, found.quality.thickness_ratio);
        let ratio = foretold.error_estimate / found.error_estimate;
        assert!(
            (0.4..2.5).contains(&ratio),
            "{shape:?} {triangles}: {ratio}"
        );
    }

    #[test]
    fn the_error_is_foretold_within_a_factor() {
        for size in [
            [1.0; 3],
            [1.0, 2.0, 0.5],
            [1.0, 1.0, 0.1],
            [0.2, 3.0, 0.2],
            [1.0, 1.5, 0.01],
        ] {
            check(&Shape::Box { size }, 300);
            check(&Shape::Box { size }, 3000);
        }
        for semi_axes in [[1.0; 3], [1.0, 2.0, 4.0], [1.0, 1.0, 0.2]] {
            check(&Shape::Ellipsoid { semi_axes }, 1280);
            check(&Shape::Ellipsoid { semi_axes }, 5120);
        }
    }

    /// Around Z through (r, z), poles at the ends.
    fn turned(profile: &[[f64; 2]], n: usize) -> TriMesh {
        let rings = profile.len() - 2;
        let mut vertices = vec![[0.0, 0.0, profile[0][1]], [0.0, 0.0, profile[rings + 1][1]]];
        for [r, z] in &profile[1..=rings] {
            vertices.extend((0..n).map(|i| {
                let angle = std::f64::consts::TAU * i as f64 / n as f64;
                [r * libm::cos(angle), r * libm::sin(angle), *z]
            }));
        }
        let at = |ring: usize, i: usize| (2 + ring * n + i % n) as u32;
        let mut triangles = Vec::new();
        for i in 0..n {
            triangles.push([0, at(0, i + 1), at(0, i)]);
            triangles.push([1, at(rings - 1, i), at(rings - 1, i + 1)]);
            for k in 1..rings {
                triangles.push([at(k - 1, i), at(k - 1, i + 1), at(k, i)]);
                triangles.push([at(k - 1, i + 1), at(k, i + 1), at(k, i)]);
            }
        }
        TriMesh::new(vertices, triangles).unwrap()
    }

    #[test]
    fn the_error_of_cones_and_fans_is_foretold_within_a_factor() {
        let cone = |height: f64| vec![[0.0, 0.0], [1.0, 0.0], [0.0, height]];
        let spindle = |height: f64| vec![[0.0, -height], [1.0, 0.0], [0.0, height]];
        let cylinder = |height: f64| vec![[0.0, 0.0], [1.0, 0.0], [1.0, height], [0.0, height]];
        let bodies = [0.2, 0.5, 1.0, 3.0, 10.0]
            .into_iter()
            .flat_map(|height| [cone(height), spindle(height), cylinder(height)])
            .map(|profile| (profile, 50))
            .chain([30, 200, 1000, 5000].map(|n| (cone(1.0), n)))
            .chain([(cylinder(1.0), 1000)]);
        for (profile, n) in bodies {
            let mesh = turned(&profile, n);
            let foretold = expected(&mesh, &Options::default()).unwrap();
            let found = added_mass(&mesh, &Options::default(), &()).unwrap();
            assert_eq!(foretold.triangles_solved, found.quality.triangles_solved);
            let ratio = foretold.error_estimate / found.error_estimate;
            assert!(
                (1.0 / 3.0..3.0).contains(&ratio),
                "{profile:?} {n}: {ratio}"
            );
        }
    }

    #[test]
    fn the_thinnest_wall_is_that_of_the_sheet() {
        let sheet = Shape::Box {
            size: [0.3, 0.2, 0.001],
        }
        .mesh(300)
        .unwrap();
        let foretold = expected(&sheet, &Options::default()).unwrap();
        let wall = foretold.thinnest.unwrap();
        assert!((wall.thickness / 0.001 - 1.0).abs() < 1e-9);
        assert!(wall.ratio < 0.1 && wall.position[2].abs() <= 0.0005 + 1e-12);
        let ball = Shape::Ellipsoid {
            semi_axes: [1.0; 3],
        }
        .mesh(1280)
        .unwrap();
        assert_eq!(expected(&ball, &Options::default()).unwrap().thinnest, None);
    }

    #[test]
    fn too_many_triangles_are_refused() {
        let few = Options {
            max_triangles: 100,
            ..Options::default()
        };
        let ball = Shape::Ellipsoid {
            semi_axes: [1.0; 3],
        }
        .mesh(320)
        .unwrap();
        assert!(matches!(
            expected(&ball, &few),
            Err(AddedMassError::TooLarge { .. })
        ));
    }
}
