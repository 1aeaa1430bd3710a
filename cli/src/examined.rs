//! What can be said of a body's file before it is packed: the content of `sphpack check`.

use std::path::{Path, PathBuf};

use serde::{Serialize, Serializer};
use sphpack_geometry::{
    BodyFormat, GeometryError, HoleLimit, Mesh, MeshReport, Outline, Soup, Surface,
};
use sphpack_neighbors::Bounds;

use crate::Error;
use crate::body_file::{self, body_format};

/// The version of the keys.
const SCHEMA: u32 = 1;

/// Places on a surface at which its thickness is measured.
const PROBES: usize = 4000;

/// A body's file, examined.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Examined {
    /// 1.
    pub schema: u32,
    /// The file.
    pub file: PathBuf,
    /// What it was read as: stl, obj, ply, csv, dat (an airfoil) or svg, whatever its name.
    #[serde(serialize_with = "extension")]
    pub format: BodyFormat,
    /// 2 or 3.
    pub dimension: usize,
    /// Whether `sphpack pack` packs it, after the `repairs` where there are any.
    pub can_be_packed: bool,
    /// What keeps it from being packed, with the cure.
    pub reason: Option<String>,
    /// What packing mends first, or the repair that was asked for; a sentence each.
    pub repairs: Vec<String>,
    /// Lower corner of the box around it, scene units.
    pub min: Vec<f64>,
    /// Upper corner.
    pub max: Vec<f64>,
    /// Perimeter or surface area, after repairs; as it is where it cannot be packed.
    pub measure: f64,
    /// Area or volume, likewise.
    pub volume: f64,
    /// Of a mesh, before repairs.
    pub mesh: Option<MeshFindings>,
    /// Where a spacing was given: what is thinner.
    pub thin: Option<Thin>,
}

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
    pub place: [f64; 3],
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

/// What is thinner than a particle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Thin {
    /// ∆s, scene units.
    pub spacing: f64,
    /// The part of the surface where the body is thinner than ∆s.
    pub part_of_surface: f64,
    /// The least thickness found, at most 2 ∆s.
    pub thinnest: f64,
    /// Where.
    pub place: Vec<f64>,
}

/// What to find out, and to mend.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Examine {
    /// ∆s, to find what is thinner.
    pub spacing: Option<f64>,
    /// How a mesh is mended.
    pub mend: Mend,
}

/// How a mesh is mended.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Mend {
    /// As packing does: holes that cannot matter are closed.
    #[default]
    AsPacking,
    /// Holes up to this size are closed, scene units.
    FillHoles(f64),
    /// It is wrapped in a new mesh, on a grid with cells of this size, scene units.
    Wrap(f64),
}

impl Examined {
    /// Reads a body and examines it; and the mended body, where it is a mesh that can be packed.
    ///
    /// # Errors
    /// [`Error::Input`] where the file cannot be read, or is an outline that cannot be used.
    pub fn of(path: &Path, what: &Examine) -> Result<(Self, Option<Mesh>), Error> {
        let in_file = |source: GeometryError| match source {
            GeometryError::InFile { path, source } => Error::Input {
                path: path.into(),
                at: None,
                message: source.to_string(),
            },
            source => Error::input(path, source.to_string()),
        };
        // What keeps the file from being opened is said as of any other file.
        if body_format(path)?.dimension() == 2 {
            let (format, outline) = body_file::read(path, Outline::from_bytes).map_err(in_file)?;
            let mut examined = Self::new(path, format, outline.bounds());
            examined.be(&outline, what.spacing);
            return Ok((examined, None));
        }
        let (format, soup) = body_file::read(path, Soup::from_bytes).map_err(in_file)?;
        let report = soup.check();
        let mut examined = Self::new(path, format, report.bounds);
        examined.measure = report.area;
        examined.volume = report.volume;
        let body = match what.mend {
            Mend::AsPacking => soup.body_knowing(&report),
            Mend::FillHoles(most) => soup.repaired(HoleLimit::Across(most)).body(),
            Mend::Wrap(cell) => match soup.wrapped(cell) {
                Err(e @ GeometryError::BadParameter { .. }) => {
                    return Err(Error::Usage(format!("--wrap {cell} does not work: {e}")));
                }
                wrapped => wrapped,
            },
        };
        examined.mesh = Some(report.into());
        match body {
            Ok(mended) => {
                examined.repairs = mended.done.iter().map(ToString::to_string).collect();
                examined.be(&mended.mesh, what.spacing);
                Ok((examined, Some(mended.mesh)))
            }
            Err(reason) => {
                examined.reason = Some(reason.to_string());
                Ok((examined, None))
            }
        }
    }

    fn new<const D: usize>(path: &Path, format: BodyFormat, bounds: Bounds<D>) -> Self {
        Self {
            schema: SCHEMA,
            file: path.to_owned(),
            format,
            dimension: D,
            can_be_packed: false,
            reason: None,
            repairs: Vec::new(),
            min: bounds.min.to_vec(),
            max: bounds.max.to_vec(),
            measure: 0.0,
            volume: 0.0,
            mesh: None,
            thin: None,
        }
    }

    /// It is a body: this one.
    fn be<const D: usize>(&mut self, surface: &dyn Surface<D>, spacing: Option<f64>) {
        self.can_be_packed = true;
        self.measure = surface.measure();
        self.volume = surface.volume();
        self.thin = spacing.map(|spacing| thin(surface, spacing));
    }
}

fn extension<S: Serializer>(format: &BodyFormat, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(format.extension())
}

/// Measures the thickness at places that stand for equal parts of the surface.
fn thin<const D: usize>(surface: &dyn Surface<D>, spacing: f64) -> Thin {
    let probes = surface.strew(PROBES);
    let mut found = Thin {
        spacing,
        part_of_surface: 0.0,
        thinnest: 2.0 * spacing,
        place: Vec::new(),
    };
    let mut below = 0;
    for at in &probes {
        let thickness = sphpack_geometry::thickness(surface, at, 2.0 * spacing);
        below += usize::from(thickness < spacing);
        if thickness < found.thinnest || found.place.is_empty() {
            found.thinnest = thickness;
            found.place = at.point.to_vec();
        }
    }
    found.part_of_surface = below as f64 / probes.len().max(1) as f64;
    found
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
                    place: defect.place,
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
