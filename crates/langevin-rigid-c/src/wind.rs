//! Wind that varies in space and time.

use langevin_rigid::wind::{GustSettings, Gusts, Jet, Profile, Shear, Vortex, Wind, WindField};

use crate::input::lr_flow;
use crate::pointers;
use crate::status::{Error, call, lr_status};
use crate::vector::lr_vec3;

/// The velocity of the fluid wherever and whenever a body may be: the sum of any number of fields. Several threads may ask
/// it for the flow at a time, but for one that adds to it.
pub struct lr_wind(Wind);

/// A wind without any field.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_new(out: *mut *mut lr_wind) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe { pointers::put_new(out, || Ok(lr_wind(Wind::default()))) })
}

/// Frees a wind; NULL is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_free(wind: *mut lr_wind) {
    // SAFETY: promised by the caller.
    unsafe { pointers::free(wind) }
}

/// # Safety
/// The wind is nobody else's meanwhile.
unsafe fn add<F: Into<WindField>>(
    wind: *mut lr_wind,
    field: impl FnOnce() -> Result<F, Error>,
) -> lr_status {
    call(|| {
        // SAFETY: promised by the caller.
        let wind = unsafe { pointers::exclusive(wind, "wind") }?;
        Ok(wind.0.add(field()?)?)
    })
}

/// Adds the same velocity everywhere (m/s), world frame.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_add_uniform(wind: *mut lr_wind, velocity: lr_vec3) -> lr_status {
    // SAFETY: promised by the caller.
    unsafe { add(wind, || Ok(WindField::Uniform(velocity.into()))) }
}

/// Adds wind that grows with this power of the height (1/7 over open land): `velocity` (m/s, world frame) at `height` (m)
/// above a ground at world y `ground` (m), below which there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_add_power_shear(
    wind: *mut lr_wind,
    velocity: lr_vec3,
    height: f64,
    ground: f64,
    exponent: f64,
) -> lr_status {
    let profile = Profile::Power { exponent };
    // SAFETY: promised by the caller.
    unsafe { add(wind, || Ok(shear(velocity, height, ground, profile))) }
}

/// Adds wind that grows with ln(1 + height/roughness), for a roughness length (m) of 0.03 in grass or 0.001 on a floor; the
/// rest as in `lr_wind_add_power_shear`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_add_log_shear(
    wind: *mut lr_wind,
    velocity: lr_vec3,
    height: f64,
    ground: f64,
    roughness: f64,
) -> lr_status {
    let profile = Profile::Log { roughness };
    // SAFETY: promised by the caller.
    unsafe { add(wind, || Ok(shear(velocity, height, ground, profile))) }
}

fn shear(velocity: lr_vec3, height: f64, ground: f64, profile: Profile) -> Shear {
    Shear {
        velocity: velocity.into(),
        height,
        ground,
        profile,
    }
}

/// Adds homogeneous isotropic turbulence of von Karman's spectrum: `rms` of each component of the velocity (m/s), integral
/// length scale `length` (m), size of the smallest eddies `smallest` (m; 0 for a fiftieth of the length), the velocity that
/// carries them (m/s, world frame), and which of all such fields it is, `seed`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_add_gusts(
    wind: *mut lr_wind,
    rms: f64,
    length: f64,
    smallest: f64,
    carried: lr_vec3,
    seed: u64,
) -> lr_status {
    let settings = GustSettings {
        rms,
        length,
        smallest: (smallest != 0.0).then_some(smallest),
        carried: carried.into(),
        seed,
    };
    // SAFETY: promised by the caller.
    unsafe { add(wind, || Ok(Gusts::new(&settings)?)) }
}

/// Adds a straight line through `centre` (m, world frame) along `axis`, of any length, about which the fluid turns
/// counter-clockwise, seen from the axis' tip: circulation (m^2/s) and radius of the viscous core (m).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_add_vortex(
    wind: *mut lr_wind,
    centre: lr_vec3,
    axis: lr_vec3,
    circulation: f64,
    core: f64,
) -> lr_status {
    let vortex = Vortex {
        centre: centre.into(),
        axis: axis.into(),
        circulation,
        core,
    };
    // SAFETY: promised by the caller.
    unsafe { add(wind, || Ok(vortex)) }
}

/// Adds what a fan blows: from `centre` (m, world frame) along `axis`, of any length, at `speed` (m/s) in the middle of a fan
/// of this diameter (m).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_add_jet(
    wind: *mut lr_wind,
    centre: lr_vec3,
    axis: lr_vec3,
    speed: f64,
    diameter: f64,
) -> lr_status {
    let jet = Jet {
        centre: centre.into(),
        axis: axis.into(),
        speed,
        diameter,
    };
    // SAFETY: promised by the caller.
    unsafe { add(wind, || Ok(jet)) }
}

/// The fluid at a position (m, world frame) and a time (s), for the input of a body there.
///
/// `stream` (m/s) is the velocity of the body's `lr_fluid`, which the wind comes on top of: it is not in the velocity that
/// comes out, but carries the wind along, which counts for its acceleration.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_wind_flow(
    wind: *const lr_wind,
    position: lr_vec3,
    time: f64,
    stream: lr_vec3,
    out: *mut lr_flow,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        let wind = &pointers::shared(wind, "wind")?.0;
        finite("the position", position)?;
        finite("the stream", stream)?;
        if !time.is_finite() {
            return Err(not_finite("the time", time.to_string()));
        }
        let flow = wind.flow(position.into(), time, stream.into());
        pointers::put(out, "out", flow.into())
    })
}

fn finite(name: &'static str, vector: lr_vec3) -> Result<(), Error> {
    let numbers: [f64; 3] = vector.into();
    match numbers.iter().all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(not_finite(name, format!("{numbers:?}"))),
    }
}

fn not_finite(name: &'static str, value: String) -> Error {
    Error::Argument {
        name,
        value,
        wanted: "finite",
    }
}
