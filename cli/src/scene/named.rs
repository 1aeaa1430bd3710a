//! Kernels, lattices and insets as scenes write them.

use std::fmt;

use serde::de::{Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use sphpack_kernels::KernelKind;
use sphpack_packing::problem::DEFAULT_INSET_OVER_SPACING;
use sphpack_packing::{Lattice, MinimiserKind};

use super::nearest::advice;

/// Kernels by name, or none.
pub(super) mod optional_kernel {
    use super::*;

    pub(in crate::scene) fn serialize<S: Serializer>(
        kernel: &Option<KernelKind>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        kernel.map(KernelKind::name).serialize(to)
    }

    pub(in crate::scene) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<KernelKind>, D::Error> {
        kernel_by_name(&String::deserialize(from)?)
            .map(Some)
            .map_err(D::Error::custom)
    }
}

/// Minimisers by name, or none.
pub(super) mod minimiser {
    use super::*;

    pub(in crate::scene) fn serialize<S: Serializer>(
        minimiser: &Option<MinimiserKind>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        minimiser.map(MinimiserKind::name).serialize(to)
    }

    pub(in crate::scene) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<MinimiserKind>, D::Error> {
        let name = String::deserialize(from)?;
        name.parse().map(Some).map_err(|_| {
            let known = MinimiserKind::ALL.map(MinimiserKind::name);
            D::Error::custom(format!(
                "no minimiser is called \"{name}\"; {}",
                advice(&name, &known)
            ))
        })
    }
}

/// Lattices by name, or "auto".
pub(super) mod lattice {
    use super::*;

    pub(in crate::scene) fn serialize<S: Serializer>(
        lattice: &Option<Lattice>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.serialize_str(lattice.map_or("auto", Lattice::name))
    }

    pub(in crate::scene) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<Lattice>, D::Error> {
        let name = String::deserialize(from)?;
        if name == "auto" {
            return Ok(None);
        }
        name.parse().map(Some).map_err(|_| {
            let mut known = vec!["auto"];
            known.extend(Lattice::ALL.map(Lattice::name));
            D::Error::custom(format!(
                "no lattice is called \"{name}\"; {}",
                advice(&name, &known)
            ))
        })
    }
}

/// The kernel called `name`, or a message with the nearest known name.
pub(crate) fn kernel_by_name(name: &str) -> Result<KernelKind, String> {
    name.parse().map_err(|_| {
        let known = KernelKind::ALL.map(KernelKind::name);
        format!("no kernel is called \"{name}\"; {}", advice(name, &known))
    })
}

/// How far inside a true surface its boundary particles sit: `"inset"` (∆s/2), `"exact"` (0), or a number of ∆s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inset(
    /// In ∆s.
    pub f64,
);

impl Default for Inset {
    fn default() -> Self {
        Self(DEFAULT_INSET_OVER_SPACING)
    }
}

impl Serialize for Inset {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.0 == DEFAULT_INSET_OVER_SPACING {
            to.serialize_str("inset")
        } else if self.0 == 0.0 {
            to.serialize_str("exact")
        } else {
            to.serialize_f64(self.0)
        }
    }
}

impl<'de> Deserialize<'de> for Inset {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct WordOrNumber;

        impl Visitor<'_> for WordOrNumber {
            type Value = Inset;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"inset\", \"exact\" or a number (the inset in spacings)")
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<Inset, E> {
                match word {
                    "inset" => Ok(Inset::default()),
                    "exact" => Ok(Inset(0.0)),
                    _ => Err(E::invalid_value(Unexpected::Str(word), &self)),
                }
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Inset, E> {
                Ok(Inset(number))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Inset, E> {
                Ok(Inset(number as f64))
            }
        }

        from.deserialize_any(WordOrNumber)
    }
}
