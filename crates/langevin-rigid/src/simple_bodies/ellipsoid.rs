//! Ellipsoids, from closed forms of the flow around them.

use std::f64::consts::{FRAC_PI_2, PI};

use super::slices::Slices;
use super::{Form, diagonal, mean_where_degenerate, surface};
use crate::body::Slice;
use crate::carlson::rd;
use crate::linalg::Vec3;
use crate::wake::{SLIP_QUANTILE, Wake};

/// Steps of the drag's quadrature, along and around.
const STEPS: usize = 48;

/// The ellipsoid with these semi-axes (m).
pub(super) fn form(semi_axes: Vec3) -> Form {
    let flow = Flow::around(semi_axes);
    let [a, b, c] = semi_axes;
    let half_extents = mean_where_degenerate(
        semi_axes.map(|h| h * h),
        semi_axes,
        |i, j| 0.5 * (semi_axes[i] + semi_axes[j]),
        (a + b + c) / 3.0,
    );
    let pressure = [0, 1, 2].map(|axis| flow.pressure(axis));
    let drag = |p: &Vec<Load>| p.iter().map(|load| load.drag).sum();
    Form {
        volume: flow.volume(),
        mean_squares: semi_axes.map(|h| h * h / 5.0),
        added_mass: std::array::from_fn(|i| {
            if i < 3 {
                flow.translation(i)
            } else {
                flow.rotation(i - 3)
            }
        }),
        half_extents,
        thickness: 2.0 * a.min(b).min(c),
        drag_areas: pressure.each_ref().map(drag),
        slices: Slices::of(half_extents, semi_axes)
            .map_or(vec![], |slices| flow.slices(&slices, &pressure)),
        surface: surface::ellipsoid(semi_axes),
    }
}

/// Potential flow around an ellipsoid (Lamb 1932, articles 114 and 115).
struct Flow {
    semi_axes: Vec3,
    /// Potential of the motion along axis i at x on the surface, over -x_i: the added mass over the displaced fluid's.
    translation: Vec3,
    /// Potential of the rotation about axis i, over x_j x_k of the axes that follow it.
    rotation: Vec3,
}

/// A place on the surface with the drag that it takes; it stands for its mirror images too.
struct Load {
    place: Vec3,
    drag: f64,
}

/// A place on the surface.
struct Point {
    place: Vec3,
    /// Component of the unit normal along the axis.
    facing: f64,
    /// Area, and area of the silhouette, in units that are the same for all points.
    area: f64,
    silhouette: f64,
}

impl Flow {
    fn around(semi_axes: Vec3) -> Self {
        let s = semi_axes.map(|h| h * h);
        let product: f64 = semi_axes.iter().product();
        // alpha, beta and gamma.
        let integrals: Vec3 =
            std::array::from_fn(|i| 2.0 / 3.0 * product * rd(s[(i + 1) % 3], s[(i + 2) % 3], s[i]));
        let rotation = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let (difference, sum) = (s[j] - s[k], s[j] + s[k]);
            if difference.abs() <= 1e-9 * sum {
                return 0.0;
            }
            let asymmetry = integrals[k] - integrals[j];
            -difference * asymmetry / (2.0 * difference - sum * asymmetry)
        };
        Self {
            semi_axes,
            translation: integrals.map(|i| i / (2.0 - i)),
            rotation: [0, 1, 2].map(rotation),
        }
    }

    fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.semi_axes.iter().product::<f64>()
    }

    fn translation(&self, i: usize) -> f64 {
        self.volume() * self.translation[i]
    }

    fn rotation(&self, i: usize) -> f64 {
        let [b, c] = [1, 2].map(|n| self.semi_axes[(i + n) % 3]);
        -self.volume() / 5.0 * (b * b - c * c) * self.rotation[i]
    }

    /// Points of an eighth of the surface, as the unit sphere's at even steps along `axis` and around it.
    fn points(&self, axis: usize) -> Vec<Point> {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let step = |n: usize| (n as f64 + 0.5) / STEPS as f64;
        let point = |along: f64, angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            let across = (1.0 - along * along).sqrt();
            let mut unit = [0.0; 3];
            (unit[axis], unit[j], unit[k]) = (along, across * cos, across * sin);
            let h = self.semi_axes;
            let normal: Vec3 = std::array::from_fn(|i| unit[i] / h[i]);
            let area = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            Point {
                place: std::array::from_fn(|i| h[i] * unit[i]),
                facing: normal[axis] / area,
                area,
                silhouette: normal[axis],
            }
        };
        (0..STEPS)
            .flat_map(|m| (0..STEPS).map(move |n| (step(m), FRAC_PI_2 * step(n))))
            .map(|(along, angle)| point(along, angle))
            .collect()
    }

    /// The drag of the motion along `axis`, place by place.
    fn pressure(&self, axis: usize) -> Vec<Load> {
        let mut points = self.points(axis);
        points.sort_by(|a, b| b.facing.total_cmp(&a.facing));
        let [p, q] = [1, 2].map(|n| self.semi_axes[(axis + n) % 3]);
        // The fluid slips along -e_t: (1 + share k)^2 (1 - facing^2) is the square.
        let slip = |share: f64, facing: f64| {
            let speed = 1.0 + share * self.translation[axis];
            speed * speed * (1.0 - facing * facing)
        };
        let least = least_facing(&points);
        let wake = Wake::new((p / q).max(q / p), |share| slip(share, least));
        let total: f64 = points.iter().map(|point| point.silhouette).sum();
        let unit = PI * p * q / total;
        let drop = |facing| wake.pressure_drop(slip(wake.potential_share(), facing));
        points
            .into_iter()
            .map(|point| Load {
                place: point.place,
                drag: unit * point.silhouette * drop(point.facing),
            })
            .collect()
    }

    fn slices(&self, slices: &Slices, pressure: &[Vec<Load>; 3]) -> Vec<Slice> {
        let points = self.points(slices.axis);
        (0..slices.count)
            .map(|k| Slice {
                drag_area: diagonal(pressure.each_ref().map(|loads| {
                    let of = |load: &Load| load.drag * mirrored_share(slices, k, load.place);
                    loads.iter().map(of).sum()
                })),
                extents: diagonal(
                    slices.thin(self.slice_extents(slices, k, &points), self.semi_axes),
                ),
                ..self.slice_loads(slices, k)
            })
            .collect()
    }

    /// Three times the mean squares over the surface of a slice, which for a plate are its squared half-chord; along the
    /// body the body's half-length.
    fn slice_extents(&self, slices: &Slices, k: usize, points: &[Point]) -> Vec3 {
        let weight = |p: &Point| p.area * mirrored_share(slices, k, p.place);
        let total: f64 = points.iter().map(weight).sum();
        std::array::from_fn(|i| {
            if i == slices.axis {
                return slices.half_length * slices.half_length;
            }
            let second: f64 = points
                .iter()
                .map(|p| weight(p) * p.place[i] * p.place[i])
                .sum();
            3.0 * second / total
        })
    }

    /// Centre and added mass of a slice: the integrals over the surface of its share s of -phi n, which Gauss's
    /// theorem turns into integrals over the length.
    fn slice_loads(&self, slices: &Slices, k: usize) -> Slice {
        let l = slices.axis;
        let (m, n) = ((l + 1) % 3, (l + 2) % 3);
        let [a, b, c] = [l, m, n].map(|i| self.semi_axes[i]);
        let [along, mm, nn] = [l, m, n].map(|i| self.translation[i]);
        // Area of the section, and the mean squares across in it.
        let left = |x: f64| (1.0 - x * x / (a * a)).max(0.0);
        let section = |x: f64| PI * b * c * left(x);
        let [m2, n2] = [b, c].map(|h| move |x: f64| 0.25 * h * h * left(x));
        let integral = |f: &dyn Fn(f64, f64, f64) -> f64| {
            slices.integral(k, |x, s, slope| f(x, s, slope) * section(x))
        };
        let volume = integral(&|_, s, _| s);
        let axial = along * integral(&|x, s, slope| s + slope * x);
        let first = (mm + nn) * integral(&|x, s, _| s * x)
            + along * integral(&|x, s, slope| 2.0 * s * x + slope * x * x);
        let centre = first / ((mm + nn) * volume + axial);
        let (mut translation, mut rotation) = ([0.0; 3], [0.0; 3]);
        (translation[l], translation[m], translation[n]) = (axial, mm * volume, nn * volume);
        rotation[l] = -self.rotation[l] * integral(&|x, s, _| s * (m2(x) - n2(x)));
        // The potentials about the slice's own centre are g z and g y.
        let (dm, dn) = (self.rotation[m], self.rotation[n]);
        let about_m = |x: f64| dm * x - nn * centre;
        let about_n = |x: f64| dn * x + mm * centre;
        rotation[m] = -integral(&|x, s, slope| {
            (slope * about_m(x) + s * dm) * n2(x) - s * about_m(x) * (x - centre)
        });
        rotation[n] = integral(&|x, s, slope| {
            (slope * about_n(x) + s * dn) * m2(x) - s * about_n(x) * (x - centre)
        });
        Slice {
            centre: slices.at(centre),
            translation: diagonal(translation.map(|t: f64| t.max(0.0))),
            rotation: diagonal(rotation.map(|r: f64| r.max(0.0))),
            ..Slice::default()
        }
    }
}

/// The facing that all but a sliver of the surface exceeds; `points` by descending facing.
fn least_facing(points: &[Point]) -> f64 {
    let wanted = SLIP_QUANTILE * points.iter().map(|p| p.area).sum::<f64>();
    let mut above = 0.0;
    let reaches = |p: &&Point| {
        above += p.area;
        above >= wanted
    };
    points.iter().find(reaches).map_or(0.0, |p| p.facing)
}

/// The share of slice `k` in a place and its mirror image along the body.
fn mirrored_share(slices: &Slices, k: usize, place: Vec3) -> f64 {
    let x = place[slices.axis];
    0.5 * (slices.share(k, x) + slices.share(k, -x))
}
