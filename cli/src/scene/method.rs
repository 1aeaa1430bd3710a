//! The methods that a scene can name.

use serde::{Deserialize, Serialize};

/// How particles are settled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Surface first, counts balanced, then a minimiser.
    #[default]
    Balanced,
    /// Capture the surface, then settle by damped dynamics (001 §3.1).
    Hybrid,
    /// Free particles against fixed boundary nodes (001 §3.2).
    Standard,
    /// Boundary and free particles in turn (001 §3.3).
    Coupled,
    /// Level-set relaxation with surface bounding (004).
    Relaxation,
    /// Relaxation of bodies and fluid together (004).
    Complex,
}

/// A line of the table of methods.
#[derive(Debug, Clone, Copy)]
pub struct MethodInfo {
    /// The method.
    pub method: Method,
    /// The name that scenes and reports use.
    pub name: &'static str,
    /// Whether this version has it.
    pub is_available: bool,
    /// A line for people.
    pub summary: &'static str,
}

/// Every method that has a name.
pub const METHODS: [MethodInfo; 6] = [
    MethodInfo {
        method: Method::Balanced,
        name: "balanced",
        is_available: true,
        summary: "surface first, counts balanced, then a minimiser (the default)",
    },
    MethodInfo {
        method: Method::Hybrid,
        name: "hybrid",
        is_available: true,
        summary: "captures the surface, then settles by damped dynamics (paper 001)",
    },
    MethodInfo {
        method: Method::Standard,
        name: "standard",
        is_available: false,
        summary: "free particles against fixed boundary nodes",
    },
    MethodInfo {
        method: Method::Coupled,
        name: "coupled",
        is_available: false,
        summary: "boundary and free particles in turn",
    },
    MethodInfo {
        method: Method::Relaxation,
        name: "relaxation",
        is_available: false,
        summary: "level-set relaxation with surface bounding",
    },
    MethodInfo {
        method: Method::Complex,
        name: "complex",
        is_available: false,
        summary: "relaxation of bodies and fluid together",
    },
];

impl Method {
    /// Its line in the table.
    pub fn info(self) -> &'static MethodInfo {
        METHODS
            .iter()
            .find(|info| info.method == self)
            .unwrap_or(&METHODS[0])
    }

    /// The name that scenes and reports use.
    pub fn name(self) -> &'static str {
        self.info().name
    }

    /// The method called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        METHODS
            .iter()
            .find(|info| info.name == name)
            .map(|info| info.method)
    }

    /// The names of the methods that this version has.
    pub fn available() -> Vec<&'static str> {
        METHODS
            .iter()
            .filter(|info| info.is_available)
            .map(|info| info.name)
            .collect()
    }
}
