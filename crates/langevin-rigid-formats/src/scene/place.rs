//! Where in a scene file something is wrong.

use std::ops::Range;

use serde_spanned::Spanned;

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
        let source_line = self.text[line_start..]
            .lines()
            .next()
            .unwrap_or("")
            .to_owned();
        SceneError {
            file: self.file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            message: message.into(),
            source_line,
        }
    }

    /// A number that must be positive; `what` names it with its unit.
    pub(super) fn positive(&self, value: &Spanned<f64>, what: &str) -> Result<f64, SceneError> {
        self.check(
            value,
            |x| x > 0.0 && x.is_finite(),
            || format!("{what} must be a positive number"),
        )
    }

    /// A number that must be finite.
    pub(super) fn finite(&self, value: &Spanned<f64>, what: &str) -> Result<f64, SceneError> {
        self.check(value, f64::is_finite, || {
            format!("{what} must be a finite number")
        })
    }

    /// Numbers that must all be finite.
    pub(super) fn finite_all<const N: usize>(
        &self,
        values: &Spanned<[f64; N]>,
        what: &str,
    ) -> Result<[f64; N], SceneError> {
        let all = values.get_ref();
        match all.iter().all(|x| x.is_finite()) {
            true => Ok(*all),
            false => Err(self.error(values.span(), format!("{what} must be finite numbers"))),
        }
    }

    /// A name that parses into a choice.
    pub(super) fn name<T: std::str::FromStr>(&self, name: &Spanned<String>) -> Result<T, SceneError>
    where
        T::Err: std::fmt::Display,
    {
        name.get_ref()
            .parse()
            .map_err(|e: T::Err| self.error(name.span(), e.to_string()))
    }

    fn check(
        &self,
        value: &Spanned<f64>,
        good: impl Fn(f64) -> bool,
        message: impl Fn() -> String,
    ) -> Result<f64, SceneError> {
        let x = *value.get_ref();
        match good(x) {
            true => Ok(x),
            false => Err(self.error(value.span(), format!("{}, and is {x}", message()))),
        }
    }
}
