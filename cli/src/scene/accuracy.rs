//! How accurate a packing by `method = "auto"` must be.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::fault::{Checked, Key, fault, positive};

/// What is measured of a packing at its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AccuracyMeasure {
    /// max |Γ − 1|.
    Linf,
    /// The largest h|∇Γ| of a free particle.
    Residual,
    /// By how much the error of an interpolated wave is more than the undisturbed lattice's, as a part of that
    /// ([`Packed::interpolation`](sphpack_packing::Packed::interpolation)).
    Interpolation,
    /// The same of the wave's derivative.
    Derivative,
}

impl AccuracyMeasure {
    /// Every measure.
    pub const ALL: [Self; 4] = [
        Self::Linf,
        Self::Residual,
        Self::Interpolation,
        Self::Derivative,
    ];

    /// Its key in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linf => "linf",
            Self::Residual => "residual",
            Self::Interpolation => "interpolation",
            Self::Derivative => "derivative",
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Linf => "the largest error of the density, |Γ − 1|",
            Self::Residual => "the largest residual of a free particle, h|∇Γ|",
            Self::Interpolation => "the error of an interpolated function beyond the lattice's",
            Self::Derivative => "the error of an interpolated derivative beyond the lattice's",
        }
    }
}

impl fmt::Display for AccuracyMeasure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// `accuracy = { linf = 0.002 }`: one measure and what it may come to.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Accuracy {
    /// [`AccuracyMeasure::Linf`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linf: Option<f64>,
    /// [`AccuracyMeasure::Residual`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual: Option<f64>,
    /// [`AccuracyMeasure::Interpolation`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<f64>,
    /// [`AccuracyMeasure::Derivative`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivative: Option<f64>,
}

impl Accuracy {
    fn of(&self, measure: AccuracyMeasure) -> Option<f64> {
        match measure {
            AccuracyMeasure::Linf => self.linf,
            AccuracyMeasure::Residual => self.residual,
            AccuracyMeasure::Interpolation => self.interpolation,
            AccuracyMeasure::Derivative => self.derivative,
        }
    }

    /// The measure and its number; the first where a program names several, which [`Scene::check`](super::Scene::check) refuses.
    pub fn asked(&self) -> Option<(AccuracyMeasure, f64)> {
        (AccuracyMeasure::ALL.into_iter()).find_map(|measure| Some((measure, self.of(measure)?)))
    }

    /// Whether it names one measure with a number that can be reached; of particles of many sizes where `is_graded`.
    pub(super) fn check(&self, is_graded: bool) -> Checked {
        let at = [Key::Name("packing"), Key::Name("accuracy")];
        let named: Vec<AccuracyMeasure> = (AccuracyMeasure::ALL.into_iter())
            .filter(|&measure| self.of(measure).is_some())
            .collect();
        let (measure, value) = match (named.as_slice(), self.asked()) {
            ([_], Some(asked)) => asked,
            ([], _) | (_, None) => {
                let all: Vec<String> = (AccuracyMeasure::ALL.iter())
                    .map(|measure| format!("{measure} ({})", measure.words()))
                    .collect();
                return fault(
                    &at,
                    format!(
                        "packing.accuracy names no measure; write one, such as accuracy = {{ linf = 0.002 }}: there are {}",
                        all.join(", ")
                    ),
                );
            }
            ([first, second, ..], _) => {
                return fault(
                    &at,
                    format!(
                        "packing.accuracy names {first} and {second}; settings are picked for one measure: keep the one that matters"
                    ),
                );
            }
        };
        let keys = [at[0], at[1], Key::Name(measure.name())];
        positive(&keys, &format!("packing.accuracy.{measure}"), value)?;
        let interpolates = matches!(
            measure,
            AccuracyMeasure::Interpolation | AccuracyMeasure::Derivative
        );
        if is_graded && interpolates {
            return fault(
                &keys,
                format!(
                    "packing.accuracy.{measure} is measured of particles of one size; with [refinement] use linf or residual"
                ),
            );
        }
        Ok(())
    }
}
