//! The `langevin-rigid` command.

mod added_mass;
mod arguments;
mod bake;
mod bars;
mod bench;
mod cache;
mod check;
mod crowd;
mod direct;
mod ensemble;
mod export;
mod forecast;
mod meshes;
mod pictures;
mod recorded_run;
mod regimes;
mod repair;
mod reproduce;
mod say;
mod scenes;
mod signals;
mod simulate;
mod size;
mod turbulence;
mod view;

use std::process::ExitCode;

use clap::Parser;

use arguments::{Arguments, Command};
use bars::Bars;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let bars = Bars::new();
    let done = match &arguments.command {
        Command::Simulate(options) => simulate::simulate(options, &bars),
        Command::Export(options) => export::export(options, &bars),
        Command::Ensemble(options) => ensemble::ensemble(options, &bars),
        Command::Direct(options) => direct::direct(options, &bars),
        Command::Regimes(options) => regimes::regimes(options, &bars),
        Command::AddedMass(options) => added_mass::added_mass(options, &bars),
        Command::Check(options) => match check::check(options, &bars) {
            Ok(false) => return ExitCode::FAILURE,
            checked => checked.map(|_| ()),
        },
        Command::Repair(options) => repair::repair(options, &bars),
        Command::Turbulence(options) => turbulence::turbulence(options, &bars),
        Command::Bake(options) => bake::bake(options, &bars),
        Command::Bench(options) => bench::bench(options, &bars),
        Command::Crowd(options) => crowd::crowd(options, &bars),
        Command::Reproduce(options) => reproduce::reproduce(options, &bars),
        Command::View(options) => view::view(options, &bars),
        Command::Scenes => scenes::scenes(),
    };
    bars.clear();
    match done {
        Ok(()) if bars.interrupted() => ExitCode::from(bars.exit_code()),
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(_) if bars.interrupted() => {
            say::aside("interrupted before there was a result; nothing was written");
            ExitCode::from(bars.exit_code())
        }
        Err(error) => {
            say::error(format!("{error:#}"));
            ExitCode::FAILURE
        }
    }
}

/// Whoever read our output has seen enough.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .downcast_ref::<std::io::Error>()
        .is_some_and(|e| e.kind() == std::io::ErrorKind::BrokenPipe)
}
