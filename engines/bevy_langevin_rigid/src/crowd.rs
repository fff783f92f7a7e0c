//! Many bodies step at once: those that move alike in lanes, all of them on any number of threads.

use std::sync::Arc;

use bevy_ecs::change_detection::Mut;
use bevy_tasks::{ComputeTaskPool, TaskPool};
use langevin_rigid::linalg::vector::add;
use langevin_rigid::{Batch, Flow, Input, NoiseStream, Precision, State, Wrench};

use crate::ambient::ImmersionSettings;
use crate::components::ExternalWrench;
use crate::medium::Medium;
use crate::regions::Surroundings;
use crate::stepped::{Mover, Stepped};
use crate::steppers::Mobility;

/// Bodies that a task takes.
const TASK: usize = 256;

/// A body that takes a step.
pub(crate) struct Due<'a> {
    pub(crate) stepped: Mut<'a, Stepped>,
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
}

/// A body with all that its step takes.
struct Ready<'a, 'w> {
    body: &'a mut Due<'w>,
    input: Input,
    medium: Medium,
    kind: Kind,
}

/// Bodies that move alike. These may go in lanes together, to the same bits as alone.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
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

/// Steps all of them.
pub(crate) fn step(mut due: Vec<Due>, fixed: &FixedStep) {
    // So that a task has many of each kind; which one has which changes no bit.
    due.sort_by_key(|body| (body.stepped.mover.address(), body.span));
    let pool = ComputeTaskPool::get_or_init(TaskPool::default);
    pool.scope(|scope| {
        for some in due.chunks_mut(TASK) {
            scope.spawn(async move { fixed.step(some) });
        }
    });
}

impl FixedStep<'_> {
    fn step(&self, bodies: &mut [Due]) {
        let mut ready: Vec<Ready> = bodies.iter_mut().map(|body| self.ready(body)).collect();
        ready.sort_by(|a, b| a.kind.cmp(&b.kind));
        for alike in ready.chunk_by_mut(|a, b| a.kind == b.kind) {
            let Some(Ready { body, kind, .. }) = alike.first() else {
                continue;
            };
            match (kind, body.stepped.mover.clone()) {
                (&Kind::Together { span: 1, .. }, Mover::Immersed(mobility)) => {
                    self.step_together::<f64>(alike, &mobility, 1);
                }
                (&Kind::Together { span, .. }, Mover::Immersed(mobility)) => {
                    self.step_together::<f32>(alike, &mobility, span);
                }
                _ => alike.iter_mut().for_each(|ready| self.step_alone(ready)),
            }
        }
    }

    fn ready<'a, 'w>(&self, body: &'a mut Due<'w>) -> Ready<'a, 'w> {
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
        let mover = &body.stepped.mover;
        let medium = match mover {
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
        let kind = match (mover, &medium) {
            (Mover::Immersed(_), Medium::Open) => Kind::Together {
                mobility: mover.address(),
                span: body.span,
                acts: input.flow != Flow::default() || input.wrench != Wrench::default(),
                turns: input.flow.gradient != [[0.0; 3]; 3],
            },
            _ => Kind::Alone,
        };
        Ready {
            body,
            input,
            medium,
            kind,
        }
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

    fn step_alone(&self, ready: &mut Ready) {
        let span = ready.body.span;
        let gravity = self.settings.motion.gravity;
        let medium = std::mem::take(&mut ready.medium);
        let stepped = &mut ready.body.stepped;
        stepped.step(self.length(span), span, &ready.input, gravity, medium);
    }

    fn step_together<P: Precision>(&self, alike: &mut [Ready], mobility: &Mobility, span: u32) {
        let mut batch = Batch::<P>::new(self.settings.seed);
        let far = span > 1;
        for Ready { body, .. } in alike.iter() {
            let mut state = *body.stepped.state();
            // Single precision tells where a body goes, not where it is.
            if far {
                state.position = [0.0; 3];
            }
            batch.push_numbered(body.number, &state);
        }
        let stepper = if far {
            mobility.coarse()
        } else {
            &mobility.open
        };
        let mut inputs = alike.iter().map(|ready| ready.input);
        let next = |_, _: &State| inputs.next().unwrap_or_default();
        // Bodies that could not take it stay as they were.
        let stopped = stepper
            .step_batch_with(&mut batch, self.length(span), next)
            .is_err();
        for (place, ready) in alike.iter_mut().enumerate() {
            let before = *ready.body.stepped.state();
            match batch.state(place) {
                Some(mut after) if !stopped || after.step != before.step => {
                    if far {
                        after.position = add(before.position, after.position);
                    }
                    ready.body.stepped.take_step(after, span, Medium::Open);
                }
                // Alone it says why not.
                _ => self.step_alone(ready),
            }
        }
    }
}

impl Mover {
    /// Where it is in memory, for bodies to be sorted by.
    fn address(&self) -> usize {
        match self {
            Self::Immersed(mobility) => Arc::as_ptr(mobility) as usize,
            Self::Plain => 0,
        }
    }
}
