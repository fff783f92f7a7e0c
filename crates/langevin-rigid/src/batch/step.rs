//! Steps of a batch.

use super::{Acting, Batch, BatchError, InWind, Pack, Precision};
use crate::input::Input;
use crate::state::State;
use crate::stepper::{StepError, Stepper};
use crate::wind::Wind;

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
    /// It is asked once for each body, in the order of their places.
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

    /// The same in a wind, which is evaluated in lanes as well.
    ///
    /// Body n of the run meets the wind as it is n `apart` (s) after its own time: none, and all bodies are in one place
    /// and time together; an hour, and each has gusts of its own.
    ///
    /// In double precision a body has the same bits as by [`Stepper::step`] with the flow that [`Wind::flow`] gives there
    /// and then.
    ///
    /// ```
    /// use langevin_rigid::wind::{GustSettings, Gusts, Wind};
    /// use langevin_rigid::{Batch, Body, Fluid, Input, NoiseStream, Settings, State, Stepper};
    /// let disc = Body::disc(0.05, 0.001, 500.0)?;
    /// let stepper = Stepper::new(&disc, &Fluid::AIR, None, &Settings::default())?;
    /// let mut wind = Wind::default();
    /// wind.add(Gusts::new(&GustSettings { rms: 0.4, length: 2.0, ..GustSettings::default() })?)?;
    /// let mut batch = Batch::<f64>::new(7);
    /// for _ in 0..100 {
    ///     batch.push(&State::default());
    /// }
    /// let mut alone = State::default();
    /// for _ in 0..10 {
    ///     let flow = wind.flow(alone.position, alone.time, Fluid::AIR.velocity);
    ///     let noise = NoiseStream { seed: 7, body: 3 };
    ///     stepper.step(&mut alone, 1e-2, &Input { flow, noise, ..Input::default() })?;
    ///     stepper.step_batch_in(&mut batch, 1e-2, &wind, 0.0)?;
    /// }
    /// assert_eq!(batch.state(3), Some(alone));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Stepper::step_batch`].
    pub fn step_batch_in<P: Precision>(
        &self,
        batch: &mut Batch<P>,
        dt: f64,
        wind: &Wind,
        apart: f64,
    ) -> Result<(), BatchError> {
        self.step_packs_in(batch.packs_mut(), dt, wind, apart)
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
        self.each_pack(packs, dt, Acting::Nothing)
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
        self.each_pack(packs, dt, Acting::Inputs(&mut inputs))
    }

    /// [`Stepper::step_batch_in`] for some packs of a batch.
    ///
    /// # Errors
    /// As [`Stepper::step_batch`].
    pub fn step_packs_in<P: Precision>(
        &self,
        packs: &mut [Pack<P>],
        dt: f64,
        wind: &Wind,
        apart: f64,
    ) -> Result<(), BatchError> {
        let acting = match wind.is_empty() {
            true => Acting::Nothing,
            false => Acting::Wind(InWind { wind, apart }),
        };
        self.each_pack(packs, dt, acting)
    }

    fn each_pack<P: Precision>(
        &self,
        packs: &mut [Pack<P>],
        dt: f64,
        mut acting: Acting<'_>,
    ) -> Result<(), BatchError> {
        let mut stopped = Vec::new();
        match self.paper() {
            _ if dt.is_nan() || dt < 0.0 => {
                let places = packs.iter().flat_map(Pack::bodies);
                stopped.extend(places.map(|body| (body, StepError::TimeStep(dt))));
            }
            None => {
                P::step(self, packs, dt, &mut acting, &mut stopped);
            }
            Some(_) => {
                let stream = self.equations.current.unwrap_or_default();
                let mut input = |body, state: &State| match &mut acting {
                    Acting::Nothing => Input::default(),
                    Acting::Inputs(inputs) => inputs(body, state),
                    Acting::Wind(in_wind) => {
                        let time = in_wind.time(state.time, body);
                        Input {
                            flow: in_wind.wind.flow(state.position, time, stream),
                            ..Input::default()
                        }
                    }
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
