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
    /// How deep it is in one of them, scene units: it is on the surface of the other, or a little behind that.
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
    let common = a.bounds().intersection(b.bounds());
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
    let common = a.bounds().intersection(b.bounds());
    (0..D).all(|k| common.max[k] > common.min[k])
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
    for at in a.scatter(count) {
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
    fn check<const D: usize>(bodies: &[Body<D>], overlaps: bool) -> Option<Overlap<D>> {
        let found = first(bodies, 0.1, |_| true);
        assert_eq!(found.is_some(), overlaps, "{found:?}");
        assert!(first(bodies, 0.1, |i| i == 0).is_none());
        if let Some(found) = found {
            let depths = (found.bodies).map(|i| -bodies[i].surface.closest(found.place).distance);
            assert!(depths.iter().all(|depth| *depth > -1e-12), "{found:?}");
            let is_in_one = depths
                .iter()
                .any(|depth| (depth - found.depth).abs() < 1e-12);
            assert!(is_in_one, "{found:?}, not {depths:?}");
        }
        found
    }

    /// The depth that is found, and no other, up to how densely places are scattered.
    #[track_caller]
    fn check_depth<const D: usize>(bodies: [Body<D>; 2], exact: f64, scattered: f64) {
        let [a, b] = bodies;
        let mirrored = [b.clone(), a.clone()];
        for bodies in [[a, b], mirrored] {
            let depth = check(&bodies, true).map_or(0.0, |found| found.depth);
            assert!(
                depth < exact + 1e-12 && depth > exact - scattered,
                "{depth}, not {exact}"
            );
        }
    }

    fn ball<const D: usize>(x: f64, r: f64) -> Body<D> {
        let center = std::array::from_fn(|k| if k == 0 { x } else { 0.0 });
        body(Ball::new(center, r).expect("a ball"))
    }

    fn square(x: f64, y: f64) -> Body<2> {
        body(Cuboid::new([x, y], [x + 1.0, y + 1.0]).expect("a square"))
    }

    fn cube(x: f64, y: f64, z: f64) -> Body<3> {
        body(Cuboid::new([x, y, z], [x + 1.0, y + 1.0, z + 1.0]).expect("a cube"))
    }

    #[test]
    fn touching_is_no_overlap_and_nesting_is() {
        check::<3>(&[ball(0.0, 1.0), ball(2.0, 1.0)], false);
        check::<3>(&[ball(0.0, 1.0), ball(1.999, 1.0)], false);
        check::<3>(&[ball(0.0, 1.0), ball(1.9, 1.0)], true);
        check::<3>(&[ball(0.0, 1.0), ball(0.1, 0.3)], true);
        check::<3>(&[ball(0.1, 0.3), ball(0.0, 1.0)], true);
        check::<3>(&[ball(0.0, 1.0), ball(0.0, 1.0)], true);
        check::<3>(&[ball(0.0, 1.0), ball(5.0, 1.0)], false);
        check(&[square(0.0, 0.0), square(1.0, 0.0)], false);
        check(&[square(0.0, 0.0), square(1.0, 0.3)], false);
        check(&[square(0.0, 0.0), square(0.95, 0.95)], true);
        check(&[square(0.0, 0.0), square(0.0, 0.0)], true);
        // A sheet that is thinner than the step behind its surface.
        let sheet = body(Cuboid::new([0.0, -0.01], [1.0, 0.0]).expect("a sheet"));
        check(&[sheet, square(0.0, -1.01)], false);
    }

    /// How far one surface reaches into the other body.
    #[test]
    fn the_depth_is_that_of_exact_cases() {
        // Balls: r₁ + r₂ − d.
        check_depth::<2>([ball(0.0, 1.0), ball(1.9, 1.0)], 0.1, 1e-3);
        check_depth::<2>([ball(0.0, 1.0), ball(1.3, 0.5)], 0.2, 1e-3);
        check_depth::<3>([ball(0.0, 1.0), ball(1.9, 1.0)], 0.1, 0.01);
        check_depth::<3>([ball(0.0, 1.0), ball(1.3, 0.5)], 0.2, 0.01);
        // One in the other: R minus how near the small one's surface comes to the large one's centre.
        check_depth::<3>([ball(0.0, 1.0), ball(0.5, 0.3)], 0.8, 0.01);
        // The same twice: as far behind the surface as is looked.
        check_depth::<3>([ball(0.0, 1.0), ball(0.0, 1.0)], 0.02, 1e-12);
        // Boxes: the middle of a side, a corner.
        check_depth([square(0.0, 0.0), square(0.7, 0.0)], 0.3, 1e-12);
        check_depth([square(0.0, 0.0), square(0.8, 0.9)], 0.1, 1e-12);
        check_depth([square(0.0, 0.0), square(0.95, 0.95)], 0.05, 0.01);
        check_depth([cube(0.0, 0.0, 0.0), cube(0.2, 0.0, 0.7)], 0.3, 1e-12);
        check_depth([cube(0.0, 0.0, 0.0), cube(0.6, 0.7, 0.8)], 0.2, 1e-12);
    }
}
