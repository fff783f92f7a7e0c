//! What bodies of one kind share.

use langevin_rigid::linalg::vector::sub;
use langevin_rigid::linalg::{Mat6, rotate_back};
use langevin_rigid::wind::Wind;
use langevin_rigid::{Flow, Input, State, StepError, Stepper};

use crate::material::{Material, MaterialError};
use crate::shape::Shape;
use crate::water::{Immersion, WaterSurface};

/// How bodies move in the fluid, what of them touches, and how it rubs.
#[derive(Debug, Clone)]
pub struct Kind {
    fluids: Fluids,
    shape: Shape,
    material: Material,
    /// In place of the world's.
    wind: Option<Wind>,
}

#[derive(Debug, Clone)]
enum Fluids {
    One(Box<Stepper>),
    Two(Box<Immersion>),
}

/// A sleeping body wakes in a wind that pushes it with this share of its weight.
const BLOWN: f64 = 0.1;

/// Share of an energy that is rounding.
const ROUNDING: f64 = 1e-14;

impl Kind {
    /// Bodies in one fluid.
    ///
    /// # Errors
    /// [`MaterialError`].
    pub fn new(stepper: Stepper, shape: Shape, material: Material) -> Result<Self, MaterialError> {
        Self::of(Fluids::One(Box::new(stepper)), shape, material)
    }

    /// Bodies that may cross the surface between two.
    ///
    /// # Errors
    /// [`MaterialError`].
    pub fn between(
        immersion: Immersion,
        shape: Shape,
        material: Material,
    ) -> Result<Self, MaterialError> {
        Self::of(Fluids::Two(Box::new(immersion)), shape, material)
    }

    fn of(fluids: Fluids, shape: Shape, material: Material) -> Result<Self, MaterialError> {
        Ok(Self {
            fluids,
            shape,
            material: material.checked()?,
            wind: None,
        })
    }

    /// The same in a wind of their own, in place of that of the [world](crate::World::set_wind).
    #[must_use]
    pub fn in_wind(self, wind: Wind) -> Self {
        Self {
            wind: Some(wind),
            ..self
        }
    }

    /// The wind of their own.
    pub(crate) fn wind(&self) -> Option<&Wind> {
        self.wind.as_ref()
    }

    /// How they move in the fluid; the upper one, of two.
    pub fn stepper(&self) -> &Stepper {
        match &self.fluids {
            Fluids::One(stepper) => stepper,
            Fluids::Two(immersion) => immersion.in_air(),
        }
    }

    /// What of them touches.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// How they rub.
    pub fn material(&self) -> Material {
        self.material
    }

    pub(crate) fn step(
        &self,
        state: &mut State,
        dt: f64,
        input: &Input,
        water: Option<&WaterSurface>,
    ) -> Result<(), StepError> {
        match (&self.fluids, water) {
            (Fluids::Two(immersion), Some(surface)) => immersion.step(state, dt, input, surface),
            _ => self.stepper().step(state, dt, input),
        }
    }

    /// Inverse mass of a body and the fluid around it, body frame.
    pub(crate) fn inverse_mass(&self, state: &State, water: Option<&WaterSurface>) -> Mat6 {
        match (&self.fluids, water) {
            (Fluids::Two(immersion), Some(surface)) => {
                immersion.inverse_total_mass(immersion.share(state, surface))
            }
            _ => *self.stepper().inverse_total_mass(),
        }
    }

    /// Turns the momentum of a body back that moves as `free` but is at another pose, where that adds no energy. Else
    /// velocity and spin turn with the body, which never does.
    pub(crate) fn keep_momentum(&self, free: &State, state: &mut State) {
        let Fluids::One(stepper) = &self.fluids else {
            return;
        };
        let lost = sub(stepper.linear_impulse(free), stepper.linear_impulse(state));
        let lost = rotate_back(state.orientation, lost);
        let inverse = stepper.inverse_total_mass();
        let change = |row: usize| (0..3).map(|k| inverse[row][k] * lost[k]).sum::<f64>();
        let mut kept = *state;
        for k in 0..3 {
            kept.velocity[k] += change(k);
            kept.angular_velocity[k] += change(3 + k);
        }
        if stepper.kinetic_energy(&kept) <= stepper.kinetic_energy(free) * (1.0 + ROUNDING) {
            *state = kept;
        }
    }

    /// One over the mass of a body and the upper fluid around it, in its lightest direction (1/kg).
    pub(crate) fn lightness(&self) -> f64 {
        let inverse = self.stepper().inverse_total_mass();
        (0..3).map(|i| inverse[i][i]).fold(0.0, f64::max)
    }

    /// Whether a flow pushes a body at rest so that it may move.
    pub(crate) fn is_blown(&self, state: &State, flow: Flow) -> bool {
        let input = Input {
            flow,
            ..Input::default()
        };
        let stepper = self.stepper();
        stepper.push_to_weight(&stepper.loads(state, &input)) > BLOWN
    }
}
