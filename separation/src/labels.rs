//! Labels, and the plain way to get them.

use std::fmt;
use std::str::FromStr;

use sphpack_geometry::Surface;

/// What a particle is part of.
///
/// ```
/// use sphpack_separation::Side;
///
/// assert_eq!("solid".parse(), Ok(Side::Solid));
/// assert_eq!(Side::Fluid.to_string(), "fluid");
/// assert!("void".parse::<Side>().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Side {
    /// Part of a body.
    Solid,
    /// Outside every body.
    Fluid,
}

impl Side {
    /// Both, in the order of their numbers in files.
    pub const ALL: [Self; 2] = [Self::Solid, Self::Fluid];

    /// The name that files use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solid => "solid",
            Self::Fluid => "fluid",
        }
    }
}

/// A side's name that is none.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no side is called \"{0}\"; there are solid, fluid")]
pub struct UnknownSide(
    /// The name that was asked for.
    pub String,
);

impl FromStr for Side {
    type Err = UnknownSide;

    fn from_str(name: &str) -> Result<Self, UnknownSide> {
        Self::ALL
            .into_iter()
            .find(|side| side.name() == name)
            .ok_or_else(|| UnknownSide(name.to_owned()))
    }
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Side and body of every particle, in the particles' order.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[must_use]
pub struct Labels {
    /// Solid or fluid.
    pub side: Vec<Side>,
    /// The index of the body; `None` for fluid. Where bodies overlap, the first.
    pub body: Vec<Option<u16>>,
}

/// Why particles cannot be separated.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SeparationError {
    /// A particle has no place.
    #[error("particle {index} has a coordinate that is not a finite number")]
    NotFinite {
        /// The first such particle.
        index: usize,
    },
    /// Slices of different lengths.
    #[error(
        "{positions} positions but {on_surface} entries that say on which body's surface they are; give one for each"
    )]
    LengthMismatch {
        /// Number of positions.
        positions: usize,
        /// Number of entries.
        on_surface: usize,
    },
    /// A particle is on a surface that is not there.
    #[error(
        "particle {index} is said to be on the surface of body {body}, but there are only {bodies} bodies"
    )]
    UnknownBody {
        /// The particle.
        index: usize,
        /// The body it names, counted from 0.
        body: u16,
        /// How many there are.
        bodies: usize,
    },
    /// More bodies than a label can name.
    #[error("{0} bodies are more than labels have numbers for; there may be {MAX_BODIES}")]
    TooManyBodies(usize),
    /// The reach is no length.
    #[error(
        "the reach is {0}; it must be a positive, finite length of about two particle spacings"
    )]
    BadReach(f64),
}

/// Labels number bodies with 16 bits.
const MAX_BODIES: usize = 1 << 16;

pub(crate) fn check<const D: usize>(
    positions: &[[f64; D]],
    on_surface: &[Option<u16>],
    bodies: usize,
) -> Result<(), SeparationError> {
    if positions.len() != on_surface.len() {
        return Err(SeparationError::LengthMismatch {
            positions: positions.len(),
            on_surface: on_surface.len(),
        });
    }
    if bodies > MAX_BODIES {
        return Err(SeparationError::TooManyBodies(bodies));
    }
    if let Some(index) = positions
        .iter()
        .position(|p| p.iter().any(|x| !x.is_finite()))
    {
        return Err(SeparationError::NotFinite { index });
    }
    for (index, body) in on_surface.iter().enumerate() {
        if let Some(body) = *body
            && usize::from(body) >= bodies
        {
            return Err(SeparationError::UnknownBody {
                index,
                body,
                bodies,
            });
        }
    }
    Ok(())
}

/// Labels from which particles each body holds; `on_surface` has the last word. The first body wins.
pub(crate) fn combine(on_surface: &[Option<u16>], held: impl Iterator<Item = Vec<bool>>) -> Labels {
    let mut body: Vec<Option<u16>> = vec![None; on_surface.len()];
    for (inside, number) in held.zip(0..=u16::MAX) {
        for (label, inside) in body.iter_mut().zip(inside) {
            if inside && label.is_none() {
                *label = Some(number);
            }
        }
    }
    for (label, on) in body.iter_mut().zip(on_surface) {
        *label = on.or(*label);
    }
    let side = body
        .iter()
        .map(|label| {
            if label.is_some() {
                Side::Solid
            } else {
                Side::Fluid
            }
        })
        .collect();
    Labels { side, body }
}

/// Gives every particle to the first body that holds it, else to the fluid. O(n · cost of an inside test) for each
/// body, parallel.
///
/// ```
/// use sphpack_geometry::Outline;
/// use sphpack_separation::separate;
///
/// let wing = Outline::naca("2412", 1.0)?;
/// let points = [[0.5, 0.0], [0.5, 0.5]];
/// assert_eq!(separate(&points, &[&wing])?.body, [Some(0), None]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A [`SeparationError`] for positions that are not finite, or too many bodies.
pub fn separate<const D: usize>(
    positions: &[[f64; D]],
    bodies: &[&dyn Surface<D>],
) -> Result<Labels, SeparationError> {
    separate_with_on_surface(positions, &vec![None; positions.len()], bodies)
}

/// [`separate`] where some particles are known to sit on a surface, and rounding would tell their side:
/// `on_surface[i]` is the body on whose surface particle `i` sits, which it then belongs to.
///
/// ```
/// use sphpack_geometry::Cuboid;
/// use sphpack_separation::separate_with_on_surface;
///
/// let left = Cuboid::new([0.0; 3], [1.0; 3])?;
/// let right = Cuboid::new([1.0, 0.0, 0.0], [2.0, 1.0, 1.0])?;
/// let points = [[0.5; 3], [1.0, 0.5, 0.5], [1.5, 0.5, 0.5]];
/// let on_surface = [None, Some(1), None];
/// let labels = separate_with_on_surface(&points, &on_surface, &[&left, &right])?;
/// assert_eq!(labels.body, [Some(0), Some(1), Some(1)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A [`SeparationError`] for slices that do not fit together, positions that are not finite, or too many bodies.
pub fn separate_with_on_surface<const D: usize>(
    positions: &[[f64; D]],
    on_surface: &[Option<u16>],
    bodies: &[&dyn Surface<D>],
) -> Result<Labels, SeparationError> {
    check(positions, on_surface, bodies.len())?;
    let held = (bodies.iter()).map(|body| body.inside_batch(positions));
    Ok(combine(on_surface, held))
}
