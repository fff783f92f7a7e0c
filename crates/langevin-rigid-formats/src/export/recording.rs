//! A run as it is handed to the writers: how it was made, the kinds of its bodies, where each went.

use std::borrow::Cow;

use langevin_rigid::{Bake, Fluid, Settings};

use super::{ExportError, Up};
use crate::trajectory::Trajectory;
use crate::visual::Visual;

/// How a run was made, which animations say beside what they show.
#[derive(Debug, Clone, Copy)]
pub struct Conditions<'a> {
    /// Name of the scene.
    pub scene: &'a str,
    /// What the bodies are immersed in.
    pub fluid: &'a Fluid,
    /// Model, integrator, turbulence, gravity.
    pub settings: &'a Settings,
    /// Seed of the noise.
    pub seed: u64,
    /// Time step (s).
    pub time_step: f64,
}

/// What bodies of one kind have in common.
#[derive(Debug, Clone, Copy)]
pub struct Kind<'a> {
    /// Its name, which objects in animations have; that of the scene where it has one kind only.
    pub name: &'a str,
    /// The bake of a body of scale one, of which surface and mass properties are shown.
    pub bake: &'a Bake,
    /// What it looks like in GLB; its surface if none.
    pub visual: Option<&'a Visual>,
}

impl<'a> Kind<'a> {
    /// A kind that looks like its surface.
    pub fn new(name: &'a str, bake: &'a Bake) -> Self {
        Self {
            name,
            bake,
            visual: None,
        }
    }
}

/// A body of a run.
#[derive(Debug, Clone, Copy)]
pub struct RecordedBody<'a> {
    /// Place of its kind in [`Recording::kinds`].
    pub kind: usize,
    /// Its lengths over those of its kind, positive.
    pub scale: f64,
    /// Where it went.
    pub trajectory: &'a Trajectory,
}

/// A body of the first kind, at scale one.
impl<'a> From<&'a Trajectory> for RecordedBody<'a> {
    fn from(trajectory: &'a Trajectory) -> Self {
        Self {
            kind: 0,
            scale: 1.0,
            trajectory,
        }
    }
}

/// A run: the bodies of a scene and where they went.
///
/// Bodies of one kind come from their trajectories, as [`write()`](super::write()) shows.
#[derive(Debug, Clone, Copy)]
pub struct Recording<'a> {
    /// How it was made.
    pub conditions: Conditions<'a>,
    /// The kinds of bodies in it.
    pub kinds: &'a [Kind<'a>],
    /// The bodies, each of one of these kinds.
    pub bodies: &'a [RecordedBody<'a>],
}

impl<'a> Recording<'a> {
    /// Refuses bodies of no kind and of impossible sizes.
    pub(super) fn check(&self) -> Result<(), ExportError> {
        for body in self.bodies {
            let number = body.trajectory.body;
            if body.kind >= self.kinds.len() {
                return Err(ExportError::UnknownKind {
                    body: number,
                    kind: body.kind,
                    kinds: self.kinds.len(),
                });
            }
            if !(body.scale.is_normal() && body.scale > 0.0) {
                return Err(ExportError::Scale {
                    body: number,
                    scale: body.scale,
                });
            }
        }
        Ok(())
    }

    /// What the bodies look like is in GLB only.
    pub(super) fn without_visuals(&self) -> Option<String> {
        let names: Vec<&str> = self
            .kinds
            .iter()
            .filter(|kind| kind.visual.is_some())
            .map(|kind| kind.name)
            .collect();
        (!names.is_empty()).then(|| {
            format!(
                "USD shows the surface of {} that was simulated: its visual, with materials and textures, is in GLB \
                 only (`--format glb`)",
                names.join(", ")
            )
        })
    }

    /// Whether there is nothing to say of a body's kind and size.
    pub(super) fn is_uniform(&self) -> bool {
        self.kinds.len() <= 1 && self.bodies.iter().all(|body| body.scale == 1.0)
    }

    /// The kind of a body.
    pub(super) fn kind_of(&self, body: &RecordedBody<'_>) -> &Kind<'a> {
        &self.kinds[body.kind]
    }

    /// Lengths of the bodies (m).
    pub(super) fn lengths(&self) -> Vec<f64> {
        let length = |body: &RecordedBody<'_>| {
            2.0 * body.scale * self.kind_of(body).bake.body.half_extents[0]
        };
        self.bodies.iter().map(length).collect()
    }

    /// Where the bodies went, in a world in which another axis may point up.
    pub(super) fn trajectories(&self, up: Up) -> Vec<Cow<'a, Trajectory>> {
        self.bodies
            .iter()
            .map(|body| up.of(body.trajectory))
            .collect()
    }
}
