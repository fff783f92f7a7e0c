//! Many falls of one scene at once, in lanes.

use langevin_rigid::{Batch, Input, State};

use crate::advance::{advance, blown, is_carried};
use crate::ensemble::FallEnding;
use crate::prepared::{Prepared, Release};
use crate::scene::{MAX_STEPS, Steering};

/// Steps of a batch between two looks at whether to go on.
const PATIENCE: u32 = 16;

/// What is learnt of a fall on its way.
pub(crate) trait Watch {
    /// A step of it.
    fn see(&mut self, before: &State, after: &State);
}

/// A fall to be made.
pub(crate) struct Task<W> {
    /// Where it begins, and its noise.
    pub(crate) release: Release,
    /// The force that steers it, beside the scene's own.
    pub(crate) steering: Option<Steering>,
    /// What watches it.
    pub(crate) watch: W,
}

/// A fall that ended.
pub(crate) struct Dropped<W> {
    /// Which of the tasks it was.
    pub(crate) place: usize,
    /// Where it began, and its noise.
    pub(crate) release: Release,
    /// What watched it.
    pub(crate) watch: W,
    /// Its last state.
    pub(crate) last: State,
    /// Why it ended.
    pub(crate) ending: FallEnding,
}

/// A fall under way.
struct Falling<W> {
    place: usize,
    task: Task<W>,
}

/// What becomes of a fall while it is carried.
enum Start<W> {
    /// It is let go in this state.
    Free(Falling<W>, State),
    /// It ended before.
    Over(Dropped<W>),
}

/// What falls in lanes share.
pub(crate) struct Lanes<'a> {
    /// The scene.
    pub(crate) prepared: &'a Prepared,
    /// Time between the falls of two streams of noise in the wind (s).
    pub(crate) apart: f64,
}

impl Lanes<'_> {
    /// The falls of some tasks, in their order; without those that were under way when it was cancelled. `done` hears of
    /// each that ended.
    pub(crate) fn falls<W: Watch>(
        &self,
        tasks: impl IntoIterator<Item = Task<W>>,
        cancelled: &dyn Fn() -> bool,
        done: &dyn Fn(),
    ) -> Vec<Dropped<W>> {
        let mut ended = Vec::new();
        let mut end = |fall: Dropped<W>| {
            ended.push(fall);
            done();
        };
        let mut batch = Batch::<f64>::new(self.prepared.scene().seed);
        let mut falling = Vec::new();
        for (place, task) in tasks.into_iter().enumerate() {
            match self.let_go(Falling { place, task }) {
                Start::Free(fall, state) => {
                    batch.push_numbered(fall.task.release.noise.body, &state);
                    falling.push(fall);
                }
                Start::Over(fall) => end(fall),
            }
        }
        let mut before = Vec::with_capacity(falling.len());
        let mut steps = 0u32;
        while !falling.is_empty() {
            if steps.is_multiple_of(PATIENCE) && cancelled() {
                break;
            }
            steps = steps.wrapping_add(1);
            before.clear();
            before.extend((0..falling.len()).filter_map(|place| batch.state(place)));
            self.step(&mut batch, &before, &mut falling, &mut end);
        }
        ended.sort_by_key(|fall| fall.place);
        ended
    }

    /// One step of all that fall from the states `before`, and the end of those whose last it is.
    fn step<W: Watch>(
        &self,
        batch: &mut Batch,
        before: &[State],
        falling: &mut Vec<Falling<W>>,
        end: &mut impl FnMut(Dropped<W>),
    ) {
        let (scene, stepper) = (self.prepared.scene(), self.prepared.stepper());
        let steered = scene.steering.is_some() || falling.iter().any(|f| f.task.steering.is_some());
        let stopped = if steered {
            // Inputs are asked for in the order of places.
            let mut next = falling.iter();
            stepper.step_batch_with(batch, scene.time_step, |_, state| {
                next.next()
                    .map_or_else(Input::default, |fall| self.input(&fall.task, state))
            })
        } else {
            let wind = self.prepared.wind();
            stepper.step_batch_in(batch, scene.time_step, wind, self.apart)
        };
        let stopped = stopped.err().map_or_else(Vec::new, |error| error.bodies);
        // Backwards, as the last takes the place of one that leaves.
        for place in (0..falling.len()).rev() {
            let Some(mut state) = batch.state(place) else {
                continue;
            };
            let fall = &mut falling[place];
            let mut ending = None;
            // Two falls may have one stream: only what stopped is where it was.
            let stands = state.step == before[place].step;
            if stands && stopped.contains(&fall.task.release.noise.body) {
                let mut again = state;
                let input = self.input(&fall.task, &state);
                let error = stepper.step(&mut again, scene.time_step, &input).err();
                let words = error.map_or_else(String::new, |error| error.to_string());
                ending = Some(FallEnding::Diverged(words));
            } else {
                if let Some(tank) = &scene.tank {
                    tank.hold(fall.task.release.state.position, &mut state);
                    batch.set(place, &state);
                }
                fall.task.watch.see(&before[place], &state);
            }
            if let Some(ending) = ending.or_else(|| self.ending(&state)) {
                batch.swap_remove(place);
                end(falling.swap_remove(place).ended(&state, ending));
            }
        }
    }

    /// What a body meets.
    fn input<W>(&self, task: &Task<W>, state: &State) -> Input {
        let later = self.apart * f64::from(task.release.noise.body);
        let mut input = blown(self.prepared, &task.release, state, later);
        if let Some(steering) = &task.steering {
            steering.push(state.time, &mut input.wrench);
        }
        input
    }

    /// A fall until it is let go: while it is carried it is in no batch.
    fn let_go<W: Watch>(&self, mut fall: Falling<W>) -> Start<W> {
        let release = fall.task.release;
        let mut state = release.state;
        loop {
            if let Some(ending) = self.ending(&state) {
                return Start::Over(fall.ended(&state, ending));
            }
            if !is_carried(self.prepared.scene(), &state) {
                return Start::Free(fall, state);
            }
            let before = state;
            if let Err(error) = advance(self.prepared, &release, &mut state) {
                let ending = FallEnding::Diverged(error.to_string());
                return Start::Over(fall.ended(&state, ending));
            }
            fall.task.watch.see(&before, &state);
        }
    }

    fn ending(&self, state: &State) -> Option<FallEnding> {
        let scene = self.prepared.scene();
        let stop = &scene.stop;
        // Half a step of slack: times are sums of steps.
        let late = |end| state.time > end - 0.5 * scene.time_step;
        let hull = self.prepared.hull();
        if stop.ground.is_some_and(|y| hull.touches(state, y)) {
            Some(FallEnding::Ground)
        } else if stop.time.is_some_and(late) || state.step >= MAX_STEPS {
            Some(FallEnding::Time)
        } else {
            None
        }
    }
}

impl<W> Falling<W> {
    fn ended(self, state: &State, ending: FallEnding) -> Dropped<W> {
        Dropped {
            place: self.place,
            release: self.task.release,
            watch: self.task.watch,
            last: *state,
            ending,
        }
    }
}
