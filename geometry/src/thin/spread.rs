//! Points over the particle surface of a body with thin parts.

use sphpack_neighbors::point;

use super::shares::{Place, Shares};
use crate::GeometryError;
use crate::sample::{Candidates, Local, occupied, settle};
use crate::surface::{Closest, Surface};
use crate::thickness::through;

/// Points are spread as if there were no fewer per area than this part of the full number: under a particle surface
/// there is half, and on an exact one what is thinner need not be even.
const LEAST_DENSITY: f64 = 0.25;

/// `count` points on `surface`, which is `shares.depth` inside the body, as dense as the body is thick.
pub(super) fn over<const D: usize>(
    body: &dyn Surface<D>,
    surface: &dyn Surface<D>,
    shares: &Shares<D>,
    count: usize,
) -> Result<Vec<Closest<D>>, GeometryError> {
    let held = occupied(surface, shares.spacing, count);
    if held.len() == count {
        return Ok(held);
    }
    let root = 1.0 / (D as f64 - 1.0);
    let local = |thickness: f64| {
        let density = shares.density(thickness);
        Local {
            spacing: shares.spacing * density.max(LEAST_DENSITY).powf(-root),
            across: shares.spacing,
            unit: shares.spacing,
        }
    };
    let below = |place: &Place<D>| Closest {
        point: point::add_scaled(place.foot.point, -shares.depth, place.foot.normal),
        ..place.foot
    };
    let mut locals: Vec<Local> = held
        .iter()
        .map(|site| {
            let foot = body.closest(site.point);
            let away = point::sub(site.point, foot.point);
            let inward = point::unit(away).unwrap_or_else(|| point::scale(site.normal, -1.0));
            local(through(body, foot.point, inward, 2.0 * shares.spacing))
        })
        .collect();
    locals.extend(shares.over.iter().map(|place| local(place.thickness)));
    let hits: Vec<Closest<D>> = shares.over.iter().map(below).collect();
    let candidates = Candidates::of(&hits);
    let near = |p| surface.closest(p);
    let locals = (locals.as_slice(), shares.spacing);
    Ok(settle(surface, held, &candidates, count, locals, &near))
}
