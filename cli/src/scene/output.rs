//! What is written, of what was packed.

use serde::{Deserialize, Serialize};
use sphpack_packing::Kind;

/// What is written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct OutputSpec {
    /// Names of the kinds of particles in the files.
    #[cfg_attr(feature = "schema", schemars(schema_with = "super::schema::kinds"))]
    pub include: Vec<String>,
    /// A larger box that the files fill around the domain, on the lattice that the frozen particles begin (Negi &
    /// Ramachandran 2021, fig. 3).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surroundings: Option<Surroundings>,
}

/// A box around the domain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Surroundings {
    /// Lower corner, scene units.
    pub min: Vec<f64>,
    /// Upper corner, scene units.
    pub max: Vec<f64>,
}

impl Default for OutputSpec {
    fn default() -> Self {
        Self {
            include: (Kind::ALL.iter())
                .filter(|&&kind| kind != Kind::Frozen)
                .map(|kind| kind.name().to_owned())
                .collect(),
            surroundings: None,
        }
    }
}
