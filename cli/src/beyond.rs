//! Bodies that pass the sides of the box, or have faces on them.

use std::sync::Arc;

use sphpack_geometry::{Continued, Outline, Surface};
use sphpack_neighbors::{Bounds, Domain, words};

use crate::Error;
use crate::dimension::{Built, Cuttable, Dimension, Space};
use crate::scene::{Method, Role, Scene};

/// How far beyond a side a body must reach to be told that it is cut there, in ∆s.
pub(crate) const TOLD_OVER_SPACING: f64 = 1e-3;

/// A box of more sites than this is refused, and everything in it would be on its sides.
const MOST_SITES: f64 = 1e11;

/// A body is joined with its images as long as it is no longer than so many periods, in the plane and in space: there
/// the images of a long rod aslant are many meshes to join.
const MOST_PERIODS: [f64; 2] = [16.0, 2.0];

/// Part of a period by which a body may be longer and still be as long: numbers of single precision are.
const AS_LONG: f64 = 1e-5;

/// A part of a body, or of the box, smaller than this is none.
const NOTHING: f64 = 1e-9;

/// Solid bodies go on beyond the sides of the box that they pass, or lie on: there they have no surface. Gives a sentence for each
/// that is cut. The published methods have no such bodies.
pub(crate) fn go_on<const D: usize>(
    scene: &Scene,
    all: &mut [Built<D>],
    domain: &Domain<D>,
) -> Result<Vec<String>, Error>
where
    Space<D>: Dimension<D>,
{
    let mut told = Vec::new();
    let fail = |message: String| Error::Scene {
        path: scene.path.clone(),
        at: None,
        message,
    };
    let sites: f64 = (domain.bounds.size().iter())
        .map(|edge| edge / scene.spacing)
        .product();
    if sites > MOST_SITES {
        return Ok(told);
    }
    for (body, built) in scene.body.iter().zip(all) {
        let bounds = built.surface.bounds();
        let goes_on = body.role == Role::Solid && scene.packing.method == Method::Balanced;
        let most = if goes_on { MOST_PERIODS[D - 2] } else { 1.0 };
        if let Some((name, periods)) = too_long(&bounds, domain, most) {
            return Err(fail(if goes_on {
                format!(
                    "body \"{}\" is {periods:.1} times as long as the periodic box along {name}; {most} times are the most, so make the domain longer or the body shorter",
                    body.name
                )
            } else {
                format!(
                    "body \"{}\" is {periods:.4} times as long as the periodic box along {name} and meets its own images; only solid bodies may, with method = \"balanced\"; make it no longer than the box",
                    body.name
                )
            }));
        }
        if body.role != Role::Solid || !Continued::may_go_on(&bounds, domain) {
            continue;
        }
        let sides = passed(&bounds, domain, TOLD_OVER_SPACING * scene.spacing);
        if scene.packing.method != Method::Balanced {
            if sides.is_empty() {
                continue;
            }
            return Err(fail(format!(
                "body \"{}\" reaches outside the domain, beyond the {}; enlarge the domain, use margin = … instead of min and max, or method = \"balanced\", which cuts bodies at its sides",
                body.name,
                sides.join(" and ")
            )));
        }
        let continued = Space::<D>::continued(body, built, domain, scene.spacing);
        let Some(continued) = continued.map_err(|source| Error::Body {
            path: scene.path.clone(),
            body: body.name.clone(),
            error: source,
        })?
        else {
            continue;
        };
        let (volume, whole) = (continued.volume(), built.surface.volume());
        if volume <= NOTHING * whole.min(domain.bounds.volume()) {
            return Err(fail(format!(
                "body \"{}\" lies outside the domain (body from {}); enlarge the domain, move the body, or leave it out",
                body.name,
                words::corners(&bounds.min, &bounds.max)
            )));
        }
        if !sides.is_empty() {
            let of = match built.is_cut {
                true => String::new(),
                false => format!(" of its {whole:.4e}"),
            };
            told.push(format!(
                "body \"{}\" reaches beyond the {} of the domain and is cut there: {volume:.4e}{of} is inside",
                body.name,
                sides.join(" and ")
            ));
            if D == 2 {
                built.loops = drawn(std::mem::take(&mut built.loops), &bounds, domain);
            }
        }
        built.surface = Arc::new(continued);
    }
    Ok(told)
}

/// An axis, by name, along which a body is longer than so many periods, and how many it is.
fn too_long<const D: usize>(
    bounds: &Bounds<D>,
    domain: &Domain<D>,
    most: f64,
) -> Option<(&'static str, f64)> {
    let (size, period) = (bounds.size(), domain.bounds.size());
    (["x", "y", "z"].into_iter().enumerate().take(D))
        .map(|(axis, name)| (axis, name, size[axis] / period[axis]))
        .find(|&(axis, _, periods)| domain.periodic[axis] && periods > most * (1.0 + AS_LONG))
        .map(|(_, name, periods)| (name, periods))
}

/// What of an outline is drawn: the part between the open sides.
fn drawn<const D: usize>(
    loops: Vec<Vec<[f64; 2]>>,
    around: &Bounds<D>,
    domain: &Domain<D>,
) -> Vec<Vec<[f64; 2]>> {
    let side = |k: usize, of: [[f64; D]; 2]| of[usize::from(domain.periodic[k])][k];
    let (low, high) = (
        [domain.bounds.min, around.min],
        [domain.bounds.max, around.max],
    );
    let [a, b, c, d] = [side(0, low), side(1, low), side(0, high), side(1, high)];
    let part = Outline::new(loops.clone()).and_then(|all| {
        Ok(all.intersection(&Outline::polygon(&[[a, b], [c, b], [c, d], [a, d]])?))
    });
    match part {
        Ok(Some(part)) => part.loops().map(<[_]>::to_vec).collect(),
        _ => loops,
    }
}

/// The open sides that a body passes by more than `slack`, in words.
fn passed<const D: usize>(bounds: &Bounds<D>, domain: &Domain<D>, slack: f64) -> Vec<String> {
    let mut sides = Vec::new();
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate().take(D) {
        if domain.periodic[axis] {
            continue;
        }
        if bounds.min[axis] < domain.bounds.min[axis] - slack {
            sides.push(format!("lower {name} side"));
        }
        if bounds.max[axis] > domain.bounds.max[axis] + slack {
            sides.push(format!("upper {name} side"));
        }
    }
    sides
}
