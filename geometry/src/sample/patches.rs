//! Points scattered by area over surfaces that are given as images of squares: the sides of flat and slender bodies.

use super::Candidates;
use crate::surface::Closest;

/// Pieces of the surface for each point.
const PIECES: f64 = 4.0;

/// Parts by which each point's place in its piece goes on from the last one's: powers of 1/x for the root of
/// x³ = x + 1, whose points fill a square most evenly (Roberts 2018).
const ON: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// A part of a surface, the image of the unit square.
pub(crate) struct Patch<'a, const D: usize> {
    /// About how long it is along both sides of the square, scene units; in the plane the second is 1 and not looked at.
    pub(crate) sides: [f64; 2],
    /// Pieces at least along the second side, which may be bent more sharply than points are apart.
    pub(crate) least: f64,
    /// The area around a place on the square is so many times that on the square.
    pub(crate) stretch: Box<dyn Fn([f64; 2]) -> f64 + 'a>,
    /// The point at a place on the square, and the unit normal there.
    #[expect(
        clippy::type_complexity,
        reason = "a function from a place to a point and a normal needs no name"
    )]
    pub(crate) at: Box<dyn Fn([f64; 2]) -> ([f64; D], [f64; D]) + 'a>,
}

/// Whether the sides of a body are so near each other, for points so far apart as `count` of them are, that a search
/// for them would be long.
pub(crate) fn are_needed<const D: usize>(thickness: f64, measure: f64, count: usize) -> bool {
    let apart = (measure / count as f64).powf(1.0 / (D as f64 - 1.0));
    thickness < 0.5 * apart
}

/// `count` points, each standing for the same area: the squares are cut into some four pieces for each point, about as
/// long as wide. O(count): a search for the surface of a disk of radius 70 and thickness 0.2 took more than a minute for
/// 20,000 points, and one for a rod of 1 × 10⁶ gibibytes.
pub(crate) fn over<const D: usize>(patches: &[Patch<'_, D>], count: usize) -> Vec<Closest<D>> {
    if count == 0 || D < 2 {
        return Vec::new();
    }
    let size = |patch: &Patch<'_, D>| patch.sides[0] * patch.sides[1];
    let whole: f64 = patches.iter().map(size).sum();
    let mut pieces: Vec<(usize, [f64; 2], [f64; 2])> = Vec::new();
    for (number, patch) in patches.iter().enumerate() {
        let most = (PIECES * count as f64 * size(patch) / whole).max(1.0);
        let ratio = patch.sides[0] / patch.sides[1];
        let along = (most * ratio)
            .sqrt()
            .clamp(1.0, (most / patch.least).max(1.0));
        let along = along.ceil();
        let across = (most / along).max(patch.least).ceil();
        for i in 0..along as u32 {
            for j in 0..across as u32 {
                let corner = [f64::from(i) / along, f64::from(j) / across];
                pieces.push((number, corner, [1.0 / along, 1.0 / across]));
            }
        }
    }
    let mut place = [0.5; 2];
    Candidates::systematic(
        count,
        &pieces,
        |&(number, [s, t], [ds, dt])| {
            ds * dt * (patches[number].stretch)([s + 0.5 * ds, t + 0.5 * dt])
        },
        |&(number, corner, size), _| {
            place = std::array::from_fn(|k| (place[k] + ON[k]) % 1.0);
            (patches[number].at)(std::array::from_fn(|k| corner[k] + place[k] * size[k]))
        },
    )
    .hits()
}
