//! The showcase scenes fall like the things they are named after.
//!
//! A maple seed turns some tens of times a second around the vertical, with the wing a little above
//! level, and sinks at the order of 1 m/s; shed as it is it must do so from every seed of the noise. A leaf wanders and turns, a feather takes
//! its time. If the seed dives, its slices do not see their own velocities.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::linalg::{eigen_symmetric, rotate};
use langevin_rigid::{NoiseStream, State};
use langevin_rigid_scenes::advance::advance;
use langevin_rigid_scenes::prepared::{Prepared, Release};
use langevin_rigid_scenes::scene::find;

fn prepared(name: &str) -> Prepared {
    Prepared::new(find(name).unwrap(), None, &()).unwrap()
}

/// The states from the release to `seconds` later.
fn fall(prepared: &Prepared, seed: u64, seconds: f64) -> Vec<State> {
    let release = Release {
        state: prepared.scene().release,
        noise: NoiseStream { seed, body: 0 },
    };
    let mut states = vec![release.state];
    let mut state = release.state;
    while state.time < seconds {
        advance(prepared, &release, &mut state).unwrap();
        states.push(state);
    }
    states
}

/// Mean over the last half of a fall.
fn late(states: &[State], quantity: impl Fn(&State) -> f64) -> f64 {
    let half = &states[states.len() / 2..];
    half.iter().map(quantity).sum::<f64>() / half.len() as f64
}

fn sinking(states: &[State]) -> f64 {
    late(states, |s| -s.world_velocity()[1])
}

#[test]
fn a_maple_seed_spins_itself_down() {
    let seed_body = prepared("maple-seed");
    assert!(seed_body.body().slices.len() > 1);
    for seed in 0..10 {
        let states = fall(&seed_body, seed, 4.0);
        let turns = late(&states, |s| s.world_angular_velocity()[1]) / std::f64::consts::TAU;
        assert!(
            (10.0..22.0).contains(&turns),
            "seed {seed}: {turns} turns a second"
        );
        let speed = sinking(&states);
        assert!((0.9..1.5).contains(&speed), "seed {seed}: {speed} m/s");
        // The span points from the nut, which is inside, up and out.
        let cone = late(&states, |s| {
            rotate(s.orientation, [1.0, 0.0, 0.0])[1].asin()
        });
        let degrees = cone.to_degrees();
        assert!(
            (15.0..25.0).contains(&degrees),
            "seed {seed}: cone of {degrees} degrees"
        );
    }
}

#[test]
fn leaves_and_feathers_wander_and_turn_on_their_way() {
    // One fall among ten may be fast or slow by half: the middle one is the measure, beside the speed of a steady
    // fall broadside.
    for name in ["leaf", "feather"] {
        let prepared = prepared(name);
        let (body, density) = (prepared.body(), prepared.scene().fluid.density);
        let ([.., broadside], _) = eigen_symmetric(&body.separation.drag_area);
        let steady = (2.0 * body.mass * 9.80665 / (density * broadside)).sqrt();
        let mut speeds = Vec::new();
        let mut apart = 0.0f64;
        let mut first: Option<State> = None;
        for seed in 0..10 {
            let states = fall(&prepared, seed, 2.0);
            speeds.push(sinking(&states));
            let up = |s: &State| rotate(s.orientation, [0.0, 1.0, 0.0])[1];
            let least = states.iter().map(up).fold(1.0, f64::min);
            assert!(least < 0.7, "{name} {seed} stays level: {least}");
            let end = *states.last().unwrap();
            let other = first.get_or_insert(end);
            let way = |axis: usize| end.position[axis] - other.position[axis];
            apart = apart.max(way(0).hypot(way(2)));
        }
        speeds.sort_by(f64::total_cmp);
        let middle = speeds[5];
        let ratio = middle / steady;
        assert!(
            (0.75..1.5).contains(&ratio),
            "{name}: {middle} m/s, {ratio}"
        );
        let (least, most) = (speeds[0] / middle, speeds[9] / middle);
        assert!(least > 0.3 && most < 3.0, "{name}: {speeds:?} m/s");
        assert!(apart > 0.1, "{name}: all seeds within {apart} m");
    }
}
