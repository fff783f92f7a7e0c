//! Which bodies may be close: their boxes meet.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};

/// Pairs of boxes that meet, the lower number first, in order.
pub(crate) fn pairs(boxes: &[Aabb]) -> Vec<(usize, usize)> {
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, boxes);
    let mut found = Vec::new();
    tree.traverse_bvtt_single_tree::<false>(&mut BvhWorkspace::default(), &mut |a, b| {
        found.push((a.min(b) as usize, a.max(b) as usize));
    });
    found.sort_unstable();
    found
}
