//! Which targets share a block, kept from build to build.

/// A list whose candidates are by so much more than when its targets were arranged gets them arranged anew: sorting is most
/// of a build in the plane, and where particles move by parts of their spacing, the blocks of the build before are nearly as
/// compact.
const WORN: f64 = 1.08;

/// The arrangement of the targets of a list in blocks: with the positions of the last build, what builds the same list again.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Arranged {
    /// The targets, slot by slot.
    pub order: Vec<u32>,
    /// How many particles there were, targets or not.
    pub particles: usize,
    /// Candidates over all blocks and lanes when the targets were arranged.
    pub lane_pairs: usize,
    /// Whether there are too many more since: then the next list gets another.
    is_worn: bool,
}

impl Arranged {
    /// An arrangement with these fields.
    pub fn new(order: Vec<u32>, particles: usize, lane_pairs: usize) -> Self {
        Self {
            order,
            particles,
            lane_pairs,
            is_worn: false,
        }
    }

    /// Whether the next list of so many particles takes it over.
    pub(crate) fn still_serves(&self, particles: usize) -> bool {
        !self.is_worn && self.lane_pairs > 0 && self.particles == particles
    }

    /// Takes note of a list built with it.
    pub(crate) fn wear(&mut self, lane_pairs: usize) {
        self.is_worn = lane_pairs as f64 > WORN * self.lane_pairs as f64;
    }
}
