//! Particles as a structure of arrays.

use std::fmt;
use std::str::FromStr;

use crate::sizes::Sizes;

/// How a particle may move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Kind {
    /// Moves freely.
    Free,
    /// Moves on the surface of its body.
    Boundary,
    /// Sits on a corner and never moves.
    Fixed,
    /// Continues the lattice outside the domain and never moves.
    Frozen,
}

impl Kind {
    /// Every kind, in the order of its number in files.
    pub const ALL: [Self; 4] = [Self::Free, Self::Boundary, Self::Fixed, Self::Frozen];

    /// The name that files and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Boundary => "boundary",
            Self::Fixed => "fixed",
            Self::Frozen => "frozen",
        }
    }

    /// Whether the particle sits on a surface.
    pub fn is_on_surface(self) -> bool {
        matches!(self, Self::Boundary | Self::Fixed)
    }

    /// Whether the particle may move at all.
    pub fn is_mobile(self) -> bool {
        matches!(self, Self::Free | Self::Boundary)
    }
}

/// A kind's name that is none.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no kind of particles is called \"{0}\"; there are free, boundary, fixed, frozen")]
pub struct UnknownKind(pub String);

impl FromStr for Kind {
    type Err = UnknownKind;

    fn from_str(name: &str) -> Result<Self, UnknownKind> {
        Self::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
            .ok_or_else(|| UnknownKind(name.to_owned()))
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Particles in the domain and the frozen ones around it. All arrays have one entry per particle, in the same order;
/// `id` follows a particle through every reordering.
#[derive(Debug, Clone, PartialEq)]
pub struct Particles<const D: usize> {
    /// A number that stays with the particle: 0, 1, 2, … in the order of seeding.
    pub id: Vec<u32>,
    /// Positions, scene units.
    pub position: Vec<[f64; D]>,
    /// How each particle may move.
    pub kind: Vec<Kind>,
    /// Volume (area in 2-D) of each particle, scene units to the power D.
    pub volume: Vec<f64>,
    /// The index of the body that each is part of; `None` for the fluid, and for free particles of methods that do not know
    /// ([`Packed::knows_sides`](crate::Packed::knows_sides)).
    pub body: Vec<Option<u16>>,
    /// Spacing and smoothing length of each.
    pub sizes: Sizes,
}

impl<const D: usize> Particles<D> {
    /// None yet, of the given size.
    pub fn new(sizes: Sizes) -> Self {
        Self {
            id: Vec::new(),
            position: Vec::new(),
            kind: Vec::new(),
            volume: Vec::new(),
            body: Vec::new(),
            sizes,
        }
    }

    /// Number of particles, frozen ones included.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Appends a particle of the size that all have; its id is its index. Where sizes differ, [`Particles::sizes`] is set
    /// when all are there.
    ///
    /// # Panics
    /// Beyond 2³² particles; [`crate::Problem::estimate`] refuses such problems first.
    pub fn push(&mut self, position: [f64; D], kind: Kind, volume: f64, body: Option<u16>) {
        let id = u32::try_from(self.id.len()).expect("fewer than 2^32 particles");
        self.id.push(id);
        self.position.push(position);
        self.kind.push(kind);
        self.volume.push(volume);
        self.body.push(body);
    }

    /// The body whose surface particle `i` sits on; `None` for a particle on none.
    #[inline]
    pub fn on_surface(&self, i: usize) -> Option<u16> {
        self.body[i].filter(|_| self.kind[i].is_on_surface())
    }

    /// How many particles are of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        self.kind.iter().filter(|&&k| k == kind).count()
    }

    /// The particles in another order: entry `i` of the result is entry `order[i]` of this. `order` may leave
    /// particles out.
    pub fn selected(&self, order: &[usize]) -> Self {
        Self {
            id: order.iter().map(|&i| self.id[i]).collect(),
            position: order.iter().map(|&i| self.position[i]).collect(),
            kind: order.iter().map(|&i| self.kind[i]).collect(),
            volume: order.iter().map(|&i| self.volume[i]).collect(),
            body: order.iter().map(|&i| self.body[i]).collect(),
            sizes: self.sizes.selected(order),
        }
    }
}
