//! How settling by a field is kept and gone on with.

use std::io::{self, Write};

use sphpack_neighbors::Arranged;

use super::energy::GradedEnergy;
use crate::sizes::Sizes;
use crate::state::{Damaged, State, Value, all_finite, load_as_many};

/// Of the same problem, with the same aim.
impl<const D: usize> State for GradedEnergy<'_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.movable.save(out)?;
        let sizes = &self.movable.particles.sizes;
        let spacing: Vec<f64> = (0..self.movable.particles.len())
            .map(|i| sizes.spacing(i))
            .collect();
        spacing.save(out)?;
        self.movable.particles.volume.save(out)?;
        self.anchors.save(out)?;
        self.mirror.save(out)?;
        self.list.reference().to_vec().save(out)?;
        self.built_with.save(out)?;
        let arranged = self.list.arranged();
        arranged.order.save(out)?;
        arranged.lane_pairs.save(out)?;
        self.evaluations.save(out)?;
        (self.neighbor_seconds, self.force_seconds).save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.movable.load(from)?;
        let count = self.movable.particles.len();
        let mut spacing = vec![0.0; count];
        load_as_many(&mut spacing, from)?;
        load_as_many(&mut self.movable.particles.volume, from)?;
        let is_sound = |x: &f64| *x > 0.0 && x.is_finite();
        if !spacing.iter().all(is_sound) {
            return Err(Damaged);
        }
        self.movable.particles.sizes = Sizes::each(&spacing, self.h_over_spacing);
        self.anchors = Vec::take(from)?;
        if !(self.anchors.is_empty() || self.anchors.len() == count) {
            return Err(Damaged);
        }
        self.mirror.load(from)?;
        let reference: Vec<[f64; D]> = Vec::take(from)?;
        self.built_with = Vec::take(from)?;
        if reference.len() != self.built_with.len()
            || reference.len() != count + self.mirror.len()
            || !all_finite(&reference)
            || !self.built_with.iter().all(is_sound)
        {
            return Err(Damaged);
        }
        let order = Vec::<u32>::take(from)?;
        let lane_pairs = usize::take(from)?;
        if !is_permutation(&order, count) {
            return Err(Damaged);
        }
        (self.list).arrange(Arranged::new(order, reference.len(), lane_pairs));
        (self.list).update_each(&reference, &self.built_with, |i| i < count);
        let evaluations = usize::take(from)?;
        let spent = Value::take(from)?;
        self.force.resize(self.movable.mobile.len(), [0.0; D]);
        self.is_stale = true;
        self.evaluate();
        self.is_changed = false;
        self.evaluations = evaluations;
        (self.neighbor_seconds, self.force_seconds) = spent;
        Ok(())
    }
}

/// Whether these are the numbers from 0 to below `count`, each once.
fn is_permutation(order: &[u32], count: usize) -> bool {
    let mut is_there = vec![false; count];
    order.len() == count
        && order.iter().all(|&i| {
            (is_there.get_mut(i as usize)).is_some_and(|seen| !std::mem::replace(seen, true))
        })
}
