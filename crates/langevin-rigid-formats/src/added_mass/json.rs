//! JSON for scripts: the report, and what its numbers mean.

use serde::Serialize;

use super::Report;
use super::statement::Statement;

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
/// [`serde_json::Error`], which these types never cause.
pub fn json(report: &Report) -> Result<String, serde_json::Error> {
    let conventions = Statement::new(report);
    let document = Document {
        report,
        conventions,
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}
