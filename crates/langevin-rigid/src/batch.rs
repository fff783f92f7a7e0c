//! Many bodies of one shape: a structure of arrays that steps in SIMD lanes.

mod step;

use fearless_simd::{Level, Simd, dispatch};

use crate::equations::{Equations, Noise, Stepped};
use crate::input::{Flow, Forcing, Input, Wrench};
use crate::kirchhoff::Motion;
use crate::lanes::{Doubles, Lanes, Singles};
use crate::linalg::{Vec3, each, join, split};
use crate::noise::{Counter, NoiseStream};
use crate::state::State;
use crate::stepper::{StepError, Stepper};
use crate::symmetry::{General, Symmetric, Symmetry};
use crate::wind::{Local, Wind};

/// Bodies in a [`Pack`]: a multiple of the lanes of every processor.
const PACK: usize = 16;

/// The precision of a [`Batch`]: `f64`, or `f32` for twice the bodies in the same time.
///
/// In `f32` the noise has 23 random bits a number, and a step adds 1e-8 of the speed (median; 1e-6 at
/// most seen); the body leaves its path in double precision as it would after a change of its release by
/// as much.
pub trait Precision: sealed::Sealed + Copy + Send + Sync {}

impl Precision for f64 {}
impl Precision for f32 {}

mod sealed {
    use super::{Acting, Pack, StepError, Stepper};

    /// What a precision must do.
    pub trait Sealed: Sized + 'static {
        const ZERO: Self;
        fn of(value: f64) -> Self;
        fn to_f64(self) -> f64;
        fn step(
            stepper: &Stepper,
            packs: &mut [Pack<Self>],
            dt: f64,
            acting: &mut Acting<'_>,
            stopped: &mut Vec<(u32, StepError)>,
        );
    }
}

macro_rules! precision {
    ($scalar:ident, $lanes:ident) => {
        impl sealed::Sealed for $scalar {
            const ZERO: Self = 0.0;

            fn of(value: f64) -> Self {
                value as Self
            }

            fn to_f64(self) -> f64 {
                self.into()
            }

            fn step(
                stepper: &Stepper,
                packs: &mut [Pack<Self>],
                dt: f64,
                acting: &mut Acting<'_>,
                stopped: &mut Vec<(u32, StepError)>,
            ) {
                if stepper.symmetric.is_some() {
                    dispatch!(Level::new(), simd => step_packs::<_, $lanes<_>, Symmetric>(
                        simd, stepper, packs, dt, acting, stopped));
                } else {
                    dispatch!(Level::new(), simd => step_packs::<_, $lanes<_>, General>(
                        simd, stepper, packs, dt, acting, stopped));
                }
            }
        }
    };
}

precision!(f64, Doubles);
precision!(f32, Singles);

/// Bodies of one shape and their streams of noise.
///
/// ```
/// use langevin_rigid::{Batch, State};
/// let mut batch = Batch::<f64>::new(7);
/// for _ in 0..100 {
///     batch.push(&State::default());
/// }
/// assert_eq!(batch.len(), 100);
/// assert_eq!(batch.state(99), Some(State::default()));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Batch<P = f64> {
    seed: u64,
    packs: Vec<Pack<P>>,
}

/// Some bodies of a [`Batch`], which step together.
#[derive(Debug, Clone, PartialEq)]
pub struct Pack<P = f64> {
    seed: u64,
    bodies: [u32; PACK],
    /// How many of the places are taken.
    taken: usize,
    step: [u64; PACK],
    time: [f64; PACK],
    position: [[P; PACK]; 3],
    orientation: [[P; PACK]; 4],
    velocity: [[P; PACK]; 6],
    fluctuation: [[P; PACK]; 6],
}

/// The input of a body from its number and its state.
pub(crate) type Inputs<'a> = dyn FnMut(u32, &State) -> Input + 'a;
/// What acts on bodies over a step besides what they are in always.
pub enum Acting<'a> {
    Nothing,
    Inputs(&'a mut Inputs<'a>),
    Wind(InWind<'a>),
}

/// A wind, and how much later in it each body is than the one before it (s).
#[derive(Clone, Copy)]
pub struct InWind<'a> {
    pub(crate) wind: &'a Wind,
    pub(crate) apart: f64,
}

/// What acts on the bodies of a pack over a step.
struct Forced<P> {
    /// A bit for each body for which it is finite.
    sound: u64,
    velocity: [[P; PACK]; 3],
    /// Row by row; none where no body has one.
    gradient: Option<[[[P; PACK]; 3]; 3]>,
    acceleration: [[P; PACK]; 3],
    /// Force and torque; none where no body has them.
    wrench: Option<[[[P; PACK]; 3]; 2]>,
}

impl<P: Precision> Forced<P> {
    /// What acts on one of them.
    fn input(&self, place: usize) -> Input {
        let of = |columns: &[[P; PACK]; 3]| columns.map(|column| column[place].to_f64());
        let gradient = self.gradient.as_ref();
        let [force, torque] = self
            .wrench
            .as_ref()
            .map_or_else(Default::default, |wrench| [of(&wrench[0]), of(&wrench[1])]);
        Input {
            flow: Flow {
                velocity: of(&self.velocity),
                gradient: gradient.map_or_else(Default::default, |[x, y, z]| [of(x), of(y), of(z)]),
                acceleration: of(&self.acceleration),
            },
            wrench: Wrench { force, torque },
            ..Input::default()
        }
    }
}

/// Bodies of a batch could not take a step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "{} of the bodies could not take a step, the first is body {}: {first}",
    .bodies.len(), .bodies.first().copied().unwrap_or_default()
)]
pub struct BatchError {
    /// Their numbers; each is left as it was before the step.
    pub bodies: Vec<u32>,
    /// Why the first of them could not.
    #[source]
    pub first: StepError,
}

impl<P: Precision> Batch<P> {
    /// No bodies yet; `seed` is that of the run.
    pub fn new(seed: u64) -> Self {
        Self {
            seed,
            packs: Vec::new(),
        }
    }

    /// Adds a body; its number in the batch, from zero, is also the number of its noise.
    pub fn push(&mut self, state: &State) {
        let body = self.len();
        if body.is_multiple_of(PACK) {
            self.packs.push(Pack::new(self.seed));
        }
        let pack = &mut self.packs[body / PACK];
        pack.bodies[body % PACK] = body as u32;
        pack.taken += 1;
        pack.set(body % PACK, state);
    }

    /// Adds a body with the noise of body `number` of the run. Its place is the last, and errors name its number.
    pub fn push_numbered(&mut self, number: u32, state: &State) {
        self.push(state);
        let place = (self.len() - 1) % PACK;
        if let Some(pack) = self.packs.last_mut() {
            pack.bodies[place] = number;
        }
    }

    /// Takes out the body in this place, which the last body takes, noise and all; gives its state, if there is such a body.
    pub fn swap_remove(&mut self, place: usize) -> Option<State> {
        let state = self.state(place)?;
        let last = self.len() - 1;
        let moved = self.state(last)?;
        let number = self.packs[last / PACK].bodies[last % PACK];
        self.set(place, &moved);
        self.packs[place / PACK].bodies[place % PACK] = number;
        let pack = &mut self.packs[last / PACK];
        pack.taken -= 1;
        // What is in no place rests.
        pack.set(last % PACK, &State::default());
        if pack.taken == 0 {
            self.packs.pop();
        }
        Some(state)
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        match self.packs.split_last() {
            Some((last, full)) => full.len() * PACK + last.taken,
            None => 0,
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.packs.is_empty()
    }

    /// The state of body number `body`, if there is one.
    pub fn state(&self, body: usize) -> Option<State> {
        let pack = self.packs.get(body / PACK)?;
        (body % PACK < pack.taken).then(|| pack.state(body % PACK))
    }

    /// Puts body number `body` into `state`; false if there is no such body.
    pub fn set(&mut self, body: usize, state: &State) -> bool {
        let taken = body < self.len();
        if taken {
            self.packs[body / PACK].set(body % PACK, state);
        }
        taken
    }

    /// The bodies in packs, each of which can be stepped on a thread of its own.
    pub fn packs_mut(&mut self) -> &mut [Pack<P>] {
        &mut self.packs
    }
}

impl InWind<'_> {
    /// When it is for a body (s).
    pub(crate) fn time(&self, time: f64, body: u32) -> f64 {
        time + self.apart * f64::from(body)
    }

    /// Adds what no lanes tell.
    #[inline(always)]
    fn with_tables<S: Simd>(
        &self,
        simd: S,
        lanes: &Local<Doubles<S>>,
        position: &[[f64; PACK]; 3],
        time: &[f64; PACK],
        first: usize,
    ) -> Local<Doubles<S>> {
        let count = <Doubles<S> as Lanes<S>>::COUNT;
        let mut columns = [[0.0; PACK]; 15];
        store_columns::<S, Doubles<S>, 15>(&mut columns, 0, &lanes.numbers());
        for lane in 0..count {
            let place = first + lane;
            let mut local = Local::of_numbers(columns.map(|column| column[lane]));
            let at = position.map(|column| column[place]);
            self.wind.add_tables(&mut local, at, time[place]);
            put(&mut columns, lane, &local.numbers());
        }
        Local::of_numbers(load_columns::<S, Doubles<S>, 15>(simd, &columns, 0))
    }
}

impl<P: Precision> Pack<P> {
    fn new(seed: u64) -> Self {
        let mut pack = Self {
            seed,
            bodies: [0; PACK],
            taken: 0,
            step: [0; PACK],
            time: [0.0; PACK],
            position: [[P::ZERO; PACK]; 3],
            orientation: [[P::ZERO; PACK]; 4],
            velocity: [[P::ZERO; PACK]; 6],
            fluctuation: [[P::ZERO; PACK]; 6],
        };
        // Places not taken step too: they rest.
        for place in 0..PACK {
            pack.set(place, &State::default());
        }
        pack
    }

    /// The numbers of its bodies.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = u32> {
        self.bodies.into_iter().take(self.taken)
    }

    fn state(&self, place: usize) -> State {
        let (velocity, angular_velocity) = split(&get(&self.velocity, place));
        State {
            time: self.time[place],
            step: self.step[place],
            position: get(&self.position, place),
            orientation: get(&self.orientation, place),
            velocity,
            angular_velocity,
            fluctuation: get(&self.fluctuation, place),
        }
    }

    fn set(&mut self, place: usize, state: &State) {
        self.time[place] = state.time;
        self.step[place] = state.step;
        put(&mut self.position, place, &state.position);
        put(&mut self.orientation, place, &state.orientation);
        let [v, omega] = [state.velocity, state.angular_velocity];
        let xi = join(v, omega);
        put(&mut self.velocity, place, &xi);
        put(&mut self.fluctuation, place, &state.fluctuation);
    }

    /// One body after the other, in double precision.
    pub(crate) fn step_each(
        &mut self,
        inputs: &mut Inputs<'_>,
        stopped: &mut Vec<(u32, StepError)>,
        step: impl Fn(&mut State, &Input) -> Result<(), StepError>,
    ) {
        for place in 0..self.taken {
            let mut state = self.state(place);
            let input = self.with_its_noise(place, inputs(self.bodies[place], &state));
            match step(&mut state, &input) {
                Ok(()) => self.set(place, &state),
                Err(error) => stopped.push((self.bodies[place], error)),
            }
        }
    }

    fn with_its_noise(&self, place: usize, input: Input) -> Input {
        let noise = NoiseStream {
            seed: self.seed,
            body: self.bodies[place],
        };
        Input { noise, ..input }
    }

    /// What its bodies meet, as `inputs` tells; none where nothing acts.
    fn told(&self, inputs: &mut Inputs<'_>) -> Option<Forced<P>> {
        let mut each = [Input::default(); PACK];
        for (place, input) in each.iter_mut().enumerate().take(self.taken) {
            *input = inputs(self.bodies[place], &self.state(place));
        }
        if !each.iter().any(|input| Forcing::of(input).is_some()) {
            return None;
        }
        let finite = |(place, input): (usize, &Input)| u64::from(input.is_finite()) << place;
        let any = |of: fn(&Input) -> bool| each.iter().any(of);
        let turns = any(|input| input.flow.gradient != [[0.0; 3]; 3]);
        let pushes = any(|input| input.wrench != Wrench::default());
        Some(Forced {
            velocity: columns(&each, |input| input.flow.velocity),
            gradient: turns
                .then(|| std::array::from_fn(|i| columns(&each, |input| input.flow.gradient[i]))),
            acceleration: columns(&each, |input| input.flow.acceleration),
            wrench: pushes.then(|| {
                [
                    columns(&each, |input| input.wrench.force),
                    columns(&each, |input| input.wrench.torque),
                ]
            }),
            sound: each.iter().enumerate().map(finite).sum(),
        })
    }

    /// The wind that its bodies meet, on top of a stream (m/s); in double precision whatever theirs.
    #[inline(always)]
    fn blown<S: Simd>(&self, simd: S, in_wind: &InWind<'_>, stream: Vec3) -> Forced<P> {
        let position = self.position.map(|column| column.map(P::to_f64));
        let mut time = self.time;
        for (time, body) in time.iter_mut().zip(self.bodies) {
            *time = in_wind.time(*time, body);
        }
        let mut velocity = [[0.0; PACK]; 3];
        let mut acceleration = [[0.0; PACK]; 3];
        let mut gradient = [[[0.0; PACK]; 3]; 3];
        // Where there is no body nothing is wrong.
        let mut sound = u64::MAX << self.taken;
        let count = <Doubles<S> as Lanes<S>>::COUNT;
        let tables = in_wind.wind.has_tables();
        for first in (0..self.taken).step_by(count) {
            let at = load_columns::<S, Doubles<S>, 3>(simd, &position, first);
            let now = <Doubles<S> as Lanes<S>>::load(simd, &time[first..first + count]);
            let mut local = in_wind.wind.in_lanes(&at, now);
            if tables {
                local = in_wind.with_tables::<S>(simd, &local, &position, &time, first);
            }
            let gained = local.acceleration(stream);
            sound |= <Doubles<S> as Lanes<S>>::bits(local.is_finite(&gained)) << first;
            store_columns::<S, Doubles<S>, 3>(&mut velocity, first, &local.velocity);
            store_columns::<S, Doubles<S>, 3>(&mut acceleration, first, &gained);
            for i in 0..3 {
                store_columns::<S, Doubles<S>, 3>(&mut gradient[i], first, &local.gradient[i]);
            }
        }
        let narrow = |columns: [[f64; PACK]; 3]| columns.map(|column| column.map(P::of));
        Forced {
            sound,
            velocity: narrow(velocity),
            gradient: (!in_wind.wind.is_uniform()).then(|| gradient.map(narrow)),
            acceleration: narrow(acceleration),
            wrench: None,
        }
    }
}

fn columns<P: Precision>(inputs: &[Input; PACK], of: impl Fn(&Input) -> Vec3) -> [[P; PACK]; 3] {
    let mut columns = [[P::ZERO; PACK]; 3];
    for (place, input) in inputs.iter().enumerate() {
        put(&mut columns, place, &of(input));
    }
    columns
}

/// What one place has of each row.
fn get<P: Precision, const N: usize>(rows: &[[P; PACK]; N], place: usize) -> [f64; N] {
    std::array::from_fn(|row| rows[row][place].to_f64())
}

fn put<P: Precision, const N: usize>(to: &mut [[P; PACK]; N], place: usize, from: &[f64; N]) {
    for (column, &value) in to.iter_mut().zip(from) {
        column[place] = P::of(value);
    }
}

#[inline(always)]
fn step_packs<S: Simd, L: Lanes<S>, F: Symmetry>(
    simd: S,
    stepper: &Stepper,
    packs: &mut [Pack<L::Scalar>],
    dt: f64,
    acting: &mut Acting<'_>,
    stopped: &mut Vec<(u32, StepError)>,
) where
    L::Scalar: Precision,
{
    let equations = stepper.equations.lift::<F, L>(L::splat(simd, 0.0));
    let stream = stepper.equations.current.unwrap_or_default();
    for pack in packs {
        let forced = match acting {
            Acting::Nothing => None,
            Acting::Inputs(inputs) => pack.told(inputs),
            Acting::Wind(in_wind) => Some(pack.blown(simd, in_wind, stream)),
        };
        for first in (0..pack.taken).step_by(L::COUNT) {
            let forced = forced.as_ref();
            step_lanes::<S, L, F>(simd, stepper, &equations, pack, first, dt, forced, stopped);
        }
    }
}

/// Steps the bodies of `pack` from place `first` on, as many as there are lanes.
#[expect(
    clippy::too_many_arguments,
    reason = "the body of a loop, for processors of any width"
)]
#[inline(always)]
fn step_lanes<S: Simd, L: Lanes<S>, F: Symmetry>(
    simd: S,
    stepper: &Stepper,
    equations: &Equations<F, L>,
    pack: &mut Pack<L::Scalar>,
    first: usize,
    dt: f64,
    forced: Option<&Forced<L::Scalar>>,
    stopped: &mut Vec<(u32, StepError)>,
) where
    L::Scalar: Precision,
{
    let lanes = first..first + L::COUNT;
    // Columns that a model does not use stay out of the processor's way.
    let fluctuates = equations.loads.fluctuates();
    let before = Motion {
        position: load_columns(simd, &pack.position, first),
        orientation: load_columns(simd, &pack.orientation, first),
        xi: load_columns(simd, &pack.velocity, first),
        fluctuation: match fluctuates {
            true => load_columns(simd, &pack.fluctuation, first),
            false => [L::splat(simd, 0.0); 6],
        },
    };
    let noise = Noise {
        seed: pack.seed,
        counter: Counter {
            step: L::load_halves(simd, &pack.step[lanes.clone()]),
            body: L::load_words(simd, &pack.bodies[lanes.clone()]),
        },
    };

    let time = L::load_doubles(simd, &pack.time[lanes.clone()]);
    let forcing = forced.map(
        #[inline(always)]
        |forced| load_forcing(simd, forced, first),
    );
    let Stepped {
        motion: after,
        sound,
        alone,
    } = equations.step(&before, time, dt, &noise, forcing.as_ref());

    let every = (1 << L::COUNT) - 1;
    let told = forced.map_or(every, |forced| (forced.sound >> first) & every);
    let good = L::bits(sound & !alone) & told;
    let was = (good != every).then(|| pack.clone());
    store_columns(&mut pack.position, first, &after.position);
    store_columns(&mut pack.orientation, first, &after.orientation);
    store_columns(&mut pack.velocity, first, &after.xi);
    if fluctuates {
        store_columns(&mut pack.fluctuation, first, &after.fluctuation);
    }
    for place in lanes.clone() {
        pack.time[place] += dt;
        pack.step[place] = pack.step[place].wrapping_add(1);
    }
    let Some(was) = was else { return };
    let alone = L::bits(alone);
    for place in lanes.filter(|place| good & (1 << (place - first)) == 0) {
        let before = was.state(place);
        let input = forced.map_or_else(Input::default, |forced| forced.input(place));
        let input = pack.with_its_noise(place, input);
        let mut state = before;
        let taken = match alone & told & (1 << (place - first)) {
            0 => Err(stepper.why_not(&before, dt, &input)),
            _ => stepper.step(&mut state, dt, &input),
        };
        pack.set(place, &state);
        if let Err(error) = taken
            && place < pack.taken
        {
            stopped.push((input.noise.body, error));
        }
    }
}

#[inline(always)]
fn load_forcing<S: Simd, L: Lanes<S>>(
    simd: S,
    forced: &Forced<L::Scalar>,
    first: usize,
) -> Forcing<L> {
    let [force, torque] = match &forced.wrench {
        Some([force, torque]) => [
            load_columns(simd, force, first),
            load_columns(simd, torque, first),
        ],
        None => [[L::splat(simd, 0.0); 3]; 2],
    };
    Forcing {
        velocity: load_columns(simd, &forced.velocity, first),
        gradient: match &forced.gradient {
            Some([x, y, z]) => Some([
                load_columns(simd, x, first),
                load_columns(simd, y, first),
                load_columns(simd, z, first),
            ]),
            None => None,
        },
        acceleration: load_columns(simd, &forced.acceleration, first),
        force,
        torque,
    }
}

#[inline(always)]
fn load_columns<S: Simd, L: Lanes<S>, const N: usize>(
    simd: S,
    columns: &[[L::Scalar; PACK]; N],
    first: usize,
) -> [L; N] {
    each(
        L::splat(simd, 0.0),
        #[inline(always)]
        |i| L::load(simd, &columns[i][first..first + L::COUNT]),
    )
}

#[inline(always)]
fn store_columns<S: Simd, L: Lanes<S>, const N: usize>(
    columns: &mut [[L::Scalar; PACK]; N],
    first: usize,
    values: &[L; N],
) {
    for i in 0..N {
        values[i].store(&mut columns[i][first..first + L::COUNT]);
    }
}

#[cfg(test)]
#[cfg(target_arch = "x86_64")]
mod tests {
    use super::*;
    use crate::wind::{GustSettings, Gusts};
    use crate::{Body, Fluid, Model, Settings};

    fn stepper() -> Stepper {
        let mut body = Body {
            mass: 1.0,
            inertia: [[1.0, 0.1, 0.0], [0.1, 2.0, 0.0], [0.0, 0.0, 1.5]],
            volume: 1e-3,
            centre_of_buoyancy: [0.01, 0.02, -0.01],
            added_mass: [[0.0; 6]; 6],
            half_extents: [0.3, 0.2, 0.1],
            thickness: 0.1,
            length: 0.6,
            separation: Default::default(),
            slices: vec![],
            surface: Default::default(),
        };
        for i in 0..6 {
            body.added_mass[i][i] = 1e-3 * (1 + i) as f64;
        }
        let settings = Settings {
            model: Model::Consistent,
            ..Settings::default()
        };
        Stepper::new(&body, &Fluid::WATER, None, &settings).unwrap()
    }

    fn run<S: Simd>(simd: S, wind: Option<&Wind>) -> Batch {
        let stepper = stepper();
        let mut batch = Batch::new(3);
        for body in 0..PACK {
            batch.push(&State {
                velocity: [0.1 * body as f64, 0.2, 0.3],
                ..State::default()
            });
        }
        let mut stopped = Vec::new();
        for _ in 0..50 {
            let packs = batch.packs_mut();
            let mut acting = match wind {
                Some(wind) => Acting::Wind(InWind { wind, apart: 0.3 }),
                None => Acting::Nothing,
            };
            step_packs::<S, Doubles<S>, General>(
                simd,
                &stepper,
                packs,
                5e-3,
                &mut acting,
                &mut stopped,
            );
        }
        assert!(stopped.is_empty());
        batch
    }

    #[test]
    fn every_width_gives_the_same_bits() {
        let level = Level::new();
        let mut gusty = Wind::default();
        let gusts = Gusts::new(&GustSettings::default()).unwrap();
        gusty.add(gusts).unwrap();
        for wind in [None, Some(&gusty)] {
            let two = level.as_sse2().map(|simd| run(simd, wind));
            assert!(two.is_some());
            let wider = [
                level.as_avx2().map(|simd| run(simd, wind)),
                level.as_avx512().map(|simd| run(simd, wind)),
            ];
            for batch in wider.into_iter().flatten() {
                assert_eq!(Some(batch), two);
            }
        }
    }
}
