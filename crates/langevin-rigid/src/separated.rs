//! Separated flow: a closure on top of Kirchhoff's equations that flutters and tumbles.
//!
//! Potential flow turns a moving body with the couple tau = -v x A11 v (Munk). In real flow the
//! separated wake leaves a fraction of it, the attachment `a`, and that fraction is the couple of a
//! normal force at the quarter chord. The attachment falls with incidence (stall), and it rises
//! while incidence grows and falls while it shrinks (dynamic stall); that lag is the negative
//! damping which drives tumbling. Rotation carries a circulation, whose lift does no work. Drag is
//! a tensor. Everything is written with the structure of the added-mass tensor, so it holds for
//! bodies of any shape and needs no panels.

use crate::body::{Body, Part, shift_added_mass};
use crate::linalg::{
    Mat3, Vec3, Vec6, add, cholesky, cross, dot, eigen_symmetric, join, mat_vec, norm, scale, split,
};

/// The constants of the closure, the same for all bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparatedFlow {
    /// Attachment at small incidence. 1/2 gives a plate the lift slope pi and the normal force of
    /// thin-plate measurements; not fitted.
    pub attachment: f64,
    /// Attachment near broadside, 0.1 to 0.25: sets the centre of pressure at 45 to 60 degrees.
    pub broadside_attachment: f64,
    /// Gain of dynamic stall, 3 to 6; larger values change nothing.
    pub dynamic_stall: f64,
    /// Rotational lift in units of that of attached flow (Theodorsen 1935), which is 1.
    pub rotational_lift: f64,
    /// Rotational damping, 0.5 to 0.8. Above 1.27 (discs) and 1.66 (strips) heavy plates stop
    /// tumbling.
    pub rotational_damping: f64,
    /// Intensity of the turbulence shed by the body, fluctuation over speed: 0.1.
    pub turbulence_intensity: f64,
    /// Whether the flow stays attached: Kirchhoff's equations alone.
    pub attached: bool,
}

impl Default for SeparatedFlow {
    fn default() -> Self {
        Self {
            attachment: 0.5,
            broadside_attachment: 0.15,
            dynamic_stall: 6.0,
            rotational_lift: 1.0,
            rotational_damping: 0.75,
            turbulence_intensity: 0.1,
            attached: false,
        }
    }
}

/// Attachment never quite reaches its ceiling, which keeps dynamic stall finite.
const FULLEST: f64 = 0.98;
/// Attachment of a slender wing relative to a two-dimensional one (R. T. Jones 1946).
const SLENDER: f64 = 0.25;
/// Below this fraction of its largest size a couple has no direction.
const NEGLIGIBLE: f64 = 1e-9;

/// The closure of one body in one fluid.
#[derive(Debug, Clone)]
pub(crate) struct Closure {
    constants: SeparatedFlow,
    parts: Vec<PartClosure>,
    /// Hydrodynamic centre: the centroid of the volume, from the centre of mass (m).
    centre: Vec3,
    /// Stokes resistance to translation and rotation about the centroid (kg/s, kg m^2/s).
    stokes: [Mat3; 2],
}

impl Closure {
    /// `None` if the body has no extents.
    pub(crate) fn new(
        body: &Body,
        density: f64,
        viscosity: f64,
        constants: SeparatedFlow,
    ) -> Option<Self> {
        cholesky(&body.separation.extents)?;
        let part = |part: &Part| PartClosure::new(part, body, density);
        let stokes = [
            body.separation.stokes_translation,
            body.separation.stokes_rotation,
        ];
        Some(Self {
            constants,
            parts: if body.parts.is_empty() {
                vec![part(&whole(body))]
            } else {
                body.parts.iter().map(part).collect()
            },
            centre: body.centre_of_buoyancy,
            stokes: stokes.map(|tensor| scaled(density * viscosity, &tensor)),
        })
    }

    /// The closure's generalized force about the centre of mass, body frame, from the velocity
    /// relative to the fluid.
    ///
    /// It never feeds energy: its power is negative or zero in every state.
    pub(crate) fn load(&self, xi: &Vec6) -> Vec6 {
        if self.constants.attached {
            return [0.0; 6];
        }
        let (v, omega) = split(xi);
        let mut sum = self.friction(v, omega);
        for part in &self.parts {
            let at_part = add(v, cross(omega, part.centre));
            sum.add(
                part.centre,
                at_part,
                omega,
                &part.loads(&self.constants, at_part, omega),
            );
        }
        let separation = limited(sum.lost, omega, sum.power);
        join(sum.force, add(sum.torque, separation))
    }

    fn friction(&self, v: Vec3, omega: Vec3) -> Sum {
        let at_centre = add(v, cross(omega, self.centre));
        let loads = Loads {
            workless: [0.0; 3],
            force: scale(-1.0, mat_vec(&self.stokes[0], at_centre)),
            damping: scale(-1.0, mat_vec(&self.stokes[1], omega)),
            lost: [0.0; 3],
        };
        let mut sum = Sum::default();
        sum.add(self.centre, at_centre, omega, &loads);
        sum
    }
}

/// The body as its only part.
fn whole(body: &Body) -> Part {
    let about_centre = shift_added_mass(&body.added_mass, body.centre_of_buoyancy);
    let block = |k: usize| -> Mat3 {
        std::array::from_fn(|i| std::array::from_fn(|j| about_centre[k + i][k + j]))
    };
    Part {
        centre: body.centre_of_buoyancy,
        translation: block(0),
        rotation: block(3),
        drag_area: body.separation.drag_area,
        extents: body.separation.extents,
    }
}

/// Loads of one part, at its centre.
struct Loads {
    /// Rotational lift (N).
    workless: Vec3,
    /// Normal force and drag (N).
    force: Vec3,
    /// Rotational damping (N m).
    damping: Vec3,
    /// The part of the couple that separation takes away (N m).
    lost: Vec3,
}

/// Loads of all parts about the centre of mass, the lost couples apart.
#[derive(Default)]
struct Sum {
    force: Vec3,
    torque: Vec3,
    lost: Vec3,
    /// Power of all but the lost couples and what does no work (W).
    power: f64,
}

impl Sum {
    fn add(&mut self, centre: Vec3, v: Vec3, omega: Vec3, loads: &Loads) {
        let force = add(loads.force, loads.workless);
        self.force = add(self.force, force);
        self.torque = add(self.torque, add(loads.damping, cross(centre, force)));
        self.lost = add(self.lost, loads.lost);
        self.power += dot(loads.force, v) + dot(loads.damping, omega);
    }
}

/// A part with its tensors in the fluid.
#[derive(Debug, Clone)]
struct PartClosure {
    centre: Vec3,
    density: f64,
    /// A11 - mu 1, mu the least eigenvalue of A11 (kg).
    directed: Mat3,
    /// lam - mu and lam, lam the largest eigenvalue of A11 (kg).
    spread: f64,
    largest: f64,
    /// tr(A11) 1 - A11 (kg).
    circulation: Mat3,
    /// A22 about the centre (kg m^2).
    rotation: Mat3,
    /// Drag areas P (m^2).
    drag_area: Mat3,
    /// Squared half-extents of the part and of the body (m^2).
    extents: Mat3,
    body_extents: Mat3,
    /// Second-largest half-extent L of the body (m).
    length: f64,
}

impl PartClosure {
    fn new(part: &Part, body: &Body, density: f64) -> Self {
        let translation = scaled(density, &part.translation);
        let ([mu, _, lam], _) = eigen_symmetric(&translation);
        let trace = translation[0][0] + translation[1][1] + translation[2][2];
        Self {
            centre: part.centre,
            density,
            directed: shifted(&translation, 1.0, -mu),
            spread: lam - mu,
            largest: lam,
            circulation: shifted(&translation, -1.0, trace),
            rotation: scaled(density, &part.rotation),
            drag_area: part.drag_area,
            extents: part.extents,
            body_extents: body.separation.extents,
            length: body.half_extents[1],
        }
    }

    /// From the velocity relative to the fluid at the part's centre.
    fn loads(&self, constants: &SeparatedFlow, v: Vec3, omega: Vec3) -> Loads {
        let speed = norm(v);
        let incidence = self.incidence(v, speed);
        let attachment = self.attachment(constants, &incidence, omega, speed);
        Loads {
            workless: scale(
                constants.rotational_lift * attachment,
                cross(mat_vec(&self.circulation, omega), v),
            ),
            force: add(incidence.normal_force(attachment), self.drag(v)),
            damping: self.damping(constants, omega, speed),
            lost: scale(attachment - 1.0, incidence.couple),
        }
    }

    /// Direction and size of the potential couple, and the chord and span that belong to it.
    fn incidence(&self, v: Vec3, speed: f64) -> Incidence {
        let u = mat_vec(&self.directed, v);
        let couple = cross(u, v);
        let (size, pull) = (norm(couple), norm(u));
        if size <= NEGLIGIBLE * self.largest * speed * speed || speed == 0.0 {
            let edgewise = self.spread > NEGLIGIBLE * self.largest
                && pull <= NEGLIGIBLE * self.largest * speed;
            return Incidence {
                couple: [0.0; 3],
                size: 0.0,
                normal: [0.0; 3],
                cos2: f64::from(edgewise),
                chord: self.length,
                aspect: 1.0,
            };
        }
        let normal = scale(1.0 / pull, u);
        let span = scale(1.0 / size, couple);
        let chord = cross(span, normal);
        let half_chord = dot(chord, mat_vec(&self.extents, chord)).sqrt();
        let half_span = dot(span, mat_vec(&self.body_extents, span)).sqrt();
        let cos = size / (pull * speed);
        Incidence {
            couple,
            size,
            normal,
            cos2: cos * cos,
            chord: half_chord,
            aspect: half_span / half_chord,
        }
    }

    /// The fraction of the potential couple that survives.
    fn attachment(&self, c: &SeparatedFlow, incidence: &Incidence, omega: Vec3, speed: f64) -> f64 {
        let still =
            c.broadside_attachment + (c.attachment - c.broadside_attachment) * incidence.cos2;
        if incidence.size == 0.0 {
            return still;
        }
        let ceiling = (incidence.aspect + SLENDER) / (incidence.aspect + 1.0);
        let fraction = (still / ceiling).min(FULLEST);
        // Reduced rate of growing incidence: omega l sin(2 alpha) / V for a plate.
        let rate = incidence.chord * dot(omega, incidence.couple)
            / (0.5 * self.spread * speed * speed * speed);
        let lag = libm::exp(-2.0 * c.dynamic_stall * rate);
        ceiling / (1.0 + (1.0 - fraction) / fraction * lag)
    }

    /// Pressure drag along P v.
    fn drag(&self, v: Vec3) -> Vec3 {
        let pv = mat_vec(&self.drag_area, v);
        let size = norm(pv);
        if size == 0.0 {
            return [0.0; 3];
        }
        scale(-0.5 * self.density * dot(v, pv) / size, pv)
    }

    fn damping(&self, constants: &SeparatedFlow, omega: Vec3, speed: f64) -> Vec3 {
        let rate = constants.rotational_damping * (speed / self.length + norm(omega));
        scale(-rate, mat_vec(&self.rotation, omega))
    }
}

/// The body's attitude to the stream.
struct Incidence {
    /// tau = -v x A11 v (N m).
    couple: Vec3,
    size: f64,
    /// Unit direction of the normal force.
    normal: Vec3,
    /// Squared cosine of the incidence: 1 edgewise, 0 broadside.
    cos2: f64,
    /// Half chord (m).
    chord: f64,
    /// Span over chord.
    aspect: f64,
}

impl Incidence {
    /// The surviving couple as a force at the quarter chord.
    fn normal_force(&self, attachment: f64) -> Vec3 {
        scale(-2.0 * attachment / self.chord * self.size, self.normal)
    }
}

/// The lost couple, limited to what the other loads dissipate where it would feed energy.
fn limited(lost: Vec3, omega: Vec3, dissipated: f64) -> Vec3 {
    let fed = dot(lost, omega);
    if fed + dissipated > 0.0 {
        scale(-dissipated / fed, lost)
    } else {
        lost
    }
}

fn scaled(factor: f64, m: &Mat3) -> Mat3 {
    shifted(m, factor, 0.0)
}

/// `s m + d 1`.
fn shifted(m: &Mat3, s: f64, d: f64) -> Mat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| s * m[i][j] + if i == j { d } else { 0.0 }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Separation, Surface};

    fn diagonal(d: [f64; 3]) -> Mat3 {
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
    }

    /// A flat body, thin along y, in a fluid of density 1 without viscosity.
    fn plate(added: [f64; 6], drag: [f64; 3], half_extents: [f64; 3]) -> Closure {
        let mut added_mass = [[0.0; 6]; 6];
        for i in 0..6 {
            added_mass[i][i] = added[i];
        }
        let mut sorted = half_extents;
        sorted.sort_by(|a, b| b.total_cmp(a));
        let body = Body {
            mass: 1.0,
            inertia: diagonal([1.0; 3]),
            volume: 1.0,
            centre_of_buoyancy: [0.0; 3],
            added_mass,
            half_extents: sorted,
            thickness: 1.0,
            length: 1.0,
            separation: Separation {
                drag_area: diagonal(drag),
                extents: diagonal(half_extents.map(|e| e * e)),
                ..Separation::default()
            },
            parts: vec![],
            surface: Surface::default(),
        };
        Closure::new(&body, 1.0, 0.0, SeparatedFlow::default()).unwrap()
    }

    fn disc() -> Closure {
        let face = std::f64::consts::PI;
        let (broadside, turning) = (8.0 / 3.0, 16.0 / 45.0);
        plate(
            [0.0, broadside, 0.0, turning, 0.0, turning],
            [0.05 * face, 1.12 * face, 0.05 * face],
            [1.0, 0.02, 1.0],
        )
    }

    /// A strip of chord 2 along x and unit span, with the aspect ratio of a long one.
    fn strip() -> Closure {
        let pi = std::f64::consts::PI;
        plate(
            [0.0, pi, 0.0, 0.0, 0.0, pi / 8.0],
            [0.02 * 2.0, 1.95 * 2.0, 0.0],
            [1.0, 0.01, 1e6],
        )
    }

    /// Normal force coefficient and centre of pressure (chords from the middle) at rest in a stream.
    fn statics(closure: &Closure, area: f64, degrees: f64) -> (f64, f64) {
        let (sin, cos) = (degrees.to_radians().sin(), degrees.to_radians().cos());
        let v = [cos, -sin, 0.0];
        let (force, torque) = split(&closure.load(&join(v, [0.0; 3])));
        // With the Munk couple that Kirchhoff's terms contribute.
        let munk = closure.parts[0].incidence(v, 1.0).couple;
        let normal = force[1];
        (normal / (0.5 * area), (torque[2] + munk[2]) / normal / 2.0)
    }

    #[test]
    fn normal_force_and_centre_of_pressure_follow_the_incidence() {
        // (incidence, strip CN, strip x_cp, disc CN, disc x_cp)
        let table = [
            (5.0, 0.31, 0.215, 0.20, 0.184),
            (10.0, 0.61, 0.214, 0.36, 0.195),
            (20.0, 1.18, 0.196, 0.67, 0.185),
            (30.0, 1.63, 0.172, 0.92, 0.164),
            (45.0, 2.01, 0.127, 1.13, 0.121),
            (60.0, 2.12, 0.076, 1.20, 0.072),
            (90.0, 1.95, 0.0, 1.12, 0.0),
        ];
        for (degrees, strip_cn, strip_cp, disc_cn, disc_cp) in table {
            let (cn, cp) = statics(&strip(), 2.0, degrees);
            assert!((cn - strip_cn).abs() < 0.02, "strip {degrees}: CN {cn}");
            assert!((cp - strip_cp).abs() < 0.01, "strip {degrees}: x_cp {cp}");
            let (cn, cp) = statics(&disc(), std::f64::consts::PI, degrees);
            assert!((cn - disc_cn).abs() < 0.02, "disc {degrees}: CN {cn}");
            assert!((cp - disc_cp).abs() < 0.01, "disc {degrees}: x_cp {cp}");
        }
    }

    #[test]
    fn the_attached_switch_is_kirchhoff() {
        let mut closure = disc();
        closure.constants.attached = true;
        assert_eq!(closure.load(&[1.0, -2.0, 0.5, 3.0, 1.0, -1.0]), [0.0; 6]);
    }

    /// A body without any symmetry, with a centre of mass off its centroid.
    fn general() -> Closure {
        let mut closure = plate(
            [0.4, 2.0, 0.9, 0.3, 0.5, 0.2],
            [0.3, 2.2, 0.7],
            [1.5, 0.1, 0.8],
        );
        let part = &mut closure.parts[0];
        part.centre = [0.2, -0.1, 0.3];
        let (s, c) = (0.6, 0.8);
        let turn = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        for tensor in [
            &mut part.directed,
            &mut part.circulation,
            &mut part.drag_area,
            &mut part.extents,
            &mut part.body_extents,
        ] {
            let transposed = crate::linalg::transpose(&turn);
            *tensor = crate::linalg::product(&crate::linalg::product(&turn, tensor), &transposed);
        }
        closure
    }

    #[test]
    fn the_closure_never_feeds_energy() {
        let closure = general();
        let stream = crate::noise::NoiseStream { seed: 3, body: 0 };
        for n in 0..2000 {
            let z = stream.normals(n);
            let xi: Vec6 = std::array::from_fn(|i| if i < 3 { z[i] } else { 4.0 * z[i] });
            let load = closure.load(&xi);
            let (v, omega) = split(&xi);
            let at_centre = add(v, cross(omega, closure.parts[0].centre));
            let power: f64 = (0..6).map(|i| load[i] * xi[i]).sum();
            let scale = norm(at_centre).powi(3) + norm(omega).powi(3);
            assert!(power <= 1e-12 * scale, "state {n}: power {power}");
        }
    }

    #[test]
    fn a_spinning_sphere_bends_to_the_magnus_side() {
        let sphere = plate([0.5, 0.5, 0.5, 0.0, 0.0, 0.0], [0.45; 3], [1.0; 3]);
        // Moving along x with the spin along z: backspin lifts a ball that flies with its top
        // moving backwards, omega x v along +y.
        let (force, _) = split(&sphere.load(&[1.0, 0.0, 0.0, 0.0, 0.0, 1.0]));
        assert!(force[1] > 0.0 && force[0] < 0.0, "{force:?}");
    }

    #[test]
    fn rest_and_pure_motions_have_no_direction_to_fail_on() {
        for closure in [disc(), strip(), general()] {
            for xi in [
                [0.0; 6],
                [0.0, 0.0, 0.0, 1.0, 2.0, 3.0],
                [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                [0.0, 1e-300, 0.0, 0.0, 0.0, 1.0],
            ] {
                assert!(closure.load(&xi).iter().all(|f| f.is_finite()), "{xi:?}");
            }
        }
    }
}
