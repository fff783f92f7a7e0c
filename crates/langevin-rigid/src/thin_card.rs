//! The two-dimensional thin card of Andersen, Pesavento & Wang (J. Fluid Mech. 541, 91-104, 2005) as
//! a judge of Kirchhoff's equations with loads of lift and drag.
//!
//! Lengths are half chords, forces net weights, masses those of the circle of fluid around the card.
//! Its loads are written with the added-mass tensor as the closure's are; its published eigenvalues
//! and regimes then hold the equations of motion, the tensor form and the signs of all couplings.

use crate::body::{Body, Separation, Surface};
use crate::fluid::Fluid;
use crate::kirchhoff::{Kirchhoff, Load, Motion};
use crate::linalg::{
    Mat3, Vec3, Vec6, add, add_scaled, cross, dot, join, mat_vec, norm, quat_from_rotation_vector,
    scale, split,
};

const PI: f64 = std::f64::consts::PI;
/// Coefficients of the publication: lift of translation and rotation, drag, damping.
const C_T: f64 = 1.2;
const C_R: f64 = PI;
const A: f64 = 1.4;
const B: f64 = 1.0;
const MU: f64 = 0.2;

/// The card of density ratio times thickness ratio I*, chord along x, thin along y; motion in x, y.
struct Card(Kirchhoff);

const ADDED: [f64; 3] = [0.0, 1.0, 0.0];

impl Card {
    fn new(inertia_ratio: f64) -> Self {
        let mut added_mass = [[0.0; 6]; 6];
        added_mass[1][1] = 1.0;
        added_mass[5][5] = 0.125;
        let turning = 0.25 * inertia_ratio;
        let volume = 1e-9;
        let body = Body {
            mass: inertia_ratio,
            inertia: [
                [turning, 0.0, 0.0],
                [0.0, turning, 0.0],
                [0.0, 0.0, turning],
            ],
            volume,
            centre_of_buoyancy: [0.0; 3],
            added_mass,
            half_extents: [1.0; 3],
            thickness: 1.0,
            length: 1.0,
            separation: Separation::default(),
            slices: vec![],
            surface: Surface::default(),
        };
        let fluid = Fluid {
            density: 1.0,
            viscosity: 0.0,
            velocity: [0.0; 3],
        };
        let gravity = [0.0, -1.0 / (inertia_ratio - volume), 0.0];
        Self(Kirchhoff::new(&body, &fluid, gravity).unwrap())
    }

    fn load(xi: &Vec6) -> Vec6 {
        let (v, omega) = split(xi);
        let speed = norm(v);
        let damping = scale(-MU * (1.0 + norm(omega)), omega);
        if speed == 0.0 {
            return join([0.0; 3], damping);
        }
        let added: Mat3 =
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { ADDED[i] } else { 0.0 }));
        let impulse = mat_vec(&added, v);
        // Perpendicular to v, with the circulation of translation.
        let across = add_scaled(scale(speed, impulse), -dot(v, impulse) / speed, v);
        let translation = scale(-2.0 * C_T / PI, across);
        let turned: Vec3 = std::array::from_fn(|i| (1.0 - ADDED[i]) * omega[i]);
        let rotation = scale(2.0 * C_R / PI, cross(turned, v));
        let along = (v[0] * v[0] - v[1] * v[1]) / (speed * speed);
        let drag = scale(-(A - B * along) * speed / PI, v);
        join(add(add(translation, rotation), drag), damping)
    }

    /// (v_x, v_y, omega, turn) after `steps` steps of `h`, seen on the way.
    fn run(&self, start: [f64; 4], h: f64, steps: usize, mut see: impl FnMut([f64; 4])) {
        let mut motion = Motion {
            position: [0.0; 3],
            orientation: quat_from_rotation_vector([0.0, 0.0, start[3]]),
            xi: [start[0], start[1], 0.0, 0.0, 0.0, start[2]],
            fluctuation: [0.0; 6],
        };
        let mut turn = start[3];
        for _ in 0..steps {
            let before = motion.xi[5];
            let statics = self.0.statics(None);
            self.0.step(&mut motion, h, &statics, |xi, _| {
                Some(Load {
                    force: Self::load(xi),
                    fed: 0.0,
                })
            });
            turn += 0.5 * h * (before + motion.xi[5]);
            // The quaternion knows the turn to rounding, the sum knows how often around.
            let [_, _, z, w] = motion.orientation;
            let within = 2.0 * z.atan2(w);
            turn = within + 2.0 * PI * ((turn - within) / (2.0 * PI)).round();
            see([motion.xi[0], motion.xi[1], motion.xi[5], turn]);
        }
    }

    fn end(&self, start: [f64; 4], time: f64) -> [f64; 4] {
        let mut end = start;
        self.run(start, time / 400.0, 400, |y| end = y);
        end
    }

    /// F if it swings within a half turn and a bit, T if it turns on and on, C otherwise; from long
    /// after a release a little off its edge.
    fn regime(&self) -> char {
        let (steps, h) = (80_000, 0.01);
        let mut seen = Vec::with_capacity(steps);
        self.run([-0.5, 0.0, 0.0, 1.0], h, steps, |y| seen.push(y));
        let late = &seen[steps / 2..];
        let (low, high) = late
            .iter()
            .fold((f64::MAX, f64::MIN), |(l, h), y| (l.min(y[3]), h.max(y[3])));
        let progress: Vec<f64> = late
            .chunks(steps / 8)
            .map(|c| c[c.len() - 1][3] - c[0][3])
            .collect();
        let onwards = |sign: f64| progress.iter().all(|turned| sign * turned > 2.0 * PI);
        match high - low {
            swing if swing < 1.5 * PI => 'F',
            _ if onwards(1.0) || onwards(-1.0) => 'T',
            _ => 'C',
        }
    }
}

/// Coefficients of the characteristic polynomial, the leading 1 left out (Faddeev, LeVerrier).
fn characteristic(m: &[[f64; 4]; 4]) -> [f64; 4] {
    let mut product = [[0.0; 4]; 4];
    let mut last = 1.0;
    std::array::from_fn(|k| {
        let mut shifted = product;
        for (i, row) in shifted.iter_mut().enumerate() {
            row[i] += last;
        }
        product = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..4).map(|n| m[i][n] * shifted[n][j]).sum())
        });
        last = -(0..4).map(|i| product[i][i]).sum::<f64>() / (k + 1) as f64;
        last
    })
}

#[test]
fn falling_on_its_edge_it_has_the_published_eigenvalues() {
    let card = Card::new(1.2191);
    // The chord along the fall: the +x end down, at the speed where drag is weight.
    let fall = [(PI / (A - B)).sqrt(), 0.0, 0.0, -0.5 * PI];
    let still = card.end(fall, 0.5);
    for (a, b) in fall.iter().zip(&still) {
        assert!(
            (a - b).abs() < 1e-9,
            "{fall:?} is no steady fall: {still:?}"
        );
    }
    let (time, small) = (0.5, 1e-5);
    let mut map = [[0.0; 4]; 4];
    for j in 0..4 {
        let moved = |by: f64| {
            let mut start = fall;
            start[j] += by;
            card.end(start, time)
        };
        let (ahead, behind) = (moved(small), moved(-small));
        for i in 0..4 {
            map[i][j] = (ahead[i] - behind[i]) / (2.0 * small);
        }
    }
    // Published: -0.9861 +- 2.5949 i, -0.5854, 0.3813; over a time t they become exp(lambda t).
    let (re, im) = (-0.9861 * time, 2.5949 * time);
    let [p, q] = [2.0 * re.exp() * im.cos(), (2.0 * re).exp()];
    let [a, b] = [(-0.5854 * time).exp(), (0.3813 * time).exp()];
    let (s, d) = (a + b, a * b);
    let wanted = [-(p + s), q + d + p * s, -(p * d + q * s), q * d];
    for (found, wanted) in characteristic(&map).iter().zip(wanted) {
        assert!((found - wanted).abs() < 2e-4, "{found} for {wanted}");
    }
}

#[test]
fn it_flutters_tumbles_and_wavers_where_published() {
    for (inertia_ratio, regime) in [
        (1.1, 'F'),
        (1.219, 'F'),
        (1.2192, 'T'),
        (1.4, 'T'),
        (1.45, 'T'),
        (1.6, 'C'),
        (2.2, 'C'),
        (3.0, 'F'),
    ] {
        let found = Card::new(inertia_ratio).regime();
        assert_eq!(found, regime, "I* {inertia_ratio}");
    }
}
