//! The methods that a scene can name.

use serde::{Deserialize, Serialize};
use sphpack_kernels::KernelKind;
use sphpack_packing::Lattice;

/// How particles are settled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Surface first, counts balanced, then a minimiser.
    #[default]
    Balanced,
    /// Capture the surface, then settle by damped dynamics (001 §3.1).
    Hybrid,
    /// A solid of offset layers, fluid packed around it (001 §3.2).
    Standard,
    /// Inside and outside packed apart, then together (001 §3.3).
    Coupled,
    /// Bodies and fluid relaxed apart, bounded and confined (004 §2.1).
    Relaxation,
    /// The same, the fluid against the bodies' particles (004 §2.3).
    Complex,
    /// Stirred until the surface has its share (000).
    Agitated,
    /// Fluid between fixed walls (002).
    Ppa,
    /// The lattice clipped by the bodies (000 §3).
    Clipped,
    /// Bodies cut into triangles (000 §3).
    Triangulated,
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
    /// The dimensions it works in.
    pub dimensions: &'static [usize],
    /// Whether it minimises an energy by itself.
    pub minimises: bool,
    /// Its own kernel, and smoothing length over ∆s.
    pub kernel: (KernelKind, f64),
    /// The lattices that its paper starts from, in the plane and in space, instead of the one of least Γ.
    pub lattices: Option<[Lattice; 2]>,
    /// Whether a paper describes it.
    pub is_published: bool,
    /// Whether it fills solid bodies with particles; one that does not is for voids and containers.
    pub fills_bodies: bool,
    /// Whether all its particles have the box's volume together.
    pub fills_box: bool,
    /// How far from the lattice's Γ a particle's may be in a sound packing.
    pub gamma_within: f64,
    /// A line for people.
    pub summary: &'static str,
}

/// What most methods are.
const USUAL: MethodInfo = MethodInfo {
    method: Method::Balanced,
    name: "balanced",
    is_available: true,
    dimensions: &[2, 3],
    minimises: false,
    kernel: (KernelKind::Quintic, 1.2),
    lattices: None,
    is_published: true,
    fills_bodies: true,
    fills_box: true,
    gamma_within: 0.3,
    summary: "",
};

/// Every method that has a name.
pub const METHODS: [MethodInfo; 10] = [
    MethodInfo {
        minimises: true,
        is_published: false,
        gamma_within: 0.1,
        summary: "surface first, counts balanced, then a minimiser (the default)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Hybrid,
        name: "hybrid",
        summary: "captures the surface, then settles by damped dynamics (paper 001)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Standard,
        name: "standard",
        dimensions: &[2],
        fills_box: false,
        summary: "a solid of offset layers, fluid packed around it; 2-D (paper 001)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Coupled,
        name: "coupled",
        kernel: (KernelKind::Cubic, 1.0),
        lattices: Some([Lattice::Square, Lattice::SimpleCubic]),
        summary: "inside and outside packed apart, then together (paper 001)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Relaxation,
        name: "relaxation",
        kernel: (KernelKind::WendlandC2, 1.3),
        summary: "bodies and fluid relaxed apart, each within its surface (paper 004)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Complex,
        name: "complex",
        kernel: (KernelKind::WendlandC2, 1.3),
        summary: "bodies relaxed alone, the fluid against their particles (paper 004)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Agitated,
        name: "agitated",
        summary: "stirred by particles on circles until the surface has its share (paper 000)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Ppa,
        name: "ppa",
        fills_bodies: false,
        fills_box: false,
        summary: "fluid at rest between walls that never move, for containers (paper 002)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Clipped,
        name: "clipped",
        summary: "the lattice as it is, clipped by the bodies: what to compare with",
        ..USUAL
    },
    MethodInfo {
        method: Method::Triangulated,
        name: "triangulated",
        dimensions: &[2],
        fills_box: false,
        summary: "bodies cut into triangles that carry their area, not moved; 2-D: what to compare with",
        ..USUAL
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

    /// Its own kernel, and smoothing length over ∆s.
    pub fn kernel(self) -> (KernelKind, f64) {
        self.info().kernel
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
