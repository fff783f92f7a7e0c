//! Discs and strips with their tensors in closed form.
//!
//! Lengths are in diameters or chords, and the fluid has density 1; gravity, and with it the time,
//! is the host's. Both bodies are thin along y of the body frame, and a strip is long along z.

use std::f64::consts::PI;

use langevin_rigid::linalg::{Mat3, Mat6};
use langevin_rigid::{
    Body, Fluid, GRAVITY, Model, SeparatedFlow, Separation, Settings, SetupError, Stepper, Surface,
};
use serde::{Deserialize, Serialize};

/// Euler's constant.
const EULER: f64 = 0.577_215_664_901_532_9;
/// Length of a strip in chords: as good as infinite.
const SPAN: f64 = 100.0;
/// Sides of the polygon that a disc is drawn as.
const SIDES: u32 = 64;
/// Length of the piece of a strip that is drawn, chords.
const DRAWN_SPAN: f64 = 1.5;

/// The flat bodies whose regimes have been measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Plate {
    /// A circular disc. I* = I / (rho d^5), with I about a diameter d.
    Disc,
    /// A strip as long as to fall in a plane. I* = rho_s h / (rho c), thickness h and chord c.
    Strip,
}

impl Plate {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Disc, Self::Strip];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Disc => "disc",
            Self::Strip => "strip",
        }
    }

    /// Thickness over diameter or chord in the map of the regimes: thin, as the measured ones.
    pub fn thickness(self) -> f64 {
        match self {
            Self::Disc => 0.015,
            Self::Strip => 0.02,
        }
    }

    /// The same of a plate with this I*, thinner where it would not be 2.5 times as dense as the fluid.
    pub fn thickness_at(self, inertia_ratio: f64) -> f64 {
        const DENSITY_RATIO: f64 = 2.5;
        let thinner = match self {
            Self::Disc => inertia_ratio * 64.0 / (PI * DENSITY_RATIO),
            Self::Strip => inertia_ratio / DENSITY_RATIO,
        };
        thinner.min(self.thickness())
    }

    /// What a picture shows of a plate of [`Plate::body`]: all of a disc, a piece of a strip.
    pub fn drawn(self, body: &Body) -> Surface {
        let [_, a, b] = body.half_extents;
        match self {
            Self::Disc => body.surface.clone(),
            Self::Strip => strip_surface(a, b, DRAWN_SPAN),
        }
    }

    /// The body of diameter or chord 1 with this I*; `thickness` in the same unit.
    pub fn body(self, inertia_ratio: f64, thickness: f64) -> Body {
        match self {
            Self::Disc => disc(inertia_ratio, thickness),
            Self::Strip => strip(inertia_ratio, thickness),
        }
    }
}

/// Terminal speed of a plate of [`Plate::body`] that falls broadside at this Reynolds number, with its viscous resistance:
/// the speed that experiments put into the number. Not a number for a plate lighter than the fluid.
pub fn broadside_speed(body: &Body, reynolds: f64) -> f64 {
    let weight = (body.mass - body.volume) * -GRAVITY[1];
    let pressure = 0.5 * body.separation.drag_area[1][1];
    (weight / (pressure + body.separation.stokes_translation[1][1] * body.length / reynolds)).sqrt()
}

/// A stepper for a plate of [`Plate::body`] in fluid at rest of this kinematic viscosity, on the plate's scale: the model
/// `separated` without turbulence.
///
/// # Errors
/// [`SetupError`] for a plate that cannot fall.
pub fn stepper(body: &Body, viscosity: f64) -> Result<Stepper, SetupError> {
    let fluid = Fluid {
        density: 1.0,
        viscosity,
        velocity: [0.0; 3],
    };
    let settings = Settings {
        model: Model::Separated,
        separated: SeparatedFlow {
            turbulence_intensity: 0.0,
            ..SeparatedFlow::default()
        },
        ..Settings::default()
    };
    Stepper::new(body, &fluid, None, &settings)
}

/// Added mass of the thin disc (Lamb 1932, articles 102 and 108), and of its rim edgewise as half a
/// cylinder's; C_D 1.12 broadside, 1.2 on the rim; Stokes resistance of the thin disc (Oberbeck 1876).
fn disc(inertia_ratio: f64, h: f64) -> Body {
    let r = 0.5f64;
    let face = PI * r * r;
    let per_mass = r * r / 4.0 + h * h / 12.0;
    let mass = inertia_ratio / per_mass;
    let (broadside, turning) = (8.0 / 3.0 * r.powi(3), 16.0 / 45.0 * r.powi(5));
    let edge = PI * h * h / 4.0 * r;
    let (rim, polar) = (1.2 * 2.0 * r * h, mass * r * r / 2.0);
    Body {
        mass,
        inertia: diagonal([mass * per_mass, polar, mass * per_mass]),
        volume: face * h,
        centre_of_buoyancy: [0.0; 3],
        added_mass: added_mass([edge, broadside, edge, turning, 0.0, turning]),
        half_extents: [r, r, h / 2.0],
        thickness: h,
        length: 2.0 * r,
        separation: Separation {
            drag_area: diagonal([rim, 1.12 * face, rim]),
            extents: diagonal([r * r, h * h / 4.0, r * r]),
            stokes_translation: diagonal([32.0 / 3.0 * r, 16.0 * r, 32.0 / 3.0 * r]),
            stokes_rotation: diagonal([32.0 / 3.0 * r.powi(3); 3]),
        },
        slices: vec![],
        surface: disc_surface(r, h),
    }
}

/// Added mass of the elliptic cylinder (Lamb 1932, article 71); C_D 1.95 broadside, 1.2 on the edge.
fn strip(inertia_ratio: f64, h: f64) -> Body {
    let (a, b) = (0.5f64, 0.5 * h);
    let volume = 4.0 * a * b * SPAN;
    let mass = inertia_ratio / h * volume;
    let about_span = mass * (a * a + b * b) / 3.0;
    let long = mass * SPAN * SPAN / 12.0;
    // Along the span nothing moves in a plane fall; this makes the tensor positive, no more. Nothing turns out of the
    // plane either: so hard to turn that it could not limit the step.
    let along = 0.01 * SPAN;
    // Along the span as on the edge: the least drag area is that of the plane.
    let edge = 1.2 * 2.0 * b * SPAN;
    let turning = PI / 8.0 * (a * a - b * b).powi(2) * SPAN;
    Body {
        mass,
        inertia: diagonal([long, long, about_span]),
        volume,
        centre_of_buoyancy: [0.0; 3],
        added_mass: added_mass([
            PI * b * b * SPAN,
            PI * a * a * SPAN,
            along,
            SPAN.powi(5),
            SPAN.powi(5),
            turning,
        ]),
        half_extents: [SPAN / 2.0, a, b],
        thickness: h,
        length: 2.0 * a,
        separation: Separation {
            drag_area: diagonal([edge, 1.95 * 2.0 * a * SPAN, edge]),
            extents: diagonal([a * a, b * b, SPAN * SPAN / 4.0]),
            stokes_translation: diagonal([
                oseen_resistance(a, b) * SPAN,
                oseen_resistance(b, a) * SPAN,
                0.0,
            ]),
            // Jeffery (1922), in the limit of a long ellipsoid.
            stokes_rotation: diagonal([0.0, 0.0, 2.0 * PI * (a * a + b * b) * SPAN]),
        },
        slices: vec![],
        surface: strip_surface(a, b, SPAN),
    }
}

/// Viscous resistance per length and viscosity of an elliptic cylinder, semi-axes `along` and
/// `across` the stream (Lamb 1932, article 343; Oseen's approximation).
///
/// There is no Stokes resistance in the plane: Oseen's has a logarithm of the Reynolds number on the
/// chord. It is taken at Re = 1, where the approximation ends, because the closure adds a resistance
/// linear in the speed to the pressure drag.
fn oseen_resistance(along: f64, across: f64) -> f64 {
    let sum = along + across;
    let chord = 2.0 * along.max(across);
    4.0 * PI / (libm::log(8.0 * chord / sum) - EULER + along / sum)
}

fn diagonal(d: [f64; 3]) -> Mat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}

fn added_mass(d: [f64; 6]) -> Mat6 {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}

/// A prism with as many sides as make it round to the eye.
fn disc_surface(r: f64, h: f64) -> Surface {
    let ring = |y: f64| {
        (0..SIDES).map(move |k| {
            let angle = 2.0 * PI * f64::from(k) / f64::from(SIDES);
            [r * libm::sin(angle), y, r * libm::cos(angle)]
        })
    };
    prism(ring(0.5 * h).chain(ring(-0.5 * h)).collect())
}

fn strip_surface(a: f64, b: f64, span: f64) -> Surface {
    let z = 0.5 * span;
    let ring = |y: f64| [[a, y, z], [a, y, -z], [-a, y, -z], [-a, y, z]];
    prism(ring(b).into_iter().chain(ring(-b)).collect())
}

/// The upper ring, counterclockwise from above, and the lower one in the same order.
fn prism(vertices: Vec<[f64; 3]>) -> Surface {
    let n = vertices.len() as u32 / 2;
    let mut triangles = Vec::new();
    for k in 0..n {
        let next = (k + 1) % n;
        triangles.push([k, n + k, n + next]);
        triangles.push([k, n + next, next]);
        if k > 0 && next > 0 {
            triangles.push([0, k, next]);
            triangles.push([n, n + next, n + k]);
        }
    }
    Surface {
        vertices,
        triangles,
        ..Surface::default()
    }
}

#[cfg(test)]
mod tests {
    use langevin_rigid::linalg::vector::{cross, dot};

    use super::*;

    #[test]
    fn a_body_has_the_inertia_ratio_asked_for() {
        for ratio in [0.003, 0.2, 5.0] {
            let disc = Plate::Disc.body(ratio, 0.015);
            assert!((disc.inertia[0][0] / ratio - 1.0).abs() < 1e-12);
            let strip = Plate::Strip.body(ratio, 0.02);
            let density = strip.mass / strip.volume;
            assert!((density * 0.02 / ratio - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_resistance_of_a_cylinder_is_lambs() {
        // Circle: 4 pi / (1/2 - gamma - ln(Re/8)) at Re = 1.
        let circle = 4.0 * PI / (0.5 - EULER + 8f64.ln());
        assert!((oseen_resistance(0.5, 0.5) / circle - 1.0).abs() < 1e-12);
        // A plate moves more easily edgewise.
        assert!(oseen_resistance(0.5, 0.0) < oseen_resistance(0.0, 0.5));
    }

    #[test]
    fn rotation_of_a_strip_is_resisted_as_that_of_a_long_ellipsoid() {
        // The ellipsoid's section shrinks to its ends: its mean square is 2/3 of the middle one's.
        let (a, b, c) = (0.5, 0.1, 400.0);
        let [.., whole] = langevin_rigid_bake::separation::stokes_rotation([a, b, c]);
        let section = 2.0 * PI * (a * a + b * b);
        assert!((whole / (section * 2.0 * c * 2.0 / 3.0) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn surfaces_are_closed_and_have_the_volume_of_the_body() {
        for plate in Plate::ALL {
            let body = plate.body(1.0, 0.1);
            let corner = |t: &[u32; 3], k: usize| body.surface.vertices[t[k] as usize];
            let volume: f64 = body
                .surface
                .triangles
                .iter()
                .map(|t| dot(corner(t, 0), cross(corner(t, 1), corner(t, 2))) / 6.0)
                .sum();
            let error = volume / body.volume - 1.0;
            // The polygon is 0.16 % smaller than the circle.
            assert!(error.abs() < 2e-3, "{plate:?}: {error}");
        }
    }
}
