//! Free particles stay in the box.

use std::io::{self, Write};

use sphpack_neighbors::{Bounds, Domain};

use crate::particles::{Kind, Particles};
use crate::state::{Damaged, State};

/// Keeps free particles within the sides of the box that are not periodic. Frozen particles alone are no barrier: where a
/// thin body holds too many particles, or two bodies leave a narrow place between them, some are pushed through.
#[derive(Debug)]
pub(super) struct Walls<const D: usize> {
    domain: Domain<D>,
    /// No particle comes nearer to a side than this, in its spacings.
    pub(super) margin: f64,
    /// Particles that were put back, with the axis and which way is into the box.
    held: Vec<(u32, usize, f64)>,
}

impl<const D: usize> Walls<D> {
    pub(super) fn new(domain: Domain<D>) -> Self {
        Self {
            domain,
            margin: 0.0,
            held: Vec::new(),
        }
    }

    /// Puts free particles that left the box back onto its side.
    pub(super) fn keep(&mut self, particles: &mut Particles<D>, mobile: &[u32]) {
        self.held.clear();
        let open: [bool; D] = self.domain.periodic.map(|periodic| !periodic);
        for &i in mobile {
            let bounds = self.within(particles, i as usize);
            let p = &mut particles.position[i as usize];
            let is_off =
                (0..D).any(|k| open[k] && (p[k] <= bounds.min[k] || p[k] >= bounds.max[k]));
            if !is_off {
                continue;
            }
            if particles.kind[i as usize] == Kind::Boundary {
                // Its surface goes on beyond the side, but not it.
                for k in (0..D).filter(|&k| open[k]) {
                    if p[k] <= bounds.min[k] {
                        self.held.push((i, k, 1.0));
                    } else if p[k] >= bounds.max[k] {
                        self.held.push((i, k, -1.0));
                    }
                }
                continue;
            }
            for k in (0..D).filter(|&k| open[k]) {
                // A place that is no number is left for the caller to find.
                if p[k] < bounds.min[k] {
                    p[k] = bounds.min[k];
                    self.held.push((i, k, 1.0));
                } else if p[k] > bounds.max[k] {
                    p[k] = bounds.max[k];
                    self.held.push((i, k, -1.0));
                }
            }
        }
    }

    /// The room of particle `i`: the box without the margin.
    fn within(&self, particles: &Particles<D>, i: usize) -> Bounds<D> {
        if self.margin > 0.0 {
            (self.domain.bounds).grown(-self.margin * particles.sizes.spacing(i))
        } else {
            self.domain.bounds
        }
    }

    /// Moves boundary particles out of the margin, off their surfaces; whether any was in it.
    pub(super) fn clear(&self, particles: &mut Particles<D>, mobile: &[u32]) -> bool {
        let mut any = false;
        for &i in mobile {
            let i = i as usize;
            if self.margin > 0.0 && particles.kind[i] == Kind::Boundary {
                let within = self.within(particles, i);
                let p = &mut particles.position[i];
                for k in (0..D).filter(|&k| !self.domain.periodic[k]) {
                    let x = p[k].max(within.min[k]).min(within.max[k]);
                    any |= x != p[k];
                    p[k] = x;
                }
            }
        }
        any
    }

    /// Particles that a side holds: which, across which axis, and the sign of the way into the box.
    pub(super) fn held(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        self.held
            .iter()
            .map(|&(i, axis, inward)| (i as usize, axis, inward))
    }
}

impl<const D: usize> State for Walls<D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.held.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.held.load(from)?;
        (self.held.iter().all(|&(_, axis, _)| axis < D))
            .then_some(())
            .ok_or(Damaged)
    }
}
