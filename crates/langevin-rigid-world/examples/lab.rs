use langevin_rigid::linalg::quat_from_rotation_vector;
use langevin_rigid::linalg::vector::norm;
use langevin_rigid::{Body, Fluid, Model, NoiseStream, Settings, State, Stepper, TurbulenceSource};
use langevin_rigid_world::*;
use std::sync::Arc;
use std::time::Instant;
fn settings(model: Model) -> Settings {
    Settings {
        model,
        ..Settings::default()
    }
}
fn kind(body: &Body, model: Model, m: Material) -> Arc<Kind> {
    let stepper = Stepper::new(body, &Fluid::AIR, None, &settings(model)).unwrap();
    Arc::new(Kind::new(stepper, Shape::of_body(body).unwrap(), m).unwrap())
}
fn world() -> World {
    let mut w = World::new([0.0, -9.81, 0.0]);
    w.add_obstacle(Obstacle::half_space([0.0, 1.0, 0.0], 0.0, Material::default()).unwrap());
    w
}
fn main() {
    let what = std::env::args().nth(1).unwrap();
    let dt: f64 = std::env::args()
        .nth(2)
        .map_or(0.002, |s| s.parse().unwrap());
    match what.as_str() {
        "stack" => {
            let body = Body::plate(0.2, 0.14, 0.03, 700.0).unwrap();
            let k = kind(&body, Model::Kirchhoff, Material::default());
            let mut w = world();
            let n: u32 = std::env::args().nth(3).map_or(10, |s| s.parse().unwrap());
            let every: f64 = std::env::args().nth(4).map_or(0.5, |s| s.parse().unwrap());
            for i in 0..n {
                w.add(
                    k.clone(),
                    State {
                        position: [0.002 * (i % 3) as f64, 0.0151 + 0.0301 * i as f64, 0.0],
                        ..State::default()
                    },
                    NoiseStream { seed: 1, body: i },
                );
            }
            for step in 0..(10.0 / dt) as usize {
                w.step(dt).unwrap();
                if step % (every / dt) as usize == 0 {
                    let s = w.state(n as usize - 1);
                    println!(
                        "{:.2} y {:.6} x {:.6} v {:.2e} asleep {}",
                        w.time(),
                        s.position[1],
                        s.position[0],
                        norm(s.velocity) + 0.1 * norm(s.angular_velocity),
                        {
                            for i in 0..n as usize {
                                if !w.is_asleep(i) && w.time() > 3.0 {
                                    let s = w.state(i);
                                    print!(
                                        "[{i} {:.1e} {:.1e}] ",
                                        norm(s.velocity),
                                        norm(s.angular_velocity)
                                    );
                                }
                            }
                            (0..n as usize).filter(|i| w.is_asleep(*i)).count()
                        }
                    );
                }
            }
        }
        "coin" => {
            let body = Body::cylinder(0.0121, 0.0018, 7000.0).unwrap();
            let k = kind(
                &body,
                Model::Kirchhoff,
                Material {
                    friction: 0.5,
                    restitution: 0.0,
                },
            );
            println!(
                "half {:?} verts {}",
                body.half_extents,
                body.surface.vertices.len()
            );
            let mut w = world();
            let mut s = State {
                position: [0.0, 0.0135, 0.0],
                orientation: quat_from_rotation_vector([
                    std::f64::consts::FRAC_PI_2 - 0.15,
                    0.0,
                    0.0,
                ]),
                ..State::default()
            };
            s.set_world_velocities([0.0; 3], [0.0, 25.0, 0.0]);
            w.add(k, s, NoiseStream { seed: 1, body: 0 });
            for step in 0..(8.0 / dt) as usize {
                w.step(dt).unwrap();
                if step % (0.1 / dt) as usize == 0 {
                    let s = w.state(0);
                    let n = langevin_rigid::linalg::rotate(s.orientation, [0.0, 1.0, 0.0]);
                    let o = s.world_angular_velocity();
                    println!(
                        "{:.2} y {:.5} tilt {:.2} w {:.2} {:.2} asleep {}",
                        w.time(),
                        s.position[1],
                        n[1].acos().to_degrees(),
                        o[1],
                        (o[0] * o[0] + o[2] * o[2]).sqrt(),
                        w.is_asleep(0)
                    );
                }
            }
        }
        "heap" => {
            let n: u32 = std::env::args().nth(3).map_or(500, |s| s.parse().unwrap());
            let body = match std::env::args().nth(4).as_deref() {
                Some("plate") => Body::plate(0.08, 0.05, 0.001, 500.0).unwrap(),
                Some("disc") => Body::cylinder(0.03, 0.001, 500.0).unwrap(),
                _ => Body::ellipsoid([0.04, 0.0006, 0.025], 500.0).unwrap(),
            };
            let k = kind(
                &body,
                if std::env::args().nth(5).is_some() {
                    Model::Kirchhoff
                } else {
                    Model::Separated
                },
                Material {
                    friction: 0.5,
                    restitution: 0.1,
                },
            );
            let mut w = world();
            let started = Instant::now();
            let mut busy = 0.0;
            let mut next = 0u32;
            let mut step = 0usize;
            loop {
                while next < n && w.time() >= next as f64 * 0.02 {
                    let r = |k: u32| {
                        let x = (next as f64 * [0.754877, 0.569840, 0.3][k as usize]).fract();
                        x
                    };
                    w.add(
                        k.clone(),
                        State {
                            position: [0.5 * (r(0) - 0.5), 1.0, 0.5 * (r(1) - 0.5)],
                            orientation: quat_from_rotation_vector([
                                r(1) * 3.0,
                                r(2) * 6.0,
                                r(0) * 2.0,
                            ]),
                            ..State::default()
                        },
                        NoiseStream {
                            seed: 1,
                            body: next,
                        },
                    );
                    while w.overlap(next as usize).is_some() {
                        let mut s = *w.state(next as usize);
                        s.position[1] += 0.05;
                        w.set_state(next as usize, &s);
                    }
                    next += 1;
                }
                let t = Instant::now();
                w.step(dt).unwrap();
                busy += t.elapsed().as_secs_f64();
                step += 1;
                if std::env::var("WATCH").is_ok() {
                    if let Some(o) = (0..w.len())
                        .filter_map(|i| w.overlap(i))
                        .find(|o| o.depth > 2e-4)
                    {
                        let s = w.state(o.body);
                        println!(
                            "t {:.3} {o} v {:?} w {:?} q {:?}",
                            w.time(),
                            s.world_velocity(),
                            s.world_angular_velocity(),
                            s.orientation
                        );
                        if let Some(k) = o.other.strip_prefix("body ") {
                            let s = w.state(k.parse().unwrap());
                            println!(
                                "   {:?} {:?} {:?} asleep {}",
                                s.world_velocity(),
                                s.world_angular_velocity(),
                                s.orientation,
                                w.is_asleep(k.parse().unwrap())
                            );
                        }
                    }
                }
                if n == 1 && w.time() > 3.0 && w.time() < 3.06 {
                    let s = w.state(0);
                    let v = s.world_velocity();
                    let o = s.world_angular_velocity();
                    println!(
                        "t {:.3} y {:.6} v {:.5} {:.5} {:.5} w {:.4} {:.4} {:.4} f {:.2?}",
                        w.time(),
                        s.position[1],
                        v[0],
                        v[1],
                        v[2],
                        o[0],
                        o[1],
                        o[2],
                        s.fluctuation
                    );
                }
                if step % (1.0 / dt) as usize == 0 {
                    let top = (0..w.len())
                        .map(|i| w.state(i).position[1])
                        .filter(|y| *y < 0.5)
                        .fold(0.0, f64::max);
                    let asleep = (0..w.len()).filter(|i| w.is_asleep(*i)).count();
                    let worst = (0..w.len())
                        .filter_map(|i| w.overlap(i))
                        .map(|o| o.depth)
                        .fold(0.0, f64::max);
                    println!(
                        "{:.1} busy {:.2} (wall {:.1}) n {} asleep {} top {:.3} worst overlap {:.5} mm",
                        w.time(),
                        busy,
                        started.elapsed().as_secs_f64(),
                        w.len(),
                        asleep,
                        top,
                        1e3 * worst
                    );
                    busy = 0.0;
                    let mut v: Vec<f64> = (0..w.len())
                        .filter(|i| !w.is_asleep(*i) && w.state(*i).position[1] < 0.1)
                        .map(|i| {
                            norm(w.state(i).velocity) + 0.04 * norm(w.state(i).angular_velocity)
                        })
                        .collect();
                    v.sort_by(f64::total_cmp);
                    if v.len() > 0 {
                        println!(
                            "   speeds median {:.4} max {:.4} limit {:.4}",
                            v[v.len() / 2],
                            v[v.len() - 1],
                            (2e-4f64 * 9.81 * 0.04).sqrt()
                        );
                    }
                    if asleep == n as usize || w.time() > 7.0 {
                        break;
                    }
                }
            }
        }
        "lens" => {
            let model = std::env::args().nth(3).unwrap().parse::<Model>().unwrap();
            let body = Body::ellipsoid([0.04, 0.0006, 0.025], 500.0).unwrap();
            let k = kind(
                &body,
                model,
                Material {
                    friction: 0.5,
                    restitution: 0.0,
                },
            );
            let mut w = world();
            w.add(
                k.clone(),
                State {
                    position: [0.0, 0.003, 0.0],
                    orientation: quat_from_rotation_vector([0.05, 0.3, 0.02]),
                    ..State::default()
                },
                NoiseStream { seed: 1, body: 0 },
            );
            let mut step = 0;
            while w.time() < 6.0 {
                w.step(dt).unwrap();
                step += 1;
                if step % (0.5 / dt) as usize == 0 {
                    let s = w.state(0);
                    let e =
                        w.kind(0).stepper().kinetic_energy(s) + body.mass * 9.81 * s.position[1];
                    println!(
                        "{:.3} y {:.6} v {:.5} w {:.3} E {:.4e} asleep {}",
                        w.time(),
                        s.position[1],
                        norm(s.velocity),
                        norm(s.angular_velocity),
                        e / (body.mass * 9.81),
                        w.is_asleep(0)
                    );
                }
            }
        }
        _ => {}
    }
    let _ = TurbulenceSource::default();
}
