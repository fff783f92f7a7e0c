//! The seed of the noise in a scene file.
//!
//! Whole numbers of TOML end at 2^63 - 1, seeds at 2^64 - 1: those beyond stand in quotes.

use std::fmt;

use serde::de::{Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A seed as it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Seed(pub(super) u64);

impl Serialize for Seed {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match i64::try_from(self.0) {
            Ok(number) => serializer.serialize_i64(number),
            Err(_) => serializer.serialize_str(&self.0.to_string()),
        }
    }
}

impl<'de> Deserialize<'de> for Seed {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SeedVisitor)
    }
}

struct SeedVisitor;

impl Visitor<'_> for SeedVisitor {
    type Value = Seed;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "a `seed`: a whole number from 0 to 18446744073709551615, in quotes from \
             9223372036854775808 on",
        )
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Seed, E> {
        let seed = u64::try_from(number).map(Seed);
        seed.map_err(|_| E::invalid_value(Unexpected::Signed(number), &self))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Seed, E> {
        Ok(Seed(number))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Seed, E> {
        let seed = text.parse().map(Seed);
        seed.map_err(|_| E::invalid_value(Unexpected::Str(text), &self))
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;

    fn parsed(seed: &str) -> Result<Scene, crate::scene::SceneError> {
        let text = format!(
            "fluid.preset = \"water\"\nbody = {{ shape = \"box\", size = [1, 1, 1], mass = 3 }}\n\
             run = {{ time_step = 0.1, duration = 1, seed = {seed} }}\n"
        );
        Scene::parse("box", "box.toml", &text)
    }

    #[test]
    fn every_seed_is_written_and_read_as_itself() {
        for seed in [0, 1, (1 << 63) - 1, 1 << 63, u64::MAX - 1, u64::MAX] {
            let scene = parsed(&format!("\"{seed}\"")).unwrap();
            assert_eq!(scene.seed, seed);
            let written = scene.to_toml().unwrap();
            assert_eq!(Scene::parse("box", "again", &written).unwrap(), scene);
        }
        assert_eq!(parsed("7").unwrap().seed, 7);
        assert_eq!(parsed("18446744073709551615").unwrap().seed, u64::MAX);
    }

    #[test]
    fn what_is_no_seed_is_refused_at_its_place() {
        for bad in [
            "-1",
            "1.5",
            "\"-1\"",
            "\"18446744073709551616\"",
            "\"\"",
            "[1]",
            "true",
        ] {
            let error = parsed(bad).unwrap_err();
            assert_eq!((error.line, error.column), (3, 47), "{error}");
            assert!(error.message.contains("`seed`"), "{error}");
        }
    }
}
