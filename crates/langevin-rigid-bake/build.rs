//! Hashes the sources that bakes depend on: bakes of other code are not taken for ours.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// Our own sources and, in the workspace, those of the run time. A package of the run time lies elsewhere; it has our
/// own version, which names its sources.
const SOURCES: [&str; 2] = ["src", "../langevin-rigid/src"];

fn main() -> std::io::Result<()> {
    let mut hash = Sha256::new();
    hash.update(env!("CARGO_PKG_VERSION"));
    for root in SOURCES.map(Path::new).into_iter().filter(|r| r.is_dir()) {
        println!("cargo::rerun-if-changed={}", root.display());
        let mut files = Vec::new();
        collect(root, &mut files)?;
        files.sort();
        for file in files {
            let content = std::fs::read(&file)?;
            // Checked out with other line ends it is the same code.
            let content: Vec<u8> = content.into_iter().filter(|b| *b != b'\r').collect();
            hash.update(file.to_string_lossy().replace('\\', "/"));
            hash.update((content.len() as u64).to_le_bytes());
            hash.update(content);
        }
    }
    let hash: String = hash.finalize().iter().map(|b| format!("{b:02x}")).collect();
    println!("cargo::rustc-env=LANGEVIN_RIGID_SOURCES={hash}");
    Ok(())
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, files)?;
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    Ok(())
}
