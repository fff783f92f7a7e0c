//! The standard Runge-Kutta scheme of fourth order, as the paper uses it (section 6).

use crate::kirchhoff::Motion;
use crate::linalg::{Quat, Vec6, add_scaled, quat_mul, quat_normalize, rotate, split};

/// Rates of a [`Motion`].
struct Rate {
    velocity: [f64; 3],
    orientation: Quat,
    acceleration: Vec6,
}

/// One step of (R, x, xi) with xi' = `acceleration(motion, time)`.
pub(crate) fn step(
    motion: &mut Motion,
    time: f64,
    h: f64,
    acceleration: impl Fn(&Motion, f64) -> Vec6,
) {
    let rate = |m: &Motion, t: f64| Rate {
        velocity: rotate(m.orientation, split(&m.xi).0),
        orientation: spin(m.orientation, &m.xi),
        acceleration: acceleration(m, t),
    };
    let half = time + 0.5 * h;
    let k1 = rate(motion, time);
    let k2 = rate(&advance(motion, 0.5 * h, &k1), half);
    let k3 = rate(&advance(motion, 0.5 * h, &k2), half);
    let k4 = rate(&advance(motion, h, &k3), time + h);
    let mut end = advance(motion, h / 6.0, &k1);
    for (weight, k) in [(h / 3.0, &k2), (h / 3.0, &k3), (h / 6.0, &k4)] {
        end = advance(&end, weight, k);
    }
    end.orientation = quat_normalize(end.orientation);
    *motion = end;
}

/// q' = 1/2 q (omega, 0).
fn spin(q: Quat, xi: &Vec6) -> Quat {
    quat_mul(q, [0.5 * xi[3], 0.5 * xi[4], 0.5 * xi[5], 0.0])
}

fn advance(m: &Motion, h: f64, k: &Rate) -> Motion {
    Motion {
        position: add_scaled(m.position, h, k.velocity),
        orientation: std::array::from_fn(|i| m.orientation[i] + h * k.orientation[i]),
        xi: std::array::from_fn(|i| m.xi[i] + h * k.acceleration[i]),
        fluctuation: m.fluctuation,
    }
}
