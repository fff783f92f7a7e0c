//! Which bodies fall asleep, and what wakes them.

use langevin_rigid::State;
use parry3d_f64::math::Vector;

use super::impulses::{Held, Key};
use super::near::Met;
use super::solve::Solved;
use super::{World, placed};
use crate::contact::Point;
use crate::sleep::{self, Bed};

/// Steps between two looks at whether the wind moves a sleeping body.
const LOOKS: u64 = 16;

impl World {
    /// Wakes what sleeps and is hit; whether there was any.
    pub(super) fn wake_the_hit(&mut self, met: &[Met], dt: f64) -> bool {
        let mut hit = Vec::new();
        for met in met.iter().filter(|met| met.key.obstacle.is_none()) {
            let (a, b) = (met.key.a as usize, met.key.b as usize);
            let sleeper = match (self.is_asleep(a), self.is_asleep(b)) {
                (true, false) => a,
                (false, true) => b,
                _ => continue,
            };
            let kind = &self.members[sleeper].kind;
            let disturbing = sleep::disturbing(kind.shape().radius(), self.gravity);
            let pressed = self.members[sleeper].rest.pressed();
            let fast = |point: &Point| {
                let velocity = |body: usize, at: Vector| velocity_at(&self.members[body].state, at);
                let approach = velocity(a, point.on_a) - velocity(b, point.on_b);
                let push = self.impulse_at(met.key, point);
                // Hit, or pressed upon by more than it carried and its own weight.
                (point.gap <= met.skin && approach.dot(met.patch.normal) > disturbing)
                    || push > pressed + self.gravity * dt / kind.lightness()
            };
            if met.patch.points.iter().any(fast) {
                hit.push(sleeper);
            }
        }
        for &body in &hit {
            self.wake(body);
        }
        !hit.is_empty()
    }

    /// Wakes what sleeps in wind that may move it. Looks at each body now and then.
    pub(super) fn wake_the_blown(&mut self) {
        if self.wind.is_empty() && self.stream == [0.0; 3] {
            return;
        }
        let (wind, stream) = (&self.wind, self.stream);
        for (body, member) in self.members.iter_mut().enumerate() {
            let due = (member.state.step + body as u64).is_multiple_of(LOOKS);
            if due && member.rest.is_asleep() {
                let flow = wind.flow(member.state.position, member.state.time, stream);
                if member.kind.is_blown(&member.state, flow) {
                    member.rest.wake();
                }
            }
        }
    }

    /// The impulse of the last step at a point (N s), without its direction.
    fn impulse_at(&self, key: Key, point: &Point) -> f64 {
        let member = &self.members[key.b as usize];
        let at = placed(&member.state).inverse_transform_point(point.on_b);
        self.impulses
            .near(key, at, member.kind.shape().radius())
            .length()
    }

    /// Takes over what was solved; puts to sleep what has come to rest, and wakes what is stirred.
    pub(super) fn settle(&mut self, solved: Solved, dt: f64) {
        let mut stirred = vec![false; self.members.len()];
        for (body, (member, state)) in self.members.iter_mut().zip(solved.states).enumerate() {
            member.state = state;
            if !member.rest.is_asleep() {
                stirred[body] = member.rest.stirs(&state, member.kind.shape().radius(), dt);
            }
        }
        self.impulses = solved.impulses;
        let mut touching = vec![None; self.members.len()];
        for Held { key, impulse, .. } in self.impulses.iter() {
            let mut touch = |body: u32, other: Option<u32>| {
                let bed: &mut Bed = touching[body as usize].get_or_insert_default();
                bed.against.extend(other);
                bed.pressed += impulse.length();
            };
            touch(key.b, key.obstacle.is_none().then_some(key.a));
            if key.obstacle.is_none() {
                touch(key.a, Some(key.b));
            }
        }
        for (member, touching) in self.members.iter_mut().zip(touching) {
            if member.rest.is_asleep() {
                if member.rest.is_stirred_by(&stirred) {
                    member.rest.wake();
                }
            } else if let Some(touching) = touching.filter(|_| member.rest.is_drowsy()) {
                member.rest.sleep(touching);
                (member.state.velocity, member.state.angular_velocity) = ([0.0; 3], [0.0; 3]);
            }
        }
    }
}

/// Velocity of a point of a body, both in the world frame.
fn velocity_at(state: &State, at: Vector) -> Vector {
    let arm = at - Vector::from(state.position);
    Vector::from(state.world_velocity()) + Vector::from(state.world_angular_velocity()).cross(arm)
}
