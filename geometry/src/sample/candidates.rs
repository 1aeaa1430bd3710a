//! Many points scattered over a surface by area, of which the evenest are kept.

use sphpack_neighbors::random::SplitMix64;
use sphpack_neighbors::{Bounds, Domain, point};

use crate::level_inset::cut;
use crate::surface::{Closest, Feature};

/// Leaf size of the search for the surface, in spacings: two to three leaves per point that is kept.
const LEAF_OVER_SPACING: f64 = 0.7;

/// Levels of boxes at least, so that few points too are spread by area.
const LEAST_LEVELS: usize = 5;

/// How thoroughly boxes are searched.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Search {
    /// How many times more a box is halved where the surface turns sharply within it.
    extra: usize,
    /// Whether also where the body's other side may pass through it.
    both_sides: bool,
}

/// For points that are evened out afterwards.
pub(crate) const QUICK: Search = Search {
    extra: 2,
    both_sides: false,
};

/// For thin bodies.
pub(crate) const THOROUGH: Search = Search {
    extra: 5,
    both_sides: true,
};

/// Cosine of the angle by which the surface turns sharply.
const SHARP: f64 = 0.87;

/// Points near a surface, not exactly on it, each standing for the same area.
#[derive(Debug, Clone, Default)]
pub(crate) struct Candidates<const D: usize> {
    pub(crate) point: Vec<[f64; D]>,
    /// Outward unit normals.
    pub(crate) normal: Vec<[f64; D]>,
    /// Area of the whole surface as it was found.
    pub(crate) area: f64,
}

/// The flat piece that stands for the surface in a small cube.
#[derive(Debug, Clone, Copy)]
struct Piece<const D: usize> {
    center: [f64; D],
    half: f64,
    normal: [f64; D],
    /// Signed distance of the cube's centre from the piece.
    height: f64,
    area: f64,
}

impl<const D: usize> Candidates<D> {
    /// `wanted` candidates on any surface within `bounds`, found by halving boxes:
    /// each small box that the surface passes holds a piece of its tangent plane. Some 12 queries of `near` per point
    /// of the given spacing.
    pub(crate) fn in_boxes(
        bounds: &Bounds<D>,
        near: &impl Fn([f64; D]) -> Closest<D>,
        spacing: f64,
        wanted: usize,
        search: Search,
    ) -> Self {
        Self::in_some(bounds, near, spacing, wanted, search, |_| true)
    }

    /// [`Candidates::in_boxes`] within a box beyond which the surface goes on; as near to its sides as the small boxes are
    /// wide.
    pub(crate) fn in_window(
        window: &Domain<D>,
        near: &impl Fn([f64; D]) -> Closest<D>,
        spacing: f64,
        wanted: usize,
        search: Search,
    ) -> Self {
        let bounds = &window.bounds;
        let is_in = |p: [f64; D]| (0..D).all(|k| p[k] >= bounds.min[k] && p[k] < bounds.max[k]);
        Self::in_some(bounds, near, spacing, wanted, search, is_in)
    }

    fn in_some(
        bounds: &Bounds<D>,
        near: &impl Fn([f64; D]) -> Closest<D>,
        spacing: f64,
        wanted: usize,
        search: Search,
        is_wanted: impl Fn([f64; D]) -> bool,
    ) -> Self {
        let largest = bounds.size().iter().copied().fold(0.0, f64::max) * 1.02;
        let mut leaf = LEAF_OVER_SPACING * spacing;
        let mut levels = 0;
        while leaf < largest && levels < 40 {
            leaf *= 2.0;
            levels += 1;
        }
        let levels = levels.max(LEAST_LEVELS);
        // A flat side between two boxes would be half lost: the grid is off the middle.
        let center = bounds.center().map(|x| x + 0.003_7 * leaf);
        let mut pieces = Vec::new();
        let root = look(near, center, 0.5 * leaf);
        gather(near, &root, levels, search, &mut pieces);
        pieces.retain(|piece| is_wanted(piece.center));
        let mut noise = SplitMix64::default();
        Self::systematic(
            wanted,
            &pieces,
            |piece| piece.area,
            |piece, _| (piece.somewhere(&mut noise), piece.normal),
        )
    }

    /// `wanted` points at equal steps of area through `pieces`. `place` gives a point of a piece, and the normal
    /// there, for the part (0 … 1) of its area that lies before the point.
    pub(crate) fn systematic<P>(
        wanted: usize,
        pieces: &[P],
        area: impl Fn(&P) -> f64,
        mut place: impl FnMut(&P, f64) -> ([f64; D], [f64; D]),
    ) -> Self {
        let total: f64 = pieces.iter().map(&area).sum();
        let mut found = Self {
            point: Vec::with_capacity(wanted),
            normal: Vec::with_capacity(wanted),
            area: total,
        };
        let step = total / wanted as f64;
        let mut before = 0.0;
        for piece in pieces {
            let here = area(piece);
            while found.point.len() < wanted {
                let target = step * (found.point.len() as f64 + 0.5);
                if target >= before + here {
                    break;
                }
                let (p, n) = place(piece, ((target - before) / here).clamp(0.0, 1.0));
                found.point.push(p);
                found.normal.push(n);
            }
            before += here;
        }
        found
    }
}

impl<const D: usize> Candidates<D> {
    /// The points of a surface as candidates, whatever its area.
    pub(crate) fn of(hits: &[Closest<D>]) -> Self {
        Self {
            point: hits.iter().map(|hit| hit.point).collect(),
            normal: hits.iter().map(|hit| hit.normal).collect(),
            area: f64::NAN,
        }
    }

    /// The candidates as points of a surface that they are on.
    pub(crate) fn hits(&self) -> Vec<Closest<D>> {
        let both = self.point.iter().zip(&self.normal);
        both.map(|(&point, &normal)| Closest {
            point,
            normal,
            distance: 0.0,
            feature: Feature::Smooth,
        })
        .collect()
    }
}

impl<const D: usize> Piece<D> {
    /// Whether another side of the body is nearer below the piece than the cube is wide, and far enough that cubes halved
    /// `extra` times may tell the sides apart. (A disk 10⁻⁸ thick was halved for 7 s, to no end.)
    fn is_thin(&self, near: &impl Fn([f64; D]) -> Closest<D>, extra: usize) -> bool {
        let down = self.height + 2.0 * self.half;
        let below = near(point::add_scaled(self.center, -down, self.normal));
        let thickness = 2.0 * self.half - below.distance;
        let finest = self.half / (1_u64 << extra) as f64;
        below.distance > -1.9 * self.half && thickness > 0.25 * finest
    }

    /// A point of the piece.
    fn somewhere(&self, noise: &mut SplitMix64) -> [f64; D] {
        let foot = point::add_scaled(self.center, -self.height, self.normal);
        // A plane through a cube lies within its circumscribed ball; a third of the tries or so succeed.
        for _ in 0..32 {
            let from: [f64; D] =
                std::array::from_fn(|_| self.half * (D as f64).sqrt() * (2.0 * noise.unit() - 1.0));
            let p = point::add(foot, point::reject(from, self.normal));
            if (0..D).all(|k| (p[k] - self.center[k]).abs() <= self.half) {
                return p;
            }
        }
        foot
    }
}

/// What is seen from the centre of a cube.
fn look<const D: usize>(
    near: &impl Fn([f64; D]) -> Closest<D>,
    center: [f64; D],
    half: f64,
) -> Piece<D> {
    let hit = near(center);
    let away = point::sub(center, hit.point);
    let length = point::norm(away);
    // Too near the surface the difference is rounding.
    let normal = if length > 1e-6 * half {
        point::scale(away, hit.distance.signum() / length)
    } else {
        hit.normal
    };
    Piece {
        center,
        half,
        normal,
        height: hit.distance,
        area: 0.0,
    }
}

fn gather<const D: usize>(
    near: &impl Fn([f64; D]) -> Closest<D>,
    cell: &Piece<D>,
    levels: usize,
    search: Search,
    pieces: &mut Vec<Piece<D>>,
) {
    let reach = (D as f64).sqrt();
    let half = 0.5 * cell.half;
    let children: Vec<Piece<D>> = (0..1_usize << D)
        .map(|bits| {
            let center = std::array::from_fn(|k| {
                let side = if bits >> k & 1 == 1 { half } else { -half };
                cell.center[k] + side
            });
            look(near, center, half)
        })
        .filter(|child| child.height.abs() <= reach * half)
        .collect();
    if levels > 1 {
        for child in &children {
            gather(near, child, levels - 1, search, pieces);
        }
        return;
    }
    let sharp = children
        .iter()
        .any(|child| point::dot(child.normal, children[0].normal) < SHARP);
    let finer = Search {
        extra: search.extra.saturating_sub(1),
        ..search
    };
    for child in &children {
        let deeper = || sharp || search.both_sides && child.is_thin(near, search.extra);
        if search.extra > 0 && deeper() {
            gather(near, child, 1, finer, pieces);
        } else {
            let area =
                cut(child.normal, 0.5 * child.height / half).0 * (2.0 * half).powi(D as i32 - 1);
            if area > 0.0 {
                pieces.push(Piece { area, ..*child });
            }
        }
    }
}
