//! Time evolutions beside the eigenvalues: waves grow and swing as fast as these say.

use std::fmt::Write as _;

use rayon::prelude::*;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::random::SplitMix64;
use sphpack_packing::Lattice;
use sphpack_pairs::Repulsion;

use super::Section;
use super::evolution::{Evolution, PUBLISHED, cells};
use crate::crystal::{Crystal, Mode};

/// Measured rates are within this part of the expected ones.
const BAR: f64 = 0.05;

/// About the edge of the periodic box, in ∆s.
const EDGE: f64 = 8.0;

/// How far a wave carries at the beginning, and noise, in ∆s.
const WAVE: f64 = 1e-5;
const NOISE: f64 = 1e-10;

/// Growth is measured between these displacements over the first ones; that of noise from where the fastest wave is nearly alone.
const GROWN: [f64; 2] = [10.0, 100.0];
const GROWN_NOISE: [f64; 2] = [1e6, 1e7];

/// Half periods over which a frequency is measured.
const HALF_PERIODS: usize = 6;

/// Who has not grown or swung after so many steps does neither.
const PATIENCE: usize = 60_000;

/// How an evolution begins.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Start {
    /// With the wave of the least eigenvalue.
    Softest,
    /// With the wave of the greatest.
    Stiffest,
    /// With noise; the wave that grows fastest comes out of it.
    Noise,
}

/// A lattice, and how it begins.
#[derive(Debug, Clone, Copy)]
struct Trial {
    lattice: Lattice,
    kernel: KernelKind,
    h: f64,
    start: Start,
}

/// What came of it.
struct Outcome {
    /// The eigenvalue, in p_b/ρ∆s².
    value: f64,
    wavelength: f64,
    /// The rate or the frequency, expected and measured.
    expected: f64,
    measured: f64,
    steps: usize,
}

/// Lattices that do not stay.
const UNSTABLE: [(Lattice, KernelKind, f64); 14] = [
    (Lattice::Square, KernelKind::Quintic, 1.1),
    (Lattice::Square, KernelKind::WendlandC2, 1.2),
    (Lattice::Square, KernelKind::WendlandC6, 1.2),
    (Lattice::Hexagonal, KernelKind::Quintic, 1.3),
    (Lattice::Hexagonal, KernelKind::Cubic, 1.3),
    (Lattice::Hexagonal, KernelKind::WendlandC2, 1.0),
    (Lattice::SimpleCubic, KernelKind::Quintic, 1.1),
    (Lattice::SimpleCubic, KernelKind::WendlandC4, 1.0),
    (Lattice::Bcc, KernelKind::Quintic, 1.3),
    (Lattice::Bcc, KernelKind::Cubic, 1.0),
    (Lattice::Fcc, KernelKind::Quintic, 1.2),
    (Lattice::Fcc, KernelKind::WendlandC2, 1.0),
    (Lattice::Hcp, KernelKind::Quintic, 1.2),
    (Lattice::Hcp, KernelKind::WendlandC2, 1.0),
];

/// Lattices that do.
const STABLE: [(Lattice, KernelKind, f64); 11] = [
    (Lattice::Square, KernelKind::Quintic, 1.2),
    (Lattice::Hexagonal, KernelKind::Quintic, 1.2),
    (Lattice::Hexagonal, KernelKind::WendlandC2, 1.3),
    (Lattice::Hexagonal, KernelKind::WendlandC6, 1.2),
    (Lattice::SimpleCubic, KernelKind::WendlandC2, 1.0),
    (Lattice::Bcc, KernelKind::Quintic, 1.2),
    (Lattice::Bcc, KernelKind::Cubic, 1.1),
    (Lattice::Fcc, KernelKind::Quintic, 1.1),
    (Lattice::Fcc, KernelKind::WendlandC4, 1.3),
    (Lattice::Hcp, KernelKind::Quintic, 1.1),
    (Lattice::Hcp, KernelKind::WendlandC4, 1.3),
];

fn trials(is_quick: bool) -> Vec<Trial> {
    let of = |&(lattice, kernel, h): &(Lattice, KernelKind, f64), start| Trial {
        lattice,
        kernel,
        h,
        start,
    };
    if is_quick {
        return vec![
            of(&UNSTABLE[0], Start::Softest),
            of(&STABLE[5], Start::Stiffest),
        ];
    }
    let unstable =
        (UNSTABLE.iter()).flat_map(|case| [Start::Softest, Start::Noise].map(|s| of(case, s)));
    let stable =
        (STABLE.iter()).flat_map(|case| [Start::Softest, Start::Stiffest].map(|s| of(case, s)));
    unstable.chain(stable).collect()
}

/// The table.
///
/// # Errors
/// Where a rate is off by more than [`BAR`].
pub(super) fn section(is_quick: bool) -> Result<Section, String> {
    let mut text = format!(
        "## Confirmed by time evolution\n\n\
         A periodic box of about {EDGE} ∆s, at rest but for a wave of {WAVE:.0e} ∆s or noise of {NOISE:.0e} ∆s, moves without damping by\n\
         the packing's own forces (semi-implicit Euler, ∆t = {PUBLISHED} h as in 001 eq. 25). Expected are √−λ and √λ of the waves that fit into\n\
         the box, in √(p_b/ρ)/∆s. *Softest* and *stiffest* begin with the wave of the least and of the greatest eigenvalue that is not nought,\n\
         *noise* with everything: its spread grows a little slower than its fastest wave, as long as others are in it. The bar is {:.0} %.\n\n\
         | lattice | kernel | h/∆s | begins with | length of the wave / ∆s | λ | grows or swings | expected | measured | off by | steps |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
        100.0 * BAR
    );
    let trials = trials(is_quick);
    let outcomes: Vec<Outcome> = trials
        .par_iter()
        .map(|t| t.run())
        .collect::<Result<_, _>>()?;
    let mut missed = Vec::new();
    for (trial, outcome) in trials.iter().zip(&outcomes) {
        let off = outcome.measured / outcome.expected - 1.0;
        let line = format!(
            "| {} | {} | {} | {} | {:.2} | {:.2e} | {} | {:.4} | {:.4} | {:+.2} % | {} |",
            trial.lattice,
            trial.kernel,
            trial.h,
            match trial.start {
                Start::Softest => "softest",
                Start::Stiffest => "stiffest",
                Start::Noise => "noise",
            },
            outcome.wavelength,
            outcome.value,
            if outcome.value < 0.0 {
                "grows"
            } else {
                "swings"
            },
            outcome.expected,
            outcome.measured,
            100.0 * off,
            outcome.steps,
        );
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{line}");
        if off.is_nan() || off.abs() > BAR {
            missed.push(line);
        }
    }
    if !missed.is_empty() {
        return Err(format!(
            "rates that the eigenvalues do not give:\n{}",
            missed.join("\n")
        ));
    }
    text.push('\n');
    Ok(Section {
        text,
        pictures: Vec::new(),
    })
}

impl Trial {
    fn run(&self) -> Result<Outcome, String> {
        if self.lattice.dimension() == 2 {
            self.in_dimension::<2>()
        } else {
            self.in_dimension::<3>()
        }
    }

    fn in_dimension<const D: usize>(&self) -> Result<Outcome, String> {
        let cells = cells::<D>(self.lattice, EDGE);
        let crystal = Crystal::<D>::new(self.lattice, self.kernel, self.h);
        let mode = self.wave_of(&crystal, cells)?;
        let mut evolution =
            Evolution::new(self.lattice, self.kernel, self.h, cells, Repulsion::none());
        let expected = mode.value.abs().sqrt();
        let dt = PUBLISHED * self.h;
        let (measured, steps) = if self.start == Start::Noise {
            let mut random = SplitMix64::new(7);
            let noise: Vec<[f64; D]> = (evolution.sites.iter())
                .map(|_| std::array::from_fn(|_| NOISE * (2.0 * random.unit() - 1.0)))
                .collect();
            evolution.displace(|i| noise[i]);
            let first = evolution.spread();
            growth(&mut evolution, dt, GROWN_NOISE, |now| now.spread() / first)
        } else {
            let field = crystal.field(&mode, &evolution.sites);
            let longest = (field.iter().flatten()).fold(0.0, |a: f64, b| a.max(b.abs()));
            let field: Vec<[f64; D]> = (field.iter())
                .map(|way| way.map(|x| WAVE / longest * x))
                .collect();
            evolution.displace(|i| field[i]);
            if mode.value < 0.0 {
                growth(&mut evolution, dt, GROWN, |now| now.along(&field))
            } else {
                frequency(&mut evolution, dt, |now| now.along(&field))
            }
        };
        let k = crystal.cell.shortest(mode.k);
        Ok(Outcome {
            value: mode.value,
            wavelength: std::f64::consts::TAU / sphpack_neighbors::point::norm(k),
            expected,
            measured,
            steps,
        })
    }

    /// The wave of the box that is looked for.
    fn wave_of<const D: usize>(
        &self,
        crystal: &Crystal<D>,
        cells: [usize; D],
    ) -> Result<Mode<D>, String> {
        let mut best: Option<Mode<D>> = None;
        // The first is no wave: it carries the lattice as a whole.
        for k in crystal
            .cell
            .waves_in(self.lattice, cells)
            .into_iter()
            .skip(1)
        {
            for mode in crystal.modes(k)? {
                let is_better = best.as_ref().is_none_or(|best| match self.start {
                    Start::Stiffest => mode.value > best.value,
                    Start::Softest | Start::Noise => mode.value < best.value,
                });
                if is_better {
                    best = Some(mode);
                }
            }
        }
        best.ok_or_else(|| format!("a box of {cells:?} cells holds no wave"))
    }
}

/// ln(b/a) over the time in which what is measured grows from a to b, and the steps until then; not a number where it does not.
fn growth<const D: usize>(
    evolution: &mut Evolution<D>,
    dt: f64,
    [low, high]: [f64; 2],
    measure: impl Fn(&Evolution<D>) -> f64,
) -> (f64, usize) {
    let mut from = None;
    for step in 1..=PATIENCE {
        evolution.step(dt, 0.0);
        let size = measure(evolution).abs();
        let time = step as f64 * dt;
        match from {
            None if size >= low => from = Some((size, time)),
            Some((first, since)) if size >= high => {
                return ((size / first).ln() / (time - since), step);
            }
            _ => {}
        }
    }
    (f64::NAN, PATIENCE)
}

/// π over the time between changes of sign, and the steps until enough were seen; not a number where they are not.
fn frequency<const D: usize>(
    evolution: &mut Evolution<D>,
    dt: f64,
    measure: impl Fn(&Evolution<D>) -> f64,
) -> (f64, usize) {
    let mut crossings = Vec::new();
    let mut before = measure(evolution);
    for step in 1..=PATIENCE {
        evolution.step(dt, 0.0);
        let now = measure(evolution);
        if now * before < 0.0 {
            // Straight between steps.
            crossings.push((step as f64 - now / (now - before)) * dt);
        }
        before = now;
        if let [first, .., last] = crossings[..]
            && crossings.len() > HALF_PERIODS
        {
            let half = (last - first) / (crossings.len() - 1) as f64;
            return (std::f64::consts::PI / half, step);
        }
    }
    (f64::NAN, PATIENCE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(lattice: Lattice, h: f64, start: Start, grows: bool) {
        let trial = Trial {
            lattice,
            kernel: KernelKind::Quintic,
            h,
            start,
        };
        let outcome = trial.run().unwrap();
        assert_eq!(outcome.value < 0.0, grows, "{lattice}: {}", outcome.value);
        let off = outcome.measured / outcome.expected - 1.0;
        assert!(off.abs() < 0.01, "{lattice} {h}: off by {off}");
    }

    #[test]
    fn waves_grow_and_swing_as_fast_as_their_eigenvalues_say() {
        check(Lattice::Square, 1.1, Start::Softest, true);
        check(Lattice::Square, 1.2, Start::Softest, false);
        check(Lattice::Hexagonal, 1.2, Start::Stiffest, false);
        check(Lattice::Bcc, 1.2, Start::Stiffest, false);
    }
}
