//! Points spread over a surface in space: corners, sharp edges, then everything between.

use rayon::prelude::*;
use sphpack_neighbors::Domain;

use super::candidates::Candidates;
use super::local::Local;
use super::{features, relax, thinning};
use crate::continued::within_window;
use crate::surface::{Closest, Feature, Surface};
use crate::{GeometryError, ParameterError};

/// Candidates per point.
const CANDIDATES: usize = 6;

/// `count` points spread evenly over `surface`. `near` answers like [`Surface::closest`] near the surface, perhaps
/// less exactly and faster; `scatter` gives so many candidates for a spacing.
pub(crate) fn spread<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    count: usize,
    near: &(impl Fn([f64; D]) -> Closest<D> + Sync),
    scatter: impl FnOnce(f64, usize) -> Candidates<D>,
) -> Result<Vec<Closest<D>>, GeometryError> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let rough = (surface.measure() / count as f64).sqrt();
    let sites = features::occupied(surface, rough, count);
    if sites.len() == count {
        return Ok(sites);
    }
    let candidates = scatter(rough, CANDIDATES * count);
    if candidates.point.is_empty() {
        return Err(ParameterError::OutOfRange {
            of: "sample",
            name: "area of the surface",
            value: candidates.area,
            needs: "large enough to be found between points of a grid",
        }
        .into());
    }
    let spacing = (candidates.area / count as f64).sqrt();
    let locals = vec![Local::even(spacing); sites.len() + candidates.point.len()];
    Ok(settle(
        surface,
        sites,
        &candidates,
        count,
        (&locals, spacing),
        near,
    ))
}

/// `count` points of the surface: `held`, which stay where they are, and the evenest of the candidates, moved on until
/// all are as far apart as `locals` (of the held points, then of the candidates; `spacing` on average) ask for.
pub(crate) fn settle<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    held: Vec<Closest<D>>,
    candidates: &Candidates<D>,
    count: usize,
    (locals, spacing): (&[Local], f64),
    near: &(impl Fn([f64; D]) -> Closest<D> + Sync),
) -> Vec<Closest<D>> {
    let mut sites = held;
    let held = sites.len();
    let window = surface.window();
    let window = window.as_ref();
    let kept = thinning::keep_evenest(candidates, &sites, count - held, locals, window);
    let start: Vec<Closest<D>> = kept
        .par_iter()
        .with_min_len(64)
        .map(|&i| near(candidates.point[i]))
        .collect();
    sites.extend(start);
    let of_kept = kept.iter().map(|&i| locals[held + i]);
    let locals: Vec<Local> = locals[..held].iter().copied().chain(of_kept).collect();
    relax::even_out(&mut sites, held, (&locals, spacing), near, window);
    sites[held..]
        .par_iter_mut()
        .with_min_len(64)
        .for_each(|site| {
            // Held in place is only what features were given, not what came to lie on a crease.
            *site = Closest {
                distance: 0.0,
                feature: Feature::Smooth,
                ..put(surface, site.point, window)
            };
        });
    sites
}

/// The point of the surface nearest to `p`, within the box beyond which it goes on.
fn put<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    p: [f64; D],
    window: Option<&Domain<D>>,
) -> Closest<D> {
    match window {
        Some(window) => within_window(surface, window, surface.closest(window.wrap(p))),
        None => surface.closest(p),
    }
}
