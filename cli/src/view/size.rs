//! How large particles are drawn: across by their spacing ∆s.

use crate::files::Columns;

use super::column::Stored;

/// Diameters.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Size {
    pub(super) diameter: Stored,
    /// What they are.
    pub(super) words: &'static str,
    /// The median.
    pub(super) typical: f64,
}

impl Size {
    /// The column `spacing`; else the root of the volume, or of m/ρ; else what fills the box.
    pub(super) fn of(columns: &Columns, dimension: usize, position: &[[f64; 3]]) -> Self {
        let root = |volume: f64| match dimension {
            2 => volume.sqrt(),
            _ => volume.cbrt(),
        };
        let column = |name: &str| {
            columns
                .numbers
                .get(name)
                .filter(|values| are_lengths(values))
        };
        let ratio = |mass: &str, density: &str| {
            let (mass, density) = (column(mass)?, column(density)?);
            let volume = mass.iter().zip(density);
            Some(volume.map(|(m, rho)| root(m / rho)).collect::<Vec<f64>>())
        };
        let of_volume =
            || column("volume").map(|volume| volume.iter().map(|&v| root(v)).collect::<Vec<f64>>());
        let (values, words) = if let Some(spacing) = column("spacing") {
            (spacing.clone(), "spacing")
        } else if let Some(roots) = of_volume() {
            (roots, "root of volume")
        } else if let Some(roots) = ratio("mass", "density").or_else(|| ratio("m", "rho")) {
            (roots, "root of mass / density")
        } else {
            (
                vec![filling(position); position.len()],
                "guessed: the file has no spacing or volume",
            )
        };
        let mut sorted = values.clone();
        let middle = sorted.len() / 2;
        let (_, &mut typical, _) = sorted.select_nth_unstable_by(middle, f64::total_cmp);
        Self {
            diameter: Stored::numbers("∆s".into(), values),
            words,
            typical,
        }
    }
}

fn are_lengths(values: &[f64]) -> bool {
    values.iter().all(|&value| value > 0.0 && value.is_finite())
}

/// The spacing of so many particles that fill their box, whose sides without length do not count.
fn filling(position: &[[f64; 3]]) -> f64 {
    let sides = (0..3).map(|k| {
        let (low, high) = (position.iter())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| {
                (l.min(p[k]), h.max(p[k]))
            });
        high - low
    });
    let sides: Vec<f64> = sides.filter(|&side| side > 0.0).collect();
    if sides.is_empty() {
        return 1.0;
    }
    let dimension = sides.len() as f64;
    let each = (position.len() as f64).powf(-1.0 / dimension);
    let logarithms: f64 = sides.iter().map(|side| side.ln()).sum();
    each * (logarithms / dimension).exp()
}
