//! Bodies, obstacles and wind, and the steps of all of them.

use std::sync::Arc;

use langevin_rigid::linalg::vector::norm;
use langevin_rigid::linalg::{Vec3, quat_from_rotation_vector};
use langevin_rigid::wind::Wind;
use langevin_rigid::{Input, NoiseStream, State, StepError, Stepper};
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::{Pose, Rotation, Vector};
use rayon::prelude::*;

use crate::broad;
use crate::contact::island::Islands;
use crate::contact::narrow::{self, Placed};
use crate::contact::solver::{self, Contact, InverseMass, Mover, Rules, Twist};
use crate::contact::{Patch, Point};
use crate::material::{Material, MaterialError};
use crate::obstacle::{Geometry, Obstacle, pose};
use crate::shape::Shape;
use crate::sleep::{self, Rest};

/// What bodies of one kind share: how they move in the fluid, what touches, how it rubs.
#[derive(Debug, Clone)]
pub struct Kind {
    stepper: Stepper,
    shape: Shape,
    material: Material,
}

impl Kind {
    /// A kind of body.
    ///
    /// # Errors
    /// [`MaterialError`].
    pub fn new(stepper: Stepper, shape: Shape, material: Material) -> Result<Self, MaterialError> {
        Ok(Self {
            stepper,
            shape,
            material: material.checked()?,
        })
    }

    /// How it moves.
    pub fn stepper(&self) -> &Stepper {
        &self.stepper
    }

    /// What touches.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }
}

/// Bodies in a fluid that meet obstacles and each other.
///
/// A step moves every body by its own [`Stepper`], under the wind, and then gives impulses where bodies would enter
/// others: against the full 6x6 mass of body and fluid, with Coulomb's friction, Newton's restitution and no gain of
/// energy. Bodies that have come to rest sleep until they are disturbed.
///
/// The same bodies, added in the same order, have the same bits on any number of threads.
///
/// ```
/// use std::sync::Arc;
/// use langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};
/// use langevin_rigid_world::{Kind, Material, Obstacle, Shape, World};
///
/// let card = Body::plate(0.09, 0.06, 0.003, 700.0)?;
/// let stepper = Stepper::new(&card, &Fluid::AIR, None, &Settings::default())?;
/// let shape = Shape::cuboid([0.045, 0.0015, 0.03])?;
/// let kind = Arc::new(Kind::new(stepper, shape, Material::default())?);
///
/// let mut world = World::new([0.0, -9.81, 0.0]);
/// world.add_obstacle(Obstacle::half_space([0.0, 1.0, 0.0], 0.0, Material::default())?);
/// let noise = NoiseStream { seed: 1, body: 0 };
/// world.add(kind, State { position: [0.0, 0.3, 0.0], ..State::default() }, noise);
/// while !world.is_asleep(0) && world.time() < 10.0 {
///     world.step(0.002)?;
/// }
/// assert!((world.state(0).position[1] - 0.0015).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct World {
    gravity: f64,
    time: f64,
    wind: Wind,
    stream: Vec3,
    obstacles: Vec<Obstacle>,
    members: Vec<Member>,
    /// Impulses of the last step, in the order of their keys.
    held: Vec<Held>,
}

#[derive(Debug, Clone)]
struct Member {
    kind: Arc<Kind>,
    state: State,
    noise: NoiseStream,
    rest: Rest,
}

/// Why a step was not taken. No body has moved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("body {body}: {error}")]
pub struct WorldError {
    /// Number of the body.
    pub body: usize,
    /// Why it could not step.
    pub error: StepError,
}

/// Two that are inside each other.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("body {body} is {:.3} mm inside {other}; place them apart", 1e3 * .depth)]
pub struct Overlap {
    /// Number of the body.
    pub body: usize,
    /// What it is in.
    pub other: String,
    /// How deep (m).
    pub depth: f64,
}

/// Which hulls a patch is between: of an obstacle or a body, and of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    obstacle: Option<u32>,
    a: u32,
    part_a: u32,
    b: u32,
    part_b: u32,
}

/// An impulse of the step before.
#[derive(Debug, Clone, Copy)]
struct Held {
    key: Key,
    /// Where it acted, in the frame of b (m).
    at: Vector,
    /// On b, world frame (N s).
    impulse: Vector,
}

/// A patch between two parts.
struct Met {
    key: Key,
    patch: Patch,
    /// Gap that is kept (m).
    skin: f64,
}

/// Gap that is kept between two bodies, in radii of the smaller one.
const SKIN: f64 = 5e-4;

impl World {
    /// An empty world with this gravity (m/s^2), which must be that of the steppers of its bodies.
    pub fn new(gravity: Vec3) -> Self {
        Self {
            gravity: norm(gravity),
            time: 0.0,
            wind: Wind::default(),
            stream: [0.0; 3],
            obstacles: Vec::new(),
            members: Vec::new(),
            held: Vec::new(),
        }
    }

    /// Sets the wind, on top of the velocity `stream` (m/s) of the fluid that the steppers have.
    pub fn set_wind(&mut self, wind: Wind, stream: Vec3) {
        (self.wind, self.stream) = (wind, stream);
    }

    /// Adds what does not move.
    pub fn add_obstacle(&mut self, obstacle: Obstacle) {
        self.obstacles.push(obstacle);
    }

    /// Adds a body, whose number this gives: 0, 1, 2, ... Its `state.time` becomes the world's.
    pub fn add(&mut self, kind: Arc<Kind>, state: State, noise: NoiseStream) -> usize {
        self.members.push(Member {
            kind,
            state: State {
                time: self.time,
                ..state
            },
            noise,
            rest: Rest::default(),
        });
        self.members.len() - 1
    }

    /// Time since the begin (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// How many bodies there are.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// Whether there is no body.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// The state of a body.
    pub fn state(&self, body: usize) -> &State {
        &self.members[body].state
    }

    /// What a body shares with others of its kind.
    pub fn kind(&self, body: usize) -> &Arc<Kind> {
        &self.members[body].kind
    }

    /// Moves a body, and wakes it.
    pub fn set_state(&mut self, body: usize, state: &State) {
        self.wake(body);
        self.members[body].state = State {
            time: self.time,
            ..*state
        };
    }

    /// Whether a body has come to rest.
    pub fn is_asleep(&self, body: usize) -> bool {
        self.members[body].rest.is_asleep()
    }

    /// Wakes a body; those that sleep against it wake when it moves.
    pub fn wake(&mut self, body: usize) {
        self.members[body].rest.wake();
    }

    /// The deepest overlap of a body with anything, if there is one of more than a thousandth of its radius.
    pub fn overlap(&self, body: usize) -> Option<Overlap> {
        let members = &self.members;
        let others = (0..members.len()).filter(|other| *other != body);
        let pairs: Vec<(usize, usize)> = others
            .map(|other| (other.min(body), other.max(body)))
            .collect();
        let mut met: Vec<Met> = pairs
            .iter()
            .flat_map(|pair| self.bodies_met(*pair, 0.0))
            .collect();
        met.extend(self.obstacles_met(body, 0.0));
        let depth = |met: &Met| {
            -met.patch
                .points
                .iter()
                .map(|p| p.gap)
                .fold(f64::INFINITY, f64::min)
        };
        let (deepest, met) = met
            .iter()
            .map(|met| (depth(met), met))
            .max_by(|a, b| a.0.total_cmp(&b.0))?;
        (deepest > 1e-3 * members[body].kind.shape.radius()).then(|| Overlap {
            body,
            other: match met.key.obstacle {
                Some(number) => format!("obstacle {number}"),
                None if met.key.a as usize == body => format!("body {}", met.key.b),
                None => format!("body {}", met.key.a),
            },
            depth: deepest,
        })
    }

    /// Advances all bodies that are awake by `dt` (s).
    ///
    /// # Errors
    /// [`WorldError`], with all bodies as they were.
    pub fn step(&mut self, dt: f64) -> Result<(), WorldError> {
        let met = loop {
            let met = self.meet(dt);
            if !self.wake_the_hit(&met) {
                break met;
            }
        };
        let free = self.free_step(dt)?;
        let contacts = self.contacts(&met);
        let solved = self.solve(&free, contacts, dt);
        self.settle(solved, dt);
        self.time += dt;
        Ok(())
    }

    /// How far a body may go in a step (m).
    fn stride(&self, member: &Member, dt: f64) -> f64 {
        if member.rest.is_asleep() {
            return 0.0;
        }
        1.5 * sleep::fastest(&member.state, member.kind.shape.radius()) * dt
            + 2.0 * self.gravity * dt * dt
    }

    /// All that is close, in the order of its keys.
    fn meet(&self, dt: f64) -> Vec<Met> {
        let boxes: Vec<Aabb> = self
            .members
            .iter()
            .map(|member| {
                let margin = self.stride(member, dt) + SKIN * member.kind.shape.radius();
                bounds(member).loosened(margin)
            })
            .collect();
        let awake = |body: usize| !self.is_asleep(body);
        let pairs: Vec<(usize, usize)> = broad::pairs(&boxes)
            .into_iter()
            .filter(|(a, b)| awake(*a) || awake(*b))
            .collect();
        let reach = |body: usize| self.stride(&self.members[body], dt);
        let mut met: Vec<Met> = (0..self.members.len())
            .into_par_iter()
            .filter(|body| awake(*body))
            .flat_map_iter(|body| self.obstacles_met(body, reach(body)))
            .collect();
        met.par_extend(
            pairs
                .into_par_iter()
                .flat_map_iter(|pair| self.bodies_met(pair, reach(pair.0) + reach(pair.1))),
        );
        met
    }

    fn bodies_met(&self, (a, b): (usize, usize), reach: f64) -> Vec<Met> {
        let (first, second) = (&self.members[a], &self.members[b]);
        let skin = SKIN * first.kind.shape.radius().min(second.kind.shape.radius());
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
                let patch = narrow::hulls(hull_a, hull_b, reach + skin);
                met.extend(patch.map(|patch| Met { key, patch, skin }));
            }
        }
        met
    }

    fn obstacles_met(&self, body: usize, reach: f64) -> Vec<Met> {
        let member = &self.members[body];
        let skin = SKIN * member.kind.shape.radius();
        let reach = reach + skin;
        let around = bounds(member).loosened(reach);
        let mut met = Vec::new();
        for (number, obstacle) in self.obstacles.iter().enumerate() {
            if obstacle
                .bounds()
                .is_some_and(|bounds| !bounds_meet(&bounds, &around))
            {
                continue;
            }
            for (part_b, hull) in parts(member) {
                let mut add = |part_a: u32, patch: Option<Patch>| {
                    let key = Key {
                        obstacle: Some(number as u32),
                        a: 0,
                        part_a,
                        b: body as u32,
                        part_b,
                    };
                    met.extend(patch.map(|patch| Met { key, patch, skin }));
                };
                match &obstacle.geometry {
                    Geometry::HalfSpace { normal, offset } => {
                        add(0, narrow::half_space(*normal, *offset, hull, reach));
                    }
                    Geometry::Shape { shape, pose, .. } => {
                        for (part, of_obstacle) in shape.hulls().iter().enumerate() {
                            let placed = Placed {
                                hull: of_obstacle,
                                pose: *pose,
                                size: shape.radius(),
                            };
                            add(part as u32, narrow::hulls(placed, hull, reach));
                        }
                    }
                    Geometry::Mesh(mesh) => {
                        let mut near: Vec<u32> = mesh.tree.intersect_aabb(&around).collect();
                        near.sort_unstable();
                        for index in near {
                            let triangle = &mesh.triangles[index as usize];
                            add(index, narrow::triangle(triangle, hull, reach));
                        }
                    }
                }
            }
        }
        met
    }

    /// Wakes what sleeps and is hit; whether there was any.
    fn wake_the_hit(&mut self, met: &[Met]) -> bool {
        let mut hit = Vec::new();
        for met in met.iter().filter(|met| met.key.obstacle.is_none()) {
            let (a, b) = (met.key.a as usize, met.key.b as usize);
            let sleeper = match (self.is_asleep(a), self.is_asleep(b)) {
                (true, false) => a,
                (false, true) => b,
                _ => continue,
            };
            let kind = &self.members[sleeper].kind;
            let disturbing = sleep::disturbing(kind.shape.radius(), self.gravity);
            let fast = |point: &Point| {
                let velocity = |body: usize, at: Vector| velocity_at(&self.members[body].state, at);
                let approach = velocity(a, point.on_a) - velocity(b, point.on_b);
                let push = self.impulse_at(met.key, point);
                // Hit, or pressed upon by more than itself.
                (point.gap <= met.skin && approach.dot(met.patch.normal) > disturbing)
                    || push > disturbing / kind.lightness()
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

    /// The impulse of the last step at a point (N s), without its direction.
    fn impulse_at(&self, key: Key, point: &Point) -> f64 {
        let member = &self.members[key.b as usize];
        let at = placed(&member.state).inverse_transform_point(point.on_b);
        self.held_at(key, at, member.kind.shape.radius()).length()
    }

    /// The impulse of the last step near a point of b, in its frame.
    fn held_at(&self, key: Key, at: Vector, radius: f64) -> Vector {
        let from = self.held.partition_point(|held| held.key < key);
        let mut best = (0.05 * radius, Vector::ZERO);
        for held in self.held[from..].iter().take_while(|held| held.key == key) {
            let away = held.at.distance(at);
            if away < best.0 {
                best = (away, held.impulse);
            }
        }
        best.1
    }

    /// The states of all after a step without contact.
    fn free_step(&self, dt: f64) -> Result<Vec<State>, WorldError> {
        let results: Vec<Result<State, WorldError>> = self
            .members
            .par_iter()
            .enumerate()
            .with_min_len(16)
            .map(|(body, member)| {
                let mut state = member.state;
                if member.rest.is_asleep() {
                    state.time += dt;
                    state.step += 1;
                    return Ok(state);
                }
                let mut input = Input::with_noise(member.noise);
                if !self.wind.is_empty() {
                    input.flow = self.wind.flow(state.position, state.time, self.stream);
                }
                match member.kind.stepper.step(&mut state, dt, &input) {
                    Ok(()) => Ok(state),
                    Err(error) => Err(WorldError { body, error }),
                }
            })
            .collect();
        results.into_iter().collect()
    }

    /// The contacts of what is close; movers are numbered as bodies.
    fn contacts(&self, met: &[Met]) -> Vec<(Key, Vector, Contact)> {
        let mut contacts = Vec::new();
        for Met { key, patch, skin } in met {
            let b = key.b as usize;
            let second = &self.members[b];
            let moves = |body: usize| (!self.is_asleep(body)).then_some(body);
            let (a, material) = match key.obstacle {
                Some(number) => (None, self.obstacles[number as usize].material),
                None => (
                    Some(key.a as usize),
                    self.members[key.a as usize].kind.material,
                ),
            };
            let material = material.with(second.kind.material);
            let frame = placed(&second.state);
            let centre_a = a.map_or(Vector::ZERO, |a| self.members[a].state.position.into());
            let radius = second.kind.shape.radius();
            for point in &patch.points {
                let at = frame.inverse_transform_point(point.on_b);
                contacts.push((
                    *key,
                    at,
                    Contact {
                        a: a.and_then(moves),
                        b: moves(b),
                        normal: patch.normal,
                        arm_a: point.on_a - centre_a,
                        arm_b: point.on_b - frame.translation,
                        gap: point.gap - skin,
                        skin: *skin,
                        friction: material.friction,
                        restitution: material.restitution,
                        impulse: self.held_at(*key, at, radius),
                    },
                ));
            }
        }
        contacts
    }

    /// Solves island by island, on all cores.
    fn solve(&self, free: &[State], contacts: Vec<(Key, Vector, Contact)>, dt: f64) -> Solved {
        let mut islands = Islands::new(self.members.len());
        for (_, _, contact) in &contacts {
            if let (Some(a), Some(b)) = (contact.a, contact.b) {
                islands.join(a, b);
            }
        }
        let mut solved = Solved {
            states: free.to_vec(),
            island: (0..self.members.len())
                .map(|body| islands.root(body))
                .collect(),
            held: Vec::with_capacity(contacts.len()),
        };
        let mut of_island: Vec<Vec<usize>> = vec![Vec::new(); self.members.len()];
        for (number, (_, _, contact)) in contacts.iter().enumerate() {
            if let Some(mover) = contact.b.or(contact.a) {
                of_island[solved.island[mover]].push(number);
            }
        }
        of_island.retain(|numbers| !numbers.is_empty());
        let done: Vec<Vec<(usize, Mover)>>;
        let mut of_island: Vec<Vec<(Key, Vector, Contact)>> = of_island
            .into_iter()
            .map(|numbers| numbers.into_iter().map(|i| contacts[i].clone()).collect())
            .collect();
        done = of_island
            .par_iter_mut()
            .map(|contacts| self.solve_island(free, contacts, dt))
            .collect();
        for (body, mover) in done.into_iter().flatten() {
            moved(&mut solved.states[body], &self.members[body].state, &mover);
        }
        for (key, at, contact) in of_island.into_iter().flatten() {
            if contact.impulse != Vector::ZERO {
                solved.held.push(Held {
                    key,
                    at,
                    impulse: contact.impulse,
                });
            }
        }
        solved.held.sort_by(|a, b| a.key.cmp(&b.key));
        solved
    }

    fn solve_island(
        &self,
        free: &[State],
        contacts: &mut [(Key, Vector, Contact)],
        dt: f64,
    ) -> Vec<(usize, Mover)> {
        let mut bodies: Vec<usize> = contacts
            .iter()
            .flat_map(|(_, _, contact)| [contact.a, contact.b])
            .flatten()
            .collect();
        bodies.sort_unstable();
        bodies.dedup();
        let mut movers: Vec<Mover> = bodies
            .iter()
            .map(|&body| {
                let state = &free[body];
                Mover {
                    inverse_mass: InverseMass::new(
                        self.members[body].kind.stepper.inverse_total_mass(),
                        placed(state).rotation,
                    ),
                    velocity: Twist {
                        linear: state.world_velocity().into(),
                        angular: state.world_angular_velocity().into(),
                    },
                    way: None,
                }
            })
            .collect();
        let place = |body: Option<usize>| body.and_then(|body| bodies.binary_search(&body).ok());
        let mut numbered: Vec<Contact> = contacts
            .iter()
            .map(|(_, _, contact)| Contact {
                a: place(contact.a),
                b: place(contact.b),
                ..contact.clone()
            })
            .collect();
        let fall = self.gravity * dt;
        let rules = Rules {
            dt,
            tolerance: 1e-3 * fall,
            bounce: 4.0 * fall,
        };
        solver::solve(&mut movers, &mut numbered, &rules);
        for ((_, _, contact), solved) in contacts.iter_mut().zip(numbered) {
            contact.impulse = solved.impulse;
        }
        bodies.into_iter().zip(movers).collect()
    }

    /// Takes over what was solved; puts to sleep what has come to rest, and wakes what is stirred.
    fn settle(&mut self, solved: Solved, dt: f64) {
        let mut stirred = vec![false; self.members.len()];
        for (body, (member, state)) in self.members.iter_mut().zip(solved.states).enumerate() {
            member.state = state;
            if !member.rest.is_asleep() {
                stirred[body] = member.rest.stirs(&state, member.kind.shape.radius(), dt);
            }
        }
        self.held = solved.held;
        let mut touching = vec![None; self.members.len()];
        for Held { key, .. } in &self.held {
            let mut touch = |body: u32, other: Option<u32>| {
                let others: &mut Vec<u32> = touching[body as usize].get_or_insert_default();
                others.extend(other);
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

impl Kind {
    /// One over the mass of body and fluid, of its lightest direction (1/kg).
    fn lightness(&self) -> f64 {
        let inverse = self.stepper.inverse_total_mass();
        (0..3).map(|i| inverse[i][i]).fold(0.0, f64::max)
    }
}

/// What a step makes of all bodies.
struct Solved {
    states: Vec<State>,
    /// The island of each body.
    island: Vec<usize>,
    held: Vec<Held>,
}

/// What contacts make of a state after a free step from `before`. Spin and velocity turn with the body, so that where it
/// goes costs no energy.
fn moved(state: &mut State, before: &State, mover: &Mover) {
    let velocity = mover.velocity;
    state.set_world_velocities(velocity.linear.to_array(), velocity.angular.to_array());
    if let Some(way) = mover.way {
        state.position = (Vector::from(before.position) + way.linear).to_array();
        let [x, y, z, w] = quat_from_rotation_vector(way.angular.to_array());
        let turned = Rotation::from_xyzw(x, y, z, w) * placed(before).rotation;
        state.orientation = turned.normalize().to_array();
    }
}

fn placed(state: &State) -> Pose {
    pose(state.position, state.orientation)
}

fn bounds(member: &Member) -> Aabb {
    let pose = placed(&member.state);
    let points = member
        .kind
        .shape
        .hulls()
        .iter()
        .flat_map(|hull| &hull.points);
    Aabb::from_points(points.map(|p| pose * *p))
}

fn bounds_meet(a: &Aabb, b: &Aabb) -> bool {
    a.mins.cmple(b.maxs).all() && b.mins.cmple(a.maxs).all()
}

/// The hulls of a body, numbered.
fn parts(member: &Member) -> impl Iterator<Item = (u32, Placed<'_>)> {
    let (pose, size) = (placed(&member.state), member.kind.shape.radius());
    let hulls = member.kind.shape.hulls().iter().enumerate();
    hulls.map(move |(part, hull)| (part as u32, Placed { hull, pose, size }))
}

/// Velocity of a point of a body, both in the world frame.
fn velocity_at(state: &State, at: Vector) -> Vector {
    let arm = at - Vector::from(state.position);
    Vector::from(state.world_velocity()) + Vector::from(state.world_angular_velocity()).cross(arm)
}
