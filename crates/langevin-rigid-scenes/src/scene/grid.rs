//! The grid that the turbulence history is computed on.

use langevin_rigid_bake::turbulence::{FlowOptions, MacGrid, Sampling};
use serde_spanned::Spanned;

use super::Grid;
use super::place::{Document, SceneError};
use super::quantity::{DURATION, INFLOW, SIZE, TIME_STEP};
use super::raw::{RawTurbulence, given};

impl Default for Grid {
    /// The grid of the paper's Fig. 2.
    fn default() -> Self {
        Self {
            cells: FlowOptions::PAPER_CELLS,
            cell: None,
            inflow_speed: None,
            time_step: None,
            duration: None,
            sampling: Sampling::Fixed,
        }
    }
}

pub(super) fn resolve(doc: &Document, raw: &RawTurbulence) -> Result<Grid, SceneError> {
    let grid = Grid {
        cells: match &raw.cells {
            Some(wanted) => cells(doc, wanted)?,
            None => FlowOptions::PAPER_CELLS,
        },
        cell: doc.given(&raw.cell, "cell", SIZE)?,
        inflow_speed: doc.given(&raw.inflow_speed, "inflow_speed", INFLOW)?,
        time_step: doc.given(&raw.time_step, "time_step", TIME_STEP)?,
        duration: doc.given(&raw.duration, "duration", DURATION)?,
        sampling: sampling(doc, raw)?,
    };
    if let (Some(step), Some(duration), Some(at)) = (grid.time_step, grid.duration, &raw.time_step)
        && duration / step >= FlowOptions::MAX_ENTRIES as f64
    {
        let message = format!(
            "a `time_step` of {step:e} s in a `duration` of {duration:e} s makes {:.3e} entries of \
             turbulence history, and {:e} are possible: lengthen the step or shorten the duration",
            duration / step,
            FlowOptions::MAX_ENTRIES as f64
        );
        return Err(doc.error(at.span(), message));
    }
    Ok(grid)
}

fn cells(doc: &Document, wanted: &Spanned<Vec<i64>>) -> Result<[usize; 3], SceneError> {
    let numbers: [i64; 3] = doc.array(wanted, "cells")?;
    if numbers.iter().any(|n| *n < 1) {
        let message = "`cells` must be three positive whole numbers";
        return Err(doc.error(wanted.span(), message));
    }
    let cells = numbers.map(|n| usize::try_from(n).unwrap_or(usize::MAX));
    match MacGrid::bytes(cells) {
        Some(bytes) if bytes <= MacGrid::MAX_BYTES => Ok(cells),
        bytes => {
            let gigabytes = bytes.map_or(f64::INFINITY, |b| b as f64 / 1e9);
            let message = format!(
                "`cells` of {} x {} x {} take {gigabytes:.1} GB of memory, and {:.1} GB are possible: \
                 use fewer",
                cells[0],
                cells[1],
                cells[2],
                MacGrid::MAX_BYTES as f64 / 1e9
            );
            Err(doc.error(wanted.span(), message))
        }
    }
}

fn sampling(doc: &Document, raw: &RawTurbulence) -> Result<Sampling, SceneError> {
    let Some(name) = &raw.sampling else {
        return Ok(Sampling::Fixed);
    };
    let choices = [
        ("fixed", Sampling::Fixed),
        ("passive-particle", Sampling::PassiveParticle),
    ];
    doc.choose("`sampling`", name, choices)
}

/// The section of a resolved scene.
pub(super) fn write(grid: &Grid, length: Option<f64>) -> RawTurbulence {
    let sampling = match grid.sampling {
        Sampling::Fixed => "fixed",
        Sampling::PassiveParticle => "passive-particle",
    };
    RawTurbulence {
        length: length.and_then(given),
        cells: given(grid.cells.map(|n| n as i64).to_vec()),
        cell: grid.cell.and_then(given),
        inflow_speed: grid.inflow_speed.and_then(given),
        time_step: grid.time_step.and_then(given),
        duration: grid.duration.and_then(given),
        sampling: given(sampling.to_owned()),
    }
}
