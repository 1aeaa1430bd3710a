//! From loops to a body, or the reason why not; and loops into files.

use std::io::{self, Write};

use super::repair::OutlineRepair;
use super::report::{LoopRole, OutlineDefectKind as Kind, OutlineReport};
use super::{RepairedSketch, Sketch};
use crate::{GeometryError, Outline, OutlineError};

/// A body, and what was done to its loops to make it one.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MendedOutline {
    /// The body.
    pub outline: Outline,
    /// What was done, in this order; empty where nothing was wrong.
    pub done: Vec<OutlineRepair>,
}

impl Sketch {
    /// The body that the loops bound: as they are where nothing is wrong, else after [`Sketch::repaired`]. What was done
    /// is told.
    ///
    /// # Errors
    /// [`OutlineError::Defective`] with every defect that is left and its cure, or what [`Outline::new`] finds.
    pub fn body(&self) -> Result<MendedOutline, GeometryError> {
        self.body_knowing(&self.check())
    }

    /// [`Sketch::body`] where what [`Sketch::check`] finds is known already.
    ///
    /// # Errors
    /// As [`Sketch::body`].
    pub fn body_knowing(&self, report: &OutlineReport) -> Result<MendedOutline, GeometryError> {
        if report.is_clean() {
            return Ok(MendedOutline {
                outline: Outline::new(self.loops.clone())?,
                done: self.done.clone(),
            });
        }
        if let ([_], [only]) = (&self.loops[..], &report.loops[..])
            && only.role == LoopRole::Nothing
        {
            // This says how many points there are.
            Outline::new(self.loops.clone())?;
        }
        self.repaired().body()
    }
}

impl RepairedSketch {
    /// The body that the mended loops bound.
    ///
    /// # Errors
    /// [`OutlineError::Defective`] with every defect that is left and its cure, or what [`Outline::new`] finds.
    pub fn body(self) -> Result<MendedOutline, GeometryError> {
        let Self {
            sketch,
            mut done,
            report,
            is_directed,
        } = self;
        if report.is_clean() {
            let outline = Outline::new(sketch.loops)?;
            return Ok(MendedOutline { outline, done });
        }
        let is_contact = |kind: Kind| matches!(kind, Kind::Contact | Kind::SelfContact);
        let only_contacts = (report.defects.iter())
            .all(|defect| is_contact(defect.kind) || defect.kind.is_harmless());
        if !(is_directed && only_contacts) {
            return Err(defective(&report));
        }
        let contacts = report.defects.iter().filter(|d| is_contact(d.kind));
        done.push(OutlineRepair::LeftContacts(contacts.map(|d| d.count).sum()));
        Ok(MendedOutline {
            outline: Outline::assemble(sketch.loops),
            done,
        })
    }
}

/// What keeps loops from being a body.
fn defective(report: &OutlineReport) -> GeometryError {
    let words: Vec<String> = report
        .defects
        .iter()
        .filter(|defect| !defect.kind.is_harmless())
        .map(|defect| format!("{defect}; {}", defect.kind.cure()))
        .collect();
    OutlineError::Defective {
        defects: words.join(". "),
    }
    .into()
}

impl Outline {
    /// Writes the loops as rows of x,y with a blank line between loops; every number is read back as it is.
    ///
    /// # Errors
    /// What `to` says.
    pub fn write_csv(&self, to: &mut dyn Write) -> io::Result<()> {
        writeln!(to, "x,y")?;
        for (number, points) in self.loops().enumerate() {
            if number > 0 {
                writeln!(to)?;
            }
            for [x, y] in points {
                writeln!(to, "{x:?},{y:?}")?;
            }
        }
        Ok(())
    }
}
