//! The parametric shapes by name, with the keys of their dimensions.

use langevin_rigid_bake::shapes::Shape;
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{HOLE, RADIUS, SIZE};
use super::raw::{Given, RawBody, given};

/// A shape as scenes have it.
struct Entry {
    name: &'static str,
    /// The keys that it takes.
    keys: &'static [&'static str],
    read: fn(&Dimensions) -> Result<Shape, SceneError>,
}

/// All shapes, as messages list them. A new one is a row here, and an arm of [`write`].
const SHAPES: &[Entry] = &[
    Entry {
        name: "ellipsoid",
        keys: &["semi_axes"],
        read: |given| {
            Ok(Shape::Ellipsoid {
                semi_axes: given.semi_axes()?,
            })
        },
    },
    Entry {
        name: "elliptical-plate",
        keys: &["semi_axes", "thickness"],
        read: |given| {
            Ok(Shape::EllipticalPlate {
                semi_axes: given.semi_axes()?,
                thickness: given.thickness()?,
            })
        },
    },
    Entry {
        name: "disc",
        keys: &["diameter", "radius", "thickness"],
        read: |given| {
            Ok(Shape::Disc {
                radius: given.radius()?,
                thickness: given.thickness()?,
            })
        },
    },
    Entry {
        name: "coin",
        keys: &["diameter", "thickness", "hole"],
        read: |given| {
            Ok(Shape::Coin {
                diameter: given.size("diameter", &given.body.diameter)?,
                thickness: given.thickness()?,
                hole: given
                    .doc
                    .given(&given.body.hole, "hole", HOLE)?
                    .unwrap_or(0.0),
            })
        },
    },
    Entry {
        name: "washer",
        keys: &["diameter", "inner_diameter", "thickness"],
        read: |given| {
            Ok(Shape::Washer {
                outer_diameter: given.size("diameter", &given.body.diameter)?,
                inner_diameter: given.size("inner_diameter", &given.body.inner_diameter)?,
                thickness: given.thickness()?,
            })
        },
    },
    Entry {
        name: "box",
        keys: &["size"],
        read: |given| {
            Ok(Shape::Box {
                size: given.edges()?,
            })
        },
    },
    Entry {
        name: "cylinder",
        keys: &["diameter", "radius", "height"],
        read: |given| {
            Ok(Shape::Cylinder {
                radius: given.radius()?,
                height: given.size("height", &given.body.height)?,
            })
        },
    },
    Entry {
        name: "paper-airplane",
        keys: &["side", "thickness"],
        read: |given| {
            Ok(Shape::PaperAirplane {
                side: given.size("side", &given.body.side)?,
                thickness: given.thickness()?,
            })
        },
    },
    Entry {
        name: "leaf",
        keys: &["length", "width", "thickness"],
        read: |given| {
            Ok(Shape::Leaf {
                length: given.size("length", &given.body.length)?,
                width: given.size("width", &given.body.width)?,
                thickness: given.thickness()?,
            })
        },
    },
    Entry {
        name: "feather",
        keys: &["length", "width", "thickness"],
        read: |given| {
            Ok(Shape::Feather {
                length: given.size("length", &given.body.length)?,
                width: given.size("width", &given.body.width)?,
                thickness: given.thickness()?,
            })
        },
    },
    Entry {
        name: "samara",
        keys: &["length", "width", "thickness"],
        read: |given| {
            Ok(Shape::Samara {
                length: given.size("length", &given.body.length)?,
                width: given.size("width", &given.body.width)?,
                thickness: given.thickness()?,
            })
        },
    },
];

/// The names of all shapes.
pub(super) fn names() -> String {
    let names: Vec<&str> = SHAPES.iter().map(|shape| shape.name).collect();
    names.join(", ")
}

/// The shape of that name with the dimensions of the section.
pub(super) fn resolve(
    doc: &Document,
    body: &RawBody,
    name: &Spanned<String>,
) -> Result<Shape, SceneError> {
    let shape = doc.choose(
        "shape",
        name,
        SHAPES.iter().map(|shape| (shape.name, shape)),
    )?;
    allow(doc, body, shape.name, shape.keys)?;
    (shape.read)(&Dimensions { doc, body, name })
}

/// The dimensions in the section of a shape.
struct Dimensions<'a> {
    doc: &'a Document<'a>,
    body: &'a RawBody,
    name: &'a Spanned<String>,
}

impl Dimensions<'_> {
    fn size(&self, key: &str, value: &Given<f64>) -> Result<f64, SceneError> {
        match value {
            Some(value) => self.doc.number(value, key, SIZE),
            None => Err(self.missing(key)),
        }
    }

    fn thickness(&self) -> Result<f64, SceneError> {
        self.size("thickness", &self.body.thickness)
    }

    /// The radius, or half the diameter.
    fn radius(&self) -> Result<f64, SceneError> {
        match (&self.body.radius, &self.body.diameter) {
            (Some(_), Some(diameter)) => {
                let message = "give the `radius` or the `diameter`, not both";
                Err(self.doc.error(diameter.span(), message))
            }
            (Some(radius), None) => self.doc.number(radius, "radius", RADIUS),
            (None, diameter) => Ok(0.5 * self.size("diameter", diameter)?),
        }
    }

    fn semi_axes<const N: usize>(&self) -> Result<[f64; N], SceneError> {
        match &self.body.semi_axes {
            Some(axes) => self.doc.numbers(axes, "semi_axes", RADIUS),
            None => Err(self.missing("semi_axes")),
        }
    }

    /// The edges of a box.
    fn edges(&self) -> Result<[f64; 3], SceneError> {
        match &self.body.size {
            Some(size) => self.doc.numbers(size, "size", SIZE),
            None => Err(self.missing("size")),
        }
    }

    fn missing(&self, key: &str) -> SceneError {
        let message = format!("the shape `{}` needs `{key}` (m)", self.name.get_ref());
        self.doc.error(self.name.span(), message)
    }
}

/// Refuses dimensions that the body does not have.
pub(super) fn allow(
    doc: &Document,
    body: &RawBody,
    name: &str,
    keys: &[&str],
) -> Result<(), SceneError> {
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

/// The keys of a resolved shape.
pub(super) fn write(shape: &Shape) -> RawBody {
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
    use super::*;

    #[test]
    fn every_shape_reads_back_as_written() {
        let all = RawBody {
            semi_axes: given(vec![0.1, 0.2, 0.3]),
            size: given(vec![0.1, 0.2, 0.3]),
            diameter: given(0.2),
            inner_diameter: given(0.1),
            hole: given(0.05),
            height: given(0.3),
            length: given(0.3),
            width: given(0.1),
            side: given(0.2),
            thickness: given(0.01),
            ..RawBody::default()
        };
        let plane = RawBody {
            semi_axes: given(vec![0.1, 0.2]),
            thickness: given(0.01),
            ..RawBody::default()
        };
        let doc = Document { file: "", text: "" };
        for entry in SHAPES {
            let name = Spanned::new(0..0, entry.name.to_owned());
            let body = if entry.name == "elliptical-plate" {
                &plane
            } else {
                &all
            };
            let (doc, name) = (&doc, &name);
            let shape = (entry.read)(&Dimensions { doc, body, name }).unwrap();
            let written = write(&shape);
            assert_eq!(
                written.shape.as_ref().map(Spanned::get_ref),
                Some(name.get_ref())
            );
            assert_eq!(resolve(doc, &written, name).unwrap(), shape);
        }
    }
}
