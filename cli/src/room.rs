//! Where bodies are looked at: in the box and around it.

use sphpack_geometry::{GeometryError, Mesh, Surface};
use sphpack_neighbors::{Bounds, Domain, point};

use crate::scene::Scene;

/// How far beyond the sides of the box bodies by formula are looked at, in ∆s.
const BEYOND: f64 = 2.0;

/// The last part of that, in ∆s, is stretched, to so many times the size of the box.
const STRETCHED: f64 = 0.5;
const FAR: f64 = 1.5;

/// The box and a little more; without end across periodic sides, where bodies come back.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Room<const D: usize> {
    pub(crate) bounds: Bounds<D>,
    /// Of the box, its diagonal.
    size: f64,
    spacing: f64,
}

impl<const D: usize> Room<D> {
    pub(crate) fn around(domain: &Domain<D>, spacing: f64) -> Self {
        let mut bounds = domain.bounds.grown(BEYOND * spacing);
        for axis in (0..D).filter(|&axis| domain.periodic[axis]) {
            bounds.min[axis] = f64::NEG_INFINITY;
            bounds.max[axis] = f64::INFINITY;
        }
        Self {
            bounds,
            size: domain.bounds.diagonal(),
            spacing,
        }
    }

    /// Of a scene that gives its box; all there is where bodies make it.
    pub(crate) fn of(scene: &Scene) -> Self {
        let spec = &scene.domain;
        let (Some(min), Some(max)) = (&spec.min, &spec.max) else {
            return Self::open(scene.spacing);
        };
        let periodic = spec.periodic.as_deref().unwrap_or(&[]);
        let is_periodic = |k: usize| periodic.get(k).copied().unwrap_or(false);
        let domain = Domain::new(point::of_slice(min), point::of_slice(max))
            .with_periodic(std::array::from_fn(is_periodic));
        Self::around(&domain, scene.spacing)
    }

    /// A room without sides.
    pub(crate) fn open(spacing: f64) -> Self {
        Self {
            bounds: Bounds::new([f64::NEG_INFINITY; D], [f64::INFINITY; D]),
            size: f64::INFINITY,
            spacing,
        }
    }
}

impl Room<3> {
    /// What of a body is in the room. The faces that the room's sides have left are moved away by more than the size of
    /// the box, so that nothing in it is near them; what passes a side goes straight on from 1.5 ∆s behind it.
    pub(crate) fn carry_on(&self, mesh: Mesh) -> Result<Mesh, GeometryError> {
        let kept = self.bounds.grown(-STRETCHED * self.spacing);
        if kept.contains_box(&mesh.bounds()) {
            return Ok(mesh);
        }
        let times = FAR * self.size / (STRETCHED * self.spacing);
        let moved = |p: &[f64; 3]| {
            std::array::from_fn(|k| {
                let near = p[k].clamp(kept.min[k], kept.max[k]);
                near + times * (p[k] - near)
            })
        };
        let vertices = mesh.vertices().iter().map(moved).collect();
        Mesh::new(vertices, mesh.triangles().to_vec())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use sphpack_geometry::{Ball, LevelSet};

    use super::*;

    /// Of a ball that covers a corner of the box: nothing in the box has changed, and all else is far away.
    #[test]
    fn nothing_in_the_box_is_near_the_sides_of_the_room() {
        let domain = Domain::new([0.0; 3], [10.0, 8.0, 9.0]).with_periodic([false, false, true]);
        let room = Room::around(&domain, 1.0);
        let ball: Arc<dyn Surface<3>> = Arc::new(Ball::new([0.0, 0.0, 4.0], 4.0).expect("a ball"));
        let window = ball.bounds().grown(1.0).intersection(room.bounds);
        let part = LevelSet::within(Arc::clone(&ball), 0.25, &window).expect("a set");
        let mesh = part.mesh().expect("a mesh").expect("not empty");
        let carried = room.carry_on(mesh).expect("a mesh");
        let diagonal = domain.bounds.diagonal();
        assert!(carried.bounds().min[0] < -diagonal && carried.bounds().min[1] < -diagonal);
        assert!(carried.bounds().min[2] > -0.1 && carried.bounds().max[0] < 4.1);
        for n in 0..4000 {
            let n = f64::from(n) + 0.5;
            let part = [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|a| (a * n) % 1.0);
            let p: [f64; 3] = std::array::from_fn(|k| part[k] * domain.bounds.max[k]);
            let (was, is) = (ball.closest(p), carried.closest(p));
            if was.distance.abs() > 0.01 {
                assert_eq!(was.distance < 0.0, is.distance < 0.0, "{p:?}");
            }
            // The nearest place of the ball that is not in the room is farther than this.
            if was.distance.abs() < 1.0 {
                assert!(
                    (was.distance - is.distance).abs() < 0.01,
                    "{p:?}: {was:?}, {is:?}"
                );
            }
        }
        // A body within the room stays as it is, and so does any in an open one.
        let whole = LevelSet::of(ball, 0.25).and_then(|set| set.mesh());
        let whole = whole.expect("a mesh").expect("not empty");
        let bounds = whole.bounds();
        assert_eq!(
            Room::open(1.0).carry_on(whole).expect("a mesh").bounds(),
            bounds
        );
    }
}
