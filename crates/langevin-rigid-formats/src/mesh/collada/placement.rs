//! Maps of nodes into their parents.

use super::super::ParseError;
use super::super::transform::Transform;
use super::document::{Document, Element, elements, fault};

/// The map of a node into its parent: its transformations, the first one outermost.
pub(super) fn of_node<'a>(
    document: &Document<'a>,
    node: Element<'a>,
) -> Result<Transform, ParseError> {
    let mut map = Transform::IDENTITY;
    for element in elements(node) {
        let one = match element.tag_name().name() {
            "matrix" => Transform::of_rows(&numbers(document, element)?),
            "translate" => Transform::of_parts(Some(numbers(document, element)?), None, None),
            "scale" => Transform::of_parts(None, None, Some(numbers(document, element)?)),
            "rotate" => rotation(document, element)?,
            "skew" => skew(document, element)?,
            "lookat" => {
                return Err(ParseError::Unsupported {
                    feature: "a node placed by `lookat`".to_owned(),
                    remedy: "apply its transformation before exporting",
                });
            }
            _ => continue,
        };
        map = map.after(&one);
    }
    Ok(map)
}

/// As many finite numbers as an element must have.
pub(super) fn numbers<'a, const N: usize>(
    document: &Document<'a>,
    element: Element<'a>,
) -> Result<[f64; N], ParseError> {
    document
        .finite(element)?
        .try_into()
        .map_err(|found: Vec<f64>| {
            fault(
                element,
                &format!("it has {} numbers instead of {N}", found.len()),
            )
        })
}

/// An axis and the angle around it in degrees.
fn rotation<'a>(document: &Document<'a>, element: Element<'a>) -> Result<Transform, ParseError> {
    let [x, y, z, degrees] = numbers(document, element)?;
    if degrees == 0.0 {
        return Ok(Transform::IDENTITY);
    }
    let [x, y, z] = direction(element, [x, y, z])?;
    let half = 0.5 * degrees.to_radians();
    let sin = libm::sin(half);
    let quaternion = [x * sin, y * sin, z * sin, libm::cos(half)];
    Ok(Transform::of_parts(None, Some(quaternion), None))
}

/// An angle in degrees by which the first axis leans towards the second.
fn skew<'a>(document: &Document<'a>, element: Element<'a>) -> Result<Transform, ParseError> {
    let [degrees, a, b, c, x, y, z] = numbers(document, element)?;
    let leaning = direction(element, [a, b, c])?;
    let towards = direction(element, [x, y, z])?;
    let slope = libm::tan(degrees.to_radians());
    let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
    let row = |i: usize| [0, 1, 2].map(|j| unit(i, j) + slope * towards[i] * leaning[j]);
    Ok(Transform::of_linear([0, 1, 2].map(row)))
}

fn direction(element: Element<'_>, axis: [f64; 3]) -> Result<[f64; 3], ParseError> {
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() {
        Ok(axis.map(|x| x / length))
    } else {
        Err(fault(element, "its axis has no direction"))
    }
}
