//! The connected parts of an outline.

use std::collections::BTreeMap;

use super::{Outline, crosses};
use crate::segment::signed_area;

impl Outline {
    /// The parts, in the order of their outer loops, each with the holes in it; none where there is but one.
    pub(crate) fn pieces(&self) -> Vec<Self> {
        let loops: Vec<&[[f64; 2]]> = self.loops().collect();
        let area: Vec<f64> = loops.iter().map(|points| signed_area(points)).collect();
        // Holes run clockwise.
        if area.iter().filter(|area| **area > 0.0).count() < 2 {
            return Vec::new();
        }
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for k in 0..loops.len() {
            // A hole without a loop around it does not come from nesting; it goes with itself.
            let outer = if area[k] > 0.0 {
                k
            } else {
                self.around(k, &area).unwrap_or(k)
            };
            members.entry(outer).or_default().push(k);
        }
        (members.into_values())
            .map(|loop_numbers| {
                Self::assemble(
                    loop_numbers
                        .into_iter()
                        .map(|k| loops[k].to_vec())
                        .collect(),
                )
            })
            .collect()
    }

    /// The smallest outer loop around loop `k`.
    fn around(&self, k: usize, area: &[f64]) -> Option<usize> {
        let p = self.points[self.starts[k]];
        // A ray from within a loop crosses it an odd number of times.
        let mut is_odd: BTreeMap<usize, bool> = BTreeMap::new();
        self.beside(p, |i| {
            let [a, b] = self.side(i);
            if crosses(a, b, p) {
                *is_odd.entry(self.address(i).0).or_default() ^= true;
            }
        });
        (is_odd.into_iter())
            .filter(|&(other, is_odd)| is_odd && other != k && area[other] > 0.0)
            .map(|(other, _)| other)
            .min_by(|&a, &b| area[a].total_cmp(&area[b]))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::surface::Surface;

    fn ring(center: [f64; 2], radius: f64, sides: u32) -> Vec<[f64; 2]> {
        (0..sides)
            .map(|k| {
                let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
                [
                    center[0] + radius * angle.cos(),
                    center[1] + radius * angle.sin(),
                ]
            })
            .collect()
    }

    #[test]
    fn one_piece_has_no_parts() {
        let plain = Outline::polygon(&ring([0.0, 0.0], 1.0, 7)).unwrap();
        assert!(plain.parts().is_empty());
        let holed = Outline::new(vec![ring([0.0; 2], 1.0, 7), ring([0.0; 2], 0.5, 9)]).unwrap();
        assert!(holed.parts().is_empty());
    }

    proptest! {
        /// Targets of rings beside each other, in any order: every second gap is a hole of the ring around it.
        #[test]
        fn rings_in_rings(
            depths in prop::collection::vec(1_usize..7, 2..5),
            order in any::<u64>(),
        ) {
            let mut loops = Vec::new();
            let mut areas = Vec::new();
            for (k, &depth) in depths.iter().enumerate() {
                let rings: Vec<_> = (0..depth)
                    .map(|n| ring([3.0 * k as f64, 0.1], 1.0 - 0.13 * n as f64, 20 + n as u32))
                    .collect();
                for pair in rings.chunks(2) {
                    let area = |points: &[[f64; 2]]| signed_area(points).abs();
                    areas.push(area(&pair[0]) - pair.get(1).map_or(0.0, |hole| area(hole)));
                }
                loops.extend(rings);
            }
            let turn = (order % loops.len() as u64) as usize;
            loops.rotate_left(turn);
            let body = Outline::new(loops).unwrap();
            let parts = body.parts();
            prop_assert_eq!(parts.len(), areas.len());
            let mut found: Vec<f64> = parts.iter().map(|part| part.volume()).collect();
            found.sort_by(f64::total_cmp);
            areas.sort_by(f64::total_cmp);
            for (found, area) in found.iter().zip(&areas) {
                prop_assert!((found - area).abs() < 1e-12);
            }
            let measure: f64 = parts.iter().map(|part| part.measure()).sum();
            prop_assert!((measure - body.measure()).abs() < 1e-9);
        }
    }
}
