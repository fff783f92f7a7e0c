//! The waves that a bobbing body makes, which take energy along.

use std::f64::consts::PI;

/// Heave damping per density and frequency (m^3) of a body that makes waves of the wave number `number` (1/m).
///
/// A body small beside the waves moves as much water up and down as its waterplane sweeps, whatever its form: the damping is
/// 1/2 rho omega k A^2, by Haskind's relation (Newman, Marine Hydrodynamics, 1977, chapter 6). Shorter waves
/// are made less well, as the water is pushed some way below the surface: e^(-2 k h) where h, the mean draught and half the
/// radius of the waterplane, is such that the damping of a hemisphere is that of Hulme (J. Fluid Mech. 121, 1982) within
/// a tenth up to k times radius of one, where it bobs by itself. For other bodies this is an estimate.
pub(super) fn heave_damping(number: f64, waterplane: f64, volume: f64) -> f64 {
    let depth = volume / waterplane + 0.5 * (waterplane / PI).sqrt();
    0.5 * number * waterplane * waterplane * libm::exp(-2.0 * number * depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hemisphere_is_damped_as_by_hulme() {
        let volume = 2.0 / 3.0 * PI;
        for (number, damping) in [
            (0.05, 0.1036),
            (0.1, 0.1816),
            (0.2, 0.2793),
            (0.4, 0.3410),
            (0.6, 0.3271),
            (0.8, 0.2899),
            (1.0, 0.2484),
        ] {
            let found = heave_damping(number, PI, volume) / volume;
            assert!((found / damping - 1.0).abs() < 0.1, "{number}: {found}");
        }
    }
}
