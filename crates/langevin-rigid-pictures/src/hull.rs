//! Outlines of what is on the page, as sixteen-sided polygons, to tell what covers what.

use crate::canvas::{Area, Point};

/// Unit directions across which two outlines may be seen to be apart.
const ACROSS: [Point; 8] = [
    [1.0, 0.0],
    [0.923_879_532_511_286_7, 0.382_683_432_365_089_8],
    [
        std::f64::consts::FRAC_1_SQRT_2,
        std::f64::consts::FRAC_1_SQRT_2,
    ],
    [0.382_683_432_365_089_8, 0.923_879_532_511_286_7],
    [0.0, 1.0],
    [-0.382_683_432_365_089_8, 0.923_879_532_511_286_7],
    [
        -std::f64::consts::FRAC_1_SQRT_2,
        std::f64::consts::FRAC_1_SQRT_2,
    ],
    [-0.923_879_532_511_286_7, 0.382_683_432_365_089_8],
];

/// The extent of some points along each direction, pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hull([[f64; 2]; ACROSS.len()]);

impl Hull {
    pub(super) fn of(points: impl Iterator<Item = Point>) -> Self {
        let mut extents = [[f64::INFINITY, f64::NEG_INFINITY]; ACROSS.len()];
        for [x, y] in points {
            for (extent, [u, v]) in extents.iter_mut().zip(ACROSS) {
                let along = u * x + v * y;
                *extent = [extent[0].min(along), extent[1].max(along)];
            }
        }
        Self(extents)
    }

    pub(super) fn of_area(Area { low, high }: &Area) -> Self {
        let corners = [*low, [high[0], low[1]], *high, [low[0], high[1]]];
        Self::of(corners.into_iter())
    }

    pub(super) fn grown(self, by: f64) -> Self {
        Self(self.0.map(|[low, high]| [low - by, high + by]))
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        let overlap = |(a, b): (&[f64; 2], &[f64; 2])| a[0] <= b[1] && b[0] <= a[1];
        self.0.iter().zip(&other.0).all(overlap)
    }

    /// The upright rectangle about the points.
    pub(super) fn area(&self) -> Area {
        let [x, y] = [self.0[0], self.0[ACROSS.len() / 2]];
        Area {
            low: [x[0], y[0]],
            high: [x[1], y[1]],
        }
    }

    /// Where the centre of a rectangle of the given half size is when it lies against the
    /// outline, `gap` away, along each direction and its opposite.
    pub(super) fn against(&self, half: Point, gap: f64) -> Vec<Point> {
        let centre = self.area().centre();
        let at = |[u, v]: Point, own: f64| {
            let reach = own + u.abs() * half[0] + v.abs() * half[1] + gap;
            [centre[0] + reach * u, centre[1] + reach * v]
        };
        let both = |([u, v], [low, high]): (Point, [f64; 2])| {
            let middle = u * centre[0] + v * centre[1];
            [at([u, v], high - middle), at([-u, -v], middle - low)]
        };
        ACROSS.into_iter().zip(self.0).flat_map(both).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossed_boxes_do_not_make_slanted_bars_meet() {
        let bar = |x: f64| Hull::of([[x, 0.0], [x + 10.0, 10.0]].into_iter());
        assert!(bar(0.0).area().meets(&bar(4.0).area()));
        assert!(!bar(0.0).meets(&bar(4.0)));
        // They are 4 / sqrt(2) apart.
        assert!(!bar(0.0).grown(2.8).meets(&bar(4.0)));
        assert!(bar(0.0).grown(2.9).meets(&bar(4.0)));
    }

    #[test]
    fn a_rectangle_against_an_outline_does_not_meet_it() {
        let hull = Hull::of([[0.0, 0.0], [30.0, 12.0], [5.0, 40.0]].into_iter());
        let half = [14.0, 6.0];
        let places = hull.against(half, 3.0);
        for centre in &places {
            let rectangle = Hull::of_area(&Area::about(*centre, half));
            assert!(!hull.grown(2.9).meets(&rectangle), "{centre:?}");
        }
        // Beside the rightmost point, 30, at the middle height.
        assert_eq!(places[0], [30.0 + 3.0 + 14.0, 20.0]);
    }
}
