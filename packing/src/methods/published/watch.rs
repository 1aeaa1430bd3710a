//! Free particles that come near a surface, found without asking for every distance at every step.

use std::io::{self, Write};

use rayon::prelude::*;
use sphpack_geometry::Closest;
use sphpack_neighbors::point;

use crate::particles::{Kind, Particles};
use crate::state::{Damaged, State, load_as_many};

/// Where every particle was seen last, and how far it may go from there before it can be near.
#[derive(Debug)]
pub(crate) struct Watch<const D: usize> {
    seen: Vec<([f64; D], f64)>,
}

impl<const D: usize> Watch<D> {
    pub(crate) fn new(count: usize) -> Self {
        Self {
            seen: vec![([0.0; D], -1.0); count],
        }
    }

    /// The free particles that are nearer to the surface than `reach` (scene units), or beyond it, with the nearest
    /// place. `nearest` tells that of a place and a body; its distance is negative within the watched side.
    pub(crate) fn near(
        &mut self,
        particles: &Particles<D>,
        reach: f64,
        nearest: &(dyn Fn([f64; D], u16) -> Closest<D> + Sync),
    ) -> Vec<(usize, Closest<D>)> {
        self.seen
            .par_iter_mut()
            .enumerate()
            .with_min_len(256)
            .filter(|(i, _)| particles.kind[*i] == Kind::Free)
            .filter_map(|(i, (seen, room))| {
                let p = particles.position[i];
                if *room >= 0.0 && point::distance(p, *seen) <= *room {
                    return None;
                }
                let hit = nearest(p, particles.body[i].unwrap_or(0));
                (*seen, *room) = (p, -hit.distance - reach);
                (*room < 0.0).then_some((i, hit))
            })
            .collect()
    }
}

impl<const D: usize> State for Watch<D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.seen.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        load_as_many(&mut self.seen, from)
    }
}
