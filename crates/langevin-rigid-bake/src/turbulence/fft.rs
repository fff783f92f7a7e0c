//! Fast Fourier transforms of any length, four complex lines at a time.
//!
//! Own code rather than a library's, for the bits: the fields must not depend on the machine, so
//! roots of unity come from `libm` and the lanes have a fixed width, with no dispatch on the CPU.

use std::ops::{Add, Mul, Sub};

use wide::f64x4;

/// Real lines that are transformed together: four in the real parts, four in the imaginary parts.
pub(crate) const LINES: usize = 8;

/// One sample of each line.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sample {
    /// Lines 0 to 3.
    pub(crate) re: f64x4,
    /// Lines 4 to 7.
    pub(crate) im: f64x4,
}

impl Sample {
    /// Takes the lines from consecutive values; lines that are missing are zero.
    #[inline(always)]
    pub(crate) fn load(values: &[f64]) -> Self {
        let mut lanes = [0.0; LINES];
        match values.first_chunk::<LINES>() {
            Some(full) => lanes = *full,
            None => lanes[..values.len()].copy_from_slice(values),
        }
        let [a, b, c, d, e, f, g, h] = lanes;
        Self {
            re: f64x4::new([a, b, c, d]),
            im: f64x4::new([e, f, g, h]),
        }
    }

    /// The lines as consecutive values.
    #[inline(always)]
    pub(crate) fn lanes(self) -> [f64; LINES] {
        let [a, b, c, d] = self.re.to_array();
        let [e, f, g, h] = self.im.to_array();
        [a, b, c, d, e, f, g, h]
    }

    /// Writes as many lines as `values` has room for.
    #[inline(always)]
    pub(crate) fn store(self, values: &mut [f64]) {
        match values.first_chunk_mut::<LINES>() {
            Some(full) => *full = self.lanes(),
            None => {
                let count = values.len();
                values.copy_from_slice(&self.lanes()[..count]);
            }
        }
    }

    /// Product with the complex number `[re, im]`.
    #[inline(always)]
    pub(crate) fn turned(self, by: [f64; 2]) -> Self {
        let (c, s) = (f64x4::splat(by[0]), f64x4::splat(by[1]));
        Self {
            re: self.re * c - self.im * s,
            im: self.re * s + self.im * c,
        }
    }

    /// Product with `-i`.
    #[inline(always)]
    fn quarter_turned_back(self) -> Self {
        Self {
            re: self.im,
            im: -self.re,
        }
    }

    /// Real and imaginary parts exchanged: turns the forward transform into the inverse one.
    #[inline(always)]
    pub(crate) fn swapped(self) -> Self {
        Self {
            re: self.im,
            im: self.re,
        }
    }
}

impl Add for Sample {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }
}

impl Sub for Sample {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            re: self.re - other.re,
            im: self.im - other.im,
        }
    }
}

impl Mul<f64> for Sample {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        let factor = f64x4::splat(factor);
        Self {
            re: self.re * factor,
            im: self.im * factor,
        }
    }
}

/// `[cos, sin]` of `-2 pi numerator / denominator`, folded into the first eighth of the circle so
/// that symmetric roots have the same digits.
pub(crate) fn root_of_unity(numerator: usize, denominator: usize) -> [f64; 2] {
    let part = numerator % denominator;
    // Eighths and the rest, both exact.
    let (octant, rest) = (8 * part / denominator, 8 * part % denominator);
    let folded = if octant % 2 == 0 {
        rest
    } else {
        denominator - rest
    };
    let angle = core::f64::consts::FRAC_PI_4 * (folded as f64 / denominator as f64);
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    let [x, y] = match octant {
        0 => [c, s],
        1 => [s, c],
        2 => [-s, c],
        3 => [-c, s],
        4 => [-c, -s],
        5 => [-s, -c],
        6 => [s, -c],
        _ => [c, -s],
    };
    [x, -y]
}

/// One pass of the transform: `radix`-point transforms over what earlier passes left.
#[derive(Debug, Clone)]
struct Pass {
    radix: usize,
    /// Length of the sub-transforms after this pass.
    rest: usize,
    /// Product of the radices of earlier passes.
    stride: usize,
    /// `radix - 1` factors for each of the `rest` positions.
    twiddles: Vec<[f64; 2]>,
    /// Roots of unity of the radix, for radices with no butterfly of their own.
    roots: Vec<[f64; 2]>,
}

/// Plan of the forward transform `X_k = sum x_n exp(-2 pi i n k / N)` (Stockham's self-sorting form).
#[derive(Debug, Clone)]
pub(crate) struct Fft {
    passes: Vec<Pass>,
}

impl Fft {
    /// Plans transforms of `length` samples.
    pub(crate) fn new(length: usize) -> Self {
        let mut passes = Vec::new();
        let (mut rest, mut stride) = (length, 1);
        for radix in radices(length) {
            let whole = rest;
            rest /= radix;
            passes.push(Pass::new(radix, whole, stride));
            stride *= radix;
        }
        Self { passes }
    }

    /// Transforms `input`; the result is the first of the two returned slices.
    pub(crate) fn forward<'a>(
        &self,
        input: &'a mut [Sample],
        spare: &'a mut [Sample],
    ) -> (&'a mut [Sample], &'a mut [Sample]) {
        let (mut from, mut to) = (input, spare);
        for pass in &self.passes {
            pass.run(from, to);
            core::mem::swap(&mut from, &mut to);
        }
        (from, to)
    }
}

/// Factors of `length`: fours, then a two, then odd primes.
fn radices(length: usize) -> Vec<usize> {
    let (mut rest, mut factors) = (length, Vec::new());
    for radix in [4, 2] {
        while rest.is_multiple_of(radix) {
            factors.push(radix);
            rest /= radix;
        }
    }
    let mut radix = 3;
    while rest > 1 {
        if rest.is_multiple_of(radix) {
            factors.push(radix);
            rest /= radix;
        } else if radix * radix > rest {
            radix = rest;
        } else {
            radix += 2;
        }
    }
    factors
}

impl Pass {
    fn new(radix: usize, whole: usize, stride: usize) -> Self {
        let rest = whole / radix;
        let twiddles = (0..rest)
            .flat_map(|p| (1..radix).map(move |j| root_of_unity(p * j, whole)))
            .collect();
        let roots = (0..radix).map(|j| root_of_unity(j, radix)).collect();
        Self {
            radix,
            rest,
            stride,
            twiddles,
            roots,
        }
    }

    fn run(&self, from: &[Sample], to: &mut [Sample]) {
        match self.radix {
            2 => self.radix_2(from, to),
            4 => self.radix_4(from, to),
            _ => self.radix_any(from, to),
        }
    }

    fn radix_2(&self, from: &[Sample], to: &mut [Sample]) {
        let s = self.stride;
        let (a, b) = from.split_at(s * self.rest);
        let terms = a.chunks_exact(s).zip(b.chunks_exact(s));
        let outs = to.chunks_exact_mut(2 * s).zip(&self.twiddles);
        for ((a, b), (out, w)) in terms.zip(outs) {
            let (sums, differences) = out.split_at_mut(s);
            let outs = sums.iter_mut().zip(differences);
            for ((a, b), (sum, difference)) in a.iter().zip(b).zip(outs) {
                *sum = *a + *b;
                *difference = (*a - *b).turned(*w);
            }
        }
    }

    fn radix_4(&self, from: &[Sample], to: &mut [Sample]) {
        let s = self.stride;
        let (half, quarter) = (2 * s * self.rest, s * self.rest);
        let ((a, b), (c, d)) = (
            from[..half].split_at(quarter),
            from[half..].split_at(quarter),
        );
        let [a, b, c, d] = [a, b, c, d].map(|part| part.chunks_exact(s));
        let outs = to
            .chunks_exact_mut(4 * s)
            .zip(self.twiddles.chunks_exact(3));
        for ((((a, b), c), d), (out, w)) in a.zip(b).zip(c).zip(d).zip(outs) {
            let (low, high) = out.split_at_mut(2 * s);
            let ((p, q), (r, t)) = (low.split_at_mut(s), high.split_at_mut(s));
            for n in 0..s {
                let (ac, bd) = (a[n] + c[n], b[n] + d[n]);
                let (a_c, b_d) = (a[n] - c[n], (b[n] - d[n]).quarter_turned_back());
                p[n] = ac + bd;
                q[n] = (a_c + b_d).turned(w[0]);
                r[n] = (ac - bd).turned(w[1]);
                t[n] = (a_c - b_d).turned(w[2]);
            }
        }
    }

    /// Odd radix: the sum over `j` is folded into sums and differences of `j` and `radix - j`.
    fn radix_any(&self, from: &[Sample], to: &mut [Sample]) {
        let (r, s) = (self.radix, self.stride);
        let part = s * self.rest;
        for (p, out) in to.chunks_exact_mut(r * s).enumerate() {
            let w = &self.twiddles[(r - 1) * p..(r - 1) * (p + 1)];
            for q in 0..s {
                let term = |j: usize| from[s * p + q + j * part];
                out[q] = (1..r).fold(term(0), |sum, j| sum + term(j));
                for k in 1..=r / 2 {
                    let (mut even, mut odd) = (term(0), Sample::default());
                    for j in 1..=r / 2 {
                        let [c, sine] = self.roots[j * k % r];
                        even = even + (term(j) + term(r - j)) * c;
                        odd = odd + (term(j) - term(r - j)) * -sine;
                    }
                    let odd = odd.quarter_turned_back();
                    out[q + k * s] = (even + odd).turned(w[k - 1]);
                    out[q + (r - k) * s] = (even - odd).turned(w[r - k - 1]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(length: usize) -> Vec<Sample> {
        (0..length)
            .map(|n| {
                let value = |l: usize| libm::sin((3 * n + 7 * l + n * n * (l + 1)) as f64);
                Sample::load(&core::array::from_fn::<f64, LINES, _>(value))
            })
            .collect()
    }

    /// The sum that defines the transform, for line pair `lane`.
    fn direct(input: &[Sample], k: usize, lane: usize) -> [f64; 2] {
        let n = input.len();
        let mut sum = [0.0; 2];
        for (i, sample) in input.iter().enumerate() {
            let [c, s] = root_of_unity(i * k, n);
            let (re, im) = (sample.lanes()[lane], sample.lanes()[lane + 4]);
            sum[0] += re * c - im * s;
            sum[1] += re * s + im * c;
        }
        sum
    }

    #[test]
    fn agrees_with_the_defining_sum_at_every_kind_of_length() {
        for length in [
            1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 30, 31, 32, 45, 49, 64, 77, 128,
        ] {
            let original = samples(length);
            let (mut a, mut b) = (original.clone(), original.clone());
            let (result, _) = Fft::new(length).forward(&mut a, &mut b);
            for k in 0..length {
                for lane in 0..4 {
                    let expected = direct(&original, k, lane);
                    let lanes = result[k].lanes();
                    let error =
                        (lanes[lane] - expected[0]).abs() + (lanes[lane + 4] - expected[1]).abs();
                    assert!(
                        error < 2e-14 * (length as f64).max(8.0),
                        "N {length} k {k}: {error:e}"
                    );
                }
            }
        }
    }

    #[test]
    fn roots_are_exact_on_the_axes_and_on_the_unit_circle() {
        assert_eq!(root_of_unity(0, 7), [1.0, -0.0]);
        assert_eq!(root_of_unity(2, 8), [-0.0, -1.0]);
        assert_eq!(root_of_unity(6, 12), [-1.0, 0.0]);
        for k in 0..100 {
            let [c, s] = root_of_unity(k, 100);
            assert!((c * c + s * s - 1.0).abs() < 3e-16);
            let angle = core::f64::consts::TAU * k as f64 / 100.0;
            assert!((c - libm::cos(angle)).abs() < 1e-15 && (s + libm::sin(angle)).abs() < 1e-15);
        }
    }
}
