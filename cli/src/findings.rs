//! What the check of a body's file finds, as it is written to JSON.

use serde::Serialize;
use sphpack_geometry::{MeshReport, OutlineReport};

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
    pub holes: Vec<HoleFound>,
    /// Parts that hang together.
    pub shells: Vec<ShellFound>,
}

/// A defect.
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

/// A hole.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HoleFound {
    /// Open edges.
    pub edges: usize,
    /// How large across, scene units.
    pub size: f64,
    /// Where.
    pub place: [f64; 3],
}

/// A shell.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShellFound {
    /// Triangles.
    pub triangles: usize,
    /// What it is to the body: body, cavity, redundant, undecided (it is open, or its triangles disagree).
    pub role: &'static str,
    /// Whether it faces the wrong way for that.
    pub is_inverted: bool,
    /// The shell around it, counted from 0.
    pub inside: Option<usize>,
    /// Lower corner of its box.
    pub min: [f64; 3],
    /// Upper corner.
    pub max: [f64; 3],
    /// Its area.
    pub area: f64,
    /// What it encloses, negative where it faces inward; means little where it is open.
    pub volume: f64,
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

/// A loop.
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
            holes: report
                .holes
                .iter()
                .map(|hole| HoleFound {
                    edges: hole.edges,
                    size: hole.size,
                    place: hole.place,
                })
                .collect(),
            shells: report
                .shells
                .iter()
                .map(|shell| ShellFound {
                    triangles: shell.triangles,
                    role: shell.role.name(),
                    is_inverted: shell.is_inverted,
                    inside: shell.inside,
                    min: shell.bounds.min,
                    max: shell.bounds.max,
                    area: shell.area,
                    volume: shell.volume,
                })
                .collect(),
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
