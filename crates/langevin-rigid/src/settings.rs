//! What a run may choose, by the names that scenes and the command line use.

use crate::choice::{UnknownName, choose};
use crate::fluid::GRAVITY;
use crate::linalg::Vec3;
use crate::published::UnitSystem;
use crate::separated::SeparatedFlow;
use crate::turbulence::TurbulenceSource;

/// How the equations of motion are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Model {
    /// Kirchhoff's equations with Langevin loads through the added mass: the paper's method,
    /// dimensionally sound.
    Consistent,
    /// Eqs. (11) and (12) of Xie & Miyata (2014) to the letter, in the named system of units.
    Published(UnitSystem),
    /// No turbulence loads (Weissmann & Pinkall 2012), the paper's Fig. 5(a).
    Kirchhoff,
    /// Kirchhoff's equations with the closure for separated flow: bodies flutter and tumble.
    #[default]
    Separated,
}

impl Model {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Consistent,
        Self::Published(UnitSystem::Cgs),
        Self::Published(UnitSystem::Si),
        Self::Kirchhoff,
        Self::Separated,
    ];

    /// Its name in scenes and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Consistent => "consistent",
            Self::Published(UnitSystem::Cgs) => "published",
            Self::Published(UnitSystem::Si) => "published-si",
            Self::Kirchhoff => "kirchhoff",
            Self::Separated => "separated",
        }
    }

    /// The integrator that it is meant for: the printed equations know only the paper's.
    pub fn integrator(self) -> Integrator {
        match self {
            Self::Published(_) => Integrator::RungeKutta4,
            Self::Consistent | Self::Kirchhoff | Self::Separated => Integrator::default(),
        }
    }
}

/// How a step is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Integrator {
    /// Strang splitting: half a step of the linear Langevin part solved exactly, one step of
    /// Kirchhoff's part by a Lie-group Runge-Kutta scheme, half a step of the Langevin part.
    #[default]
    Strang,
    /// The paper's scheme: Runge-Kutta for everything deterministic, Euler-Maruyama for the noise.
    RungeKutta4,
}

/// Choices of a run; the default is what a new user should have.
///
/// ```
/// use langevin_rigid::{Model, Settings};
/// let settings = Settings { model: "kirchhoff".parse()?, ..Settings::default() };
/// assert_eq!(settings.model, Model::Kirchhoff);
/// # Ok::<(), langevin_rigid::UnknownName>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Settings {
    /// How the equations of motion are read.
    pub model: Model,
    /// How a step is taken; the published equations know only [`Integrator::RungeKutta4`].
    pub integrator: Integrator,
    /// Where the turbulence comes from.
    pub turbulence: TurbulenceSource,
    /// Constants of the model [`Model::Separated`].
    pub separated: SeparatedFlow,
    /// Gravity, world frame (m/s^2).
    pub gravity: Vec3,
    /// Length l of Eq. (18) for body-driven turbulence (m); the body's own if none.
    pub turbulence_length: Option<f64>,
    /// Speed relative to the fluid at which the body is let go (m/s). The speed U of a run is the larger of this and
    /// of U0, Eq. (1); its Reynolds number U L / nu goes into C0(Re), Eq. (10).
    pub release_speed: f64,
    /// Another Reynolds number than that.
    pub reynolds: Option<f64>,
    /// The longest part that a step is taken in, over the shortest time in which the motion changes: 1 resolves it; up to 1.6
    /// it is coarser and faster, and stable, for bodies seen from afar.
    pub longest_part: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            model: Model::default(),
            integrator: Integrator::default(),
            turbulence: TurbulenceSource::default(),
            separated: SeparatedFlow::default(),
            gravity: GRAVITY,
            turbulence_length: None,
            release_speed: 0.0,
            reynolds: None,
            longest_part: 1.0,
        }
    }
}

impl std::str::FromStr for Model {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        choose("model", name, Self::ALL.map(|model| (model.name(), model)))
    }
}

impl std::fmt::Display for Model {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for Integrator {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let choices = [("strang", Self::Strang), ("rk4", Self::RungeKutta4)];
        choose("integrator", name, choices)
    }
}

impl std::fmt::Display for Integrator {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Strang => "strang",
            Self::RungeKutta4 => "rk4",
        })
    }
}

impl std::str::FromStr for TurbulenceSource {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let wake_age = name
            .strip_prefix("wake-age=")
            .and_then(|age| age.parse::<f64>().ok())
            .filter(|age| age.is_finite() && *age >= 0.0);
        if let Some(wake_age) = wake_age {
            return Ok(Self::BodyDriven { wake_age });
        }
        let choices = [
            ("body-driven", Self::BodyDriven { wake_age: 0.0 }),
            ("history", Self::History),
        ];
        choose("turbulence source", name, choices).map_err(|mut unknown| {
            unknown
                .known
                .push("wake-age=LENGTHS (body-driven, sampled so many lengths l behind)");
            unknown
        })
    }
}

impl std::fmt::Display for TurbulenceSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::BodyDriven { wake_age: 0.0 } => f.write_str("body-driven"),
            Self::BodyDriven { wake_age } => write!(f, "wake-age={wake_age}"),
            Self::History => f.write_str("history"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back_as_written() {
        for name in [
            "consistent",
            "published",
            "published-si",
            "kirchhoff",
            "separated",
        ] {
            assert_eq!(name.parse::<Model>().unwrap().to_string(), name);
        }
        for name in ["strang", "rk4"] {
            assert_eq!(name.parse::<Integrator>().unwrap().to_string(), name);
        }
        for name in ["body-driven", "history", "wake-age=16"] {
            assert_eq!(name.parse::<TurbulenceSource>().unwrap().to_string(), name);
        }
    }

    #[test]
    fn unknown_names_list_the_known_ones() {
        let message = "euler".parse::<Integrator>().unwrap_err().to_string();
        assert_eq!(
            message,
            "`euler` is no integrator; choose one of strang, rk4"
        );
        for bad in ["wake-age=-1", "wake-age=NaN", "wake-age=x", "wake-age"] {
            assert!(bad.parse::<TurbulenceSource>().is_err());
        }
    }
}
