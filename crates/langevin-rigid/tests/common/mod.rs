//! Bodies with tensors in closed form.
#![allow(dead_code, reason = "every test file uses its own share of these")]

use langevin_rigid::linalg::vector::{norm, sub};
use langevin_rigid::{Body, Separation, Surface, TurbulenceHistory};

/// Lamb's integrals kappa_i of an ellipsoid, by the midpoint rule in u with L = c^2 (u/(1-u))^2.
fn kappa(axes: [f64; 3]) -> [f64; 3] {
    const N: usize = 200_000;
    let c = axes.iter().copied().fold(0.0, f64::max);
    let product: f64 = axes.iter().product();
    let mut kappa = [0.0; 3];
    for n in 0..N {
        let u = (n as f64 + 0.5) / N as f64;
        let w = u / (1.0 - u);
        let l = c * c * w * w;
        let dl = 2.0 * c * c * w / ((1.0 - u) * (1.0 - u)) / N as f64;
        let root: f64 = axes.iter().map(|r| (r * r + l).sqrt()).product();
        for i in 0..3 {
            kappa[i] += product * dl / ((axes[i] * axes[i] + l) * root);
        }
    }
    kappa
}

/// A homogeneous ellipsoid: Lamb's added mass (1932, articles 114 and 115), exact inertia.
pub(crate) fn ellipsoid(axes: [f64; 3], density: f64) -> Body {
    let volume = 4.0 / 3.0 * std::f64::consts::PI * axes[0] * axes[1] * axes[2];
    let mass = density * volume;
    let kappa = kappa(axes);
    let (mut added_mass, mut inertia) = ([[0.0; 6]; 6], [[0.0; 3]; 3]);
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (rj, rk) = (axes[j] * axes[j], axes[k] * axes[k]);
        added_mass[i][i] = volume * kappa[i] / (2.0 - kappa[i]);
        let (difference, sum) = (rj - rk, rj + rk);
        let rotation = difference * difference * (kappa[k] - kappa[j])
            / (2.0 * difference + sum * (kappa[j] - kappa[k]));
        added_mass[3 + i][3 + i] = if difference == 0.0 {
            0.0
        } else {
            volume / 5.0 * rotation
        };
        inertia[i][i] = mass / 5.0 * sum;
    }
    let mut half_extents = axes;
    half_extents.sort_by(|a, b| b.total_cmp(a));
    Body {
        mass,
        inertia,
        volume,
        centre_of_buoyancy: [0.0; 3],
        added_mass,
        half_extents,
        thickness: 2.0 * half_extents[2],
        length: 2.0 * half_extents[0],
        separation: separation(axes),
        slices: vec![],
        surface: Surface::default(),
    }
}

/// Half the silhouette as drag area.
fn separation(axes: [f64; 3]) -> Separation {
    let mut tensors = Separation::default();
    for i in 0..3 {
        let silhouette = std::f64::consts::PI * axes[(i + 1) % 3] * axes[(i + 2) % 3];
        tensors.drag_area[i][i] = 0.5 * silhouette;
        tensors.extents[i][i] = axes[i] * axes[i];
    }
    tensors
}

/// A body with no symmetry at all: every block of its tensors is full.
pub(crate) fn chiral() -> Body {
    let mut body = ellipsoid([0.02, 0.03, 0.05], 800.0);
    // A congruence keeps the tensor symmetric and positive definite and fills its couplings.
    let mix: [[f64; 6]; 6] = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let scale = [1.0, 0.03][i / 3] / [1.0, 0.03][j / 3];
            f64::from(i == j) + 0.3 * scale * libm::sin((5 * i + 3 * j + 1) as f64)
        })
    });
    let a = body.added_mass;
    let mut full = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..6 {
            for k in 0..6 {
                full[i][j] += mix[i][k] * a[k][k] * mix[j][k];
            }
        }
    }
    body.added_mass =
        std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (full[i][j] + full[j][i])));
    body
}

/// Turbulence that never changes: one entry, held.
pub(crate) fn frozen(k: f64, epsilon: f64) -> TurbulenceHistory {
    TurbulenceHistory {
        interval: 1.0,
        inflow_speed: 1.0,
        length: 0.01,
        k: vec![k],
        epsilon: vec![epsilon],
    }
}

pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(sub(a, b))
}
