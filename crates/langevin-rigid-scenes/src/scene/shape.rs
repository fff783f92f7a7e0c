//! The body of a scene: a parametric shape by name, or a mesh file.

use std::path::Path;

use langevin_rigid_bake::body::BodySpec;
use langevin_rigid_bake::mass_properties::check_inertia;
use langevin_rigid_bake::shapes::Shape;
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{DENSITY, HOLE, INERTIA, MASS, PLACE, RADIUS, SIZE};
use super::raw::{Given, RawBody, given};
use super::{BodySource, Geometry, WriteSceneError};
use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat};

/// Triangles of a parametric body where the scene does not say.
const DEFAULT_TRIANGLES: usize = 1280;

const SHAPES: &str = "ellipsoid, elliptical-plate, disc, coin, washer, box, cylinder, paper-airplane, leaf, feather, samara";

/// The keys that give dimensions, with the value of each.
fn dimensions(raw: &RawBody) -> [(&'static str, Option<std::ops::Range<usize>>); 11] {
    fn at<T>(value: &Given<T>) -> Option<std::ops::Range<usize>> {
        value.as_ref().map(Spanned::span)
    }
    [
        ("semi_axes", at(&raw.semi_axes)),
        ("size", at(&raw.size)),
        ("radius", at(&raw.radius)),
        ("diameter", at(&raw.diameter)),
        ("inner_diameter", at(&raw.inner_diameter)),
        ("hole", at(&raw.hole)),
        ("height", at(&raw.height)),
        ("length", at(&raw.length)),
        ("width", at(&raw.width)),
        ("side", at(&raw.side)),
        ("thickness", at(&raw.thickness)),
    ]
}

pub(super) fn resolve(doc: &Document, raw: &Spanned<RawBody>) -> Result<BodySource, SceneError> {
    let body = raw.get_ref();
    let (geometry, own_thickness) = match (&body.shape, &body.mesh) {
        (Some(shape), None) => parametric(doc, body, shape)?,
        (None, Some(mesh)) => (from_file(doc, body, mesh)?, None),
        (Some(_), Some(mesh)) => {
            return Err(doc.error(
                mesh.span(),
                "a body has either a `shape` or a `mesh`, not both",
            ));
        }
        (None, None) => {
            let message =
                format!("the body has neither a `mesh` (a file) nor a `shape` ({SHAPES})");
            return Err(doc.error(raw.span(), message));
        }
    };
    Ok(BodySource {
        geometry,
        spec: spec(doc, raw, own_thickness)?,
    })
}

fn spec(
    doc: &Document,
    raw: &Spanned<RawBody>,
    own_thickness: Option<f64>,
) -> Result<BodySpec, SceneError> {
    let body = raw.get_ref();
    let density = doc.given(&body.density, "density", DENSITY)?;
    let mass = doc.given(&body.mass, "mass", MASS)?;
    if density.is_none() && mass.is_none() {
        let message = "the body needs a `density` (kg/m^3) or a `mass` (kg)";
        return Err(doc.error(raw.span(), message));
    }
    let centre = |v| doc.numbers(v, "centre_of_mass", PLACE);
    let thickness = &body.characteristic_thickness;
    Ok(BodySpec {
        density,
        mass,
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
    allow(doc, body, "mesh", &["thickness"])?;
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

/// The shape and the thickness b of Eq. (1) that belongs to it.
fn parametric(
    doc: &Document,
    body: &RawBody,
    name: &Spanned<String>,
) -> Result<(Geometry, Option<f64>), SceneError> {
    if let Some(unit) = &body.unit {
        return Err(doc.error(
            unit.span(),
            "`unit` belongs to mesh files; shapes are in metres",
        ));
    }
    let get = |key: &str, value: &Given<f64>| match value {
        Some(v) => doc.number(v, key, SIZE),
        None => Err(missing(doc, name, key)),
    };
    let shape = match name.get_ref().as_str() {
        "ellipsoid" => {
            allow(doc, body, name.get_ref(), &["semi_axes"])?;
            Shape::Ellipsoid {
                semi_axes: semi_axes(doc, body, name)?,
            }
        }
        "elliptical-plate" => {
            allow(doc, body, name.get_ref(), &["semi_axes", "thickness"])?;
            Shape::EllipticalPlate {
                semi_axes: semi_axes(doc, body, name)?,
                thickness: get("thickness", &body.thickness)?,
            }
        }
        "disc" => {
            allow(
                doc,
                body,
                name.get_ref(),
                &["diameter", "radius", "thickness"],
            )?;
            Shape::Disc {
                radius: radius(doc, body, name)?,
                thickness: get("thickness", &body.thickness)?,
            }
        }
        "coin" => {
            allow(
                doc,
                body,
                name.get_ref(),
                &["diameter", "thickness", "hole"],
            )?;
            Shape::Coin {
                diameter: get("diameter", &body.diameter)?,
                thickness: get("thickness", &body.thickness)?,
                hole: doc.given(&body.hole, "hole", HOLE)?.unwrap_or(0.0),
            }
        }
        "washer" => {
            allow(
                doc,
                body,
                name.get_ref(),
                &["diameter", "inner_diameter", "thickness"],
            )?;
            Shape::Washer {
                outer_diameter: get("diameter", &body.diameter)?,
                inner_diameter: get("inner_diameter", &body.inner_diameter)?,
                thickness: get("thickness", &body.thickness)?,
            }
        }
        "box" => {
            allow(doc, body, name.get_ref(), &["size"])?;
            let size = body
                .size
                .as_ref()
                .ok_or_else(|| missing(doc, name, "size"))?;
            Shape::Box {
                size: doc.numbers(size, "size", SIZE)?,
            }
        }
        "cylinder" => {
            allow(doc, body, name.get_ref(), &["diameter", "radius", "height"])?;
            Shape::Cylinder {
                radius: radius(doc, body, name)?,
                height: get("height", &body.height)?,
            }
        }
        "paper-airplane" => {
            allow(doc, body, name.get_ref(), &["side", "thickness"])?;
            Shape::PaperAirplane {
                side: get("side", &body.side)?,
                thickness: get("thickness", &body.thickness)?,
            }
        }
        blade @ ("leaf" | "feather" | "samara") => {
            allow(doc, body, blade, &["length", "width", "thickness"])?;
            let (length, width, thickness) = (
                get("length", &body.length)?,
                get("width", &body.width)?,
                get("thickness", &body.thickness)?,
            );
            match blade {
                "leaf" => Shape::Leaf {
                    length,
                    width,
                    thickness,
                },
                "feather" => Shape::Feather {
                    length,
                    width,
                    thickness,
                },
                _ => Shape::Samara {
                    length,
                    width,
                    thickness,
                },
            }
        }
        other => {
            let message = format!("`{other}` is no shape; choose one of {SHAPES}");
            return Err(doc.error(name.span(), message));
        }
    };
    let triangles = triangles(doc, body)?;
    // Impossible dimensions and counts show when the mesh is made: do it once, here.
    shape
        .mesh(triangles)
        .map_err(|e| doc.error(name.span(), e.to_string()))?;
    Ok((
        Geometry::Shape { shape, triangles },
        Some(thickness_of(&shape)),
    ))
}

fn triangles(doc: &Document, body: &RawBody) -> Result<usize, SceneError> {
    body.triangles.as_ref().map_or(Ok(DEFAULT_TRIANGLES), |n| {
        usize::try_from(*n.get_ref())
            .map_err(|_| doc.error(n.span(), "`triangles` must be a positive whole number"))
    })
}

fn missing(doc: &Document, name: &Spanned<String>, key: &str) -> SceneError {
    let message = format!("the shape `{}` needs `{key}` (m)", name.get_ref());
    doc.error(name.span(), message)
}

/// Refuses dimensions that the body does not have.
fn allow(doc: &Document, body: &RawBody, name: &str, keys: &[&str]) -> Result<(), SceneError> {
    for (key, span) in dimensions(body) {
        if let Some(span) = span.filter(|_| !keys.contains(&key)) {
            let message = format!(
                "`{key}` does not belong to `{name}`, which takes {}",
                keys.join(", ")
            );
            return Err(doc.error(span, message));
        }
    }
    Ok(())
}

fn semi_axes<const N: usize>(
    doc: &Document,
    body: &RawBody,
    name: &Spanned<String>,
) -> Result<[f64; N], SceneError> {
    let axes = body
        .semi_axes
        .as_ref()
        .ok_or_else(|| missing(doc, name, "semi_axes"))?;
    doc.numbers(axes, "semi_axes", RADIUS)
}

fn radius(doc: &Document, body: &RawBody, name: &Spanned<String>) -> Result<f64, SceneError> {
    match (&body.radius, &body.diameter) {
        (Some(r), None) => doc.number(r, "radius", RADIUS),
        (None, Some(d)) => Ok(0.5 * doc.number(d, "diameter", SIZE)?),
        (Some(_), Some(d)) => {
            Err(doc.error(d.span(), "give the `radius` or the `diameter`, not both"))
        }
        (None, None) => Err(missing(doc, name, "diameter")),
    }
}

/// The full thickness b of Eq. (1).
fn thickness_of(shape: &Shape) -> f64 {
    let least = |sizes: &[f64]| sizes.iter().copied().fold(f64::INFINITY, f64::min);
    match *shape {
        Shape::Ellipsoid { semi_axes } => 2.0 * least(&semi_axes),
        Shape::Box { size } => least(&size),
        Shape::Cylinder { radius, height } => least(&[2.0 * radius, height]),
        Shape::EllipticalPlate { thickness, .. }
        | Shape::Disc { thickness, .. }
        | Shape::Coin { thickness, .. }
        | Shape::Washer { thickness, .. }
        | Shape::PaperAirplane { thickness, .. }
        | Shape::Leaf { thickness, .. }
        | Shape::Feather { thickness, .. }
        | Shape::Samara { thickness, .. } => thickness,
    }
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
            mesh: given(utf8(path)?),
            unit: unit.and_then(|unit| given(unit.to_string())),
            thickness: thickness.and_then(given),
            ..RawBody::default()
        },
        Geometry::Shape { shape, triangles } => RawBody {
            triangles: given(*triangles as i64),
            ..write_shape(shape)
        },
    };
    let spec = &source.spec;
    raw.density = spec.density.and_then(given);
    raw.mass = spec.mass.and_then(given);
    raw.centre_of_mass = spec.centre_of_mass.and_then(|c| given(c.to_vec()));
    let row = |row: [f64; 3]| Spanned::new(0..0, row.to_vec());
    raw.inertia = spec.inertia.and_then(|m| given(m.map(row).to_vec()));
    raw.characteristic_thickness = spec.thickness.and_then(given);
    raw.characteristic_length = spec.length.and_then(given);
    Ok(raw)
}

fn utf8(path: &Path) -> Result<String, WriteSceneError> {
    path.to_str()
        .map(ToOwned::to_owned)
        .ok_or_else(|| WriteSceneError {
            message: format!(
                "the path of its mesh, `{}`, is not UTF-8: rename the file or its folder",
                path.display()
            ),
        })
}

fn write_shape(shape: &Shape) -> RawBody {
    let none = RawBody::default();
    let name = |name: &str| given(name.to_owned());
    match *shape {
        Shape::Ellipsoid { semi_axes } => RawBody {
            shape: name("ellipsoid"),
            semi_axes: given(semi_axes.to_vec()),
            ..none
        },
        Shape::EllipticalPlate {
            semi_axes,
            thickness,
        } => RawBody {
            shape: name("elliptical-plate"),
            semi_axes: given(semi_axes.to_vec()),
            thickness: given(thickness),
            ..none
        },
        Shape::Disc { radius, thickness } => RawBody {
            shape: name("disc"),
            radius: given(radius),
            thickness: given(thickness),
            ..none
        },
        Shape::Coin {
            diameter,
            thickness,
            hole,
        } => RawBody {
            shape: name("coin"),
            diameter: given(diameter),
            thickness: given(thickness),
            hole: given(hole),
            ..none
        },
        Shape::Washer {
            outer_diameter,
            inner_diameter,
            thickness,
        } => RawBody {
            shape: name("washer"),
            diameter: given(outer_diameter),
            inner_diameter: given(inner_diameter),
            thickness: given(thickness),
            ..none
        },
        Shape::Box { size } => RawBody {
            shape: name("box"),
            size: given(size.to_vec()),
            ..none
        },
        Shape::Cylinder { radius, height } => RawBody {
            shape: name("cylinder"),
            radius: given(radius),
            height: given(height),
            ..none
        },
        Shape::PaperAirplane { side, thickness } => RawBody {
            shape: name("paper-airplane"),
            side: given(side),
            thickness: given(thickness),
            ..none
        },
        Shape::Leaf {
            length,
            width,
            thickness,
        } => write_blade("leaf", [length, width, thickness]),
        Shape::Feather {
            length,
            width,
            thickness,
        } => write_blade("feather", [length, width, thickness]),
        Shape::Samara {
            length,
            width,
            thickness,
        } => write_blade("samara", [length, width, thickness]),
    }
}

fn write_blade(name: &str, [length, width, thickness]: [f64; 3]) -> RawBody {
    RawBody {
        shape: given(name.to_owned()),
        length: given(length),
        width: given(width),
        thickness: given(thickness),
        ..RawBody::default()
    }
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
