//! A table for people.

use std::fmt::Write as _;

use super::statement::{Statement, point};
use super::{Proxy, Report};

const NAMES: [&str; 6] = ["x", "y", "z", "rot x", "rot y", "rot z"];

/// The report as lines of names and values, and the tensor under them.
pub fn table(report: &Report) -> String {
    let stated = Statement::new(report);
    let solved = match report.triangles_solved {
        n if n == report.triangles => String::new(),
        n => format!(" (solved on {n})"),
    };
    let mut out = line("triangles", &format!("{}{solved}", report.triangles));
    if let Some(proxy) = &report.proxy {
        out += &line("proxy", &stand_in(proxy));
    }
    out += &line("volume", &format!("{:.6e} m^3", report.volume));
    out += &line("centroid", &point(report.centroid));
    out += &line("fluid", &stated.fluid);
    out += &line("axes", &stated.axes);
    out += &line("about", &stated.reference_point);
    out += &line("sign", &stated.sign);
    out += &line(
        "error estimate",
        &format!("{:.2} %", 100.0 * report.error_estimate),
    );
    out += &line("time", &format!("{:.3} s", report.seconds));
    out + "\nadded mass (kg, kg m, kg m^2; force per acceleration, linear first)\n"
        + &tensor(report)
}

fn line(name: &str, value: &str) -> String {
    format!("{name:<16}{value}\n")
}

fn stand_in(proxy: &Proxy) -> String {
    let Proxy {
        triangles,
        deviation,
        error_estimate,
    } = proxy;
    let cost = 100.0 * error_estimate;
    format!("{triangles} triangles, {deviation:.2e} m away, which may cost {cost:.2} %")
}

fn tensor(report: &Report) -> String {
    let mut out = format!("{:11}", "");
    // Writing to a string cannot fail.
    for name in NAMES {
        let _ = write!(out, "{name:>15}");
    }
    for (name, row) in NAMES.iter().zip(&report.added_mass) {
        let _ = write!(out, "\n{name:>11}");
        for entry in row {
            let _ = write!(out, "{entry:>15.6e}");
        }
    }
    out + "\n"
}
