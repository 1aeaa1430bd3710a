//! Whether bodies have room that both claim.

use sphpack_geometry::Surface;
use sphpack_neighbors::{Bounds, point};
use sphpack_packing::Body;

/// How deep bodies may be in each other, in ∆s, and still count as touching.
pub(crate) const TOUCHING_OVER_SPACING: f64 = 0.1;

/// Places per particle of a surface that are looked at.
pub(crate) const PER_PARTICLE: f64 = 4.0;

/// A place that two bodies claim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Overlap<const D: usize> {
    /// The bodies' places in the list.
    pub(crate) bodies: [usize; 2],
    /// Where, scene units.
    pub(crate) place: [f64; D],
    /// How deep it is in both, at least, scene units.
    pub(crate) depth: f64,
}

/// The first two bodies that overlap by more than a tenth of ∆s, of those that `claims` room; at the deepest place found.
///
/// Looks at some four places per surface particle, on each surface and a little behind it.
pub(crate) fn first<const D: usize>(
    bodies: &[Body<D>],
    spacing: f64,
    claims: impl Fn(usize) -> bool,
) -> Option<Overlap<D>> {
    let claiming: Vec<usize> = (0..bodies.len()).filter(|&i| claims(i)).collect();
    for (n, &i) in claiming.iter().enumerate() {
        for &j in &claiming[n + 1..] {
            let (a, b) = (bodies[i].surface.as_ref(), bodies[j].surface.as_ref());
            if let Some((place, depth)) = between(a, b, spacing) {
                return Some(Overlap {
                    bodies: [i, j],
                    place,
                    depth,
                });
            }
        }
    }
    None
}

/// The deepest place found that two bodies claim, and how deep it is, if that is more than a tenth of ∆s.
fn between<const D: usize>(
    a: &dyn Surface<D>,
    b: &dyn Surface<D>,
    spacing: f64,
) -> Option<([f64; D], f64)> {
    deeper_than(TOUCHING_OVER_SPACING, a, b, spacing)
}

/// The deepest place found that two bodies claim, and how deep it is, if that is more than so much, in ∆s.
pub(crate) fn deeper_than<const D: usize>(
    depth_over_spacing: f64,
    a: &dyn Surface<D>,
    b: &dyn Surface<D>,
    spacing: f64,
) -> Option<([f64; D], f64)> {
    let slack = depth_over_spacing * spacing;
    let common = common(a.bounds(), b.bounds());
    if (0..D).any(|k| common.max[k] - common.min[k] <= slack) {
        return None;
    }
    let places = [(a, b), (b, a)].map(|(a, b)| deepest(a, b, common, spacing, slack));
    places
        .into_iter()
        .flatten()
        .max_by(|p, q| p.1.total_cmp(&q.1))
}

/// Whether the boxes around two bodies have room in common.
pub(crate) fn may_overlap<const D: usize>(a: &dyn Surface<D>, b: &dyn Surface<D>) -> bool {
    let common = common(a.bounds(), b.bounds());
    (0..D).all(|k| common.max[k] > common.min[k])
}

fn common<const D: usize>(a: Bounds<D>, b: Bounds<D>) -> Bounds<D> {
    Bounds::new(
        std::array::from_fn(|k| a.min[k].max(b.min[k])),
        std::array::from_fn(|k| a.max[k].min(b.max[k])),
    )
}

/// Of places on the surface of `a` and just behind it, the deepest in `b`, if that is deeper than `slack`.
fn deepest<const D: usize>(
    a: &dyn Surface<D>,
    b: &dyn Surface<D>,
    within: Bounds<D>,
    spacing: f64,
    slack: f64,
) -> Option<([f64; D], f64)> {
    let count = PER_PARTICLE * a.measure() / spacing.powi(D as i32 - 1);
    let count = count.clamp(500.0, 50_000.0) as usize;
    let mut best: Option<([f64; D], f64)> = None;
    for at in a.strew(count) {
        // Behind it, so that two bodies that are alike are found too.
        for behind in [0.0, 2.0 * slack] {
            let p = point::add_scaled(at.point, -behind, at.normal);
            if !within.contains(p) {
                continue;
            }
            let mut depth = -b.closest(p).distance;
            if behind > 0.0 && depth > slack {
                // Behind something thinner it is in the open again.
                depth = depth.min(-a.closest(p).distance);
            }
            if depth > slack && best.is_none_or(|(_, d)| depth > d) {
                best = Some((p, depth));
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use sphpack_geometry::{Ball, Cuboid, Thin};

    use super::*;

    fn body<const D: usize>(surface: impl Surface<D> + 'static) -> Body<D> {
        Body {
            name: String::new(),
            surface: Arc::new(surface),
            inset_over_spacing: 0.5,
            thin: Thin::Mass,
        }
    }

    #[track_caller]
    fn check<const D: usize>(bodies: &[Body<D>], overlaps: bool) {
        let found = first(bodies, 0.1, |_| true);
        assert_eq!(found.is_some(), overlaps, "{found:?}");
        assert!(first(bodies, 0.1, |i| i == 0).is_none());
        if let Some(found) = found {
            for &i in &found.bodies {
                let distance = bodies[i].surface.closest(found.place).distance;
                assert!(distance < 1e-12, "{found:?}");
            }
        }
    }

    #[test]
    fn touching_is_no_overlap_and_nesting_is() {
        let ball = |x: f64, r: f64| body(Ball::new([x, 0.0, 0.0], r).unwrap());
        check(&[ball(0.0, 1.0), ball(2.0, 1.0)], false);
        check(&[ball(0.0, 1.0), ball(1.999, 1.0)], false);
        check(&[ball(0.0, 1.0), ball(1.9, 1.0)], true);
        check(&[ball(0.0, 1.0), ball(0.1, 0.3)], true);
        check(&[ball(0.1, 0.3), ball(0.0, 1.0)], true);
        check(&[ball(0.0, 1.0), ball(0.0, 1.0)], true);
        check(&[ball(0.0, 1.0), ball(5.0, 1.0)], false);
        let square = |x: f64, y: f64| body(Cuboid::new([x, y], [x + 1.0, y + 1.0]).unwrap());
        check(&[square(0.0, 0.0), square(1.0, 0.0)], false);
        check(&[square(0.0, 0.0), square(1.0, 0.3)], false);
        check(&[square(0.0, 0.0), square(0.95, 0.95)], true);
        check(&[square(0.0, 0.0), square(0.0, 0.0)], true);
        // A sheet that is thinner than the step behind its surface.
        let sheet = body(Cuboid::new([0.0, -0.01], [1.0, 0.0]).unwrap());
        check(&[sheet, square(0.0, -1.01)], false);
    }
}
