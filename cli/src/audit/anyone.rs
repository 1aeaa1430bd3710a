//! The audit of somebody's particles: what can be said without knowing what was asked for.

use sphpack_neighbors::{Bounds, Domain, point};
use sphpack_packing::closest_pair::{CROWDED, NEIGHBORS_IN_SIZES};
use sphpack_packing::{ClosestPair, Kind};

use super::Audit;
use crate::cloud::{Cloud, CloudQuality};
use crate::dimension::in_dimension;

/// How far from the lattice's Γ anybody's may be: beyond, particles or room are missing.
const GAMMA_WITHIN: f64 = 0.3;

/// The file's own densities agree with those summed anew to within this.
const SAME_GAMMA: f64 = 1e-6;

impl Audit {
    /// Audits particles of a file, measured at `spacing`. There is no box and there are no bodies to compare with; a file
    /// without frozen particles is measured away from its edge only.
    pub(crate) fn of_cloud(cloud: &Cloud, spacing: f64, quality: &CloudQuality) -> Self {
        let pair = in_dimension!(cloud.dimension, D => pair::<D>(cloud, spacing));
        let density = &quality.density;
        let mut audit = Self::clean(spacing, pair.0, [density.min, density.max]);
        if let Some(ids) = &cloud.id {
            let mut ids = ids.clone();
            ids.sort_by(f64::total_cmp);
            if let Some(pair) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
                let message = format!("two particles have the id {}; number them anew", pair[0]);
                audit.found::<3>(message, None);
            }
        }
        if pair.1 < CROWDED {
            let message = format!(
                "two particles are only {:.3} of their size apart; take one of them away, or settle them",
                pair.1
            );
            audit.found(message, Some(pair.2));
        }
        let off = density.linf_lattice;
        if off > GAMMA_WITHIN {
            let message = format!(
                "the density is off by {:.0} %: particles or room are missing, or the spacing, kernel or h/∆s is not theirs",
                100.0 * off
            );
            audit.found::<3>(message, None);
        }
        if let Some(differs) = quality.gamma_differs.filter(|&d| d > SAME_GAMMA) {
            // Another kernel is no fault.
            audit.messages.push(format!(
                "the file's column gamma differs by up to {differs:.1e}: it is by another kernel or h/∆s, or the particles were changed"
            ));
        }
        audit
    }
}

/// The smallest distance in ∆s, that over the mean size where below a half, and the place of that.
fn pair<const D: usize>(cloud: &Cloud, spacing: f64) -> (f64, f64, [f64; 3]) {
    let positions: Vec<[f64; D]> = (cloud.position.iter())
        .map(|p| point::of_slice(p))
        .collect();
    let domain = Domain {
        bounds: Bounds::of(&positions),
        periodic: [false; D],
    };
    let is_asked = |i: usize| cloud.kind[i] != Kind::Frozen;
    let likely = 2.0 * spacing;
    let (pair, distance) = if cloud.sizes.is_some() {
        let sizes = NEIGHBORS_IN_SIZES;
        let pair =
            ClosestPair::by_size(&domain, &positions, &cloud.volume, is_asked, likely, sizes);
        (pair, pair.crowded)
    } else {
        let pair = ClosestPair::of(&domain, &positions, &cloud.volume, is_asked, likely);
        (pair, pair.distance / spacing)
    };
    let place = point::of_slice(&pair.place);
    (
        if distance.is_finite() { distance } else { 0.0 },
        pair.crowded,
        place,
    )
}
