//! How a body moves in its fluid.

use langevin_rigid::{Model, Settings, TurbulenceSource, UnitSystem};

use crate::status::Error;
use crate::vector::lr_vec3;

/// How the equations of motion are read.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum lr_model {
    /// Kirchhoff's equations with the closure for separated flow: bodies flutter and tumble. The default.
    Separated = 0,
    /// Kirchhoff's equations with Langevin loads through the added mass: the method of Xie & Miyata (2014), dimensionally
    /// sound.
    Consistent = 1,
    /// Potential flow alone, without turbulence.
    Kirchhoff = 2,
    /// Eqs. (11) and (12) of Xie & Miyata (2014) to the letter, in centimetres, grams and seconds.
    Published = 3,
    /// The same in SI units.
    PublishedSi = 4,
}

/// Where the turbulence comes from.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum lr_turbulence {
    /// Born at the body, all along its way. The default.
    BodyDriven = 0,
    /// From the history in the bake, by the time since release.
    History = 1,
}

/// Choices of a run. `lr_settings_default` fills them with what a new user should have.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct lr_settings {
    /// Gravity, world frame (m/s^2).
    pub gravity: lr_vec3,
    /// Speed relative to the fluid at which the body is let go (m/s): the Reynolds number of its turbulence is on it where
    /// it is faster than the body falls.
    pub release_speed: f64,
    /// The longest part that a step is taken in, over the shortest time in which the motion changes: 1 resolves it; up to 1.6
    /// it is coarser and faster, and stable, for bodies seen from afar.
    pub longest_part: f64,
    /// One of `lr_model`.
    pub model: i32,
    /// One of `lr_turbulence`.
    pub turbulence: i32,
}

/// Earth's gravity along -y, the model `LR_MODEL_SEPARATED`, turbulence of the body's own, steps that resolve the motion.
#[unsafe(no_mangle)]
pub extern "C" fn lr_settings_default() -> lr_settings {
    let settings = Settings::default();
    lr_settings {
        gravity: settings.gravity.into(),
        release_speed: settings.release_speed,
        longest_part: settings.longest_part,
        model: lr_model::Separated as i32,
        turbulence: lr_turbulence::BodyDriven as i32,
    }
}

/// The models by number.
const MODELS: [(i32, Model); 5] = [
    (lr_model::Separated as i32, Model::Separated),
    (lr_model::Consistent as i32, Model::Consistent),
    (lr_model::Kirchhoff as i32, Model::Kirchhoff),
    (
        lr_model::Published as i32,
        Model::Published(UnitSystem::Cgs),
    ),
    (
        lr_model::PublishedSi as i32,
        Model::Published(UnitSystem::Si),
    ),
];

/// The sources by number.
const SOURCES: [(i32, TurbulenceSource); 2] = [
    (
        lr_turbulence::BodyDriven as i32,
        TurbulenceSource::BodyDriven { wake_age: 0.0 },
    ),
    (lr_turbulence::History as i32, TurbulenceSource::History),
];

impl lr_settings {
    pub(crate) fn chosen(self) -> Result<Settings, Error> {
        let model = choose("the model", self.model, "one of `lr_model`", MODELS)?;
        let turbulence = choose(
            "the source of turbulence",
            self.turbulence,
            "one of `lr_turbulence`",
            SOURCES,
        )?;
        Ok(Settings {
            model,
            integrator: model.integrator(),
            turbulence,
            gravity: self.gravity.into(),
            release_speed: self.release_speed,
            longest_part: self.longest_part,
            ..Settings::default()
        })
    }
}

/// What has this number.
fn choose<T, const N: usize>(
    name: &'static str,
    value: i32,
    wanted: &'static str,
    choices: [(i32, T); N],
) -> Result<T, Error> {
    let chosen = choices.into_iter().find(|(number, _)| *number == value);
    let (_, chosen) = chosen.ok_or_else(|| Error::Argument {
        name,
        value: value.to_string(),
        wanted,
    })?;
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_has_a_number() {
        for model in Model::ALL {
            let (number, _) = MODELS.iter().find(|(_, of)| *of == model).unwrap();
            let settings = lr_settings {
                model: *number,
                ..lr_settings_default()
            };
            let settings = settings.chosen().unwrap();
            assert_eq!(settings.model, model);
            assert_eq!(settings.integrator, model.integrator());
        }
    }

    #[test]
    fn the_default_is_the_library_s() {
        let settings = lr_settings_default().chosen().unwrap();
        assert_eq!(settings, Settings::default());
    }
}
