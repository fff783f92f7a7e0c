//! What a survey found, in words.

use std::fmt;

use super::{Faults, Survey};
use crate::mesh::Hole;

/// A kind of fault, and what there is of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What the kind is called.
    pub name: &'static str,
    /// How often it occurs.
    pub count: usize,
    /// How often, as what, and where first; "none" where it does not occur.
    pub words: String,
}

impl Survey {
    /// Every kind of fault but holes, which say themselves what they are; found or not.
    ///
    /// ```
    /// use langevin_rigid_bake::mesh::survey;
    /// use langevin_rigid_bake::shapes::Shape;
    ///
    /// let cube = Shape::Box { size: [0.1; 3] }.mesh(12)?;
    /// let mut triangles = cube.triangles().to_vec();
    /// triangles[7].swap(0, 1);
    /// let survey = survey(cube.vertices(), &triangles, &()).unwrap();
    /// let found: Vec<_> = survey.findings().into_iter().filter(|f| f.count > 0).collect();
    /// assert_eq!(found.len(), 1);
    /// assert_eq!(found[0].words, "1 triangles wind unlike their neighbours");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn findings(&self) -> Vec<Finding> {
        let first = |faults: &Faults| match faults.first {
            Some([x, y, z]) => format!(", the first at ({x:.4}, {y:.4}, {z:.4}) m"),
            None => String::new(),
        };
        let seams = &self.seams;
        let near = format!(
            "vertices within {:.1e} m of another (looked within {:.1e} m)",
            seams.distance, seams.tolerance
        );
        let edges = format!(
            "edges of more than two triangles{}",
            first(&self.non_manifold_edges)
        );
        let pinched = format!(
            "vertices where parts touch{}",
            first(&self.non_manifold_vertices)
        );
        let meeting = format!("triangles that meet others{}", first(&self.meeting));
        let unusable = "triangles, with coordinates or vertices that are none";
        let mut findings = vec![
            Finding::of("unusable", self.unusable, unusable),
            Finding::of("unused", self.unused_vertices, "vertices of no triangle"),
            Finding::of("degenerate", self.degenerate, "triangles without area"),
            Finding::of(
                "duplicate",
                self.duplicates,
                "triangles that repeat another",
            ),
            Finding::of("unwelded", seams.vertices, &near),
            Finding::of(
                "flipped",
                self.flipped,
                "triangles wind unlike their neighbours",
            ),
            Finding::of("non-manifold", self.non_manifold_edges.count, &edges),
            Finding::of("pinched", self.non_manifold_vertices.count, &pinched),
            Finding::of("intersections", self.meeting.count, &meeting),
        ];
        let turned = self.components.iter().filter(|c| c.is_inside_out()).count();
        if turned > 0 {
            findings.push(Finding {
                name: "inside out",
                count: turned,
                words: "yes; that is mended on the way".into(),
            });
        }
        if self.one_sided.is_some() {
            findings.push(Finding {
                name: "one-sided",
                count: 1,
                words: "yes, like a Möbius strip".into(),
            });
        }
        findings
    }
}

impl Finding {
    fn of(name: &'static str, count: usize, what: &str) -> Self {
        Self {
            name,
            count,
            words: match count {
                0 => "none".into(),
                count => format!("{count} {what}"),
            },
        }
    }
}

impl fmt::Display for Hole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Hole {
            edges,
            perimeter,
            centre: [x, y, z],
        } = self;
        write!(
            f,
            "{edges} edges, {perimeter:.4e} m around ({x:.4}, {y:.4}, {z:.4}) m"
        )
    }
}
