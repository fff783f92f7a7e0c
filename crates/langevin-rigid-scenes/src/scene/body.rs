//! The body of a scene: a parametric shape by name, or a mesh file.

use std::path::{Path, PathBuf};

use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::body::{BodyBakeError, BodySpec, mass_properties};
use langevin_rigid_bake::mass_properties::{MassError, check_inertia};
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{BODY_DENSITY, INERTIA, MASS, PLACE, SIZE};
use super::raw::{RawBody, given};
use super::{BodySource, Geometry, WriteSceneError, materials, shape};
use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat};

/// Triangles of a parametric body where the scene does not say.
const DEFAULT_TRIANGLES: usize = 1280;

pub(super) fn resolve(doc: &Document, raw: &Spanned<RawBody>) -> Result<BodySource, SceneError> {
    let body = raw.get_ref();
    match (&body.shape, &body.mesh) {
        (Some(shape), None) => {
            let (geometry, mesh, thickness) = parametric(doc, body, shape)?;
            let spec = spec(doc, raw, Some(thickness))?;
            weigh(doc, raw, &mesh, &spec)?;
            Ok(BodySource {
                geometry,
                spec,
                visual: visual(body),
            })
        }
        (None, Some(mesh)) => Ok(BodySource {
            geometry: from_file(doc, body, mesh)?,
            spec: spec(doc, raw, None)?,
            visual: visual(body),
        }),
        (Some(_), Some(mesh)) => {
            let message = "a body has either a `shape` or a `mesh`, not both";
            Err(doc.error(mesh.span(), message))
        }
        (None, None) => {
            let message = format!(
                "the body has neither a `mesh` (a file) nor a `shape` ({})",
                shape::names()
            );
            Err(doc.error(raw.span(), message))
        }
    }
}

fn visual(body: &RawBody) -> Option<PathBuf> {
    let path = body.visual.as_ref();
    path.map(|path| path.get_ref().into())
}

/// Refuses regions that the body does not fit; those of a mesh file are seen when it is read.
fn weigh(
    doc: &Document,
    raw: &Spanned<RawBody>,
    mesh: &TriMesh,
    spec: &BodySpec,
) -> Result<(), SceneError> {
    if spec.regions.is_empty() {
        return Ok(());
    }
    let body = raw.get_ref();
    mass_properties(mesh, spec).map(|_| ()).map_err(|error| {
        let place = match (&error, &body.mass) {
            (BodyBakeError::Mass(MassError::EmptyRegion { region, .. }), _) => {
                body.region[*region].span()
            }
            (_, Some(mass)) => mass.span(),
            _ => raw.span(),
        };
        doc.error(place, error.to_string())
    })
}

fn spec(
    doc: &Document,
    raw: &Spanned<RawBody>,
    own_thickness: Option<f64>,
) -> Result<BodySpec, SceneError> {
    let body = raw.get_ref();
    let density = doc.given(&body.density, "density", BODY_DENSITY)?;
    let mass = doc.given(&body.mass, "mass", MASS)?;
    if density.is_none() && mass.is_none() {
        let message = "the body needs a `density` (kg/m^3) or a `mass` (kg)";
        return Err(doc.error(raw.span(), message));
    }
    materials::check_stated_once(doc, body)?;
    let centre = |v| doc.numbers(v, "centre_of_mass", PLACE);
    let thickness = &body.characteristic_thickness;
    Ok(BodySpec {
        density,
        mass,
        regions: materials::regions(doc, body)?,
        ballast: materials::ballast(doc, body)?,
        centre_of_mass: body.centre_of_mass.as_ref().map(centre).transpose()?,
        inertia: inertia(doc, body)?,
        thickness: doc
            .given(thickness, "characteristic_thickness", SIZE)?
            .or(own_thickness),
        length: doc.given(&body.characteristic_length, "characteristic_length", SIZE)?,
    })
}

fn inertia(doc: &Document, body: &RawBody) -> Result<Option<[[f64; 3]; 3]>, SceneError> {
    let Some(given) = &body.inertia else {
        return Ok(None);
    };
    let rows: [Spanned<Vec<f64>>; 3] = doc.array(given, "inertia")?;
    let mut inertia = [[0.0; 3]; 3];
    for (numbers, row) in inertia.iter_mut().zip(&rows) {
        *numbers = doc.numbers(row, "inertia", INERTIA)?;
    }
    match check_inertia(inertia) {
        Ok(_) => Ok(Some(inertia)),
        Err(error) => Err(doc.error(given.span(), format!("`inertia`: {error}"))),
    }
}

fn from_file(
    doc: &Document,
    body: &RawBody,
    mesh: &Spanned<String>,
) -> Result<Geometry, SceneError> {
    shape::allow(doc, body, "mesh", &["thickness"])?;
    if let Some(triangles) = &body.triangles {
        let message = "`triangles` belongs to parametric shapes; a mesh file has its own";
        return Err(doc.error(triangles.span(), message));
    }
    let format = MeshFormat::of_extension(mesh.get_ref().as_ref());
    if body.unit.is_none() && format.is_some_and(|format| !format.has_unit()) {
        let message = "a mesh file needs its `unit` of length: \"m\", \"cm\", \"mm\", \"um\", \"in\" or \"ft\"";
        return Err(doc.error(mesh.span(), message));
    }
    let unit = body
        .unit
        .as_ref()
        .map(|unit| doc.name::<LengthUnit>(unit, "unit"));
    Ok(Geometry::Mesh {
        path: mesh.get_ref().into(),
        unit: unit.transpose()?,
        thickness: doc.given(&body.thickness, "thickness", SIZE)?,
    })
}

/// The shape, its mesh, and the thickness b of Eq. (1) that belongs to it.
fn parametric(
    doc: &Document,
    body: &RawBody,
    name: &Spanned<String>,
) -> Result<(Geometry, TriMesh, f64), SceneError> {
    if let Some(unit) = &body.unit {
        return Err(doc.error(
            unit.span(),
            "`unit` belongs to mesh files; shapes are in metres",
        ));
    }
    let shape = shape::resolve(doc, body, name)?;
    let triangles = triangles(doc, body)?;
    // Impossible dimensions and counts show when the mesh is made: do it once, here.
    let mesh = shape
        .mesh(triangles)
        .map_err(|e| doc.error(name.span(), e.to_string()))?;
    let thickness = shape.thickness();
    Ok((Geometry::Shape { shape, triangles }, mesh, thickness))
}

fn triangles(doc: &Document, body: &RawBody) -> Result<usize, SceneError> {
    body.triangles.as_ref().map_or(Ok(DEFAULT_TRIANGLES), |n| {
        usize::try_from(*n.get_ref())
            .map_err(|_| doc.error(n.span(), "`triangles` must be a positive whole number"))
    })
}

/// The body section of a resolved scene.
///
/// # Errors
/// A path that TOML, which is UTF-8, cannot hold.
pub(super) fn write(source: &BodySource) -> Result<RawBody, WriteSceneError> {
    let mut raw = match &source.geometry {
        Geometry::Mesh {
            path,
            unit,
            thickness,
        } => RawBody {
            mesh: given(utf8(path, "its mesh")?),
            unit: unit.and_then(|unit| given(unit.to_string())),
            thickness: thickness.and_then(given),
            ..RawBody::default()
        },
        Geometry::Shape { shape, triangles } => RawBody {
            triangles: given(*triangles as i64),
            ..shape::write(shape)
        },
    };
    if let Some(visual) = &source.visual {
        raw.visual = given(utf8(visual, "its visual")?);
    }
    let spec = &source.spec;
    raw.density = spec.density.and_then(given);
    raw.mass = spec.mass.and_then(given);
    raw.region = spec.regions.iter().map(materials::write_region).collect();
    raw.ballast = spec.ballast.iter().map(materials::write_ballast).collect();
    raw.centre_of_mass = spec.centre_of_mass.and_then(|c| given(c.to_vec()));
    let row = |row: [f64; 3]| Spanned::new(0..0, row.to_vec());
    raw.inertia = spec.inertia.and_then(|m| given(m.map(row).to_vec()));
    raw.characteristic_thickness = spec.thickness.and_then(given);
    raw.characteristic_length = spec.length.and_then(given);
    Ok(raw)
}

/// The path of a file that belongs to `whose`.
pub(super) fn utf8(path: &Path, whose: &str) -> Result<String, WriteSceneError> {
    path.to_str()
        .map(ToOwned::to_owned)
        .ok_or_else(|| WriteSceneError {
            message: format!(
                "the path of {whose}, `{}`, is not UTF-8: rename the file or its folder",
                path.display()
            ),
        })
}

#[cfg(test)]
mod tests {
    use crate::baking;
    use crate::scene::Scene;

    #[test]
    fn a_mesh_needs_its_unit_unless_its_format_has_one() {
        let scene = |mesh: &str| {
            let text = format!(
                "[fluid]\npreset = \"water\"\n[body]\nmesh = {mesh:?}\ndensity = 2000.0\n\
                 [release]\nposition = [0.0, 1.0, 0.0]\n[run]\ntime_step = 0.01\nduration = 1.0\n"
            );
            Scene::parse("body", "body.toml", &text)
        };
        let error = scene("body.stl").unwrap_err();
        assert_eq!(error.line, 4);
        assert!(error.to_string().contains("needs its `unit`"), "{error}");
        let ball = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../langevin-rigid-formats/tests/data/ball-meshopt.glb"
        );
        let scene = scene(ball).unwrap();
        let (mesh, notices) = baking::mesh(&scene).unwrap();
        assert!((mesh.volume() - 0.506).abs() < 1e-3 && notices.is_empty());
        let again = Scene::parse("body", "resolved", &scene.to_toml().unwrap()).unwrap();
        assert_eq!(again, scene);
    }
}
