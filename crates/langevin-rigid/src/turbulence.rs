//! Turbulence at the body: the precomputed history and the sources that a run samples.

/// Turbulent kinetic energy and its dissipation rate at the body, at equal intervals from release.
///
/// Computed once per scene by the k-epsilon model on a MAC grid (Xie & Miyata 2014, Algorithm 1).
#[derive(Debug, Clone, PartialEq)]
pub struct TurbulenceHistory {
    /// Time between two entries (s).
    pub interval: f64,
    /// Inflow speed U0 of the mean flow (m/s).
    pub inflow_speed: f64,
    /// Length l of Eq. (18), the cell size of the grid (m).
    pub length: f64,
    /// Turbulent kinetic energy k (m^2/s^2), entry `i` at time `i * interval`.
    pub k: Vec<f64>,
    /// Dissipation rate epsilon (m^2/s^3), as long as `k`.
    pub epsilon: Vec<f64>,
}
