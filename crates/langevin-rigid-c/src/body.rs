//! Bodies: of simple form, or baked from a mesh.

use std::ffi::c_char;

use langevin_rigid::{Bake, Body, BodyError, TurbulenceHistory};

use crate::pointers;
use crate::status::{Error, call, lr_status};
use crate::vector::{lr_mat3, lr_vec3};

/// A rigid body: its mass, its added mass, and what flow makes of its shape. Its frame has the origin at the centre of mass
/// and the axes of the mesh that it was made from.
///
/// Several threads may read it at a time.
pub struct lr_body {
    pub(crate) body: Body,
    /// Of the bake, where it has one.
    pub(crate) history: Option<TurbulenceHistory>,
}

impl From<Body> for lr_body {
    fn from(body: Body) -> Self {
        Self {
            body,
            history: None,
        }
    }
}

impl From<Bake> for lr_body {
    fn from(bake: Bake) -> Self {
        Self {
            body: bake.body,
            history: bake.history,
        }
    }
}

/// What a body is in numbers.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct lr_body_properties {
    /// Mass (kg).
    pub mass: f64,
    /// Volume (m^3).
    pub volume: f64,
    /// Inertia about the centre of mass, body frame (kg m^2).
    pub inertia: lr_mat3,
    /// Centre of buoyancy, from the centre of mass, body frame (m).
    pub centre_of_buoyancy: lr_vec3,
    /// Half the extents along the principal axes of the volume, descending (m).
    pub half_extents: lr_vec3,
}

/// A body from the bytes of a bake: the file that the command `langevin-rigid bake` writes. The turbulence that it has is
/// kept for the source `LR_TURBULENCE_HISTORY`.
///
/// `LR_STATUS_BAKE` if it is none. The bytes are not needed afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_from_bake(
    bytes: *const u8,
    length: usize,
    out: *mut *mut lr_body,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        pointers::put_new(out, || {
            let bytes = pointers::shared_many(bytes, length, "bytes")?;
            Ok(Bake::from_bytes(bytes)?.into())
        })
    })
}

/// A body from a bake file, whose path is in UTF-8: see `lr_body_from_bake`.
///
/// `LR_STATUS_FILE` if the file cannot be read, `LR_STATUS_BAKE` if it is no bake.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_load(path: *const c_char, out: *mut *mut lr_body) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe { pointers::put_new(out, || load(pointers::path(path)?)) })
}

fn load(path: &str) -> Result<lr_body, Error> {
    let bytes = std::fs::read(path).map_err(|cause| Error::File {
        path: path.into(),
        cause,
    })?;
    let bake = Bake::from_bytes(&bytes).map_err(|cause| Error::BakeFile {
        path: path.into(),
        cause,
    })?;
    Ok(bake.into())
}

/// # Safety
/// There is room for a pointer at `out`.
unsafe fn simple(
    out: *mut *mut lr_body,
    make: impl FnOnce() -> Result<Body, BodyError>,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe { pointers::put_new(out, || Ok(make()?.into())) })
}

/// A homogeneous sphere of this radius (m) and density (kg/m^3).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_sphere(
    radius: f64,
    density: f64,
    out: *mut *mut lr_body,
) -> lr_status {
    // SAFETY: promised by the caller.
    unsafe { simple(out, || Body::sphere(radius, density)) }
}

/// A homogeneous ellipsoid with these semi-axes along x, y and z of its frame (m) and this density (kg/m^3).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_ellipsoid(
    semi_axes: lr_vec3,
    density: f64,
    out: *mut *mut lr_body,
) -> lr_status {
    // SAFETY: promised by the caller.
    unsafe { simple(out, || Body::ellipsoid(semi_axes.into(), density)) }
}

/// A homogeneous disc of this radius and thickness (m) and density (kg/m^3), its axis along y of its frame.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_disc(
    radius: f64,
    thickness: f64,
    density: f64,
    out: *mut *mut lr_body,
) -> lr_status {
    // SAFETY: promised by the caller.
    unsafe { simple(out, || Body::disc(radius, thickness, density)) }
}

/// A homogeneous flat plate of this length along x, width along z and thickness along y of its frame (m) and this density
/// (kg/m^3).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_plate(
    length: f64,
    width: f64,
    thickness: f64,
    density: f64,
    out: *mut *mut lr_body,
) -> lr_status {
    // SAFETY: promised by the caller.
    unsafe { simple(out, || Body::plate(length, width, thickness, density)) }
}

/// A homogeneous circular cylinder of this radius and length (m) and density (kg/m^3), its axis along x of its frame.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_cylinder(
    radius: f64,
    length: f64,
    density: f64,
    out: *mut *mut lr_body,
) -> lr_status {
    // SAFETY: promised by the caller.
    unsafe { simple(out, || Body::cylinder(radius, length, density)) }
}

/// A homogeneous box with these edges along x, y and z of its frame (m) and this density (kg/m^3).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_cuboid(
    size: lr_vec3,
    density: f64,
    out: *mut *mut lr_body,
) -> lr_status {
    // SAFETY: promised by the caller.
    unsafe { simple(out, || Body::cuboid(size.into(), density)) }
}

/// Gives the hull other contents: this mass (kg), this centre of mass, from the present one in the body frame (m), and this
/// inertia about the new one (kg m^2). The origin of the frame moves to the new centre of mass; steppers that were made of
/// the body stay as they are. On failure the body is left as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_set_mass_properties(
    body: *mut lr_body,
    mass: f64,
    centre_of_mass: lr_vec3,
    inertia: lr_mat3,
) -> lr_status {
    call(|| {
        // SAFETY: promised by the caller.
        let body = unsafe { pointers::exclusive(body, "body") }?;
        let (centre_of_mass, inertia) = (centre_of_mass.into(), inertia.into());
        body.body = body
            .body
            .with_mass_properties(mass, centre_of_mass, inertia)?;
        Ok(())
    })
}

/// Mass, volume, inertia and size of a body.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_get_properties(
    body: *const lr_body,
    out: *mut lr_body_properties,
) -> lr_status {
    // SAFETY: promised by the caller.
    call(|| unsafe {
        let body = &pointers::shared(body, "body")?.body;
        let properties = lr_body_properties {
            mass: body.mass,
            volume: body.volume,
            inertia: body.inertia.into(),
            centre_of_buoyancy: body.centre_of_buoyancy.into(),
            half_extents: body.half_extents.into(),
        };
        pointers::put(out, "out", properties)
    })
}

/// Frees a body; NULL is none. Steppers that were made of it stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lr_body_free(body: *mut lr_body) {
    // SAFETY: promised by the caller.
    unsafe { pointers::free(body) }
}
