//! What is so close that it may meet in a step.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::impulses::Key;
use super::{Member, World, placed};
use crate::broad;
use crate::contact::Patch;
use crate::contact::narrow::{self, Placed};
use crate::obstacle::{Geometry, Obstacle};
use crate::sleep;

/// A patch between two parts.
pub(super) struct Met {
    pub(super) key: Key,
    pub(super) patch: Patch,
    /// Gap that is kept (m).
    pub(super) skin: f64,
}

/// Gap that is kept between two bodies, in radii of the smaller one.
const SKIN: f64 = 5e-4;

/// Pairs that one thread looks at without a break: a pair takes microseconds.
const PAIRS: usize = 32;

impl World {
    /// How far a body may go in a step (m).
    fn stride(&self, member: &Member, dt: f64) -> f64 {
        if member.rest.is_asleep() {
            return 0.0;
        }
        1.5 * sleep::fastest(&member.state, member.kind.shape().radius()) * dt
            + 2.0 * self.gravity * dt * dt
    }

    /// All that is close: obstacles to each body, then bodies to each other.
    pub(super) fn meet(&self, dt: f64) -> Vec<Met> {
        let strides: Vec<f64> = self
            .members
            .iter()
            .map(|member| self.stride(member, dt))
            .collect();
        let around = |(member, stride): (&Member, &f64)| {
            bounds(member).loosened(stride + SKIN * member.kind.shape().radius())
        };
        let boxes: Vec<Aabb> = self.members.iter().zip(&strides).map(around).collect();
        let awake = |body: usize| !self.is_asleep(body);
        let mut pairs = broad::pairs(&boxes);
        pairs.retain(|(a, b)| awake(*a) || awake(*b));
        let mut met: Vec<Met> = (0..self.members.len())
            .into_par_iter()
            .with_min_len(PAIRS)
            .filter(|body| awake(*body))
            .flat_map_iter(|body| self.obstacles_met(body, &boxes[body], strides[body]))
            .collect();
        met.par_extend(
            pairs
                .into_par_iter()
                .with_min_len(PAIRS)
                .flat_map_iter(|pair| self.bodies_met(pair, strides[pair.0] + strides[pair.1])),
        );
        met
    }

    /// Where two bodies are closer than `reach` (m).
    pub(super) fn bodies_met(&self, (a, b): (usize, usize), reach: f64) -> Vec<Met> {
        let (first, second) = (&self.members[a], &self.members[b]);
        let skin = SKIN
            * first
                .kind
                .shape()
                .radius()
                .min(second.kind.shape().radius());
        let mut met = Vec::new();
        for (part_a, hull_a) in parts(first) {
            for (part_b, hull_b) in parts(second) {
                let key = Key {
                    obstacle: None,
                    a: a as u32,
                    part_a,
                    b: b as u32,
                    part_b,
                };
                let before = self.impulses.normal(key);
                let patch = narrow::hulls(hull_a, hull_b, reach + skin, before);
                met.extend(patch.map(|patch| Met { key, patch, skin }));
            }
        }
        met
    }

    /// Where a body, all of which is in the box `around`, is closer to an obstacle than `reach` (m).
    pub(super) fn obstacles_met(&self, body: usize, around: &Aabb, reach: f64) -> Vec<Met> {
        let mut met = Vec::new();
        for (number, obstacle) in self.obstacles.iter().enumerate() {
            if obstacle
                .bounds()
                .is_none_or(|bounds| bounds.intersects(around))
            {
                self.obstacle_met((number, obstacle), body, around, reach, &mut met);
            }
        }
        met
    }

    fn obstacle_met(
        &self,
        (number, obstacle): (usize, &Obstacle),
        body: usize,
        around: &Aabb,
        reach: f64,
        met: &mut Vec<Met>,
    ) {
        let member = &self.members[body];
        let skin = SKIN * member.kind.shape().radius();
        let reach = reach + skin;
        for (part_b, hull) in parts(member) {
            let key = |part_a: u32| Key {
                obstacle: Some(number as u32),
                a: 0,
                part_a,
                b: body as u32,
                part_b,
            };
            let mut add = |key: Key, patch: Option<Patch>| {
                met.extend(patch.map(|patch| Met { key, patch, skin }));
            };
            match &obstacle.geometry {
                Geometry::HalfSpace { normal, offset } => {
                    add(key(0), narrow::half_space(*normal, *offset, hull, reach));
                }
                Geometry::Shape { shape, pose, .. } => {
                    for (part, of_obstacle) in shape.hulls().iter().enumerate() {
                        let placed = Placed {
                            hull: of_obstacle,
                            pose: *pose,
                            size: shape.radius(),
                        };
                        let key = key(part as u32);
                        let before = self.impulses.normal(key);
                        add(key, narrow::hulls(placed, hull, reach, before));
                    }
                }
                Geometry::Mesh(mesh) => {
                    let mut near: Vec<u32> = mesh.tree.intersect_aabb(around).collect();
                    near.sort_unstable();
                    for index in near {
                        let triangle = &mesh.triangles[index as usize];
                        add(key(index), narrow::triangle(triangle, hull, reach));
                    }
                }
            }
        }
    }
}

/// The box around a body.
pub(super) fn bounds(member: &Member) -> Aabb {
    let pose = placed(&member.state);
    let points = member
        .kind
        .shape()
        .hulls()
        .iter()
        .flat_map(|hull| &hull.points);
    Aabb::from_points(points.map(|p| pose * *p))
}

/// The hulls of a body, numbered.
fn parts(member: &Member) -> impl Iterator<Item = (u32, Placed<'_>)> {
    let (pose, size) = (placed(&member.state), member.kind.shape().radius());
    let hulls = member.kind.shape().hulls().iter().enumerate();
    hulls.map(move |(part, hull)| (part as u32, Placed { hull, pose, size }))
}
