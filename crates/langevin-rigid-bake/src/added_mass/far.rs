//! Integrals of 1/r over pairs of triangles that are far from each other: point and quadrupole.

use wide::f64x4;

use super::lanes::sum;
use super::near::NEAR2;
use super::panels::{Panel, Vec3};
use super::sums::RowSums;
use crate::mesh::vector::{cross, dot};

/// Sources, in fours, that are paired with a row at a time.
pub(super) const TILE: usize = 16;

/// Four panels as sources.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sources {
    centroid: [f64x4; 3],
    normal: [f64x4; 3],
    /// centroid x normal.
    turn: [f64x4; 3],
    area: f64x4,
    longest2: f64x4,
    spread: [f64x4; 6],
}

impl Sources {
    /// All panels in fours; what fills the last four has no area.
    pub(super) fn all(panels: &[Panel]) -> Vec<Sources> {
        panels.chunks(4).map(Sources::new).collect()
    }

    fn new(four: &[Panel]) -> Sources {
        let lanes = |f: &dyn Fn(&Panel) -> f64| {
            f64x4::new([0, 1, 2, 3].map(|i| f(four.get(i).unwrap_or(&four[0]))))
        };
        let filled = f64x4::new([0, 1, 2, 3].map(|i| if i < four.len() { 1.0 } else { 0.0 }));
        Sources {
            centroid: [0, 1, 2].map(|k| lanes(&|p| p.centroid[k])),
            normal: [0, 1, 2].map(|k| lanes(&|p| p.normal[k])),
            turn: [0, 1, 2].map(|k| lanes(&|p| cross(p.centroid, p.normal)[k])),
            area: filled * lanes(&|p| p.area),
            longest2: lanes(&|p| p.longest2),
            spread: [0, 1, 2, 3, 4, 5].map(|k| lanes(&|p| p.spread[k])),
        }
    }
}

/// A panel as the fixed side of its row.
pub(super) struct Target {
    centroid: [f64x4; 3],
    area: f64x4,
    longest2: f64x4,
    spread: [f64x4; 6],
}

/// What one pair of Target and Sources shares between its integrals.
struct Pairing {
    d: [f64x4; 3],
    /// A_a A_b / R, zero for near pairs.
    monopole: f64x4,
    inverse2: f64x4,
}

impl Target {
    pub(super) fn new(panel: &Panel) -> Target {
        Target {
            centroid: panel.centroid.map(f64x4::splat),
            area: f64x4::splat(panel.area),
            longest2: f64x4::splat(panel.longest2),
            spread: panel.spread.map(f64x4::splat),
        }
    }

    #[inline(always)]
    fn pairing(&self, b: &Sources) -> Pairing {
        let d: [f64x4; 3] = std::array::from_fn(|k| b.centroid[k] - self.centroid[k]);
        let r2 = inner(d, d);
        let larger = self
            .longest2
            .simd_gt(b.longest2)
            .select(self.longest2, b.longest2);
        // The same quotient decides in the search for near pairs, so the two never disagree.
        let far = (r2 / larger).simd_ge(f64x4::splat(NEAR2));
        let inverse2 = f64x4::ONE / far.select(r2, f64x4::ONE);
        let monopole = far.select(self.area * b.area, f64x4::ZERO) * inverse2.sqrt();
        Pairing {
            d,
            monopole,
            inverse2,
        }
    }

    /// II 1/r with each of four sources, zero for the near ones.
    #[inline(always)]
    pub(super) fn potential(&self, b: &Sources) -> f64x4 {
        let pairing = self.pairing(b);
        let spread = std::array::from_fn(|k| self.spread[k] + b.spread[k]);
        let reach = inner(pairing.d, product(&spread, pairing.d));
        pairing.with_quadrupole(reach, spread[0] + spread[1] + spread[2])
    }

    /// The same with a whole tile, adding the pairs to the sums of the row.
    pub(super) fn potentials_and_sums(
        &self,
        tile: &[Sources],
        values: &mut [f64x4],
        sums: &mut FarSums,
    ) {
        let mut moments = [[f64x4::ZERO; 3]; TILE];
        let mut normal_x = sums.normal_x;
        for ((b, value), y) in tile.iter().zip(&mut *values).zip(&mut moments) {
            let pairing = self.pairing(b);
            let (own, other) = (
                product(&self.spread, pairing.d),
                product(&b.spread, pairing.d),
            );
            let reach = inner(pairing.d, own) + inner(pairing.d, other);
            let trace = (self.spread[0] + b.spread[0])
                + (self.spread[1] + b.spread[1])
                + (self.spread[2] + b.spread[2]);
            let p = pairing.with_quadrupole(reach, trace);
            let dipole = pairing.monopole * pairing.inverse2;
            *value = p;
            *y = std::array::from_fn(|m| b.centroid[m] * p - other[m] * dipole);
            normal_x += inner(b.normal, own) * dipole;
        }
        sums.normal_x = normal_x;
        for k in 0..3 {
            sums.add_axis(k, tile, values, &moments);
        }
    }
}

impl Pairing {
    #[inline(always)]
    fn with_quadrupole(&self, reach: f64x4, trace: f64x4) -> f64x4 {
        let correction = f64x4::splat(3.0) * reach * self.inverse2 - trace;
        self.monopole * (f64x4::ONE + f64x4::HALF * self.inverse2 * correction)
    }
}

#[inline(always)]
fn inner(a: [f64x4; 3], b: [f64x4; 3]) -> f64x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Symmetric matrix (xx, yy, zz, xy, xz, yz) times vector.
#[inline(always)]
fn product(m: &[f64x4; 6], v: [f64x4; 3]) -> [f64x4; 3] {
    [
        m[0] * v[0] + m[3] * v[1] + m[4] * v[2],
        m[3] * v[0] + m[1] * v[1] + m[5] * v[2],
        m[4] * v[0] + m[5] * v[1] + m[2] * v[2],
    ]
}

/// Running sums of one row in lanes.
#[derive(Debug, Clone, Copy)]
pub(super) struct FarSums {
    normal: [f64x4; 3],
    turn: [f64x4; 3],
    normal_y: [[f64x4; 3]; 3],
    normal_x: f64x4,
}

impl FarSums {
    pub(super) fn zero() -> FarSums {
        FarSums {
            normal: [f64x4::ZERO; 3],
            turn: [f64x4::ZERO; 3],
            normal_y: [[f64x4::ZERO; 3]; 3],
            normal_x: f64x4::ZERO,
        }
    }

    /// Adds the sums whose normal component is `k`: few enough to stay in registers.
    fn add_axis(&mut self, k: usize, tile: &[Sources], p: &[f64x4], y: &[[f64x4; 3]]) {
        let (mut normal, mut turn) = (self.normal[k], self.turn[k]);
        let mut normal_y = self.normal_y[k];
        for ((b, p), y) in tile.iter().zip(p).zip(y) {
            normal += b.normal[k] * *p;
            turn += b.turn[k] * *p;
            for m in 0..3 {
                normal_y[m] += b.normal[k] * y[m];
            }
        }
        (self.normal[k], self.turn[k], self.normal_y[k]) = (normal, turn, normal_y);
    }

    /// The sums of the row of panel `a`.
    pub(super) fn finish(&self, a: &Panel) -> RowSums {
        let normal: Vec3 = self.normal.map(sum);
        let mut sums = RowSums {
            normal,
            normal_y: self.normal_y.map(|row| row.map(sum)),
            normal_x: dot(a.centroid, normal) + sum(self.normal_x),
            rotational: [[0.0; 3]; 3],
        };
        // The moment of x about its centroid adds the transpose of that of y: take it twice here,
        // the energy is symmetrized.
        let (y, points) = (sums.y_cross_normal(), self.turn.map(sum));
        let x = cross(a.centroid, a.normal);
        sums.rotational =
            std::array::from_fn(|k| std::array::from_fn(|l| x[k] * (2.0 * y[l] - points[l])));
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::added_mass::kernel::{Potential, Rule, pair};
    use crate::added_mass::panels::Panels;

    fn two_triangles(distance: f64) -> Panels {
        let mut vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.2, 0.9, 0.1]];
        vertices.extend(
            [[0.1, 0.0, 0.3], [0.9, 0.3, 0.0], [0.3, 0.2, 0.8]].map(|p: Vec3| {
                [
                    p[0] + distance,
                    p[1] + 0.3 * distance,
                    p[2] - 0.2 * distance,
                ]
            }),
        );
        Panels::new(&vertices, &[[0, 1, 2], [3, 4, 5]])
    }

    #[test]
    fn far_pairs_agree_with_the_exact_ones() {
        let panels = two_triangles(6.0).panels;
        let [a, b] = [0, 1].map(|k| Potential::new(&panels[k]));
        let exact = pair(&a, &b, &Rule::seven());
        let mut sums = FarSums::zero();
        let sources = Sources::all(&panels);
        let target = Target::new(&panels[0]);
        let mut p = [f64x4::ZERO];
        target.potentials_and_sums(&sources, &mut p, &mut sums);
        let p = p[0].to_array();
        assert_eq!(p[0], 0.0, "a panel is near itself");
        assert!((p[1] / exact.p - 1.0).abs() < 2e-5, "{} {}", p[1], exact.p);
        let plain = target.potential(&sources[0]).to_array();
        assert!((plain[1] / p[1] - 1.0).abs() < 1e-15);
        let mut near = RowSums::default();
        near.add_near(&exact, panels[1].normal);
        let far = sums.finish(&panels[0]);
        for k in 0..3 {
            for m in 0..3 {
                let error = far.normal_y[k][m] - near.normal_y[k][m];
                assert!(error.abs() < 2e-4 * exact.p, "{k} {m} {error}");
            }
        }
        let error = far.normal_x - near.normal_x;
        assert!(error.abs() < 2e-4 * exact.p, "{error} {}", exact.p);
    }

    #[test]
    fn a_pair_is_the_same_from_both_ends() {
        let panels = two_triangles(4.0).panels;
        let sources = Sources::all(&panels);
        let ab = Target::new(&panels[0]).potential(&sources[0]).to_array()[1];
        let ba = Target::new(&panels[1]).potential(&sources[0]).to_array()[0];
        assert_eq!(ab, ba);
    }
}
