//! Bodies in other units than the spacing: a file in millimetres beside a spacing in metres is a thousand times too large.

use std::ops::RangeInclusive;

use sphpack_neighbors::{Bounds, point};
use sphpack_packing::{Body, PackingError, Problem};

use crate::scene::{BodySpec, Scene};

/// Spacings across a body that somebody may well have meant.
const SENSIBLE: RangeInclusive<f64> = 5.0..=500.0;

/// A file in millimetres, the spacing in metres.
const SMALLER: f64 = 1e-3;

/// The other way round.
const LARGER: f64 = 1e3;

/// What to do where a body from a file would be of a sensible size in other units, and the refusal would be gone.
pub(crate) fn advice<const D: usize>(
    scene: &Scene,
    problem: &Problem<D>,
    refusal: &PackingError,
) -> Option<String> {
    let bodies = || scene.body.iter().zip(&problem.bodies);
    let named = |name: &str| bodies().find(|(body, _)| body.name == name);
    match refusal {
        PackingError::SpacingLargerThanBody { body, .. } => {
            let (body, built) = named(body)?;
            words(scene, body, across(built) / scene.spacing, LARGER)
        }
        PackingError::OutsideDomain { body, .. } => {
            let (body, built) = named(body)?;
            let shift: [f64; D] = point::of_slice(body.translate.as_deref().unwrap_or(&[]));
            let Bounds { min, max } = built.surface.bounds();
            let [min, max] = [min, max]
                .map(|corner| point::add_scaled(shift, SMALLER, point::sub(corner, shift)));
            let fits = problem.domain.bounds.contains_box(&Bounds::new(min, max));
            let number = across(built) / scene.spacing;
            fits.then(|| words(scene, body, number, SMALLER))?
        }
        PackingError::TooLarge { .. } => {
            // The box must become smaller with the bodies.
            let margin = scene.domain.margin.unwrap_or(0.0) / scene.spacing;
            if scene.domain.min.is_some() || margin > *SENSIBLE.end() {
                return None;
            }
            let large = bodies()
                .map(|(body, built)| (body, across(built) / scene.spacing))
                .filter(|(_, number)| number > SENSIBLE.end());
            let all: Option<Vec<String>> = large
                .map(|(body, number)| words(scene, body, number, SMALLER))
                .collect();
            all.filter(|all| !all.is_empty()).map(|all| all.join("; "))
        }
        _ => None,
    }
}

/// The longest edge of a body's box.
fn across<const D: usize>(body: &Body<D>) -> f64 {
    (body.surface.bounds().size().into_iter()).fold(0.0, f64::max)
}

/// A body from a file that is `number` spacings across, and would sensibly be `factor` times as many.
fn words(scene: &Scene, body: &BodySpec, number: f64, factor: f64) -> Option<String> {
    let file = body.shape.file()?;
    let number = factor * number;
    if !SENSIBLE.contains(&number) {
        return None;
    }
    let units = if factor < 1.0 {
        "in millimetres"
    } else {
        "in metres and the spacing in millimetres"
    };
    // A thousandth of 0.1 is 0.0001, without the digits that rounding leaves.
    let scale = factor * body.scale;
    let scale: f64 = format!("{scale:.12e}").parse().unwrap_or(scale);
    let is_on_command_line = scene.resolve(file) == scene.path;
    let cure = if is_on_command_line {
        format!("--scale {scale}")
    } else {
        format!("scale = {scale} in body \"{}\"", body.name)
    };
    // Where nothing else scales it, a word says the same.
    let same = match (scale == SMALLER, is_on_command_line) {
        (false, _) => "",
        (true, true) => " (--units mm is the same)",
        (true, false) => " (units = \"mm\" is the same)",
    };
    Some(format!(
        "if {} is {units}, {cure} makes it {number:.0} spacings across{same}",
        file.display()
    ))
}
