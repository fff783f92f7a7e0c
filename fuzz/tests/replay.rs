//! Every input that is kept, once more: what fuzzing found new ways through the code with, and what failed.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

use langevin_rigid_fuzz::{TARGETS, Target};

/// The files of a target in one of the folders of this crate; none where there is no such folder.
fn inputs(folder: &str, target: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join(folder)
        .join(target);
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn passes(target: Target, file: &Path) -> bool {
    let bytes = std::fs::read(file).unwrap();
    catch_unwind(|| target.run(&bytes)).is_ok()
}

// One test, since the limits of time and memory are those of the process.
#[test]
fn every_kept_input_passes() {
    let mut failures = Vec::new();
    for target in TARGETS {
        let files = [
            inputs("corpus", target.name),
            inputs("crashes", target.name),
        ]
        .concat();
        assert!(!files.is_empty(), "the corpus of {} is gone", target.name);
        println!("{}: {} inputs", target.name, files.len());
        failures.extend(files.into_iter().filter(|file| !passes(target, file)));
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
