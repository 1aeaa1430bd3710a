//! Bodies that are drawn at random and know by a formula what is in them.

use std::f64::consts::TAU;
use std::path::Path;

use sphpack::Outcome;

/// A fluid particle is in a solid where it is deeper than this, in ∆s.
pub(super) const DEEP: f64 = 0.12;

/// Pairs nearer than this, in ∆s, are wrong.
pub(super) const COINCIDENT: f64 = 0.5;

/// A scene that was drawn, and its judge.
pub(super) trait Drawn {
    /// The scene; a body that is a file is written into the folder, with the number in its name.
    fn text(&self, folder: &Path, number: u64) -> Result<String, String>;

    /// What is wrong with a packing that says it is right.
    fn faults(&self, outcome: &Outcome) -> Vec<String>;
}

/// What is wrong by what was counted, a volume held beside the exact one, and the closest pair.
pub(super) fn faults_of(
    outcome: &Outcome,
    counts: &[(usize, &str)],
    [held, exact]: [f64; 2],
) -> Vec<String> {
    let mut faults: Vec<String> = (counts.iter())
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    let each = (outcome.report.spacing).powi(outcome.report.dimension as i32);
    // Half a particle, or one in a hundred.
    if (held - exact).abs() > (0.5 * each).max(0.01 * exact) * (1.0 + 1e-9) {
        faults.push(format!("{:+.2} particles of volume", (held - exact) / each));
    }
    let closest = outcome.report.closest_pair_over_spacing;
    if closest < COINCIDENT {
        faults.push(format!("two particles are {closest:.3} apart"));
    }
    faults
}

/// Whether a body holds a place and all that is as far as `far` around it, in sixty directions.
pub(super) fn is_deep(
    dimension: usize,
    far: f64,
    p: [f64; 3],
    holds: impl Fn([f64; 3]) -> bool,
) -> bool {
    holds(p)
        && (0..60).all(|n| {
            let angle = TAU * f64::from(n) * 0.618_034;
            let high = if dimension == 2 {
                0.0
            } else {
                f64::from(n) / 29.5 - 1.0
            };
            let flat = (1.0 - high * high).sqrt();
            holds([
                p[0] + far * flat * angle.cos(),
                p[1] + far * flat * angle.sin(),
                p[2] + far * high,
            ])
        })
}
