//! Integrals of 1/r over pairs of triangles that are near each other: exact inside, quadrature
//! outside (A. Carley and D. Wilton et al.; the forms here have no cancellation that matters).

use fearless_simd::{ExtractToken, Level, Select, Simd, SimdBase, SimdFloat, dispatch, f64x4};

use super::lanes::{angle, ln, sum};
use super::panels::{Panel, Vec3};
use crate::mesh::vector::{cross, norm, scale, sub};

/// II 1/r, II x/r, II y/r and II x_k y_l / r, with x on the first triangle and y on the second.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct PairMoments {
    pub(super) p: f64,
    pub(super) x: Vec3,
    pub(super) y: Vec3,
    pub(super) xy: [Vec3; 3],
}

impl PairMoments {
    pub(super) fn swapped(&self) -> PairMoments {
        PairMoments {
            p: self.p,
            x: self.y,
            y: self.x,
            xy: std::array::from_fn(|k| std::array::from_fn(|l| self.xy[l][k])),
        }
    }

    fn mean(&self, other: &PairMoments) -> PairMoments {
        let mean = |a: Vec3, b: Vec3| std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
        PairMoments {
            p: 0.5 * (self.p + other.p),
            x: mean(self.x, other.x),
            y: mean(self.y, other.y),
            xy: std::array::from_fn(|k| mean(self.xy[k], other.xy[k])),
        }
    }
}

/// Squared ratio of longest edges above which only the smaller triangle carries the quadrature.
const UNEQUAL2: f64 = 1.517 * 1.517;

/// The moments of a pair; the order of the arguments swaps x and y and changes nothing else.
pub(super) fn pair(a: &Potential, b: &Potential, rule: &Rule) -> PairMoments {
    dispatch!(Level::new(), simd => {
        if a.longest2 > UNEQUAL2 * b.longest2 {
            directed(simd, b, a, rule).swapped()
        } else if b.longest2 > UNEQUAL2 * a.longest2 {
            directed(simd, a, b, rule)
        } else {
            directed(simd, a, b, rule).mean(&directed(simd, b, a, rule).swapped())
        }
    })
}

/// The moments of a triangle with itself.
pub(super) fn own(a: &Potential, rule: &Rule) -> PairMoments {
    let once = dispatch!(Level::new(), simd => directed(simd, a, a, rule));
    once.mean(&once.swapped())
}

/// Quadrature over x in `outer`, exact integration over y in `inner`.
#[inline(always)]
fn directed<S: Simd>(simd: S, outer: &Potential, inner: &Potential, rule: &Rule) -> PairMoments {
    let [v0, v1, v2] = outer.corners;
    let zero = f64x4::splat(simd, 0.0);
    let (mut p, mut x, mut y) = (zero, [zero; 3], [zero; 3]);
    let mut xy = [[zero; 3]; 3];
    for node in &rule.nodes {
        let [b0, b1, b2] = &node.barycentric;
        let [b0, b1, b2] = [load(simd, b0), load(simd, b1), load(simd, b2)];
        let weight = load(simd, &node.weight);
        let mut at = [zero; 3];
        for k in 0..3 {
            at[k] = b0 * v0[k] + b1 * v1[k] + b2 * v2[k];
        }
        let (value, first) = inner.at(at);
        let value = weight * value;
        p += value;
        for k in 0..3 {
            x[k] += at[k] * value;
            let moment = weight * first[k] + at[k] * value;
            y[k] += moment;
            for l in 0..3 {
                xy[l][k] += at[l] * moment;
            }
        }
    }
    let area = 0.5 * outer.double_area;
    let total = |v: f64x4<S>| sum(v.into()) * area;
    let three = |v: [f64x4<S>; 3]| [total(v[0]), total(v[1]), total(v[2])];
    PairMoments {
        p: total(p),
        x: three(x),
        y: three(y),
        xy: [three(xy[0]), three(xy[1]), three(xy[2])],
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, four: &[f64; 4]) -> f64x4<S> {
    f64x4::from_slice(simd, four)
}

/// The exact integrals of 1/r and (y - x)/r over a triangle, seen from any point x.
#[derive(Debug, Clone)]
pub(super) struct Potential {
    corners: [Vec3; 3],
    normal: Vec3,
    double_area: f64,
    longest2: f64,
    /// Unit tangent, outward normal in the plane, and length of the edge that starts at a corner.
    tangents: [Vec3; 3],
    outward: [Vec3; 3],
    lengths: [f64; 3],
}

impl Potential {
    pub(super) fn new(panel: &Panel) -> Potential {
        let corners = panel.points;
        let edges = [0, 1, 2].map(|k| sub(corners[(k + 1) % 3], corners[k]));
        let lengths = edges.map(norm);
        let tangents = std::array::from_fn(|k| scale(1.0 / lengths[k], edges[k]));
        Potential {
            corners,
            normal: panel.normal,
            double_area: 2.0 * panel.area,
            longest2: panel.longest2,
            tangents,
            outward: tangents.map(|t| cross(t, panel.normal)),
            lengths,
        }
    }

    #[inline(always)]
    fn at<S: Simd>(&self, x: [f64x4<S>; 3]) -> (f64x4<S>, [f64x4<S>; 3]) {
        let simd = x[0].token();
        let zero = f64x4::splat(simd, 0.0);
        let (mut to, mut length) = ([[zero; 3]; 3], [zero; 3]);
        for corner in 0..3 {
            for k in 0..3 {
                to[corner][k] = f64x4::splat(simd, self.corners[corner][k]) - x[k];
            }
            length[corner] = inner(to[corner], to[corner]).sqrt();
        }
        let height = against(to[0], self.normal);
        let mut value = zero;
        let mut first = [zero; 3];
        for k in 0..3 {
            let far = (k + 1) % 3;
            let across = against(to[k], self.outward[k]);
            let along = against(to[k], self.tangents[k]);
            let edge = f64x4::splat(simd, self.lengths[k]);
            let log = edge_log(length[k] + length[far], edge);
            value += across * log;
            let g = ((along + edge) * length[far] - along * length[k]
                + (across * across + height * height) * log)
                * 0.5;
            for m in 0..3 {
                first[m] += g * self.outward[k][m];
            }
        }
        value -= height.abs() * self.solid_angle(to, length, height);
        for m in 0..3 {
            first[m] += height * value * self.normal[m];
        }
        (value, first)
    }

    /// Solid angle without its sign (A. van Oosterom and J. Strackee, 1983).
    #[inline(always)]
    fn solid_angle<S: Simd>(
        &self,
        to: [[f64x4<S>; 3]; 3],
        length: [f64x4<S>; 3],
        height: f64x4<S>,
    ) -> f64x4<S> {
        let denominator = length[0] * length[1] * length[2]
            + inner(to[0], to[1]) * length[2]
            + inner(to[1], to[2]) * length[0]
            + inner(to[2], to[0]) * length[1];
        angle(height.abs() * self.double_area, denominator) * 2.0
    }
}

/// Integral of 1/r along an edge of length `edge` whose ends are `both` away together.
///
/// On the edge itself the integral diverges; it is bounded here, and its factor is zero there.
#[inline(always)]
fn edge_log<S: Simd>(both: f64x4<S>, edge: f64x4<S>) -> f64x4<S> {
    let gap = both - edge;
    let floor = edge * 1e-15;
    ln((both + edge) / gap.simd_gt(floor).select(gap, floor))
}

#[inline(always)]
fn inner<S: Simd>(a: [f64x4<S>; 3], b: [f64x4<S>; 3]) -> f64x4<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn against<S: Simd>(a: [f64x4<S>; 3], b: Vec3) -> f64x4<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Four quadrature points in barycentric coordinates; weights sum to 1 over the rule.
#[derive(Debug, Clone)]
struct Nodes {
    barycentric: [[f64; 4]; 3],
    weight: [f64; 4],
}

/// A quadrature rule on a triangle.
#[derive(Debug, Clone)]
pub(super) struct Rule {
    nodes: Vec<Nodes>,
}

impl Rule {
    /// Three points, degree 2.
    pub(super) fn three() -> Rule {
        Rule::from_points(&orbit(1.0 / 6.0, 1.0 / 3.0))
    }

    /// Seven points, degree 5 (J. Radon, 1948).
    pub(super) fn seven() -> Rule {
        let root = 15f64.sqrt();
        let mut points = vec![([1.0 / 3.0; 3], 9.0 / 40.0)];
        points.extend(orbit((6.0 - root) / 21.0, (155.0 - root) / 1200.0));
        points.extend(orbit((6.0 + root) / 21.0, (155.0 + root) / 1200.0));
        Rule::from_points(&points)
    }

    /// Six points of degree 4 on each quarter of the triangle.
    pub(super) fn twenty_four() -> Rule {
        let mut six = orbit(0.445_948_490_915_965, 0.223_381_589_678_011).to_vec();
        six.extend(orbit(0.091_576_213_509_771, 0.109_951_743_655_322));
        let corner = |k: usize| {
            move |b: [f64; 3]| {
                let mut at = b.map(|v| 0.5 * v);
                at[k] += 0.5;
                at
            }
        };
        let middle = |b: [f64; 3]| b.map(|v| 0.5 - 0.5 * v);
        let mut points = Vec::with_capacity(24);
        for &(b, w) in &six {
            points.extend((0..3).map(|k| (corner(k)(b), 0.25 * w)));
            points.push((middle(b), 0.25 * w));
        }
        Rule::from_points(&points)
    }

    fn from_points(points: &[([f64; 3], f64)]) -> Rule {
        let nodes = points
            .chunks(4)
            .map(|four| {
                // A short group repeats a point with no weight.
                let get = |i: usize| four.get(i).copied().unwrap_or((four[0].0, 0.0));
                let lanes = [0, 1, 2, 3].map(get);
                Nodes {
                    barycentric: [0, 1, 2].map(|k| lanes.map(|(b, _)| b[k])),
                    weight: lanes.map(|(_, w)| w),
                }
            })
            .collect();
        Rule { nodes }
    }
}

/// The three points with two equal barycentric coordinates `a`.
fn orbit(a: f64, weight: f64) -> [([f64; 3], f64); 3] {
    let b = 1.0 - 2.0 * a;
    [
        ([b, a, a], weight),
        ([a, b, a], weight),
        ([a, a, b], weight),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(points: [Vec3; 3]) -> Panel {
        Panel::new([0, 1, 2], points)
    }

    fn right_triangle() -> Panel {
        panel([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    }

    #[test]
    fn rules_integrate_polynomials_of_their_degree() {
        // Integral of x^i y^j over the unit triangle is i! j! / (i + j + 2)!; the mean is twice it.
        let factorial = |n: i32| f64::from((1..=n).product::<i32>());
        for (rule, degree) in [
            (Rule::three(), 2),
            (Rule::seven(), 5),
            (Rule::twenty_four(), 4),
        ] {
            for (i, j) in (0..=degree).flat_map(|i| (0..=degree - i).map(move |j| (i, j))) {
                let term = |n: &Nodes| {
                    let [_, x, y] = n.barycentric;
                    let w = n.weight;
                    (0..4)
                        .map(|l| w[l] * x[l].powi(i) * y[l].powi(j))
                        .sum::<f64>()
                };
                let got: f64 = rule.nodes.iter().map(term).sum();
                let want = 2.0 * factorial(i) * factorial(j) / factorial(i + j + 2);
                assert!((got - want).abs() < 1e-14, "x^{i} y^{j}: {got} {want}");
            }
        }
    }

    /// Midpoint rule on a fine subdivision.
    fn brute_force(points: [Vec3; 3], x: Vec3) -> (f64, Vec3) {
        let n = 600;
        let (mut value, mut first) = (0.0, [0.0; 3]);
        let [a, b, c] = points;
        let area = 0.5 * norm(cross(sub(b, a), sub(c, a))) / f64::from(n * n);
        for i in 0..n {
            for j in 0..2 * (n - i) - 1 {
                let third = if j % 2 == 0 { 1.0 / 3.0 } else { 2.0 / 3.0 };
                let (s, t) = (f64::from(i) + third, f64::from(j / 2) + third);
                let (s, t) = (s / f64::from(n), t / f64::from(n));
                let d: Vec3 =
                    std::array::from_fn(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) - x[k]);
                value += area / norm(d);
                first = std::array::from_fn(|k| first[k] + area * d[k] / norm(d));
            }
        }
        (value, first)
    }

    /// The integrals seen from one point, one lane of them.
    fn seen(potential: &Potential, x: Vec3, lane: usize) -> (f64, Vec3) {
        dispatch!(Level::new(), simd => {
            let (value, first) = potential.at(x.map(|x| f64x4::splat(simd, x)));
            (value[lane], first.map(|f| f[lane]))
        })
    }

    #[test]
    fn exact_potential_agrees_with_a_fine_sum() {
        let points = [[0.1, 0.0, 0.2], [1.0, 0.3, 0.1], [0.2, 0.9, -0.3]];
        let potential = Potential::new(&panel(points));
        for x in [
            [0.3, 0.4, 0.6],
            [0.4, 0.4, -0.4],
            [2.0, -1.0, 0.3],
            [-0.5, 0.1, 0.2],
        ] {
            let (value, first) = seen(&potential, x, 0);
            let (want, moment) = brute_force(points, x);
            assert!((value - want).abs() < 1e-5 * want, "{x:?}");
            for k in 0..3 {
                assert!((first[k] - moment[k]).abs() < 1e-5 * want, "{x:?} {k}");
            }
        }
    }

    #[test]
    fn potential_in_the_plane_is_finite_and_known() {
        // At the corner of the right angle: integral of 1/r = sqrt(2) ln(1 + sqrt(2)).
        let potential = Potential::new(&right_triangle());
        let (value, _) = seen(&potential, [0.0; 3], 3);
        let want = 2f64.sqrt() * libm::log(1.0 + 2f64.sqrt());
        assert!((value - want).abs() < 1e-13);
    }

    #[test]
    fn self_term_is_near_the_closed_form() {
        // II 1/r over a triangle with itself: -(4/3) A^2 sum ln(1 - l/s) / l, s half the perimeter.
        let panel = right_triangle();
        let sides = [1.0, 1.0, 2f64.sqrt()];
        let s = 0.5 * sides.iter().sum::<f64>();
        let sum: f64 = sides.iter().map(|l| libm::log(1.0 - l / s) / l).sum();
        let want = -4.0 / 3.0 * 0.25 * sum;
        let potential = Potential::new(&panel);
        let seven = own(&potential, &Rule::seven()).p;
        assert!((seven / want - 1.0).abs() < 0.01, "{seven} {want}");
        let fine = own(&potential, &Rule::twenty_four()).p;
        assert!((fine / want - 1.0).abs() < 0.004, "{fine} {want}");
    }

    #[test]
    fn swapping_a_pair_swaps_its_moments() {
        let a = Potential::new(&right_triangle());
        let shifted = panel([[1.2, 0.1, 0.4], [0.3, 0.8, 0.5], [0.9, -0.7, 0.6]]);
        let b = Potential::new(&shifted);
        let (ab, ba) = (pair(&a, &b, &Rule::seven()), pair(&b, &a, &Rule::seven()));
        assert_eq!(ab, ba.swapped());
        assert!(ab.x != ab.y);
    }
}
