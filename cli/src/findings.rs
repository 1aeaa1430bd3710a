//! What the check of a body's file finds, as it is written to JSON.

use serde::Serialize;
use sphpack_geometry::{Hole, MeshReport, OutlineReport, Shell};

/// A mesh as it is in its file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshFindings {
    /// Triangles.
    pub triangles: usize,
    /// Different vertices.
    pub vertices: usize,
    /// What is wrong.
    pub defects: Vec<DefectFound>,
    /// Open rims, the largest first.
    pub holes: Vec<Hole>,
    /// Parts that hang together.
    pub shells: Vec<Shell>,
}

/// A defect, with what only the library could tell a reader of the JSON: whether it matters, and the words.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DefectFound {
    /// Its short name.
    pub kind: &'static str,
    /// How often.
    pub count: usize,
    /// The first, scene units.
    pub place: Vec<f64>,
    /// Whether it matters.
    pub is_harmless: bool,
    /// The same in words.
    pub words: String,
}

/// An outline as it is in its file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutlineFindings {
    /// Points.
    pub points: usize,
    /// What is wrong.
    pub defects: Vec<DefectFound>,
    /// Its loops.
    pub loops: Vec<LoopFound>,
}

/// A loop. Its direction is told apart from its area, which a `SketchLoop` has in one signed number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoopFound {
    /// Points, those that repeat the one before left out.
    pub points: usize,
    /// What it is to the body: body, hole, nothing (it has no area, or is there already), undecided (it crosses itself or
    /// overlaps another).
    pub role: &'static str,
    /// Whether it runs clockwise. The body does not depend on that.
    pub is_clockwise: bool,
    /// The smallest loop around it, counted from 0.
    pub inside: Option<usize>,
    /// Lower corner of its box.
    pub min: [f64; 2],
    /// Upper corner.
    pub max: [f64; 2],
    /// Its length.
    pub length: f64,
    /// What it encloses; means little where it crosses itself.
    pub area: f64,
}

impl From<MeshReport> for MeshFindings {
    fn from(report: MeshReport) -> Self {
        Self {
            triangles: report.triangles,
            vertices: report.vertices,
            defects: report
                .defects
                .iter()
                .map(|defect| DefectFound {
                    kind: defect.kind.name(),
                    count: defect.count,
                    place: defect.place.to_vec(),
                    is_harmless: defect.kind.is_harmless(),
                    words: defect.to_string(),
                })
                .collect(),
            holes: report.holes,
            shells: report.shells,
        }
    }
}

impl From<OutlineReport> for OutlineFindings {
    fn from(report: OutlineReport) -> Self {
        Self {
            points: report.loops.iter().map(|one| one.points).sum(),
            defects: report
                .defects
                .iter()
                .map(|defect| DefectFound {
                    kind: defect.kind.name(),
                    count: defect.count,
                    place: defect.place.to_vec(),
                    is_harmless: defect.kind.is_harmless(),
                    words: defect.to_string(),
                })
                .collect(),
            loops: report
                .loops
                .iter()
                .map(|one| LoopFound {
                    points: one.points,
                    role: one.role.name(),
                    is_clockwise: one.area < 0.0,
                    inside: one.inside,
                    min: one.bounds.min,
                    max: one.bounds.max,
                    length: one.length,
                    area: one.area.abs(),
                })
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use sphpack_geometry::Soup;

    use super::*;

    #[test]
    fn keys_and_their_order_stay() {
        let leaf = Soup::from_loose(&[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]).unwrap();
        let found = MeshFindings::from(leaf.check());
        assert_eq!(
            serde_json::to_string(&found.shells).unwrap(),
            r#"[{"triangles":1,"role":"undecided","is_inverted":false,"inside":null,"min":[0.0,0.0,0.0],"max":[1.0,1.0,0.0],"area":0.5,"volume":0.0}]"#
        );
        assert_eq!(
            serde_json::to_string(&found.holes).unwrap(),
            r#"[{"edges":3,"size":1.4142135623730951,"place":[0.5,0.5,0.0]}]"#
        );
    }
}
