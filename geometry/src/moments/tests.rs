//! Moments by formula and by sides, beside those of cells.

use std::sync::Arc;

use proptest::prelude::*;
use sphpack_neighbors::Domain;

use super::*;
use crate::{Ball, Cuboid, Cylinder, Ellipsoid, Mesh, Outline, Placed, Repeated, Surface, Torus};

/// By cells whose middle is inside, which knows nothing but the inside test.
fn counted<const D: usize>(body: &dyn Surface<D>, cells: usize) -> Moments<D> {
    let bounds = body.bounds();
    let edge = point::scale(bounds.size(), 1.0 / cells as f64);
    let volume = edge.iter().product();
    let mut sums = MomentSums::about(bounds.center());
    for number in 0..cells.pow(D as u32) {
        let middle = std::array::from_fn(|k| {
            bounds.min[k] + edge[k] * ((number / cells.pow(k as u32) % cells) as f64 + 0.5)
        });
        if body.inside(middle) {
            sums.add(middle, volume);
        }
    }
    sums.moments().expect("some are inside")
}

/// Cells along an edge: they tell the volume to some per cent, and the others, which are parts of the body's size, much better.
const CELLS: [usize; 2] = [200, 60];

fn check<const D: usize>(body: &dyn Surface<D>) {
    let exact = body.moments().expect("known");
    let counted = counted(body, CELLS[D - 2]);
    let size = body.bounds().diagonal();
    assert!(
        (exact.volume / body.volume() - 1.0).abs() < 1e-12,
        "{body:?}"
    );
    assert!(
        (exact.volume / counted.volume - 1.0).abs() < 0.03,
        "{body:?}"
    );
    assert!(
        point::distance(exact.center, counted.center) < 0.003 * size,
        "{body:?}"
    );
    for (is, should) in exact.inertia().iter().zip(counted.inertia()) {
        assert!(
            point::distance(*is, should) < 0.003 * exact.volume * size * size,
            "{body:?} {exact:?} {counted:?}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn moments_are_those_of_cells(degrees in 0.0..360.0, shift in [-5.0..5.0, -5.0..5.0, -5.0..5.0], sizes in [0.3..1.0, 0.3..1.0, 0.3..1.0]) {
        let [a, b, c] = sizes;
        let shapes: [Arc<dyn Surface<3>>; 5] = [
            Arc::new(Ball::new(shift, a).unwrap()),
            Arc::new(Cuboid::new([-a, 0.0, b], [b, c, 2.0]).unwrap()),
            Arc::new(Cylinder::new(shift, point::add(shift, sizes), a).unwrap()),
            Arc::new(Torus::new(shift, sizes, b + 0.1, b).unwrap()),
            Arc::new(Ellipsoid::new(shift, sizes).unwrap()),
        ];
        let place = Similarity::<3>::new(1.7, [0.3, -1.0, 0.2], degrees, shift).unwrap();
        for shape in shapes {
            check(shape.as_ref());
            check(&Placed::new(shape, place));
        }
        let at = |[x, y, _]: [f64; 3]| [x, y];
        check(&Ellipsoid::new(at(shift), [a, b]).unwrap());
        check(&Ball::new(at(shift), a).unwrap());
        check(&Cuboid::new([-a, b], [c, 2.0]).unwrap());
        let ring = Outline::new(vec![
            vec![[-a, -1.0], [1.0, -b], [1.5, 1.0], [-0.5, 1.2]],
            vec![[0.0, 0.0], [0.3, 0.1], [0.3, 0.3], [0.0, 0.3]],
        ]).unwrap();
        let turn = Similarity::<2>::new(0.6, degrees, at(shift)).unwrap();
        check(&ring.transformed(&turn));
    }
}

#[test]
fn a_mesh_far_away_keeps_its_digits() {
    let far = [1e6, -2e6, 3e6];
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let at = |origin: [f64; 3]| {
        let vertices = corners.map(|corner| point::add(corner, origin)).to_vec();
        let mesh = Mesh::new(vertices, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        mesh.unwrap().moments().expect("known of a mesh")
    };
    let (near, away) = (at([0.0; 3]), at(far));
    // Of the tetrahedron of unit edges: ∫ x² = 1/60, ∫ x y = 1/120, the centre at a quarter.
    assert!(point::distance(near.center, [0.25; 3]) < 1e-15);
    assert!((near.second[0][0] - (1.0 / 60.0 - 0.25 * 0.25 / 6.0)).abs() < 1e-15);
    assert!((near.second[0][1] - (1.0 / 120.0 - 0.25 * 0.25 / 6.0)).abs() < 1e-15);
    assert!((near.inertia()[2][2] - 2.0 * near.second[0][0]).abs() < 1e-15);
    assert!(point::distance(point::sub(away.center, far), near.center) < 1e-9);
    for (a, b) in near.second.iter().zip(away.second) {
        assert!(point::distance(*a, b) < 1e-10);
    }
}

#[test]
fn images_have_those_of_the_one_body_and_what_goes_on_has_none() {
    let domain = Domain::new([0.0; 2], [4.0, 2.0]).with_periodic([true, false]);
    let disc: Arc<dyn Surface<2>> = Arc::new(Ball::new([3.9, 1.0], 0.5).unwrap());
    let repeated = Repeated::new(Arc::clone(&disc), &domain);
    assert_eq!(repeated.moments(), disc.moments());
    let strip = Outline::polygon(&[[-1.0, 0.0], [5.0, 0.0], [5.0, 0.5], [-1.0, 0.5]]).unwrap();
    let open = Domain::new([0.0; 2], [4.0, 2.0]);
    let continued = strip.continued(&open);
    assert!(continued.is_some_and(|body| body.moments().is_none()));
    let mut nothing = MomentSums::about([0.0; 2]);
    assert_eq!(nothing.moments(), None);
    nothing.add([1.0, 2.0], 0.0);
    assert_eq!(nothing.moments(), None);
}
