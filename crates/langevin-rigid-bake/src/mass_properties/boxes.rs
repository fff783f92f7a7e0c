//! Boxes along the axes, and what is left of one without another.

/// Lowest and highest corner.
pub(super) type Corners = [[f64; 3]; 2];

/// The box that two have in common, if it has a volume.
pub(super) fn common([a, b]: [&Corners; 2]) -> Option<Corners> {
    let low = [0, 1, 2].map(|k| a[0][k].max(b[0][k]));
    let high = [0, 1, 2].map(|k| a[1][k].min(b[1][k]));
    (0..3).all(|k| low[k] < high[k]).then_some([low, high])
}

/// Disjoint boxes, at most six, that fill `of` outside `hole`.
pub(super) fn without(of: Corners, hole: &Corners) -> Vec<Corners> {
    let Some(hole) = common([&of, hole]) else {
        return vec![of];
    };
    let (mut rest, mut left) = (of, Vec::new());
    for k in 0..3 {
        if rest[0][k] < hole[0][k] {
            let mut below = rest;
            below[1][k] = hole[0][k];
            left.push(below);
        }
        if hole[1][k] < rest[1][k] {
            let mut above = rest;
            above[0][k] = hole[1][k];
            left.push(above);
        }
        (rest[0][k], rest[1][k]) = (hole[0][k], hole[1][k]);
    }
    left
}
