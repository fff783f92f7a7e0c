//! The report as lines for people.

use std::fmt::Write as _;

use langevin_rigid_bake::added_mass::SMALL_THICKNESS;

use super::Report;

impl Report {
    pub(in crate::check) fn table(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let mut line = |name: &str, value: String| {
            let _ = writeln!(out, "{name:<16}{value}");
        };
        line("file", self.file.clone());
        line(
            "triangles",
            format!("{} over {} vertices", self.triangles, self.vertices),
        );
        line(
            "box",
            format!("{} m in the unit `{}`", box_of(self.size), self.unit),
        );
        if let Some(hint) = &self.unit_hint {
            line(
                "",
                "which is no likely size of a body in air or water".into(),
            );
            for (unit, size) in [
                ("m", self.size_if_m),
                ("cm", self.size_if_cm),
                ("mm", self.size_if_mm),
                ("um", self.size_if_um),
                ("in", self.size_if_in),
                ("ft", self.size_if_ft),
            ] {
                line("", format!("{} m if it is in `{unit}`", box_of(size)));
            }
            line("", hint.clone());
        }
        line("area", format!("{:.6e} m^2", self.area));
        line(
            "volume",
            match self.volume {
                Some(volume) => format!("{volume:.6e} m^3"),
                None => "has no meaning while the surface is not closed or meets itself".into(),
            },
        );
        self.faults(&mut line);
        self.parts(&mut line);
        self.outlook(&mut line);
        self.verdict(&mut line);
        out
    }

    fn faults(&self, line: &mut impl FnMut(&str, String)) {
        line("holes", self.holes.to_string());
        for hole in &self.largest_holes {
            line("", hole.text.clone());
        }
        for finding in &self.findings {
            line(finding.name, finding.words.clone());
        }
    }

    fn parts(&self, line: &mut impl FnMut(&str, String)) {
        line("components", self.components.to_string());
        if self.components < 2 {
            return;
        }
        for (place, part) in self.largest_components.iter().enumerate() {
            let volume = match part.volume {
                Some(volume) => format!("{volume:.4e} m^3"),
                None => "open".into(),
            };
            let role = if part.cavity { "a cavity" } else { "a part" };
            let inside = part
                .inside
                .map(|k| format!(", {role} inside component {}", k + 1));
            let (n, inside) = (part.triangles, inside.unwrap_or_default());
            line(
                "",
                format!("{}: {n} triangles, {volume}{inside}", place + 1),
            );
        }
        let more = self.components - self.largest_components.len();
        if more > 0 {
            line("", format!("and {more} of less surface"));
        }
    }

    fn outlook(&self, line: &mut impl FnMut(&str, String)) {
        let Some(expected) = &self.expected else {
            return;
        };
        if let (Some(wall), Some(ratio), Some(at)) = (
            expected.thinnest_wall,
            expected.thinnest_wall_over_edge,
            expected.thinnest_wall_at,
        ) {
            let warning = if ratio < SMALL_THICKNESS {
                ", too thin for them"
            } else {
                ""
            };
            line(
                "thin parts",
                format!(
                    "{wall:.2e} m at {}, {ratio:.2} of its triangles' edges{warning}",
                    point(at)
                ),
            );
        } else {
            line(
                "thin parts",
                "none thinner than its triangles are long".into(),
            );
        }
        let when = if self.ready { "" } else { ", once repaired" };
        line(
            "added-mass",
            format!(
                "about {:.1} s for an error of about {:.2} % on {} triangles{when}",
                expected.seconds,
                100.0 * expected.error_estimate,
                expected.triangles_solved
            ),
        );
    }

    fn verdict(&self, line: &mut impl FnMut(&str, String)) {
        if self.ready {
            line("verdict", "ready".into());
            return;
        }
        line("verdict", "not ready".into());
        line("at first sight", self.fault.clone().unwrap_or_default());
        if let Some(command) = &self.repair {
            line("repair", command.clone());
            for step in &self.repair_steps {
                line("", step.text().to_owned());
            }
            if let Some(balance) = &self.repair_balance {
                line("", balance.text().to_owned());
            }
            for warning in &self.repair_warnings {
                line("", format!("warning: {warning}"));
            }
        }
        if let Some(command) = &self.repair_of_sheet {
            line("or, as a sheet", command.clone());
        }
        if let Some(left) = &self.left {
            line("left to do", left.clone());
        }
    }
}

fn point([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4}, {y:.4}, {z:.4}) m")
}

fn box_of([x, y, z]: [f64; 3]) -> String {
    format!("{x:.4} x {y:.4} x {z:.4}")
}
