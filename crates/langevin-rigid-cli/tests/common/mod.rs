//! A place of its own for each test, and the command in it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![allow(dead_code, unreachable_pub, reason = "each test takes what it needs")]

use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

/// A place of its own for results and bakes.
pub struct Place(pub tempfile::TempDir);

impl Place {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: &str) -> String {
        std::fs::write(self.path(name), content).unwrap();
        self.path(name).display().to_string()
    }

    pub fn run(&self, arguments: &[&str]) -> Outcome {
        let output = Command::cargo_bin("langevin-rigid")
            .unwrap()
            .current_dir(self.0.path())
            .env("LANGEVIN_RIGID_CACHE", self.path("cache"))
            .args(arguments)
            .output()
            .unwrap();
        Outcome {
            code: output.status.code().unwrap(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

pub struct Outcome {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Outcome {
    pub fn json(&self) -> Value {
        assert_eq!(self.code, 0, "{}", self.err);
        serde_json::from_str(&self.out).unwrap()
    }

    /// Failed with code 1 and an error that contains every word.
    pub fn fails_with(&self, words: &[&str]) {
        assert_eq!(self.code, 1, "{}", self.out);
        assert!(
            self.err.lines().any(|l| l.starts_with("error: ")),
            "{}",
            self.err
        );
        for word in words {
            assert!(self.err.contains(word), "`{word}` is not in: {}", self.err);
        }
    }
}

pub fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

/// A small scene in water.
pub fn scene(body: &str, run: &str) -> String {
    format!("[fluid]\npreset = \"water\"\n[body]\n{body}\n[run]\ntime_step = 0.005\n{run}\n")
}

pub const BALL: &str =
    "shape = \"ellipsoid\"\nsemi_axes = [0.01, 0.01, 0.02]\ntriangles = 80\ndensity = 1500.0";
