//! The kinds of bodies of a run, as exports show them.

use langevin_rigid::Bake;
use langevin_rigid_formats::export::Kind;
use langevin_rigid_formats::visual::Visual;

use crate::look::{LookError, look};
use crate::prepared::Prepared;
use crate::scene::Scene;

/// The bodies of a scene with their looks: what a [`Recording`](langevin_rigid_formats::export::Recording) is given.
#[derive(Debug)]
pub struct Cast<'a> {
    members: Vec<(&'a Scene, &'a Bake, Option<Visual>)>,
}

impl<'a> Cast<'a> {
    /// Reads the looks.
    ///
    /// # Errors
    /// [`LookError`].
    pub fn new(prepared: &'a Prepared) -> Result<Self, LookError> {
        let members = prepared
            .kinds()
            .map(|(scene, baked)| Ok((scene, &baked.bake, look(scene)?)));
        Ok(Self {
            members: members.collect::<Result<_, LookError>>()?,
        })
    }

    /// The kinds, the scene's own first.
    pub fn kinds(&self) -> Vec<Kind<'_>> {
        self.members
            .iter()
            .map(|(scene, bake, look)| Kind {
                visual: look.as_ref(),
                ..Kind::new(&scene.name, bake)
            })
            .collect()
    }

    /// What was left out of the looks.
    pub fn notices(&self) -> impl Iterator<Item = String> {
        let looks = self.members.iter().filter_map(|(_, _, look)| look.as_ref());
        looks.flat_map(|look| look.notices().iter().cloned())
    }
}
