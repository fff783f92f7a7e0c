//! Bodies of simple form, without a mesh and without precomputation.
//!
//! Every field is filled as the bake fills it for a fine mesh of the same shape, from closed forms
//! (masses, sizes, everything of an ellipsoid) or from fits to values of the boundary-element bake
//! (added mass and drag of cylinders and boxes). Each constructor states how far the two were found
//! apart.
//!
//! A density of zero is a body without mass: what moves is the fluid around it.

mod cuboid;
mod cylinder;
mod ellipsoid;
mod slices;
mod surface;

use crate::body::{Body, BodyError, Separation, Slice, Surface, nonnegative};
use crate::linalg::Vec3;
use crate::stokes::{stokes_rotation, stokes_translation};

impl Body {
    /// A homogeneous sphere of this radius (m) and density (kg/m^3), centred at the origin of its frame.
    ///
    /// Added mass, half the displaced fluid, and Stokes resistance are exact (Lamb 1932, articles 92 and 337).
    /// The drag is that of [`Body::ellipsoid`].
    ///
    /// ```
    /// use langevin_rigid::Body;
    ///
    /// let ball = Body::sphere(0.05, 600.0)?;
    /// assert!((ball.added_mass[0][0] / ball.volume - 0.5).abs() < 1e-12);
    /// # Ok::<(), langevin_rigid::BodyError>(())
    /// ```
    ///
    /// # Errors
    /// [`BodyError::NotPositive`] or [`BodyError::Negative`] names the number that is out of range.
    pub fn sphere(radius: f64, density: f64) -> Result<Body, BodyError> {
        positive([("radius", radius)])?;
        ellipsoid::form([radius; 3]).body(density)
    }

    /// A homogeneous ellipsoid with these semi-axes (m) along x, y, z of its frame and this density
    /// (kg/m^3), centred at the origin.
    ///
    /// Added mass (Lamb 1932, articles 114 and 115), Stokes resistance (Oberbeck 1876, Jeffery 1922)
    /// and the loads of the slices of a long ellipsoid are exact; the drag is the integral of the
    /// surface pressure that [`Wake`](crate::Wake) gives.
    ///
    /// Against the bake of 1280 triangles, over ratios of the axes of 1 to 150: added mass within 0.2 %, drag
    /// areas 0.2 % of the largest, sizes and Stokes resistance 1 %, the slices 3 %: the errors of that mesh.
    ///
    /// # Errors
    /// [`BodyError::NotPositive`] or [`BodyError::Negative`] names the number that is out of range.
    pub fn ellipsoid(semi_axes: Vec3, density: f64) -> Result<Body, BodyError> {
        positive([
            ("semi-axis along x", semi_axes[0]),
            ("semi-axis along y", semi_axes[1]),
            ("semi-axis along z", semi_axes[2]),
        ])?;
        ellipsoid::form(semi_axes).body(density)
    }

    /// A homogeneous disc of this radius and thickness (m) and density (kg/m^3): a flat cylinder, its axis
    /// along y of its frame, centred at the origin.
    ///
    /// Sources and errors are those of [`Body::cylinder`], which it is but for the axis. In the limit of
    /// no thickness the added mass is Lamb's (1932, articles 102 and 108), 8/3 r^3 broadside.
    ///
    /// # Errors
    /// [`BodyError::NotPositive`] or [`BodyError::Negative`] names the number that is out of range.
    pub fn disc(radius: f64, thickness: f64, density: f64) -> Result<Body, BodyError> {
        positive([("radius", radius), ("thickness", thickness)])?;
        cylinder::form(radius, thickness, 1).body(density)
    }

    /// A homogeneous flat plate of this length along x, width along z and thickness along y of its frame (m)
    /// and this density (kg/m^3), centred at the origin: `Body::cuboid([length, thickness, width], density)`.
    ///
    /// # Errors
    /// [`BodyError::NotPositive`] or [`BodyError::Negative`] names the number that is out of range.
    pub fn plate(length: f64, width: f64, thickness: f64, density: f64) -> Result<Body, BodyError> {
        positive([
            ("length", length),
            ("width", width),
            ("thickness", thickness),
        ])?;
        cuboid::form([length, thickness, width]).body(density)
    }

    /// A homogeneous circular cylinder of this radius and length (m) and density (kg/m^3), its axis
    /// along x of its frame, centred at the origin.
    ///
    /// Added mass and drag are fits to the boundary-element bake with the limits of the thin disc (Lamb
    /// 1932) and the long cylinder; the Stokes resistance is that of the ellipsoid of the same extents, as
    /// in the bake.
    ///
    /// Against the bake, over lengths of 0.01 to 40 radii: added mass within 1.5 %, drag areas 2 % of the
    /// largest, the slices of a long cylinder 4 %, but for their rotation, 20 %.
    /// A drag area on the rim of a disc thinner than 0.05 radii is a guess, and so small beside the
    /// face's that it is within these 2 %.
    ///
    /// # Errors
    /// [`BodyError::NotPositive`] or [`BodyError::Negative`] names the number that is out of range.
    pub fn cylinder(radius: f64, length: f64, density: f64) -> Result<Body, BodyError> {
        positive([("radius", radius), ("length", length)])?;
        cylinder::form(radius, length, 0).body(density)
    }

    /// A homogeneous box with these edges (m) along x, y, z of its frame and this density (kg/m^3),
    /// centred at the origin.
    ///
    /// Added mass and drag are fits to the boundary-element bake with the limit of the thin strip (Lamb
    /// 1932, article 71); the Stokes resistance is that of the ellipsoid of the same extents, as in the bake.
    ///
    /// Against the bake, for lengths up to 25 times the width and the width up to 100 times the thickness:
    /// translational added mass within 3 % and rotational within 5 % (entries below a tenth of the largest, as
    /// of a plate that moves edgeways: of a tenth of it), drag areas 7 % of the largest, those of the slices of a
    /// long box 8 %, their added mass 4 %, but for their rotation, 32 %.
    ///
    /// As in the bake, a box with square sides has the mean drag and half-extents over the directions
    /// of their plane, which no longer tell its corners from its faces.
    ///
    /// # Errors
    /// [`BodyError::NotPositive`] or [`BodyError::Negative`] names the number that is out of range.
    pub fn cuboid(size: Vec3, density: f64) -> Result<Body, BodyError> {
        positive([
            ("size along x", size[0]),
            ("size along y", size[1]),
            ("size along z", size[2]),
        ])?;
        cuboid::form(size).body(density)
    }
}

fn positive<const N: usize>(numbers: [(&'static str, f64); N]) -> Result<(), BodyError> {
    match numbers
        .into_iter()
        .find(|(_, x)| !(*x > 0.0 && x.is_finite()))
    {
        Some((name, value)) => Err(BodyError::NotPositive { name, value }),
        None => Ok(()),
    }
}

/// A form with three planes of symmetry: everything of a body but its density, along the axes.
struct Form {
    /// Volume (m^3).
    volume: f64,
    /// Means of x^2, y^2, z^2 over the volume (m^2).
    mean_squares: Vec3,
    /// Added mass per fluid density, three translations and three rotations (m^3, m^5).
    added_mass: [f64; 6],
    /// Half-extents as [`mean_half_extents`] gives them (m).
    half_extents: Vec3,
    /// Thickness b of Eq. (1) (m).
    thickness: f64,
    /// Drag areas (m^2).
    drag_areas: Vec3,
    slices: Vec<Slice>,
    surface: Surface,
}

impl Form {
    fn body(self, density: f64) -> Result<Body, BodyError> {
        nonnegative("density", density)?;
        let mass = density * self.volume;
        let [x, y, z] = self.mean_squares;
        let mut half_extents = self.half_extents;
        half_extents.sort_by(|a, b| b.total_cmp(a));
        let body = Body {
            mass,
            inertia: diagonal([y + z, z + x, x + y].map(|s| mass * s)),
            volume: self.volume,
            centre_of_buoyancy: [0.0; 3],
            added_mass: diagonal(self.added_mass),
            half_extents,
            thickness: self.thickness.min(2.0 * half_extents[2]),
            length: 2.0 * half_extents[0],
            separation: Separation {
                drag_area: diagonal(self.drag_areas),
                extents: diagonal(self.half_extents.map(|h| h * h)),
                stokes_translation: diagonal(stokes_translation(self.half_extents)),
                stokes_rotation: diagonal(stokes_rotation(self.half_extents)),
            },
            slices: self.slices,
            surface: self.surface,
        };
        body.check()?;
        Ok(body)
    }
}

fn diagonal<const N: usize>(values: [f64; N]) -> [[f64; N]; N] {
    let mut m = [[0.0; N]; N];
    for i in 0..N {
        m[i][i] = values[i];
    }
    m
}

/// Eigenvalues closer than this, relative to the larger of the two, have no axes of their own: the
/// threshold of the bake.
const DEGENERATE: f64 = 1e-3;

/// Values along the axes; where `moments` of two or three axes agree those are arbitrary, and the
/// value is the mean over the directions of their plane, or of space.
fn mean_where_degenerate(
    moments: Vec3,
    values: Vec3,
    plane: impl Fn(usize, usize) -> f64,
    space: f64,
) -> Vec3 {
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| moments[i].total_cmp(&moments[j]));
    let [i, j, k] = order;
    let same = |i: usize, j: usize| moments[j] - moments[i] <= DEGENERATE * moments[j];
    let mut means = values;
    match [same(i, j), same(j, k)] {
        [true, true] => means = [space; 3],
        [true, false] => (means[i], means[j]) = (plane(i, j), plane(i, j)),
        [false, true] => (means[j], means[k]) = (plane(j, k), plane(j, k)),
        [false, false] => {}
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_numbers_are_named() {
        let named = |body: Result<Body, BodyError>, wanted: &str| {
            let Err(BodyError::NotPositive { name, .. } | BodyError::Negative { name, .. }) = body
            else {
                panic!("{body:?} for {wanted}");
            };
            assert_eq!(name, wanted);
        };
        named(Body::sphere(0.0, 1.0), "radius");
        named(Body::sphere(1.0, f64::NAN), "density");
        named(Body::ellipsoid([1.0, -1.0, 1.0], 1.0), "semi-axis along y");
        named(Body::disc(1.0, f64::INFINITY, 1.0), "thickness");
        named(Body::plate(1.0, -2.0, 0.1, 1.0), "width");
        named(Body::cylinder(1.0, 0.0, 1.0), "length");
        named(Body::cuboid([1.0, 1.0, -0.0], 1.0), "size along z");
        named(Body::sphere(1e200, 1.0), "mass");
    }

    #[test]
    fn extreme_proportions_are_bodies() {
        for exponent in -6..=6 {
            let x = 10f64.powi(exponent);
            for body in [
                Body::ellipsoid([0.1, 0.1 * x, 0.2], 500.0),
                Body::ellipsoid([0.1, 0.1 * x, 0.1], 500.0),
                Body::disc(0.1, 0.1 * x, 500.0),
                Body::cuboid([0.1, 0.1 * x, 0.2], 500.0),
                Body::cuboid([0.1, 0.1 * x, 0.1], 500.0),
            ] {
                assert!(body.is_ok(), "{body:?} for {x}");
            }
        }
    }

    #[test]
    fn limits_of_added_mass() {
        let thin = Body::disc(1.0, 1e-9, 1.0).unwrap().added_mass;
        assert!((thin[1][1] / (8.0 / 3.0) - 1.0).abs() < 1e-4);
        assert!((thin[3][3] / (16.0 / 45.0) - 1.0).abs() < 1e-4);
        let long = Body::cylinder(1.0, 1e4, 1.0).unwrap();
        assert!((long.added_mass[1][1] / long.volume - 1.0).abs() < 1e-3);
        let strip = Body::plate(1e4, 1.0, 1e-9, 1.0).unwrap().added_mass;
        let pi = std::f64::consts::PI;
        assert!((strip[1][1] / (pi / 4.0 * 1e4) - 1.0).abs() < 1e-3);
        assert!((strip[3][3] / (pi / 128.0 * 1e4) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_form_is_the_same_along_every_axis() {
        let long = Body::cuboid([0.5, 0.1, 0.02], 500.0).unwrap();
        let turned = Body::cuboid([0.02, 0.5, 0.1], 500.0).unwrap();
        for i in 0..3 {
            let j = (i + 1) % 3;
            assert_eq!(long.added_mass[i][i], turned.added_mass[j][j]);
            assert_eq!(
                long.added_mass[3 + i][3 + i],
                turned.added_mass[3 + j][3 + j]
            );
            for (p, q) in long.slices.iter().zip(&turned.slices) {
                assert_eq!(p.translation[i][i], q.translation[j][j]);
                assert!((p.rotation[i][i] / q.rotation[j][j] - 1.0).abs() < 1e-12);
                assert_eq!(p.extents[i][i], q.extents[j][j]);
            }
        }
        let [disc, rod] = [Body::disc(0.1, 0.7, 500.0), Body::cylinder(0.1, 0.7, 500.0)];
        assert_eq!(disc.unwrap().slices.len(), rod.unwrap().slices.len());
    }

    #[test]
    fn slices_of_an_ellipsoid_add_up_to_it() {
        let body = Body::ellipsoid([0.02, 0.3, 0.05], 500.0).unwrap();
        assert_eq!(body.slices.len(), 6);
        for i in 0..3 {
            let translation: f64 = body.slices.iter().map(|p| p.translation[i][i]).sum();
            assert!((translation / body.added_mass[i][i] - 1.0).abs() < 1e-3);
            let drag: f64 = body.slices.iter().map(|p| p.drag_area[i][i]).sum();
            assert!((drag / body.separation.drag_area[i][i] - 1.0).abs() < 1e-9);
            // A rotation moves every slice with its centre too: along x about z, along z about x.
            let carried = |p: &Slice| {
                let crosswise = [p.translation[2][2], 0.0, p.translation[0][0]][i];
                p.rotation[i][i] + crosswise * p.centre[1] * p.centre[1]
            };
            let rotation: f64 = body.slices.iter().map(carried).sum();
            let error = rotation / body.added_mass[3 + i][3 + i] - 1.0;
            assert!(error.abs() < 0.15, "axis {i}: {error}");
        }
    }
}
