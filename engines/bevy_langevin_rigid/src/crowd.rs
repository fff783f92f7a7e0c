//! Many bodies step at once: those that move alike in lanes, all of them on any number of threads.

use std::sync::Arc;

use bevy_ecs::entity::Entity;
use langevin_rigid::linalg::vector::add;
use langevin_rigid::{Batch, Flow, Input, NoiseStream, Precision, State, Stepper, Wrench};

use crate::ambient::ImmersionSettings;
use crate::components::{AngularVelocity, ExternalWrench, LinearVelocity};
use crate::drawn::Drawn;
use crate::faults::Faults;
use crate::medium::Medium;
use crate::pace::Pace;
use crate::regions::Surroundings;
use crate::stepped::{Mover, Stepped};

/// Bodies that are gathered before they step: many of a kind fill the lanes, few stay in the cache.
const GATHERED: usize = 192;

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
}

/// A fixed step.
pub(crate) struct FixedStep<'a> {
    /// Its start and its length (s).
    pub(crate) start: f64,
    pub(crate) dt: f64,
    pub(crate) settings: &'a ImmersionSettings,
    pub(crate) around: &'a Surroundings,
    pub(crate) faults: &'a Faults,
}

/// The bodies that a task has gathered; those that are left step when it is dropped.
pub(crate) struct Crowd<'a, 'w> {
    fixed: &'a FixedStep<'a>,
    bodies: Vec<Due<'w>>,
}

/// What the step of a body takes beside it.
struct Around {
    input: Input,
    medium: Medium,
}

/// Bodies that move alike. These may go in lanes together, to the same bits as alone.
#[derive(Clone, PartialEq, Eq)]
enum Kind {
    /// One by one.
    Alone,
    /// In the fluid around all.
    Together {
        /// Address of what moves them.
        mobility: usize,
        span: u32,
        /// Whether anything acts on them, and whether the fluid turns or strains.
        acts: bool,
        turns: bool,
    },
}

impl<'a, 'w> Crowd<'a, 'w> {
    pub(crate) fn new(fixed: &'a FixedStep<'a>) -> Self {
        Self {
            fixed,
            bodies: Vec::with_capacity(GATHERED),
        }
    }

    /// Gathers a body, and steps all of them if they are enough.
    pub(crate) fn add(&mut self, body: Due<'w>) {
        self.bodies.push(body);
        if self.bodies.len() == GATHERED {
            self.step();
        }
    }

    fn step(&mut self) {
        self.fixed.step(&mut self.bodies);
        self.bodies.clear();
    }
}

impl Drop for Crowd<'_, '_> {
    fn drop(&mut self) {
        self.step();
    }
}

impl Due<'_> {
    fn take_step(&mut self, next: State, medium: Medium) {
        let (before, after) = self.stepped.take_step(next, medium);
        self.drawn.between(before, after);
        *self.pace = Pace::of(self.span);
        (*self.velocity, *self.angular_velocity) = self.stepped.velocities();
    }
}

impl FixedStep<'_> {
    fn step(&self, bodies: &mut [Due]) {
        let mut around: Vec<Around> = bodies.iter().map(|body| self.around(body)).collect();
        for (kind, alike) in kinds(bodies, &around) {
            let mover = alike
                .first()
                .map(|&first| bodies[first].stepped.mover.clone());
            match (kind, mover) {
                (Kind::Together { span: 1, acts, .. }, Some(Mover::Immersed(mobility))) => {
                    let many = Many {
                        fixed: self,
                        alike: &alike,
                        acts,
                    };
                    many.step::<f64>(bodies, &mut around, &mobility.open, 1);
                }
                (Kind::Together { span, acts, .. }, Some(Mover::Immersed(mobility))) => {
                    let many = Many {
                        fixed: self,
                        alike: &alike,
                        acts,
                    };
                    many.step::<f32>(bodies, &mut around, mobility.coarse(), span);
                }
                _ => {
                    for place in alike {
                        self.step_alone(&mut bodies[place], &mut around[place]);
                    }
                }
            }
        }
    }

    fn around(&self, body: &Due) -> Around {
        let state = body.stepped.state();
        let input = Input {
            flow: self.flow(state.position),
            wrench: Wrench {
                force: body.wrench.force.as_dvec3().to_array(),
                torque: body.wrench.torque.as_dvec3().to_array(),
            },
            noise: NoiseStream {
                seed: self.settings.seed,
                body: body.number,
            },
        };
        let medium = match &body.stepped.mover {
            Mover::Plain => Medium::Open,
            Mover::Immersed(mobility) => {
                let gravity = self.settings.motion.gravity;
                Medium::around(
                    state,
                    mobility,
                    self.length(body.span),
                    gravity,
                    self.around,
                )
            }
        };
        Around { input, medium }
    }

    /// The wind at a place.
    fn flow(&self, position: [f64; 3]) -> Flow {
        if self.around.wind.is_empty() {
            return Flow::default();
        }
        let stream = self.settings.fluid.velocity;
        self.around.wind.flow(position, self.start, stream)
    }

    /// Of so many fixed steps (s).
    fn length(&self, span: u32) -> f64 {
        f64::from(span) * self.dt
    }

    fn step_alone(&self, body: &mut Due, around: &mut Around) {
        let gravity = self.settings.motion.gravity;
        let medium = std::mem::take(&mut around.medium);
        let length = self.length(body.span);
        match body.stepped.next(length, &around.input, gravity, &medium) {
            Ok(next) => body.take_step(next, medium),
            Err(fault) => self.faults.tell(body.entity, fault),
        }
    }
}

/// The places of bodies that move alike, by kind.
fn kinds(bodies: &[Due], around: &[Around]) -> Vec<(Kind, Vec<usize>)> {
    let mut kinds: Vec<(Kind, Vec<usize>)> = Vec::new();
    for (place, (body, around)) in bodies.iter().zip(around).enumerate() {
        let kind = Kind::of(body, around);
        match kinds.iter_mut().rev().find(|(other, _)| *other == kind) {
            Some((_, alike)) => alike.push(place),
            None => kinds.push((kind, vec![place])),
        }
    }
    kinds
}

impl Kind {
    fn of(body: &Due, around: &Around) -> Self {
        let Around { input, medium } = around;
        match (&body.stepped.mover, medium) {
            (Mover::Immersed(mobility), Medium::Open) => Self::Together {
                mobility: Arc::as_ptr(mobility) as usize,
                span: body.span,
                acts: input.flow != Flow::default() || input.wrench != Wrench::default(),
                turns: input.flow.gradient != [[0.0; 3]; 3],
            },
            _ => Self::Alone,
        }
    }
}

/// Bodies of a kind, which step in lanes.
struct Many<'a> {
    fixed: &'a FixedStep<'a>,
    /// Their places.
    alike: &'a [usize],
    acts: bool,
}

impl Many<'_> {
    fn step<P: Precision>(
        &self,
        bodies: &mut [Due],
        around: &mut [Around],
        stepper: &Stepper,
        span: u32,
    ) {
        let fixed = self.fixed;
        let mut batch = Batch::<P>::new(fixed.settings.seed);
        let far = span > 1;
        for &place in self.alike {
            let mut state = *bodies[place].stepped.state();
            // Single precision tells where a body goes, not where it is.
            if far {
                state.position = [0.0; 3];
            }
            batch.push_numbered(bodies[place].number, &state);
        }
        let length = fixed.length(span);
        let stopped = if self.acts {
            let mut places = self.alike.iter();
            let next = |_, _: &State| {
                let place = places.next();
                place.map_or_else(Input::default, |&place| around[place].input)
            };
            stepper.step_batch_with(&mut batch, length, next).is_err()
        } else {
            stepper.step_batch(&mut batch, length).is_err()
        };
        for (lane, &place) in self.alike.iter().enumerate() {
            let body = &mut bodies[place];
            let before = *body.stepped.state();
            match batch.state(lane) {
                Some(mut after) if !stopped || after.step != before.step => {
                    if far {
                        after.position = add(before.position, after.position);
                    }
                    body.take_step(after, Medium::Open);
                }
                // Those that could not take it stay as they were; alone they say why not.
                _ => fixed.step_alone(body, &mut around[place]),
            }
        }
    }
}
