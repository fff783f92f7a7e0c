//! Turbulence at the body: mean flow on a MAC grid and the k-epsilon model (Algorithm 1).
//!
//! # What is solved
//!
//! In the frame of the body the fluid streams upwards past it at the speed `U0` of Eqs. (1) and
//! (19). The mean flow `u` on a staggered grid obeys the Euler equations: semi-Lagrangian advection,
//! then a pressure projection by a direct solve. The turbulence obeys Eqs. (14)-(17) along the
//! paths of the mean flow,
//!
//! ```text
//! nu_T = C_mu k^2/epsilon        G = 2 nu_T sum S_ij^2
//! D k/Dt = G - epsilon           D epsilon/Dt = (epsilon/k) (C1 G - C2 epsilon)
//! ```
//!
//! and starts, in the box and at the inflow, from Eq. (18) with the cell size as its length:
//! `k0 = 3/2 U0^2`, `epsilon0 = C_mu^(3/4) k0^(3/2) / l`.
//!
//! # What comes out
//!
//! The body is passive: it has no boundary in the flow. The paper's inflow is uniform, and a uniform stream stays what it
//! is (to the bit, here), with no strain and no production, `G = 0`. The history of a fixed point at height `H` is then
//! first the decay of the initial turbulence, `chi = chi0 / (1 + (C2-1) chi0 t)`, and from `t = H/U0` on it stays at the
//! value of that law at `t = H/U0`: the fluid that passes by has always spent that long in the box. A passive particle,
//! as the paper words it, never sees this plateau; its `chi` decays like 1/t. The fixed point is the default because a
//! body that keeps falling needs loads that do not fade away.
//!
//! Mean flows with structure (shear, vortices, uneven inflow) go through the same solver:
//! [`MacGrid::set_velocity`] and [`TurbulentFlow`].
//!
//! # Choices
//!
//! - The sides of the box are slip walls: they leave a uniform stream as it is, and allow a direct solve.
//! - All equations here are inviscid, so `k/U0^2` and `chi l/U0` depend on `U0 t/l` and the shape of the grid alone.
//! - The bits of a result depend on the options only: not on the number of threads (each value is
//!   computed from the previous step's, nothing is summed across threads) and not on the processor
//!   (no dispatch; roots and powers from `libm`).

mod advection;
mod fft;
mod flow;
mod grid;
mod history;
mod k_epsilon;
mod lanes;
mod lattice;
mod projection;
mod sampler;
mod transform;

pub use flow::TurbulentFlow;
pub use grid::MacGrid;
pub use history::{FlowOptions, Sampling, turbulence_history};
pub use k_epsilon::{C_1, C_2, KEpsilon, decayed};
pub use lattice::Boundary;
pub use projection::Projection;

/// Why a turbulence history could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TurbulenceError {
    /// An axis of the grid has no cells.
    #[error("the grid has {cells:?} cells along x, y, z: each needs at least 1")]
    EmptyGrid {
        /// Cells along x, y and z.
        cells: [usize; 3],
    },
    /// The cell size is not a positive finite length.
    #[error(
        "cell size {cell} m: give a positive length, about the size of the body's smaller radius"
    )]
    CellSize {
        /// Edge of a cell (m).
        cell: f64,
    },
    /// The grid needs more memory than [`MacGrid::MAX_BYTES`].
    #[error(
        "a grid of {cells:?} cells needs {gigabytes:.1} GiB of memory, more than the limit of {} GiB: \
         use fewer cells", MacGrid::MAX_BYTES >> 30
    )]
    GridTooLarge {
        /// Cells along x, y and z.
        cells: [usize; 3],
        /// Memory of the flow (GiB).
        gigabytes: f64,
    },
    /// A stream through the box along another axis than `Y`.
    #[error(
        "Boundary::Through on axis {axis}: the stream runs along y (axis 1) only, use Walls or Periodic"
    )]
    StreamAxis {
        /// The axis: 0 is x, 2 is z.
        axis: usize,
    },
    /// The inflow speed is not positive and finite.
    #[error(
        "inflow speed {inflow_speed} m/s: give the positive mean falling speed of the body, Eq. (1)"
    )]
    InflowSpeed {
        /// Speed U0 (m/s).
        inflow_speed: f64,
    },
    /// The time step is not positive and finite.
    #[error("time step {time_step} s: give a positive step, such as cell / inflow_speed")]
    TimeStep {
        /// Time step (s).
        time_step: f64,
    },
    /// The duration is not positive and finite.
    #[error("duration {duration} s of the turbulence history: give a positive time")]
    Duration {
        /// Length of the history (s).
        duration: f64,
    },
    /// The history would have more entries than [`FlowOptions::MAX_ENTRIES`].
    #[error(
        "{steps} steps of turbulence history, more than the limit of {}: \
         shorten the duration or lengthen the time step",
        FlowOptions::MAX_ENTRIES
    )]
    TooManySteps {
        /// Steps that the options ask for.
        steps: f64,
    },
    /// The grid and the history together take more than [`FlowOptions::MAX_UPDATES`].
    #[error(
        "{steps} steps of this grid update {updates:.1e} cells, more than the limit of {:.0e}: \
         use fewer cells, shorten the duration or lengthen the time step",
        FlowOptions::MAX_UPDATES
    )]
    TooMuchWork {
        /// Steps that the options ask for.
        steps: f64,
        /// Cells times steps.
        updates: f64,
    },
    /// The turbulence to start from is not positive and finite.
    #[error(
        "initial turbulence k = {k} m^2/s^2, epsilon = {epsilon} m^2/s^3: both must be positive"
    )]
    InitialTurbulence {
        /// Energy (m^2/s^2).
        k: f64,
        /// Dissipation rate (m^2/s^3).
        epsilon: f64,
    },
    /// The velocity to start from is infinite or not a number somewhere.
    #[error("the initial velocity is not finite everywhere: check the function that sets it")]
    InitialVelocity,
    /// A projection was given a grid that it was not planned for.
    #[error(
        "projection planned for {planned:?} cells, given a grid of {given:?} cells or other bounds: \
         plan one for this grid"
    )]
    OtherGrid {
        /// Cells of the plan.
        planned: [usize; 3],
        /// Cells of the grid.
        given: [usize; 3],
    },
    /// The caller's [`Progress`](crate::progress::Progress) asked to stop.
    #[error("the turbulence history was cancelled")]
    Cancelled,
}
