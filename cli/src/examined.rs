//! What can be said of a body's file before it is packed: the content of `sphpack check`.

use std::path::{Path, PathBuf};

use serde::Serialize;
use sphpack_geometry::{
    BodyFormat, GeometryError, HoleLimit, Mesh, Outline, ParameterError, Sketch, Soup, Surface,
};
use sphpack_neighbors::Bounds;

use crate::Error;
use crate::body_file::BodyFile;
use crate::error::cured;
use crate::findings::{MeshFindings, OutlineFindings};

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
    /// Of an outline, before repairs.
    pub outline: Option<OutlineFindings>,
    /// Where a spacing was given: what is thinner.
    pub thin: Option<Thin>,
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

/// What is packed, or written by a repair.
#[derive(Debug, Clone)]
pub enum MendedBody {
    /// In space.
    Mesh(Mesh),
    /// In the plane.
    Outline(Outline),
}

impl Examined {
    /// The findings as JSON text, a line break at its end.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).map_or_else(|_| String::new(), |text| text + "\n")
    }

    /// Reads a body and examines it; and the mended body, where it can be packed.
    ///
    /// # Errors
    /// [`Error::Input`] where the file cannot be read.
    pub fn of(path: &Path, what: &Examine) -> Result<(Self, Option<MendedBody>), Error> {
        let in_file = |source: GeometryError| match source {
            GeometryError::InFile { path, error } => Error::input(&path, cured(&error)),
            source => Error::input(path, cured(&source)),
        };
        // What keeps the file from being opened is said as of any other file.
        let file = BodyFile::read(path)?;
        if file.format.dimension() == 2 {
            let (format, sketch) = file.body(Sketch::from_bytes).map_err(in_file)?;
            return Ok(Self::of_sketch(path, format, &sketch, what.spacing));
        }
        let (format, soup) = file.body(Soup::from_bytes).map_err(in_file)?;
        drop(file);
        let report = soup.check();
        let mut examined = Self::new(path, format, report.bounds);
        examined.measure = report.area;
        examined.volume = report.volume;
        let body = match what.mend {
            Mend::AsPacking => soup.body_knowing(&report),
            Mend::FillHoles(most) => soup.repaired(HoleLimit::Across(most)).body(),
            Mend::Wrap(cell) => match soup.wrapped(cell) {
                Err(e @ GeometryError::Parameter(ParameterError::OutOfRange { .. })) => {
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
                Ok((examined, Some(MendedBody::Mesh(mended.mesh))))
            }
            Err(reason) => {
                examined.reason = Some(cured(&reason));
                Ok((examined, None))
            }
        }
    }

    fn of_sketch(
        path: &Path,
        format: BodyFormat,
        sketch: &Sketch,
        spacing: Option<f64>,
    ) -> (Self, Option<MendedBody>) {
        let report = sketch.check();
        let mut examined = Self::new(path, format, report.bounds);
        examined.measure = report.loops.iter().map(|one| one.length).sum();
        examined.volume = report.area();
        let body = sketch.body_knowing(&report);
        examined.outline = Some(report.into());
        match body {
            Ok(mended) => {
                examined.repairs = mended.done.iter().map(ToString::to_string).collect();
                examined.be(&mended.outline, spacing);
                (examined, Some(MendedBody::Outline(mended.outline)))
            }
            Err(reason) => {
                examined.reason = Some(cured(&reason));
                (examined, None)
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
            outline: None,
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

/// Measures the thickness at places that stand for equal parts of the surface.
fn thin<const D: usize>(surface: &dyn Surface<D>, spacing: f64) -> Thin {
    let probes = surface.scatter(PROBES);
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
