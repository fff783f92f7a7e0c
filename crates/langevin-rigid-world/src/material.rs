//! How surfaces rub and bounce.

/// Friction and bounce of a surface.
///
/// Where two surfaces meet, the friction is the geometric mean of both and the restitution the larger one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Coulomb's coefficient of friction, at rest and sliding alike.
    pub friction: f64,
    /// Speed after a bounce over the speed before it, from 0 to 1.
    pub restitution: f64,
}

/// Why a surface cannot rub or bounce so.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaterialError {
    /// The friction is negative or no number.
    #[error("the friction is {0}; it must be zero or a positive number")]
    Friction(f64),
    /// The restitution is not between 0 and 1.
    #[error("the restitution is {0}; it must be between 0 and 1")]
    Restitution(f64),
}

impl Default for Material {
    /// Paper on wood, roughly: friction 0.4, restitution 0.2.
    fn default() -> Self {
        Self {
            friction: 0.4,
            restitution: 0.2,
        }
    }
}

impl Material {
    /// Itself, where it is possible.
    ///
    /// # Errors
    /// [`MaterialError`].
    pub fn checked(self) -> Result<Self, MaterialError> {
        if !(self.friction >= 0.0 && self.friction.is_finite()) {
            Err(MaterialError::Friction(self.friction))
        } else if !(0.0..=1.0).contains(&self.restitution) {
            Err(MaterialError::Restitution(self.restitution))
        } else {
            Ok(self)
        }
    }

    pub(crate) fn with(self, other: Self) -> Self {
        Self {
            friction: (self.friction * other.friction).sqrt(),
            restitution: self.restitution.max(other.restitution),
        }
    }
}
