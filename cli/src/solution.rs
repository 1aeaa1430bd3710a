//! A packed scene, before anything is written.

use sphpack_packing::{Fields, Packed, Problem, Quality};
use sphpack_separation::Labels;

/// A packed scene in its own dimension.
#[derive(Debug, Clone)]
pub struct Solution<const D: usize> {
    /// What was to be packed.
    pub problem: Problem<D>,
    /// All particles, and how they came there.
    pub packed: Packed<D>,
    /// Which belongs to what; frozen ones are labelled fluid.
    pub labels: Labels,
    /// Which of them roles and `fluid.fill` keep.
    pub keep: Vec<bool>,
    /// Γ and its gradient as the scene's quality settings ask; zero for frozen particles.
    pub fields: Fields<D>,
    /// The figures of these fields.
    pub quality: Quality,
}

/// A packed scene in the plane or in space.
#[derive(Debug, Clone)]
pub enum Packing {
    /// 2-D.
    Plane(Solution<2>),
    /// 3-D.
    Space(Solution<3>),
}

impl<const D: usize> Solution<D> {
    fn forget_columns(&mut self) {
        let particles = &mut self.packed.particles;
        particles.id = Vec::new();
        particles.position = Vec::new();
        particles.kind = Vec::new();
        particles.volume = Vec::new();
        particles.body = Vec::new();
        self.labels.side = Vec::new();
        self.labels.body = Vec::new();
        self.keep = Vec::new();
        self.fields.gamma = Vec::new();
        self.fields.gradient = Vec::new();
    }
}

impl Packing {
    /// Gives back the memory of what the table holds too, some 80 bytes of a particle: nothing but the problem and the figures is left.
    pub(crate) fn forget_columns(&mut self) {
        match self {
            Self::Plane(solution) => solution.forget_columns(),
            Self::Space(solution) => solution.forget_columns(),
        }
    }
}

impl From<Solution<2>> for Packing {
    fn from(solution: Solution<2>) -> Self {
        Self::Plane(solution)
    }
}

impl From<Solution<3>> for Packing {
    fn from(solution: Solution<3>) -> Self {
        Self::Space(solution)
    }
}
