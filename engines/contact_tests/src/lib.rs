//! What the tests of the contact adapters share: a card, how two hundred of them are let go, and what becomes of them on the
//! ground in any engine.
#![allow(clippy::unwrap_used, reason = "of tests")]

#[cfg(feature = "bevy")]
pub mod bevy;

use langevin_rigid::linalg::{Vec3, quat_from_rotation_vector, rotate};
use langevin_rigid::{Body, Fluid, Settings, State, Stepper};

/// Size of a card of cardboard (m).
pub const SIZE: Vec3 = [0.06, 0.0005, 0.09];
/// Its density (kg/m^3).
pub const DENSITY: f64 = 700.0;

/// The card itself.
pub fn card() -> Body {
    Body::cuboid(SIZE, DENSITY).unwrap()
}

/// How it moves in air.
pub fn stepper() -> Stepper {
    Stepper::new(&card(), &Fluid::AIR, None, &Settings::default()).unwrap()
}

/// A body at rest at `position` (m), turned by a rotation vector (rad).
pub fn pose(position: Vec3, turn: Vec3) -> State {
    State {
        position,
        orientation: quat_from_rotation_vector(turn),
        ..State::default()
    }
}

/// How two hundred cards are let go: side by side in two layers, each turned otherwise.
pub fn releases() -> impl Iterator<Item = State> {
    (0..200u32).map(|number| {
        let (column, row) = (f64::from(number % 10), f64::from(number / 10 % 10));
        let height = 1.0 + 0.5 * f64::from(number / 100) + 0.01 * f64::from(number % 7);
        let turn = [0.37, 0.11, 0.23].map(|turn| turn * f64::from(number));
        pose([0.12 * column, height, 0.12 * row], turn)
    })
}

/// A world of an engine in air, with the ground at height zero.
pub trait Engine {
    /// Names a card.
    type Card: Copy;
    /// The fixed step (s).
    const DT: f64;
    /// Lets a card go.
    fn release(&mut self, pose: &State) -> Self::Card;
    /// Has this wind (m/s) from now on.
    fn blow(&mut self, wind: Vec3);
    /// Has this torque (N m) on a card from now on.
    fn twist(&mut self, card: Self::Card, torque: Vec3);
    /// Takes a fixed step.
    fn step(&mut self);
    /// The card now; of one that took a step.
    fn seen(&self, card: Self::Card) -> Seen;
}

/// A card in an engine.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// Its state in the fluid.
    pub state: State,
    /// Where the engine has it (m).
    pub place: Vec3,
    /// Whether the engine lets it sleep.
    pub asleep: bool,
}

impl Seen {
    /// Height of the lower of the two places (m).
    fn lower(&self) -> f64 {
        self.place[1].min(self.state.position[1])
    }

    fn is_on_edge(&self) -> bool {
        rotate(self.state.orientation, [0.0, 1.0, 0.0])[1].abs() < 0.5
    }
}

/// The cards of [`releases`] are on the ground half a minute later, and five seconds after the last of them they
/// [lie and sleep](assert_lie_and_sleep).
pub fn two_hundred_cards_land_lie_flat_and_sleep<E: Engine>(engine: &mut E) {
    let cards: Vec<E::Card> = releases().map(|pose| engine.release(&pose)).collect();
    let seen = |engine: &E| -> Vec<Seen> { cards.iter().map(|card| engine.seen(*card)).collect() };
    let landed = |engine: &E| seen(engine).iter().all(|card| card.place[1] < 0.15);
    until(engine, 30.0, landed, "not all have landed");
    run(engine, 5.0);
    assert_lie_and_sleep(&seen(engine));
}

/// Of two hundred cards none is below the ground, and nearly all lie flat and sleep.
pub fn assert_lie_and_sleep(cards: &[Seen]) {
    let count = |of: fn(&Seen) -> bool| cards.iter().filter(|card| of(card)).count();
    let below = count(|card| card.lower() < -0.001);
    let on_edge = count(Seen::is_on_edge);
    let asleep = count(|card| card.asleep);
    let counts = format!("{below} below the ground, {on_edge} on edge, {asleep} asleep");
    println!("{counts}");
    assert_eq!(cards.len(), 200);
    assert!(below == 0 && on_edge <= 2 && asleep >= 190, "{counts}");
}

/// A card that sleeps is left as it is by a breath, and blown away by a gust.
pub fn a_gust_wakes_a_card_and_a_breath_does_not<E: Engine>(engine: &mut E) {
    let card = asleep(engine);
    let lies = engine.seen(card).state;
    let mut blow = |speed: f64| {
        engine.blow([speed, 0.4 * speed, 0.0]);
        run(engine, 1.0);
        engine.seen(card)
    };
    let breath = blow(0.05);
    assert!(breath.asleep, "a breath wakes it");
    assert_eq!(breath.state, lies);
    let gust = blow(8.0);
    assert!(!gust.asleep, "a gust does not wake it");
    assert!(gust.place[0] > 0.1, "{:?}", gust.place);
}

/// A card that sleeps is left as it is by a tenth of the torque that would tip it over, and woken by half of it.
pub fn a_torque_wakes_a_card_and_a_slight_one_does_not<E: Engine>(engine: &mut E) {
    let card = asleep(engine);
    let lies = engine.seen(card).state;
    let tips = self::card().mass * 9.81 * 0.5 * SIZE[0];
    let mut twist = |share: f64, seconds: f64| {
        engine.twist(card, [0.0, 0.0, share * tips]);
        run(engine, seconds);
        engine.seen(card)
    };
    let slight = twist(0.1, 1.0);
    assert!(slight.asleep, "a slight torque wakes it");
    assert_eq!(slight.state, lies);
    // Before it falls asleep again, since it does not move.
    assert!(!twist(0.5, 0.25).asleep, "a torque does not wake it");
}

/// A card that was let go just above the ground and sleeps.
fn asleep<E: Engine>(engine: &mut E) -> E::Card {
    let card = engine.release(&pose([0.0, 0.01, 0.0], [0.0; 3]));
    let asleep = |engine: &E| engine.seen(card).asleep;
    until(engine, 10.0, asleep, "the card does not sleep");
    card
}

fn run<E: Engine>(engine: &mut E, seconds: f64) {
    for _ in 0..steps::<E>(seconds) {
        engine.step();
    }
}

/// Steps until `done`, for so many seconds at most.
fn until<E: Engine>(engine: &mut E, seconds: f64, done: impl Fn(&E) -> bool, or: &str) {
    for _ in 0..steps::<E>(seconds) {
        engine.step();
        if done(engine) {
            return;
        }
    }
    panic!("{or} after {seconds} s");
}

fn steps<E: Engine>(seconds: f64) -> usize {
    (seconds / E::DT).round() as usize
}
