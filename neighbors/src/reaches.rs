//! How far particles look: all as far, or each as far as it says.

use rayon::prelude::*;

use crate::point;

#[cfg(test)]
mod tests;

/// How far the particles of a list look, and how far they may move before it is built anew.
#[derive(Debug, Clone)]
pub(crate) struct Reaches {
    /// The support radius of all, or the greatest of a list whose particles have their own.
    pub(crate) support: f64,
    /// In scene units, or in parts of each particle's own support.
    skin: f64,
    /// Every particle's own support at the last build; empty where all have one.
    own: Vec<f64>,
}

impl Reaches {
    pub(crate) fn one(support: f64, skin: f64) -> Self {
        Self {
            support,
            skin,
            own: Vec::new(),
        }
    }

    /// Whether it is another than before.
    pub(crate) fn set_skin(&mut self, skin: f64) -> bool {
        std::mem::replace(&mut self.skin, skin) != skin
    }

    /// Whether every particle has its own.
    pub(crate) fn are_many(&self) -> bool {
        !self.own.is_empty()
    }

    /// Takes over the supports of a new list; `None` for one of all.
    pub(crate) fn set(&mut self, own: Option<&[f64]>) {
        self.own.clear();
        if let Some(own) = own {
            self.own.extend_from_slice(own);
            self.support = own.iter().copied().fold(0.0, f64::max);
        }
    }

    /// Support and skin of particle `i`, in scene units.
    pub(crate) fn listed(&self, i: usize) -> f64 {
        self.own
            .get(i)
            .map_or(self.support + self.skin, |own| own * (1.0 + self.skin))
    }

    /// How far apart `i` and `j` may be to be neighbours, as of the last build.
    pub(crate) fn of_pair(&self, i: usize, j: usize) -> f64 {
        if self.are_many() {
            self.own[i].max(self.own[j])
        } else {
            self.support
        }
    }

    /// The greatest [`Reaches::listed`].
    pub(crate) fn greatest(&self) -> f64 {
        if self.are_many() {
            self.support * (1.0 + self.skin)
        } else {
            self.support + self.skin
        }
    }

    /// From where on a pair is in a shell: as long as the list holds, it is then at least `begin` apart. In scene units;
    /// where particles have their own supports both are in parts of the greater one of a pair, support and skin.
    pub(crate) fn shell(&self, begin: f64) -> f64 {
        // Both ends of a pair may come half a skin nearer.
        if self.are_many() {
            (begin + self.skin) / (1.0 + self.skin)
        } else {
            begin + self.skin
        }
    }

    /// Whether a list built at `reference` still holds.
    ///
    /// What a support has grown by, its particle may no longer move, twice: once for what it sees farther out, once for shells,
    /// which begin farther out too.
    pub(crate) fn still_hold<const D: usize>(
        &self,
        reference: &[[f64; D]],
        positions: &[[f64; D]],
        own: Option<&[f64]>,
    ) -> bool {
        if positions.len() != reference.len() || own.is_some() != self.are_many() {
            return false;
        }
        match own {
            None => {
                let limit = 0.25 * self.skin * self.skin;
                let moved = positions
                    .par_iter()
                    .zip(reference)
                    .with_min_len(4096)
                    .any(|(&p, &q)| point::distance_squared(p, q) > limit);
                !moved
            }
            Some(now) => {
                let all = positions.par_iter().zip(reference).zip(now).zip(&self.own);
                all.with_min_len(4096).all(|(((&p, &q), &now), &then)| {
                    let grown = (now - then).max(0.0);
                    2.0 * (point::distance(p, q) + grown) <= self.skin * then
                })
            }
        }
    }
}
