//! Programs in C and C++ over the header and the built libraries: what they print has the bits of the same calls in Rust.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use langevin_rigid::wind::{GustSettings, Gusts, Jet, Profile, Shear, Vortex, Wind, WindField};
use langevin_rigid::{
    Bake, Body, Fluid, Input, Model, NoiseStream, Settings, State, Stepper, TurbulenceHistory,
    TurbulenceSource,
};

const HERE: &str = env!("CARGO_MANIFEST_DIR");
const ARCHIVE: &str = "liblangevin_rigid_c.a";

/// The folder where cargo has put the libraries: that of this test, or the one above it.
fn libraries() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let beside = test.parent().unwrap();
    let folders = [beside, beside.parent().unwrap()];
    let found = folders
        .iter()
        .find(|folder| folder.join(ARCHIVE).exists() && folder.join(shared()).exists());
    found
        .unwrap_or_else(|| panic!("{} and {} are in none of {folders:?}", ARCHIVE, shared()))
        .to_path_buf()
}

fn shared() -> String {
    use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
    format!("{DLL_PREFIX}langevin_rigid_c{DLL_SUFFIX}")
}

/// How a program gets the library.
#[derive(Clone, Copy)]
enum Link {
    Static,
    Shared,
}

/// Compiles a program of one source file, links it and runs it: what it prints. None if there is no compiler.
fn run(source: &str, link: Link, arguments: &[&Path]) -> Option<String> {
    let mut command = common::compiler("CC", "cc")?;
    let libraries = libraries();
    let name = Path::new(source).file_stem().unwrap().to_str().unwrap();
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(match link {
        Link::Static => format!("{name}-static"),
        Link::Shared => format!("{name}-shared"),
    });
    command
        .args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"])
        .arg("-I")
        .arg(Path::new(HERE).join("include"))
        .arg(Path::new(HERE).join(source));
    match link {
        Link::Static => command.arg(libraries.join(ARCHIVE)),
        Link::Shared => command
            .arg(libraries.join(shared()))
            .arg(format!("-Wl,-rpath,{}", libraries.display())),
    };
    // What Rust's standard library wants of the system.
    command.args(["-lm", "-lpthread", "-ldl"]);
    let compiled = command.arg("-o").arg(&program).output().unwrap();
    let said = String::from_utf8_lossy(&compiled.stderr);
    assert!(
        compiled.status.success(),
        "{source} is not compiled:\n{said}"
    );

    let output = Command::new(program).args(arguments).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{source} fails:\n{said}");
    Some(String::from_utf8(output.stdout).unwrap())
}

/// The lines of a program against ours. A number is compared by its bits, anything else by its letters.
fn assert_same(printed: &str, ours: &str) {
    assert_eq!(printed.lines().count(), ours.lines().count(), "{printed}");
    for (printed, ours) in printed.lines().zip(ours.lines()) {
        let bits = |line: &str| -> Vec<Result<u64, String>> {
            let words = line.split(' ');
            words
                .map(|word| {
                    word.parse::<f64>()
                        .map(f64::to_bits)
                        .map_err(|_| word.into())
                })
                .collect()
        };
        assert_eq!(bits(printed), bits(ours), "`{printed}` is not `{ours}`");
    }
}

fn line(out: &mut String, name: &str, numbers: &[f64]) {
    out.push_str(name);
    for (index, x) in numbers.iter().enumerate() {
        let space = if index == 0 && name.is_empty() {
            ""
        } else {
            " "
        };
        write!(out, "{space}{x}").unwrap();
    }
    out.push('\n');
}

/// What `examples/fall.c` does.
fn fall() -> String {
    let leaf = Body::plate(0.08, 0.05, 0.2e-3, 450.0).unwrap();
    let stepper = Stepper::new(&leaf, &Fluid::AIR, None, &Settings::default()).unwrap();
    let mut wind = Wind::default();
    let mean = [1.0, 0.0, 0.0];
    wind.add(WindField::Uniform(mean)).unwrap();
    let gusts = GustSettings {
        rms: 0.3,
        length: 0.5,
        carried: mean,
        seed: 7,
        ..GustSettings::default()
    };
    wind.add(Gusts::new(&gusts).unwrap()).unwrap();

    let mut state = State::default();
    state.position[1] = 5.0;
    state.set_world_velocities([0.5, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let mut input = Input::with_noise(NoiseStream { seed: 1, body: 0 });
    input.wrench.force[1] = 1e-3;
    let mut out = String::new();
    for step in 1..=180 {
        input.flow = wind.flow(state.position, state.time, [0.0; 3]);
        stepper.step(&mut state, 1.0 / 60.0, &input).unwrap();
        if step % 30 == 0 {
            line(&mut out, "time", &[state.time]);
            line(&mut out, "position", &state.position);
            line(&mut out, "velocity", &state.world_velocity());
        }
    }
    let loads = stepper.loads(&state, &input);
    line(&mut out, "weight", &loads.weight.force);
    line(&mut out, "buoyancy", &loads.buoyancy.force);
    line(&mut out, "drag", &loads.drag.force);
    line(&mut out, "normal force", &loads.normal_force.force);
    line(&mut out, "rotational lift", &loads.rotational_lift.force);
    line(&mut out, "friction", &loads.friction.force);
    line(
        &mut out,
        "fluid acceleration",
        &loads.fluid_acceleration.force,
    );
    line(&mut out, "outside", &loads.outside.force);
    line(
        &mut out,
        "couple of the added mass",
        &loads.added_mass.torque,
    );
    line(&mut out, "lost couple", &loads.lost_couple.torque);
    line(&mut out, "damping", &loads.damping.torque);
    line(&mut out, "sum of the torques", &loads.sum().torque);
    line(&mut out, "longest step", &[stepper.longest_step(&state)]);
    out
}

#[test]
fn the_example_has_the_bits_of_rust() {
    for link in [Link::Static, Link::Shared] {
        if let Some(printed) = run("examples/fall.c", link, &[]) {
            assert_same(&printed, &fall());
        }
    }
}

fn bake() -> Bake {
    Bake {
        body: Body::cuboid([0.1, 0.01, 0.05], 300.0).unwrap(),
        history: Some(TurbulenceHistory {
            interval: 0.1,
            inflow_speed: 1.0,
            length: 0.02,
            k: vec![0.02, 0.01, 0.005],
            epsilon: vec![0.1, 0.05, 0.02],
        }),
        error_estimate: 1e-3,
        warnings: vec![],
        fingerprint: [0; 32],
    }
}

/// What `tests/c/calls.c` prints.
fn calls(bake: &Bake) -> String {
    let mut out = format!("{}\n", langevin_rigid::VERSION);
    let mut tell = |state: &State| {
        let ([x, y, z], [u, v, w]) = (state.position, state.velocity);
        line(
            &mut out,
            "",
            &[state.time, x, y, z, u, v, w, state.fluctuation[5]],
        );
    };
    let settings = Settings {
        model: Model::Consistent,
        turbulence: TurbulenceSource::History,
        ..Settings::default()
    };
    let steppers = [(settings, 0), (Settings::default(), 4)];
    for (settings, body) in steppers {
        let stepper =
            Stepper::new(&bake.body, &Fluid::AIR, bake.history.as_ref(), &settings).unwrap();
        let mut state = State::default();
        for _ in 0..50 {
            stepper
                .step(&mut state, 0.01, &NoiseStream { seed: 0, body }.into())
                .unwrap();
        }
        tell(&state);
    }

    let (x, y) = ([2.0, 0.0, 0.0], [0.0, 3.0, 0.0]);
    let mut wind = Wind::default();
    wind.add(WindField::Uniform(x)).unwrap();
    for profile in [
        Profile::Power { exponent: 0.2 },
        Profile::Log { roughness: 0.03 },
    ] {
        wind.add(Shear {
            velocity: x,
            height: 10.0,
            ground: 0.0,
            profile,
        })
        .unwrap();
    }
    let gusts = GustSettings {
        rms: 0.4,
        length: 2.0,
        smallest: Some(0.1),
        carried: x,
        seed: 5,
    };
    wind.add(Gusts::new(&gusts).unwrap()).unwrap();
    wind.add(Vortex {
        centre: [0.0; 3],
        axis: y,
        circulation: 3.0,
        core: 0.5,
    })
    .unwrap();
    wind.add(Jet {
        centre: [0.0; 3],
        axis: x,
        speed: 4.0,
        diameter: 0.6,
    })
    .unwrap();
    let flow = wind.flow([1.0, 2.0, 3.0], 0.5, x);
    let ([u, v, w], [a, _, c]) = (flow.velocity, flow.acceleration);
    line(
        &mut out,
        "",
        &[u, v, w, flow.gradient[0][1], flow.gradient[2][0], a, c],
    );
    out
}

#[test]
fn every_call_refuses_what_it_must() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [baked, missing, foreign] =
        ["block.bake", "there-is-no.bake", "foreign.bake"].map(|name| folder.join(name));
    let bake = bake();
    std::fs::write(&baked, bake.to_bytes()).unwrap();
    std::fs::write(&foreign, "a text").unwrap();
    for link in [Link::Static, Link::Shared] {
        let paths = [baked.as_path(), &missing, &foreign];
        if let Some(printed) = run("tests/c/calls.c", link, &paths) {
            assert_same(&printed, &calls(&bake));
        }
    }
}

#[test]
fn the_header_is_one_of_cpp_too() {
    let Some(mut command) = common::compiler("CXX", "c++") else {
        return;
    };
    let header = Path::new(HERE).join("include/langevin_rigid.h");
    let flags = [
        "-x",
        "c++",
        "-std=c++11",
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Werror",
        "-fsyntax-only",
    ];
    let compiled = command.args(flags).arg(header).output().unwrap();
    let said = String::from_utf8_lossy(&compiled.stderr);
    assert!(compiled.status.success(), "{said}");
}
