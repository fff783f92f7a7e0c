//! Tables for two readers: the page has them as HTML, the manual as Markdown.

/// A table as Markdown, and its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Its name: unique in its part, and that of its file.
    pub name: String,
    /// Head and rows, a line each.
    pub markdown: String,
}

impl Table {
    /// A table of plain words in its head and of HTML in its cells.
    ///
    /// Tags that Markdown has marks for become those, powers are written as in the manual (`64^3`, `2e-7`), and
    /// all others go.
    ///
    /// ```
    /// use langevin_rigid_report::Table;
    ///
    /// let rows = [vec!["<i>here</i>".to_owned(), "9\u{b7}10<sup>\u{2212}7</sup>".to_owned()]];
    /// let table = Table::new("main", &["where", "error"], &rows);
    /// assert_eq!(table.markdown, "| where | error |\n|---|---|\n| *here* | 9e-7 |\n");
    /// ```
    pub fn new(name: &str, head: &[&str], rows: &[Vec<String>]) -> Self {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let mut markdown = line(head.iter().map(|words| cell(words)).collect());
        markdown += &format!("|{}\n", "---|".repeat(head.len()));
        for row in rows {
            markdown += &line(row.iter().map(|html| cell(&text(html))).collect());
        }
        Self {
            name: name.to_owned(),
            markdown,
        }
    }
}

/// Words that stay in their cell.
fn cell(words: &str) -> String {
    words.replace('\n', " ").replace('|', "\\|")
}

/// HTML as Markdown.
fn text(html: &str) -> String {
    let mut text = String::new();
    let mut rest = html;
    while let Some((before, tagged)) = rest.split_once('<') {
        let (tag, after) = tagged.split_once('>').unwrap_or((tagged, ""));
        text += before;
        text += mark(tag);
        rest = after;
    }
    text += rest;
    // The ampersand last: what it escapes is no tag.
    for (html, plain) in [
        ("\u{b7}10^", "e"),
        ("\u{2212}", "-"),
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&amp;", "&"),
    ] {
        text = text.replace(html, plain);
    }
    text
}

/// What stands for a tag.
fn mark(tag: &str) -> &'static str {
    let name = tag.trim_start_matches('/');
    match name.split([' ', '/']).next().unwrap_or(name) {
        "i" | "em" => "*",
        "b" | "strong" => "**",
        "code" => "`",
        "br" => " ",
        "sup" if name == tag => "^",
        "sub" if name == tag => "_",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn html_becomes_markdown() {
        for (html, markdown) in [
            ("plain", "plain"),
            (
                r#"<data data-key="a.b" value="0.125">0.12</data> m"#,
                "0.12 m",
            ),
            ("\u{2212}1.5\u{b7}10<sup>\u{2212}7</sup>", "-1.5e-7"),
            ("64<sup>3</sup>, C<sub>0</sub>", "64^3, C_0"),
            ("a<br>b<br/>c", "a b c"),
            (
                "<i>separated</i> <b>and</b> <code>x</code>",
                "*separated* **and** `x`",
            ),
            (r#"1 <span class="note">[0, 2]</span>"#, "1 [0, 2]"),
            ("a &lt; b &amp;lt; c", "a < b &lt; c"),
        ] {
            assert_eq!(text(html), markdown);
        }
    }

    #[test]
    fn cells_stay_apart() {
        let rows = [vec!["|v|".to_owned(), "two\nlines".to_owned()]];
        let table = Table::new("bars", &["a|b", ""], &rows);
        assert_eq!(
            table.markdown,
            "| a\\|b |  |\n|---|---|\n| \\|v\\| | two lines |\n"
        );
    }
}
