//! Files beside the file that is read, and no others.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The first `length` bytes of a file named relative to the folder, which it must not leave; all of them if none.
pub(super) fn read(
    uri: &str,
    length: Option<usize>,
    folder: Option<&Path>,
) -> Result<Vec<u8>, String> {
    let folder = folder.ok_or("the folder of the file is not known")?;
    let name = name(uri).ok_or("only names of files in its folder are read")?;
    let path = confined(folder, &name)?;
    let failed = |error: std::io::Error| error.to_string();
    // Opening a pipe would wait for its other end.
    let metadata = std::fs::metadata(&path).map_err(failed)?;
    if !metadata.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    let length = length.map_or(metadata.len(), |length| length as u64);
    if metadata.len() < length {
        return Err(format!("{} bytes instead of {length}", metadata.len()));
    }
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    let file = File::open(&path).map_err(failed)?;
    file.take(length).read_to_end(&mut bytes).map_err(failed)?;
    Ok(bytes)
}

/// The real path of a file, if it is below the folder once links are followed.
fn confined(folder: &Path, name: &Path) -> Result<PathBuf, String> {
    // The parent of a bare file name is the empty path.
    let folder = Path::new(".").join(folder);
    let failed = |error: std::io::Error| error.to_string();
    let path = folder.join(name).canonicalize().map_err(failed)?;
    if path.starts_with(folder.canonicalize().map_err(failed)?) {
        Ok(path)
    } else {
        Err("it is a link out of the folder".to_owned())
    }
}

/// A relative path downward, on every system: its parts may not hold what separates parts, drives or
/// streams on one of them, not even percent-encoded.
fn name(uri: &str) -> Option<PathBuf> {
    uri.split('/').map(part).collect()
}

fn part(encoded: &str) -> Option<String> {
    let part = percent_decoded(encoded)?;
    let forbidden = |c: char| matches!(c, '/' | '\\' | ':' | '\0');
    (!part.is_empty() && part != ".." && !part.contains(forbidden)).then_some(part)
}

fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        if first == b'%' {
            let hex = std::str::from_utf8(tail.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(hex, 16).ok()?);
            rest = &tail[2..];
        } else {
            bytes.push(first);
            rest = tail;
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_percent_decoded() {
        assert_eq!(
            percent_decoded("a%20b%C3%A9.bin").as_deref(),
            Some("a bé.bin")
        );
        assert_eq!(percent_decoded("a%2"), None);
        assert_eq!(percent_decoded("a%zz"), None);
    }

    #[test]
    fn names_lead_downward_only() {
        assert_eq!(name("a/b%20c.bin"), Some(PathBuf::from("a/b c.bin")));
        assert_eq!(name("./a.bin"), Some(PathBuf::from("./a.bin")));
        for uri in [
            "",
            "/etc/passwd",
            "../a",
            "a/../../b",
            "%2e%2e/a",
            "a%2F..%2Fb",
            "%2Fetc",
            "a\\b",
            "a%5Cb",
            "C:/a",
            "C%3A/a",
            "c:a",
            "file:///a",
            "http://host/a",
            "//host/a",
            "a%00",
            "a.bin:stream",
        ] {
            assert_eq!(name(uri), None, "{uri}");
        }
    }
}
