//! The smallest scene that still fails in the same way.

use super::case::{Body, Case, Sides};
use super::shape::Shape;

/// Shrinks a scene, not placed, as long as it still `fails`; asks at most so many times.
pub(super) fn shrink(case: &Case, most: usize, mut fails: impl FnMut(&Case) -> bool) -> Case {
    let mut best = case.clone();
    let mut trials = 0;
    let mut is_better = true;
    while is_better {
        is_better = false;
        for next in simpler(&best) {
            if trials == most {
                return best;
            }
            trials += 1;
            if fails(&next) {
                best = next;
                is_better = true;
                // What is simpler now is another list.
                break;
            }
        }
    }
    best
}

/// Scenes that are a little simpler, the boldest first.
fn simpler(case: &Case) -> Vec<Case> {
    let mut all = Vec::new();
    let mut offer = |change: &dyn Fn(&mut Case)| {
        let mut next = case.clone();
        change(&mut next);
        if next != *case {
            all.push(next);
        }
    };
    offer(&|next| {
        next.spacing = 1.0;
        next.origin.iter_mut().for_each(|x| *x = 0.0);
        next.packing.clear();
        next.kernel = None;
        next.h_over_spacing = None;
        next.quality = None;
        next.fill = true;
        next.refinement = None;
    });
    for k in 0..case.bodies.len() {
        if case.bodies.len() > 1 {
            offer(&|next| drop(next.bodies.remove(k)));
        }
    }
    offer(&|next| {
        next.spacing = 1.0;
        next.origin.iter_mut().for_each(|x| *x = 0.0);
    });
    offer(&|next| next.packing.clear());
    offer(&|next| (next.kernel, next.h_over_spacing) = (None, None));
    offer(&|next| next.quality = None);
    offer(&|next| next.fill = true);
    offer(&|next| next.method = None);
    offer(&|next| next.refinement = None);
    offer(&|next| {
        if let Some(refinement) = &mut next.refinement {
            refinement.regions.clear();
            (refinement.finest, refinement.growth) = (None, 1.08);
        }
    });
    offer(&|next| next.periodic.iter_mut().for_each(|x| *x = false));
    for k in 0..case.packing.len() {
        offer(&|next| drop(next.packing.remove(k)));
    }
    for k in 0..case.bodies.len() {
        offer(&|next| {
            let body = &mut next.bodies[k];
            (body.scale, body.rotate, body.density) = match body.shape {
                Shape::Airfoil { .. } => (body.scale, None, 1.0),
                _ => (1.0, None, 1.0),
            };
        });
        offer(&|next| next.bodies[k].surface = None);
        offer(&|next| next.bodies[k].spacing = None);
        offer(&|next| as_polygon(&mut next.bodies[k]));
        let corners = match &case.bodies[k].shape {
            Shape::Polygon { points } if points.len() > 3 => points.len(),
            _ => 0,
        };
        // Half of them, then one by one.
        if corners > 7 {
            offer(&|next| {
                if let Shape::Polygon { points } = &mut next.bodies[k].shape {
                    *points = points.iter().copied().step_by(2).collect();
                }
            });
        }
        for corner in 0..corners.min(12) {
            offer(&|next| {
                if let Shape::Polygon { points } = &mut next.bodies[k].shape {
                    points.remove(corner);
                }
            });
        }
    }
    for digits in [0, 1, 2] {
        offer(&|next| round(next, digits));
    }
    all
}

/// An outline from a file, or with holes, as corners in the scene.
fn as_polygon(body: &mut Body) {
    if let Shape::Outline { loops, .. } = &body.shape
        && let Some(points) = loops.first()
    {
        body.shape = Shape::Polygon {
            points: points.clone(),
        };
    }
}

/// All places with so many digits behind the point.
fn round(case: &mut Case, digits: i32) {
    let step = 10_f64.powi(digits);
    let near = |x: &mut f64| *x = (*x * step).round() / step;
    if let Sides::Corners(_, max) = &mut case.sides {
        max.iter_mut().for_each(near);
    }
    for body in &mut case.bodies {
        body.translate.iter_mut().flatten().for_each(near);
        if let Some((_, degrees)) = &mut body.rotate {
            near(degrees);
        }
        match &mut body.shape {
            Shape::Circle { center, radius } => {
                center.iter_mut().for_each(near);
                near(radius);
            }
            Shape::Box { min, max } => min.iter_mut().chain(max).for_each(near),
            Shape::Polygon { points } => points.iter_mut().flatten().for_each(near),
            Shape::Ellipse { center, semi_axes } => {
                center.iter_mut().chain(semi_axes).for_each(near);
            }
            Shape::Sphere { center, radius } => {
                center.iter_mut().for_each(near);
                near(radius);
            }
            Shape::Ellipsoid { center, semi_axes } => {
                center.iter_mut().chain(semi_axes).for_each(near);
            }
            Shape::Cylinder { start, end, radius } => {
                start.iter_mut().chain(end).for_each(near);
                near(radius);
            }
            Shape::Torus {
                center,
                major,
                minor,
                ..
            } => {
                center.iter_mut().for_each(near);
                near(major);
                near(minor);
            }
            Shape::Outline { loops, .. } => {
                loops.iter_mut().flatten().flatten().for_each(near);
            }
            Shape::Mesh { points, .. } => points.iter_mut().flatten().for_each(near),
            Shape::Starfish { .. }
            | Shape::Zigzag { .. }
            | Shape::Naca { .. }
            | Shape::Airfoil { .. } => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_matter_goes() {
        // Scenes of which it matters only that they are periodic.
        for number in 0..200 {
            let case = super::super::generate::case(5, number);
            if !case.periodic.contains(&true) {
                continue;
            }
            let small = shrink(&case, 40, |next| next.periodic.contains(&true));
            assert_eq!(small.spacing, 1.0);
            assert!(small.bodies.len() <= 1 && small.kernel.is_none() && small.method.is_none());
            assert!(small.periodic.contains(&true));
        }
    }
}
