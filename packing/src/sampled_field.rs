//! Spacings given at the points of a grid.

use std::fmt;

use sphpack_neighbors::Odometer;
use thiserror::Error;

use crate::resolution::{Spacing, SpacingField};

/// A field of spacings between samples on a regular grid: ln s by cubic polynomials through the nearest four samples of every
/// axis, so that it has no kinks, and held within the least and the greatest sample. Beyond the grid it goes on as it is
/// at the rim.
///
/// ```
/// use sphpack_packing::{Resolution, SampledField, SpacingField};
///
/// // Finer towards the right, one sample per unit.
/// let points: Vec<[f64; 2]> = (0..12).map(|k| [f64::from(k % 4), f64::from(k / 4)]).collect();
/// let spacings: Vec<f64> = points.iter().map(|p| 0.1 * (-0.05 * p[0]).exp()).collect();
/// let field = SampledField::of_points(&points, &spacings)?;
/// let there = field.at([1.5, 0.7]);
/// assert!((there.value - 0.1 * (-0.075_f64).exp()).abs() < 1e-12);
/// assert!((there.gradient[0] + 0.05 * there.value).abs() < 1e-12);
/// let resolution: Resolution<2> = field.into();
/// # Ok::<(), sphpack_packing::FieldError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SampledField<const D: usize> {
    origin: [f64; D],
    step: [f64; D],
    /// Samples along every axis.
    shape: [usize; D],
    /// ln s, the last axis fastest.
    logarithms: Vec<f64>,
    range: [f64; 2],
}

/// Why samples are no field.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FieldError {
    /// Other numbers of places and spacings, or too few of them.
    #[error(
        "a grid of spacings needs at least two samples along every axis and one spacing for each, and there are {points} places and {spacings} spacings"
    )]
    TooFew {
        /// Places.
        points: usize,
        /// Spacings.
        spacings: usize,
    },
    /// A spacing that is none.
    #[error("spacing {value} of sample {sample} is not a positive number")]
    NotPositive {
        /// Which, from 0.
        sample: usize,
        /// What it is.
        value: f64,
    },
    /// Places that are not on a grid.
    #[error(
        "the places are no regular grid: sample {sample} is not at a node of the {nodes}, or shares one with another"
    )]
    NoGrid {
        /// Which, from 0.
        sample: usize,
        /// Nodes along every axis, as in `3 × 4 nodes`.
        nodes: Nodes,
    },
}

/// How many nodes a grid has along every axis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Nodes(Vec<usize>);

impl fmt::Display for Nodes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts: Vec<String> = self.0.iter().map(usize::to_string).collect();
        write!(f, "{} nodes", counts.join(" × "))
    }
}

/// Places may be off their nodes by this part of a step: single precision has so much.
const OFF: f64 = 1e-3;

impl<const D: usize> SampledField<D> {
    /// A field with these spacings (scene units) at these places, which are the nodes of a regular grid in any order.
    ///
    /// # Errors
    /// Places that are no grid, or spacings that are none.
    pub fn of_points(points: &[[f64; D]], spacings: &[f64]) -> Result<Self, FieldError> {
        let too_few = FieldError::TooFew {
            points: points.len(),
            spacings: spacings.len(),
        };
        if points.len() != spacings.len() || points.len() < 1 << D {
            return Err(too_few);
        }
        for (sample, &value) in spacings.iter().enumerate() {
            if !(value > 0.0 && value.is_finite()) {
                return Err(FieldError::NotPositive { sample, value });
            }
        }
        let mut shape = [0; D];
        let (mut origin, mut step) = ([0.0; D], [0.0; D]);
        for k in 0..D {
            let mut along: Vec<f64> = points.iter().map(|p| p[k]).collect();
            along.sort_by(f64::total_cmp);
            let [first, last] = [along[0], along[along.len() - 1]];
            // Places of one node may differ by rounding.
            let apart = OFF * (last - first) / points.len() as f64;
            along.dedup_by(|next, kept| *next - *kept <= apart);
            if along.len() < 2 {
                return Err(too_few);
            }
            shape[k] = along.len();
            origin[k] = first;
            step[k] = (last - first) / (along.len() - 1) as f64;
        }
        let mut field = Self {
            origin,
            step,
            shape,
            logarithms: vec![f64::NAN; points.len()],
            range: [f64::INFINITY, 0.0],
        };
        let no_grid = |sample| FieldError::NoGrid {
            sample,
            nodes: Nodes(shape.to_vec()),
        };
        if shape.iter().product::<usize>() != points.len() {
            return Err(no_grid(points.len() - 1));
        }
        for (sample, (point, &spacing)) in points.iter().zip(spacings).enumerate() {
            let steps: [f64; D] = std::array::from_fn(|k| (point[k] - origin[k]) / step[k]);
            let is_off = (steps.iter()).any(|s| (s - s.round()).abs() > OFF || s.is_nan());
            let node = std::array::from_fn(|k| steps[k].round() as i64);
            let slot = field.slot(node);
            if is_off || !field.logarithms[slot].is_nan() {
                return Err(no_grid(sample));
            }
            field.logarithms[slot] = spacing.ln();
            field.range[0] = field.range[0].min(spacing);
            field.range[1] = field.range[1].max(spacing);
        }
        Ok(field)
    }

    /// The same with spacings that grow by no more than `growth` from particle to particle: finer where need be.
    #[must_use]
    pub fn limited(mut self, growth: f64) -> Self {
        let slope = growth - 1.0;
        let mut values: Vec<f64> = self.logarithms.iter().map(|log| log.exp()).collect();
        let near: Vec<[i64; D]> = Odometer::new([-1; D], [2; D]).collect();
        let nodes: Vec<[i64; D]> =
            Odometer::new([0; D], self.shape.map(|count| count as i64)).collect();
        // Forth and back until nothing changes: a front goes along the order of the nodes in one sweep.
        let mut is_changed = true;
        let mut is_forth = true;
        while is_changed {
            is_changed = false;
            for number in 0..nodes.len() {
                let node = if is_forth {
                    nodes[number]
                } else {
                    nodes[nodes.len() - 1 - number]
                };
                let slot = self.slot(node);
                for offset in &near {
                    let next: [i64; D] = std::array::from_fn(|k| node[k] + offset[k]);
                    let is_there = (0..D).all(|k| next[k] >= 0 && next[k] < self.shape[k] as i64);
                    if !is_there {
                        continue;
                    }
                    let away = (0..D)
                        .map(|k| (offset[k] as f64 * self.step[k]).powi(2))
                        .sum::<f64>()
                        .sqrt();
                    let most = values[self.slot(next)] + slope * away;
                    // Rounding is no change.
                    if values[slot] > most * (1.0 + 1e-12) {
                        values[slot] = most;
                        is_changed = true;
                    }
                }
            }
            is_forth = !is_forth;
        }
        self.range[1] = values.iter().copied().fold(0.0, f64::max);
        self.logarithms = values.iter().map(|value| value.ln()).collect();
        self
    }

    fn slot(&self, node: [i64; D]) -> usize {
        (0..D).fold(0, |slot, k| slot * self.shape[k] + node[k] as usize)
    }
}

/// Weights of the samples at −1, 0, 1, 2 for a cubic at t between 0 and 1 (Catmull and Rom 1974), and their slopes.
fn weights(t: f64) -> [[f64; 4]; 2] {
    let (t2, t3) = (t * t, t * t * t);
    [
        [
            0.5 * (-t3 + 2.0 * t2 - t),
            0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
            0.5 * (-3.0 * t3 + 4.0 * t2 + t),
            0.5 * (t3 - t2),
        ],
        [
            0.5 * (-3.0 * t2 + 4.0 * t - 1.0),
            0.5 * (9.0 * t2 - 10.0 * t),
            0.5 * (-9.0 * t2 + 8.0 * t + 1.0),
            0.5 * (3.0 * t2 - 2.0 * t),
        ],
    ]
}

impl<const D: usize> SpacingField<D> for SampledField<D> {
    fn at(&self, place: [f64; D]) -> Spacing<D> {
        let mut cell = [0; D];
        let mut each = [[[0.0; 4]; 2]; D];
        for k in 0..D {
            let last = (self.shape[k] - 1) as f64;
            let along = (place[k] - self.origin[k]) / self.step[k];
            let within = along.clamp(0.0, last);
            let first = within.floor().min(last - 1.0);
            cell[k] = first as i64;
            each[k] = weights(within - first);
            if along != within {
                each[k][1] = [0.0; 4];
            }
        }
        let (mut log, mut slope) = (0.0, [0.0; D]);
        for offset in Odometer::new([0; D], [4; D]) {
            // Beyond the rim the samples go on in a straight line.
            let value = self.beyond(std::array::from_fn(|k| cell[k] + offset[k] - 1));
            let weight = |with_slope: usize| -> f64 {
                (0..D)
                    .map(|k| each[k][usize::from(k == with_slope)][offset[k] as usize])
                    .product()
            };
            log += weight(D) * value;
            for (k, slope) in slope.iter_mut().enumerate() {
                *slope += weight(k) * value;
            }
        }
        let value = log.exp();
        let held = value.clamp(self.range[0], self.range[1]);
        let gradient = if held == value {
            std::array::from_fn(|k| value * slope[k] / self.step[k])
        } else {
            [0.0; D]
        };
        Spacing {
            value: held,
            gradient,
        }
    }

    fn range(&self) -> [f64; 2] {
        self.range
    }
}

impl<const D: usize> SampledField<D> {
    /// ln s at a node, which may be one step beyond the rim.
    fn beyond(&self, node: [i64; D]) -> f64 {
        for k in 0..D {
            let last = self.shape[k] as i64 - 1;
            let inside = node[k].clamp(0, last);
            if inside != node[k] {
                let mut rim = node;
                rim[k] = inside;
                let mut behind = node;
                behind[k] = (2 * inside - node[k]).clamp(0, last);
                return 2.0 * self.beyond(rim) - self.beyond(behind);
            }
        }
        self.logarithms[self.slot(node)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(shape: [usize; 2], of: impl Fn([f64; 2]) -> f64) -> (Vec<[f64; 2]>, Vec<f64>) {
        let nodes = Odometer::new([0; 2], shape.map(|n| n as i64));
        let points: Vec<[f64; 2]> = nodes
            .map(|n| [0.5 * n[0] as f64 - 1.0, 0.25 * n[1] as f64 + 3.0])
            .collect();
        let spacings = points.iter().map(|&p| of(p)).collect();
        (points, spacings)
    }

    #[test]
    fn nodes_have_their_samples_and_gradients_are_slopes() {
        let of = |p: [f64; 2]| 0.1 * (0.3 * (p[0] * p[1]).sin()).exp();
        let (mut points, mut spacings) = grid([9, 12], of);
        // In any order.
        points.reverse();
        spacings.reverse();
        let field = SampledField::of_points(&points, &spacings).expect("a grid");
        for (&p, &s) in points.iter().zip(&spacings) {
            assert!((field.at(p).value - s).abs() < 1e-14);
        }
        let step = 1e-6;
        for k in 0..400 {
            let p = [-1.3 + 0.011 * f64::from(k), 2.9 + 0.0077 * f64::from(k)];
            let there = field.at(p);
            for axis in 0..2 {
                let (mut a, mut b) = (p, p);
                a[axis] -= step;
                b[axis] += step;
                let slope = (field.at(b).value - field.at(a).value) / (2.0 * step);
                assert!((slope - there.gradient[axis]).abs() < 1e-6, "{p:?}");
            }
            let [least, most] = field.range();
            assert!(least <= there.value && there.value <= most);
        }
    }

    #[test]
    fn limited_spacings_grow_no_faster_and_no_finer_than_needed() {
        let (points, spacings) = grid([20, 30], |p| if p[0] < 0.0 { 0.05 } else { 2.0 });
        let field = SampledField::of_points(&points, &spacings).expect("a grid");
        let limited = field.limited(1.1);
        for p in points {
            let free = 0.05 + 0.1 * (p[0] + 0.5).max(0.0);
            assert!((limited.at(p).value - free).abs() < 1e-9, "{p:?}");
        }
        assert_eq!(limited.range()[0], 0.05);
    }

    #[test]
    fn what_is_no_grid_is_refused() {
        let (points, spacings) = grid([4, 5], |_| 0.1);
        let refused = |points: &[[f64; 2]], spacings: &[f64]| {
            SampledField::of_points(points, spacings).expect_err("no grid")
        };
        assert!(matches!(
            refused(&points[1..], &spacings[1..]),
            FieldError::NoGrid { .. }
        ));
        let mut moved = points.clone();
        moved[7][0] += 0.1;
        assert!(matches!(
            refused(&moved, &spacings),
            FieldError::NoGrid { .. }
        ));
        let mut twice = points.clone();
        twice[7] = twice[8];
        assert!(matches!(
            refused(&twice, &spacings),
            FieldError::NoGrid { .. }
        ));
        assert!(matches!(
            refused(&points, &spacings[1..]),
            FieldError::TooFew { .. }
        ));
        let mut wrong = spacings.clone();
        wrong[3] = -1.0;
        assert!(matches!(
            refused(&points, &wrong),
            FieldError::NotPositive { sample: 3, .. }
        ));
        let row: Vec<[f64; 2]> = (0..8).map(|k| [f64::from(k), 0.0]).collect();
        assert!(matches!(
            refused(&row, &[0.1; 8]),
            FieldError::TooFew { .. }
        ));
    }
}
