//! The added mass of a mesh in water, with an estimate of its error.
//!
//! `cargo run --example added_mass_of_a_mesh -- hull.stl mm` reads a file; the unit may be left out where the file states
//! one, as glTF and Collada do. Without arguments it takes an ellipsoid, whose added mass is known in closed form.

use std::error::Error;

use langevin_rigid::{Body, Fluid};
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{Options, added_mass};
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_formats::mesh::{LengthUnit, read_mesh};

/// Semi-axes of the ellipsoid (m).
const SEMI_AXES: [f64; 3] = [0.3, 0.1, 0.2];

fn print(tensor: &[[f64; 6]; 6]) {
    for row in tensor {
        let row: Vec<String> = row.iter().map(|entry| format!("{entry:12.4e}")).collect();
        println!("{}", row.join(" "));
    }
}

fn in_water(tensor: [[f64; 6]; 6]) -> [[f64; 6]; 6] {
    tensor.map(|row| row.map(|entry| Fluid::WATER.density * entry))
}

fn print_added_mass(mesh: &TriMesh) -> Result<(), Box<dyn Error>> {
    let result = added_mass(mesh, &Options::default(), &())?;
    println!(
        "{} triangles, {:.6} m^3 displaced",
        mesh.triangles().len(),
        mesh.volume()
    );
    println!("added mass about the centroid in kg, kg m and kg m^2, linear part first:");
    print(&in_water(result.tensor));
    println!("error estimate: {:.3} %", 100.0 * result.error_estimate);
    for warning in &result.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    if let Some(path) = arguments.next() {
        let unit = arguments.next().map(|unit| unit.parse::<LengthUnit>());
        return print_added_mass(&read_mesh(path.as_ref(), unit.transpose()?)?.body()?);
    }
    let semi_axes = SEMI_AXES;
    print_added_mass(&Shape::Ellipsoid { semi_axes }.mesh(1280)?)?;
    println!("in closed form:");
    // The body's own density has no part in it.
    print(&in_water(Body::ellipsoid(semi_axes, 1000.0)?.added_mass));
    Ok(())
}
