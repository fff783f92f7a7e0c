//! Cards fall onto the ground by three contact layers: the library's own, Rapier's and Avian's. Prints a table of how they
//! land, beside that of the own layer in finer steps.

mod avian;
mod cards;
mod measures;
mod own;
mod rapier;
mod table;

use std::error::Error;

use bevy_langevin_rigid::langevin_rigid::{State, Stepper};

use cards::{DT, Way};
use measures::Watch;
use table::Layer;

/// Steps of a card in the air at most, and of one that is watched from when it touches: ten seconds each.
const FALL: usize = 640;
const WATCHED: usize = 640;
/// Steps of the references in one of the others: a quarter of the step is not yet near enough to none.
const REFERENCES: [(&str, usize); 2] = [("own, 1/1024 s", 16), ("own, 1/256 s", 4)];

fn main() -> Result<(), Box<dyn Error>> {
    let card = cards::stepper()?;
    let steps = FALL + WATCHED;
    let rapier = rapier::ways(&card, steps)?;
    // Rapier's single precision rounds where they begin; all begin there.
    let starts: Vec<State> = rapier.iter().map(|way| way[0]).collect();
    let avian = avian::ways(&starts, steps)?;
    let own = own::ways(&card, &starts, DT, steps)?;
    let free = cards::free_ways(&card, &starts, DT, FALL)?;

    let watch = Watch {
        card: &card,
        dt: DT,
        every: 1,
        steps: WATCHED,
    };
    let own = Layer::new("own, 1/64 s", &watch, &own, &free)?;
    let rapier = Layer::new("Rapier, 1/64 s", &watch, &rapier, &free)?;
    let avian = Layer::new("Avian, 1/64 s", &watch, &avian, &free)?;
    let before = before_touch(&free, &[&own, &rapier, &avian]);
    let mut layers = Vec::new();
    for (name, finer) in REFERENCES {
        layers.push(reference(name, &card, &before, finer)?);
    }
    layers.extend([own, rapier, avian]);
    print!("{}", table::table(&layers));
    Ok(())
}

/// Each card in the last state before it touches the ground in any layer.
fn before_touch(free: &[Way], layers: &[&Layer]) -> Vec<State> {
    let before = |(number, way): (usize, &Way)| {
        let touches = layers.iter().map(|layer| layer.landings[number].touch);
        way[touches.min().map_or(0, |touch| touch - 1)]
    };
    free.iter().enumerate().map(before).collect()
}

/// The own layer from there, in steps that are so many times as fine.
fn reference(
    name: &'static str,
    card: &Stepper,
    before: &[State],
    finer: usize,
) -> Result<Layer, Box<dyn Error>> {
    let watch = Watch {
        card,
        dt: DT / finer as f64,
        every: finer,
        steps: finer * WATCHED,
    };
    // What grazes the ground in coarse steps may miss it in fine ones, and touch it a little later.
    let fall = FALL / 10;
    let ways = own::ways(card, before, watch.dt, finer * (fall + WATCHED))?;
    let free = cards::free_ways(card, before, watch.dt, finer * fall)?;
    Layer::new(name, &watch, &ways, &free)
}
