//! What files for solvers hold of a table: fewer columns than others, some in fewer digits, some in another order.

use super::ParticleFormat;
use super::by_body::by_body;
use crate::table::Table;

/// How the numbers of a column stand in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Digits {
    /// To the last bit.
    All,
    /// Rounded to 32 bits.
    Single,
}

impl Digits {
    /// A number as a file has it.
    pub(super) fn of(self, number: f64) -> f64 {
        match self {
            Self::All => number,
            Self::Single => f64::from(number as f32),
        }
    }
}

/// What is reloaded.
const PLACES_AND_VOLUMES: &[(&str, Digits)] = &[
    ("x", Digits::All),
    ("y", Digits::All),
    ("z", Digits::All),
    ("volume", Digits::All),
];

/// What a format holds of each particle.
pub(super) struct Carried {
    /// Columns of numbers.
    pub(super) numbers: &'static [(&'static str, Digits)],
    /// Columns of words.
    pub(super) words: &'static [&'static str],
}

impl ParticleFormat {
    /// What a solver's format holds; `None` where a format holds every column to the last bit.
    pub(super) fn carried(self) -> Option<Carried> {
        let (numbers, words): (&[(&str, Digits)], &[&str]) = match self {
            Self::Lammps => (
                &[
                    ("id", Digits::All),
                    ("x", Digits::All),
                    ("y", Digits::All),
                    ("z", Digits::All),
                    ("mass", Digits::All),
                    ("density", Digits::All),
                ],
                &["kind", "side", "body"],
            ),
            Self::Reload => (PLACES_AND_VOLUMES, &["body"]),
            Self::ReloadBody => (PLACES_AND_VOLUMES, &[]),
            Self::Bgeo => (
                &[
                    ("x", Digits::Single),
                    ("y", Digits::Single),
                    ("z", Digits::Single),
                    ("id", Digits::All),
                    ("spacing", Digits::Single),
                    ("mass", Digits::Single),
                    ("density", Digits::Single),
                ],
                &[],
            ),
            Self::Bi4 => (
                &[
                    ("x", Digits::All),
                    ("y", Digits::All),
                    ("z", Digits::All),
                    ("m", Digits::All),
                    ("rho", Digits::Single),
                    ("to_surface_x", Digits::Single),
                    ("to_surface_y", Digits::Single),
                    ("to_surface_z", Digits::Single),
                ],
                &["side"],
            ),
            _ => return None,
        };
        Some(Carried { numbers, words })
    }

    /// The rows of the table in the order in which a file has them; `None` where that is their own.
    pub(super) fn order(self, table: &Table) -> Option<Vec<u32>> {
        matches!(self, Self::Reload | Self::Bi4).then(|| by_body(table))
    }
}
