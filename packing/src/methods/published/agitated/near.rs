//! The repulsion of Negi & Ramachandran (preprint), eqs. 4 and 5.

use std::io::{self, Write};

use rayon::prelude::*;
use sphpack_neighbors::{Domain, KdTree, point};

use crate::forces::largest;
use crate::particles::{Kind, Particles};
use crate::state::{Damaged, State, all_finite};

/// c of eq. 4 in ∆s: 1.5 α with α = 1, and 1.2 between boundary particles.
pub(super) const REACH: [f64; 2] = [1.5, 1.8];

/// Nearer than this, in ∆s, the repulsion no longer grows.
const CORE: f64 = 0.5;

/// Who is within reach of the repulsion of eq. 4.
#[derive(Default)]
pub(super) struct Near<const D: usize> {
    list: Vec<Vec<u32>>,
    seen: Vec<[f64; D]>,
}

impl<const D: usize> Near<D> {
    /// Finds the neighbours anew where a particle has moved half the skin.
    pub(super) fn update(
        &mut self,
        particles: &Particles<D>,
        domain: &Domain<D>,
        reach: f64,
        skin: f64,
    ) {
        let positions = &particles.position;
        if self.seen.len() == positions.len() {
            let moved = largest(positions.len(), |i| {
                point::distance(positions[i], self.seen[i])
            });
            if moved <= 0.5 * skin {
                return;
            }
        }
        self.seen.clone_from(positions);
        self.find(particles, domain, reach + skin);
    }

    /// The neighbours within `reach` (scene units) where the particles were seen.
    pub(super) fn find(&mut self, particles: &Particles<D>, domain: &Domain<D>, reach: f64) {
        if self.seen.len() != particles.len() {
            return;
        }
        let places: Vec<[f64; D]> = self.seen.iter().map(|&p| domain.wrap(p)).collect();
        let Ok(tree) = KdTree::new(&places) else {
            self.list = vec![Vec::new(); places.len()];
            return;
        };
        self.list = (0..places.len())
            .into_par_iter()
            .with_min_len(256)
            .map(|i| {
                if particles.kind[i] == Kind::Frozen {
                    return Vec::new();
                }
                (domain.images(places[i], reach))
                    .flat_map(|image| tree.within(image, reach))
                    .filter(|found| found.index != i)
                    .map(|found| found.index as u32)
                    .collect()
            })
            .collect();
    }

    /// Eq. 5 with eq. 4 cut at r = c.
    pub(super) fn accelerations(
        &self,
        particles: &Particles<D>,
        domain: &Domain<D>,
        strength: f64,
        size: f64,
        out: &mut Vec<[f64; D]>,
    ) {
        let is_boundary = |i: usize| particles.kind[i] == Kind::Boundary;
        self.list
            .par_iter()
            .enumerate()
            .with_min_len(256)
            .map(|(i, near)| {
                let mut sum = [0.0; D];
                for &j in near {
                    let j = j as usize;
                    let apart = domain.difference(particles.position[i], particles.position[j]);
                    let r = point::norm(apart);
                    let c = REACH[usize::from(is_boundary(i) && is_boundary(j))] * size;
                    if r < c && r > 0.0 {
                        let r = r.max(CORE * size);
                        let push = 12.0 * strength * c / (r * r) * (c / r - 1.0);
                        sum = point::add_scaled(sum, push / r, apart);
                    }
                }
                sum
            })
            .collect_into_vec(out);
    }
}

/// To be followed by [`Near::find`].
impl<const D: usize> State for Near<D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.seen.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.seen.load(from)?;
        all_finite(&self.seen).then_some(()).ok_or(Damaged)
    }
}
