//! From the units of the frame to metres, and what to say about the result.

use super::discretize::Discretized;
use super::flow::Flow;
use super::operator::Six;
use super::panels::{Panel, Panels, Vec3};
use super::report::{MeshQuality, Warning};
use super::solver::TOLERANCE;
use super::{AddedMass, Surface};
use crate::mesh::TriMesh;

/// Share of length × size² × |n - n'|² that the tensor misses at the facets of a curved surface, measured
/// on ellipsoids and tori against finer divisions of the same polyhedra.
pub(super) const FACETING: f64 = 0.003;
const LARGE_ESTIMATE: f64 = 0.01;
const LARGE_QUADRATURE_ERROR: f64 = 0.02;
const LARGE_ASPECT: f64 = 1000.0;
/// [`MeshQuality::thickness_ratio`] below which [`Warning::ThinnerThanTriangles`] is given.
pub const SMALL_THICKNESS: f64 = 0.02;

impl Flow {
    /// The result in the caller's units.
    pub(super) fn outcome(&self, mesh: &TriMesh, body: &Discretized) -> AddedMass {
        let quality = self.quality(mesh, body);
        let error_estimate = self.error_estimate(body, &quality);
        AddedMass {
            tensor: in_metres(&self.tensor, body.frame.unit),
            reference: body.frame.origin,
            surface: self.surface(mesh, body),
            error_estimate,
            quality,
            warnings: warnings(&quality, error_estimate, body),
        }
    }

    fn quality(&self, mesh: &TriMesh, body: &Discretized) -> MeshQuality {
        let volume = body.frame.volume;
        MeshQuality {
            triangles_given: mesh.triangles().len(),
            triangles_solved: body.triangles.len(),
            worst_aspect: self
                .panels
                .panels
                .iter()
                .map(Panel::aspect)
                .fold(0.0, f64::max),
            longest_edge: body.longest() * body.frame.unit,
            thickness_ratio: self.thickness.ratio,
            quadrature_error: (self.volume - volume).abs() / volume,
            edge_correction: self.relative(body, &difference(&self.tensor, &self.layered)),
            residual: self.solution.relative,
            iterations: self.solution.iterations,
        }
    }

    fn error_estimate(&self, body: &Discretized, quality: &MeshQuality) -> f64 {
        // What the integrals miss of the volume they miss of the tensor, in the same units.
        let missed = quality.quadrature_error * body.frame.volume / largest(&self.tensor, 0);
        let facets = FACETING * body.faceting() / largest(&self.tensor, 0);
        quality.edge_correction + missed + facets + quality.residual * quality.residual
    }

    /// Size of a change of the tensor, block by block against what matters in it.
    fn relative(&self, body: &Discretized, change: &[Six; 6]) -> f64 {
        let translation = largest(change, 0) / largest(&self.tensor, 0);
        let rotation = largest(change, 3) / largest(&self.tensor, 3).max(body.frame.inertia);
        translation.max(rotation)
    }

    fn surface(&self, mesh: &TriMesh, body: &Discretized) -> Surface {
        let (given, unit) = (mesh.vertices(), body.frame.unit);
        let solved = potentials(&self.panels, &self.solution.x, unit);
        let numbers = body.numbers(given.len());
        let added = numbers.iter().zip(&body.vertices).zip(&solved);
        let added = added.filter(|((number, _), _)| **number as usize >= given.len());
        let (places, values): (Vec<Vec3>, Vec<Six>) = added
            .map(|((_, &place), value)| (body.frame.outside(place), *value))
            .unzip();
        let triangles = body.triangles.iter();
        Surface {
            vertices: given.iter().copied().chain(places).collect(),
            triangles: triangles.map(|t| t.map(|v| numbers[v as usize])).collect(),
            potentials: [body.at_given(given.len(), &solved), values].concat(),
        }
    }
}

/// phi = -x with zero mean over each component of the surface, in the caller's order of vertices.
fn potentials(panels: &Panels, x: &[Six], unit: f64) -> Vec<Six> {
    let components = panels.components();
    let count = components.iter().max().map_or(0, |&c| c as usize + 1);
    let mut mean = vec![[0.0; 6]; count];
    let mut area = vec![0.0; count];
    for panel in &panels.panels {
        let component = components[panel.corners[0] as usize] as usize;
        area[component] += panel.area;
        for v in panel.corners {
            for c in 0..6 {
                mean[component][c] += panel.area / 3.0 * x[v as usize][c];
            }
        }
    }
    let mut potentials = vec![[0.0; 6]; x.len()];
    for ((x, &origin), &component) in x.iter().zip(&panels.vertex_origin).zip(&components) {
        let (mean, area) = (mean[component as usize], area[component as usize]);
        let scale = |c: usize| if c < 3 { unit } else { unit * unit };
        potentials[origin as usize] = std::array::from_fn(|c| scale(c) * (mean[c] / area - x[c]));
    }
    potentials
}

fn in_metres(tensor: &[Six; 6], unit: f64) -> [Six; 6] {
    let length = |k: usize| if k < 3 { 1.0 } else { unit };
    let cube = unit * unit * unit;
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            0.5 * (tensor[i][j] + tensor[j][i]) * (cube * (length(i) * length(j)))
        })
    })
}

fn difference(a: &[Six; 6], b: &[Six; 6]) -> [Six; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] - b[i][j]))
}

/// Largest entry of the diagonal block that starts at `first`.
fn largest(m: &[Six; 6], first: usize) -> f64 {
    let block = m[first..first + 3]
        .iter()
        .flat_map(|row| &row[first..first + 3]);
    block.fold(0.0, |l, v| l.max(v.abs()))
}

fn warnings(quality: &MeshQuality, estimate: f64, body: &Discretized) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let mut warn = |doubtful: bool, warning: Warning| {
        if doubtful {
            warnings.push(warning);
        }
    };
    warn(
        estimate > LARGE_ESTIMATE,
        Warning::InaccurateTensor {
            estimate,
            threshold: LARGE_ESTIMATE,
        },
    );
    let error = quality.quadrature_error;
    warn(
        error > LARGE_QUADRATURE_ERROR,
        Warning::InaccurateQuadrature {
            error,
            threshold: LARGE_QUADRATURE_ERROR,
        },
    );
    let aspect = quality.worst_aspect;
    warn(
        aspect > LARGE_ASPECT,
        Warning::Slivers {
            aspect,
            threshold: LARGE_ASPECT,
        },
    );
    let ratio = quality.thickness_ratio;
    warn(
        ratio < SMALL_THICKNESS,
        Warning::ThinnerThanTriangles {
            ratio,
            threshold: SMALL_THICKNESS,
        },
    );
    if let Some(wanted) = body.stopped {
        let (longest, wanted) = (quality.longest_edge, wanted * body.frame.unit);
        warn(true, Warning::RefinementStopped { longest, wanted });
    }
    let residual = quality.residual;
    warn(
        residual > 2.0 * TOLERANCE,
        Warning::NotConverged {
            residual,
            threshold: TOLERANCE,
        },
    );
    warnings
}
