//! From triangles to a body, or the reason why not.

use std::collections::BTreeSet;

use sphpack_neighbors::Bounds;

use super::check::Survey;
use super::join;
use super::repair::{HoleLimit, Repair};
use super::report::{DefectKind, MeshReport};
use super::{Repaired, Soup, cracks};
use crate::mesh::triangle;
use crate::{Bvh, GeometryError, Mesh, MeshError};

/// A body, and what was done to its triangles to make it one.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Mended {
    /// The body.
    pub mesh: Mesh,
    /// What was done, in this order; empty where nothing was wrong.
    pub done: Vec<Repair>,
}

impl Soup {
    /// The body that the triangles bound: as they are where nothing is wrong, else after [`Soup::repaired`] (holes
    /// within [`HoleLimit::Small`]), shells that overlap joined, with what of them is inside others left
    /// out. Shells that touch along edges or in points stay as they are. Crossings within a shell stay where they are at most 500 and the triangles have less than 1 % of the area. What was done is told.
    ///
    /// # Errors
    /// [`MeshError::Defective`] with every defect that is left and its cure, or what [`Mesh::new`] finds.
    pub fn body(&self) -> Result<Mended, GeometryError> {
        self.body_knowing(&self.check())
    }

    /// [`Soup::body`] where what [`Soup::check`] finds is known already.
    ///
    /// # Errors
    /// As [`Soup::body`].
    pub fn body_knowing(&self, report: &MeshReport) -> Result<Mended, GeometryError> {
        if report.is_clean() && !may_be_flush(report) {
            let done = if self.welded > 0 {
                vec![Repair::Welded(self.welded)]
            } else {
                Vec::new()
            };
            let mesh = Mesh::new(self.vertices.clone(), self.triangles.clone())?;
            return Ok(Mended { mesh, done });
        }
        self.repaired(HoleLimit::Small).body()
    }
}

/// Whether shells are so near each other that faces may lie on each other but for rounding, which is no defect: what
/// is exact finds them apart.
fn may_be_flush(report: &MeshReport) -> bool {
    let all = (report.shells.iter()).fold(Bounds::EMPTY, |all, shell| all.union(shell.bounds));
    let width = cracks::WIDTH * all.diagonal();
    let boxes: Vec<Bounds<3>> = (report.shells.iter())
        .map(|shell| shell.bounds.grown(width))
        .collect();
    boxes.len() > 1 && !Bvh::build(&boxes).pairs(&boxes, |_, _| true).is_empty()
}

impl Repaired {
    /// The body that the mended triangles bound.
    ///
    /// # Errors
    /// [`MeshError::Defective`] with every defect that is left and its cure, or what [`Mesh::new`] finds.
    pub fn body(self) -> Result<Mended, GeometryError> {
        let Self {
            mut soup,
            mut done,
            mut report,
        } = self;
        let is_there = |report: &MeshReport, kinds: &[DefectKind]| {
            kinds.iter().any(|&kind| report.defect(kind).is_some())
        };
        if is_there(&report, &UNMENDED) {
            return Err(defective(&report));
        }
        let contact = report
            .defect(DefectKind::Contact)
            .map(|contact| contact.count);
        let overlap = is_there(&report, &[DefectKind::Overlap, DefectKind::Redundant]);
        let stays_apart = contact.is_some()
            && !overlap
            && !soup.has_flush_walls()
            && !join::reach_into_each_other(&soup);
        if let Some(count) = contact.filter(|_| stays_apart) {
            // Along edges and in points: each shell is a body of its own there.
            done.push(Repair::LeftContacts(count));
        } else if is_there(&report, &SEVERAL) {
            let survey = Survey::new(&soup);
            if let Some(joined) = join::join(&soup, &survey) {
                let whole = joined.check();
                done.push(Repair::Joined {
                    shells: survey.shells.len(),
                    shared_volume: (report.volume - whole.volume).max(0.0),
                });
                (soup, report) = (joined, whole);
                if is_there(&report, &UNMENDED) || is_there(&report, &SEVERAL) {
                    return Err(defective(&report));
                }
            } else {
                return Err(defective(&report));
            }
        }
        if let Some(crossings) = report.defect(DefectKind::SelfIntersection) {
            if crossings.count > MOST_CROSSINGS
                || crossing_area(&soup) > FEW_CROSSINGS * report.area
            {
                return Err(defective(&report));
            }
            done.push(Repair::LeftCrossings {
                pairs: crossings.count,
                place: crossings.place,
            });
        }
        let mesh = Mesh::new(soup.vertices, soup.triangles)?;
        Ok(Mended { mesh, done })
    }
}

/// Defects that keep shells from being closed and facing outward.
const UNMENDED: [DefectKind; 5] = [
    DefectKind::OpenEdge,
    DefectKind::NonManifold,
    DefectKind::Inconsistent,
    DefectKind::Inverted,
    DefectKind::Duplicate,
];

/// Defects of shells that have something to do with each other.
const SEVERAL: [DefectKind; 3] = [
    DefectKind::Overlap,
    DefectKind::Redundant,
    DefectKind::Contact,
];

/// The part of the area that triangles may have which cross others of their shell.
const FEW_CROSSINGS: f64 = 0.01;

/// More pairs of triangles that cross than this are not few, however small they are.
const MOST_CROSSINGS: usize = 500;

/// Area of the triangles that cross others.
fn crossing_area(soup: &Soup) -> f64 {
    let crossing: BTreeSet<u32> = Survey::new(soup)
        .meetings
        .within
        .iter()
        .flat_map(|&(i, j)| [i, j])
        .collect();
    crossing
        .iter()
        .map(|&t| triangle::area(&soup.corners(t as usize)))
        .sum()
}

/// What keeps a mesh from being a body.
fn defective(report: &MeshReport) -> GeometryError {
    let mut words = Vec::new();
    for defect in &report.defects {
        if defect.kind.is_harmless() {
            continue;
        }
        let mut text = match defect.kind {
            DefectKind::OpenEdge | DefectKind::NonManifold => {
                format!("the mesh is not closed: {defect}")
            }
            _ => defect.to_string(),
        };
        if defect.kind == DefectKind::OpenEdge
            && let Some(hole) = report.holes.first()
        {
            text += &format!(
                "; {} of {} edges, the largest {} across, too large to be closed unasked",
                match report.holes.len() {
                    1 => "1 hole".to_owned(),
                    n => format!("{n} holes"),
                },
                defect.count,
                super::report::four_digits(hole.size)
            );
        }
        words.push(format!("{text}; {}", defect.kind.cure()));
    }
    MeshError::Defective {
        defects: words.join(". "),
    }
    .into()
}
