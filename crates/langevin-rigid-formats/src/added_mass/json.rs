//! JSON for scripts: the report, and what its numbers mean.

use serde::Serialize;

use super::Report;
use super::statement::Statement;

/// Why a report cannot be written as JSON.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the added mass cannot be written as JSON: {message}")]
pub struct JsonError {
    /// What of it.
    pub message: String,
}

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    report: &'a Report,
    /// Stands for the comment that JSON lacks.
    conventions: Statement,
}

/// The report as JSON, with its conventions.
///
/// # Errors
///
/// [`JsonError`], which these types never cause.
pub fn json(report: &Report) -> Result<String, JsonError> {
    let conventions = Statement::new(report);
    let document = Document {
        report,
        conventions,
    };
    let text = serde_json::to_string_pretty(&document).map_err(|error| JsonError {
        message: error.to_string(),
    })?;
    Ok(text + "\n")
}
