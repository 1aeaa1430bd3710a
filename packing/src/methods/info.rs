//! What is known of a method before it runs.

use sphpack_kernels::KernelKind;

use crate::estimate::Work;
use crate::lattice::Lattice;

/// Which particles a method moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Moves {
    /// None: they stay where they are placed.
    Nothing,
    /// Those near surfaces, as far as its [`Band`](crate::Band) says.
    Band,
    /// All that are free.
    All,
}

/// What a method is for, what it costs, and what may be expected of what it packs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct MethodInfo {
    /// The name that scenes and reports use.
    pub name: &'static str,
    /// A line for people.
    pub summary: &'static str,
    /// The dimensions that it works in.
    pub dimensions: &'static [usize],
    /// Its own kernel.
    pub kernel: KernelKind,
    /// Its own smoothing length over ∆s.
    pub h_over_spacing: f64,
    /// The lattices that its paper starts from, in the plane and in space, instead of the one of least Γ.
    pub lattices: Option<[Lattice; 2]>,
    /// Whether a paper describes it.
    pub is_published: bool,
    /// What it moves.
    pub moves: Moves,
    /// Whether it minimises an energy by itself.
    pub minimises: bool,
    /// Whether it fills solid bodies with particles. One that does not is for voids and containers.
    pub fills_bodies: bool,
    /// Whether all its particles have the box's volume together.
    pub fills_box: bool,
    /// How far from the lattice's Γ a particle's may be in a sound packing.
    pub gamma_within: f64,
    /// What it does, as far as it decides about time and memory.
    pub work: Work,
}

/// Core-seconds of a particle where sites are chosen by their depths: 5 … 14 µs.
pub(crate) const CHOOSING: f64 = 1e-5;

impl MethodInfo {
    /// What most published methods are. 800 … 4,550 evaluations brought discs, squares, a ball and a box of 250 … 1,200
    /// particles among 1,000 … 4,900 to rest by the method hybrid. Those of other methods are of the same scenes.
    pub(crate) const USUAL: Self = Self {
        name: "",
        summary: "",
        dimensions: &[2, 3],
        kernel: KernelKind::Quintic,
        h_over_spacing: 1.2,
        lattices: None,
        is_published: true,
        moves: Moves::All,
        minimises: false,
        fills_bodies: true,
        fills_box: true,
        gamma_within: 0.3,
        work: Work {
            evaluations: 2500.0,
            ..Work::PLAIN
        },
    };
}
