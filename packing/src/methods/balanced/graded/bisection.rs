//! Where particles of graded spacing start: a region cut again and again into parts of equal mass.

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, point};

/// A box of a region, evenly filled with mass: particles per volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece<const D: usize> {
    pub(super) bounds: Bounds<D>,
    pub(super) density: f64,
}

impl<const D: usize> Piece<D> {
    /// Particles.
    pub(super) fn mass(&self) -> f64 {
        self.density * self.bounds.volume()
    }
}

/// Below so many particles a part is not worth a task of its own.
const TASK: usize = 1024;

/// Steps towards the plane that cuts off the right mass, at most; Newton's, four to six, do.
const STEPS: usize = 60;

/// The mass below a plane is right to this part of the whole.
const RIGHT: f64 = 1e-12;

/// `count` places of equal mass: the pieces are cut across the axis along which their mass is spread widest, so that both
/// sides have whole numbers of shares as equal as can be, down to one share each, whose place is its centre of mass. Exact counts, no
/// waves in the density longer than a few particles, for any region and field (equal-mass k-d partition). O(n log n), parallel;
/// the same bits for any number of threads.
pub(super) fn places<const D: usize>(pieces: Vec<Piece<D>>, count: usize) -> Vec<[f64; D]> {
    if count == 0 || pieces.is_empty() {
        return Vec::new();
    }
    if count == 1 {
        return vec![center(&pieces)];
    }
    let axis = widest(&pieces);
    let lower = count / 2;
    let part = lower as f64 / count as f64;
    let [below, above] = cut(pieces, axis, part);
    if count < TASK {
        let mut all = places(below, lower);
        all.extend(places(above, count - lower));
        return all;
    }
    let (mut all, more) = rayon::join(|| places(below, lower), || places(above, count - lower));
    all.extend(more);
    all
}

/// The centre of mass, or the nearest place to it in a piece.
fn center<const D: usize>(pieces: &[Piece<D>]) -> [f64; D] {
    let (mut mass, mut sum) = (0.0, [0.0; D]);
    for piece in pieces {
        mass += piece.mass();
        sum = point::add_scaled(sum, piece.mass(), piece.bounds.center());
    }
    let center = if mass > 0.0 {
        point::scale(sum, 1.0 / mass)
    } else {
        pieces[0].bounds.center()
    };
    let clamped = |bounds: &Bounds<D>| {
        std::array::from_fn(|k| center[k].max(bounds.min[k]).min(bounds.max[k]))
    };
    let nearest = (pieces.iter())
        .map(|piece| clamped(&piece.bounds))
        .min_by(|a, b| {
            point::distance_squared(*a, center).total_cmp(&point::distance_squared(*b, center))
        });
    nearest.unwrap_or(center)
}

/// The axis along which the mass is spread widest.
fn widest<const D: usize>(pieces: &[Piece<D>]) -> usize {
    let (mut mass, mut mean) = (0.0, [0.0; D]);
    for piece in pieces {
        mass += piece.mass();
        mean = point::add_scaled(mean, piece.mass(), piece.bounds.center());
    }
    let mean = point::scale(mean, 1.0 / mass.max(f64::MIN_POSITIVE));
    let mut spread = [0.0; D];
    for piece in pieces {
        let (center, size) = (piece.bounds.center(), piece.bounds.size());
        for k in 0..D {
            let away = center[k] - mean[k];
            spread[k] += piece.mass() * (away * away + size[k] * size[k] / 12.0);
        }
    }
    (0..D).fold(0, |best, k| if spread[k] > spread[best] { k } else { best })
}

/// The pieces below and above a plane across an axis, with `part` of the mass below.
fn cut<const D: usize>(pieces: Vec<Piece<D>>, axis: usize, part: f64) -> [Vec<Piece<D>>; 2] {
    let all: f64 = pieces.iter().map(Piece::mass).sum();
    let wanted = part * all;
    let mut low = (pieces.iter()).fold(f64::INFINITY, |x, piece| x.min(piece.bounds.min[axis]));
    let mut high =
        (pieces.iter()).fold(f64::NEG_INFINITY, |x, piece| x.max(piece.bounds.max[axis]));
    let mut plane = low + part * (high - low);
    for _ in 0..STEPS {
        let [below, across] = mass_below(&pieces, axis, plane);
        let off = below - wanted;
        if off.abs() <= RIGHT * all {
            break;
        }
        if off > 0.0 {
            high = plane;
        } else {
            low = plane;
        }
        let next = plane - off / across;
        plane = if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
    }
    let (mut below, mut above) = (Vec::new(), Vec::new());
    for piece in pieces {
        let bounds = piece.bounds;
        if bounds.max[axis] <= plane {
            below.push(piece);
        } else if bounds.min[axis] >= plane {
            above.push(piece);
        } else {
            let [lower, upper] = bounds.cut(axis, plane);
            below.push(Piece {
                bounds: lower,
                ..piece
            });
            above.push(Piece {
                bounds: upper,
                ..piece
            });
        }
    }
    [below, above]
}

/// Pieces per task of a sum, fixed.
const BLOCK: usize = 1 << 14;

/// The mass below a plane, and how fast it grows with the plane.
fn mass_below<const D: usize>(pieces: &[Piece<D>], axis: usize, plane: f64) -> [f64; 2] {
    let of = |pieces: &[Piece<D>]| {
        let mut sums = [0.0; 2];
        for piece in pieces {
            let (min, max) = (piece.bounds.min[axis], piece.bounds.max[axis]);
            let mass = piece.mass();
            if plane >= max {
                sums[0] += mass;
            } else if plane > min {
                sums[0] += mass * (plane - min) / (max - min);
                sums[1] += mass / (max - min);
            }
        }
        sums
    };
    if pieces.len() <= BLOCK {
        return of(pieces);
    }
    let parts: Vec<[f64; 2]> = pieces.par_chunks(BLOCK).map(of).collect();
    parts.into_iter().fold([0.0; 2], point::add)
}
