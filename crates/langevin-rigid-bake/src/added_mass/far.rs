//! Integrals of 1/r over pairs of triangles that are far from each other: point and quadrupole.

use fearless_simd::f64x4 as Four;
use fearless_simd::{Level, Select, Simd, SimdBase, SimdFloat, dispatch};
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
struct Pairing<S: Simd> {
    d: [Four<S>; 3],
    /// A_a A_b / R, zero for near pairs.
    monopole: Four<S>,
    inverse2: Four<S>,
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
    fn pairing<S: Simd>(&self, simd: S, b: &Sources) -> Pairing<S> {
        let (from, to) = (three(simd, &self.centroid), three(simd, &b.centroid));
        let d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let r2 = inner(d, d);
        let (own, other) = (load(simd, self.longest2), load(simd, b.longest2));
        let larger = own.simd_gt(other).select(own, other);
        // The same quotient decides in the search for near pairs, so the two never disagree.
        let far = (r2 / larger).simd_ge(Four::splat(simd, NEAR2));
        let one = Four::splat(simd, 1.0);
        let inverse2 = one / far.select(r2, one);
        let areas = load(simd, self.area) * load(simd, b.area);
        let monopole = far.select(areas, Four::splat(simd, 0.0)) * inverse2.sqrt();
        Pairing {
            d,
            monopole,
            inverse2,
        }
    }

    /// II 1/r with each of the sources, zero for the near ones.
    pub(super) fn potentials(&self, tile: &[Sources], values: &mut [f64x4]) {
        dispatch!(Level::new(), simd => {
            let own = six(simd, &self.spread);
            for (b, value) in tile.iter().zip(values) {
                let pairing = self.pairing(simd, b);
                let mut spread = six(simd, &b.spread);
                for k in 0..6 {
                    spread[k] = own[k] + spread[k];
                }
                let reach = inner(pairing.d, product(&spread, pairing.d));
                let trace = spread[0] + spread[1] + spread[2];
                *value = stored(pairing.with_quadrupole(reach, trace));
            }
        });
    }

    /// The same, adding the pairs to the sums of the row.
    pub(super) fn potentials_and_sums(
        &self,
        tile: &[Sources],
        values: &mut [f64x4],
        sums: &mut FarSums,
    ) {
        dispatch!(Level::new(), simd => {
            let zero = Four::splat(simd, 0.0);
            let mut moments = [[zero; 3]; TILE];
            let mut potentials = [zero; TILE];
            let mut normal_x = load(simd, sums.normal_x);
            let spread = six(simd, &self.spread);
            for (place, b) in tile.iter().enumerate() {
                let pairing = self.pairing(simd, b);
                let theirs = six(simd, &b.spread);
                let (own, other) = (product(&spread, pairing.d), product(&theirs, pairing.d));
                let reach = inner(pairing.d, own) + inner(pairing.d, other);
                let trace = (spread[0] + theirs[0]) + (spread[1] + theirs[1]) + (spread[2] + theirs[2]);
                let p = pairing.with_quadrupole(reach, trace);
                let dipole = pairing.monopole * pairing.inverse2;
                potentials[place] = p;
                values[place] = stored(p);
                let centroid = three(simd, &b.centroid);
                for m in 0..3 {
                    moments[place][m] = centroid[m] * p - other[m] * dipole;
                }
                normal_x += inner(three(simd, &b.normal), own) * dipole;
            }
            sums.normal_x = stored(normal_x);
            for k in 0..3 {
                sums.add_axis(simd, k, tile, &potentials, &moments);
            }
        });
    }
}

impl<S: Simd> Pairing<S> {
    #[inline(always)]
    fn with_quadrupole(&self, reach: Four<S>, trace: Four<S>) -> Four<S> {
        let correction = reach * 3.0 * self.inverse2 - trace;
        self.monopole * (self.inverse2 * 0.5 * correction + 1.0)
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, four: f64x4) -> Four<S> {
    Four::from_slice(simd, &four.to_array())
}

#[inline(always)]
fn stored<S: Simd>(four: Four<S>) -> f64x4 {
    f64x4::new(four.into())
}

#[inline(always)]
fn three<S: Simd>(simd: S, v: &[f64x4; 3]) -> [Four<S>; 3] {
    [load(simd, v[0]), load(simd, v[1]), load(simd, v[2])]
}

#[inline(always)]
fn six<S: Simd>(simd: S, m: &[f64x4; 6]) -> [Four<S>; 6] {
    let ([a, b, c], [d, e, f]) = (
        three(simd, &[m[0], m[1], m[2]]),
        three(simd, &[m[3], m[4], m[5]]),
    );
    [a, b, c, d, e, f]
}

#[inline(always)]
fn inner<S: Simd>(a: [Four<S>; 3], b: [Four<S>; 3]) -> Four<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn total(x: f64x4) -> f64 {
    sum(x.to_array())
}

/// Symmetric matrix (xx, yy, zz, xy, xz, yz) times vector.
#[inline(always)]
fn product<S: Simd>(m: &[Four<S>; 6], v: [Four<S>; 3]) -> [Four<S>; 3] {
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
    #[inline(always)]
    fn add_axis<S: Simd>(
        &mut self,
        simd: S,
        k: usize,
        tile: &[Sources],
        p: &[Four<S>],
        y: &[[Four<S>; 3]],
    ) {
        let (mut normal, mut turn) = (load(simd, self.normal[k]), load(simd, self.turn[k]));
        let mut normal_y = three(simd, &self.normal_y[k]);
        for ((b, p), y) in tile.iter().zip(p).zip(y) {
            let along = load(simd, b.normal[k]);
            normal += along * *p;
            turn += load(simd, b.turn[k]) * *p;
            for m in 0..3 {
                normal_y[m] += along * y[m];
            }
        }
        self.normal[k] = stored(normal);
        self.turn[k] = stored(turn);
        self.normal_y[k] = [
            stored(normal_y[0]),
            stored(normal_y[1]),
            stored(normal_y[2]),
        ];
    }

    /// The sums of the row of panel `a`.
    pub(super) fn finish(&self, a: &Panel) -> RowSums {
        let normal: Vec3 = self.normal.map(total);
        let mut sums = RowSums {
            normal,
            normal_y: self.normal_y.map(|row| row.map(total)),
            normal_x: dot(a.centroid, normal) + total(self.normal_x),
            rotational: [[0.0; 3]; 3],
        };
        // The moment of x about its centroid adds the transpose of that of y: take it twice here,
        // the energy is symmetrized.
        let (y, points) = (sums.y_cross_normal(), self.turn.map(total));
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

    fn alone(target: &Target, sources: &[Sources]) -> [f64; 4] {
        let mut values = [f64x4::ZERO];
        target.potentials(sources, &mut values);
        values[0].to_array()
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
        let plain = alone(&target, &sources);
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
        let ab = alone(&Target::new(&panels[0]), &sources)[1];
        let ba = alone(&Target::new(&panels[1]), &sources)[0];
        assert_eq!(ab, ba);
    }
}
