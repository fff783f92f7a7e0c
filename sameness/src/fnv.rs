//! The hash FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), 64 bits.

use langevin_rigid::State;

#[derive(Debug, Clone, Copy)]
pub(crate) struct Fnv(pub(crate) u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Fnv {
    pub(crate) fn word(&mut self, word: u64) {
        self.bytes(&word.to_le_bytes());
    }

    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }

    pub(crate) fn state(&mut self, state: &State) {
        self.word(state.step);
        let vectors = [state.position, state.velocity, state.angular_velocity];
        for x in vectors
            .as_flattened()
            .iter()
            .chain(&state.orientation)
            .chain(&state.fluctuation)
            .chain([&state.time])
        {
            self.word(x.to_bits());
        }
    }
}
