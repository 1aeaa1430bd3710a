//! The repulsion of two particles beside one of Lennard-Jones's kind (Negi & Ramachandran 2021, fig. 5).

use std::collections::BTreeMap;

use sphpack_pairs::Repulsion;

use crate::reproduction::measure::Measure;

/// The library's force between two particles, by their distance, with this α. ∆s = 1 and p_b = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Repelled {
    pub(crate) alpha: f64,
}

/// Distances that are looked at, evenly over 0 … ∆s and a bit.
const PLACES: usize = 4400;
const FARTHEST: f64 = 1.1;

/// No higher than this many of ours is drawn: the one of Lennard-Jones's kind is beyond all paper soon.
const DRAWN: f64 = 3.0;

impl Repelled {
    pub(crate) fn words(&self) -> String {
        format!("two particles, α = {}", self.alpha)
    }

    pub(crate) fn figures(&self) -> BTreeMap<Measure, f64> {
        let force = Repulsion::with_reach(1.0, Repulsion::STRENGTH, self.alpha);
        let at = |i: usize| FARTHEST * i as f64 / PLACES as f64;
        let (mut begins, mut largest, mut off, mut pulls) = (0.0, 0.0, 0.0, 0.0);
        for r in (0..=PLACES).map(at) {
            let ours = force.force(r);
            if ours > 0.0 {
                begins = f64::max(begins, r);
            }
            largest = f64::max(largest, ours);
            off = f64::max(off, (ours - self.printed(r)).abs());
            pulls = f64::max(pulls, -ours);
        }
        BTreeMap::from([
            (Measure::Begins, begins),
            (Measure::LargestForce, largest),
            (Measure::ForceTogether, force.force(0.0) / largest),
            (Measure::OffPrinted, off / largest),
            (Measure::Pulls, pulls),
            (
                Measure::LennardJonesOverOurs,
                self.like_lennard_jones(0.5) / largest,
            ),
        ])
    }

    /// Both curves.
    pub(crate) fn curves(&self) -> Vec<(String, Vec<[f64; 2]>)> {
        let force = Repulsion::with_reach(1.0, Repulsion::STRENGTH, self.alpha);
        let over = |f: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
            (1..=110)
                .map(|i| 0.01 * f64::from(i))
                .map(|r| [r, f(r)])
                .filter(|point| point[1].abs() <= DRAWN * force.force(0.0))
                .collect()
        };
        vec![
            ("ours".to_owned(), over(&|r| force.force(r))),
            (
                "Lennard-Jones's kind".to_owned(),
                over(&|r| self.like_lennard_jones(r)),
            ),
        ]
    }

    /// Eq. 16 of the paper, its three cases as printed, for k_r = 0.005.
    fn printed(&self, r: f64) -> f64 {
        let (k, c) = (0.005, 2.0 * self.alpha / 3.0);
        if r <= 0.5 {
            192.0 * k * (3.0 * c * c - c)
        } else if r <= self.alpha {
            12.0 * k * (3.0 * c * c / r.powi(4) - 2.0 * c / r.powi(3))
        } else {
            0.0
        }
    }

    /// The gradient of (σ/r)¹² − (σ/r)⁶, without force where ours begins, and as steep there. The paper does not print its own one's
    /// constants.
    fn like_lennard_jones(&self, r: f64) -> f64 {
        let x = self.alpha / r;
        // f = A (x¹³ − x⁷) falls by 6A/α per length at α; ours, 12 k c (3c/r⁴ − 2/r³), by 36 k c (4c/α⁵ − 2/α⁴) = 16 k/α³.
        let slope = 16.0 * 0.005 / self.alpha.powi(3);
        slope * self.alpha / 6.0 * (x.powi(13) - x.powi(7))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_begin_at_one_place_and_as_steeply() {
        let trial = Repelled { alpha: 0.95 };
        let step = 1e-6;
        let r = 0.95 - step;
        let [ours, other] = [trial.printed(r), trial.like_lennard_jones(r)];
        assert!((ours / other - 1.0).abs() < 1e-4, "{ours} {other}");
        assert!(trial.like_lennard_jones(0.95).abs() < 1e-12);
    }

    #[test]
    fn a_repulsion_that_begins_elsewhere_is_seen() {
        let figures = Repelled { alpha: 0.8 }.figures();
        assert!((figures[&Measure::Begins] - 0.8).abs() < 1e-3);
        assert!(figures[&Measure::OffPrinted] < 1e-12, "{figures:?}");
    }
}
