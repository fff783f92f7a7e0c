//! Numbers out of bytes. Where the bytes are used up they are zero.

use arbitrary::{Arbitrary, Unstructured};

/// Reads numbers and choices off bytes.
pub(crate) struct Numbers<'a>(Unstructured<'a>);

impl<'a> Numbers<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self(Unstructured::new(bytes))
    }

    pub(crate) fn any<T: Arbitrary<'a> + Default>(&mut self) -> T {
        self.0.arbitrary().unwrap_or_default()
    }

    /// A number below `count`, which is at most 256.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        usize::from(self.any::<u8>()) % count
    }

    /// One of the items.
    pub(crate) fn among<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.below(items.len())]
    }

    /// A number in [0, 1].
    pub(crate) fn unit(&mut self) -> f64 {
        f64::from(self.any::<u16>()) / f64::from(u16::MAX)
    }

    /// A number whose logarithm is uniform from `low` to `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        (low * (high / low).powf(self.unit())).clamp(low, high)
    }

    /// A vector with components up to `most` either way.
    pub(crate) fn vector(&mut self, most: f64) -> [f64; 3] {
        [(); 3].map(|()| most * (2.0 * self.unit() - 1.0))
    }

    /// A coordinate: mostly on a coarse grid, so that places coincide; sometimes extreme, or any bits.
    pub(crate) fn coordinate(&mut self) -> f64 {
        match self.below(8) {
            0..=5 => f64::from(self.any::<i8>()) / 16.0,
            6 => f64::from(self.any::<i16>()) * 10f64.powi(i32::from(self.any::<i8>()) / 2),
            _ => f64::from_bits(self.any()),
        }
    }
}
