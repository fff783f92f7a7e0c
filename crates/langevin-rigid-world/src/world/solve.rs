//! From what is close to where bodies go.

use arrayvec::ArrayVec;
use langevin_rigid::State;
use langevin_rigid::linalg::quat_from_rotation_vector;
use parry3d_f64::math::{Rotation, Vector};
use rayon::prelude::*;

use super::impulses::{Held, Impulses, Key};
use super::near::Met;
use super::{Member, World, placed};
use crate::contact::island::Islands;
use crate::contact::solver::{self, Contact, InverseMass, Mover, Rules, Twist};
use crate::contact::{MOST_POINTS, Point};

/// Two that overlap by more than this do not fall asleep at once, in gaps that are kept between them.
const DEEP: f64 = 4.0;

/// What a step makes of all bodies.
pub(super) struct Solved {
    pub(super) states: Vec<State>,
    pub(super) impulses: Impulses,
}

/// A contact, whose movers are numbered as bodies, and where its impulse is kept.
struct Touch {
    key: Key,
    /// In the frame of b (m).
    at: Vector,
    contact: Contact,
}

impl World {
    /// Gives impulses where bodies would enter others, island by island, on all cores; `free` are the states without them.
    pub(super) fn solve(&self, free: Vec<State>, met: &[Met], dt: f64) -> Solved {
        let mut islands = self.islands(met);
        let done: Vec<Vec<(usize, Mover)>> = islands
            .par_iter_mut()
            .map(|touches| self.solve_island(&free, touches, dt))
            .collect();
        let mut states = free;
        for (body, mover) in done.into_iter().flatten() {
            self.move_on(body, &mut states[body], &mover);
        }
        let held = islands.iter().flatten().filter_map(Touch::held);
        Solved {
            states,
            impulses: Impulses::new(held.collect()),
        }
    }

    /// The contacts of bodies that push each other, together.
    fn islands(&self, met: &[Met]) -> Vec<Vec<Touch>> {
        let mut sets = Islands::new(self.members.len());
        for Met { key, .. } in met.iter().filter(|met| met.key.obstacle.is_none()) {
            let (a, b) = (key.a as usize, key.b as usize);
            if !self.is_asleep(a) && !self.is_asleep(b) {
                sets.join(a, b);
            }
        }
        let mut islands: Vec<Vec<Touch>> = Vec::new();
        let mut number = vec![None; self.members.len()];
        for met in met {
            let (a, b) = (met.key.a as usize, met.key.b as usize);
            let mover = if self.is_asleep(b) { a } else { b };
            let island = *number[sets.root(mover)].get_or_insert_with(|| {
                islands.push(Vec::new());
                islands.len() - 1
            });
            islands[island].extend(self.touches(met));
        }
        islands
    }

    /// The contacts of a patch. Each impulse of the last step goes to the point that is nearest to where it was, so that
    /// none is lost when the points of a patch change.
    fn touches(&self, met: &Met) -> ArrayVec<Touch, MOST_POINTS> {
        let points = met.patch.points.iter();
        let mut touches: ArrayVec<Touch, MOST_POINTS> =
            points.map(|point| self.touch(met, point)).collect();
        for held in self.impulses.of(met.key) {
            let away = |touch: &Touch| touch.at.distance_squared(held.at);
            let nearest = touches
                .iter_mut()
                .min_by(|a, b| away(a).total_cmp(&away(b)));
            if let Some(nearest) = nearest {
                nearest.contact.impulse += held.impulse;
            }
        }
        touches
    }

    fn touch(&self, met: &Met, point: &Point) -> Touch {
        let (key, b) = (met.key, met.key.b as usize);
        let second = &self.members[b];
        let moves = |body: usize| (!self.is_asleep(body)).then_some(body);
        let (a, material) = match key.obstacle {
            Some(number) => (None, self.obstacles[number as usize].material),
            None => (
                Some(key.a as usize),
                self.members[key.a as usize].kind.material(),
            ),
        };
        let material = material.with(second.kind.material());
        let frame = placed(&second.state);
        let centre_a = a.map_or(Vector::ZERO, |a| self.members[a].state.position.into());
        let at = frame.inverse_transform_point(point.on_b);
        Touch {
            key,
            at,
            contact: Contact {
                a: a.and_then(moves),
                b: moves(b),
                normal: met.patch.normal,
                arm_a: point.on_a - centre_a,
                arm_b: point.on_b - frame.translation,
                gap: point.gap - met.skin,
                skin: met.skin,
                friction: material.friction,
                restitution: material.restitution,
                impulse: Vector::ZERO,
            },
        }
    }

    fn solve_island(&self, free: &[State], touches: &mut [Touch], dt: f64) -> Vec<(usize, Mover)> {
        let ends = touches
            .iter()
            .flat_map(|touch| [touch.contact.a, touch.contact.b]);
        let mut bodies: Vec<usize> = ends.flatten().collect();
        bodies.sort_unstable();
        bodies.dedup();
        let mut movers: Vec<Mover> = bodies
            .iter()
            .map(|&body| self.mover(&free[body], &self.members[body]))
            .collect();
        let place = |body: Option<usize>| body.and_then(|body| bodies.binary_search(&body).ok());
        let mut contacts: Vec<Contact> = touches
            .iter()
            .map(|Touch { contact, .. }| Contact {
                a: place(contact.a),
                b: place(contact.b),
                ..contact.clone()
            })
            .collect();
        let fall = self.gravity * dt;
        let rules = Rules {
            dt,
            tolerance: 0.001 * fall,
            bounce: 4.0 * fall,
        };
        solver::solve(&mut movers, &mut contacts, &rules);
        for (touch, solved) in touches.iter_mut().zip(contacts) {
            touch.contact.impulse = solved.impulse;
        }
        bodies.into_iter().zip(movers).collect()
    }

    fn mover(&self, free: &State, member: &Member) -> Mover {
        let inverse_mass = member.kind.inverse_mass(free, self.water.as_ref());
        Mover {
            inverse_mass: InverseMass::new(&inverse_mass, placed(free).rotation),
            velocity: Twist {
                linear: free.world_velocity().into(),
                angular: free.world_angular_velocity().into(),
            },
            way: None,
        }
    }

    /// What contacts make of the state of a body after a free step.
    fn move_on(&self, body: usize, state: &mut State, mover: &Mover) {
        let Member {
            state: before,
            kind,
            ..
        } = &self.members[body];
        let velocity = mover.velocity;
        state.set_world_velocities(velocity.linear.to_array(), velocity.angular.to_array());
        let Some(way) = mover.way else { return };
        let free = *state;
        state.position = (Vector::from(before.position) + way.linear).to_array();
        let [x, y, z, w] = quat_from_rotation_vector(way.angular.to_array());
        let turned = Rotation::from_xyzw(x, y, z, w) * placed(before).rotation;
        state.orientation = turned.normalize().to_array();
        kind.keep_momentum(&free, state);
    }
}

impl Touch {
    fn held(&self) -> Option<Held> {
        let Contact {
            impulse,
            normal,
            gap,
            skin,
            ..
        } = self.contact;
        (impulse != Vector::ZERO).then_some(Held {
            key: self.key,
            at: self.at,
            impulse,
            normal,
            is_deep: gap < -DEEP * skin,
        })
    }
}
