//! Fig. 2: the turbulence over the steps of Algorithm 1.

use std::fmt::Write;

use langevin_rigid::turbulence::{Turbulence, TurbulenceHistory};
use langevin_rigid::{Body, Fluid};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::turbulence::{FlowOptions, Sampling, decayed, turbulence_history};

use crate::chart::{Chart, Curve};
use crate::error::ReportError;
use crate::options::Options;
use crate::paper;
use crate::runs::Setting;
use crate::section::{Section, figure};

/// Transits of the box that are computed: one to decay, one to see the plateau.
const TRANSITS: f64 = 2.0;

pub(crate) fn section(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let setting = Setting::new("paper-75", options, progress)?;
    let flow = flow(&setting.baked.bake.body, &setting.scene.fluid);
    let fixed = turbulence_history(&flow, progress)?;
    let particle = FlowOptions {
        sampling: Sampling::PassiveParticle,
        ..flow.clone()
    };
    let particle = turbulence_history(&particle, progress)?;
    let start = Turbulence::at_birth(flow.inflow_speed, flow.cell);
    let transit = 0.5 * flow.cells[1] as f64 * flow.cell / flow.inflow_speed;
    let plateau = decayed(start, transit);

    let mut section = Section::new("fig2", "Fig. 2: turbulence over the steps");
    section.paper(paper::FIG2_WORDS, "section 5");
    let [nx, ny, nz] = flow.cells;
    let re = section.quote("reynolds", paper::FIG2_REYNOLDS, 2);
    let speed = section.quote("inflow_speed", flow.inflow_speed, 3);
    let cell = section.quote("cell", flow.cell, 2);
    let step = section.quote("time_step", flow.time_step, 3);
    section.text(format!(
        "Re = {re} on a {nx}x{ny}x{nz} grid, as the caption says. It names neither body nor cell: here \
         the sheet of Fig. 3 in air, whose length makes that an inflow of {speed} m/s, cells of {cell} m \
         and steps of {step} s, in which the stream crosses a cell."
    ));
    let charts = [
        chart(
            "chi (1/s)",
            &flow,
            [&fixed, &particle],
            start,
            plateau,
            |t| t.frequency(),
        ),
        chart(
            "epsilon (m\u{b2}/s\u{b3})",
            &flow,
            [&fixed, &particle],
            start,
            plateau,
            |t| t.epsilon,
        ),
    ];
    section.row(&charts);
    table(&mut section, &flow, [&fixed, &particle], start, plateau);
    section.text(
        "The inflow is uniform, so there is no mean shear and no production: the turbulence decays by \
         the closed form, and at a point that stays with the body it settles, after the time that the \
         stream takes from the inflow to the body, to the plateau of what has decayed for that long. A \
         passive particle never sees the plateau.",
    );
    section.file("history.csv", csv(&fixed, &particle, start));
    Ok(section)
}

/// The stream whose Reynolds number with the body's length is the paper's.
fn flow(body: &Body, fluid: &Fluid) -> FlowOptions {
    let speed = paper::FIG2_REYNOLDS * fluid.viscosity / body.length;
    let mut flow = FlowOptions::new(paper::FIG2_CELLS, body.turbulence_length(), speed);
    flow.duration *= TRANSITS;
    flow
}

fn at(history: &TurbulenceHistory, i: usize) -> Turbulence {
    Turbulence {
        k: history.k[i],
        epsilon: history.epsilon[i],
    }
}

fn chart(
    name: &str,
    flow: &FlowOptions,
    [fixed, particle]: [&TurbulenceHistory; 2],
    start: Turbulence,
    plateau: Turbulence,
    value: fn(Turbulence) -> f64,
) -> String {
    let steps = fixed.k.len();
    let curve = |of: &dyn Fn(usize) -> Turbulence| -> Vec<[f64; 2]> {
        (0..steps).map(|i| [i as f64, value(of(i))]).collect()
    };
    let closed = |i: usize| decayed(start, i as f64 * flow.time_step);
    let curves = vec![
        Curve::new("fixed point", curve(&|i| at(fixed, i))),
        Curve::new("passive particle", curve(&|i| at(particle, i))),
        Curve::new("closed-form decay", curve(&closed)).dashed(),
        Curve::new("plateau", curve(&|_| plateau)).dashed(),
    ];
    figure(&Chart::new("step", name, curves).log(), "")
}

fn table(
    section: &mut Section,
    flow: &FlowOptions,
    [fixed, particle]: [&TurbulenceHistory; 2],
    start: Turbulence,
    plateau: Turbulence,
) {
    let last = fixed.k.len() - 1;
    let closed_end = decayed(start, last as f64 * flow.time_step);
    let mut rows = Vec::new();
    for (words, key, computed, closed) in [
        ("at the start, Eq. (18)", "start", at(fixed, 0), start),
        (
            "fixed point, last step; plateau",
            "plateau",
            at(fixed, last),
            plateau,
        ),
        (
            "passive particle, last step; decay",
            "particle",
            at(particle, last),
            closed_end,
        ),
    ] {
        let mut row = vec![words.to_owned()];
        for (name, a, b) in [
            ("chi", computed.frequency(), closed.frequency()),
            ("epsilon", computed.epsilon, closed.epsilon),
        ] {
            row.push(section.quote(format!("{key}.{name}"), a, 4).to_string());
            row.push(
                section
                    .quote(format!("{key}.{name}.closed_form"), b, 4)
                    .to_string(),
            );
        }
        rows.push(row);
    }
    let head = [
        "where",
        "chi (1/s)",
        "closed form",
        "epsilon (m\u{b2}/s\u{b3})",
        "closed form",
    ];
    section.table("turbulence", &head, &rows);
    let worst = (0..=last)
        .map(|i| (at(particle, i).k / decayed(start, i as f64 * flow.time_step).k - 1.0).abs())
        .fold(0.0, f64::max);
    let worst = section.quote("decay.worst", worst, 2);
    section.text(format!(
        "Largest relative difference of the passive particle's k from the closed form over all steps: \
         {worst}."
    ));
}

fn csv(fixed: &TurbulenceHistory, particle: &TurbulenceHistory, start: Turbulence) -> String {
    let mut table = String::from(
        "step,t,k_fixed,epsilon_fixed,chi_fixed,k_particle,epsilon_particle,chi_particle,chi_decay\n",
    );
    for i in 0..fixed.k.len() {
        let t = i as f64 * fixed.interval;
        let (f, p) = (at(fixed, i), at(particle, i));
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "{i},{t},{},{},{},{},{},{},{}",
            f.k,
            f.epsilon,
            f.frequency(),
            p.k,
            p.epsilon,
            p.frequency(),
            decayed(start, t).frequency()
        );
    }
    table
}
