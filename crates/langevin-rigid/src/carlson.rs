//! Elliptic integrals in Carlson's symmetric forms (B. C. Carlson 1979), by duplication.

/// Each duplication brings the arguments four times nearer together: to 1e-7 of each other and
/// the fifth-order series, exact to rounding, from any ratio in use.
const DUPLICATIONS: usize = 16;

/// R_F(x, y, z) = 1/2 int_0^inf dt / sqrt((t + x)(t + y)(t + z)); at most one argument is zero.
pub(crate) fn rf(x: f64, y: f64, z: f64) -> f64 {
    let mut a = [x, y, z];
    for _ in 0..DUPLICATIONS {
        a = duplicated(a).0;
    }
    let mean = (a[0] + a[1] + a[2]) / 3.0;
    let [x, y, z] = a.map(|a| 1.0 - a / mean);
    let (e2, e3) = (x * y - z * z, x * y * z);
    (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) / mean.sqrt()
}

/// R_D(x, y, z) = 3/2 int_0^inf dt / (sqrt((t + x)(t + y)(t + z)) (t + z)); z is not zero, at most
/// one of x and y is.
pub(crate) fn rd(x: f64, y: f64, z: f64) -> f64 {
    let (mut a, mut sum, mut factor) = ([x, y, z], 0.0, 1.0);
    for _ in 0..DUPLICATIONS {
        let (next, lambda) = duplicated(a);
        sum += factor / (a[2].sqrt() * (a[2] + lambda));
        factor *= 0.25;
        a = next;
    }
    let mean = (a[0] + a[1] + 3.0 * a[2]) / 5.0;
    let [x, y, z] = a.map(|a| 1.0 - a / mean);
    let (xy, z2) = (x * y, z * z);
    let (e2, e3) = (xy - 6.0 * z2, (3.0 * xy - 8.0 * z2) * z);
    let series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0;
    3.0 * sum + factor * series / (mean * mean.sqrt())
}

/// The next arguments and the shift lambda.
fn duplicated(a: [f64; 3]) -> ([f64; 3], f64) {
    let [x, y, z] = a.map(f64::sqrt);
    let lambda = x * y + y * z + z * x;
    (a.map(|a| 0.25 * (a + lambda)), lambda)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn assert_near(got: f64, want: f64) {
        assert!((got / want - 1.0).abs() < 1e-14, "{got} for {want}");
    }

    /// The arguments that Carlson (1995) tabulates, by arithmetic of 25 digits.
    #[test]
    fn tabulated_values() {
        assert_near(rf(1.0, 2.0, 0.0), 1.311_028_777_146_059_9);
        assert_near(rf(2.0, 3.0, 4.0), 0.584_082_841_677_151_7);
        assert_near(rd(0.0, 2.0, 1.0), 1.797_210_352_103_388_3);
        assert_near(rd(2.0, 3.0, 4.0), 0.165_105_272_942_610_53);
    }

    #[test]
    fn closed_forms_of_spheres_and_discs() {
        assert_near(rf(4.0, 4.0, 4.0), 0.5);
        assert_near(rd(4.0, 4.0, 4.0), 0.125);
        assert_near(rf(1.0, 1.0, 0.0), 0.5 * PI);
        assert_near(rd(1.0, 0.0, 1.0), 0.75 * PI);
        // R_D(1, 1, c^2) -> 3/c - 3 pi/2 for a flat disc.
        let c = 1e-5;
        assert!((rd(1.0, 1.0, c * c) - (3.0 / c - 1.5 * PI)).abs() < 1e-3);
    }
}
