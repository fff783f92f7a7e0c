//! The corner that is farthest along a direction, four corners at a time: what a search for the nearest points of two hulls
//! asks for most.

use parry3d_f64::math::Vector;

const LANES: usize = 4;

/// Points side by side; the last ones are filled up with the first.
#[derive(Debug, Clone)]
pub(crate) struct Lanes {
    packs: Vec<[[f64; LANES]; 3]>,
}

impl Lanes {
    pub(super) fn new(points: &[Vector]) -> Self {
        let pack = |some: &[Vector]| {
            let at = |lane: usize| some.get(lane).unwrap_or(&points[0]).to_array();
            std::array::from_fn(|axis| std::array::from_fn(|lane| at(lane)[axis]))
        };
        Self {
            packs: points.chunks(LANES).map(pack).collect(),
        }
    }

    /// The first of the points farthest along `direction`.
    pub(super) fn farthest(&self, direction: Vector) -> usize {
        let [x, y, z] = direction.to_array();
        let mut most = [f64::NEG_INFINITY; LANES];
        let mut which = [0u64; LANES];
        for (number, [xs, ys, zs]) in (0u64..).zip(&self.packs) {
            for lane in 0..LANES {
                let along = xs[lane] * x + ys[lane] * y + zs[lane] * z;
                let more = along > most[lane];
                most[lane] = if more { along } else { most[lane] };
                which[lane] = if more { number } else { which[lane] };
            }
        }
        let place = |lane: usize| which[lane] as usize * LANES + lane;
        let better = |a: usize, b: usize| {
            let first = most[b] == most[a] && place(b) < place(a);
            if most[b] > most[a] || first { b } else { a }
        };
        place((1..LANES).fold(0, better))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_first_of_the_farthest() {
        for count in 1..40 {
            let point = |i: usize| {
                let turn = 2.4 * i as f64;
                Vector::new(turn.sin(), (3.0 * turn).cos(), (i % 3) as f64)
            };
            let points: Vec<Vector> = (0..count).map(point).collect();
            let lanes = Lanes::new(&points);
            for k in 0..20 {
                // Along z many are equal.
                let direction = match k {
                    0 => Vector::Z,
                    1 => -Vector::Z,
                    _ => point(7 * k + 1),
                };
                let mut first = 0;
                for (i, point) in points.iter().enumerate() {
                    if point.dot(direction) > points[first].dot(direction) {
                        first = i;
                    }
                }
                assert_eq!(lanes.farthest(direction), first, "{count} {k}");
            }
        }
    }
}
