//! Walls in layers are what solvers expect of them.

use rayon::prelude::*;
use sphpack_neighbors::random::SplitMix64;
use sphpack_neighbors::{KdTree, point};

use super::Audit;
use crate::table::Table;
use crate::walls::{Wall, WallReport};

/// No particle of a layer is nearer to any other than this, in ∆s; those that were packed are judged as others are.
const CLOSEST: f64 = 0.6;

/// How far a layer's particle may be off its depth, in ∆s.
const OFF_LEVEL: f64 = 1.1e-3;

/// Every place of the layers is within this of a wall's particle, in ∆s, in the plane and in space; a square lattice leaves
/// 0.71, a cubic one 0.87.
const HOLE: [f64; 2] = [0.92, 1.02];

/// Or so near to any other particle that there is no room for one more.
const TAKEN: f64 = 0.62;

/// Places that are looked at beside each particle.
const PROBES: u64 = 6;

impl Audit {
    /// Audits a wall, and says what it is like; `name` is its body's, `table` what was built.
    pub(crate) fn wall<const D: usize>(
        &mut self,
        wall: &Wall<D>,
        name: &str,
        table: &Table,
    ) -> WallReport {
        let spacing = wall.of.spec.spacing;
        let depth = |p: [f64; D]| wall.of.surface.closest(p).distance.abs();
        let mut level: Vec<Option<f64>> = Vec::new();
        for (number, layer) in wall.layers.iter().enumerate() {
            let even = layer.points.len() - layer.between;
            let wanted = (number as f64 + 0.5) * spacing;
            level.extend((0..layer.points.len()).map(|i| (i < even).then_some(wanted)));
        }
        // What was packed is on the particle surface, which has sharp corners where the distance is round.
        level.iter_mut().take(wall.packed).for_each(|at| *at = None);
        let place = |i: usize| -> [f64; D] { point::of_slice(&table.position[i]) };
        let mut worst = (0.0, None, "");
        for (&i, level) in wall.rows.iter().zip(&level) {
            let p = place(i);
            let normal = table.normal(i);
            let foot = point::add_scaled(p, -table.distance[i], point::of_slice::<D>(&normal));
            let found = [
                ((table.distance[i] + depth(p)).abs(), "off its distance"),
                (
                    level.map_or(0.0, |level| (depth(p) - level).abs()),
                    "off its layer's depth",
                ),
                (depth(foot), "off the surface at the end of its normal"),
                (
                    spacing * (point::norm_squared(normal) - 1.0).abs(),
                    "off a normal of unit length",
                ),
            ];
            for (off, what) in found {
                if off.is_nan() || off > worst.0 {
                    worst = (off, Some(p), what);
                }
            }
        }
        if worst.0.is_nan() || worst.0 > OFF_LEVEL * spacing {
            let message = format!(
                "a particle of the wall of body \"{name}\" is {:.1e} spacings {}",
                worst.0 / spacing,
                worst.2
            );
            self.found(message, worst.1);
        }
        let all: Vec<[f64; D]> = (0..table.len()).map(place).collect();
        let own: Vec<[f64; D]> = wall.rows.iter().map(|&i| all[i]).collect();
        let (Ok(all), Ok(tree)) = (KdTree::new(&all), KdTree::new(&own)) else {
            self.found::<D>(
                format!("a particle of the wall of body \"{name}\" is nowhere"),
                None,
            );
            return WallReport::new(wall, 0.0, 0.0);
        };
        let pairs: Vec<f64> = (own.par_iter().with_min_len(64))
            .map(|&p| (all.nearest_n(p, 2).get(1)).map_or(f64::INFINITY, |other| other.distance))
            .collect();
        let closest = pairs.iter().copied().fold(f64::INFINITY, f64::min);
        let made = (pairs.iter().enumerate().skip(wall.packed)).min_by(|a, b| a.1.total_cmp(b.1));
        if let Some((i, &near)) = made.filter(|(_, near)| **near < CLOSEST * (1.0 - 1e-9) * spacing)
        {
            let message = format!(
                "a particle of the wall of body \"{name}\" is only {:.3} spacings from another",
                near / spacing
            );
            self.found(message, Some(own[i]));
        }
        let probes = (own.par_iter().with_min_len(64).enumerate()).map(|(i, &p)| {
            let mut random = SplitMix64::new(i as u64);
            let mut far = (0.0, p, false);
            for _ in 0..PROBES {
                let q: [f64; D] =
                    std::array::from_fn(|k| p[k] + spacing * (2.0 * random.unit() - 1.0));
                let Some(hit) = tree.nearest(q).filter(|hit| hit.distance > far.0) else {
                    continue;
                };
                if wall.is_within(q) {
                    let is_taken = all
                        .nearest(q)
                        .is_some_and(|any| any.distance <= TAKEN * spacing);
                    far = (hit.distance, q, !is_taken);
                }
            }
            far
        });
        let probes: Vec<(f64, [f64; D], bool)> = probes.collect();
        let farthest = probes.iter().map(|probe| probe.0).fold(0.0, f64::max);
        let open = (probes.iter())
            .filter(|probe| probe.2)
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let limit = HOLE[D.clamp(2, 3) - 2] * spacing;
        if let Some(hole) = open.filter(|hole| hole.0 > limit) {
            let message = format!(
                "the wall of body \"{name}\" has a hole: {:.2} spacings to its nearest particle",
                hole.0 / spacing
            );
            self.found(message, Some(hole.1));
        }
        let report = WallReport::new(wall, closest / spacing, farthest / spacing);
        if report.volume_error > 1e-9 {
            let message = format!(
                "the particles of the wall of body \"{name}\" have {:.1e} of its volume too much or too little",
                report.volume_error
            );
            self.found::<D>(message, None);
        }
        report
    }
}
