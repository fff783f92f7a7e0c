//! What a body's symmetry makes of its tensors.
//!
//! A body with three planes of symmetry (an ellipsoid, a box, a coin, a sheet) has diagonal tensors in
//! its own axes, and its step needs much less arithmetic. The equations are therefore written over a
//! [`Symmetry`]: [`General`] or [`Symmetric`].

use std::fmt::Debug;

use crate::body::{Body, Separation};
use crate::linalg::{Mat3, Mat6, Vec3, Vec6, each, lift, lift_matrix, mat_vec, mul};
use crate::modes::{Axes, Eigenmodes, Modes};
use crate::real::Real;

/// How a body's tensors are kept and applied.
pub(crate) trait Symmetry: Debug + Clone {
    /// A 6x6 tensor.
    type Tensor<R: Real>: Tensor<R> + Debug + Clone;
    /// A 3x3 tensor.
    type Block<R: Real>: Block<R> + Debug + Clone;
    /// The modes of the Langevin loads.
    type Modes<R: Real>: Modes<R> + Debug + Clone;
    /// Whether buoyancy acts at the centre of mass.
    const CENTRED: bool;

    /// `m` in the lanes of `like`.
    fn tensor<R: Real>(like: R, m: &Mat6) -> Self::Tensor<R>;
    /// `m` in the lanes of `like`.
    fn block<R: Real>(like: R, m: &Mat3) -> Self::Block<R>;
    /// `modes` in the lanes of `like`, which are those of the tensors A, T and T^-1 A B.
    fn modes<R: Real>(
        like: R,
        modes: &Eigenmodes,
        added: &Mat6,
        total: &Mat6,
        kick: &Mat6,
    ) -> Self::Modes<R>;
}

pub(crate) trait Tensor<R> {
    fn times(&self, a: &Vec6<R>) -> Vec6<R>;
    /// All its entries.
    fn matrix(&self) -> Mat6<R>;
}

pub(crate) trait Block<R> {
    fn times(&self, a: Vec3<R>) -> Vec3<R>;
    /// All its entries.
    fn matrix(&self) -> Mat3<R>;
}

/// Any body.
#[derive(Debug, Clone)]
pub(crate) struct General;

impl Symmetry for General {
    type Tensor<R: Real> = Mat6<R>;
    type Block<R: Real> = Mat3<R>;
    type Modes<R: Real> = Eigenmodes<R>;
    const CENTRED: bool = false;

    fn tensor<R: Real>(like: R, m: &Mat6) -> Mat6<R> {
        lift_matrix(like, m)
    }
    fn block<R: Real>(like: R, m: &Mat3) -> Mat3<R> {
        lift_matrix(like, m)
    }
    fn modes<R: Real>(like: R, modes: &Eigenmodes, _: &Mat6, _: &Mat6, _: &Mat6) -> Eigenmodes<R> {
        modes.lift(like)
    }
}

impl<R: Real> Tensor<R> for Mat6<R> {
    #[inline(always)]
    fn times(&self, a: &Vec6<R>) -> Vec6<R> {
        mul(self, a)
    }
    #[inline(always)]
    fn matrix(&self) -> Mat6<R> {
        *self
    }
}

impl<R: Real> Block<R> for Mat3<R> {
    #[inline(always)]
    fn times(&self, a: Vec3<R>) -> Vec3<R> {
        mat_vec(self, a)
    }
    #[inline(always)]
    fn matrix(&self) -> Mat3<R> {
        *self
    }
}

/// A body with three planes of symmetry and its buoyancy at its centre of mass.
#[derive(Debug, Clone)]
pub(crate) struct Symmetric;

impl Symmetry for Symmetric {
    type Tensor<R: Real> = Diagonal<R, 6>;
    type Block<R: Real> = Diagonal<R, 3>;
    type Modes<R: Real> = Axes<R>;
    const CENTRED: bool = true;

    fn tensor<R: Real>(like: R, m: &Mat6) -> Diagonal<R, 6> {
        Diagonal::new(like, m)
    }
    fn block<R: Real>(like: R, m: &Mat3) -> Diagonal<R, 3> {
        Diagonal::new(like, m)
    }
    fn modes<R: Real>(like: R, _: &Eigenmodes, added: &Mat6, total: &Mat6, kick: &Mat6) -> Axes<R> {
        let diagonal = |m: &Mat6| -> Vec6 { std::array::from_fn(|i| m[i][i]) };
        Axes::new(like, &diagonal(added), &diagonal(total), &diagonal(kick))
    }
}

impl Symmetric {
    /// Whether the body is one, but for what is far below the accuracy of its tensors: the mesh of a
    /// symmetric body seldom is symmetric to the bit.
    pub(crate) fn includes(body: &Body, fluid_density: f64) -> bool {
        let total = body.total_mass(fluid_density);
        let added = body.added_mass.map(|row| row.map(|a| fluid_density * a));
        let Separation {
            drag_area,
            extents,
            stokes_translation,
            stokes_rotation,
        } = &body.separation;
        let of_body = [drag_area, extents, stokes_translation, stokes_rotation];
        let of_parts = body.slices.iter().flat_map(|part| {
            [
                &part.translation,
                &part.rotation,
                &part.drag_area,
                &part.extents,
            ]
        });
        let size = body.half_extents[0];
        let centred = body.centre_of_buoyancy;
        couples_little(&total, &total)
            && couples_little(&added, &total)
            && centred.iter().all(|r| r.abs() <= NEGLIGIBLE * size)
            && of_body.into_iter().chain(of_parts).all(is_diagonal)
    }
}

/// What a coupling may be beside the entries that it couples.
const NEGLIGIBLE: f64 = 1e-6;

/// Whether the entries of `m` off the diagonal are negligible beside the inertias of the motions that
/// they couple.
fn couples_little(m: &Mat6, total: &Mat6) -> bool {
    let little = |i: usize, j: usize| {
        let beside = NEGLIGIBLE * NEGLIGIBLE * total[i][i] * total[j][j];
        i == j || m[i][j] * m[i][j] <= beside
    };
    (0..6).all(|i| (0..6).all(|j| little(i, j)))
}

/// The same of a tensor beside its own largest entry.
fn is_diagonal(m: &Mat3) -> bool {
    let largest = (0..3).fold(0.0f64, |l, i| l.max(m[i][i].abs()));
    (0..3).all(|i| (0..3).all(|j| i == j || m[i][j].abs() <= NEGLIGIBLE * largest))
}

/// The diagonal of a tensor that has nothing else.
#[derive(Debug, Clone)]
pub(crate) struct Diagonal<R, const N: usize>([R; N]);

impl<R: Real, const N: usize> Diagonal<R, N> {
    fn new(like: R, m: &[[f64; N]; N]) -> Self {
        Self(lift(like, &std::array::from_fn(|i| m[i][i])))
    }

    #[inline(always)]
    fn scaled(&self, a: &[R; N]) -> [R; N] {
        each(
            a[0],
            #[inline(always)]
            |i| self.0[i] * a[i],
        )
    }

    #[inline(always)]
    fn full(&self) -> [[R; N]; N] {
        let mut m = [[self.0[0].of(0.0); N]; N];
        for i in 0..N {
            m[i][i] = self.0[i];
        }
        m
    }
}

impl<R: Real> Tensor<R> for Diagonal<R, 6> {
    #[inline(always)]
    fn times(&self, a: &Vec6<R>) -> Vec6<R> {
        self.scaled(a)
    }
    #[inline(always)]
    fn matrix(&self) -> Mat6<R> {
        self.full()
    }
}

impl<R: Real> Block<R> for Diagonal<R, 3> {
    #[inline(always)]
    fn times(&self, a: Vec3<R>) -> Vec3<R> {
        self.scaled(&a)
    }
    #[inline(always)]
    fn matrix(&self) -> Mat3<R> {
        self.full()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_negligible_coupling_is_none() {
        let mut total = [[0.0; 6]; 6];
        for i in 0..6 {
            total[i][i] = if i < 3 { 4.0 } else { 1.0 };
        }
        let mut added = [[0.0; 6]; 6];
        added[0][5] = 1.9e-6;
        assert!(couples_little(&added, &total));
        added[0][5] = 2.1e-6;
        assert!(!couples_little(&added, &total));
        assert!(is_diagonal(&[[1.0, 1e-7, 0.0], [1e-7, 0.0, 0.0], [0.0; 3]]));
        assert!(!is_diagonal(&[
            [1.0, 1e-5, 0.0],
            [1e-5, 1.0, 0.0],
            [0.0; 3]
        ]));
        assert!(is_diagonal(&[[0.0; 3]; 3]));
    }
}
