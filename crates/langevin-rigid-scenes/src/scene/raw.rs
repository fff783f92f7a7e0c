//! A scene file as it is written: every value optional and with its place in the file.
//!
//! Arrays are lists here, of any length: a fixed length would let surplus entries pass.

use serde::{Deserialize, Serialize};
use serde_spanned::Spanned;
use toml::Value;

use super::seed::Seed;

/// A value that may be absent and knows where it stands.
pub(super) type Given<T> = Option<Spanned<T>>;

/// Wraps a value that comes from no file.
pub(super) fn given<T>(value: T) -> Given<T> {
    Some(Spanned::new(0..0, value))
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawScene {
    pub(super) description: Option<String>,
    pub(super) fluid: Spanned<RawFluid>,
    pub(super) body: Spanned<RawBody>,
    #[serde(default)]
    pub(super) release: RawRelease,
    pub(super) run: Spanned<RawRun>,
    #[serde(default)]
    pub(super) turbulence: RawTurbulence,
    #[serde(default)]
    pub(super) picture: RawPicture,
    #[serde(default)]
    pub(super) scatter: RawScatter,
    pub(super) tank: Option<RawTank>,
    #[serde(default)]
    pub(super) separated: RawSeparated,
    pub(super) contact: Option<RawContact>,
    pub(super) water: Option<Spanned<RawWater>>,
    pub(super) crowd: Option<Spanned<RawCrowd>>,
    pub(super) steering: Option<Spanned<RawSteering>>,
    pub(super) direct: Option<Spanned<RawDirect>>,
    // Lists of tables last, as TOML has them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) wind: Vec<Spanned<RawWind>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) obstacle: Vec<Spanned<RawObstacle>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawContact {
    pub(super) friction: Given<f64>,
    pub(super) restitution: Given<f64>,
    pub(super) shape: Given<String>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawObstacle {
    pub(super) shape: Given<String>,
    pub(super) size: Given<Vec<f64>>,
    pub(super) position: Given<Vec<f64>>,
    pub(super) normal: Given<Vec<f64>>,
    pub(super) tilt: Given<f64>,
    pub(super) tilt_axis: Given<Vec<f64>>,
    pub(super) orientation: Given<Vec<f64>>,
    pub(super) mesh: Given<String>,
    pub(super) unit: Given<String>,
    pub(super) friction: Given<f64>,
    pub(super) restitution: Given<f64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawWater {
    pub(super) level: Given<f64>,
    pub(super) preset: Given<String>,
    pub(super) density: Given<f64>,
    pub(super) viscosity: Given<f64>,
    pub(super) current: Given<Vec<f64>>,
    pub(super) waves: Option<Spanned<RawWaves>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawWaves {
    pub(super) height: Given<f64>,
    pub(super) period: Given<f64>,
    pub(super) heading: Given<f64>,
    pub(super) seed: Given<Seed>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawCrowd {
    pub(super) count: Given<i64>,
    pub(super) over: Given<Vec<f64>>,
    pub(super) during: Given<f64>,
    pub(super) orientation: Given<String>,
    pub(super) sizes: Given<Vec<f64>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) kinds: Vec<Spanned<RawCrowdKind>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawCrowdKind {
    pub(super) scene: Given<String>,
    pub(super) share: Given<f64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawFluid {
    pub(super) preset: Given<String>,
    pub(super) density: Given<f64>,
    pub(super) viscosity: Given<f64>,
    pub(super) velocity: Given<Vec<f64>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawBody {
    pub(super) shape: Given<String>,
    pub(super) semi_axes: Given<Vec<f64>>,
    pub(super) size: Given<Vec<f64>>,
    pub(super) radius: Given<f64>,
    pub(super) diameter: Given<f64>,
    pub(super) inner_diameter: Given<f64>,
    pub(super) hole: Given<f64>,
    pub(super) height: Given<f64>,
    pub(super) length: Given<f64>,
    pub(super) width: Given<f64>,
    pub(super) side: Given<f64>,
    pub(super) thickness: Given<f64>,
    pub(super) triangles: Given<i64>,
    pub(super) mesh: Given<String>,
    pub(super) unit: Given<String>,
    pub(super) visual: Given<String>,
    pub(super) density: Given<f64>,
    pub(super) mass: Given<f64>,
    pub(super) centre_of_mass: Given<Vec<f64>>,
    pub(super) inertia: Given<Vec<Spanned<Vec<f64>>>>,
    pub(super) characteristic_thickness: Given<f64>,
    pub(super) characteristic_length: Given<f64>,
    // Tables last, as TOML has them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) region: Vec<Spanned<RawRegion>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) ballast: Vec<Spanned<RawBallast>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawRegion {
    pub(super) from: Given<Vec<f64>>,
    pub(super) to: Given<Vec<f64>>,
    pub(super) density: Given<f64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawBallast {
    pub(super) mass: Given<f64>,
    pub(super) position: Given<Vec<f64>>,
    pub(super) radius: Given<f64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawRelease {
    pub(super) position: Given<Vec<f64>>,
    pub(super) tilt: Given<f64>,
    pub(super) tilt_axis: Given<Vec<f64>>,
    pub(super) orientation: Given<Vec<f64>>,
    pub(super) velocity: Given<Vec<f64>>,
    pub(super) angular_velocity: Given<Vec<f64>>,
    pub(super) frame: Given<String>,
    pub(super) carried: Given<f64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawRun {
    pub(super) model: Given<String>,
    pub(super) integrator: Given<String>,
    pub(super) turbulence: Given<String>,
    pub(super) time_step: Given<f64>,
    pub(super) duration: Given<f64>,
    pub(super) ground: Given<f64>,
    pub(super) seed: Given<Seed>,
    pub(super) gravity: Given<Vec<f64>>,
    pub(super) reynolds: Given<f64>,
    pub(super) stream: Given<i64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawTurbulence {
    pub(super) length: Given<f64>,
    pub(super) cells: Given<Vec<i64>>,
    pub(super) cell: Given<f64>,
    pub(super) inflow_speed: Given<f64>,
    pub(super) time_step: Given<f64>,
    pub(super) duration: Given<f64>,
    pub(super) sampling: Given<String>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawPicture {
    pub(super) interval: Given<f64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawScatter {
    pub(super) height: Given<Value>,
    pub(super) tilt: Given<Value>,
    pub(super) heading: Given<Value>,
    pub(super) velocity: Given<Value>,
    pub(super) spin: Given<Value>,
    pub(super) size: Given<Value>,
    pub(super) mass: Given<Value>,
    pub(super) fluid: Given<Vec<Spanned<String>>>,
    pub(super) fluid_density: Given<Value>,
    pub(super) fluid_viscosity: Given<Value>,
    pub(super) wind: Given<Value>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawWind {
    pub(super) field: Given<String>,
    pub(super) velocity: Given<Vec<f64>>,
    pub(super) height: Given<f64>,
    pub(super) ground: Given<f64>,
    pub(super) exponent: Given<f64>,
    pub(super) roughness: Given<f64>,
    pub(super) rms: Given<f64>,
    pub(super) length: Given<f64>,
    pub(super) smallest: Given<f64>,
    pub(super) carried: Given<Vec<f64>>,
    pub(super) seed: Given<Seed>,
    pub(super) centre: Given<Vec<f64>>,
    pub(super) axis: Given<Vec<f64>>,
    pub(super) circulation: Given<f64>,
    pub(super) core: Given<f64>,
    pub(super) speed: Given<f64>,
    pub(super) diameter: Given<f64>,
    pub(super) file: Given<String>,
    pub(super) bodies: Given<Vec<String>>,
    pub(super) within: Option<Spanned<RawWithin>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawWithin {
    pub(super) centre: Given<Vec<f64>>,
    pub(super) size: Given<Vec<f64>>,
    pub(super) radius: Given<f64>,
    pub(super) edge: Given<f64>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawTank {
    pub(super) size: Spanned<Vec<f64>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawSeparated {
    pub(super) attachment: Given<f64>,
    pub(super) broadside_attachment: Given<f64>,
    pub(super) normal_force_arm: Given<f64>,
    pub(super) dynamic_stall: Given<f64>,
    pub(super) rotational_lift: Given<f64>,
    pub(super) damping: Given<f64>,
    pub(super) rotational_damping: Given<f64>,
    pub(super) relief_speed: Given<f64>,
    pub(super) turbulence_intensity: Given<f64>,
    pub(super) turbulence_memory: Given<f64>,
    pub(super) attached: Option<bool>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawSteering {
    pub(super) every: Given<f64>,
    pub(super) force: Given<Vec<Spanned<Vec<f64>>>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawDirect {
    pub(super) best: Given<i64>,
    pub(super) falls: Given<i64>,
    pub(super) motion: Given<Vec<Spanned<String>>>,
    pub(super) steer: Given<f64>,
    pub(super) free: Option<Spanned<RawFree>>,
    pub(super) land: Option<Spanned<RawLand>>,
    pub(super) path: Option<Spanned<RawPath>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) ring: Vec<Spanned<RawRing>>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawFree {
    pub(super) tilt: Given<f64>,
    pub(super) heading: Given<f64>,
    pub(super) position: Given<Vec<f64>>,
    pub(super) velocity: Given<f64>,
    pub(super) spin: Given<f64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawLand {
    pub(super) at: Given<Vec<f64>>,
    pub(super) within: Given<f64>,
    pub(super) time: Given<f64>,
    pub(super) time_within: Given<f64>,
    pub(super) side: Given<String>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawPath {
    pub(super) file: Given<String>,
    pub(super) within: Given<f64>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RawRing {
    pub(super) centre: Given<Vec<f64>>,
    pub(super) normal: Given<Vec<f64>>,
    pub(super) radius: Given<f64>,
}
