//! Minimisers: three ways down the same energy.
//!
//! | name | what it does | source |
//! |---|---|---|
//! | [`Damped`] | the papers' dynamics: semi-implicit Euler with damping −ζu | Negi & Ramachandran (2021), eqs. 17–25 |
//! | [`Fire`] | dynamics that is stopped where it runs uphill, and hastened where it does not | Bitzek et al., PRL 97, 170201 (2006) |
//! | [`Lbfgs`] | quasi-Newton steps from the last few gradients, with a line search | Nocedal & Wright, Numerical Optimization, ch. 7 |
//!
//! All work on a [`Potential`]: mostly an [`Energy`], that of pressure and repulsion over the places of the mobile particles, boundary
//! particles held on their surfaces. [`Settling`] is the schedule that methods share.
//!
//! # What was tried and dropped
//! - Newton's method towards the nearest place without forces, be it a saddle (MINRES on products of the Hessian by
//!   differences, 60 a step), in the hope that close pairs stay apart without repulsion: from an even packing of the
//!   starfish at ∆s = 0.05 it needed more evaluations than L-BFGS, and its pairs came as near (0.77 ∆s). Where
//!   repulsion holds a pair apart there is no resting place nearby without it.
//! - Newton's steps to Γ = 1 itself (conjugate gradients on JJᵀ, the smallest moves that do it): level within 0.15 % in
//!   60 products on the sphere, but they leave ten times the residual. [`Levelling`](crate::forces::Levelling) trades
//!   one against the other.
//! - Letting surface particles slide to the end: no denser or evener than holding them where the early phase left them,
//!   more uneven along the surface (3.9 to 4.1 % on the zig-zag), and a projection per evaluation.
//! - Annealing: 5 to 20 rounds of random kicks of 0.1 to 0.5 ∆s that fade out, each followed by 15 steps. Within 330
//!   evaluations, on starfish, cylinder and sphere, none came below what L-BFGS alone reached in as many; kicks of
//!   0.5 ∆s melted the starfish. What disorder leaves, levelling evens out.
//! - A few dozen careful FIRE steps before L-BFGS: capped L-BFGS steps reach the same density in fewer evaluations
//!   from the start (63 instead of 103 on every 2-D scene here).

mod damped;
mod energy;
mod fire;
mod gradient_penalty;
mod history;
mod lbfgs;
mod movable;
mod settling;
mod sides;
#[cfg(test)]
mod tests;
pub(crate) mod vectors;
mod walls;

pub use damped::Damped;
#[cfg(feature = "published")]
pub(crate) use damped::time_step;
pub use energy::Energy;
pub use fire::Fire;
pub use gradient_penalty::GradientPenalty;
pub use lbfgs::Lbfgs;
pub(crate) use movable::Movable;
pub use settling::{Finish, Settling};

use std::fmt;
use std::io::{self, Write};
use std::str::FromStr;

use crate::Damaged;

/// An energy over the places of mobile particles, as minimisers see it: coordinates may be scaled from particle to particle, so that
/// a step means the same to all.
pub trait Potential<const D: usize> {
    /// Number of mobile particles: the length of every vector here.
    fn len(&self) -> usize;

    /// Whether nothing can move.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The spacing that a step's length is compared with, scene units.
    fn spacing(&self) -> f64;

    /// The smoothing length of particles of that spacing, scene units.
    fn smoothing_length(&self) -> f64;

    /// The energy where the particles are.
    fn value(&mut self) -> f64;

    /// Minus its gradient, along the surface for boundary particles.
    fn force(&mut self) -> &[[f64; D]];

    /// Writes the coordinates of the mobile particles.
    fn places(&self, out: &mut Vec<[f64; D]>);

    /// Puts the mobile particles at `from + step · direction`, boundary ones onto their surface from there.
    fn move_to(&mut self, from: &[[f64; D]], step: f64, direction: &[[f64; D]]);

    /// `v` of every mobile particle without its part along the normal of the surface that it sits on.
    fn make_tangential(&self, v: &mut [[f64; D]]);

    /// The length of the longest of these steps, for particles of [`Potential::spacing`].
    fn longest(&self, direction: &[[f64; D]]) -> f64 {
        vectors::longest(direction)
    }
}

/// What a step came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// The particles moved.
    Taken,
    /// No way down was found: the particles are where they were.
    Stuck,
}

/// Goes down an energy, step by step.
pub trait Minimiser<const D: usize>: fmt::Debug {
    /// One step from where the particles are, which costs one evaluation or, in a line search, a few.
    fn step(&mut self, energy: &mut dyn Potential<D>) -> Step;

    /// Forgets what earlier steps taught: the energy has become another one, or other particles move.
    fn reset(&mut self);

    /// Appends all that earlier steps taught.
    fn save(&self, out: &mut dyn Write) -> io::Result<()>;

    /// Takes what [`Minimiser::save`] appended off the front of `from`, for a energy of `count` mobile particles.
    ///
    /// # Errors
    /// [`Damaged`] where it is not that; then the minimiser is of no use any more.
    fn load(&mut self, from: &mut &[u8], count: usize) -> Result<(), Damaged>;
}

/// The name of a minimiser.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum MinimiserKind {
    /// [`Damped`].
    Damped,
    /// [`Fire`].
    Fire,
    /// [`Lbfgs`].
    #[default]
    Lbfgs,
}

impl MinimiserKind {
    /// Every minimiser, slowest first.
    pub const ALL: [Self; 3] = [Self::Damped, Self::Fire, Self::Lbfgs];

    /// The name that scenes and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Damped => "damped",
            Self::Fire => "fire",
            Self::Lbfgs => "lbfgs",
        }
    }

    /// Evaluations for which L-BFGS needs one, about, from a rough start.
    pub fn pace(self) -> usize {
        match self {
            Self::Damped => 5,
            Self::Fire => 2,
            Self::Lbfgs => 1,
        }
    }

    /// A minimiser with its defaults.
    pub fn build<const D: usize>(self) -> Box<dyn Minimiser<D>> {
        match self {
            Self::Damped => Box::new(Damped::default()),
            Self::Fire => Box::new(Fire::default()),
            Self::Lbfgs => Box::new(Lbfgs::default()),
        }
    }
}

/// A minimiser's name that is none.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no minimiser is called \"{0}\"; there are damped, fire, lbfgs")]
pub struct UnknownMinimiser(pub String);

impl FromStr for MinimiserKind {
    type Err = UnknownMinimiser;

    fn from_str(name: &str) -> Result<Self, UnknownMinimiser> {
        Self::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
            .ok_or_else(|| UnknownMinimiser(name.to_owned()))
    }
}

impl fmt::Display for MinimiserKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
