//! Neighbours in a set that stands still.

use std::fmt;
use std::num::NonZero;

use kiddo::{ImmutableKdTree, SquaredEuclidean};

/// A kd-tree over points that stand still: nearest points, and points within a radius. Built in O(n log n), queried in
/// O(log n + answers). Many coincident points are fine.
///
/// ```
/// use sphpack_neighbors::KdTree;
///
/// let tree = KdTree::new(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 3.0, 0.0]])?;
/// let hit = tree.nearest([0.8, 0.0, 0.0]).expect("the tree has points");
/// assert_eq!(hit.index, 1);
/// assert!((hit.distance - 0.2).abs() < 1e-12);
/// assert_eq!(tree.within([0.0; 3], 1.0).len(), 2);
/// assert_eq!(tree.nearest_n([0.0; 3], 2)[1].index, 1);
/// # Ok::<(), sphpack_neighbors::KdTreeError>(())
/// ```
pub struct KdTree<const D: usize> {
    /// `None` for no points: the library answers queries on an empty tree with a sentinel.
    tree: Option<ImmutableKdTree<f64, D>>,
    len: usize,
}

impl<const D: usize> fmt::Debug for KdTree<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("KdTree")
            .field("len", &self.len)
            .finish_non_exhaustive()
    }
}

/// A point found by a [`KdTree`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Its index in the points that the tree was built from.
    pub index: usize,
    /// Its distance, scene units.
    pub distance: f64,
}

/// Why a tree cannot be built.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum KdTreeError {
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// The first such point.
        index: usize,
    },
    /// The library refused the points.
    Construction(String),
}

impl fmt::Display for KdTreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { index } => write!(
                f,
                "point {index} has a coordinate that is not a finite number"
            ),
            Self::Construction(why) => write!(f, "the kd-tree cannot be built: {why}"),
        }
    }
}

impl std::error::Error for KdTreeError {}

impl<const D: usize> KdTree<D> {
    /// The tree over `points`.
    ///
    /// # Errors
    /// [`KdTreeError::NotFinite`] for NaN or infinite coordinates.
    pub fn new(points: &[[f64; D]]) -> Result<Self, KdTreeError> {
        if let Some(index) = points.iter().position(|&p| !crate::point::is_finite(p)) {
            return Err(KdTreeError::NotFinite { index });
        }
        let tree = if points.is_empty() {
            None
        } else {
            let tree = ImmutableKdTree::new_from_slice(points);
            Some(tree.map_err(|error| KdTreeError::Construction(format!("{error:?}")))?)
        };
        Ok(Self {
            tree,
            len: points.len(),
        })
    }

    /// The point nearest to `p`; `None` for an empty tree.
    pub fn nearest(&self, p: [f64; D]) -> Option<Found> {
        let hit = self
            .tree
            .as_ref()?
            .query(&p)
            .nearest_one::<SquaredEuclidean<f64>>()
            .execute();
        Some(Found {
            index: hit.item as usize,
            distance: hit.distance.sqrt(),
        })
    }

    /// The `count` points nearest to `p`, nearest first; fewer where there are fewer.
    pub fn nearest_n(&self, p: [f64; D], count: usize) -> Vec<Found> {
        let (Some(tree), Some(count)) = (self.tree.as_ref(), NonZero::new(count.min(self.len)))
        else {
            return Vec::new();
        };
        let hits = tree
            .query(&p)
            .nearest_n::<SquaredEuclidean<f64>>(count)
            .execute();
        hits.into_iter()
            .map(|hit| Found {
                index: hit.item as usize,
                distance: hit.distance.sqrt(),
            })
            .collect()
    }

    /// The points within `radius` of `p`, those at exactly `radius` included, by ascending index.
    pub fn within(&self, p: [f64; D], radius: f64) -> Vec<Found> {
        let Some(tree) = self.tree.as_ref() else {
            return Vec::new();
        };
        let hits = tree
            .query(&p)
            .within::<SquaredEuclidean<f64>>(radius * radius)
            .unsorted()
            .execute();
        let mut found: Vec<Found> = hits
            .into_iter()
            .map(|hit| Found {
                index: hit.item as usize,
                distance: hit.distance.sqrt(),
            })
            .collect();
        found.sort_unstable_by_key(|hit| hit.index);
        found
    }
}
