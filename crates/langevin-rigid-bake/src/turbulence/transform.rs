//! Real transforms that diagonalize the second difference along one axis.
//!
//! | bounds                      | eigenvectors at cell `n`              | transform | eigenvalue of `-d2`           |
//! |-----------------------------|---------------------------------------|-----------|-------------------------------|
//! | periodic                    | `cos + sin` of `2 pi n k / N`         | Hartley   | `4 sin^2(pi k / N)`           |
//! | walls (Neumann, Neumann)    | `cos(pi (n + 1/2) k / N)`             | DCT-II    | `4 sin^2(pi k / 2N)`          |
//! | through (Neumann, Dirichlet)| `cos(pi (n + 1/2)(k + 1/2) / N)`      | DCT-IV    | `4 sin^2(pi (k + 1/2) / 2N)`  |
//!
//! Bounds are faces of cells, half a cell from the outer centres: zero slope there mirrors the
//! outer cell, a zero value there mirrors it with its sign changed, and the cosines above are what
//! these mirrors leave unchanged. All three are one complex transform of `N` samples that carries
//! two real lines: reorder, transform, part the two lines by the symmetry of their spectra, turn.

use super::fft::{Fft, Sample, root_of_unity};
use super::lattice::Boundary;

/// Buffers of one line of samples; `line` is what a transform reads and where it leaves its result.
#[derive(Debug)]
pub(crate) struct Workspace {
    pub(crate) line: Vec<Sample>,
    first: Vec<Sample>,
    second: Vec<Sample>,
}

impl Workspace {
    /// Room for lines of up to `length` samples.
    pub(crate) fn new(length: usize) -> Self {
        let empty = vec![Sample::default(); length];
        Self {
            line: empty.clone(),
            first: empty.clone(),
            second: empty,
        }
    }
}

/// The transform along one axis, for its number of cells and its bounds.
#[derive(Debug, Clone)]
pub(crate) struct AxisTransform {
    boundary: Boundary,
    length: usize,
    fft: Fft,
    /// Turns of DCT-IV before the complex transform.
    before: Vec<[f64; 2]>,
    /// Turns after it, the halving of the parted spectra included.
    after: Vec<[f64; 2]>,
    /// Eigenvalues of minus the second difference, in units of 1/cell^2.
    pub(crate) eigenvalues: Vec<f64>,
    /// `inverse(forward(x)) = x / scale`.
    pub(crate) scale: f64,
}

impl AxisTransform {
    /// Plans the transform of `length` cells.
    pub(crate) fn new(length: usize, boundary: Boundary) -> Self {
        let through = boundary == Boundary::Through;
        let before = (0..length)
            .filter(|_| through)
            .map(|n| root_of_unity(n, 2 * length))
            .collect();
        let after = (0..length).map(|k| after(k, length, boundary)).collect();
        let eigenvalues = (0..length)
            .map(|k| eigenvalue(k, length, boundary))
            .collect();
        Self {
            boundary,
            length,
            fft: Fft::new(length),
            before,
            after,
            eigenvalues,
            scale: if through { 2.0 } else { 1.0 } / length as f64,
        }
    }

    /// Coefficients of the eigenvectors, not normalized.
    pub(crate) fn forward(&self, work: &mut Workspace) {
        let n = self.length;
        for m in 0..n {
            work.first[m] = self.reordered(&work.line, m);
        }
        let (spectrum, _) = self
            .fft
            .forward(&mut work.first[..n], &mut work.second[..n]);
        let mirror = if self.boundary == Boundary::Through {
            n - 1
        } else {
            n
        };
        for k in 0..n {
            let [c, s] = self.after[k];
            let (here, there) = (spectrum[k], spectrum[(mirror - k) % n]);
            let (sum, difference) = (here + there, here - there);
            work.line[k] = Sample {
                re: sum.re * c - difference.im * s,
                im: sum.im * c + difference.re * s,
            };
        }
    }

    /// Values from coefficients; divide by `scale` what went through `forward` first.
    pub(crate) fn inverse(&self, work: &mut Workspace) {
        match self.boundary {
            // Both are their own inverse.
            Boundary::Periodic | Boundary::Through => self.forward(work),
            Boundary::Walls => self.inverse_dct_ii(work),
        }
    }

    /// Even samples forwards, then odd samples backwards (Makhoul 1980); a period as it is.
    #[inline]
    fn reordered(&self, line: &[Sample], m: usize) -> Sample {
        if self.boundary == Boundary::Periodic {
            return line[m];
        }
        let back = 2 * m >= self.length;
        let sample = line[if back {
            2 * (self.length - m) - 1
        } else {
            2 * m
        }];
        match self.before.get(m) {
            None => sample,
            Some(turn) if back => sample.turned([-turn[0], -turn[1]]),
            Some(turn) => sample.turned(*turn),
        }
    }

    fn inverse_dct_ii(&self, work: &mut Workspace) {
        let n = self.length;
        for k in 0..n {
            let here = work.line[k];
            let there = if k == 0 {
                Sample::default()
            } else {
                work.line[n - k]
            };
            // Spectra of the two lines, recombined; the half in `after` is undone.
            let [c, s] = [2.0 * self.after[k][0], 2.0 * self.after[k][1]];
            let real = here * c - there * s;
            let imaginary = here * -s - there * c;
            let joined = Sample {
                re: real.re - imaginary.im,
                im: imaginary.re + real.im,
            };
            work.first[k] = joined.swapped();
        }
        let (values, _) = self
            .fft
            .forward(&mut work.first[..n], &mut work.second[..n]);
        for m in 0..n {
            let to = if 2 * m >= n { 2 * (n - m) - 1 } else { 2 * m };
            work.line[to] = values[m].swapped();
        }
    }
}

/// Half the turn that brings the spectrum of a line to its real coefficient `k`.
fn after(k: usize, length: usize, boundary: Boundary) -> [f64; 2] {
    let [c, s] = match boundary {
        // Re((1 + i) X) = Re X - Im X: the Hartley coefficient.
        Boundary::Periodic => [1.0, 1.0],
        Boundary::Walls => root_of_unity(k, 4 * length),
        Boundary::Through => root_of_unity(2 * k + 1, 8 * length),
    };
    [0.5 * c, 0.5 * s]
}

/// Eigenvalue `k` of minus the second difference (in cells).
fn eigenvalue(k: usize, length: usize, boundary: Boundary) -> f64 {
    let [_, sine] = match boundary {
        Boundary::Periodic => root_of_unity(k, 2 * length),
        Boundary::Walls => root_of_unity(k, 4 * length),
        Boundary::Through => root_of_unity(2 * k + 1, 8 * length),
    };
    4.0 * sine * sine
}

#[cfg(test)]
mod tests {
    use super::super::fft::LINES;
    use super::*;

    const KINDS: [Boundary; 3] = [Boundary::Periodic, Boundary::Walls, Boundary::Through];
    const LENGTHS: [usize; 12] = [1, 2, 3, 4, 5, 8, 9, 14, 16, 31, 32, 60];

    fn lines(length: usize) -> Vec<Sample> {
        (0..length)
            .map(|n| {
                let value = |l: usize| libm::cos((5 * n + 3 * l + n * n * (l + 2)) as f64);
                Sample::load(&core::array::from_fn::<f64, LINES, _>(value))
            })
            .collect()
    }

    fn largest_difference(a: &[Sample], b: &[Sample]) -> f64 {
        let differences = a.iter().zip(b).flat_map(|(a, b)| (*a - *b).lanes());
        differences.fold(0.0, |worst, d| worst.max(d.abs()))
    }

    #[test]
    fn inverse_undoes_forward() {
        for boundary in KINDS {
            for length in LENGTHS {
                let transform = AxisTransform::new(length, boundary);
                let mut work = Workspace::new(length);
                work.line = lines(length);
                transform.forward(&mut work);
                transform.inverse(&mut work);
                let back: Vec<_> = work.line.iter().map(|s| *s * transform.scale).collect();
                let error = largest_difference(&back, &lines(length));
                assert!(error < 4e-15, "{boundary:?} {length}: {error:e}");
            }
        }
    }

    /// Second difference of a line with its bounds at the outer faces.
    fn second_difference(line: &[Sample], boundary: Boundary) -> Vec<Sample> {
        let n = line.len();
        let (before, after) = match boundary {
            Boundary::Periodic => (line[n - 1], line[0]),
            Boundary::Walls => (line[0], line[n - 1]),
            Boundary::Through => (line[0], line[n - 1] * -1.0),
        };
        let at = |i: usize| match i {
            0 => before,
            i if i == n + 1 => after,
            i => line[i - 1],
        };
        (1..=n)
            .map(|i| at(i - 1) + at(i + 1) - at(i) * 2.0)
            .collect()
    }

    /// Fails when a transform does not belong to its bounds: Neumann-Dirichlet is DCT-IV.
    #[test]
    fn second_difference_is_diagonal_in_the_coefficients() {
        for boundary in KINDS {
            for length in LENGTHS {
                let transform = AxisTransform::new(length, boundary);
                let mut work = Workspace::new(length);
                work.line = lines(length);
                transform.forward(&mut work);
                let expected: Vec<_> = (0..length)
                    .map(|k| work.line[k] * -transform.eigenvalues[k])
                    .collect();
                work.line = second_difference(&lines(length), boundary);
                transform.forward(&mut work);
                let error = largest_difference(&work.line, &expected);
                assert!(
                    error < 5e-15 * length.max(8) as f64,
                    "{boundary:?} {length}: {error:e}"
                );
            }
        }
    }
}
