//! A section of the report: words, numbers, pictures, and the raw data beside them.

use std::fmt::Write;

use langevin_rigid_pictures::Picture;

use crate::chart::{Chart, escape};
use crate::data_uri::png_uri;
use crate::error::ReportError;
use crate::numbers::{Numbers, Quoted};
use crate::table::Table;

/// One result of the paper, computed again.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Its name: the folder of its data, and its place in the page.
    pub id: &'static str,
    /// Its heading.
    pub title: String,
    /// Its body.
    pub html: String,
    /// All numbers of its body.
    pub numbers: Numbers,
    /// Its data: names and contents of files.
    pub files: Vec<(String, Vec<u8>)>,
    /// Its tables, which are data as well: NAME.md.
    pub tables: Vec<Table>,
    /// What the paper says in words.
    pub claims: Vec<Claim>,
}

/// A statement of the paper, and what the runs say of it; both as HTML.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// What the paper says.
    pub words: String,
    /// Under which readings it is reproduced, partly, or not.
    pub verdict: String,
}

impl Section {
    pub(crate) fn new(id: &'static str, title: &str) -> Self {
        Self {
            id,
            title: title.to_owned(),
            html: String::new(),
            numbers: Numbers::default(),
            files: Vec::new(),
            tables: Vec::new(),
            claims: Vec::new(),
        }
    }

    /// A number to be shown; its key is unique in the whole report.
    pub(crate) fn quote(&mut self, key: impl AsRef<str>, value: f64, digits: usize) -> Quoted {
        let key = format!("{}.{}", self.id, key.as_ref());
        self.numbers.quote(key, value, digits)
    }

    /// A paragraph of HTML.
    pub(crate) fn text(&mut self, html: impl AsRef<str>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.html, "<p>{}</p>", html.as_ref());
    }

    /// Words of the paper, and where they are.
    pub(crate) fn paper(&mut self, words: &str, place: &str) {
        let (words, place) = (escape(words), escape(place));
        let _ = writeln!(
            self.html,
            "<blockquote>\u{201c}{words}\u{201d} ({place})</blockquote>"
        );
    }

    pub(crate) fn heading(&mut self, words: &str) {
        let _ = writeln!(self.html, "<h3>{}</h3>", escape(words));
    }

    /// A statement and its verdict, also for the summary at the head of the page.
    pub(crate) fn claim(&mut self, claim: Claim) {
        self.text(format!("<b>{}</b> {}", claim.words, claim.verdict));
        self.claims.push(claim);
    }

    /// A table; cells are HTML. It is kept with the data as `name`.md.
    pub(crate) fn table(&mut self, name: &str, head: &[&str], rows: &[Vec<String>]) {
        self.tables.push(Table::new(name, head, rows));
        let cells = |tag: &str, cells: &[String]| -> String {
            let cell = |c: &String| format!("<{tag}>{c}</{tag}>");
            let row: String = cells.iter().map(cell).collect();
            format!("<tr>{row}</tr>")
        };
        let head: Vec<String> = head.iter().map(|h| escape(h)).collect();
        let body: String = rows.iter().map(|r| cells("td", r)).collect();
        let head = cells("th", &head);
        let _ = writeln!(
            self.html,
            "<div class=\"wide\"><table><thead>{head}</thead><tbody>{body}</tbody></table></div>"
        );
    }

    /// Pictures or charts side by side, under each other on narrow screens.
    pub(crate) fn row(&mut self, figures: &[String]) {
        let _ = writeln!(self.html, "<div class=\"pair\">{}</div>", figures.concat());
    }

    /// A picture as a figure; the file `name`.png is kept with the data.
    pub(crate) fn picture(
        &mut self,
        name: &str,
        picture: &Picture,
        caption: &str,
    ) -> Result<String, ReportError> {
        let png = picture.png()?;
        let figure = format!(
            "<figure><img id=\"{}-{name}\" src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">\
             <figcaption>{caption}</figcaption></figure>\n",
            self.id,
            png_uri(&png),
            picture.width(),
            picture.height(),
            escape(&format!("The body along its path: {name}")),
        );
        self.files.push((format!("{name}.png"), png));
        Ok(figure)
    }

    /// A file of data.
    pub(crate) fn file(&mut self, name: impl Into<String>, text: String) {
        self.files.push((name.into(), text.into_bytes()));
    }
}

/// A chart as a figure.
pub(crate) fn figure(chart: &Chart, caption: &str) -> String {
    format!(
        "<figure>{}<figcaption>{caption}</figcaption></figure>\n",
        chart.svg()
    )
}
