//! Lanes of bodies: [`Real`] on the processor's SIMD registers.

use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use fearless_simd::{
    Bytes, ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdIntWiden, SimdMask, SimdNarrow,
};

use crate::real::{Real, Words, double};

/// Lanes that move to and from memory.
pub(crate) trait Lanes<S: Simd>: Real {
    type Scalar: Copy;
    /// Number of lanes.
    const COUNT: usize;
    fn load(simd: S, from: &[Self::Scalar]) -> Self;
    fn store(self, to: &mut [Self::Scalar]);
    /// From numbers of a double precision whatever the lanes'.
    fn load_doubles(simd: S, from: &[f64]) -> Self;
    fn load_words(simd: S, from: &[u32]) -> Self::Words;
    /// The low and the high words.
    fn load_halves(simd: S, from: &[u64]) -> [Self::Words; 2];
    fn splat(simd: S, value: f64) -> Self;
    /// Bit `i` for lane `i`.
    fn bits(mask: Self::Mask) -> u64;
}

/// Wraps the processor's widest vector of one type.
macro_rules! lanes {
    ($name:ident, $vector:ident, $mask:ident, $mask_name:ident) => {
        #[derive(Debug, Clone, Copy)]
        pub(crate) struct $name<S: Simd>(S::$vector);

        #[derive(Clone, Copy)]
        pub(crate) struct $mask_name<S: Simd>(S::$mask);

        lanes!(@binary $name, Add, add, +);
        lanes!(@binary $name, Sub, sub, -);
        lanes!(@binary $name, Mul, mul, *);
        lanes!(@binary $name, Div, div, /);
        lanes!(@binary $mask_name, BitAnd, bitand, &);
        lanes!(@binary $mask_name, BitOr, bitor, |);

        impl<S: Simd> Neg for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl<S: Simd> Not for $mask_name<S> {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0)
            }
        }
    };
    (@binary $name:ident, $trait:ident, $method:ident, $op:tt) => {
        impl<S: Simd> $trait for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $op other.0)
            }
        }
    };
}

lanes!(Doubles, f64s, mask64s, DoubleMask);
lanes!(Singles, f32s, mask32s, SingleMask);

/// A word in the low half of each 64-bit lane; the high half is anything.
#[derive(Clone, Copy)]
pub(crate) struct DoubleWords<S: Simd>(S::u64s);

#[derive(Clone, Copy)]
pub(crate) struct SingleWords<S: Simd>(S::u32s);

lanes!(@binary DoubleWords, BitXor, bitxor, ^);
lanes!(@binary SingleWords, BitXor, bitxor, ^);

const LOW: u64 = 0xFFFF_FFFF;

impl<S: Simd> Words for DoubleWords<S> {
    #[inline(always)]
    fn of(self, value: u32) -> Self {
        Self(S::u64s::splat(self.0.token(), u64::from(value)))
    }
    #[inline(always)]
    fn widening_mul(self, factor: u32) -> (Self, Self) {
        // The mask tells the compiler that one 32-bit multiplication is enough.
        let product = (self.0 & LOW) * u64::from(factor);
        (Self(product >> 32), Self(product))
    }
}

impl<S: Simd> Words for SingleWords<S> {
    #[inline(always)]
    fn of(self, value: u32) -> Self {
        Self(S::u32s::splat(self.0.token(), value))
    }
    #[inline(always)]
    fn widening_mul(self, factor: u32) -> (Self, Self) {
        let (low, high) = self.0.widening_mul(factor);
        (Self((low >> 32).narrow(high >> 32)), Self(self.0 * factor))
    }
}

impl<S: Simd> Doubles<S> {
    #[inline(always)]
    fn from_bits(bits: S::u64s) -> Self {
        Self(bits.bitcast())
    }
    #[inline(always)]
    fn to_bits(self) -> S::u64s {
        self.0.bitcast()
    }
}

impl<S: Simd> Real for Doubles<S> {
    type Mask = DoubleMask<S>;
    type Words = DoubleWords<S>;
    const NEGLIGIBLE: f64 = <f64 as Real>::NEGLIGIBLE;
    const LARGEST_EXPONENT: f64 = <f64 as Real>::LARGEST_EXPONENT;

    #[inline(always)]
    fn of(self, value: f64) -> Self {
        Self(S::f64s::splat(self.0.token(), value))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        DoubleMask(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        mask.0.any_true()
    }
    #[inline(always)]
    fn outlined<T>(self, f: impl FnOnce() -> T) -> T {
        self.0.token().vectorize(f)
    }
    #[inline(always)]
    fn map(mut self, f: impl Fn(f64) -> f64) -> Self {
        for i in 0..S::f64s::LEN {
            self.0[i] = f(self.0[i]);
        }
        self
    }
    #[inline(always)]
    fn uniform(bits: Self::Words) -> Self {
        Self::from_bits((bits.0 & LOW) | double::UNIT).minus(double::CENTRED)
    }
    #[inline(always)]
    fn eighth_turn(bits: Self::Words) -> Self {
        Self::from_bits((bits.0 & 0x3FFF_FFFF) | double::UNIT).minus(double::CENTRED + 0.125)
    }
    #[inline(always)]
    fn is_set(bits: Self::Words, bit: u32) -> Self::Mask {
        let wanted = bits.of(1 << bit).0;
        DoubleMask((bits.0 & wanted).simd_eq(wanted))
    }
    #[inline(always)]
    fn mantissa_and_exponent(self) -> (Self, Self) {
        let bits = self.to_bits();
        let biased = (bits + (double::ONE - double::HALF_SQRT)) >> 52;
        let mantissa = bits + double::ONE - (biased << 52);
        let exponent = Self::from_bits(biased | double::INTEGER).minus(double::TWO_52 + 1023.0);
        (Self::from_bits(mantissa), exponent)
    }
    #[inline(always)]
    fn nearest(self) -> Self {
        let rounder = self.of(double::ROUNDER);
        (self + rounder) - rounder
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Self::from_bits((self + self.of(double::ROUNDER + 1023.0)).to_bits() << 52)
    }
}

impl<S: Simd> Doubles<S> {
    #[inline(always)]
    fn minus(self, value: f64) -> Self {
        Self(self.0 - value)
    }
}

impl<S: Simd> Singles<S> {
    #[inline(always)]
    fn from_bits(bits: S::u32s) -> Self {
        Self(bits.bitcast())
    }
    #[inline(always)]
    fn to_bits(self) -> S::u32s {
        self.0.bitcast()
    }
}

/// Bits of `f32` numbers.
mod single {
    /// Bits of sqrt(1/2) and of 1.
    pub(super) const HALF_SQRT: u32 = 0x3F35_04F3;
    pub(super) const ONE: u32 = 127 << 23;
    /// 2^23, below which integers fit into its low bits.
    pub(super) const INTEGER: u32 = 0x4B00_0000;
    pub(super) const TWO_23: f32 = 8_388_608.0;
    pub(super) const ROUNDER: f32 = 1.5 * TWO_23;
}

impl<S: Simd> Real for Singles<S> {
    type Mask = SingleMask<S>;
    type Words = SingleWords<S>;
    const NEGLIGIBLE: f64 = 1e-5;
    const LARGEST_EXPONENT: f64 = 86.0;

    #[inline(always)]
    fn of(self, value: f64) -> Self {
        Self(S::f32s::splat(self.0.token(), value as f32))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        SingleMask(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn choose(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        mask.0.any_true()
    }
    #[inline(always)]
    fn outlined<T>(self, f: impl FnOnce() -> T) -> T {
        self.0.token().vectorize(f)
    }
    #[inline(always)]
    fn map(mut self, f: impl Fn(f64) -> f64) -> Self {
        for i in 0..S::f32s::LEN {
            self.0[i] = f(f64::from(self.0[i])) as f32;
        }
        self
    }
    #[inline(always)]
    fn uniform(bits: Self::Words) -> Self {
        Self(Self::from_bits((bits.0 >> 9) | single::ONE).0 - (1.0 - 0.5f32.powi(24)))
    }
    #[inline(always)]
    fn eighth_turn(bits: Self::Words) -> Self {
        let unit = Self::from_bits(((bits.0 >> 7) & 0x007F_FFFF) | single::ONE);
        Self((unit.0 - 1.5) * 0.25)
    }
    #[inline(always)]
    fn is_set(bits: Self::Words, bit: u32) -> Self::Mask {
        let wanted = bits.of(1 << bit).0;
        SingleMask((bits.0 & wanted).simd_eq(wanted))
    }
    #[inline(always)]
    fn mantissa_and_exponent(self) -> (Self, Self) {
        let bits = self.to_bits();
        let biased = (bits + (single::ONE - single::HALF_SQRT)) >> 23;
        let mantissa = bits + single::ONE - (biased << 23);
        let exponent = Self::from_bits(biased | single::INTEGER).0 - (single::TWO_23 + 127.0);
        (Self::from_bits(mantissa), Self(exponent))
    }
    #[inline(always)]
    fn nearest(self) -> Self {
        Self((self.0 + single::ROUNDER) - single::ROUNDER)
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Self::from_bits(Self(self.0 + (single::ROUNDER + 127.0)).to_bits() << 23)
    }
}

impl<S: Simd> Lanes<S> for Doubles<S> {
    type Scalar = f64;
    const COUNT: usize = S::f64s::LEN;

    #[inline(always)]
    fn load(simd: S, from: &[f64]) -> Self {
        Self(S::f64s::from_slice(simd, from))
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        self.0.store_slice(to);
    }
    #[inline(always)]
    fn load_doubles(simd: S, from: &[f64]) -> Self {
        Self::load(simd, from)
    }
    #[inline(always)]
    fn load_words(simd: S, from: &[u32]) -> DoubleWords<S> {
        DoubleWords(S::u64s::from_fn(simd, |i| u64::from(from[i])))
    }
    #[inline(always)]
    fn load_halves(simd: S, from: &[u64]) -> [DoubleWords<S>; 2] {
        let whole = S::u64s::from_slice(simd, from);
        [DoubleWords(whole), DoubleWords(whole >> 32)]
    }
    #[inline(always)]
    fn splat(simd: S, value: f64) -> Self {
        Self(S::f64s::splat(simd, value))
    }
    #[inline(always)]
    fn bits(mask: Self::Mask) -> u64 {
        mask.0.to_bitmask()
    }
}

impl<S: Simd> Lanes<S> for Singles<S> {
    type Scalar = f32;
    const COUNT: usize = S::f32s::LEN;

    #[inline(always)]
    fn load(simd: S, from: &[f32]) -> Self {
        Self(S::f32s::from_slice(simd, from))
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.0.store_slice(to);
    }
    #[inline(always)]
    fn load_doubles(simd: S, from: &[f64]) -> Self {
        Self(S::f32s::from_fn(simd, |i| from[i] as f32))
    }
    #[inline(always)]
    fn load_halves(simd: S, from: &[u64]) -> [SingleWords<S>; 2] {
        [0, 32].map(|shift| SingleWords(S::u32s::from_fn(simd, |i| (from[i] >> shift) as u32)))
    }
    #[inline(always)]
    fn load_words(simd: S, from: &[u32]) -> SingleWords<S> {
        SingleWords(S::u32s::from_slice(simd, from))
    }
    #[inline(always)]
    fn splat(simd: S, value: f64) -> Self {
        Self(S::f32s::splat(simd, value as f32))
    }
    #[inline(always)]
    fn bits(mask: Self::Mask) -> u64 {
        mask.0.to_bitmask()
    }
}
