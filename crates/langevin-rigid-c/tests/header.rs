//! The committed header is that of the sources.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeSet;
use std::path::Path;

const HERE: &str = env!("CARGO_MANIFEST_DIR");
const HEADER: &str = "include/langevin_rigid.h";
/// In the order in which the header has them.
const SOURCES: [&str; 10] = [
    "version", "status", "vector", "body", "fluid", "settings", "state", "input", "loads",
    "stepper",
];

fn written() -> String {
    let here = Path::new(HERE);
    let config = cbindgen::Config::from_file(here.join("cbindgen.toml")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES.iter().chain(&["wind"]) {
        builder = builder.with_src(here.join(format!("src/{source}.rs")));
    }
    let mut text = Vec::new();
    builder.generate().unwrap().write(&mut text);
    String::from_utf8(text).unwrap()
}

#[test]
fn the_header_is_that_of_the_sources() {
    let path = Path::new(HERE).join(HEADER);
    let written = written();
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &written).unwrap();
    }
    let committed = std::fs::read_to_string(&path)
        .unwrap()
        .replace("\r\n", "\n");
    assert!(
        committed == written,
        "{HEADER} is not what the sources say; write it again: UPDATE=1 cargo test -p langevin-rigid-c --test header"
    );
}

/// Words that begin like names of the interface.
fn names(text: &str) -> BTreeSet<&str> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
        .filter(|word| word.starts_with("lr_") || word.starts_with("LR_"))
        .collect()
}

#[test]
fn the_header_has_every_function_of_the_sources() {
    let header = written();
    let declared = names(&header);
    for file in std::fs::read_dir(Path::new(HERE).join("src")).unwrap() {
        let source = std::fs::read_to_string(file.unwrap().path()).unwrap();
        for rest in source.split("extern \"C\" fn ").skip(1) {
            let name = rest.split('(').next().unwrap();
            assert!(declared.contains(name), "{name} is not in the header");
        }
    }
}
