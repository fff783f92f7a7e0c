//! Affine maps.

use langevin_rigid::linalg::rotation_matrix;

/// An affine map x → linear · x + translation, the rows of `linear` first to third.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transform {
    linear: [[f64; 3]; 3],
    translation: [f64; 3],
}

impl Transform {
    pub(super) const IDENTITY: Transform = Transform {
        linear: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };

    /// A linear map, by its rows.
    #[cfg(feature = "collada")]
    pub(super) fn of_linear(linear: [[f64; 3]; 3]) -> Transform {
        Transform {
            linear,
            ..Transform::IDENTITY
        }
    }

    /// A row-major matrix, its last row taken to be 0, 0, 0, 1.
    #[cfg(feature = "collada")]
    pub(super) fn of_rows(m: &[f64; 16]) -> Transform {
        Transform::of_matrix(&std::array::from_fn(|k| m[4 * (k % 4) + k / 4]))
    }

    /// A column-major matrix, its last row taken to be 0, 0, 0, 1.
    pub(super) fn of_matrix(m: &[f64; 16]) -> Transform {
        Transform {
            linear: [0, 1, 2].map(|i| [m[i], m[4 + i], m[8 + i]]),
            translation: [m[12], m[13], m[14]],
        }
    }

    /// Translation · rotation (a quaternion x, y, z, w) · scale.
    pub(super) fn of_parts(
        translation: Option<[f64; 3]>,
        rotation: Option<[f64; 4]>,
        scale: Option<[f64; 3]>,
    ) -> Transform {
        let rotation = rotation_matrix(rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
        let scale = scale.unwrap_or([1.0; 3]);
        Transform {
            linear: rotation.map(|row| [0, 1, 2].map(|j| row[j] * scale[j])),
            translation: translation.unwrap_or([0.0; 3]),
        }
    }

    /// The sum of maps, each times its weight.
    pub(super) fn blend(parts: impl Iterator<Item = (f64, Transform)>) -> Transform {
        let mut sum = Transform {
            linear: [[0.0; 3]; 3],
            translation: [0.0; 3],
        };
        for (weight, part) in parts {
            for i in 0..3 {
                for j in 0..3 {
                    sum.linear[i][j] += weight * part.linear[i][j];
                }
                sum.translation[i] += weight * part.translation[i];
            }
        }
        sum
    }

    fn linear_part(&self, v: [f64; 3]) -> [f64; 3] {
        self.linear
            .map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    pub(super) fn apply(&self, v: [f64; 3]) -> [f64; 3] {
        let mapped = self.linear_part(v);
        [0, 1, 2].map(|k| mapped[k] + self.translation[k])
    }

    /// This map after `inner`.
    pub(super) fn after(&self, inner: &Transform) -> Transform {
        let columns = [0, 1, 2].map(|j| self.linear_part(inner.linear.map(|row| row[j])));
        Transform {
            linear: [0, 1, 2].map(|i| columns.map(|column| column[i])),
            translation: self.apply(inner.translation),
        }
    }

    /// Whether the map turns triangles over (negative determinant).
    pub(super) fn mirrors(&self) -> bool {
        let [a, b, c] = self.linear;
        let det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        det < 0.0
    }
}
