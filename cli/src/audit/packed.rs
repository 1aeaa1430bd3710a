//! The audit of a packing that no scene asked for.

use std::fmt;

use sphpack_packing::Packed;

use super::Audit;
use crate::asked::Asked;
use crate::content::Content;
use crate::labels::{Sorted, sort};
use crate::solution::Solution;

/// What can be audited.
pub trait Audited {
    /// Looks at it by what its method promises: particles in the box, no two in the room of one, every body with its volume,
    /// every particle on its side by the exact closest point, density as even as the method can make it, sums that agree
    /// with those taken anew. O(n log n); a few percent of a packing.
    ///
    /// ```
    /// use sphpack::prelude::*;
    ///
    /// let wing = Outline::naca("0015", 1.0)?;
    /// let packed = Problem::around(&wing, 0.04).margin(0.2).pack(&Balanced::default())?;
    /// let audit = packed.audit()?;
    /// assert!(audit.passed && audit.volume_error < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Unsound`], with what was found.
    fn audit(&self) -> Result<Audit, Unsound>;
}

/// A packing that is not what it promises.
#[derive(Debug, Clone)]
pub struct Unsound {
    /// What was found; empty of figures where particles could not even be told apart.
    pub audit: Box<Audit>,
}

impl fmt::Display for Unsound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.audit.messages.join("; "))
    }
}

impl std::error::Error for Unsound {}

impl<const D: usize> Audited for Packed<D> {
    fn audit(&self) -> Result<Audit, Unsound> {
        let asked = Asked::of(self);
        let fields = self.fields(self.kernel, self.h_over_spacing);
        let quality = self.quality_by(&fields);
        let Sorted { labels, keep } = sort(self, &asked).map_err(|error| {
            let mut audit = Audit::clean(self.spacing, 0.0, [0.0; 2]);
            audit.found::<D>(format!("particles cannot be separated: {error}"), None);
            Unsound {
                audit: Box::new(audit),
            }
        })?;
        let solution = Solution {
            problem: self.problem.clone(),
            packed: self.clone(),
            labels,
            keep,
            fields,
            quality,
        };
        let volumes = Content::of(&solution.problem, &solution).volumes;
        let audit = Audit::of(&asked, &solution, &volumes);
        if audit.passed {
            Ok(audit)
        } else {
            Err(Unsound {
                audit: Box::new(audit),
            })
        }
    }
}
