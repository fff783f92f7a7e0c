//! Pressure on the surface of a moving body, from its potentials of unit motion.

use crate::body::Body;
use crate::linalg::{Vec3, add, cross, dot, norm, scale, sub};

impl Body {
    /// Dynamic pressure (Pa) at the middle of each of the [panels](crate::Surface::panels) of a body that moves through
    /// fluid of `density` (kg/m^3) with `velocity` at its centre of mass (m/s) and `angular_velocity` (rad/s), body frame,
    /// relative to the fluid.
    ///
    /// It is that of attached flow, without what a change of the motion adds: p = rho (|U|^2 - |w|^2) / 2, with U the
    /// velocity of the surface and w that of the fluid along it (Bernoulli's theorem in axes fixed in the body, Milne-Thomson
    /// 1968). Where flow separates, the pressure behind the edge is another. At a sharp edge the suction grows without
    /// bound as panels shrink.
    ///
    /// Empty for a [simple body](Body::ellipsoid), which has no panels.
    ///
    /// ```
    /// use langevin_rigid::Body;
    /// assert!(Body::sphere(0.01, 500.0)?.surface_pressures(1.2, [1.0, 0.0, 0.0], [0.0; 3]).is_empty());
    /// # Ok::<(), langevin_rigid::BodyError>(())
    /// ```
    pub fn surface_pressures(
        &self,
        density: f64,
        velocity: Vec3,
        angular_velocity: Vec3,
    ) -> Vec<f64> {
        // The potentials are those of motion about the centroid of the volume.
        let [vx, vy, vz] = add(velocity, cross(angular_velocity, self.centre_of_buoyancy));
        let [wx, wy, wz] = angular_velocity;
        let motion = [vx, vy, vz, wx, wy, wz];
        let surface = &self.surface;
        let potential = |vertex: u32| -> f64 {
            let of_units = &surface.potentials[vertex as usize];
            of_units.iter().zip(motion).map(|(phi, u)| phi * u).sum()
        };
        let pressure = |panel: &[u32; 3]| {
            let corners = panel.map(|vertex| surface.vertices[vertex as usize]);
            let normal = normal(&corners);
            let middle = scale(1.0 / 3.0, add(add(corners[0], corners[1]), corners[2]));
            let moves = add(velocity, cross(angular_velocity, middle));
            let flows = tangential_gradient(&corners, normal, panel.map(potential));
            let along = sub(moves, scale(dot(moves, normal), normal));
            let slip = sub(flows, along);
            0.5 * density * (dot(moves, moves) - dot(slip, slip))
        };
        surface.panels.iter().map(pressure).collect()
    }
}

/// Unit normal; zero of a triangle without area.
fn normal([a, b, c]: &[Vec3; 3]) -> Vec3 {
    let across = cross(sub(*b, *a), sub(*c, *a));
    let length = norm(across);
    scale(if length > 0.0 { 1.0 / length } else { 0.0 }, across)
}

/// Gradient of the linear function with these values at the corners; zero of a triangle without area.
fn tangential_gradient([a, b, c]: &[Vec3; 3], normal: Vec3, values: [f64; 3]) -> Vec3 {
    let twice_area = dot(cross(sub(*b, *a), sub(*c, *a)), normal);
    if twice_area <= 0.0 {
        return [0.0; 3];
    }
    let opposite = [sub(*c, *b), sub(*a, *c), sub(*b, *a)];
    let sum = opposite
        .iter()
        .zip(values)
        .fold([0.0; 3], |sum, (edge, value)| add(sum, scale(value, *edge)));
    scale(1.0 / twice_area, cross(normal, sum))
}
