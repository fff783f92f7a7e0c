//! Text as it comes: its encoding, its lines and its numbers.

use std::borrow::Cow;

/// The text of a file, and what had to be done to get at it.
pub(super) struct Text<'a> {
    pub(super) text: Cow<'a, str>,
    pub(super) notices: Vec<String>,
}

/// Decodes UTF-8 and, after a byte order mark, UTF-16; a mark and NULs at the end go. What is no
/// character (names in other encodings) becomes a replacement character.
pub(super) fn decode(bytes: &[u8]) -> Text<'_> {
    let mut notices = Vec::new();
    let mut text = match bytes {
        [0xff, 0xfe, rest @ ..] => Cow::Owned(utf16(rest, u16::from_le_bytes)),
        [0xfe, 0xff, rest @ ..] => Cow::Owned(utf16(rest, u16::from_be_bytes)),
        [0xef, 0xbb, 0xbf, rest @ ..] => {
            notices.push("passed over the byte order mark at its beginning".to_owned());
            String::from_utf8_lossy(rest)
        }
        _ => String::from_utf8_lossy(bytes),
    };
    if is_utf16(bytes) {
        notices.push("read it as UTF-16, as its byte order mark says".to_owned());
    }
    let length = text.trim_end_matches('\0').len();
    if length < text.len() {
        notices.push(format!(
            "passed over {} zero bytes at its end",
            text.len() - length
        ));
        match &mut text {
            Cow::Borrowed(borrowed) => *borrowed = &borrowed[..length],
            Cow::Owned(owned) => owned.truncate(length),
        }
    }
    if text.contains('\r') && !text.contains('\n') {
        notices.push("took the carriage returns for ends of lines".to_owned());
    }
    Text { text, notices }
}

/// Whether the bytes begin with the byte order mark of UTF-16.
pub(super) fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff])
}

/// The bytes without the byte order mark of UTF-8.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(&[0xef, 0xbb, 0xbf]).unwrap_or(bytes)
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let (pairs, _) = bytes.as_chunks::<2>();
    let units = pairs.iter().map(|pair| unit(*pair));
    char::decode_utf16(units)
        .map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER))
        .collect()
}

/// The lines with their numbers, from 1, whether they end in LF, CR LF or CR.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let ended = text.strip_suffix('\n').unwrap_or(text);
    let unix = ended.split('\n');
    let all = unix.flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'));
    (1..).zip(all)
}

/// The words with the numbers of their lines, without comments.
pub(super) fn words(text: &str) -> impl Iterator<Item = (usize, &str)> {
    lines(text).flat_map(|(number, line)| {
        let words = without_comment(line).split_ascii_whitespace();
        words.map(move |word| (number, word))
    })
}

/// A line up to a `#`; one after a point belongs to a number that is none (`1.#IND`).
pub(super) fn without_comment(line: &str) -> &str {
    let begins = |&(at, _): &(usize, &str)| !line[..at].ends_with('.');
    let comment = line.match_indices('#').find(begins);
    comment.map_or(line, |(at, _)| &line[..at])
}

/// Reads numbers as programs write them, and remembers what it had to tolerate.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    fortran: Option<String>,
}

impl Numbers {
    /// A finite number.
    pub(super) fn finite(&mut self, word: &str) -> Result<f64, String> {
        let number = self.any(word)?;
        if number.is_finite() {
            Ok(number)
        } else {
            Err(format!(
                "`{word}` is not a number that a length can have: the program that wrote the file had none to give"
            ))
        }
    }

    /// A number, an infinity or none at all where the word says so.
    pub(super) fn any(&mut self, word: &str) -> Result<f64, String> {
        if let Ok(number) = word.parse() {
            return Ok(number);
        }
        if let Some(number) = fortran(word) {
            self.fortran.get_or_insert_with(|| word.to_owned());
            return Ok(number);
        }
        let hint = match word.replace(',', ".").parse::<f64>() {
            Ok(_) => ": write numbers with a decimal point, without commas",
            Err(_) => "",
        };
        let word: String = word.chars().take(40).collect();
        Err(format!("`{word}` is not a number{hint}"))
    }

    /// What was tolerated.
    pub(super) fn notice(self) -> Option<String> {
        let word = self.fortran?;
        Some(format!(
            "took the D of numbers such as `{word}` for an exponent"
        ))
    }
}

/// A number with the exponent letter of double precision in Fortran.
fn fortran(word: &str) -> Option<f64> {
    let (mantissa, exponent) = word.split_once(['d', 'D'])?;
    let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let is_exponent = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    is_exponent.then(|| format!("{mantissa}e{exponent}").parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_end_of_a_line_counts_once() {
        let numbered: Vec<_> = lines("a\nb\r\nc\rd\n\ne\r\n").collect();
        assert_eq!(
            numbered,
            [(1, "a"), (2, "b"), (3, "c"), (4, "d"), (5, ""), (6, "e")]
        );
    }

    #[test]
    fn numbers_are_read_or_refused_never_guessed() {
        let mut numbers = Numbers::default();
        for (word, value) in [
            ("1.0D+00", 1.0),
            ("-2.5d-3", -0.0025),
            ("1E2", 100.0),
            (".5", 0.5),
            ("5.", 5.0),
            ("+3", 3.0),
        ] {
            assert_eq!(numbers.finite(word), Ok(value));
        }
        for word in [
            "nan", "-inf", "1.#IND00", "-1.#IND", "1.#QNAN", "1.#INF", "1e999", "1,5", "0x10",
            "1D", "D5", "1d2d3", "", "--1", "infd1",
        ] {
            let error = numbers.finite(word).unwrap_err();
            assert!(error.contains("is not a number"), "{error}");
        }
        assert!(numbers.finite("1,5").unwrap_err().contains("decimal point"));
        assert!(numbers.notice().unwrap().contains("1.0D+00"));
    }

    #[test]
    fn comments_begin_where_they_should() {
        assert_eq!(without_comment("v 1 2 3 # three"), "v 1 2 3 ");
        assert_eq!(without_comment("f 1 2 3# three"), "f 1 2 3");
        assert_eq!(without_comment("v 1.#IND 2 -1.#J"), "v 1.#IND 2 -1.#J");
    }
}
