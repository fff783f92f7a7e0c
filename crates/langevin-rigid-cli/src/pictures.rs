//! What the command says of pictures and films.

use std::io::Write;
use std::path::Path;

use anyhow::Result;
use langevin_rigid_pictures::View;
use langevin_rigid_scenes::shot::{Frames, Shown};

use crate::arguments::{self, Viewpoint};
use crate::say;

impl From<arguments::Shown> for Shown {
    fn from(shown: arguments::Shown) -> Self {
        match shown {
            arguments::Shown::Strobe => Self::Strobe,
            arguments::Shown::Path => Self::Path,
            arguments::Shown::Both => Self::Both,
        }
    }
}

impl From<Viewpoint> for View {
    fn from(viewpoint: Viewpoint) -> Self {
        match viewpoint {
            Viewpoint::Front => Self::Front,
            Viewpoint::Side => Self::Side,
            Viewpoint::Top => Self::Top,
            Viewpoint::Iso => Self::Iso,
        }
    }
}

/// Says what frames there are in `folder` and how they become a film; aside when standard output carries JSON.
pub(crate) fn tell(frames: Frames, folder: &Path, fps: f64, aside: bool) -> Result<()> {
    let Frames { written, of } = frames;
    let all = if written < of {
        format!(" of {of}")
    } else {
        String::new()
    };
    // The count keeps the frames of an older, longer film in the same folder out of this one.
    let text = format!(
        "  wrote {written}{all} frames to {}; a film of them:\n  ffmpeg -framerate {fps} -i '{}' \
         -frames:v {written} -pix_fmt yuv420p film.mp4",
        folder.display(),
        folder.join("frame-%05d.png").display()
    );
    match aside {
        true => say::aside(&text),
        false => writeln!(say::out(), "{text}")?,
    }
    Ok(())
}
