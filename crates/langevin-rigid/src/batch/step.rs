//! Steps of a batch.

use super::{Batch, BatchError, Inputs, Pack, Precision};
use crate::input::Input;
use crate::state::State;
use crate::stepper::{StepError, Stepper};

impl Stepper {
    /// Advances every body of `batch` by `dt` (s), each with the noise of its own step number, in steady fluid.
    ///
    /// In double precision a body has the same bits as by [`Stepper::step`]. Nothing is allocated.
    ///
    /// # Errors
    /// [`BatchError`], which names the bodies that diverged; they are left as they were, the others
    /// have moved on.
    pub fn step_batch<P: Precision>(
        &self,
        batch: &mut Batch<P>,
        dt: f64,
    ) -> Result<(), BatchError> {
        self.step_packs(batch.packs_mut(), dt)
    }

    /// The same under `inputs`, which gives a body's input from its number and its state; the noise is that of the batch.
    ///
    /// ```
    /// use langevin_rigid::{Batch, Body, Flow, Fluid, Input, Settings, State, Stepper};
    /// let disc = Body::disc(0.05, 0.001, 500.0)?;
    /// let stepper = Stepper::new(&disc, &Fluid::AIR, None, &Settings::default())?;
    /// let mut batch = Batch::<f64>::new(7);
    /// for _ in 0..100 {
    ///     batch.push(&State::default());
    /// }
    /// // A wind that grows with height.
    /// let wind = |_, state: &State| Input {
    ///     flow: Flow::uniform([0.3 * (state.position[1] + 2.0), 0.0, 0.0]),
    ///     ..Input::default()
    /// };
    /// for _ in 0..10 {
    ///     stepper.step_batch_with(&mut batch, 1e-2, wind)?;
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Stepper::step_batch`].
    pub fn step_batch_with<P: Precision>(
        &self,
        batch: &mut Batch<P>,
        dt: f64,
        inputs: impl FnMut(u32, &State) -> Input,
    ) -> Result<(), BatchError> {
        self.step_packs_with(batch.packs_mut(), dt, inputs)
    }

    /// [`Stepper::step_batch`] for some packs of a batch, so that a host can share them among its own threads.
    ///
    /// # Errors
    /// As [`Stepper::step_batch`].
    pub fn step_packs<P: Precision>(
        &self,
        packs: &mut [Pack<P>],
        dt: f64,
    ) -> Result<(), BatchError> {
        self.each_pack(packs, dt, None)
    }

    /// [`Stepper::step_batch_with`] for some packs of a batch.
    ///
    /// # Errors
    /// As [`Stepper::step_batch`].
    pub fn step_packs_with<P: Precision>(
        &self,
        packs: &mut [Pack<P>],
        dt: f64,
        mut inputs: impl FnMut(u32, &State) -> Input,
    ) -> Result<(), BatchError> {
        self.each_pack(packs, dt, Some(&mut inputs))
    }

    fn each_pack<P: Precision>(
        &self,
        packs: &mut [Pack<P>],
        dt: f64,
        mut inputs: Option<&mut Inputs<'_>>,
    ) -> Result<(), BatchError> {
        let mut stopped = Vec::new();
        match self.paper() {
            _ if dt.is_nan() || dt < 0.0 => {
                let places = packs.iter().flat_map(Pack::bodies);
                stopped.extend(places.map(|body| (body, StepError::TimeStep(dt))));
            }
            None => {
                let mut forced = |pack: &Pack<P>| pack.forced(inputs.as_mut()?);
                P::step(self, packs, dt, &mut forced, &mut stopped);
            }
            Some(_) => {
                let mut input = |body, state: &State| match &mut inputs {
                    Some(inputs) => inputs(body, state),
                    None => Input::default(),
                };
                for pack in packs {
                    pack.step_each(&mut input, &mut stopped, |state, input| {
                        self.step(state, dt, input)
                    });
                }
            }
        }
        match stopped.first() {
            None => Ok(()),
            Some((_, first)) => Err(BatchError {
                first: first.clone(),
                bodies: stopped.into_iter().map(|(body, _)| body).collect(),
            }),
        }
    }
}
