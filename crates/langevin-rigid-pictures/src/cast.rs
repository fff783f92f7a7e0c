//! The bodies that are drawn, ready to draw, and their ways.

use crate::solid::Solid;
use crate::{Actor, PictureError, Pose, Subject};
use langevin_rigid_formats::track::{Track, TrackError};

/// One or many bodies of one or several kinds.
#[derive(Clone, Debug)]
pub(super) struct Cast<'a> {
    solids: Vec<Solid>,
    players: Vec<Player<'a>>,
    /// Whether they are drawn as one of many, however many there are.
    pub crowd: bool,
}

/// A body: its kind, its size as a multiple of its kind's, its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Player<'a> {
    solid: usize,
    pub scale: f64,
    pub track: Track<'a>,
}

impl<'a> Cast<'a> {
    /// One body.
    pub(super) fn alone(subject: &Subject<'_>, poses: &'a [Pose]) -> Result<Self, PictureError> {
        let track = Track::new(poses)?;
        Ok(Self {
            solids: vec![Solid::new(subject)?],
            players: vec![Player {
                solid: 0,
                scale: 1.0,
                track,
            }],
            crowd: false,
        })
    }

    pub(super) fn new(
        subjects: &[Subject<'_>],
        actors: &[Actor<'a>],
    ) -> Result<Self, PictureError> {
        if actors.is_empty() {
            return Err(TrackError::NoPoses.into());
        }
        let player = |(index, actor): (usize, &Actor<'a>)| {
            let fits = actor.scale > 0.0 && actor.scale < 1e12;
            if actor.subject >= subjects.len() || !fits {
                return Err(PictureError::BadActor { index });
            }
            Ok(Player {
                solid: actor.subject,
                scale: actor.scale,
                track: Track::new(actor.poses)?,
            })
        };
        Ok(Self {
            players: actors
                .iter()
                .enumerate()
                .map(player)
                .collect::<Result<_, _>>()?,
            solids: subjects.iter().map(Solid::new).collect::<Result<_, _>>()?,
            crowd: true,
        })
    }

    pub(super) fn players(&self) -> &[Player<'a>] {
        &self.players
    }

    pub(super) fn solids(&self) -> &[Solid] {
        &self.solids
    }

    pub(super) fn solid(&self, player: &Player<'_>) -> &Solid {
        &self.solids[player.solid]
    }

    /// The first body, which is the only one where there is no crowd.
    pub(super) fn first(&self) -> (&Solid, &Track<'a>) {
        let first = &self.players[0];
        (self.solid(first), &first.track)
    }

    /// Radius of the largest body, m.
    pub(super) fn radius(&self) -> f64 {
        let radii = self.players.iter().map(|p| p.scale * self.solid(p).radius);
        radii.fold(0.0, f64::max)
    }

    /// Time of the first pose, s.
    pub(super) fn start(&self) -> f64 {
        let starts = self.players.iter().map(|p| p.track.start());
        starts.fold(f64::INFINITY, f64::min)
    }

    /// Time of the last pose, s.
    pub(super) fn end(&self) -> f64 {
        let ends = self.players.iter().map(|p| p.track.end());
        ends.fold(f64::NEG_INFINITY, f64::max)
    }
}
