//! The methods that a scene can name.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use sphpack_kernels::KernelKind;
use sphpack_packing::{Lattice, Work};

use super::advice;

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
    /// What it does, as far as it decides about time and memory.
    pub work: Work,
    /// A line for people.
    pub summary: &'static str,
}

/// What most methods do: 800 … 4,550 evaluations brought discs, squares, a ball and a box of 250 … 1,200 particles
/// among 1,000 … 4,900 to rest by the method hybrid. Those of other methods are of the same scenes.
const DAMPED: Work = Work {
    evaluations: 2500.0,
    ..Work::PLAIN
};

/// Core-seconds of a particle where sites are chosen by their depths: 5 … 14 µs.
const CHOOSING: f64 = 1e-5;

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
    work: DAMPED,
    summary: "",
};

/// Every method that has a name.
pub const METHODS: [MethodInfo; 10] = [
    MethodInfo {
        minimises: true,
        is_published: false,
        gamma_within: 0.1,
        // 64 … 131 evaluations, each with a second sum that levels; ten pairs of L-BFGS in single precision, and its
        // vectors. 110 µs for a point of a sphere's surface that is spread evenly.
        work: Work {
            evaluations: 80.0,
            times_plain: 1.3,
            bytes: [160.0, 240.0],
            placing: CHOOSING,
            sampling: [1e-5, 1.1e-4],
            ..DAMPED
        },
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
        // 650 … 1,700 evaluations.
        work: Work {
            evaluations: 1200.0,
            ..DAMPED
        },
        summary: "a solid of offset layers, fluid packed around it; 2-D (paper 001)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Coupled,
        name: "coupled",
        kernel: (KernelKind::Cubic, 1.0),
        lattices: Some([Lattice::Square, Lattice::SimpleCubic]),
        // Twice 5,000 iterations of one side with two sums each, then 2,750 … 20,000 of all with one.
        work: Work {
            evaluations: 10_000.0,
            before: 10_000.0,
            lists: 2.0,
            ..DAMPED
        },
        summary: "inside and outside packed apart, then together (paper 001)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Relaxation,
        name: "relaxation",
        kernel: (KernelKind::WendlandC2, 1.3),
        // 560 … 2,440 iterations. Both sides of every surface are confined.
        work: Work {
            evaluations: 1500.0,
            confined_sides: 2.0,
            placing: CHOOSING,
            ..DAMPED
        },
        summary: "bodies and fluid relaxed apart, each within its surface (paper 004)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Complex,
        name: "complex",
        kernel: (KernelKind::WendlandC2, 1.3),
        // As many as relaxation, then as many that level, of two smoothing lengths with two sums each: three times as
        // long.
        work: Work {
            evaluations: 1500.0,
            times_plain: 4.0,
            confined_sides: 1.0,
            placing: CHOOSING,
            ..DAMPED
        },
        summary: "bodies relaxed alone, the fluid against their particles (paper 004)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Agitated,
        name: "agitated",
        // 3,200 … 7,850 iterations, a third of their time the repulsion, whose lists, one for each particle, took 350
        // … 720 bytes in space.
        work: Work {
            evaluations: 5000.0,
            times_plain: 1.5,
            bytes: [150.0, 500.0],
            ..DAMPED
        },
        summary: "stirred by particles on circles until the surface has its share (paper 000)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Ppa,
        name: "ppa",
        fills_bodies: false,
        fills_box: false,
        // 1,800 … 2,550 iterations; fast particles need new lists more often.
        work: Work {
            evaluations: 2200.0,
            times_plain: 1.25,
            bytes: [120.0, 180.0],
            placing: CHOOSING,
            ..DAMPED
        },
        summary: "fluid at rest between walls that never move, for containers (paper 002)",
        ..USUAL
    },
    MethodInfo {
        method: Method::Clipped,
        name: "clipped",
        work: Work::PLAIN,
        summary: "the lattice as it is, clipped by the bodies: what to compare with",
        ..USUAL
    },
    MethodInfo {
        method: Method::Triangulated,
        name: "triangulated",
        dimensions: &[2],
        fills_box: false,
        work: Work::PLAIN,
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

    /// The names of the methods that this version has.
    pub fn available() -> Vec<&'static str> {
        METHODS
            .iter()
            .filter(|info| info.is_available)
            .map(|info| info.name)
            .collect()
    }
}

/// A method's name that is none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownMethod(
    /// The name that was asked for.
    pub String,
);

impl fmt::Display for UnknownMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = METHODS.map(|info| info.name);
        let advice = advice(&self.0, &known);
        write!(f, "no method is called \"{}\"; {advice}", self.0)
    }
}

impl std::error::Error for UnknownMethod {}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        METHODS
            .iter()
            .find(|info| info.name == name)
            .map(|info| info.method)
            .ok_or_else(|| UnknownMethod(name.to_owned()))
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
