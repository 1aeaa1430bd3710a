//! The field of spacings that a scene asks for.

use std::path::Path;

use sphpack_geometry::Similarity;
use sphpack_packing::{Curved, Finest, Problem, Refinement, Resolution, SampledField};

use crate::Error;
use crate::body_file::{BodyFile, of_body};
use crate::dimension::{Dimension, Space};
use crate::files::Columns;
use crate::scene::{RefinementSpec, Scene};

/// The field around the problem's bodies and the scene's regions, and of its file.
///
/// # Errors
/// Files that cannot be read or used.
pub(crate) fn field<const D: usize>(
    scene: &Scene,
    refinement: &RefinementSpec,
    problem: &Problem<D>,
) -> Result<Resolution<D>, Error>
where
    Space<D>: Dimension<D>,
{
    let mut field = Refinement::new(refinement.coarsest, refinement.growth);
    for (number, body) in problem.bodies.iter().enumerate() {
        let usual = scene.spacing_of(number);
        field = field.around(body.surface.clone(), usual);
        if let Some(per_radius) = scene.body[number].curvature {
            let curved = Curved {
                per_radius,
                finest: scene.finest(),
                usual,
            };
            field = field.curved(&*body.surface, &problem.domain, curved);
        }
    }
    for (number, region) in refinement.region.iter().enumerate() {
        let name = format!("refinement.region {}", number + 1);
        let file = match region.shape.file() {
            Some(file) => {
                let read = BodyFile::read(&scene.resolve(file));
                Some(read.map_err(|error| of_body(error, &scene.path, &name))?)
            }
            None => None,
        };
        let built = Space::<D>::build(&region.shape, file.as_ref(), &Similarity::identity());
        let surface = built.map_err(|error| Error::Body {
            path: scene.path.clone(),
            body: name,
            error,
        })?;
        let surface = problem.placed(surface.surface);
        field = field.within(surface, scene.no_finer(region.spacing));
    }
    Ok(match &refinement.field {
        None => field.into(),
        Some(file) => {
            let sampled = read(&scene.resolve(file), |s| scene.no_finer(s))?;
            Finest::of([field.into(), sampled.limited(refinement.growth).into()]).into()
        }
    })
}

/// Reads spacings at the nodes of a grid: the columns x, y, in space z, and spacing (scene units) of any format that particles
/// are read from, rows in any order. `held` says what becomes of a spacing.
///
/// # Errors
/// [`Error::Input`] where the file cannot be read, lacks a column, or has no grid in it.
fn read<const D: usize>(path: &Path, held: impl Fn(f64) -> f64) -> Result<SampledField<D>, Error> {
    let columns = Columns::read(path)?;
    let column = |name: &str| {
        let names = if D == 2 { "x, y" } else { "x, y, z" };
        columns.numbers.get(name).ok_or_else(|| {
            Error::input(
                path,
                format!(
                    "there is no column \"{name}\"; refinement.field needs {names} and spacing"
                ),
            )
        })
    };
    let mut axes: [&[f64]; D] = [&[]; D];
    for (axis, name) in axes.iter_mut().zip(["x", "y", "z"]) {
        *axis = column(name)?;
    }
    let spacings: Vec<f64> = column("spacing")?.iter().map(|&s| held(s)).collect();
    let points: Vec<[f64; D]> = (0..spacings.len())
        .map(|i| axes.map(|axis| axis[i]))
        .collect();
    SampledField::of_points(&points, &spacings)
        .map_err(|error| Error::input(path, error.to_string()))
}
