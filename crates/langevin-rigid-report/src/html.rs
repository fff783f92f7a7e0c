//! The page: one file that needs nothing else.

use std::fmt::Write;

use crate::chart::escape;
use crate::section::Section;

const STYLE: &str = include_str!("style.css");

/// The whole page of the sections there are.
pub(crate) fn page(sections: &[Section], intro: &str, missing: &[&str]) -> String {
    let mut contents = String::new();
    let mut body = String::new();
    // Writing to a string cannot fail.
    for Section {
        id, title, html, ..
    } in sections
    {
        let title = escape(title);
        let _ = write!(contents, "<li><a href=\"#{id}\">{title}</a></li>");
        let _ = writeln!(
            body,
            "<section id=\"{id}\"><h2>{title}</h2>\n{html}</section>"
        );
    }
    let unfinished = if missing.is_empty() {
        String::new()
    } else {
        format!(
            "<p class=\"note\">Not finished: {}. Interrupted before.</p>",
            missing.join(", ")
        )
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <title>Langevin Rigid, reproduced</title><style>{STYLE}</style></head><body>\n\
         <h1>Langevin Rigid, reproduced</h1>\n{intro}\n{unfinished}<nav><ol>{contents}</ol></nav>\n\
         {}{body}</body></html>\n",
        claims(sections)
    )
}

/// What the paper says in words, and what comes of it.
fn claims(sections: &[Section]) -> String {
    let rows: String = sections
        .iter()
        .flat_map(|s| s.claims.iter().map(move |c| (s.id, c)))
        .map(|(id, claim)| {
            format!(
                "<tr><td><a href=\"#{id}\">{}</a></td><td>{}</td></tr>",
                claim.words, claim.verdict
            )
        })
        .collect();
    if rows.is_empty() {
        return rows;
    }
    format!(
        "<section id=\"claims\"><h2>What the paper says, as measured here</h2>\
         <div class=\"wide\"><table><thead><tr><th>The paper</th><th>Here</th></tr></thead>\
         <tbody>{rows}</tbody></table></div></section>\n"
    )
}
