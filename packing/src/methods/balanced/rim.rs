//! Which lattice sites along a region's rim are its: as many, place by place, as there is room for.

use std::collections::HashSet;

use sphpack_neighbors::random::scrambled;

/// A site that a region may have.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate<const D: usize> {
    pub(super) site: usize,
    pub(super) place: [f64; D],
    /// Within the region, negative outside.
    pub(super) depth: f64,
}

/// How far before and behind the depth at which a region's sites end they are counted in part, in ∆s. Over two rows of a
/// lattice the sum is right to a hundredth of a row, however the rows lie.
const RAMP_OVER_SPACING: f64 = 1.0;

/// The deepest of all are left as they are where they are as many, in a piece of the rim, as there is room for, to within this
/// many, in the plane and in space: round a body that bends they lie more smoothly than pieces would.
const AS_GOOD: [f64; 2] = [3.0, 9.0];

/// The rim is counted in pieces no larger than this, in ∆s.
const PIECE_OVER_SPACING: f64 = 4.0;

/// Steps in which the depth is found at which the sites end: halvings of some ∆s, down to 10⁻⁹.
const HALVINGS: usize = 32;

/// Numbers nearer to a half than this are rounded as that is, so that rounding errors do not tell where a site goes.
const TIE: f64 = 1e-6;

/// `count` of a region's sites: its deepest, but so that every piece of the rim has as many as it has room for.
///
/// Were the deepest of all taken, wherever the rim is, a row of sites along a flat side would be in or out as a whole: up to
/// half a row too many or too few there, and the settling would have to carry it off around the body. (Five strips along a lattice's rows:
/// 290 to 670 evaluations, turned 75 to 150.) So sites along the rim count by a ramp, as much as of their cell is in the region, and
/// the rim is halved again and again, its sites shared out by these sums; of a small piece's, the deepest are taken. O(n log n).
pub(super) fn chosen<const D: usize>(
    candidates: &[Candidate<D>],
    count: usize,
    spacing: f64,
    seed: u64,
) -> Vec<usize> {
    let of = |candidate: &Candidate<D>| (candidate.site, candidate.depth);
    if count >= candidates.len() {
        return candidates.iter().map(|c| c.site).collect();
    }
    let end = end(candidates, count, spacing);
    let (mut kept, mut rim) = (Vec::new(), Vec::new());
    for candidate in candidates {
        let part = ramp((candidate.depth - end) / spacing);
        if part >= 1.0 {
            kept.push(candidate.site);
        } else if part > 0.0 {
            rim.push(Rim {
                candidate: *candidate,
                // To a millionth of ∆s, as depths are.
                place: candidate.place.map(|x| (x / spacing * 1e6).round()),
                part,
                is_deepest: false,
            });
        }
    }
    let left = count.saturating_sub(kept.len());
    // All that are kept are deeper than the rim.
    let all = deepest(
        rim.iter().map(|rim| of(&rim.candidate)),
        left,
        spacing,
        seed,
    );
    let all: HashSet<usize> = all.into_iter().collect();
    for rim in &mut rim {
        rim.is_deepest = all.contains(&rim.candidate.site);
    }
    share_out(&mut rim, left, &mut |piece, count| {
        kept.extend(deepest(
            piece.iter().map(|rim| of(&rim.candidate)),
            count,
            spacing,
            seed,
        ));
    });
    kept
}

/// A site along the rim, and how much of its cell is in the region.
#[derive(Debug, Clone, Copy)]
struct Rim<const D: usize> {
    candidate: Candidate<D>,
    place: [f64; D],
    part: f64,
    /// Whether it is among the deepest of the whole region.
    is_deepest: bool,
}

/// How much of a site's cell is in the region, from where it lies before (negative) or behind the end of it, in ∆s.
fn ramp(behind: f64) -> f64 {
    let x = (behind / RAMP_OVER_SPACING).clamp(-1.0, 1.0);
    0.5 * (1.0 + x + (std::f64::consts::PI * x).sin() / std::f64::consts::PI)
}

/// The depth at which a region ends whose sites count `count` together.
fn end<const D: usize>(candidates: &[Candidate<D>], count: usize, spacing: f64) -> f64 {
    let mut depths: Vec<f64> = candidates.iter().map(|c| c.depth).collect();
    let last = count.min(depths.len() - 1);
    let (_, &mut middle, _) = depths.select_nth_unstable_by(last, |a, b| b.total_cmp(a));
    let reach = 2.0 * RAMP_OVER_SPACING * spacing;
    let behind = depths
        .iter()
        .filter(|&&d| d >= middle + 2.0 * reach)
        .count();
    depths.retain(|d| (d - middle).abs() < 2.0 * reach);
    let (mut low, mut high) = (middle - reach, middle + reach);
    for _ in 0..HALVINGS {
        let end = 0.5 * (low + high);
        let sum: f64 = depths.iter().map(|d| ramp((d - end) / spacing)).sum();
        if behind as f64 + sum > count as f64 {
            low = end;
        } else {
            high = end;
        }
    }
    0.5 * (low + high)
}

/// Halves a piece of the rim across its longest axis until it is small, `count` of its sites shared out by what they count;
/// gives every piece with its number to `take`.
fn share_out<const D: usize>(
    piece: &mut [Rim<D>],
    count: usize,
    take: &mut impl FnMut(&[Rim<D>], usize),
) {
    let count = count.min(piece.len());
    if count == 0 {
        return;
    }
    let size: [f64; D] = std::array::from_fn(|k| {
        let (low, high) = piece
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), rim| {
                (a.min(rim.place[k]), b.max(rim.place[k]))
            });
        high - low
    });
    let axis = (0..D).fold(0, |best, k| if size[k] > size[best] { k } else { best });
    if size[axis] <= 1e6 * PIECE_OVER_SPACING {
        take(piece, count);
        return;
    }
    let middle = piece.len() / 2;
    piece.select_nth_unstable_by(middle, |a, b| {
        (a.place[axis].total_cmp(&b.place[axis])).then(a.candidate.site.cmp(&b.candidate.site))
    });
    let (below, above) = piece.split_at_mut(middle);
    let sum = |rim: &[Rim<D>]| rim.iter().map(|rim| rim.part).sum::<f64>();
    let (low, high) = (sum(below), sum(above));
    let wanted = count as f64 * low / (low + high);
    let deepest = |rim: &[Rim<D>]| rim.iter().filter(|rim| rim.is_deepest).count();
    let (first, second) = (deepest(below), deepest(above));
    let is_as_good = (first as f64 - wanted).abs() <= AS_GOOD[usize::from(D > 2)];
    let first = if first + second == count && is_as_good {
        first
    } else {
        (wanted - TIE).round().max(0.0) as usize
    };
    let first = first.clamp(count.saturating_sub(above.len()), count.min(below.len()));
    share_out(below, first, take);
    share_out(above, count - first, take);
}

/// The deepest of a region's sites, `count` of them, of `sites` with their depths. Depths are compared to within 10⁻⁹ ∆s, so
/// that neither the unit of length nor the place of the origin decides between equals.
pub(crate) fn deepest(
    sites: impl Iterator<Item = (usize, f64)>,
    count: usize,
    spacing: f64,
    seed: u64,
) -> Vec<usize> {
    let mut candidates: Vec<(f64, u64, usize)> = sites
        .map(|(i, depth)| {
            let depth = (depth / spacing * 1e9).round();
            (depth, scrambled(i as u64 ^ seed), i)
        })
        .collect();
    // Deepest first; equals in no order that favours a side.
    let order =
        |a: &(f64, u64, usize), b: &(f64, u64, usize)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
    if count < candidates.len() {
        candidates.select_nth_unstable_by(count, order);
        candidates.truncate(count);
    }
    candidates.into_iter().map(|(_, _, i)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of a hexagonal lattice between flat sides at every height: nearly as many sites everywhere as there is room for.
    #[test]
    fn a_row_along_a_flat_side_is_in_as_much_as_its_cells_are() {
        let (across, along) = (1.0746, 0.9306);
        let sides: Vec<[f64; 2]> = vec![[0.0, 10.0], [20.0, 30.4], [41.0, 51.37], [60.0, 71.0]];
        let mut candidates = Vec::new();
        for row in 0..80 {
            for column in 0..160 {
                let y = along * f64::from(row);
                let x = across * (f64::from(column) + 0.5 * f64::from(row % 2));
                let depth = (sides.iter())
                    .map(|[low, high]| (y - low).min(high - y))
                    .fold(f64::NEG_INFINITY, f64::max);
                if depth > -1.0 {
                    candidates.push(Candidate {
                        site: candidates.len(),
                        place: [x, y],
                        depth,
                    });
                }
            }
        }
        let room: Vec<f64> = (sides.iter())
            .map(|[low, high]| (high - low) * 160.0 * across)
            .collect();
        let all: f64 = room.iter().sum();
        let count = all.round() as usize;
        let off = |kept: &[usize]| -> Vec<f64> {
            assert_eq!(kept.len(), count);
            let here = |low: f64, high: f64| {
                let is_here = |&&i: &&usize| {
                    let y = candidates[i].place[1];
                    y > low - 1.0 && y < high + 1.0
                };
                kept.iter().filter(is_here).count() as f64
            };
            (sides.iter().zip(&room))
                .map(|(&[low, high], room)| (here(low, high) - room).abs())
                .collect()
        };
        let pieces = off(&chosen(&candidates, count, 1.0, 1));
        let all = candidates.iter().map(|c| (c.site, c.depth));
        let whole = off(&deepest(all, count, 1.0, 1));
        // 23 … 29 of a side's 320 in two rows; in pieces, three each are let pass.
        assert!(whole.iter().all(|&off| off > 20.0), "{whole:?}");
        assert!(pieces.iter().all(|&off| off < 15.0), "{pieces:?}");
    }
}
