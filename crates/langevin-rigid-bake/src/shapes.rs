//! Parametric bodies, generated as closed meshes at a wished number of triangles.
//!
//! Every body is centred at the centroid of its volume. Long axes lie along X, the thin axis of
//! plates, discs and coins along Y. A family of meshes has only some triangle counts; each shape
//! says which, and [`Shape::mesh`] takes the one nearest to the wish. Curved bodies are scaled so
//! that the polyhedron encloses the volume of the body it stands for.

mod airplane;
mod builder;
mod cuboid;
mod ellipsoid;
mod lofted;
mod round;

use crate::mesh::{MeshError, TriMesh};
use round::Prism;

/// Most triangles a generated body may have.
pub const MAX_TRIANGLES: usize = 1 << 20;

/// Every [`Shape`](crate::shapes::Shape) by its name, as rows for a macro: `"name": Variant { dimension, ... },`.
///
/// Scenes and other front ends make of these rows what reads a shape by its name and dimensions.
///
/// ```
/// macro_rules! names {
///     ($($name:literal: $variant:ident { $($dimension:ident),* },)*) => {
///         [$($name),*]
///     };
/// }
///
/// assert!(langevin_rigid_bake::for_shapes!(names).contains(&"leaf"));
/// ```
#[macro_export]
macro_rules! for_shapes {
    ($rows:ident) => {
        $rows! {
            "ellipsoid": Ellipsoid { semi_axes },
            "elliptical-plate": EllipticalPlate { semi_axes, thickness },
            "disc": Disc { radius, thickness },
            "coin": Coin { diameter, thickness, hole },
            "washer": Washer { diameter, inner_diameter, thickness },
            "box": Box { size },
            "cylinder": Cylinder { radius, height },
            "paper-airplane": PaperAirplane { side, thickness },
            "leaf": Leaf { length, width, thickness },
            "feather": Feather { length, width, thickness },
            "samara": Samara { length, width, thickness },
        }
    };
}

/// A parametric body; lengths in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// x²/a² + y²/b² + z²/c² = 1: an icosahedron subdivided and mapped affinely.
    ///
    /// Counts: 20 f² (20, 80, 180, 320, 500, 720, 980, 1280, ... 5120), subdivided by the prime
    /// factors of f in turn; 320, 1280, 5120 are the icospheres.
    Ellipsoid {
        /// Semi-axes a, b, c along X, Y, Z.
        semi_axes: [f64; 3],
    },
    /// A rectangular box on a grid whose cells are as square as their number allows.
    ///
    /// Counts: 4 (l m + m n + n l) for l × m × n cells; 12 k² for a cube.
    Box {
        /// Edges along X, Y, Z.
        size: [f64; 3],
    },
    /// A flat plate of elliptic outline, thin along Y.
    ///
    /// The ends carry concentric elliptic rings, level lines of the potential of an elliptic
    /// disc; the rim is one row of quadrilaterals where the thickness is below the mesh size.
    /// Counts: multiples of 16 for one row, within 8 of the wish for more, from two rings on
    /// (about 70 triangles).
    EllipticalPlate {
        /// Semi-axes along X and Z.
        semi_axes: [f64; 2],
        /// Thickness along Y, kept exactly.
        thickness: f64,
    },
    /// A circular disc, its axis along Y; counts as for [`Shape::EllipticalPlate`].
    Disc {
        /// Radius.
        radius: f64,
        /// Thickness along Y, kept exactly.
        thickness: f64,
    },
    /// A coin, its axis along Y, with a round hole in the middle or none; counts as for
    /// [`Shape::EllipticalPlate`].
    Coin {
        /// Diameter.
        diameter: f64,
        /// Thickness along Y, kept exactly.
        thickness: f64,
        /// Diameter of the hole, 0 for none.
        hole: f64,
    },
    /// A flat ring, its axis along Y; counts as for [`Shape::EllipticalPlate`].
    Washer {
        /// Diameter of the outside.
        diameter: f64,
        /// Diameter of the hole.
        inner_diameter: f64,
        /// Thickness along Y, kept exactly.
        thickness: f64,
    },
    /// A circular cylinder, its axis along X; counts as for [`Shape::EllipticalPlate`].
    Cylinder {
        /// Radius.
        radius: f64,
        /// Length along X, kept exactly.
        height: f64,
    },
    /// The classic dart folded from a square sheet of paper, as a solid of the sheet's volume:
    /// nose along X, up along Y, wings along Z.
    ///
    /// Two delta wings in a horizontal plane, 0.42 sides across and 1.06 long, and a keel 0.2
    /// sides deep below them, as thick as the layers of paper are on average (2.5 in the wings,
    /// 4.6 in the keel). Counts: 12 s + 8 n + 4 for n stations and s cells across in all; 288
    /// exactly.
    PaperAirplane {
        /// Side of the square sheet.
        side: f64,
        /// Thickness of the paper.
        thickness: f64,
    },
    /// A broad leaf along X, pointed at both ends; edges and ends bend up along Y by about a tenth of
    /// the width and 7 % of the length, and the blade is twisted by 14 degrees from end to end.
    ///
    /// Counts of this and the next two: 2 m n for n stations of 2 m points, at least 64.
    Leaf {
        /// From stalk to tip.
        length: f64,
        /// Greatest width along Z.
        width: f64,
        /// Thickness of the blade.
        thickness: f64,
    },
    /// A feather along X: quill at the -X end, a vane that is wider on one side of the shaft, and a
    /// tip that bends up.
    Feather {
        /// From quill to tip.
        length: f64,
        /// Width of the vane along Z.
        width: f64,
        /// Thickness half way; the quill has 1.4 of it, the tip 0.6.
        thickness: f64,
    },
    /// A maple seed along X: nut at the -X end, a wing with a straight thick leading edge at +Z.
    Samara {
        /// From nut to tip.
        length: f64,
        /// Width of the wing along Z; the nut is 0.6 of it wide and 0.32 of it thick.
        width: f64,
        /// Thickness of the wing.
        thickness: f64,
    },
}

impl Shape {
    /// The closed mesh of the body with a number of triangles as near to `triangles` as its
    /// family has; of two equally near, the smaller.
    ///
    /// ```
    /// use langevin_rigid_bake::shapes::Shape;
    ///
    /// let ellipsoid = Shape::Ellipsoid { semi_axes: [0.01, 0.02, 0.04] };
    /// let mesh = ellipsoid.mesh(1280)?;
    /// assert_eq!(mesh.triangles().len(), 1280);
    /// let exact = 4.0 / 3.0 * std::f64::consts::PI * 0.01 * 0.02 * 0.04;
    /// assert!((mesh.volume() / exact - 1.0).abs() < 1e-12);
    /// # Ok::<(), langevin_rigid_bake::shapes::ShapeError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// A dimension that is not possible, and fewer triangles than the shape needs or more than
    /// [`MAX_TRIANGLES`].
    pub fn mesh(&self, triangles: usize) -> Result<TriMesh, ShapeError> {
        if triangles > MAX_TRIANGLES {
            return Err(ShapeError::TooManyTriangles { asked: triangles });
        }
        match *self {
            Shape::Ellipsoid { semi_axes } => ellipsoid::mesh(semi_axes, triangles),
            Shape::Box { size } => cuboid::mesh(size, triangles),
            Shape::EllipticalPlate {
                semi_axes: [a, b],
                thickness,
            } => prism(
                "elliptical plate",
                [
                    ("semi-axis a", a),
                    ("semi-axis b", b),
                    ("thickness", thickness),
                ],
                &Prism {
                    semi_axes: [b, a],
                    hole: 0.0,
                    height: thickness,
                    axis: 1,
                },
                triangles,
            ),
            Shape::Disc { radius, thickness } => prism(
                "disc",
                [("radius", radius), ("thickness", thickness)],
                &Prism {
                    semi_axes: [radius; 2],
                    hole: 0.0,
                    height: thickness,
                    axis: 1,
                },
                triangles,
            ),
            Shape::Cylinder { radius, height } => prism(
                "cylinder",
                [("radius", radius), ("height", height)],
                &Prism {
                    semi_axes: [radius; 2],
                    hole: 0.0,
                    height,
                    axis: 0,
                },
                triangles,
            ),
            Shape::Coin {
                diameter,
                thickness,
                hole,
            } if hole == 0.0 => prism(
                "coin",
                [("diameter", diameter), ("thickness", thickness)],
                &Prism {
                    semi_axes: [0.5 * diameter; 2],
                    hole,
                    height: thickness,
                    axis: 1,
                },
                triangles,
            ),
            Shape::Coin {
                diameter,
                thickness,
                hole,
            } => ring(
                "coin",
                ["diameter", "hole"],
                [diameter, hole],
                thickness,
                triangles,
            ),
            Shape::Washer {
                diameter,
                inner_diameter,
                thickness,
            } => ring(
                "washer",
                ["diameter", "inner_diameter"],
                [diameter, inner_diameter],
                thickness,
                triangles,
            ),
            Shape::PaperAirplane { side, thickness } => airplane::mesh(side, thickness, triangles),
            Shape::Leaf {
                length,
                width,
                thickness,
            } => lofted::leaf([length, width, thickness], triangles),
            Shape::Feather {
                length,
                width,
                thickness,
            } => lofted::feather([length, width, thickness], triangles),
            Shape::Samara {
                length,
                width,
                thickness,
            } => lofted::samara([length, width, thickness], triangles),
        }
    }

    /// The full thickness b of Eq. (1) (m): that of a sheet, the least dimension of any other body.
    pub fn thickness(&self) -> f64 {
        let least = |sizes: &[f64]| sizes.iter().copied().fold(f64::INFINITY, f64::min);
        match *self {
            Shape::Ellipsoid { semi_axes } => 2.0 * least(&semi_axes),
            Shape::Box { size } => least(&size),
            Shape::Cylinder { radius, height } => least(&[2.0 * radius, height]),
            Shape::EllipticalPlate { thickness, .. }
            | Shape::Disc { thickness, .. }
            | Shape::Coin { thickness, .. }
            | Shape::Washer { thickness, .. }
            | Shape::PaperAirplane { thickness, .. }
            | Shape::Leaf { thickness, .. }
            | Shape::Feather { thickness, .. }
            | Shape::Samara { thickness, .. } => thickness,
        }
    }
}

/// A prism after checking its lengths.
fn prism<const N: usize>(
    shape: &'static str,
    lengths: [(&'static str, f64); N],
    prism: &Prism,
    triangles: usize,
) -> Result<TriMesh, ShapeError> {
    for (dimension, value) in lengths {
        positive(shape, dimension, value)?;
    }
    enough(shape, triangles, prism.fewest())?;
    prism.mesh(triangles)
}

/// A flat ring after checking its diameters, outer and inner.
fn ring(
    shape: &'static str,
    names: [&'static str; 2],
    [outer, inner]: [f64; 2],
    thickness: f64,
    triangles: usize,
) -> Result<TriMesh, ShapeError> {
    if inner >= outer {
        let (dimension, value, must) = (names[1], inner, "smaller than the outer diameter");
        return Err(ShapeError::BadDimension {
            shape,
            dimension,
            value,
            must,
        });
    }
    prism(
        shape,
        [
            (names[0], outer),
            (names[1], inner),
            ("thickness", thickness),
        ],
        &Prism {
            semi_axes: [0.5 * outer; 2],
            hole: inner / outer,
            height: thickness,
            axis: 1,
        },
        triangles,
    )
}

/// Why a shape cannot be generated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A dimension is not positive and finite, or contradicts another.
    #[error("{shape}: {dimension} = {value} m is impossible: it must be {must}")]
    BadDimension {
        /// Name of the shape.
        shape: &'static str,
        /// Name of the dimension.
        dimension: &'static str,
        /// Its value (m).
        value: f64,
        /// What it must be.
        must: &'static str,
    },
    /// The shape cannot be made of so few triangles.
    #[error("{shape}: {asked} triangles are too few, at least {minimum} are needed")]
    TooFewTriangles {
        /// Name of the shape.
        shape: &'static str,
        /// Number asked for.
        asked: usize,
        /// Number needed.
        minimum: usize,
    },
    /// More triangles than the generator makes.
    #[error("{asked} triangles are too many: at most {MAX_TRIANGLES} can be generated")]
    TooManyTriangles {
        /// Number asked for.
        asked: usize,
    },
    /// The dimensions are so far apart that the generated mesh is not a body.
    #[error("the generated mesh is not a body, its dimensions are too far apart: {0}")]
    Mesh(#[from] MeshError),
}

/// Checks that a length is positive and finite.
fn positive(shape: &'static str, dimension: &'static str, value: f64) -> Result<(), ShapeError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(ShapeError::BadDimension {
        shape,
        dimension,
        value,
        must: "positive and finite",
    })
}

/// Checks that there are triangles enough.
fn enough(shape: &'static str, asked: usize, minimum: usize) -> Result<(), ShapeError> {
    if asked < minimum {
        return Err(ShapeError::TooFewTriangles {
            shape,
            asked,
            minimum,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests;
