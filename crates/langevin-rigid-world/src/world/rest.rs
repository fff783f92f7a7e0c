//! Which bodies fall asleep, and what wakes them.

use langevin_rigid::State;
use parry3d_f64::math::Vector;

use super::impulses::Key;
use super::near::Met;
use super::solve::Solved;
use super::{Member, World};
use crate::contact::Point;
use crate::sleep::{self, Bed};

/// Steps between two looks at whether the wind moves a sleeping body.
const LOOKS: u64 = 16;

impl World {
    /// Wakes what sleeps and is hit; whether there was any.
    pub(super) fn wake_the_hit(&mut self, met: &[Met], dt: f64) -> bool {
        let hit: Vec<usize> = met.iter().filter_map(|met| self.hit_by(met, dt)).collect();
        for &body in &hit {
            self.wake(body);
        }
        !hit.is_empty()
    }

    /// The sleeper of two that have met, if it is hit, or pressed upon by more than it carried and its own weight.
    fn hit_by(&self, met: &Met, dt: f64) -> Option<usize> {
        let (a, b) = (met.key.a as usize, met.key.b as usize);
        let sleeper = match (met.key.obstacle, self.is_asleep(a), self.is_asleep(b)) {
            (None, true, false) => a,
            (None, false, true) => b,
            _ => return None,
        };
        let Member { kind, rest, .. } = &self.members[sleeper];
        let disturbing = sleep::disturbing(kind.shape().radius(), self.gravity);
        let fall = self.gravity * dt;
        let carried = rest.pressed() + fall / kind.lightness();
        let pressing: f64 = self
            .impulses
            .of(met.key)
            .map(|held| held.impulse.length())
            .sum();
        let is_hit = |point: &Point| {
            let velocity = |body: usize, at: Vector| velocity_at(&self.members[body].state, at);
            let apart = velocity(b, point.on_b) - velocity(a, point.on_a);
            let approach = -apart.dot(met.patch.normal);
            // Before the step that they meet in, or the sleeper would be as a wall to what hits it.
            let meet = point.gap - met.skin <= (1.5 * approach + fall) * dt;
            meet && approach > disturbing
        };
        (pressing > carried || met.patch.points.iter().any(is_hit)).then_some(sleeper)
    }

    /// Wakes what sleeps in wind that may move it. Looks at each body now and then.
    pub(super) fn wake_the_blown(&mut self) {
        let (of_all, stream) = (&self.wind, self.stream);
        for (body, member) in self.members.iter_mut().enumerate() {
            let due = (member.state.step + body as u64).is_multiple_of(LOOKS);
            let wind = member.kind.wind().unwrap_or(of_all);
            let blows = !wind.is_empty() || stream != [0.0; 3];
            if due && blows && member.rest.is_asleep() {
                let flow = wind.flow(member.state.position, member.state.time, stream);
                if member.kind.is_blown(&member.state, flow) {
                    member.rest.wake();
                }
            }
        }
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
        let beds = self.beds();
        for (member, bed) in self.members.iter_mut().zip(beds) {
            if member.rest.is_asleep() {
                if member.rest.is_stirred_by(&stirred) {
                    member.rest.wake();
                }
            } else if let Some(bed) = bed.filter(|bed| member.rest.is_drowsy(bed)) {
                member.rest.sleep(bed);
                (member.state.velocity, member.state.angular_velocity) = ([0.0; 3], [0.0; 3]);
            }
        }
    }

    /// What each body touches.
    fn beds(&self) -> Vec<Option<Bed>> {
        let mut beds = vec![None; self.members.len()];
        for held in self.impulses.iter() {
            let mut touch = |body: u32, other: Option<u32>| {
                let bed: &mut Bed = beds[body as usize].get_or_insert_default();
                bed.against.extend(other);
                bed.pressed += held.impulse.length();
                bed.is_deep |= held.is_deep;
            };
            let Key { obstacle, a, b, .. } = held.key;
            touch(b, obstacle.is_none().then_some(a));
            if obstacle.is_none() {
                touch(a, Some(b));
            }
        }
        beds
    }
}

/// Velocity of a point of a body, both in the world frame.
fn velocity_at(state: &State, at: Vector) -> Vector {
    let arm = at - Vector::from(state.position);
    Vector::from(state.world_velocity()) + Vector::from(state.world_angular_velocity()).cross(arm)
}
