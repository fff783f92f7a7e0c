use langevin_rigid::linalg::rotate;

use super::*;
use crate::ensemble::{Fall, run};
use crate::prepared::Prepared;

/// A ball without turbulence: its motion is known.
fn ball(fluid: &str, body: &str, rest: &str) -> Prepared {
    let text = format!(
        "fluid.preset = {fluid:?}\n\
         run = {{ time_step = 0.002, duration = 0.2, model = \"kirchhoff\" }}\n{rest}\n\
         [body]\nshape = \"ellipsoid\"\nsemi_axes = [0.01, 0.01, 0.01]\ntriangles = 80\n{body}\n"
    );
    Prepared::new(Scene::parse("ball", "ball.toml", &text).unwrap(), None, &()).unwrap()
}

const LEAD: &str = "density = 11300.0";

fn draws(rest: &str, runs: u32) -> Vec<Draw> {
    let ball = ball("water", LEAD, rest);
    (0..runs)
        .map(|run| draw(ball.scene(), ball.body().mass, run))
        .collect()
}

/// Mean and standard deviation.
fn moments(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n;
    [mean, variance.sqrt()]
}

#[test]
fn each_quantity_is_spread_as_it_says() {
    let all = draws(
        r#"
        [scatter]
        height = { uniform = [1.0, 3.0] }
        tilt = { uniform = [0, 90] }
        heading = [0, 90, 180, 270]
        velocity = { normal = [[1.0, 0.0, 0.0], [0.1, 0.2, 0.3]] }
        spin = { uniform = [[0, 0, 0], [0, 6, 0]] }
        size = 0.1
        mass = { normal = [0.05, 0.005] }
        fluid = ["air", "water", "water"]
        wind = { uniform = [-1.0, 1.0] }
        "#,
        4000,
    );
    // Means and deviations within five of their standard errors, those of a normal distribution.
    let holds = |what: &str, value: &dyn Fn(&Draw) -> f64, wanted: [f64; 2]| {
        let values: Vec<f64> = all.iter().map(value).collect();
        let [mean, deviation] = moments(&values);
        let within = 5.0 * wanted[1] / (all.len() as f64).sqrt();
        assert!((mean - wanted[0]).abs() <= within, "{what}: mean {mean}");
        assert!(
            (deviation - wanted[1]).abs() <= within,
            "{what}: {deviation}"
        );
    };
    let flat = |least: f64, most: f64| [0.5 * (least + most), (most - least) / 12f64.sqrt()];
    let change = |draw: &Draw| draw.change.unwrap();
    holds("height", &|d| d.release.position[1], flat(1.0, 3.0));
    holds("tilt", &|d| d.tilt, flat(0.0, 90.0));
    holds("heading", &|d| d.heading, [135.0, 90.0 * 1.25f64.sqrt()]);
    for (i, wanted) in [[1.0, 0.1], [0.0, 0.2], [0.0, 0.3]].into_iter().enumerate() {
        holds("velocity", &|d| d.release.world_velocity()[i], wanted);
    }
    holds(
        "spin",
        &|d| d.release.world_angular_velocity()[1],
        flat(0.0, 6.0),
    );
    let about_x = |d: &Draw| d.release.world_angular_velocity()[0];
    assert!(all.iter().all(|d| about_x(d).abs() < 1e-12));
    holds("size", &|d| change(d).size.unwrap(), [1.0, 0.1]);
    holds("mass", &|d| change(d).mass.unwrap(), [0.05, 0.005]);
    for i in 0..3 {
        holds("wind", &|d| change(d).wind.unwrap()[i], flat(-1.0, 1.0));
    }
    let in_water = |d: &Draw| f64::from(u8::from(change(d).density.unwrap() > 100.0));
    holds("water", &in_water, [2.0 / 3.0, 2f64.sqrt() / 3.0]);
    // A fluid is drawn as a whole, and quantities do not follow each other.
    assert!(
        all.iter()
            .all(|d| (change(d).density > Some(100.0)) == (change(d).viscosity < Some(5e-6)))
    );
    let both = |d: &Draw| (d.tilt - 45.0) * (d.release.position[1] - 2.0);
    holds(
        "tilt with height",
        &both,
        [0.0, flat(0.0, 90.0)[1] * flat(0.0, 2.0)[1]],
    );
}

#[test]
fn a_turned_body_tilts_and_then_heads() {
    let one = draws("scatter = { tilt = [30.0], heading = [90.0] }", 1)[0];
    // The body's up leans to -x by the turn about z, and to z by the turn about the vertical.
    let up = rotate(one.release.orientation, [0.0, 1.0, 0.0]);
    let wanted = [0.0, 0.75f64.sqrt(), 0.5];
    assert!((0..3).all(|i| (up[i] - wanted[i]).abs() < 1e-12), "{up:?}");
    assert_eq!((one.tilt, one.heading), (30.0, 90.0));
}

#[test]
fn what_cannot_be_is_drawn_again() {
    let mass = |d: &Draw| d.change.unwrap().mass.unwrap();
    let all = draws("scatter.mass = { normal = [0.01, 0.1] }", 2000);
    assert!(all.iter().all(|d| mass(d) >= 0.0));
    // The upper part of a normal distribution, cut a tenth of a deviation below its mean (Johnson and Kotz 1970).
    let cut = -0.1f64;
    let density = (-0.5 * cut * cut).exp() / std::f64::consts::TAU.sqrt();
    let wanted = 0.01 + 0.1 * density / uniform(-cut);
    let [mean, deviation] = moments(&all.iter().map(mass).collect::<Vec<_>>());
    assert!(
        (mean - wanted).abs() < 5.0 * deviation / 2000f64.sqrt(),
        "{mean} {wanted}"
    );
}

/// The fall of the only run.
fn fall(prepared: &Prepared) -> Fall {
    run(prepared, 0..1, &()).remove(0)
}

#[test]
fn a_drawn_body_falls_like_one_that_the_scene_states() {
    let close = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-9);
    let mass = format!("density = {}", 11300.0 * 1.5);
    let stated = fall(&ball("water", &mass, ""));
    let heavier = ball("water", LEAD, "");
    let drawn = format!("scatter.mass = [{}]", 1.5 * heavier.body().mass);
    let drawn = fall(&ball("water", LEAD, &drawn));
    assert!(close(stated.end, drawn.end), "{stated:?}\n{drawn:?}");
    assert!(stated.end[1] > 0.1);

    // All balls of one density fall alike, whatever their size: added mass is a share of the displaced fluid.
    let small = fall(&ball("water", LEAD, "scatter.size = [0.25]"));
    assert!(close(small.end, fall(&ball("water", LEAD, "")).end));

    let other = ball("water", LEAD, "scatter.fluid = [\"air\"]");
    assert!(close(fall(&other).end, fall(&ball("air", LEAD, "")).end));

    // Kirchhoff's equations are the same in a fluid that moves: the body is left behind.
    let wind = fall(&ball("water", LEAD, "scatter.wind = [[1.0, 0.0, 0.0]]"));
    let stated = ball("water", LEAD, "").scene().clone();
    let mut blown = stated.clone();
    blown.fluid.velocity = [1.0, 0.0, 0.0];
    let blown = Prepared::new(blown, None, &()).unwrap();
    assert!(close(wind.end, fall(&blown).end));
}

#[test]
fn the_same_run_has_the_same_bits_beside_any_other() {
    let ball = ball(
        "water",
        LEAD,
        "scatter = { size = [0.5, 1.0], velocity = 0.1, height = 0.1 }",
    );
    let all = run(&ball, 0..40, &());
    for number in [0, 7, 39] {
        assert_eq!(
            run(&ball, number..number + 1, &()),
            [all[number as usize].clone()]
        );
    }
    let sizes = all.iter().map(|fall| fall.draw.change.unwrap().size);
    assert!(sizes.clone().any(|s| s == Some(0.5)) && sizes.clone().any(|s| s == Some(1.0)));
}

#[test]
fn a_body_that_cannot_be_is_refused() {
    let change = Change {
        mass: Some(f64::NAN),
        ..Change::default()
    };
    let error = ball("water", LEAD, "").changed(&change).unwrap_err();
    assert!(error.to_string().contains("mass"), "{error}");
}
