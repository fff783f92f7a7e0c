//! What comes with the tensor: mesh quality, warnings, errors, progress.

use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::progress::Progress;

/// The mesh that was solved on, in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshQuality {
    /// Triangles of the mesh given.
    pub triangles_given: usize,
    /// Triangles after bisection and the layer along sharp edges.
    pub triangles_solved: usize,
    /// Largest ratio of a triangle's longest edge to the height above it, as solved (1.15 for an
    /// equilateral triangle).
    pub worst_aspect: f64,
    /// Longest edge of the triangles as solved (m).
    pub longest_edge: f64,
    /// Smallest gap between panels that face each other across the body or a slot in it, over their
    /// longest edge; infinite where no two do within an edge length.
    pub thickness_ratio: f64,
    /// |sum n·n' / (4 pi r) - V| / V over all pairs of panels, V that of the mesh given: zero with exact
    /// integrals, and no needles merged.
    pub quadrature_error: f64,
    /// Change of the tensor by the extrapolation from the edge layer, relative like
    /// [`AddedMass::error_estimate`](super::AddedMass::error_estimate); zero without sharp edges.
    pub edge_correction: f64,
    /// Relative residual of the linear solve (the tensor's error is of the order of its square).
    pub residual: f64,
    /// Iterations of the linear solve.
    pub iterations: usize,
}

/// Something that makes the result doubtful, with what to do about it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// The error estimate is large.
    InaccurateTensor {
        /// The estimate.
        estimate: f64,
        /// What it should stay below.
        threshold: f64,
    },
    /// The integrals over pairs of panels are inaccurate.
    InaccurateQuadrature {
        /// [`MeshQuality::quadrature_error`].
        error: f64,
        /// What it should stay below.
        threshold: f64,
    },
    /// The mesh has slivers.
    Slivers {
        /// [`MeshQuality::worst_aspect`].
        aspect: f64,
        /// What it should stay below.
        threshold: f64,
    },
    /// The body, or a slot in it, is much thinner than its triangles are long.
    ThinnerThanTriangles {
        /// [`MeshQuality::thickness_ratio`].
        ratio: f64,
        /// What it should stay above.
        threshold: f64,
    },
    /// Bisection stopped at the largest number of triangles allowed.
    RefinementStopped {
        /// Longest edge reached (m).
        longest: f64,
        /// Longest edge wanted (m).
        wanted: f64,
    },
    /// The linear solve stopped early.
    NotConverged {
        /// Relative residual reached.
        residual: f64,
        /// Relative residual wanted.
        threshold: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Warning::InaccurateTensor {
                estimate,
                threshold,
            } => write!(
                f,
                "the added mass may be off by {:.2} % (more than {:.2} %): give a finer mesh or a \
                 larger target number of triangles",
                100.0 * estimate,
                100.0 * threshold
            ),
            Warning::InaccurateQuadrature { error, threshold } => write!(
                f,
                "the panel integrals miss the volume by {:.2} % (more than {:.2} %): look for \
                 slivers, doubled faces and parts that intersect, or give a finer mesh",
                100.0 * error,
                100.0 * threshold
            ),
            Warning::Slivers { aspect, threshold } => write!(
                f,
                "a triangle is {aspect:.0} times as long as it is high (more than {threshold:.0}): \
                 remesh with more even triangles"
            ),
            Warning::ThinnerThanTriangles { ratio, threshold } => write!(
                f,
                "the body or a slot in it is {ratio:.4} triangle edges thick (less than \
                 {threshold:.4}): the small added mass along the sheet is rough, which hardly matters \
                 to its motion; give a finer mesh where it does"
            ),
            Warning::RefinementStopped { longest, wanted } => write!(
                f,
                "triangles stay {longest:.3e} m long where {wanted:.3e} m is wanted: raise the \
                 largest number of triangles or remesh with more even triangles"
            ),
            Warning::NotConverged {
                residual,
                threshold,
            } => write!(
                f,
                "the linear solve stopped at a residual of {residual:.1e} (more than \
                 {threshold:.1e}): look for slivers, doubled faces and parts that intersect"
            ),
        }
    }
}

/// Why there is no tensor.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AddedMassError {
    /// [`Progress::cancelled`] said so.
    #[error("the added mass was cancelled")]
    Cancelled,
    /// More triangles than the options allow.
    #[error(
        "{triangles} triangles (edge layer included) would take some {:.1} GB, {limit} are allowed: \
         simplify the mesh keeping its volume (`--proxy 20000` of the command), or raise `max_triangles` of the \
         options in a program of your own",
        8e-6 * *triangles as f64
    )]
    TooLarge {
        /// Triangles that would be solved on.
        triangles: usize,
        /// [`Options::max_triangles`](super::Options::max_triangles).
        limit: usize,
    },
    /// The body is so small or large that its tensor is beyond the range of numbers.
    #[error(
        "the added mass of a body some {size:.0e} m long is beyond the range of numbers: check the unit of the mesh"
    )]
    Size {
        /// Its length, to a factor of two (m).
        size: f64,
    },
    /// The pairs of triangles near each other take more memory than there may be.
    #[error(
        "very many long, thin triangles lie side by side, and pairs of them would take more than {:.1} GB: \
         remesh with more even triangles, or simplify the mesh (`--proxy 20000` of the command)",
        1e-9 * *limit as f64
    )]
    TooCrowded {
        /// The memory they may take (bytes).
        limit: u64,
    },
    /// The matrix is not positive: the surface is not that of a body.
    #[error(
        "the surface has a flow of energy {energy:.3e} at iteration {iteration} where only \
         positive ones exist: look for faces that intersect, are doubled or have no area"
    )]
    Singular {
        /// Iteration of the linear solve.
        iteration: usize,
        /// The energy found.
        energy: f64,
    },
}

pub(super) fn check_memory(bytes: u64, limit: u64) -> Result<(), AddedMassError> {
    // No allocation is larger, whatever the processor.
    let limit = limit.min(isize::MAX as u64);
    if bytes > limit {
        Err(AddedMassError::TooCrowded { limit })
    } else {
        Ok(())
    }
}

/// Counts steps of a stage and passes a wish to stop on.
pub(super) struct Cancel<'a> {
    progress: &'a dyn Progress,
    stage: &'a str,
    total: usize,
    done: AtomicUsize,
}

impl<'a> Cancel<'a> {
    pub(super) fn new(progress: &'a dyn Progress, stage: &'a str, total: usize) -> Cancel<'a> {
        progress.report(stage, 0.0);
        Cancel {
            progress,
            stage,
            total,
            done: AtomicUsize::new(0),
        }
    }

    pub(super) fn check(&self) -> Result<(), AddedMassError> {
        if self.progress.cancelled() {
            Err(AddedMassError::Cancelled)
        } else {
            Ok(())
        }
    }

    pub(super) fn advance(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.report(done as f64 / self.total.max(1) as f64);
    }

    /// Says that this share of the stage is done.
    pub(super) fn report(&self, share: f64) {
        self.progress.report(self.stage, share);
    }
}
