//! Solid harmonics: what a cloud of charges looks like from afar, and how it acts there.
//!
//! 1/|x - y| = sum_nm conj(R_nm(y)) I_nm(x) for |y| < |x|, with R_nm = r^n P_nm e^(i m phi) / (n + m)! and
//! I_nm = (n - m)! P_nm e^(i m phi) / r^(n+1) (C. A. White and M. Head-Gordon, 1994). Both expansions are kept
//! real, in the basis (R_n0, sqrt 2 Re R_nm, sqrt 2 Im R_nm), in which a translation and its reverse are
//! each other's transpose.

use super::panels::Vec3;

/// Highest degree n.
pub(super) const DEGREE: usize = 6;
/// Coefficients of an expansion.
pub(super) const TERMS: usize = (DEGREE + 1) * (DEGREE + 1);

const SQRT_2: f64 = std::f64::consts::SQRT_2;

/// A complex number.
type Complex = [f64; 2];

/// Degrees of the irregular harmonics of a translation.
const BOTH: usize = 2 * DEGREE;

/// Place of (n, m) in a triangle of harmonics with m >= 0.
const fn place(n: usize, m: usize) -> usize {
    n * (n + 1) / 2 + m
}

/// The real basis at `x`, from the centre of the expansion: (n, 0) at n^2, (n, m) at n^2 + 2 m - 1 and
/// the imaginary part behind it.
pub(super) fn basis(x: Vec3) -> [f64; TERMS] {
    let r = regular(x);
    let mut basis = [0.0; TERMS];
    for n in 0..=DEGREE {
        basis[n * n] = r[place(n, 0)][0];
        for m in 1..=n {
            let [real, imaginary] = r[place(n, m)];
            basis[n * n + 2 * m - 1] = SQRT_2 * real;
            basis[n * n + 2 * m] = SQRT_2 * imaginary;
        }
    }
    basis
}

fn regular([x, y, z]: Vec3) -> [Complex; place(DEGREE + 1, 0)] {
    let r2 = x * x + y * y + z * z;
    let mut r = [[0.0; 2]; place(DEGREE + 1, 0)];
    r[0] = [1.0, 0.0];
    for m in 0..=DEGREE {
        if m > 0 {
            let [a, b] = r[place(m - 1, m - 1)];
            let half = 0.5 / m as f64;
            r[place(m, m)] = [half * (x * a - y * b), half * (x * b + y * a)];
        }
        for n in m + 1..=DEGREE {
            let below = r[place(n - 1, m)];
            let before = if n > m + 1 {
                r[place(n - 2, m)]
            } else {
                [0.0; 2]
            };
            let scale = 1.0 / ((n * n - m * m) as f64);
            let ahead = (2 * n - 1) as f64 * z;
            r[place(n, m)] = [0, 1].map(|c| scale * (ahead * below[c] - r2 * before[c]));
        }
    }
    r
}

fn irregular([x, y, z]: Vec3) -> [Complex; place(BOTH + 1, 0)] {
    let per_r2 = 1.0 / (x * x + y * y + z * z);
    let mut i = [[0.0; 2]; place(BOTH + 1, 0)];
    i[0] = [per_r2.sqrt(), 0.0];
    for m in 0..=BOTH {
        if m > 0 {
            let [a, b] = i[place(m - 1, m - 1)];
            let scale = (2 * m - 1) as f64 * per_r2;
            i[place(m, m)] = [scale * (x * a - y * b), scale * (x * b + y * a)];
        }
        for n in m + 1..=BOTH {
            let below = i[place(n - 1, m)];
            let before = if n > m + 1 {
                i[place(n - 2, m)]
            } else {
                [0.0; 2]
            };
            let ahead = (2 * n - 1) as f64 * z;
            let back = ((n - 1) * (n - 1) - m * m) as f64;
            i[place(n, m)] = [0, 1].map(|c| per_r2 * (ahead * below[c] - back * before[c]));
        }
    }
    i
}

/// The matrix, by rows, that turns the moments of charges about one centre into the coefficients of
/// their potential about another, `d` away from the first.
pub(super) struct Translation {
    pub(super) rows: [[f64; TERMS]; TERMS],
}

impl Translation {
    pub(super) fn new(d: Vec3) -> Translation {
        let harmonics = irregular(d);
        let mut rows = [[0.0; TERMS]; TERMS];
        for sum in 0..=BOTH {
            let own = &harmonics[place(sum, 0)..place(sum + 1, 0)];
            // Of negative orders too.
            let mut signed = [[0.0; 2]; 2 * BOTH + 1];
            for (m, &[a, b]) in own.iter().enumerate() {
                signed[BOTH + m] = [a, b];
                signed[BOTH - m] = if m % 2 == 0 { [a, -b] } else { [-a, b] };
            }
            for j in sum.saturating_sub(DEGREE)..=sum.min(DEGREE) {
                degrees(&signed, j, sum - j, &mut rows);
            }
        }
        Translation { rows }
    }
}

/// The entries of local degree `j` and moments of degree `n`, from the harmonics of degree n + j, order
/// zero in their middle.
#[inline(always)]
fn degrees(
    harmonics: &[Complex; 2 * BOTH + 1],
    j: usize,
    n: usize,
    rows: &mut [[f64; TERMS]; TERMS],
) {
    let sign = if j.is_multiple_of(2) { 1.0 } else { -1.0 };
    let at = |m: usize| harmonics[m].map(|x| sign * x);
    rows[j * j][n * n] = at(BOTH)[0];
    for m in 1..=n {
        let columns = n * n + 2 * m - 1;
        let [a, b] = at(BOTH + m);
        rows[j * j][columns] = SQRT_2 * a;
        rows[j * j][columns + 1] = SQRT_2 * b;
    }
    for k in 1..=j {
        let row = j * j + 2 * k - 1;
        let [a, b] = at(BOTH + k);
        rows[row][n * n] = SQRT_2 * a;
        rows[row + 1][n * n] = SQRT_2 * b;
        let mut other = sign;
        for m in 1..=n {
            other = -other;
            let columns = n * n + 2 * m - 1;
            let [ar, ai] = at(BOTH + k + m);
            let [br, bi] = harmonics[BOTH + k - m].map(|x| other * x);
            rows[row][columns] = ar + br;
            rows[row + 1][columns] = ai + bi;
            rows[row][columns + 1] = ai - bi;
            rows[row + 1][columns + 1] = br - ar;
        }
    }
}

/// The matrix, by rows, that turns moments about one centre into those about another, `s` being the
/// old centre from the new one; its transpose turns coefficients about the new centre into those
/// about the old one. The entries of a degree in higher degrees are zero.
pub(super) struct Shift {
    pub(super) rows: [[f64; TERMS]; TERMS],
}

impl Shift {
    pub(super) fn new(s: Vec3) -> Shift {
        let harmonics = regular(s);
        let mut rows = [[0.0; TERMS]; TERMS];
        for n in 0..=DEGREE {
            for j in 0..=n {
                let own = &harmonics[place(n - j, 0)..place(n - j + 1, 0)];
                shifted_degrees(own, n, j, &mut rows);
            }
        }
        Shift { rows }
    }
}

/// R_nm(y + s) = sum_jk R_(n-j)(m-k)(s) R_jk(y): the entries of degrees `n` and `j`, from the harmonics of
/// degree n - j.
fn shifted_degrees(own: &[Complex], n: usize, j: usize, rows: &mut [[f64; TERMS]; TERMS]) {
    for m in 0..=n {
        let (real, imaginary) = (n * n + (2 * m).saturating_sub(1), n * n + 2 * m);
        for k in 0..=j {
            let (cos, sin) = (j * j + (2 * k).saturating_sub(1), j * j + 2 * k);
            let [ar, ai] = signed(own, m as isize - k as isize);
            let [br, bi] = signed(own, (m + k) as isize).map(|b| if k % 2 == 0 { b } else { -b });
            match (m, k) {
                (0, 0) => rows[real][cos] = ar,
                (0, _) => {
                    rows[real][cos] = (ar + br) / SQRT_2;
                    rows[real][sin] = (bi - ai) / SQRT_2;
                }
                (_, 0) => {
                    rows[real][cos] = SQRT_2 * ar;
                    rows[imaginary][cos] = SQRT_2 * ai;
                }
                _ => {
                    rows[real][cos] = ar + br;
                    rows[imaginary][cos] = ai + bi;
                    rows[real][sin] = bi - ai;
                    rows[imaginary][sin] = ar - br;
                }
            }
        }
    }
}

/// The harmonic of order `m` of one degree, those with m >= 0 given; zero beyond the degree.
///
/// X_n^(-m) = (-1)^m conj X_n^m.
fn signed(own: &[Complex], m: isize) -> Complex {
    let Some(&[a, b]) = own.get(m.unsigned_abs()) else {
        return [0.0; 2];
    };
    match m {
        m if m >= 0 => [a, b],
        m if m % 2 == 0 => [a, -b],
        _ => [-a, b],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::vector::{norm, sub};

    #[test]
    fn a_charge_acts_through_its_moments_as_directly() {
        let (y, d, u): (Vec3, Vec3, Vec3) = ([0.3, -0.2, 0.25], [3.0, -2.0, 1.5], [-0.2, 0.3, 0.1]);
        let translation = Translation::new(d);
        let (moments, local) = (basis(y), basis(u));
        let potential: f64 = (0..TERMS)
            .map(|i| {
                (0..TERMS)
                    .map(|j| local[i] * translation.rows[i][j] * moments[j])
                    .sum::<f64>()
            })
            .sum();
        let x: Vec3 = std::array::from_fn(|k| d[k] + u[k]);
        let direct = 1.0 / norm(sub(x, y));
        assert!(
            (potential / direct - 1.0).abs() < 1e-5,
            "{potential} {direct}"
        );
    }

    #[test]
    fn moments_move_with_their_centre() {
        let (y, s): (Vec3, Vec3) = ([0.3, -0.2, 0.25], [0.4, 0.1, -0.6]);
        let (old, new) = (basis(y), basis(std::array::from_fn(|k| y[k] + s[k])));
        let shift = Shift::new(s);
        for (n, row) in shift.rows.iter().enumerate() {
            let moved: f64 = row.iter().zip(&old).map(|(m, x)| m * x).sum();
            assert!(
                (moved - new[n]).abs() < 1e-15,
                "{n}: {moved} for {}",
                new[n]
            );
        }
    }

    #[test]
    fn the_reverse_is_the_transpose() {
        let d = [1.0, 0.7, -2.0];
        let (there, back) = (Translation::new(d), Translation::new(d.map(|x| -x)));
        for i in 0..TERMS {
            for j in 0..TERMS {
                let (a, b) = (there.rows[i][j], back.rows[j][i]);
                assert!(
                    (a - b).abs() <= 1e-13 * (a.abs() + b.abs() + 1e-3),
                    "{i} {j}: {a} {b}"
                );
            }
        }
    }
}
