//! The turbulence history of a scene: (k, epsilon) at the body over the run of Algorithm 1.

use langevin_rigid::turbulence::{Turbulence, TurbulenceHistory};

use super::TurbulenceError;
use super::flow::TurbulentFlow;
use super::grid::MacGrid;
use super::k_epsilon::decayed;
use super::lattice::Boundary;
use crate::progress::Progress;

/// Where the turbulence is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sampling {
    /// At the body, which stands still in the middle of the domain. The turbulence settles to a
    /// plateau when the inflow has reached it.
    #[default]
    Fixed,
    /// At a passive particle that starts in the middle and drifts with the mean flow, as the paper
    /// words it. What it meets keeps decaying, `chi` like 1/t; past the outflow, where there is no
    /// grid, it decays by the closed form.
    PassiveParticle,
}

/// A stream over the body, in the frame of the body: what Algorithm 1 needs.
///
/// The stream enters at the bottom of a box (`y = 0`) with `inflow_speed` along `+Y`, leaves at the
/// top and slips along the four sides. Nothing in it is a body: the body is passive (Sec. 6).
#[derive(Debug, Clone, PartialEq)]
pub struct FlowOptions {
    /// Cells along x, y (the stream) and z.
    pub cells: [usize; 3],
    /// Edge of a cell (m); it is the length l of Eq. (18).
    pub cell: f64,
    /// Speed U0 of the inflow (m/s), Eqs. (1) and (19).
    pub inflow_speed: f64,
    /// Time step (s), also the interval of the history.
    pub time_step: f64,
    /// Length of the history (s), rounded up to whole steps.
    pub duration: f64,
    /// Where the turbulence is read.
    pub sampling: Sampling,
}

impl FlowOptions {
    /// The grid of the paper's Fig. 2.
    pub const PAPER_CELLS: [usize; 3] = [32, 32, 16];

    /// Most entries of a history.
    pub const MAX_ENTRIES: usize = 10_000_000;

    /// Most updates of a cell: cells times steps, hours of work.
    pub const MAX_UPDATES: f64 = 1e12;

    /// Options with a step in which the stream crosses one cell (CFL number 1: uniform streams are
    /// then carried exactly), the time it takes to cross the box, and a fixed sample point.
    pub fn new(cells: [usize; 3], cell: f64, inflow_speed: f64) -> Self {
        let time_step = cell / inflow_speed;
        Self {
            cells,
            cell,
            inflow_speed,
            time_step,
            duration: cells[1] as f64 * time_step,
            sampling: Sampling::Fixed,
        }
    }

    /// Checks all but the grid, which checks itself; gives the number of steps.
    fn steps(&self) -> Result<usize, TurbulenceError> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let Self {
            inflow_speed,
            time_step,
            duration,
            ..
        } = *self;
        if !positive(inflow_speed) {
            return Err(TurbulenceError::InflowSpeed { inflow_speed });
        }
        if !positive(time_step) {
            return Err(TurbulenceError::TimeStep { time_step });
        }
        if !positive(duration) {
            return Err(TurbulenceError::Duration { duration });
        }
        // A duration that is a whole number of steps but for rounding is that number.
        let steps = (duration / time_step * (1.0 - 1e-12)).ceil();
        if steps >= Self::MAX_ENTRIES as f64 {
            return Err(TurbulenceError::TooManySteps { steps });
        }
        let updates = self
            .cells
            .iter()
            .fold(steps, |product, n| product * *n as f64);
        if updates > Self::MAX_UPDATES {
            return Err(TurbulenceError::TooMuchWork { steps, updates });
        }
        Ok(steps as usize)
    }
}

/// Runs Algorithm 1 and records `(k, epsilon)` at the body, one entry per step and one for the
/// start.
///
/// # Errors
///
/// Options out of range, and [`TurbulenceError::Cancelled`] when `progress` asks to stop.
///
/// ```
/// use langevin_rigid::turbulence::Turbulence;
/// use langevin_rigid_bake::turbulence::{FlowOptions, decayed, turbulence_history};
/// let options = FlowOptions::new(FlowOptions::PAPER_CELLS, 0.01, 0.81);
/// let history = turbulence_history(&options, &())?;
/// assert_eq!(history.k.len(), 33);
/// // Eq. (18) at the start, and a plateau of what has come 16 cells from the inflow.
/// let start = Turbulence::at_birth(0.81, 0.01);
/// assert_eq!(history.k[0], start.k);
/// let plateau = decayed(start, 16.0 * options.time_step).k;
/// assert!((history.k[32] / plateau - 1.0).abs() < 1e-12);
/// # Ok::<(), langevin_rigid_bake::turbulence::TurbulenceError>(())
/// ```
pub fn turbulence_history(
    options: &FlowOptions,
    progress: &dyn Progress,
) -> Result<TurbulenceHistory, TurbulenceError> {
    let steps = options.steps()?;
    let mut flow = uniform_stream(options)?;
    let mut probe = Probe::new(&flow, options.sampling);
    let mut history = TurbulenceHistory {
        interval: options.time_step,
        inflow_speed: options.inflow_speed,
        length: options.cell,
        k: Vec::with_capacity(steps + 1),
        epsilon: Vec::with_capacity(steps + 1),
    };
    for step in 0..=steps {
        let Turbulence { k, epsilon } = probe.read(&flow);
        history.k.push(k);
        history.epsilon.push(epsilon);
        progress.report("turbulence", step as f64 / steps as f64);
        if progress.cancelled() {
            return Err(TurbulenceError::Cancelled);
        }
        if step < steps {
            probe.advance(&flow, options.time_step);
            flow.step(options.time_step)?;
        }
    }
    Ok(history)
}

/// The box of `options` with the stream everywhere and the turbulence of Eq. (18).
fn uniform_stream(options: &FlowOptions) -> Result<TurbulentFlow, TurbulenceError> {
    let sides = [Boundary::Walls, Boundary::Through, Boundary::Walls];
    let mut grid = MacGrid::new(options.cells, options.cell, sides)?;
    grid.set_velocity(|_| [0.0, options.inflow_speed, 0.0]);
    let turbulence = Turbulence::at_birth(options.inflow_speed, options.cell);
    TurbulentFlow::new(grid, turbulence)
}

/// The point at which turbulence is read.
struct Probe {
    sampling: Sampling,
    position: [f64; 3],
    /// What a particle had when it left the grid, and for how long it has been away (s).
    outside: Option<(Turbulence, f64)>,
}

impl Probe {
    fn new(flow: &TurbulentFlow, sampling: Sampling) -> Self {
        Self {
            sampling,
            position: flow.grid().extent().map(|edge| 0.5 * edge),
            outside: None,
        }
    }

    fn read(&self, flow: &TurbulentFlow) -> Turbulence {
        match self.outside {
            Some((last, time)) => decayed(last, time),
            None => flow.turbulence().at(self.position),
        }
    }

    /// Moves with the flow (midpoint rule), before the flow takes its own step.
    fn advance(&mut self, flow: &TurbulentFlow, dt: f64) {
        if self.sampling == Sampling::Fixed {
            return;
        }
        if let Some((_, time)) = &mut self.outside {
            *time += dt;
            return;
        }
        let grid = flow.grid();
        let moved =
            |by: [f64; 3], time: f64| core::array::from_fn(|a| self.position[a] + by[a] * time);
        let halfway = moved(grid.velocity_at(self.position), 0.5 * dt);
        let position: [f64; 3] = moved(grid.velocity_at(halfway), dt);
        // Beyond the last centres the grid has no gradients to read.
        let top = grid.extent()[1] - 0.5 * grid.cell_size();
        if position[1] > top {
            self.outside = Some((self.read(flow), dt));
        }
        self.position = position;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options() -> FlowOptions {
        FlowOptions::new([4, 8, 2], 0.02, 0.5)
    }

    #[test]
    fn refuses_options_out_of_range() {
        let refused = |change: &dyn Fn(&mut FlowOptions)| {
            let mut options = options();
            change(&mut options);
            turbulence_history(&options, &()).unwrap_err()
        };
        use TurbulenceError as E;
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                refused(&|o| o.inflow_speed = bad),
                E::InflowSpeed { .. }
            ));
            assert!(matches!(
                refused(&|o| o.time_step = bad),
                E::TimeStep { .. }
            ));
            assert!(matches!(refused(&|o| o.duration = bad), E::Duration { .. }));
            assert!(matches!(refused(&|o| o.cell = bad), E::CellSize { .. }));
        }
        assert!(matches!(refused(&|o| o.cells[2] = 0), E::EmptyGrid { .. }));
        assert!(matches!(
            refused(&|o| o.time_step = 1e-12),
            E::TooManySteps { .. }
        ));
        // A box of which the stream takes its length in steps to cross it.
        let long = FlowOptions::new([1, 2_000_000, 1], 0.02, 0.5);
        assert!(matches!(long.steps(), Err(E::TooMuchWork { .. })));
        assert!(FlowOptions::new([1, 900_000, 1], 0.02, 0.5).steps().is_ok());
    }

    #[test]
    fn stops_when_asked() {
        struct Stop;
        impl Progress for Stop {
            fn cancelled(&self) -> bool {
                true
            }
        }
        let result = turbulence_history(&options(), &Stop);
        assert!(matches!(result, Err(TurbulenceError::Cancelled)));
    }

    #[test]
    fn a_particle_decays_on_beyond_the_grid() {
        let mut options = options();
        options.sampling = Sampling::PassiveParticle;
        options.duration = 40.0 * options.time_step;
        let history = turbulence_history(&options, &()).unwrap();
        let start = Turbulence::at_birth(0.5, 0.02);
        for (i, (k, epsilon)) in history.k.iter().zip(&history.epsilon).enumerate() {
            let expected = decayed(start, i as f64 * options.time_step);
            assert!((k / expected.k - 1.0).abs() < 1e-13, "entry {i}");
            assert!(
                (epsilon / expected.epsilon - 1.0).abs() < 1e-13,
                "entry {i}"
            );
        }
    }

    #[test]
    fn duration_of_whole_steps_is_not_rounded_up() {
        let mut options = options();
        for steps in [1, 3, 7, 50, 1000] {
            options.duration = f64::from(steps) * options.time_step;
            assert_eq!(options.steps().unwrap(), steps as usize);
        }
        options.duration = 2.5 * options.time_step;
        assert_eq!(options.steps().unwrap(), 3);
    }
}
