//! The Python package `langevin_rigid`: what of it is computed. What is public, the package itself says.
//!
//! The documentation of what is here is that of Python's `help`.

#![expect(
    clippy::needless_pass_by_value,
    reason = "arguments come from Python by value"
)]

use pyo3::prelude::*;

mod added_mass;
mod arrays;
mod batch;
mod body;
mod check;
mod crowd;
mod direct;
mod ensemble;
mod errors;
mod files;
mod fluid;
mod interrupt;
mod loads;
mod mesh;
mod regimes;
mod repair;
mod reproduce;
mod run;
mod scene;
mod shapes;
mod state;
mod stepper;
mod sweep;
mod table;
mod threads;
mod turbulence;
mod warnings;
mod wind;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", langevin_rigid::VERSION)?;
    module.add_class::<mesh::Mesh>()?;
    module.add_class::<check::Check>()?;
    module.add_class::<repair::Repaired>()?;
    module.add_class::<added_mass::AddedMass>()?;
    module.add_class::<body::Body>()?;
    module.add_class::<fluid::Fluid>()?;
    module.add_class::<wind::Wind>()?;
    module.add_class::<wind::Flow>()?;
    module.add_class::<state::State>()?;
    module.add_class::<state::States>()?;
    module.add_class::<stepper::Stepper>()?;
    module.add_class::<loads::Loads>()?;
    module.add_class::<loads::Wrench>()?;
    module.add_class::<batch::Batch>()?;
    module.add_class::<turbulence::TurbulenceHistory>()?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<run::Run>()?;
    module.add_class::<ensemble::Ensemble>()?;
    module.add_class::<crowd::Crowd>()?;
    module.add_class::<table::Table>()?;
    module.add_class::<regimes::Regimes>()?;
    module.add_class::<direct::Directed>()?;
    module.add_function(wrap_pyfunction!(regimes::regimes, module)?)?;
    module.add_function(wrap_pyfunction!(direct::direct, module)?)?;
    module.add_function(wrap_pyfunction!(crowd::crowd, module)?)?;
    module.add_function(wrap_pyfunction!(run::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(reproduce::reproduce, module)?)?;
    module.add_function(wrap_pyfunction!(ensemble::ensemble, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::_sweep_part, module)?)?;
    module.add_function(wrap_pyfunction!(scene::_scene_of_parts, module)?)?;
    module.add_function(wrap_pyfunction!(check::check, module)?)?;
    module.add_function(wrap_pyfunction!(repair::repair, module)?)?;
    module.add_function(wrap_pyfunction!(added_mass::added_mass, module)?)?;
    module.add_function(wrap_pyfunction!(turbulence::turbulence, module)?)?;
    // What unpickles.
    module.add_function(wrap_pyfunction!(mesh::_mesh_of_shape, module)?)?;
    module.add_function(wrap_pyfunction!(mesh::_mesh_of_parts, module)?)?;
    module.add_function(wrap_pyfunction!(added_mass::_added_mass_of_parts, module)?)?;
    module.add_function(wrap_pyfunction!(fluid::_fluid_of_parts, module)?)?;
    module.add_function(wrap_pyfunction!(state::_state_of_parts, module)?)?;
    module.add_function(wrap_pyfunction!(turbulence::_history_of_parts, module)?)
}
