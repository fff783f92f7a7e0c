//! Resistance of an ellipsoid in creeping flow (Oberbeck 1876, Edwardes 1892, Jeffery 1922).

use std::f64::consts::PI;

use crate::carlson::{rd, rf};

/// Stokes resistance to translation along the axes of an ellipsoid, per dynamic viscosity (m).
///
/// A velocity v along axis i is resisted by the force mu K_i v. `semi_axes` in metres, positive.
///
/// ```
/// use langevin_rigid::stokes_translation;
///
/// let [k, _, _] = stokes_translation([0.5; 3]);
/// assert!((k - 3.0 * std::f64::consts::PI).abs() < 1e-12); // 6 pi a
/// ```
pub fn stokes_translation(semi_axes: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = semi_axes.map(|a| a * a);
    let shape = rf(x, y, z);
    let along = |axis: f64, weight: f64| 8.0 * PI / (shape + axis * weight / 3.0);
    let [i, j, k] = weights(semi_axes);
    [along(x, i), along(y, j), along(z, k)]
}

/// Stokes resistance to rotation about the axes of an ellipsoid, per dynamic viscosity (m^3).
///
/// An angular velocity omega about axis i is resisted by the torque mu K_i omega. `semi_axes` in
/// metres, positive.
///
/// ```
/// use langevin_rigid::stokes_rotation;
///
/// let [k, _, _] = stokes_rotation([0.5; 3]);
/// assert!((k - std::f64::consts::PI).abs() < 1e-12); // 8 pi a^3
/// ```
pub fn stokes_rotation(semi_axes: [f64; 3]) -> [f64; 3] {
    let squares = semi_axes.map(|a| a * a);
    let weights = weights(semi_axes);
    let about = |j: usize, k: usize| {
        let (b2, c2) = (squares[j], squares[k]);
        8.0 * PI * (b2 + c2) / (b2 * weights[j] + c2 * weights[k])
    };
    [about(1, 2), about(2, 0), about(0, 1)]
}

/// R_D of the squared semi-axes with each in the distinguished place.
fn weights(semi_axes: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = semi_axes.map(|a| a * a);
    [rd(y, z, x), rd(z, x, y), rd(x, y, z)]
}
