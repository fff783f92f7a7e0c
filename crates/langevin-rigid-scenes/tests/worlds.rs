//! Scenes where bodies touch, float and are many.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::{Ending, State};
use langevin_rigid_formats::table::Values;
use langevin_rigid_scenes::ensemble::{self, FallEnding, Statistics};
use langevin_rigid_scenes::prepared::{Fall, Prepared};
use langevin_rigid_scenes::scene::{Scene, find};
use langevin_rigid_scenes::together::TogetherError;

fn prepared(scene: Scene) -> Prepared {
    Prepared::new(scene, None, &()).unwrap()
}

fn together(prepared: &Prepared) -> Vec<Fall> {
    prepared.drop_together(1, usize::MAX, &()).unwrap()
}

fn last(fall: &Fall) -> State {
    *fall.states.last().unwrap()
}

/// Cosine of the tilt of the body's y axis.
fn up(state: &State) -> f64 {
    let [x, _, z, _] = state.orientation;
    1.0 - 2.0 * (x * x + z * z)
}

fn crowd(count: u32) -> Scene {
    let mut scene = find("leaves").unwrap();
    let crowd = scene.crowd.as_mut().unwrap();
    (crowd.count, crowd.during, crowd.over) = (count, 1.0, [0.4, 0.3, 0.4]);
    scene.release.position = [0.0, 0.6, 0.0];
    scene
}

#[test]
fn leaves_come_to_lie_on_the_ground_and_on_each_other() {
    let leaves = prepared(crowd(30));
    let falls = together(&leaves);
    assert_eq!(falls.len(), 30);
    let starts: Vec<f64> = falls.iter().map(|fall| fall.states[0].time).collect();
    assert!(
        starts.is_sorted() && starts[29] > 0.9 && starts[29] < 1.0,
        "{starts:?}"
    );
    for fall in &falls {
        assert_eq!(fall.ended, Ok(Ending::Rest));
        assert!((0.7..1.2).contains(&fall.scale));
        let state = last(fall);
        assert!(
            (0.0..0.03).contains(&state.position[1]),
            "{:?}",
            state.position
        );
        // On a heap none stands on its edge.
        assert!(up(&state).abs() > 0.8, "{}", up(&state));
    }
}

#[test]
fn a_crowd_has_the_same_bits_on_any_number_of_threads() {
    let leaves = prepared(crowd(12));
    let states = |threads: usize| -> Vec<Vec<State>> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let falls = pool.install(|| together(&leaves));
        falls.into_iter().map(|fall| fall.states).collect()
    };
    assert_eq!(states(1), states(2));
}

#[test]
fn a_crowd_has_the_kinds_that_are_asked_for() {
    let mut scene = crowd(40);
    scene.stop.time = Some(1.2);
    let kinds = toml_kinds();
    scene.crowd.as_mut().unwrap().kinds = kinds;
    let mixed = prepared(scene);
    let falls = together(&mixed);
    let of = |kind: usize| falls.iter().filter(|fall| fall.kind == kind).count();
    // Shares of 1, 1 and 2 in 4.
    assert!((4..=18).contains(&of(0)), "{}", of(0));
    assert!((4..=18).contains(&of(1)), "{}", of(1));
    assert!((12..=28).contains(&of(2)), "{}", of(2));
    assert_eq!(of(0) + of(1) + of(2), 40);
    let names = mixed.surroundings().unwrap().kinds().iter();
    let names: Vec<&str> = names.map(|kind| kind.scene.name.as_str()).collect();
    assert_eq!(names, ["leaves", "coin", "leaf"]);
}

fn toml_kinds() -> Vec<langevin_rigid_scenes::scene::CrowdKind> {
    let kind = |scene: &str, share: f64| langevin_rigid_scenes::scene::CrowdKind {
        scene: scene.to_owned(),
        share,
    };
    vec![kind("coin", 1.0), kind("leaf", 2.0)]
}

#[test]
fn a_leaf_that_lands_on_a_pond_stays_there() {
    let pond = prepared(find("pond").unwrap());
    let falls = together(&pond);
    let states = &falls[0].states;
    let afloat = states.iter().filter(|state| state.time > 4.0);
    // Waves of a centimetre.
    let highest = afloat
        .map(|state| state.position[1].abs())
        .fold(0.0, f64::max);
    assert!(highest < 0.02, "{highest}");
}

#[test]
fn a_ball_held_under_water_rises_and_floats_at_its_draught() {
    let ball = prepared(find("ball-up").unwrap());
    let falls = together(&ball);
    let states = &falls[0].states;
    let highest = states
        .iter()
        .map(|state| state.position[1])
        .fold(-1.0, f64::max);
    assert!(highest > 0.06, "it breaks the surface: {highest}");
    // The cap below a plane at d over the lowest point has the volume pi d^2 (3 r - d) / 3.
    let share = |y: f64| {
        let d = 0.05 - y;
        d * d * (0.15 - d) / (4.0 * 0.05f64.powi(3))
    };
    let still = last(&falls[0]);
    let weight = ball.body().density() / 998.2;
    assert!(
        (share(still.position[1]) - weight).abs() < 0.003,
        "{still:?}"
    );
}

#[test]
fn coins_lie_in_their_glass_with_either_face_up() {
    let coins = prepared(find("coin-toss").unwrap());
    let falls = ensemble::run(&coins, 0..40, &());
    for fall in &falls {
        let lying = fall.lying.unwrap();
        let [x, depth, z] = lying.place;
        assert!(x.abs() < 0.06 && z.abs() < 0.06, "{lying:?}");
        assert!((0.33..0.35).contains(&depth), "{lying:?}");
        assert!(lying.time > fall.time);
    }
    let faces = Statistics::new(&falls).faces.unwrap();
    assert_eq!(faces.up + faces.down + faces.edge, 40);
    assert!(faces.up >= 8 && faces.down >= 8, "{faces:?}");
    let table = ensemble::landings(&coins, &falls);
    let faces = table.columns().iter().find(|column| column.name == "face");
    let Some(Values::Words(told)) = faces.map(|column| &column.values) else {
        panic!("no faces: {table:?}");
    };
    let count = |face| told.iter().filter(|told| **told == face).count();
    let faces = Statistics::new(&falls).faces.unwrap();
    assert_eq!(
        [count("up"), count("down"), count("edge")],
        [faces.up, faces.down, faces.edge]
    );
}

#[test]
fn a_body_may_come_to_rest_without_the_ground() {
    let text = r#"
        fluid.preset = "air"
        body = { shape = "box", size = [0.1, 0.02, 0.1], density = 500.0 }
        release.position = [0.0, 0.7, 0.0]
        run = { time_step = 0.002, duration = 8.0 }
        [[obstacle]]
        shape = "box"
        size = [0.5, 0.2, 0.5]
        position = [0.0, 0.5, 0.0]
    "#;
    let table = prepared(Scene::parse("table", "table.toml", text).unwrap());
    let falls = ensemble::run(&table, 0..2, &());
    for fall in &falls {
        assert_eq!(fall.ending, FallEnding::Rest);
        // The top of the table is 10 cm below the release, and half of the 2 cm of the body lies between.
        assert!(
            (fall.lying.unwrap().place[1] - 0.09).abs() < 1e-3,
            "{fall:?}"
        );
    }
}

#[test]
fn a_run_alone_is_the_run_of_an_ensemble() {
    let coins = prepared(find("coin-toss").unwrap());
    let all = ensemble::run(&coins, 0..6, &());
    assert_eq!(ensemble::run(&coins, 3..4, &()), all[3..4]);
}

#[test]
fn a_run_that_ends_before_anything_is_let_go_is_told() {
    let mut scene = find("coin").unwrap();
    scene.stop.time = Some(0.05);
    let error = prepared(scene)
        .drop_together(1, usize::MAX, &())
        .unwrap_err();
    assert!(matches!(error, TogetherError::Nobody), "{error}");
}

#[test]
fn a_body_inside_another_is_refused_by_name() {
    let text = r#"
        fluid.preset = "air"
        body = { shape = "box", size = [0.1, 0.01, 0.1], density = 500.0 }
        release.position = [0.0, 1.0, 0.0]
        run = { time_step = 0.002, duration = 1.0, ground = 0.0 }
        [[obstacle]]
        shape = "box"
        size = [0.2, 0.2, 0.2]
        position = [0.0, 0.5, 0.0]
        [[obstacle]]
        shape = "box"
        size = [0.2, 0.2, 0.2]
        position = [0.0, 1.0, 0.0]
    "#;
    let scene = Scene::parse("inside", "inside.toml", text).unwrap();
    let error = prepared(scene)
        .drop_together(1, usize::MAX, &())
        .unwrap_err();
    assert!(matches!(error, TogetherError::Inside(_)));
    assert!(
        error.to_string().contains("inside [[obstacle]] 2"),
        "{error}"
    );
}
