use std::sync::atomic::{AtomicBool, Ordering};

use langevin_rigid::linalg::{quat_from_rotation_vector, rotate};
use langevin_rigid::{Bake, State};

use super::*;
use crate::baking;
use crate::scene::{Scene, Spread};

/// A ball in water without turbulence: its motion is known, and every direction is alike.
fn ball(extra: &str) -> Scene {
    let text = format!(
        "fluid.preset = \"water\"\n{extra}\n\
         [body]\nshape = \"ellipsoid\"\nsemi_axes = [0.01, 0.01, 0.01]\ntriangles = 80\n\
         density = 2000.0\n"
    );
    Scene::parse("ball", "ball.toml", &text).unwrap()
}

fn prepared(scene: &Scene) -> Prepared {
    Prepared::new(scene.clone(), None, &()).unwrap()
}

fn bake(scene: &Scene) -> Bake {
    baking::bake_scene(scene, None, &()).unwrap().bake
}

fn falls(scene: &Scene, runs: u32) -> Vec<Fall> {
    run(&prepared(scene), 0..runs, &())
}

const DRIFT: &str = "run = { time_step = 0.002, duration = 0.5, model = \"kirchhoff\" }";

#[test]
fn without_scatter_and_noise_all_falls_are_one() {
    let falls = falls(&ball(DRIFT), 5);
    let statistics = Statistics::new(&falls);
    assert_eq!(statistics.t.len(), 31, "0 to 30 sixtieths, both included");
    assert_eq!(statistics.falling, [5; 31]);
    for spread in [&statistics.depth_std, &statistics.x_std, &statistics.z_std] {
        assert_eq!(spread, &[0.0; 31]);
    }
    // Uniform acceleration: (m - rho V) g / (m + a rho V); the mesh's own added mass is used.
    let scene = ball(DRIFT);
    let body = bake(&scene).body;
    let displaced = scene.fluid.density * body.volume;
    let total = body.mass + scene.fluid.density * body.added_mass[1][1];
    let acceleration = 9.81 * (body.mass - displaced) / total;
    for (t, depth) in statistics.t.iter().zip(&statistics.depth_mean) {
        let wanted = 0.5 * acceleration * t * t;
        // Linear between steps: off by at most a dt^2 / 8.
        assert!(
            (depth - wanted).abs() < 1e-4 * wanted + 5e-7 * acceleration,
            "{t}"
        );
    }
    assert_eq!(statistics.landing_sigma_x, None);
}

#[test]
fn a_scatter_of_velocity_spreads_in_proportion_to_time() {
    // No load acts sideways, so the ball keeps its sideways speed, whatever its mass: the spread is
    // the scatter of the speed times the time, for the very numbers that were drawn.
    let sigma = 0.05;
    let scene = ball(&format!("{DRIFT}\nscatter.velocity = {sigma}"));
    let falls = falls(&scene, 2000);
    let statistics = Statistics::new(&falls);
    let (t, spread) = (statistics.t[30], statistics.x_std[30]);
    for (t_i, s) in statistics.t.iter().zip(&statistics.x_std) {
        assert!((s - spread * t_i / t).abs() < 1e-3 * spread, "{t_i}");
    }
    // Five standard errors of a standard deviation, sigma / sqrt(2 n).
    for speed in [
        spread / t,
        statistics.z_std[30] / t,
        statistics.depth_std[30] / t,
    ] {
        assert!(
            (speed / sigma - 1.0).abs() < 5.0 / 4000f64.sqrt(),
            "{speed}"
        );
    }
}

#[test]
fn releases_have_the_scatter_that_was_asked_for() {
    let mut scene = ball(DRIFT);
    scene.scatter.tilt = Some(Spread::About(8.0));
    scene.scatter.spin = Some(Spread::About(0.5));
    let runs = 4000;
    let (mut tilt, mut spin, mut cross) = ([0.0; 2], [0.0; 3], 0.0);
    for run in 0..runs {
        let state = scattered_release(&scene, run);
        let normal = rotate(state.orientation, [0.0, 1.0, 0.0]);
        // Tipping about x moves the normal along z, tipping about z along -x.
        let angle = normal[1].acos() / (1.0 - normal[1] * normal[1]).sqrt();
        let (about_x, about_z) = (angle * normal[2], -angle * normal[0]);
        let w = state.world_angular_velocity();
        tilt[0] += about_x * about_x / f64::from(runs);
        tilt[1] += about_z * about_z / f64::from(runs);
        cross += about_x * w[0] / f64::from(runs);
        for i in 0..3 {
            spin[i] += w[i] * w[i] / f64::from(runs);
        }
        assert!(state.world_velocity().iter().all(|v| v.abs() < 1e-15));
    }
    let within = 5.0 / (2.0 * f64::from(runs)).sqrt();
    for variance in tilt {
        assert!((variance.sqrt().to_degrees() / 8.0 - 1.0).abs() < within);
    }
    for variance in spin {
        assert!((variance.sqrt() / 0.5 - 1.0).abs() < within);
    }
    let unit = 8f64.to_radians() * 0.5;
    assert!(cross.abs() < 5.0 * unit / f64::from(runs).sqrt());
}

#[test]
fn a_run_is_decided_by_seed_and_number_alone() {
    let text = "run = { time_step = 0.005, duration = 0.2, seed = 3 }\nscatter.tilt = 8.0";
    let scene = ball(text);
    let on = |threads: usize, runs: u32| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| falls(&scene, runs))
    };
    let one = on(1, 7);
    assert_eq!(one, on(3, 7));
    assert_eq!(one[..4], on(2, 4));
    assert_ne!(one[0].end, one[1].end);
    let mut other = scene.clone();
    other.seed = 4;
    assert_ne!(falls(&other, 1)[0].end, one[0].end);
}

#[test]
fn walls_hold_the_centre_and_the_floor_ends_the_fall() {
    let scene = ball(
        "run = { time_step = 0.002, model = \"kirchhoff\" }\ntank.size = [0.2, 0.5, 0.4]\n\
         release = { position = [1.0, 2.0, 3.0], velocity = [1.0, 0.0, -0.1] }",
    );
    assert_eq!(scene.stop.ground, Some(1.5));
    let fall = &falls(&scene, 1)[0];
    assert_eq!(fall.ending, FallEnding::Ground);
    // At the wall in x since t = 0.1 s, still on its way in z, down by the depth less its radius.
    assert!((fall.end[0] - 0.1).abs() < 1e-15);
    assert!((fall.end[2] + 0.1 * fall.time).abs() < 1e-6);
    assert!(fall.end[1] > 0.49 && fall.end[1] < 0.495, "{}", fall.end[1]);
    let largest = fall.samples.iter().map(|p| p[0]).fold(0.0, f64::max);
    assert!((largest - 0.1).abs() < 1e-15);
}

#[test]
fn the_columns_stop_where_most_have_landed() {
    let scene = ball(
        "run = { time_step = 0.002, model = \"kirchhoff\" }\ntank.size = [9.0, 0.3, 9.0]\n\
         scatter.velocity = 0.2",
    );
    let prepared = prepared(&scene);
    let falls = run(&prepared, 0..40, &());
    let statistics = Statistics::new(&falls);
    let last = statistics.falling.last().copied().unwrap();
    let next = falls
        .iter()
        .filter(|f| f.samples.len() > statistics.t.len());
    assert!(last >= 20 && next.count() < 20);
    assert_eq!(statistics.landed, 40);
    // The sideways speeds are kept: landing points are drawn speed times time of fall.
    let mut distances: Vec<f64> = falls
        .iter()
        .map(|f| {
            let v = scattered_release(&scene, f.run).world_velocity();
            f.time * (v[0] * v[0] + v[2] * v[2]).sqrt()
        })
        .collect();
    distances.sort_by(f64::total_cmp);
    let wanted = 0.5 * (distances[19] + distances[20]);
    let median = statistics.median_landing_distance.unwrap();
    assert!((median - wanted).abs() < 1e-6, "{median} {wanted}");
    let table = landings(&prepared, &falls).csv();
    assert_eq!(table.lines().count(), 41);
    let columns = table.lines().map(|l| l.split(',').count());
    assert!(columns.clone().all(|n| n == 37), "{table}");
}

/// The motion of a body whose normal leans by `angle(t)`, about an axis at `heading(t)`.
fn motion(angle: impl Fn(f64) -> f64, heading: impl Fn(f64) -> f64) -> MotionTracker {
    let state = |t: f64| {
        let (a, h) = (angle(t), heading(t));
        State {
            orientation: quat_from_rotation_vector([a * h.cos(), 0.0, a * h.sin()]),
            ..State::default()
        }
    };
    let mut tracker = MotionTracker::new([0.0, -1.0, 0.0], &state(0.0));
    for i in 1..=2000 {
        tracker.follow(&state(0.01 * f64::from(i)));
    }
    tracker
}

#[test]
fn motions_are_told_apart() {
    let fixed = |_| 0.4;
    let steady = motion(|t| 0.5 * (-t).exp(), fixed);
    assert_eq!(steady.motion(), MotionClass::Steady);
    // A lean that only goes around is no swing.
    assert_eq!(motion(|_| 0.5, |t| t).motion(), MotionClass::Steady);
    let flutter = motion(|t| (std::f64::consts::PI * t).cos(), fixed);
    assert_eq!((flutter.turnovers(), flutter.swings()), (0, 20));
    assert_eq!(flutter.motion(), MotionClass::Flutter);
    let tumble = motion(|t| 0.3 * t, fixed);
    assert_eq!((tumble.turnovers(), tumble.net_turnovers()), (2, 2));
    assert_eq!(tumble.motion(), MotionClass::Tumble);
    // Past the vertical and back again: turnovers that cancel.
    let rocking = motion(|t| 2.0 * (std::f64::consts::PI * t / 5.0).sin(), fixed);
    assert_eq!((rocking.turnovers(), rocking.net_turnovers()), (8, 0));
    assert_eq!(rocking.motion(), MotionClass::Chaotic);
    // Trembling about the vertical is no turnover.
    let edge = motion(
        |t| std::f64::consts::FRAC_PI_2 + 0.05 * (9.0 * t).sin(),
        fixed,
    );
    assert!(edge.turnovers() == 0, "{edge:?}");
}

#[test]
fn a_fall_that_diverges_is_left_out_and_named() {
    let prepared = prepared(&ball(DRIFT));
    let mut falls = run(&prepared, 0..4, &());
    let before = Statistics::new(&falls[..3]);
    falls[3].ending = FallEnding::Diverged("the state diverged".into());
    falls[3].samples.truncate(5);
    assert_eq!(Statistics::new(&falls), before);
    assert!(landings(&prepared, &falls).csv().contains("diverged"));
}

#[test]
fn cancelled_work_keeps_the_falls_that_are_done() {
    /// Cancels after the first complete fall.
    struct First(AtomicBool);
    impl Progress for First {
        fn report(&self, _: &str, _: f64) {
            self.0.store(true, Ordering::Relaxed);
        }
        fn cancelled(&self) -> bool {
            self.0.load(Ordering::Relaxed)
        }
    }
    let prepared = prepared(&ball(DRIFT));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let first = First(AtomicBool::new(false));
    let falls = pool.install(|| run(&prepared, 0..100, &first));
    // Those that fell beside the first ended in the same step; the others had not begun.
    assert!(falls.iter().map(|f| f.run).eq(0..TOGETHER as u32));
}

#[test]
fn mistakes_in_the_new_tables_have_their_place() {
    let wrong = |extra: &str| {
        let text = format!(
            "fluid.preset = \"water\"\n{DRIFT}\n[body]\nshape = \"ellipsoid\"\n\
             semi_axes = [0.01, 0.01, 0.01]\ndensity = 2000.0\n{extra}\n"
        );
        let error = Scene::parse("bad", "bad.toml", &text).unwrap_err();
        (error.line, error.column, error.message)
    };
    for (text, place, word) in [
        ("[scatter]\ntilt = -1.0", (8, 8), "between 0 and 1e6"),
        ("[scatter]\nspin = nan", (8, 8), "is NaN"),
        ("[scatter]\nvelocity = inf", (8, 12), "is inf"),
        ("[scatter]\ntilts = 1.0", (8, 1), "tilts"),
        ("[scatter]\nmass = []", (8, 8), "a list of 1 to"),
        ("[scatter]\nmass = [-1.0]", (8, 8), "between 0 and 1e30"),
        (
            "[scatter]\nwind = [1, 2]\nheight = \"high\"",
            (9, 10),
            "a standard deviation",
        ),
        ("[scatter]\nwind = [[1, 2]]", (8, 8), "numbers or [x, y, z]"),
        (
            "[scatter]\nsize = { uniform = [2, 1] }",
            (8, 8),
            "in this order",
        ),
        (
            "[scatter]\nsize = { uniform = [2] }",
            (8, 8),
            "[least, most]",
        ),
        (
            "[scatter]\nsize = { normal = [1, -1] }",
            (8, 8),
            "standard deviation",
        ),
        (
            "[scatter]\nsize = { normal = [1, 1], uniform = [1, 2] }",
            (8, 8),
            "takes a standard",
        ),
        ("[scatter]\nfluid = [\"honey\"]", (8, 10), "honey"),
        ("[scatter]\nfluid = []", (8, 9), "at least one"),
        (
            "[scatter]\nfluid_density = 1.0\nfluid = [\"air\"]",
            (8, 17),
            "not both",
        ),
        ("[tank]\nsize = [0.3, 0.0, 0.3]", (8, 8), "one is 0"),
        (
            "[tank]\nsize = [0.3, 0.3]",
            (8, 8),
            "takes 3 values, and has 2",
        ),
        ("[tank]", (7, 1), "size"),
    ] {
        let (line, column, message) = wrong(text);
        assert_eq!((line, column), place, "{text}: {message}");
        assert!(message.contains(word), "{message}");
    }
}

#[test]
fn scatter_and_tank_are_written_and_read_back() {
    let scene = ball(
        "run = { time_step = 0.002, ground = -1.0 }\n\
         scatter = { tilt = 8.1, spin = 0.3, heading = [0, 90], size = { uniform = [0.5, 2] }, \
         fluid = [\"air\"], mass = { normal = [1, 0.1] }, velocity = [[1, 2, 3], 0.5], height = [2] }\n\
         tank.size = [0.38, 0.33, 0.32]\nrelease.position = [0.0, 0.1, 0.0]",
    );
    assert_eq!(scene.stop.ground, Some(0.1 - 0.33));
    let again = Scene::parse("ball", "again.toml", &scene.to_toml().unwrap()).unwrap();
    assert_eq!(again, scene);
}
