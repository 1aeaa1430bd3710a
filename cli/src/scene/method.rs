//! The methods that a scene can name.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use sphpack_packing::{
    Agitated, Balanced, Clipped, Complex, Coupled, Hybrid, MethodInfo, Ppa, Relaxation, Standard,
    Triangulated,
};

use super::advice;

/// How particles are settled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Surface first, counts balanced, then a minimiser.
    #[default]
    Balanced,
    /// Capture the surface, then settle by damped dynamics (Negi & Ramachandran 2021, §3.1).
    Hybrid,
    /// A solid of offset layers, fluid packed around it (Negi & Ramachandran 2021, §3.2).
    Standard,
    /// Inside and outside packed apart, then together (Negi & Ramachandran 2021, §3.3).
    Coupled,
    /// Bodies and fluid relaxed apart, bounded and confined (Zhao et al. 2025, §2.1).
    Relaxation,
    /// The same, the fluid against the bodies' particles (Zhao et al. 2025, §2.3).
    Complex,
    /// Stirred until the surface has its share (Negi & Ramachandran preprint).
    Agitated,
    /// Fluid between fixed walls (Bouscasse et al.).
    Ppa,
    /// The lattice clipped by the bodies (Negi & Ramachandran preprint, §3).
    Clipped,
    /// Bodies cut into triangles (Negi & Ramachandran preprint, §3).
    Triangulated,
    /// What the chart of speed against accuracy has for the scene's `accuracy`: settings are picked before anything is packed.
    Auto,
}

impl Method {
    /// Every method that packs, the default first.
    pub const ALL: [Self; 10] = [
        Self::Balanced,
        Self::Hybrid,
        Self::Standard,
        Self::Coupled,
        Self::Relaxation,
        Self::Complex,
        Self::Agitated,
        Self::Ppa,
        Self::Clipped,
        Self::Triangulated,
    ];

    /// What it costs, moves and promises; of "auto", what the default does, until settings are picked.
    pub fn info(self) -> &'static MethodInfo {
        match self {
            Self::Balanced | Self::Auto => &Balanced::INFO,
            Self::Hybrid => &Hybrid::INFO,
            Self::Standard => &Standard::INFO,
            Self::Coupled => &Coupled::INFO,
            Self::Relaxation => &Relaxation::INFO,
            Self::Complex => &Complex::INFO,
            Self::Agitated => &Agitated::INFO,
            Self::Ppa => &Ppa::INFO,
            Self::Clipped => &Clipped::INFO,
            Self::Triangulated => &Triangulated::INFO,
        }
    }

    /// The name that scenes and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => AUTO,
            packs => packs.info().name,
        }
    }

    /// Whether a scene may have what only the method balanced has: that is what is picked for "auto".
    pub(crate) fn may_be_balanced(self) -> bool {
        matches!(self, Self::Balanced | Self::Auto)
    }
}

/// The name of the method that picks.
const AUTO: &str = "auto";

/// A method's name that is none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownMethod(
    /// The name that was asked for.
    pub String,
);

impl fmt::Display for UnknownMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = Method::ALL.into_iter().chain([Method::Auto]);
        let known: Vec<&str> = known.map(Method::name).collect();
        let advice = advice(&self.0, &known);
        write!(f, "no method is called \"{}\"; {advice}", self.0)
    }
}

impl std::error::Error for UnknownMethod {}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        (Self::ALL.into_iter())
            .chain([Self::Auto])
            .find(|method| method.name() == name)
            .ok_or_else(|| UnknownMethod(name.to_owned()))
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
