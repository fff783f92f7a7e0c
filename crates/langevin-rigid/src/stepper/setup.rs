//! What a stepper is put together from: checks, the loads of the model, the Reynolds number.

use super::paper::Paper;
use crate::body::{Body, BodyError};
use crate::equations::{FluidLoads, Separated};
use crate::fluid::Fluid;
use crate::kirchhoff::Kirchhoff;
use crate::langevin::Langevin;
use crate::linalg::{Vec3, eigen_symmetric, norm, scale, split};
use crate::pace::COARSEST;
use crate::published::Published;
use crate::separated::{Closure, Eddies};
use crate::settings::{Integrator, Model, Settings};
use crate::turbulence::{
    HistoryError, PreparedSource, Turbulence, TurbulenceHistory, TurbulenceSource, kolmogorov_c0,
};

/// Why a body cannot be made ready to step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// The body is impossible.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The turbulence history is impossible.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// A quantity is out of its range.
    #[error("{name} is {value}; it must be {wanted}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        wanted: &'static str,
    },
    /// Mass plus added mass is not positive definite.
    #[error(
        "nothing has inertia when the body {motion}, neither it nor the fluid: mass plus added mass is not positive definite. Give a body without mass that of the gas that fills it (air: 1.2 kg/m^3); check mass, inertia and centre of mass of others, and bake them again"
    )]
    TotalMass {
        /// The motion: "turns about [0.00, 1.00, 0.00]", body axes.
        motion: String,
    },
    /// The source of turbulence needs a history that there is none of.
    #[error(
        "the turbulence source `{0}` samples a precomputed history and there is none; bake the scene with its turbulence, or use `body-driven`"
    )]
    NoHistory(TurbulenceSource),
    /// The body lacks the tensors that separated flow needs.
    #[error(
        "the model `separated` needs the body's extents and drag areas, and this body has none; bake it from its mesh"
    )]
    NoSeparation,
    /// The printed equations were asked for with another scheme.
    #[error(
        "the model `published` is defined with the integrator `rk4` only; choose `rk4` or another model"
    )]
    PublishedIntegrator,
}

impl SetupError {
    /// [`SetupError::TotalMass`] for the motion that has the least inertia.
    pub(super) fn without_inertia(body: &Body, fluid: &Fluid) -> Self {
        let total = body.total_mass(fluid.density);
        let length = body.rotation_length();
        let unit = |i: usize| if i < 3 { 1.0 } else { length };
        let scaled = std::array::from_fn::<[f64; 6], 6, _>(|i| {
            std::array::from_fn(|j| total[i][j] / (unit(i) * unit(j)))
        });
        let (_, motions) = eigen_symmetric(&scaled);
        let (v, omega) = split(&motions.map(|row| row[0]));
        let (what, along) = if norm(v) > norm(omega) {
            ("moves along", v)
        } else {
            ("turns about", omega)
        };
        Self::TotalMass {
            motion: format!("{what} {:.2?}", scale(1.0 / norm(along), along)),
        }
    }
}

/// The loads of a model, and the paper's integrator if that is to take the steps.
pub(super) fn loads(
    body: &Body,
    fluid: &Fluid,
    history: Option<&TurbulenceHistory>,
    settings: &Settings,
    kirchhoff: &Kirchhoff,
) -> Result<(FluidLoads, Option<Paper>), SetupError> {
    let reynolds = reynolds(body, fluid, settings);
    let source = || {
        let length = settings
            .turbulence_length
            .unwrap_or_else(|| body.turbulence_length());
        let c0 = kolmogorov_c0(reynolds);
        PreparedSource::new(settings.turbulence, history, length, c0)
            .ok_or(SetupError::NoHistory(settings.turbulence))
    };
    // Twice the mean speed: what a swing or a dive may reach.
    let mean = || {
        let falling = falling_speed(body, fluid, settings.gravity);
        let mean = falling.max(reynolds * fluid.viscosity / body.length);
        Ok::<_, SetupError>(source()?.with_mean_speed(2.0 * mean))
    };
    let langevin = |source| {
        let added = body.added_mass.map(|row| row.map(|a| fluid.density * a));
        Langevin::new(added, &kirchhoff.total, body.rotation_length(), source)
            .ok_or_else(|| SetupError::without_inertia(body, fluid))
    };
    let by_the_paper = settings.integrator == Integrator::RungeKutta4;
    Ok(match settings.model {
        Model::Kirchhoff if by_the_paper => (FluidLoads::None, Some(Paper::RungeKutta4(None))),
        Model::Kirchhoff => (FluidLoads::None, None),
        Model::Consistent if by_the_paper => {
            let langevin = langevin(mean()?)?;
            (
                FluidLoads::None,
                Some(Paper::RungeKutta4(Some(Box::new(langevin)))),
            )
        }
        Model::Consistent => (FluidLoads::Langevin(langevin(mean()?)?), None),
        Model::Separated => {
            let closure = Closure::new(body, fluid.density, fluid.viscosity, settings.separated)
                .ok_or(SetupError::NoSeparation)?;
            let eddies = eddies(body, fluid, history, settings)?;
            (FluidLoads::Separated(Separated { closure, eddies }), None)
        }
        Model::Published(units) if by_the_paper => {
            let published = Published::new(body, fluid, settings.gravity, units, source()?)
                .ok_or_else(|| SetupError::without_inertia(body, fluid))?;
            (
                FluidLoads::None,
                Some(Paper::Published(Box::new(published))),
            )
        }
        Model::Published(_) => return Err(SetupError::PublishedIntegrator),
    })
}

/// The turbulence that the closure for separated flow sees.
fn eddies(
    body: &Body,
    fluid: &Fluid,
    history: Option<&TurbulenceHistory>,
    settings: &Settings,
) -> Result<Eddies, SetupError> {
    let constants = &settings.separated;
    let missing = SetupError::NoHistory(settings.turbulence);
    match (settings.turbulence, history) {
        (TurbulenceSource::History, Some(history)) => {
            let c0 = kolmogorov_c0(reynolds(body, fluid, settings));
            Ok(Eddies::precomputed(body, history, c0, constants))
        }
        (TurbulenceSource::BodyDriven { wake_age: 0.0 }, _) => {
            Ok(Eddies::shed(body, fluid.viscosity, 1.0, constants))
        }
        (TurbulenceSource::BodyDriven { wake_age }, Some(history)) => {
            let aged = history.at_age(wake_age).ok_or(missing)?;
            let strength = (aged.k / Turbulence::at_birth(1.0, 1.0).k).sqrt();
            Ok(Eddies::shed(body, fluid.viscosity, strength, constants))
        }
        _ => Err(missing),
    }
}

/// Mean falling speed U0 of Eq. (1) (m/s), with the absolute difference of the densities so that
/// rising bodies have one too.
pub fn falling_speed(body: &Body, fluid: &Fluid, gravity: Vec3) -> f64 {
    let ratio = body.density() / fluid.density;
    ((ratio - 1.0).abs() * norm(gravity) * body.thickness).sqrt()
}

/// Reynolds number of Eq. (1).
pub fn falling_reynolds(body: &Body, fluid: &Fluid, gravity: Vec3) -> f64 {
    falling_speed(body, fluid, gravity) * body.length / fluid.viscosity
}

/// Reynolds number of a run: see [`Settings::release_speed`].
pub(super) fn reynolds(body: &Body, fluid: &Fluid, settings: &Settings) -> f64 {
    let speed = falling_speed(body, fluid, settings.gravity).max(settings.release_speed);
    let of_run = speed * body.length / fluid.viscosity;
    settings.reynolds.unwrap_or(of_run)
}

pub(super) fn check(fluid: &Fluid, settings: &Settings) -> Result<(), SetupError> {
    let positive = [
        ("the fluid's density", Some(fluid.density)),
        ("the fluid's viscosity", Some(fluid.viscosity)),
        ("the turbulence length", settings.turbulence_length),
        (
            "the arm of the normal force",
            Some(settings.separated.normal_force_arm),
        ),
        ("the speed of relief", Some(settings.separated.relief_speed)),
        (
            "the memory of the turbulence",
            Some(settings.separated.turbulence_memory),
        ),
    ];
    for (name, value) in positive {
        let value = value.unwrap_or(1.0);
        if !(value > 0.0 && value.is_finite()) {
            return Err(SetupError::OutOfRange {
                name,
                value,
                wanted: "a positive number",
            });
        }
    }
    let value = settings.longest_part;
    if !(value > 0.0 && value <= COARSEST) {
        return Err(SetupError::OutOfRange {
            name: "the longest part of a step",
            value,
            wanted: "a positive number up to 1.6",
        });
    }
    let c = &settings.separated;
    let wake_age = match settings.turbulence {
        TurbulenceSource::BodyDriven { wake_age } => wake_age,
        TurbulenceSource::History => 0.0,
    };
    for (name, value) in [
        ("the Reynolds number", settings.reynolds.unwrap_or(0.0)),
        ("the release speed", settings.release_speed),
        ("the wake age of the turbulence", wake_age),
        ("the gain of dynamic stall", c.dynamic_stall),
        ("the rotational lift", c.rotational_lift),
        ("the rotational damping", c.rotational_damping),
        ("the rotational damping of a thick body", c.damping),
        ("the turbulence intensity", c.turbulence_intensity),
    ] {
        if !(value >= 0.0 && value.is_finite()) {
            let wanted = "zero or a positive number";
            return Err(SetupError::OutOfRange {
                name,
                value,
                wanted,
            });
        }
    }
    for (name, value) in [
        ("the attachment", c.attachment),
        ("the broadside attachment", c.broadside_attachment),
    ] {
        if !(value > 0.0 && value <= 1.0) {
            let wanted = "above 0 and at most 1";
            return Err(SetupError::OutOfRange {
                name,
                value,
                wanted,
            });
        }
    }
    for (name, vector) in [
        ("a component of gravity", settings.gravity),
        ("a component of the fluid's velocity", fluid.velocity),
    ] {
        if let Some(&value) = vector.iter().find(|x| !x.is_finite()) {
            return Err(SetupError::OutOfRange {
                name,
                value,
                wanted: "a finite number",
            });
        }
    }
    Ok(())
}
