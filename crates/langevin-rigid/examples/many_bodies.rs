//! Confetti: a thousand discs step together, on all cores, each in the wind at its place.

use std::thread;

use langevin_rigid::{Batch, Body, Flow, Fluid, Input, Pack, Settings, State, Stepper};

const BODIES: u32 = 1000;
const STEPS: u32 = 180;
const DT: f64 = 1.0 / 60.0;

/// A wind along x that grows with height, from nothing at the ground.
fn wind(_: u32, state: &State) -> Input {
    let mut flow = Flow::uniform([0.3 * state.position[1], 0.0, 0.0]);
    flow.gradient[0][1] = 0.3;
    Input {
        flow,
        ..Input::default()
    }
}

/// All of them let go at 5 m, edge on to broadside in turn; the noise of each is its own.
fn thrown() -> Batch {
    let mut batch = Batch::new(7);
    for body in 0..BODIES {
        let half_angle = f64::from(body) / f64::from(BODIES);
        batch.push(&State {
            position: [0.0, 5.0, 0.0],
            orientation: [half_angle.sin(), 0.0, 0.0, half_angle.cos()],
            ..State::default()
        });
    }
    batch
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 1 cm wide, of paper.
    let disc = Body::disc(0.005, 0.1e-3, 800.0)?;
    let stepper = Stepper::new(&disc, &Fluid::AIR, None, &Settings::default())?;

    // A pack is a few bodies that step in SIMD lanes; each thread has its share of packs.
    let mut batch = thrown();
    let threads = thread::available_parallelism()?.get();
    let share = batch.packs_mut().len().div_ceil(threads);
    thread::scope(|scope| {
        let step = |packs: &mut [Pack]| stepper.step_packs_with(packs, DT, wind);
        let at_work: Vec<_> = batch
            .packs_mut()
            .chunks_mut(share)
            .map(|packs| scope.spawn(move || (0..STEPS).try_for_each(|_| step(packs))))
            .collect();
        at_work
            .into_iter()
            .try_for_each(|thread| thread.join().expect("a step does not panic"))
    })?;

    // On one thread every body has the same bits.
    let mut alone = thrown();
    for _ in 0..STEPS {
        stepper.step_batch_with(&mut alone, DT, wind)?;
    }
    assert!(batch == alone);

    let seconds = f64::from(STEPS) * DT;
    println!("{BODIES} discs after {seconds} s, by height:");
    let states: Vec<State> = (0..batch.len()).filter_map(|i| batch.state(i)).collect();
    for decimetres in (0..50).rev() {
        let here = |state: &&State| (state.position[1] * 10.0).floor() == f64::from(decimetres);
        let count = states.iter().filter(here).count();
        if count > 0 {
            let height = f64::from(decimetres) / 10.0;
            let bar = "#".repeat(count.div_ceil(10));
            println!("{height:4.1} m {count:4} {bar}");
        }
    }
    Ok(())
}
