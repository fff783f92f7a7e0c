//! Impulses of the last step: where the next one begins.

use parry3d_f64::math::Vector;

/// Which hulls a patch is between: of an obstacle or a body, and of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    pub(super) obstacle: Option<u32>,
    pub(super) a: u32,
    pub(super) part_a: u32,
    pub(super) b: u32,
    pub(super) part_b: u32,
}

/// An impulse at a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held {
    pub(super) key: Key,
    /// Where it acted, in the frame of b (m).
    pub(super) at: Vector,
    /// On b, world frame (N s).
    pub(super) impulse: Vector,
    /// From a to b, world frame.
    pub(super) normal: Vector,
    /// Whether the two are too far in each other to be let be.
    pub(super) is_deep: bool,
}

/// All impulses of a step, in the order of their keys.
#[derive(Debug, Clone, Default)]
pub(super) struct Impulses {
    sorted: Vec<Held>,
}

impl Impulses {
    pub(super) fn new(mut held: Vec<Held>) -> Self {
        held.sort_by_key(|held| held.key);
        Self { sorted: held }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Held> {
        self.sorted.iter()
    }

    /// Those of a patch.
    pub(super) fn of(&self, key: Key) -> impl Iterator<Item = &Held> {
        let from = self.sorted.partition_point(|held| held.key < key);
        self.sorted[from..]
            .iter()
            .take_while(move |held| held.key == key)
    }

    /// The normal at which two touched.
    pub(super) fn normal(&self, key: Key) -> Option<Vector> {
        self.of(key).next().map(|held| held.normal)
    }
}
