//! The number that the step's arithmetic is written in: one body's `f64`, or SIMD lanes of bodies.
//!
//! The equations are written once over [`Real`]. Every operation is exact IEEE arithmetic lane by
//! lane, in one order and without fused multiply-adds, so a body has the same bits alone and in a
//! batch, at any SIMD width.

use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// One number or one per lane.
pub(crate) trait Real:
    Copy
    + std::fmt::Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The outcome of a comparison.
    type Mask: Copy
        + BitAnd<Output = Self::Mask>
        + BitOr<Output = Self::Mask>
        + Not<Output = Self::Mask>;
    /// 32-bit words, one a lane.
    type Words: Words;
    /// Whether this is one body, not lanes of bodies.
    const ALONE: bool = false;
    /// What counts as zero beside one, a little above rounding.
    const NEGLIGIBLE: f64;
    /// Largest |x| with e^x and e^-x normal.
    const LARGEST_EXPONENT: f64;

    /// `value` in the lanes of `self`.
    fn of(self, value: f64) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    fn less(self, other: Self) -> Self::Mask;
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self;
    fn any(mask: Self::Mask) -> bool;
    /// `f` of each lane, for what is seldom needed.
    fn map(self, f: impl Fn(f64) -> f64) -> Self;
    /// What `f` returns, from a function of its own for the processor at hand.
    fn outlined<T>(self, f: impl FnOnce() -> T) -> T;

    /// What `f` returns, for what is called from several places. With debug assertions it is compiled once, and the crate
    /// in half the time; without, a step takes 5 to 9 % fewer instructions.
    #[inline(always)]
    fn apart<T>(self, f: impl FnOnce() -> T) -> T {
        if cfg!(debug_assertions) {
            self.outlined(f)
        } else {
            f()
        }
    }

    /// Uniform on (0, 1) from 32 random bits.
    fn uniform(bits: Self::Words) -> Self;
    /// Uniform on an eighth of a turn to both sides of zero, in turns, from the low 30 bits.
    fn eighth_turn(bits: Self::Words) -> Self;
    /// Whether bit `bit` is set.
    fn is_set(bits: Self::Words, bit: u32) -> Self::Mask;
    /// Mantissa in [sqrt(1/2), sqrt(2)) and exponent of a positive normal number.
    fn mantissa_and_exponent(self) -> (Self, Self);
    /// The nearest integer, for |x| < 2^20.
    fn nearest(self) -> Self;
    /// 2^n of an integer n that leaves it normal.
    fn power_of_two(self) -> Self;

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::choose(other.less(self), other, self)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::choose(self.less(other), other, self)
    }
}

/// 32-bit words, one a lane.
pub(crate) trait Words: Copy + BitXor<Output = Self> {
    /// `value` in the lanes of `self`.
    fn of(self, value: u32) -> Self;
    /// High and low word of the 64-bit product with the word of `self`.
    fn widening_mul(self, factor: u32) -> (Self, Self);
}

/// Bits of `f64` numbers, the same for one and for lanes.
pub(crate) mod double {
    /// Bits of sqrt(1/2).
    pub(crate) const HALF_SQRT: u64 = 0x3FE6_A09E_667F_3BCD;
    /// The exponent field of 1, in place.
    pub(crate) const ONE: u64 = 1023 << 52;
    /// 2^52: an integer below it, put into its low bits, is added to it.
    pub(crate) const INTEGER: u64 = 0x433 << 52;
    /// 2^20: its last bit is 2^-32.
    pub(crate) const UNIT: u64 = 0x413 << 52;
    pub(crate) const TWO_52: f64 = 4_503_599_627_370_496.0;
    /// 2^20 less half its last bit.
    pub(crate) const CENTRED: f64 = 1_048_576.0 - 0.5 / 4_294_967_296.0;
    /// 1.5 * 2^52: adding it rounds to an integer.
    pub(crate) const ROUNDER: f64 = 1.5 * TWO_52;
}

impl Real for f64 {
    type Mask = bool;
    type Words = u32;
    const ALONE: bool = true;
    const NEGLIGIBLE: f64 = 1e-9;
    const LARGEST_EXPONENT: f64 = 700.0;

    #[inline(always)]
    fn of(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn choose(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }
    #[inline(never)]
    fn outlined<T>(self, f: impl FnOnce() -> T) -> T {
        f()
    }
    #[inline(always)]
    fn uniform(bits: u32) -> Self {
        f64::from_bits(double::UNIT | u64::from(bits)) - double::CENTRED
    }
    #[inline(always)]
    fn eighth_turn(bits: u32) -> Self {
        f64::from_bits(double::UNIT | u64::from(bits & 0x3FFF_FFFF)) - (double::CENTRED + 0.125)
    }
    #[inline(always)]
    fn is_set(bits: u32, bit: u32) -> bool {
        bits & (1 << bit) != 0
    }
    #[inline(always)]
    fn mantissa_and_exponent(self) -> (Self, Self) {
        let shifted = self.to_bits() + (double::ONE - double::HALF_SQRT);
        let biased = shifted >> 52;
        let mantissa = self.to_bits() + double::ONE - (biased << 52);
        let exponent = f64::from_bits(double::INTEGER | biased) - (double::TWO_52 + 1023.0);
        (f64::from_bits(mantissa), exponent)
    }
    #[inline(always)]
    fn nearest(self) -> Self {
        (self + double::ROUNDER) - double::ROUNDER
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        // The sum's low bits are n + 1023, wherever the shift puts the others.
        f64::from_bits((self + (double::ROUNDER + 1023.0)).to_bits() << 52)
    }
}

impl Words for u32 {
    #[inline(always)]
    fn of(self, value: u32) -> Self {
        value
    }
    #[inline(always)]
    fn widening_mul(self, factor: u32) -> (Self, Self) {
        let product = u64::from(self) * u64::from(factor);
        ((product >> 32) as u32, product as u32)
    }
}
