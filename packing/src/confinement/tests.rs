//! Against a fine quadrature over the true exterior.

use sphpack_geometry::{Ball, Cuboid, Outline, Surface};
use sphpack_kernels::{Kernel, KernelKind, WendlandC2};
use sphpack_neighbors::{Domain, point};

use super::Confinement;

const SPACING: f64 = 0.1;
const H: f64 = 1.05 * SPACING;

/// The part of a cell that is outside of a body, by the cell's middle and edge.
type Share<'a, const D: usize> = dyn Fn([f64; D], f64) -> f64 + 'a;

/// Cells wholly in or wholly out.
fn by_middle<const D: usize>(surface: &dyn Surface<D>) -> impl Fn([f64; D], f64) -> f64 {
    |y, _| if surface.inside(y) { 0.0 } else { 1.0 }
}

/// I and ∇I by midpoints of cells of edge `cell`.
fn by_cells<const D: usize>(share: &Share<'_, D>, x: [f64; D], cell: f64) -> (f64, [f64; D]) {
    let kernel = WendlandC2::<D>::new(H);
    let n = (kernel.support() / cell).ceil() as i64;
    let (mut value, mut gradient) = (0.0, [0.0; D]);
    for number in 0..(2 * n).pow(D as u32) {
        let away: [f64; D] = std::array::from_fn(|k| {
            (number / (2 * n).pow(k as u32) % (2 * n) - n) as f64 * cell + 0.5 * cell
        });
        let y = point::add(x, away);
        if point::norm(away) < kernel.support() {
            let volume = share(y, cell) * cell.powi(D as i32);
            value += volume * kernel.value(point::norm(away));
            let slope = kernel.gradient(point::scale(away, -1.0));
            gradient = point::add_scaled(gradient, volume, slope);
        }
    }
    (value, gradient)
}

/// The largest errors of I and of h ∇I at places ∆s/2 inside and deeper.
fn worst<const D: usize>(
    surface: &dyn Surface<D>,
    share: &Share<'_, D>,
    count: usize,
    cell: f64,
) -> (f64, f64) {
    let bounds = surface.bounds().grown(10.0 * SPACING);
    let domain = Domain::new(bounds.min, bounds.max);
    let confinement = Confinement::inside(surface, &domain, KernelKind::WendlandC2, H, SPACING);
    let inner = surface.inset(0.5 * SPACING).expect("an inside");
    let mut worst: (f64, f64) = (0.0, 0.0);
    for (n, hit) in inner.sample(count).expect("points").into_iter().enumerate() {
        let deeper = 0.5 * SPACING * (n % 3) as f64;
        let x = point::add_scaled(hit.point, -deeper, hit.normal);
        if !surface.inside(x) {
            continue;
        }
        let (value, gradient) = by_cells(share, x, cell);
        let mut sums = [[0.0; D]];
        confinement.add_gradients(&[x], |_| true, &mut sums);
        let off = H * point::distance(sums[0], gradient);
        worst.0 = worst.0.max((confinement.gamma(x) - value).abs());
        worst.1 = worst.1.max(off);
    }
    worst
}

#[test]
fn agrees_with_cells_in_the_plane() {
    let disc = Ball::new([0.1, 0.2], 0.6).expect("a disc");
    let (value, gradient) = worst::<2>(&disc, &by_middle(&disc), 30, SPACING / 200.0);
    assert!(value < 0.001 && gradient < 0.002, "{value} {gradient}");
    // Corners of 90°, 18° and 45°, and a reflex one of 207°.
    let corners = [[0.0, 0.0], [1.5, 0.0], [0.6, 0.3], [0.0, 0.9]];
    let wedge = Outline::polygon(&corners).expect("a wedge");
    let (value, gradient) = worst::<2>(&wedge, &by_middle(&wedge), 40, SPACING / 200.0);
    assert!(value < 0.001 && gradient < 0.002, "{value} {gradient}");
}

#[test]
fn agrees_with_cells_in_space() {
    let ball = Ball::new([0.1, 0.2, 0.0], 0.45).expect("a ball");
    let (value, gradient) = worst::<3>(&ball, &by_middle(&ball), 12, SPACING / 40.0);
    assert!(value < 0.002 && gradient < 0.004, "{value} {gradient}");
    let block = Cuboid::new([0.0; 3], [0.5, 0.6, 0.7]).expect("a block");
    // Cells along its sides would all be cut alike: their true shares.
    let share = |y: [f64; 3], cell: f64| {
        let within = (0..3).map(|k| {
            let (low, high) = (y[k] - 0.5 * cell, y[k] + 0.5 * cell);
            ((high.min([0.5, 0.6, 0.7][k]) - low.max(0.0)) / cell).max(0.0)
        });
        1.0 - within.product::<f64>()
    };
    let (value, gradient) = worst::<3>(&block, &share, 30, SPACING / 30.0);
    assert!(value < 0.002 && gradient < 0.004, "{value} {gradient}");
}

#[test]
fn inside_and_outside_make_one() {
    let disc = Ball::new([0.0, 0.0], 0.5).expect("a disc");
    let domain = Domain::new([-1.0; 2], [1.0; 2]);
    let kernel = KernelKind::WendlandC2;
    let inside = Confinement::inside(&disc, &domain, kernel, H, SPACING);
    let outside = Confinement::outside(&[&disc], &domain, kernel, H, SPACING);
    for offset in [0.02, 0.05, 0.1] {
        // What one calls outward the other calls inward.
        let beyond = inside.gamma([0.5 - offset, 0.0]) + outside.gamma([0.5 - offset, 0.0]);
        assert!(beyond.abs() < 1e-12, "{beyond}");
        // Mirror images in a nearly straight surface.
        let (a, b) = (
            inside.gamma([0.5 - offset, 0.0]),
            outside.gamma([0.5 + offset, 0.0]),
        );
        assert!((a - b).abs() < 0.05, "{a} {b}");
    }
    assert_eq!(inside.gamma([0.0, 0.0]), 0.0);
}

#[test]
fn periodic_sides_are_seen_through() {
    let disc = Ball::new([0.85, 0.0], 0.14).expect("a disc");
    let domain = Domain::new([-1.0; 2], [1.0; 2]).with_periodic([true, false]);
    let outside = Confinement::outside(&[&disc], &domain, KernelKind::WendlandC2, H, SPACING);
    let (left, right) = (outside.gamma([-0.98, 0.0]), outside.gamma([1.02, 0.0]));
    assert!(left > 0.0 && (left - right).abs() < 1e-12, "{left} {right}");
}
