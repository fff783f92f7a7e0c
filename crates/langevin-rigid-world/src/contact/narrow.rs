//! Where two hulls are close: the nearest points, and the area around them where faces lie on each other.

use arrayvec::ArrayVec;
use parry3d_f64::math::{Pose, Vec2, Vector};
use parry3d_f64::query::details::contact_support_map_support_map_with_params;
use parry3d_f64::query::gjk::{GJKResult, VoronoiSimplex};

use super::overlap::{Polygon, overlap};
use super::{MOST_POINTS, Patch, Point};
use crate::obstacle::Triangle;
use crate::shape::{Face, Hull, OUTLINE, Scaled};

/// Points that hold two faces on each other.
const BETWEEN_FACES: usize = 4;

/// A face lies along a contact if its normal is within this cosine of the contact's.
const ALONG: f64 = 0.5;

/// Bodies that overlap keep their normal unless it stays within this cosine of itself.
const SAME: f64 = 0.5;

/// Differences of distances that are rounding, in sizes of a body.
const ROUNDING: f64 = 1e-9;

/// A hull and where it is.
#[derive(Clone, Copy)]
pub(crate) struct Placed<'a> {
    pub(crate) hull: &'a Hull,
    pub(crate) pose: Pose,
    /// A length of its size (m).
    pub(crate) size: f64,
}

/// Two hulls closer than `reach` (m). `before` is the normal of the step before, if they touched.
pub(crate) fn hulls(
    a: Placed<'_>,
    b: Placed<'_>,
    reach: f64,
    before: Option<Vector>,
) -> Option<Patch> {
    let found = nearest(a, b, reach, before)?;
    let nearest = refined(a, b, found, before);
    Some(patch(a, b, nearest, reach))
}

/// The nearest points along the normal that sets the hulls farthest apart: the one found, or that of a face at it.
///
/// Where hulls all but touch, the direction between their nearest points is lost in rounding; those of faces are exact.
fn refined(a: Placed<'_>, b: Placed<'_>, found: Nearest, before: Option<Vector>) -> Nearest {
    let normal = found.normal;
    let of_a = a.pose.rotation
        * a.hull
            .face_towards(a.pose.rotation.inverse() * normal)
            .normal;
    let of_b = b.pose.rotation
        * b.hull
            .face_towards(b.pose.rotation.inverse() * -normal)
            .normal;
    // The way out of a thin body must not lead through it.
    let before = before.filter(|_| found.gap < 0.0);
    let same = |normal: &Vector| before.is_none_or(|before| normal.dot(before) > SAME);
    let candidates = [Some(normal), Some(of_a), Some(-of_b), before];
    let widest = candidates
        .into_iter()
        .flatten()
        .filter(same)
        .map(|normal| along(a, b, normal))
        .reduce(|best, next| {
            if next.gap > best.gap + ROUNDING * b.size {
                next
            } else {
                best
            }
        });
    match widest {
        Some(widest) if widest.gap < found.gap || widest.normal != normal => widest,
        _ => found,
    }
}

/// A triangle of an obstacle and a hull closer than `reach` (m).
pub(crate) fn triangle(triangle: &Triangle, b: Placed<'_>, reach: f64) -> Option<Patch> {
    let hull = triangle.hull();
    let a = Placed {
        hull: &hull,
        pose: Pose::IDENTITY,
        size: b.size,
    };
    let mut nearest = nearest(a, b, reach, Some(triangle.normal))?;
    // From behind nothing is held.
    if nearest.normal.dot(triangle.normal) <= 1e-3 {
        return None;
    }
    if !triangle.lets_be(nearest.on_a, 1e-6 * b.size) {
        nearest.normal = triangle.normal;
        nearest.gap = (nearest.on_b - nearest.on_a).dot(nearest.normal);
    }
    Some(patch(a, b, nearest, reach))
}

/// A half-space and a hull with corners closer to it than `reach` (m).
pub(crate) fn half_space(normal: Vector, offset: f64, b: Placed<'_>, reach: f64) -> Option<Patch> {
    let along = b.pose.rotation.inverse() * normal;
    let height = b.pose.translation.dot(normal) - offset;
    let near = b.hull.points.iter().filter_map(|point| {
        let gap = height + point.dot(along);
        (gap <= reach).then(|| {
            let on_b = b.pose * *point;
            Point {
                on_a: on_b - normal * gap,
                on_b,
                gap,
            }
        })
    });
    let near: Vec<Point> = near.collect();
    (!near.is_empty()).then(|| Patch {
        normal,
        points: spread(&near, MOST_POINTS),
    })
}

impl Triangle {
    /// Whether the surface can be met at this point in another direction than its normal's: on a ridge.
    fn lets_be(&self, point: Vector, slack: f64) -> bool {
        (0..3).any(|k| {
            let (from, to) = (self.corners[k], self.corners[(k + 1) % 3]);
            let along = (to - from).normalize_or_zero();
            let away = (point - from) - along * (point - from).dot(along);
            self.ridges[k] && away.length() <= slack
        })
    }
}

/// The nearest two points.
#[derive(Clone, Copy)]
struct Nearest {
    normal: Vector,
    on_a: Vector,
    on_b: Vector,
    gap: f64,
}

/// `guess` is a direction near the normal.
fn nearest(a: Placed<'_>, b: Placed<'_>, reach: f64, guess: Option<Vector>) -> Option<Nearest> {
    // In units of the smaller one, as the tolerances of the library are absolute.
    let unit = a.size.min(b.size);
    let factor = 1.0 / unit;
    let mut b_in_a = a.pose.inv_mul(&b.pose);
    b_in_a.translation *= factor;
    let of_a = Scaled {
        hull: a.hull,
        factor,
    };
    let of_b = Scaled {
        hull: b.hull,
        factor,
    };
    let found = contact_support_map_support_map_with_params(
        &b_in_a,
        &of_a,
        &of_b,
        reach * factor,
        &mut VoronoiSimplex::new(),
        guess.map(|normal| a.pose.rotation.inverse() * normal),
    );
    let GJKResult::ClosestPoints(p, q, direction) = found else {
        return None;
    };
    let normal = a.pose.rotation * direction;
    let gap = (q - p).dot(direction) * unit;
    let found = gap <= reach && normal.is_finite();
    found.then(|| Nearest {
        normal,
        on_a: a.pose * (p * unit),
        on_b: a.pose * (q * unit),
        gap,
    })
}

/// The points that are deepest in each other along `normal`.
fn along(a: Placed<'_>, b: Placed<'_>, normal: Vector) -> Nearest {
    let farthest = |placed: Placed<'_>, direction: Vector| {
        let towards = placed.pose.rotation.inverse() * direction;
        placed.pose * placed.hull.farthest(towards)
    };
    let (on_a, on_b) = (farthest(a, normal), farthest(b, -normal));
    Nearest {
        normal,
        on_a,
        on_b,
        gap: (on_b - on_a).dot(normal),
    }
}

/// The points around the nearest ones.
fn patch(a: Placed<'_>, b: Placed<'_>, nearest: Nearest, reach: f64) -> Patch {
    let Nearest {
        normal,
        on_a,
        on_b,
        gap,
    } = nearest;
    let mut points: ArrayVec<Point, { 2 * OUTLINE + 1 }> = ArrayVec::new();
    let face_a = a.hull.face_towards(a.pose.rotation.inverse() * normal);
    let face_b = b.hull.face_towards(b.pose.rotation.inverse() * -normal);
    let (up_a, up_b) = (
        a.pose.rotation * face_a.normal,
        b.pose.rotation * face_b.normal,
    );
    if up_a.dot(normal) > ALONG && up_b.dot(normal) < -ALONG {
        let (across, along) = normal.any_orthonormal_pair();
        let flat = |p: Vector| Vec2::new((p - on_a).dot(across), (p - on_a).dot(along));
        let outline = |face: &Face, pose: &Pose| -> Polygon {
            face.outline.iter().map(|p| flat(*pose * *p)).collect()
        };
        let of_a = outline(face_a, &a.pose);
        let mut of_b = outline(face_b, &b.pose);
        of_b.reverse();
        // Height of a face's plane over the nearest point of the first, along the normal.
        let plane = |face: &Face, pose: &Pose, up: Vector| {
            let level = up.dot(*pose * face.outline[0] - on_a);
            move |p: Vec2| (level - up.dot(across * p.x + along * p.y)) / up.dot(normal)
        };
        let (under, over) = (plane(face_a, &a.pose, up_a), plane(face_b, &b.pose, up_b));
        for p in overlap(&of_a, &of_b) {
            let (low, high) = (under(p), over(p));
            if high - low <= reach {
                let at = |height: f64| on_a + across * p.x + along * p.y + normal * height;
                points.push(Point {
                    on_a: at(low),
                    on_b: at(high),
                    gap: high - low,
                });
            }
        }
    }
    // Where faces lie on each other their corners hold them; one point more would cost one of these its place.
    let lowest = points
        .iter()
        .map(|point| point.gap)
        .fold(f64::INFINITY, f64::min);
    if gap < lowest - 1e-6 * a.size.min(b.size) {
        points.push(Point { on_a, on_b, gap });
    }
    Patch {
        normal,
        points: spread(&points, BETWEEN_FACES),
    }
}

/// So many of the points at most: the nearest, and those farthest from each other.
fn spread(points: &[Point], most: usize) -> ArrayVec<Point, MOST_POINTS> {
    let mut chosen = ArrayVec::new();
    if points.len() <= most {
        chosen.extend(points.iter().copied());
        return chosen;
    }
    let mut first = 0;
    for (i, point) in points.iter().enumerate() {
        if point.gap < points[first].gap {
            first = i;
        }
    }
    let mut away = vec![f64::INFINITY; points.len()];
    let mut next = first;
    while chosen.len() < most {
        chosen.push(points[next]);
        for (away, point) in away.iter_mut().zip(points) {
            *away = away.min(point.on_b.distance_squared(points[next].on_b));
        }
        for (i, far) in away.iter().enumerate() {
            if *far > away[next] {
                next = i;
            }
        }
        if away[next] <= 0.0 {
            break;
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    #[test]
    fn a_box_on_a_box_has_four_points() {
        let shape = Shape::cuboid([0.1, 0.015, 0.07]).unwrap();
        let placed = |y: f64, turn: f64| Placed {
            hull: &shape.hulls()[0],
            pose: Pose::new(Vector::new(0.002, y, 0.0), Vector::new(0.0, turn, 0.0)),
            size: shape.radius(),
        };
        for turn in [0.0, 0.3, 1.0] {
            let patch = hulls(placed(0.0, 0.0), placed(0.0301, turn), 1e-3, None).unwrap();
            assert!(
                (patch.normal - Vector::Y).length() < 1e-9,
                "{}",
                patch.normal
            );
            assert_eq!(patch.points.len(), 4);
            for point in &patch.points {
                assert!((point.gap - 1e-4).abs() < 1e-12);
            }
            let first = patch.points[0].on_b;
            let away = patch.points.iter().map(|point| point.on_b.distance(first));
            let longest = away.fold(0.0, f64::max);
            assert!(longest > 0.15, "{longest}");
        }
    }
}
