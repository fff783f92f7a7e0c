//! The sphere's drag curve, and the fall of thick bodies beside drag correlations.

use std::f64::consts::PI;

use langevin_rigid::{Body, Fluid, Input, NoiseStream, State};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::shapes::Shape;
use rayon::prelude::*;

use super::drop::{baked, between, fall, mean, stepper, turned};
use crate::error::ReportError;
use crate::options::Options;
use crate::section::Section;

const REYNOLDS: [f64; 13] = [
    0.1, 1.0, 10.0, 30.0, 100.0, 300.0, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5,
];

/// Clift & Gauvin (1971), within 6 % of measured spheres below Re 3e5.
fn standard_curve(re: f64) -> f64 {
    let rise = 0.42 / (1.0 + 42_500.0 * libm::pow(re, -1.16));
    24.0 / re * (1.0 + 0.15 * libm::pow(re, 0.687)) + rise
}

pub(super) fn sphere(
    section: &mut Section,
    _: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("The drag of a sphere");
    section.text("Against the curve of Clift &amp; Gauvin (1971).");
    let radius = 0.01;
    let shape = Shape::Ellipsoid {
        semi_axes: [radius; 3],
    };
    let body = baked(&shape, 1200.0, progress)?;
    let mut rows = Vec::new();
    for re in REYNOLDS {
        let fluid = Fluid::WATER;
        let speed = re * fluid.viscosity / (2.0 * radius);
        let mut state = State::default();
        state.set_world_velocities([0.0, -speed, 0.0], [0.0; 3]);
        let loads = stepper(&body, &fluid, false)?.loads(&state, &Input::default());
        let force = loads.drag.force[1] + loads.friction.force[1];
        let here = force / (0.5 * fluid.density * speed * speed * PI * radius * radius);
        let curve = standard_curve(re);
        let key = |what: &str| format!("sphere.{re}.{what}");
        rows.push(vec![
            section.quote(key("re"), re, 1).to_string(),
            section.quote(key("curve"), curve, 3).to_string(),
            section.quote(key("here"), here, 3).to_string(),
            section
                .quote(key("error"), 100.0 * (here / curve - 1.0), 2)
                .to_string(),
        ]);
    }
    section.table(
        "sphere",
        &["Re", "drag coefficient, measured", "here", "error, %"],
        &rows,
    );
    Ok(())
}

/// A thick body.
struct Solid {
    name: &'static str,
    shape: Shape,
    /// The longest and shortest size of its largest silhouette and the shortest of its smallest (m), as Bagheri &
    /// Bonadonna measure particles.
    sizes: [f64; 3],
    density: f64,
    fluid: Fluid,
}

impl Solid {
    fn all() -> Vec<Self> {
        let mut solids = Vec::new();
        let mut add = |name, shape, sizes, dense: &[(f64, Fluid)]| {
            for &(density, fluid) in dense {
                solids.push(Self {
                    name,
                    shape,
                    sizes,
                    density,
                    fluid,
                });
            }
        };
        let (water, air) = (Fluid::WATER, Fluid::AIR);
        for (name, ratios) in [
            ("sphere", [1.0, 1.0, 1.0]),
            ("ellipsoid 1:2:4", [4.0, 1.0, 2.0]),
            ("ellipsoid 1:1:0.8", [1.0, 0.8, 1.0]),
            ("ellipsoid 1:1:0.5", [1.0, 0.5, 1.0]),
            ("ellipsoid 1:1:2", [2.0, 1.0, 1.0]),
            ("ellipsoid 1:1:4", [4.0, 1.0, 1.0]),
        ] {
            let semi_axes = ratios.map(|x: f64| 0.005 * x);
            let mut sizes = semi_axes.map(|x| 2.0 * x);
            sizes.sort_by(|a, b| b.total_cmp(a));
            let dense = [
                (1050.0, water),
                (1200.0, water),
                (8000.0, water),
                (1200.0, air),
            ];
            add(name, Shape::Ellipsoid { semi_axes }, sizes, &dense);
        }
        let dense = [(1200.0, water), (8000.0, water), (1200.0, air)];
        let side = 0.01;
        let cube = Shape::Box { size: [side; 3] };
        // Along its diagonal a cube shows a regular hexagon.
        let across = [
            2.0 * (2.0f64 / 3.0).sqrt() * side,
            2.0f64.sqrt() * side,
            side,
        ];
        add("cube", cube, across, &dense);
        for (name, slenderness) in [
            ("cylinder, L/D 1", 1.0),
            ("cylinder, L/D 3", 3.0),
            ("cylinder, L/D 5", 5.0),
        ] {
            let (diameter, height) = (side, slenderness * side);
            let shape = Shape::Cylinder {
                radius: 0.5 * diameter,
                height,
            };
            let sizes = [libm::hypot(height, diameter), diameter, diameter];
            add(name, shape, sizes, &dense);
        }
        solids
    }

    /// Terminal speed by the correlation of Bagheri & Bonadonna (2016), from form factors and the density ratio.
    fn correlation(&self, volume: f64) -> f64 {
        let [long, middle, short] = self.sizes;
        let d = libm::cbrt(6.0 * volume / PI);
        let (flatness, elongation) = (short / middle, middle / long);
        let compactness = d * d * d / (long * middle * short);
        let ratio = self.density / self.fluid.density;
        let stokes_form = flatness * libm::pow(elongation, 1.3) * compactness;
        let newton_form = flatness * flatness * elongation * compactness;
        let k_s = 0.5 * (libm::cbrt(stokes_form) + 1.0 / libm::cbrt(stokes_form));
        let log = libm::log10(ratio);
        let a = 0.45 + 10.0 / (libm::exp(2.5 * log) + 30.0);
        let b = 1.0 - 37.0 / (libm::exp(3.0 * log) + 100.0);
        let form = (-libm::log10(newton_form)).max(0.0);
        let k_n = libm::pow(10.0, a * libm::pow(form, b));
        let weight = 4.0 / 3.0 * (ratio - 1.0).abs() * 9.81 * d;
        let mut speed = 0.5;
        for _ in 0..300 {
            let re = speed * d / self.fluid.viscosity;
            let newton = re * k_n / k_s;
            let drag = 24.0 * k_s / re * (1.0 + 0.125 * libm::pow(newton, 2.0 / 3.0))
                + 0.46 * k_n / (1.0 + 5330.0 / newton);
            speed = 0.5 * (speed + (weight / drag).sqrt());
        }
        speed
    }

    /// Fall speed over the correlation's, drift over fall, mean tilt of the shortest axis (degrees), and spin
    /// (length of the middle half-axis times rate, over the speed), with turbulence or without.
    fn falls(&self, body: &Body, turbulent: bool) -> Result<[f64; 5], ReportError> {
        let speed = self.correlation(body.volume);
        let stepper = stepper(body, &self.fluid, turbulent)?;
        let ratio = self.density / self.fluid.density;
        let settling = 8.0 * speed * ratio / 9.81 / (ratio - 1.0).abs();
        let time = (150.0 * self.sizes[1] / speed).max(settling);
        let time_step = 0.1 * self.sizes[2] / speed;
        let middle = 0.5 * self.sizes[1];
        let shortest = (0..3)
            .min_by(|&i, &j| {
                let of = |i: usize| body.separation.extents[i][i];
                of(i).total_cmp(&of(j))
            })
            .unwrap_or(0);
        let falls: Vec<[f64; 4]> = [(0u64, 8.0), (1, 30.0), (2, 60.0)]
            .into_iter()
            .map(|(seed, tilt)| {
                let release = State {
                    orientation: turned([0.282, 0.188, 0.941], tilt),
                    ..State::default()
                };
                let noise = NoiseStream { seed, body: 0 };
                let steps = (time / time_step) as u32;
                let states = fall(&stepper, release, time_step, steps, noise, |_| false);
                let late = &states[states.len() / 2..];
                let [x, y, z] = between(&late[0], &late[late.len() - 1]);
                let tilt = mean(late.iter().map(|s| {
                    let up = langevin_rigid::linalg::rotation_matrix(s.orientation)[1][shortest];
                    libm::acos(up.abs().min(1.0)).to_degrees()
                }));
                let spin = mean(late.iter().map(|s| {
                    let [p, q, r] = s.angular_velocity;
                    (p * p + q * q + r * r).sqrt()
                }));
                [
                    -y / speed,
                    libm::hypot(x, z) / y.abs(),
                    tilt,
                    spin * middle / speed,
                ]
            })
            .collect();
        let of = |k: usize| falls.iter().map(move |f| f[k]);
        Ok([
            speed,
            mean(of(0)),
            of(1).fold(0.0, f64::max),
            mean(of(2)),
            mean(of(3)),
        ])
    }
}

pub(super) fn thick(
    section: &mut Section,
    _: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("Thick bodies");
    section.text(
        "Mean fall speed over that of the correlation of Bagheri &amp; Bonadonna (<i>Powder Technology</i> 301, 2016), of \
         three releases (8, 30 and 60 degrees off); largest drift over fall; mean tilt of the shortest axis; rate of turning \
         times the middle half-axis over the speed.",
    );
    let solids = Solid::all();
    let found: Result<Vec<_>, ReportError> = solids
        .par_iter()
        .map(|solid| {
            let body = baked(&solid.shape, solid.density, progress)?;
            Ok([solid.falls(&body, false)?, solid.falls(&body, true)?])
        })
        .collect();
    let mut rows = Vec::new();
    for (solid, [quiet, turbulent]) in solids.iter().zip(found?) {
        let ratio = solid.density / solid.fluid.density;
        let medium = if ratio > 100.0 { "air" } else { "water" };
        let key = |what: &str| format!("thick.{}.{}.{medium}.{what}", solid.name, solid.density);
        let mut row = vec![
            solid.name.to_owned(),
            format!("{medium}, {}", solid.density),
            section.quote(key("speed"), turbulent[0], 3).to_string(),
            section.quote(key("quiet"), quiet[1], 3).to_string(),
        ];
        for (k, what, digits) in [
            (1, "fall", 3),
            (2, "drift", 2),
            (3, "tilt", 2),
            (4, "turning", 2),
        ] {
            row.push(section.quote(key(what), turbulent[k], digits).to_string());
        }
        rows.push(row);
    }
    let head = [
        "body",
        "in, kg/m^3",
        "speed, m/s",
        "here over it, no turbulence",
        "with",
        "drift",
        "tilt",
        "turning",
    ];
    section.table("thick", &head, &rows);
    Ok(())
}
