//! Added mass in the formats of the programs that use it: one file for each.
//!
//! All begin from a [`Report`] and return text that can be pasted or parsed as it is, with a comment that
//! states axes, reference point, density, sign and order.

mod capytaine;
mod csv;
mod json;
mod mujoco;
mod sdf;
mod statement;
mod table;
#[cfg(test)]
mod tests;
mod uuv;

pub use capytaine::capytaine;
pub use csv::csv;
pub use json::{JsonError, json};
pub use mujoco::mujoco;
pub use sdf::sdf;
pub use table::table;
pub use uuv::uuv;

use langevin_rigid::shift_added_mass;
use serde::Serialize;

/// The added mass of one mesh; as JSON its keys are a contract with scripts.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// Name of the mesh, for comments.
    pub mesh: String,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Triangles of the refined mesh that was solved on.
    pub triangles_solved: usize,
    /// Volume of the body (m^3).
    pub volume: f64,
    /// Its centroid, in the coordinates of the mesh (m).
    pub centroid: [f64; 3],
    /// Density of the fluid (kg/m^3).
    pub fluid_density: f64,
    /// The point that `added_mass` refers to, in the coordinates of the mesh (m).
    pub reference: [f64; 3],
    /// The tensor in the axes of the mesh, linear part first (kg, kg m, kg m^2).
    pub added_mass: [[f64; 6]; 6],
    /// Estimated relative error of the tensor.
    pub error_estimate: f64,
    /// The simplified mesh, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proxy: Option<Proxy>,
    /// What makes the result doubtful.
    pub warnings: Vec<String>,
    /// How long it took (s).
    pub seconds: f64,
}

/// What stands for the mesh; its part of the error estimate is in that of the report too.
#[derive(Debug, Clone, Serialize)]
pub struct Proxy {
    /// Triangles of the simplified mesh.
    pub triangles: usize,
    /// Largest distance of a vertex of the mesh (m).
    pub deviation: f64,
    /// Relative error of the tensor that the simplification may cost.
    pub error_estimate: f64,
}

impl Report {
    /// The same report about another point of the mesh's coordinates (m).
    pub fn about(&self, point: [f64; 3]) -> Report {
        let offset = std::array::from_fn(|i| point[i] - self.reference[i]);
        Report {
            reference: point,
            added_mass: shift_added_mass(&self.added_mass, offset),
            ..self.clone()
        }
    }
}

/// Numbers of one row, far finer than their error.
fn row(numbers: &[f64], separator: &str) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| format!("{x:.9e}")).collect();
    texts.join(separator)
}
