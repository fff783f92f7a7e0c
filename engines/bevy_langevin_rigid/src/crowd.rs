//! Many bodies step at once: those that move alike in lanes, all of them on any number of threads.

use std::sync::Arc;

use bevy_ecs::entity::Entity;
use langevin_rigid::linalg::vector::add;
use langevin_rigid::{Batch, Flow, Input, NoiseStream, Precision, State, Stepper, Wrench};

use crate::ambient::ImmersionSettings;
use crate::components::{AngularVelocity, ExternalWrench, LinearVelocity};
use crate::detail::Spans;
use crate::drawn::Drawn;
use crate::faults::Faults;
use crate::medium::Medium;
use crate::pace::Pace;
use crate::regions::Surroundings;
use crate::stepped::{Mover, Stepped};
use crate::steppers::Mobility;

/// Bodies that are alike step when they are so many: they fill the lanes and stay in the cache.
const GATHERED: usize = 64;
/// When more are unlike than this, all step.
const MOST_KINDS: usize = 16;

/// A body that takes a step.
pub(crate) struct Due<'w> {
    pub(crate) entity: Entity,
    pub(crate) stepped: &'w mut Stepped,
    pub(crate) pace: &'w mut Pace,
    pub(crate) drawn: &'w mut Drawn,
    pub(crate) velocity: &'w mut LinearVelocity,
    pub(crate) angular_velocity: &'w mut AngularVelocity,
    pub(crate) number: u32,
    pub(crate) wrench: ExternalWrench,
    /// In fixed steps.
    pub(crate) span: u32,
    /// Whether a physics engine hosts it.
    pub(crate) hosted: bool,
}

/// A fixed step.
pub(crate) struct FixedStep<'a> {
    /// Its start and its length (s).
    pub(crate) start: f64,
    pub(crate) dt: f64,
    pub(crate) settings: &'a ImmersionSettings,
    pub(crate) around: &'a Surroundings,
    pub(crate) faults: &'a Faults,
    /// How many fixed steps bodies take as one; none where all are near.
    pub(crate) spans: Option<Spans>,
}

/// The bodies that a task has gathered; those that are left step when it is dropped.
pub(crate) struct Crowd<'a, 'w> {
    fixed: &'a FixedStep<'a>,
    kinds: Vec<Alike<'w>>,
}

/// How a body steps in the fluid around all.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Kind {
    span: u32,
    /// Whether anything acts on it, and whether the fluid turns or strains.
    acts: bool,
    turns: bool,
}

/// Bodies of one mobility and kind: they may go in lanes together, to the same bits as alone.
struct Alike<'w> {
    mobility: Arc<Mobility>,
    kind: Kind,
    bodies: Vec<Due<'w>>,
    /// What acts on them; none where nothing does.
    inputs: Vec<Input>,
}

impl<'a, 'w> Crowd<'a, 'w> {
    pub(crate) fn new(fixed: &'a FixedStep<'a>) -> Self {
        Self {
            fixed,
            kinds: Vec::new(),
        }
    }

    /// Gathers a body, and steps all that are alike if they are enough; one that is like no other steps at once.
    pub(crate) fn add(&mut self, mut body: Due<'w>) {
        let fixed = self.fixed;
        let medium = fixed.medium(&body);
        let mobility = match (&body.stepped.mover, &medium) {
            (Mover::Immersed(mobility), Medium::Open) => mobility,
            _ => return fixed.step_alone(&mut body, medium),
        };
        let input = fixed.acting(&body);
        let kind = Kind::of(body.span, input.as_ref());
        let is_its = |alike: &Alike| alike.kind == kind && Arc::ptr_eq(&alike.mobility, mobility);
        let known = self.kinds.iter().position(is_its);
        let place = known.unwrap_or_else(|| self.make_room(mobility.clone(), kind));
        self.kinds[place].add(fixed, body, input);
    }

    /// Where bodies of a mobility and kind that are new will be.
    fn make_room(&mut self, mobility: Arc<Mobility>, kind: Kind) -> usize {
        if self.kinds.len() == MOST_KINDS {
            self.step();
            self.kinds.clear();
        }
        self.kinds.push(Alike {
            mobility,
            kind,
            bodies: Vec::with_capacity(GATHERED),
            inputs: Vec::new(),
        });
        self.kinds.len() - 1
    }

    fn step(&mut self) {
        for alike in &mut self.kinds {
            alike.step(self.fixed);
        }
    }
}

impl Drop for Crowd<'_, '_> {
    fn drop(&mut self) {
        self.step();
    }
}

impl Kind {
    fn of(span: u32, acting: Option<&Input>) -> Self {
        Self {
            span,
            acts: acting.is_some(),
            turns: acting.is_some_and(|input| input.flow.gradient != [[0.0; 3]; 3]),
        }
    }
}

impl<'w> Alike<'w> {
    fn add(&mut self, fixed: &FixedStep, body: Due<'w>, input: Option<Input>) {
        self.bodies.push(body);
        self.inputs.extend(input);
        if self.bodies.len() == GATHERED {
            self.step(fixed);
        }
    }

    fn step(&mut self, fixed: &FixedStep) {
        let mobility = self.mobility.clone();
        match self.kind.span {
            1 => self.step_in_lanes::<f64>(fixed, &mobility.open),
            _ => self.step_in_lanes::<f32>(fixed, mobility.coarse()),
        }
        self.bodies.clear();
        self.inputs.clear();
    }

    fn step_in_lanes<P: Precision>(&mut self, fixed: &FixedStep, stepper: &Stepper) {
        let far = self.kind.span > 1;
        let mut batch = Batch::<P>::new(fixed.settings.seed);
        for body in &self.bodies {
            let mut state = *body.stepped.state();
            // Single precision tells where a body goes, not where it is.
            if far {
                state.position = [0.0; 3];
            }
            batch.push_numbered(body.number, &state);
        }
        let length = fixed.length(self.kind.span);
        let stopped = if self.kind.acts {
            let mut inputs = self.inputs.iter();
            let next = |_, _: &State| inputs.next().copied().unwrap_or_default();
            stepper.step_batch_with(&mut batch, length, next).is_err()
        } else {
            stepper.step_batch(&mut batch, length).is_err()
        };
        for (place, body) in self.bodies.iter_mut().enumerate() {
            let before = body.stepped.state();
            match batch.state(place) {
                Some(mut after) if !stopped || after.step != before.step => {
                    if far {
                        after.position = add(before.position, after.position);
                    }
                    body.take_step(after, Medium::Open);
                }
                // Those that could not take it stay as they were; alone they say why not.
                _ => fixed.step_alone(body, Medium::Open),
            }
        }
    }
}

impl Due<'_> {
    fn take_step(&mut self, next: State, medium: Medium) {
        let (before, after) = self.stepped.take_step(next, medium, self.hosted);
        self.drawn.between(before, after);
        *self.pace = Pace::of(self.span);
        (*self.velocity, *self.angular_velocity) = self.stepped.velocities();
    }
}

impl FixedStep<'_> {
    /// What acts on a body; none where nothing does.
    fn acting(&self, body: &Due) -> Option<Input> {
        if self.around.wind.is_empty() && body.wrench == ExternalWrench::default() {
            return None;
        }
        let input = self.input(body);
        let acts = input.flow != Flow::default() || input.wrench != Wrench::default();
        acts.then_some(input)
    }

    /// What a step of a body takes beside it.
    fn input(&self, body: &Due) -> Input {
        let position = body.stepped.state().position;
        let stream = self.settings.fluid.velocity;
        Input {
            noise: NoiseStream {
                seed: self.settings.seed,
                body: body.number,
            },
            ..self
                .around
                .input(position, self.start, stream, &body.wrench)
        }
    }

    fn medium(&self, body: &Due) -> Medium {
        let state = body.stepped.state();
        let gravity = self.settings.motion.gravity;
        match &body.stepped.mover {
            Mover::Plain => Medium::Open,
            Mover::Immersed(mobility) => {
                let length = self.length(body.span);
                Medium::around(state, mobility, length, gravity, self.around)
            }
        }
    }

    /// Of so many fixed steps (s).
    fn length(&self, span: u32) -> f64 {
        f64::from(span) * self.dt
    }

    fn step_alone(&self, body: &mut Due, medium: Medium) {
        let input = self.input(body);
        let gravity = self.settings.motion.gravity;
        let length = self.length(body.span);
        match body.stepped.next(length, &input, gravity, &medium) {
            Ok(next) => body.take_step(next, medium),
            Err(fault) => self.faults.tell(body.entity, fault),
        }
    }
}
