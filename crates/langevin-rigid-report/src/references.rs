//! What the validation compares with, and where that is from. Lamb's ellipsoids are closed forms of the run time.
//!
//! Added mass is per density of the fluid, m^3 and m^5, about the middle of the body.

/// A cube with sides of 1 m, in translation and rotation, extrapolated from meshes graded towards the edges. The textbook
/// value, 0.67 to 0.68, is too high.
pub(crate) const CUBE: [f64; 2] = [0.638423, 0.03926];

/// Square plates with sides of 1 m: thickness (m), broadside, end over end; extrapolated as [`CUBE`] is.
pub(crate) const PLATES: [[f64; 3]; 2] =
    [[0.01, 0.46982, 0.020943], [1.0 / 800.0, 0.45772, 0.020254]];

/// Square prisms with sides of 1 m: length (m), motion along it over the volume; computed at high resolution.
pub(crate) const PRISMS: [[f64; 2]; 3] = [[2.0, 0.33442], [4.0, 0.17302], [10.0, 0.07103]];
