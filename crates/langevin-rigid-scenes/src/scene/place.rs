//! Where in a scene file something is wrong.

use std::ops::{Range, RangeInclusive};

use langevin_rigid::choose;
use serde_spanned::Spanned;

use super::quantity::{Kind, Short};
use super::raw::Given;

/// A scene file that cannot be used: where, what, and how to mend it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SceneError {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong and what would be right.
    pub message: String,
    /// The line itself.
    pub source_line: String,
}

impl std::error::Error for SceneError {}

impl std::fmt::Display for SceneError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            file,
            line,
            column,
            message,
            source_line,
        } = self;
        writeln!(f, "{file}:{line}:{column}: {message}")?;
        let margin = " ".repeat(line.to_string().len());
        let pad = " ".repeat(column - 1);
        write!(f, "  {line} | {source_line}\n  {margin} | {pad}^")
    }
}

/// The text of a scene file, to find places in.
pub(super) struct Document<'a> {
    pub(super) file: &'a str,
    pub(super) text: &'a str,
}

impl Document<'_> {
    /// The error `message` at the beginning of `span`.
    pub(super) fn error(&self, span: Range<usize>, message: impl Into<String>) -> SceneError {
        let before = self.text.get(..span.start).unwrap_or(self.text);
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let source_line = self.text[line_start..].lines().next().unwrap_or("");
        SceneError {
            file: self.file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            message: printable(&message.into()),
            source_line: printable(source_line),
        }
    }

    /// A number within the range of its kind.
    pub(super) fn number(
        &self,
        value: &Spanned<f64>,
        key: &str,
        kind: Kind,
    ) -> Result<f64, SceneError> {
        let x = *value.get_ref();
        if kind.includes(x) {
            return Ok(x);
        }
        let message = format!("{} must be {kind}, and is {}", kind.named(key), Short(x));
        Err(self.error(value.span(), message))
    }

    /// The same where it is given.
    pub(super) fn given(
        &self,
        value: &Given<f64>,
        key: &str,
        kind: Kind,
    ) -> Result<Option<f64>, SceneError> {
        value
            .as_ref()
            .map(|v| self.number(v, key, kind))
            .transpose()
    }

    /// A whole number in a range.
    pub(super) fn count(
        &self,
        value: &Spanned<i64>,
        key: &str,
        range: RangeInclusive<u32>,
    ) -> Result<u32, SceneError> {
        let count = u32::try_from(*value.get_ref()).ok();
        count.filter(|n| range.contains(n)).ok_or_else(|| {
            let (least, most) = (range.start(), range.end());
            let message = format!("`{key}` must be a whole number between {least} and {most}");
            self.error(value.span(), message)
        })
    }

    /// So many values, no more and no fewer.
    pub(super) fn array<T: Clone, const N: usize>(
        &self,
        values: &Spanned<Vec<T>>,
        key: &str,
    ) -> Result<[T; N], SceneError> {
        let list = values.get_ref();
        list.clone().try_into().map_err(|_| {
            let message = format!("`{key}` takes {N} values, and has {}", list.len());
            self.error(values.span(), message)
        })
    }

    /// So many numbers, each within the range of their kind.
    pub(super) fn numbers<const N: usize>(
        &self,
        values: &Spanned<Vec<f64>>,
        key: &str,
        kind: Kind,
    ) -> Result<[f64; N], SceneError> {
        self.numbers_within(values, key, kind, 1.0)
    }

    /// The same where they may be so many times larger.
    fn numbers_within<const N: usize>(
        &self,
        values: &Spanned<Vec<f64>>,
        key: &str,
        kind: Kind,
        times: f64,
    ) -> Result<[f64; N], SceneError> {
        let numbers: [f64; N] = self.array(values, key)?;
        match numbers.iter().find(|x| !kind.includes(**x / times)) {
            None => Ok(numbers),
            Some(x) => {
                let what = kind.named(key);
                let message = format!("{what} must be numbers {kind}, and one is {}", Short(*x));
                Err(self.error(values.span(), message))
            }
        }
    }

    /// A vector of which the length, too, is within the range of its kind; zero if none.
    pub(super) fn vector(
        &self,
        value: &Given<Vec<f64>>,
        key: &str,
        kind: Kind,
    ) -> Result<[f64; 3], SceneError> {
        let Some(values) = value else {
            return Ok([0.0; 3]);
        };
        let vector = self.numbers_within(values, key, kind, ROUNDING)?;
        let length = length(&vector);
        if length <= kind.most * ROUNDING {
            return Ok(vector);
        }
        let (what, most) = (kind.named(key), Short(kind.most));
        let message = format!("{what} must be no longer than {most}, and is {length:e} long");
        Err(self.error(values.span(), message))
    }

    /// The choice of that name.
    pub(super) fn choose<T>(
        &self,
        what: &'static str,
        name: &Spanned<String>,
        choices: impl IntoIterator<Item = (&'static str, T)>,
    ) -> Result<T, SceneError> {
        choose(what, name.get_ref(), choices)
            .map_err(|unknown| self.error(name.span(), unknown.to_string()))
    }

    /// A name that parses into a choice.
    pub(super) fn name<T: std::str::FromStr>(
        &self,
        name: &Spanned<String>,
        key: &str,
    ) -> Result<T, SceneError>
    where
        T::Err: std::fmt::Display,
    {
        let choice = name.get_ref().parse();
        choice.map_err(|e: T::Err| self.error(name.span(), format!("`{key}`: {e}")))
    }
}

/// What turning a vector from one frame to another may make of its length.
const ROUNDING: f64 = 1.0 + 1e-9;

pub(super) fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Without characters that a terminal acts on; as long in characters as before.
fn printable(text: &str) -> String {
    let shown = |c: char| match c {
        '\t' => ' ',
        c if c.is_control() => char::REPLACEMENT_CHARACTER,
        c => c,
    };
    text.chars().map(shown).collect()
}
