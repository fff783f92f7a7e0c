//! Normal deviates as a pure function of (seed, body, step).
//!
//! Philox4x32-10 (Salmon et al. 2011) turns a counter into uniform bits; Box-Muller, as in the paper
//! (section 4.1), turns those into normals. No state is carried from step to step, so a run can be
//! resumed, reordered or split over threads without changing a bit.

/// Normals that one step consumes: six for each half of the Langevin splitting.
pub const NORMALS_PER_STEP: usize = 12;

/// The stream of one body: a seed and the body's number.
///
/// ```
/// use langevin_rigid::NoiseStream;
/// let stream = NoiseStream { seed: 7, body: 0 };
/// assert_eq!(stream.normals(3), stream.normals(3));
/// assert_ne!(stream.normals(3), stream.normals(4));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoiseStream {
    /// Seed of the run.
    pub seed: u64,
    /// Number of the body within the run.
    pub body: u32,
}

impl NoiseStream {
    /// Independent standard normals of step number `step`.
    pub fn normals(&self, step: u64) -> [f64; NORMALS_PER_STEP] {
        self.normals_of_part(step, 0)
    }

    /// Those of part `part` of a step that is taken in parts; part 0 has those of the step.
    pub(crate) fn normals_of_part(&self, step: u64, part: u32) -> [f64; NORMALS_PER_STEP] {
        let key = halves(self.seed);
        let [low, high] = halves(step);
        let mut bits = [0u32; NORMALS_PER_STEP];
        for block in 0..3u32 {
            // The counter's third word separates bodies, its fourth the blocks of one step.
            let words = philox4x32([low, high, self.body, 3 * part + block], key);
            bits[4 * block as usize..][..4].copy_from_slice(&words);
        }
        box_muller(&bits)
    }
}

fn halves(x: u64) -> [u32; 2] {
    [x as u32, (x >> 32) as u32]
}

/// Philox4x32 with ten rounds.
fn philox4x32(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for _ in 0..10 {
        let a = u64::from(counter[0]) * 0xD251_1F53;
        let b = u64::from(counter[2]) * 0xCD9E_8D57;
        counter = [
            (b >> 32) as u32 ^ counter[1] ^ key[0],
            b as u32,
            (a >> 32) as u32 ^ counter[3] ^ key[1],
            a as u32,
        ];
        key = [
            key[0].wrapping_add(0x9E37_79B9),
            key[1].wrapping_add(0xBB67_AE85),
        ];
    }
    counter
}

/// Normals from uniform words: word `i` gives the radius and word `i + 6` the angle of one pair.
fn box_muller(bits: &[u32; NORMALS_PER_STEP]) -> [f64; NORMALS_PER_STEP] {
    const PAIRS: usize = NORMALS_PER_STEP / 2;
    const UNIT: f64 = 1.0 / 4_294_967_296.0;
    let mut normals = [0.0; NORMALS_PER_STEP];
    for i in 0..PAIRS {
        // (0, 1): never zero, so that the logarithm is finite.
        let u = (f64::from(bits[i]) + 0.5) * UNIT;
        let radius = (-2.0 * ln_unit(u)).sqrt();
        let (sin, cos) = sin_cos_turns((f64::from(bits[PAIRS + i]) + 0.5) * UNIT);
        normals[i] = radius * cos;
        normals[PAIRS + i] = radius * sin;
    }
    normals
}

/// Natural logarithm on (0, 1), without branches so that a loop over it vectorizes.
///
/// ln m = 2 artanh((m-1)/(m+1)) with the mantissa m in [sqrt(1/2), sqrt(2)).
fn ln_unit(u: f64) -> f64 {
    const HALF_SQRT: u64 = 0x3FE6_A09E_667F_3BCD;
    let bits = u.to_bits();
    let exponent = (bits.wrapping_sub(HALF_SQRT) as i64) >> 52;
    let mantissa = f64::from_bits(bits.wrapping_sub((exponent << 52) as u64));
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let z = s * s;
    let mut p = 1.0 / 19.0;
    for k in [17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
        p = p * z + 1.0 / k;
    }
    2.0 * s * p + exponent as f64 * std::f64::consts::LN_2
}

/// Sine and cosine of `u` turns, `u` in [0, 1), without branches.
fn sin_cos_turns(u: f64) -> (f64, f64) {
    let quadrant = (4.0 * u + 0.5) as i64;
    let x = (u - 0.25 * quadrant as f64) * std::f64::consts::TAU;
    let z = x * x;
    let mut sin = 1.0;
    for k in [210.0, 156.0, 110.0, 72.0, 42.0, 20.0, 6.0] {
        sin = 1.0 - z / k * sin;
    }
    sin *= x;
    let mut cos = 1.0;
    for k in [240.0, 182.0, 132.0, 90.0, 56.0, 30.0, 12.0, 2.0] {
        cos = 1.0 - z / k * cos;
    }
    let (a, b) = if quadrant & 1 == 0 {
        (sin, cos)
    } else {
        (cos, sin)
    };
    (
        if quadrant & 2 == 0 { a } else { -a },
        if (quadrant + 1) & 2 == 0 { b } else { -b },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn philox_meets_its_known_answers() {
        // Random123 known-answer vectors.
        assert_eq!(
            philox4x32([0; 4], [0; 2]),
            [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]
        );
        assert_eq!(
            philox4x32([u32::MAX; 4], [u32::MAX; 2]),
            [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]
        );
    }

    #[test]
    fn elementary_functions_meet_the_library() {
        for i in 1..4000 {
            let u = f64::from(i) / 4000.0;
            assert!((ln_unit(u) - libm::log(u)).abs() < 4e-16 * (1.0 + libm::log(u).abs()));
            let (s, c) = sin_cos_turns(u);
            assert!((s - libm::sin(std::f64::consts::TAU * u)).abs() < 1e-15);
            assert!((c - libm::cos(std::f64::consts::TAU * u)).abs() < 1e-15);
        }
        assert!((ln_unit(1e-10) - libm::log(1e-10)).abs() < 1e-14);
    }

    #[test]
    fn moments_are_those_of_independent_normals() {
        let steps = 40_000u64;
        let stream = NoiseStream { seed: 11, body: 3 };
        let mut mean = [0.0; NORMALS_PER_STEP];
        let mut second = [[0.0; NORMALS_PER_STEP]; NORMALS_PER_STEP];
        let mut fourth = 0.0;
        for step in 0..steps {
            let z = stream.normals(step);
            for i in 0..NORMALS_PER_STEP {
                mean[i] += z[i] / steps as f64;
                fourth += z[i].powi(4) / (steps as f64 * NORMALS_PER_STEP as f64);
                for j in 0..NORMALS_PER_STEP {
                    second[i][j] += z[i] * z[j] / steps as f64;
                }
            }
        }
        // Five standard errors.
        for i in 0..NORMALS_PER_STEP {
            assert!(mean[i].abs() < 5.0 / (steps as f64).sqrt());
            for j in 0..NORMALS_PER_STEP {
                let deviation = second[i][j] - f64::from(i == j);
                assert!(
                    deviation.abs() < 5.0 * (2.0 / steps as f64).sqrt(),
                    "{i} {j} {deviation}"
                );
            }
        }
        assert!((fourth - 3.0).abs() < 0.1, "{fourth}");
    }

    #[test]
    fn bodies_and_seeds_have_their_own_streams() {
        let a = NoiseStream { seed: 1, body: 0 }.normals(5);
        assert_ne!(a, NoiseStream { seed: 1, body: 1 }.normals(5));
        assert_ne!(a, NoiseStream { seed: 2, body: 0 }.normals(5));
        assert_ne!(
            a,
            NoiseStream {
                seed: 1 << 32,
                body: 0
            }
            .normals(5)
        );
    }
}
