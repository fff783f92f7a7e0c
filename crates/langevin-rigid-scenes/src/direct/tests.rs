//! What is found does what is asked, and does it again.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

use langevin_rigid::State;

use super::*;
use crate::scene;

fn card(direct: &str) -> Prepared {
    let text = format!(
        "fluid.preset = \"air\"\n\
         run = {{ time_step = 0.004, duration = 4.0, ground = 0.0, seed = 5 }}\n\
         body = {{ shape = \"box\", size = [0.085, 0.0003, 0.055], triangles = 300, density = 900.0 }}\n\
         release = {{ position = [0.0, 1.0, 0.0], tilt = 20.0 }}\n{direct}"
    );
    let scene = Scene::parse("card", "card.toml", &text).unwrap_or_else(|e| panic!("{e}"));
    Prepared::new(scene, None, &()).unwrap()
}

/// The fall of the scene that was found, read from its text.
fn again(found: &Directed, searched: &Prepared) -> (Prepared, Vec<State>) {
    let scene = found.scene(searched);
    let text = scene.to_toml().unwrap();
    let read = Scene::parse("card", "found", &text).unwrap();
    assert_eq!(read, scene, "{text}");
    let prepared = Prepared::of(read, searched.baked().clone()).unwrap();
    let fall = prepared.drop(&prepared.release(0), &());
    (prepared, fall.states)
}

/// Every one of the best falls again to the same bits and misses as much.
fn all_fall_again(found: &Found, searched: &Prepared) {
    for best in &found.best {
        let (_, states) = again(best, searched);
        assert_eq!(states.last(), Some(&best.last));
        let misses = misses(searched, &states, &best.ending).unwrap();
        assert_eq!(misses, best.misses);
    }
}

const FREE: &str = "direct.free = { tilt = 40.0, heading = 180.0, position = [0.0, 0.1, 0.0], velocity = 0.3, spin = 2.0 }\n";

#[test]
fn a_place_that_can_be_reached_is_reached_again_and_again() {
    let land = "direct.land = { at = [0.3, 0.0, 0.2], within = 0.03, side = \"up\" }\n";
    let card = card(&format!("{land}{FREE}direct.best = 3\ndirect.falls = 3000"));
    let found = search(&card, &()).unwrap();
    assert_eq!(found.asks, ["place", "side"]);
    assert_eq!(found.best.len(), 3);
    for best in &found.best {
        assert!(best.is_hit(), "{best:?}");
        let [x, _, z] = best.last.position;
        assert!(libm::hypot(x - 0.3, z - 0.2) <= 0.03);
    }
    assert!(found.hits >= 3 && found.drawn == 1500 && found.falls <= 3000);
    assert_ne!(found.best[0].release, found.best[1].release);
    all_fall_again(&found, &card);
}

#[test]
fn the_search_does_not_depend_on_threads() {
    let land =
        "direct.land = { at = [0.3, 0.0, 0.2], within = 0.01, time = 1.0, time_within = 0.1 }\n";
    let card = card(&format!("{land}{FREE}direct.best = 2\ndirect.falls = 400"));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| search(&card, &()).unwrap())
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn what_cannot_be_is_missed_as_little_as_can_be() {
    let land = "direct.land = { at = [100.0, 0.0, 0.0], within = 0.1 }\n";
    let card = card(&format!("{land}{FREE}direct.falls = 400\ndirect.best = 2"));
    let found = search(&card, &()).unwrap();
    assert_eq!((found.hits, found.drawn_hits, found.best.len()), (0, 0, 2));
    let best = &found.best[0];
    assert!(!best.is_hit());
    // Each of the tolerances away that the place is.
    assert!(
        best.score() > 900.0 && best.score() < 999.0,
        "{}",
        best.score()
    );
    all_fall_again(&found, &card);
}

#[test]
fn a_ring_is_passed() {
    let ring = "[[direct.ring]]\ncentre = [0.1, 0.5, 0.0]\nradius = 0.04\n[[direct.ring]]\n\
                centre = [0.2, 0.2, 0.0]\nnormal = [1.0, 1.0, 0.0]\nradius = 0.1";
    let card = card(&format!(
        "{FREE}direct.falls = 2000\ndirect.best = 1\n{ring}"
    ));
    let found = search(&card, &()).unwrap();
    let best = &found.best[0];
    assert!(best.is_hit(), "{best:?}");
    let (_, states) = again(best, &card);
    let near = states.iter().map(|state| {
        let [x, y, z] = state.position;
        libm::hypot(libm::hypot(x - 0.1, y - 0.5), z)
    });
    // A step's way beside the ring's radius.
    assert!(near.fold(f64::INFINITY, f64::min) < 0.05);
}

#[test]
fn a_force_takes_the_body_where_chance_does_not() {
    let land = "direct.land = { at = [0.0, 0.0, 0.5], within = 0.05 }\n";
    let ask = format!("{land}direct.falls = 1500\ndirect.best = 1\n");
    let left = search(&card(&ask), &()).unwrap();
    assert!(!left.best[0].is_hit());
    let card = card(&format!("{ask}direct.steer = 0.3\n"));
    let found = search(&card, &()).unwrap();
    let best = &found.best[0];
    assert!(best.is_hit(), "{best:?}");
    let steering = best.steering.as_ref().unwrap();
    let [largest, rms] = steering.largest_and_rms(best.last.time);
    assert!(largest <= 0.3 * 9.81 * card.body().mass && rms > 0.0);
    all_fall_again(&found, &card);
}

#[test]
fn falls_in_wind_and_of_another_speed_fall_again() {
    let card = card(
        "direct.land = { side = \"down\" }\ndirect.falls = 64\ndirect.best = 4\n\
         direct.free = { tilt = 90.0, velocity = 4.0 }\n\
         [[wind]]\nfield = \"gusts\"\nrms = 0.5\nlength = 1.0",
    );
    let found = search(&card, &()).unwrap();
    assert_eq!(found.best.len(), 4);
    all_fall_again(&found, &card);
}

#[test]
fn built_in_bodies_move_as_they_are_known_to() {
    for (name, wanted) in [
        ("maple-seed", Motion::Spiral),
        ("leaf", Motion::Flutter),
        ("sheet-a6", Motion::Tumble),
        ("paper-75", Motion::Chaotic),
    ] {
        let scene = scene::find(name).unwrap();
        let prepared = Prepared::new(scene, None, &()).unwrap();
        let release = prepared.release(0);
        let mut glimpses = glimpses::Glimpses::new(&prepared, &release.state);
        let mut before = release.state;
        prepared
            .follow(&release, |state| {
                crate::lanes::Watch::see(&mut glimpses, &before, state);
                before = *state;
                ControlFlow::Continue(())
            })
            .unwrap();
        let size = prepared.body().half_extents[0];
        assert_eq!(motion::motion(&glimpses.seen, size), wanted, "{name}");
    }
}

#[test]
fn a_precomputed_turbulence_is_that_of_the_search() {
    let text = "fluid.preset = \"air\"\n\
                body = { shape = \"box\", size = [0.085, 0.0003, 0.055], triangles = 300, density = 900.0 }\n\
                release = { position = [0.0, 1.0, 0.0], velocity = [5.0, 0.0, 0.0], carried = 0.05 }\n\
                run = { time_step = 0.004, ground = 0.0, model = \"consistent\", turbulence = \"history\" }\n\
                turbulence = { cells = [8, 16, 8], duration = 0.5 }\n\
                direct = { land.side = \"up\", best = 2, falls = 32, free = { tilt = 90.0, velocity = 2.0 } }";
    let scene = Scene::parse("card", "card.toml", text).unwrap();
    let card = Prepared::new(scene, None, &()).unwrap();
    for best in search(&card, &()).unwrap().best {
        // Baked anew.
        let again = Prepared::new(best.scene(&card), None, &()).unwrap();
        let fall = again.drop(&again.release(0), &());
        assert_eq!(fall.states.last(), Some(&best.last));
    }
}

#[test]
fn a_thin_disc_in_water_is_found_on_a_helix() {
    let text = "fluid.preset = \"water\"\n\
                body = { shape = \"disc\", diameter = 0.03, thickness = 0.0005, triangles = 320, density = 1200.0 }\n\
                release = { position = [0.0, 1.0, 0.0], tilt = 10.0 }\n\
                run = { time_step = 0.005, duration = 60.0, ground = 0.0 }\n\
                direct = { motion = [\"helix\"], best = 1, falls = 64, free.tilt = 90.0 }";
    let scene = Scene::parse("disc", "disc.toml", text).unwrap();
    let disc = Prepared::new(scene, None, &()).unwrap();
    assert!(search(&disc, &()).unwrap().best[0].is_hit());
}

/// Asks to stop after so many reports.
struct Impatient(AtomicU32);

impl Progress for Impatient {
    fn report(&self, _: &str, _: f64) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) > 20
    }
}

#[test]
fn what_is_stopped_has_the_best_so_far() {
    let card = card("direct.land = { side = \"up\" }\ndirect.free = { tilt = 90.0 }");
    let found = search(&card, &Impatient(AtomicU32::new(0))).unwrap();
    assert!(found.falls > 20 && found.falls < 10_000, "{}", found.falls);
    assert!(!found.best.is_empty());
}

#[test]
fn a_scene_that_asks_for_nothing_is_told_so() {
    let error = search(&card(""), &()).unwrap_err();
    assert!(error.to_string().contains("`card`"), "{error}");
}
