//! The six flows around a discretized body, and their energies.

use super::AddedMassError;
use super::discretize::Discretized;
use super::hierarchical::{Hierarchical, Subspace, combined};
use super::layer;
use super::matrix::{BLOCK, Matrix};
use super::near::{self, NearPairs, Thickness};
use super::operator::Six;
use super::operator::{Operator, SparseRow};
use super::panels::{Panels, Vec3};
use super::precondition::Preconditioner;
use super::report::Cancel;
use super::solver::{Solution, solve};
use super::sums::{RowSums, single_layer_energy};
use super::{assembly, load};
use crate::progress::Progress;

/// The six flows in the units of the frame.
pub(super) struct Flow {
    /// Tensor with the layer as it is, and extrapolated from it.
    pub(super) layered: [Six; 6],
    pub(super) tensor: [Six; 6],
    pub(super) panels: Panels,
    pub(super) solution: Solution,
    pub(super) thickness: Thickness,
    /// sum n·n' / (4 pi r): the volume, if the integrals were exact.
    pub(super) volume: f64,
}

impl Flow {
    pub(super) fn solve(
        body: &Discretized,
        progress: &dyn Progress,
    ) -> Result<Flow, AddedMassError> {
        let hierarchical = body.vertices.len() >= HIERARCHICAL;
        Self::solve_as(hierarchical, body, progress)
    }

    fn solve_as(
        hierarchical: bool,
        body: &Discretized,
        progress: &dyn Progress,
    ) -> Result<Flow, AddedMassError> {
        let panels = Panels::new(&body.vertices, &body.triangles);
        let cancel = Cancel::new(progress, "near pairs", 1);
        let mut pairs = NearPairs::find(&panels.panels, &cancel)?;
        let thickness = near::thickness(&panels.panels, &pairs);
        let mut sums = near::integrate(&panels, &mut pairs, thickness.sheet, &cancel)?;
        let w = Form::new(hierarchical, &panels, &pairs, &mut sums, progress)?;
        let loads = load::loads(&panels, &sums, w.operator());
        let single_layer = single_layer_energy(&panels.panels, &sums);
        let components = panels.components();
        let needle = body.is_needle().then(|| nested_members(body, &panels));
        let zero = vec![[0.0; 6]; loads.len()];
        let system = System {
            w: w.operator(),
            loads: &loads,
            vertices: &panels.vertices,
            components: &components,
            thickness,
            needle: needle.as_deref(),
        };
        let solution = system.solve(zero, &Cancel::new(progress, "potentials", 1))?;
        let layered = plus(&single_layer, &solution.energy(&loads));
        let mut tensor = layered;
        if !body.inserted.is_empty() {
            let cancel = Cancel::new(progress, "edges", 1);
            let energy = nested_energy(&w, &system, body, &panels, &solution.x, &cancel)?;
            let q = layer::shrinkage(&panels, &pairs);
            tensor = extrapolated(&layered, &plus(&single_layer, &energy), q);
        }
        if !tensor.iter().flatten().all(|entry| entry.is_finite()) {
            return Err(AddedMassError::Singular {
                iteration: solution.iterations,
                energy: f64::NAN,
            });
        }
        let volume = (0..3).map(|k| single_layer[k][k]).sum();
        Ok(Flow {
            layered,
            tensor,
            panels,
            solution,
            thickness,
            volume,
        })
    }
}

/// Vertices from which W is kept as clusters of panels and not as a matrix.
pub(super) const HIERARCHICAL: usize = 8000;

/// W, as its size asks for.
enum Form<'a> {
    Dense(Matrix),
    Hierarchical(Box<Hierarchical<'a>>),
}

impl<'a> Form<'a> {
    /// Also adds the far pairs to the sums, which hold the near ones.
    fn new(
        hierarchical: bool,
        panels: &'a Panels,
        pairs: &'a NearPairs,
        sums: &mut [RowSums],
        progress: &'a dyn Progress,
    ) -> Result<Form<'a>, AddedMassError> {
        if !hierarchical {
            let vertices = panels.vertices.len();
            let cancel = Cancel::new(progress, "matrix", vertices.div_ceil(BLOCK));
            return Ok(Form::Dense(assembly::assemble(
                panels, pairs, sums, &cancel,
            )?));
        }
        let w = Hierarchical::new(panels, pairs, sums, progress)?;
        Ok(Form::Hierarchical(Box::new(w)))
    }

    fn operator(&self) -> &dyn Operator {
        match self {
            Form::Dense(matrix) => matrix,
            Form::Hierarchical(w) => w.as_ref(),
        }
    }

    /// T^t W T, column j of T given by its nonzero entries `members[j]`.
    fn restricted<'b>(&'b self, members: &'b [SparseRow]) -> Box<dyn Operator + 'b> {
        match self {
            Form::Dense(matrix) => Box::new(matrix.restricted(members)),
            Form::Hierarchical(whole) => Box::new(Subspace { whole, members }),
        }
    }
}

/// W phi = -f.
struct System<'a> {
    w: &'a dyn Operator,
    loads: &'a [Six],
    vertices: &'a [Vec3],
    /// The component of each.
    components: &'a [u32],
    thickness: Thickness,
    /// Of a needle the functions without the edge layer.
    needle: Option<&'a [SparseRow]>,
}

impl System<'_> {
    fn solve(&self, start: Vec<Six>, cancel: &Cancel) -> Result<Solution, AddedMassError> {
        let preconditioner = Preconditioner::new(
            self.w,
            self.vertices,
            self.components,
            self.thickness.sheet,
            self.needle,
            cancel,
        )?;
        solve(self.w, self.loads, start, &preconditioner, cancel)
    }
}

/// f^t W^-1 f in the space without the edge layer, a subspace: it takes no new integrals.
fn nested_energy(
    w: &Form,
    layered: &System,
    body: &Discretized,
    panels: &Panels,
    x: &[Six],
    cancel: &Cancel,
) -> Result<[Six; 6], AddedMassError> {
    let members = nested_members(body, panels);
    let kept: Vec<usize> = members.iter().map(|m| m[0].0 as usize).collect();
    let loads: Vec<Six> = members.iter().map(|m| combined(m, layered.loads)).collect();
    let vertices: Vec<Vec3> = kept.iter().map(|&v| layered.vertices[v]).collect();
    let components: Vec<u32> = kept.iter().map(|&v| layered.components[v]).collect();
    let w = w.restricted(&members);
    let system = System {
        w: w.as_ref(),
        loads: &loads,
        vertices: &vertices,
        components: &components,
        needle: None,
        ..*layered
    };
    let solution = system.solve(kept.iter().map(|&v| x[v]).collect(), cancel)?;
    Ok(solution.energy(&loads))
}

/// For each vertex that was there before the layer, in the order of the panels: itself, then the
/// vertices of the layer that interpolate from it, with weights.
fn nested_members(body: &Discretized, panels: &Panels) -> Vec<Vec<(u32, f64)>> {
    let unlayered = body.unlayered();
    let mut place = vec![u32::MAX; unlayered];
    let mut members: Vec<Vec<(u32, f64)>> = Vec::with_capacity(unlayered);
    for (v, &origin) in panels.vertex_origin.iter().enumerate() {
        if let Some(slot) = place.get_mut(origin as usize) {
            *slot = members.len() as u32;
            members.push(vec![(v as u32, 1.0)]);
        }
    }
    for (v, &origin) in panels.vertex_origin.iter().enumerate() {
        if let Some(cut) = (origin as usize).checked_sub(unlayered) {
            let cut = body.inserted[cut];
            let weights = [1.0 - cut.fraction, cut.fraction];
            for (end, weight) in cut.ends.into_iter().zip(weights) {
                members[place[end as usize] as usize].push((v as u32, weight));
            }
        }
    }
    members
}

/// The limit of the sequence whose defect shrinks by `q` from `before` to `after`.
fn extrapolated(after: &[Six; 6], before: &[Six; 6], q: f64) -> [Six; 6] {
    let limit = |a: f64, b: f64| a + (a - b) * q / (1.0 - q);
    std::array::from_fn(|i| std::array::from_fn(|j| limit(after[i][j], before[i][j])))
}

fn plus(a: &[Six; 6], b: &[Six; 6]) -> [Six; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::added_mass::Options;
    use crate::shapes::Shape;

    fn tensor(hierarchical: bool, shape: &Shape, triangles: usize) -> [Six; 6] {
        let mesh = shape.mesh(triangles).unwrap();
        let body = Discretized::new(&mesh, &Options::default(), &()).unwrap();
        let flow = Flow::solve_as(hierarchical, &body, &()).unwrap();
        flow.tensor
    }

    #[test]
    fn clusters_give_the_tensor_of_the_matrix() {
        let smooth = Shape::Ellipsoid {
            semi_axes: [0.01, 0.02, 0.04],
        };
        let edged = Shape::Box { size: [0.1; 3] };
        let thin = Shape::Box {
            size: [0.1, 0.1, 1e-3],
        };
        for (shape, triangles) in [(smooth, 5120), (edged, 3000), (thin, 3000)] {
            let dense = tensor(false, &shape, triangles);
            let clusters = tensor(true, &shape, triangles);
            for block in [0, 3] {
                let largest = (block..block + 3).map(|i| dense[i][i]).fold(0.0, f64::max);
                for i in block..block + 3 {
                    for j in block..block + 3 {
                        let error = (clusters[i][j] - dense[i][j]).abs() / largest;
                        assert!(error < 1e-5, "{shape:?}, {i} {j}: {error:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn threads_do_not_change_a_bit() {
        let shape = Shape::Box { size: [0.1; 3] };
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let run = || tensor(true, &shape, 2000);
            pool.build().unwrap().install(run)
        };
        assert_eq!(on(1), on(3));
    }
}
