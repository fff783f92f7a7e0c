//! Arrays of numbers, as accessors see them.

use super::super::ParseError;
use super::document::{Document, Element, children, fault, part, whole, words};

/// The columns of a source that have names, as many as asked for, of each item.
pub(super) fn columns<'a, const N: usize>(
    document: &Document<'a>,
    source: Element<'a>,
) -> Result<Vec<[f64; N]>, ParseError> {
    let accessor = accessor(source)?;
    let array = document.referred(accessor, "source", &["float_array"])?;
    let numbers = document.any(array)?;
    counted(array, numbers.len())?;
    let number = |name| whole(accessor, name);
    let count = number("count")?.unwrap_or(0);
    let (stride, offset) = (
        number("stride")?.unwrap_or(1),
        number("offset")?.unwrap_or(0),
    );
    let columns = named::<N>(accessor, stride)?;
    let last = columns.iter().max().copied().unwrap_or(0);
    let beyond = || {
        let reason = format!(
            "it reaches beyond the {} numbers of its array",
            numbers.len()
        );
        fault(accessor, &reason)
    };
    let Some(steps) = count.checked_sub(1) else {
        return Ok(Vec::new());
    };
    let end = steps
        .checked_mul(stride)
        .and_then(|n| n.checked_add(offset)?.checked_add(last));
    if last >= stride || end.is_none_or(|end| end >= numbers.len()) {
        return Err(beyond());
    }
    let item = |k: usize| columns.map(|column| numbers[offset + k * stride + column]);
    Ok((0..count).map(item).collect())
}

/// The names in a source, and whether they are ids.
pub(super) fn names<'a>(
    document: &Document<'a>,
    source: Element<'a>,
) -> Result<(Vec<&'a str>, bool), ParseError> {
    let array = document.referred(
        accessor(source)?,
        "source",
        &["Name_array", "IDREF_array", "SIDREF_array"],
    )?;
    let names: Vec<&str> = words(array).collect();
    counted(array, names.len())?;
    Ok((names, array.tag_name().name() == "IDREF_array"))
}

fn accessor(source: Element<'_>) -> Result<Element<'_>, ParseError> {
    part(part(source, "technique_common")?, "accessor")
}

/// Checks the number of items that an array says it has.
fn counted(array: Element<'_>, found: usize) -> Result<(), ParseError> {
    match whole(array, "count")? {
        Some(count) if count != found => {
            let reason = format!("it says {count} numbers or names and has {found}");
            Err(fault(array, &reason))
        }
        _ => Ok(()),
    }
}

/// Where in an item the first `N` numbers are whose parameters have a name; the first of all where there are no
/// parameters.
fn named<const N: usize>(accessor: Element<'_>, stride: usize) -> Result<[usize; N], ParseError> {
    let mut columns = Vec::new();
    let mut width = 0;
    for param in children(accessor, "param") {
        let numbers = match param.attribute("type") {
            Some("float4x4") => 16,
            _ => 1,
        };
        if param.attribute("name").is_some_and(|name| !name.is_empty()) {
            columns.extend(width..width + numbers);
        }
        width += numbers;
    }
    if columns.is_empty() {
        return Ok(std::array::from_fn(|k| k));
    }
    columns.truncate(N);
    let few = |_| {
        let reason = format!("its items of {stride} numbers have fewer than {N} with a name");
        fault(accessor, &reason)
    };
    columns.try_into().map_err(few)
}
