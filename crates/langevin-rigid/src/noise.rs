//! Normal deviates as a pure function of (seed, body, step).
//!
//! Philox4x32-10 (Salmon et al. 2011) turns a counter into uniform bits; Box-Muller, as in the paper
//! (section 4.1), turns those into normals. No state is carried from step to step, so a run can be
//! resumed, reordered or split over threads without changing a bit.

use crate::elementary::{ln, sin_cos_eighth};
use crate::real::{Real, Words};

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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoiseStream {
    /// Seed of the run.
    pub seed: u64,
    /// Number of the body within the run.
    pub body: u32,
}

impl NoiseStream {
    /// Independent standard normals of step number `step`.
    pub fn normals(&self, step: u64) -> [f64; NORMALS_PER_STEP] {
        let counter = Counter::new(step, self.body);
        let (first, second) = counter.normals_of_part(self.seed, 0);
        std::array::from_fn(|i| if i < 6 { first[i] } else { second[i - 6] })
    }
}

/// Where a body is in its stream, or bodies in theirs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Counter<W> {
    /// Number of the step, low and high word.
    pub(crate) step: [W; 2],
    pub(crate) body: W,
}

impl Counter<u32> {
    pub(crate) fn new(step: u64, body: u32) -> Self {
        Self {
            step: halves(step),
            body,
        }
    }
}

impl<W: Words> Counter<W> {
    /// Six standard normals: those of the first half of a step.
    #[inline(always)]
    pub(crate) fn normals<R: Real<Words = W>>(&self, seed: u64) -> [R; 6] {
        let first = self.words(seed, 0);
        let second = self.words(seed, 1);
        in_pairs([
            box_muller(first[0], first[1]),
            box_muller(first[2], first[3]),
            box_muller(second[0], second[1]),
        ])
    }

    /// Two times six, for part `part` of a step that is taken in parts; part 0 begins like the step.
    #[inline(always)]
    pub(crate) fn normals_of_part<R: Real<Words = W>>(
        &self,
        seed: u64,
        part: u32,
    ) -> ([R; 6], [R; 6]) {
        let first = self.words(seed, 3 * part);
        let second = self.words(seed, 3 * part + 1);
        let third = self.words(seed, 3 * part + 2);
        (
            in_pairs([
                box_muller(first[0], first[1]),
                box_muller(first[2], first[3]),
                box_muller(second[0], second[1]),
            ]),
            in_pairs([
                box_muller(second[2], second[3]),
                box_muller(third[0], third[1]),
                box_muller(third[2], third[3]),
            ]),
        )
    }

    /// The counter's third word separates bodies, its fourth the blocks of one step.
    #[inline(always)]
    fn words(&self, seed: u64, block: u32) -> [W; 4] {
        let [low, high] = self.step;
        philox4x32([low, high, self.body, low.of(block)], halves(seed))
    }
}

#[inline(always)]
fn in_pairs<R: Real>([a, b, c]: [(R, R); 3]) -> [R; 6] {
    [a.0, a.1, b.0, b.1, c.0, c.1]
}

pub(crate) fn halves(x: u64) -> [u32; 2] {
    [x as u32, (x >> 32) as u32]
}

/// Philox4x32 with ten rounds.
#[inline(always)]
fn philox4x32<W: Words>(mut counter: [W; 4], mut key: [u32; 2]) -> [W; 4] {
    for _ in 0..10 {
        let (a_high, a_low) = counter[0].widening_mul(0xD251_1F53);
        let (b_high, b_low) = counter[2].widening_mul(0xCD9E_8D57);
        counter = [
            b_high ^ counter[1] ^ b_low.of(key[0]),
            b_low,
            a_high ^ counter[3] ^ a_low.of(key[1]),
            a_low,
        ];
        key = [
            key[0].wrapping_add(0x9E37_79B9),
            key[1].wrapping_add(0xBB67_AE85),
        ];
    }
    counter
}

/// Two normals from two uniform words, one for the radius and one for the angle.
#[inline(always)]
fn box_muller<R: Real>(radius: R::Words, angle: R::Words) -> (R, R) {
    let u = R::uniform(radius);
    let radius = (ln(u) * u.of(-2.0)).sqrt();
    let (sin, cos) = sin_cos_eighth(R::eighth_turn(angle));
    let cos = R::choose(R::is_set(angle, 31), -cos, cos);
    let swapped = R::is_set(angle, 30);
    (
        radius * R::choose(swapped, sin, cos),
        radius * R::choose(swapped, cos, sin),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn philox_meets_its_known_answers() {
        // Random123 known-answer vectors.
        assert_eq!(
            philox4x32([0u32; 4], [0; 2]),
            [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]
        );
        assert_eq!(
            philox4x32([u32::MAX; 4], [u32::MAX; 2]),
            [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]
        );
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
