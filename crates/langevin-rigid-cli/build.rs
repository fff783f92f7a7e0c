//! Lists the files of the viewer's page for the program to embed: their names change with their content.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=page");
    let variable = |name| PathBuf::from(env::var_os(name).unwrap_or_default());
    let mut list = String::new();
    add(&variable("CARGO_MANIFEST_DIR").join("page"), "/", &mut list)?;
    fs::write(variable("OUT_DIR").join("page.rs"), format!("&[{list}]"))
}

/// Adds the files of a folder under the addresses they are served at.
fn add(folder: &Path, at: &str, list: &mut String) -> io::Result<()> {
    let mut entries: Vec<_> = fs::read_dir(folder)?.collect::<Result<_, _>>()?;
    // The same program from the same files.
    entries.sort_by_key(|entry| entry.file_name());
    for path in entries.iter().map(|entry| entry.path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let address = format!("{at}{name}");
        if path.is_dir() {
            add(&path, &format!("{address}/"), list)?;
        } else {
            // Writing to a string cannot fail.
            let _ = writeln!(list, "({address:?}, include_bytes!({path:?})),");
        }
    }
    Ok(())
}
