//! Choices in files by the names that scenes write.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::settings::{Integrator, Model};
use crate::turbulence::TurbulenceSource;

macro_rules! by_name {
    ($($choice:ty),*) => {$(
        impl Serialize for $choice {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        impl<'de> Deserialize<'de> for $choice {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
            }
        }
    )*};
}

by_name!(Model, Integrator, TurbulenceSource);
