//! Slices of a long body by the rule of the bake.
//!
//! A body at least twice as long as wide is cut across its long axis. Slices overlap: a linear ramp leads
//! from one to the next, which keeps first moments exact.

use super::diagonal;
use crate::body::Slice;
use crate::linalg::Vec3;

/// Length over width from which a body is cut.
const LONG: f64 = 2.0;
/// Most slices of a body.
const MOST: usize = 8;
/// Steps of the midpoint rule in half a slice.
const STEPS: usize = 32;

/// Where the slices of a body are.
pub(super) struct Slices {
    /// The axis along the body, 0 to 2.
    pub(super) axis: usize,
    /// Half the length of the body (m).
    pub(super) half_length: f64,
    pub(super) count: usize,
}

/// The moments of a load along the body, times a slice's share of it.
#[derive(Clone, Copy, Default)]
pub(super) struct Moments {
    pub(super) sum: f64,
    pub(super) first: f64,
    pub(super) second: f64,
}

impl Moments {
    pub(super) fn scaled(self, s: f64) -> Self {
        Self {
            sum: s * self.sum,
            first: s * self.first,
            second: s * self.second,
        }
    }

    /// The second moment about `x`.
    fn about(&self, x: f64) -> f64 {
        self.second - 2.0 * x * self.first + x * x * self.sum
    }
}

impl Slices {
    /// Squared half-extents of a slice from the second moments of its surface, which are right for the chord of a plate
    /// and too large for its thickness: that is the chord by the ratio of the `half` axes.
    pub(super) fn thin(&self, mut extents: Vec3, half: Vec3) -> Vec3 {
        let [u, v] = [(self.axis + 1) % 3, (self.axis + 2) % 3];
        let (thin, wide) = if half[u] < half[v] { (u, v) } else { (v, u) };
        let ratio = half[thin] / half[wide];
        extents[thin] = extents[thin].min(extents[wide] * ratio * ratio);
        extents
    }

    /// `None` for a body that moves as one; `extents` are its [`half_extents`](super::Form::half_extents), `half` the true ones.
    pub(super) fn of(extents: Vec3, half: Vec3) -> Option<Self> {
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| extents[j].total_cmp(&extents[i]));
        let [axis, second, _] = order;
        let ratio = extents[axis] / extents[second];
        (ratio >= LONG).then(|| Self {
            axis,
            half_length: half[axis],
            count: (ratio.round() as usize).min(MOST),
        })
    }

    /// From middle to middle (m).
    pub(super) fn pitch(&self) -> f64 {
        2.0 * self.half_length / self.count as f64
    }

    /// The share of slice `k` in what is at `x` along the body.
    pub(super) fn share(&self, k: usize, x: f64) -> f64 {
        let last = (self.count - 1) as f64;
        let at = ((x + self.half_length) / self.pitch() - 0.5).clamp(0.0, last);
        (1.0 - (at - k as f64).abs()).max(0.0)
    }

    /// The integral along the body of `f`, a function of the place, slice `k`'s share and the slope of this.
    pub(super) fn integral(&self, k: usize, f: impl Fn(f64, f64, f64) -> f64) -> f64 {
        let step = 0.5 * self.pitch() / STEPS as f64;
        let at = |n: usize| -self.half_length + step * (n as f64 + 0.5);
        (0..2 * STEPS * self.count)
            .map(|n| {
                let x = at(n);
                // Midpoints never lie on a corner of the ramp.
                let slope = (self.share(k, x + 0.25 * step) - self.share(k, x - 0.25 * step))
                    / (0.5 * step);
                step * f(x, self.share(k, x), slope)
            })
            .sum()
    }

    fn is_end(&self, k: usize) -> bool {
        k == 0 || k + 1 == self.count
    }

    /// The middle of slice `k` as a vector, `x` along the body.
    pub(super) fn at(&self, x: f64) -> Vec3 {
        let mut centre = [0.0; 3];
        centre[self.axis] = x;
        centre
    }
}

/// What the slices of a body with flat ends and a constant section depend on.
pub(super) struct Straight {
    /// Added mass of the body: three translations, three rotations (m^3, m^5).
    pub(super) added_mass: [f64; 6],
    /// Drag areas of the body (m^2).
    pub(super) drag_areas: Vec3,
    /// Half the size of the section along each axis (m); that along the body is not used.
    pub(super) half: Vec3,
    /// Share of the added mass that is missing at an end.
    pub(super) end_loss: f64,
}

impl Straight {
    /// The slices. Motion along the body loads the ends only; across it the added mass per length falls
    /// off towards the ends, within about the half-width of the face that is met.
    ///
    /// `mean_square(axis, end)` is the mean square height (m^2) of the surface of a slice, with
    /// the body's end or without.
    pub(super) fn slices(
        &self,
        slices: &Slices,
        mean_square: impl Fn(usize, bool) -> f64,
    ) -> Vec<Slice> {
        let along = slices.axis;
        let across = [(along + 1) % 3, (along + 2) % 3];
        let loads = across.map(|axis| self.loads(slices, axis, across[0] + across[1] - axis));
        (0..slices.count)
            .map(|k| {
                let end = slices.is_end(k);
                let side = if 2 * k < slices.count { -1.0 } else { 1.0 };
                let axial = if end {
                    0.5 * self.added_mass[along]
                } else {
                    0.0
                };
                let [u, v] = loads.each_ref().map(|l| l[k]);
                let first = u.first + v.first + side * axial * slices.half_length;
                let centre = first / (u.sum + v.sum + axial);
                let (mut translation, mut rotation) = ([0.0; 3], [0.0; 3]);
                let (mut drag, mut extents) = ([0.0; 3], [0.0; 3]);
                translation[along] = axial;
                rotation[along] = self.added_mass[3 + along] / slices.count as f64;
                drag[along] = if end {
                    0.5 * self.drag_areas[along]
                } else {
                    0.0
                };
                extents[along] = slices.half_length * slices.half_length;
                for (axis, other, load) in [(across[0], across[1], u), (across[1], across[0], v)] {
                    translation[axis] = load.sum;
                    rotation[other] = load.about(centre);
                    drag[axis] = self.drag_areas[axis] / slices.count as f64;
                    extents[axis] = 3.0 * mean_square(axis, end);
                }
                Slice {
                    centre: slices.at(centre),
                    translation: diagonal(translation),
                    rotation: diagonal(rotation),
                    drag_area: diagonal(drag),
                    extents: diagonal(slices.thin(extents, self.half)),
                }
            })
            .collect()
    }

    /// Each slice's share of the added mass of a motion along `axis`, across the body; `other` is across both.
    fn loads(&self, slices: &Slices, axis: usize, other: usize) -> Vec<Moments> {
        let reach = self.half[other] + 0.2 * self.half[axis];
        let h = slices.half_length;
        let density = |x: f64| {
            1.0 - self.end_loss * (libm::exp((x - h) / reach) + libm::exp((-x - h) / reach))
        };
        let moments = |k: usize| Moments {
            sum: slices.integral(k, |x, share, _| share * density(x)),
            first: slices.integral(k, |x, share, _| share * density(x) * x),
            second: slices.integral(k, |x, share, _| share * density(x) * x * x),
        };
        let all: Vec<Moments> = (0..slices.count).map(moments).collect();
        let scale = self.added_mass[axis] / all.iter().map(|m| m.sum).sum::<f64>();
        all.into_iter().map(|m| m.scaled(scale)).collect()
    }
}
