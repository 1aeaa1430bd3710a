//! Painted regions, and the boundary of all of them together.

use crate::outline::booleans::{Filled, common, resolved};
use crate::segment::signed_area;
use crate::{GeometryError, Sketch};

type Loops = Vec<Vec<[f64; 2]>>;

/// What loops bound by a rule: where they wind around an odd number of times, or at all.
pub(super) struct Region {
    pub(super) loops: Loops,
    pub(super) is_odd: bool,
}

impl Region {
    /// Outer loops counter-clockwise, holes clockwise.
    fn resolved(&self) -> Loops {
        let rule = if self.is_odd {
            Filled::Odd
        } else {
            Filled::Nonzero
        };
        resolved(&self.loops, rule)
    }

    /// What some regions have in common with others.
    pub(super) fn within(regions: Vec<Self>, clip: Vec<Self>) -> Vec<Self> {
        if is_room_enough(&regions, &clip) {
            return regions;
        }
        let loops = common(&united(&regions), &united(&clip));
        vec![Self {
            loops,
            is_odd: false,
        }]
    }
}

/// Whether a clip is an upright rectangle around all regions, such as a page.
fn is_room_enough(regions: &[Region], clip: &[Region]) -> bool {
    let [Region { loops, .. }] = clip else {
        return false;
    };
    let [page] = loops.as_slice() else {
        return false;
    };
    let corners = match page.as_slice() {
        [first, .., last] if first == last => &page[..page.len() - 1],
        all => all,
    };
    let [a, b, c, d] = *corners else {
        return false;
    };
    let is_upright = a[0] == d[0] && b[0] == c[0] && a[1] == b[1] && c[1] == d[1]
        || a[1] == d[1] && b[1] == c[1] && a[0] == b[0] && c[0] == d[0];
    let holds = |p: &[f64; 2]| (0..2).all(|k| a[k].min(c[k]) <= p[k] && p[k] <= a[k].max(c[k]));
    let mut points = regions
        .iter()
        .flat_map(|region| region.loops.iter().flatten());
    is_upright && points.all(holds)
}

/// The boundary of what any region holds.
fn united(regions: &[Region]) -> Loops {
    match regions {
        [one] => one.resolved(),
        several => {
            let all: Loops = several.iter().flat_map(Region::resolved).collect();
            resolved(&all, Filled::Positive)
        }
    }
}

/// The loops that bound what any region holds. Where no loops meet they stay as they are, and those with paint on both
/// sides are left out.
pub(super) fn boundary(regions: Vec<Region>) -> Result<Loops, GeometryError> {
    let all: Loops = regions.iter().flat_map(|r| r.loops.clone()).collect();
    if all.is_empty() {
        return Ok(all);
    }
    let report = Sketch::new(all)?.check();
    if !report.is_clean() {
        return Ok(united(&regions));
    }
    // The loops within each loop; those within none last.
    let count = report.loops.len();
    let mut within: Vec<Vec<usize>> = vec![Vec::new(); count + 1];
    for (k, one) in report.loops.iter().enumerate() {
        within[one.inside.unwrap_or(count)].push(k);
    }
    let rules: Vec<bool> = regions.iter().map(|region| region.is_odd).collect();
    let (mut of, mut loops) = (Vec::new(), Vec::new());
    for (number, region) in regions.into_iter().enumerate() {
        of.extend(std::iter::repeat_n(number, region.loops.len()));
        loops.extend(region.loops);
    }
    let mut paint = Paint {
        windings: vec![0; rules.len()],
        rules,
        layers: 0,
    };
    let mut kept = vec![false; count];
    // Into each loop, and out of it again.
    let mut steps: Vec<(usize, bool)> = within[count].iter().map(|&k| (k, true)).collect();
    while let Some((k, is_in)) = steps.pop() {
        let turn = if signed_area(&loops[k]) > 0.0 { 1 } else { -1 };
        let before = paint.layers > 0;
        paint.cross(of[k], if is_in { turn } else { -turn });
        if is_in {
            kept[k] = before != (paint.layers > 0);
            steps.push((k, false));
            steps.extend(within[k].iter().map(|&inner| (inner, true)));
        }
    }
    let mut kept = kept.into_iter();
    loops.retain(|_| kept.next() == Some(true));
    Ok(loops)
}

/// How often regions are wound around at a place.
struct Paint {
    rules: Vec<bool>,
    windings: Vec<i64>,
    /// How many regions there hold it.
    layers: usize,
}

impl Paint {
    fn cross(&mut self, region: usize, turn: i64) {
        let is_odd = self.rules[region];
        let holds = |winding: i64| {
            usize::from(if is_odd {
                winding % 2 != 0
            } else {
                winding != 0
            })
        };
        let winding = &mut self.windings[region];
        self.layers -= holds(*winding);
        *winding += turn;
        self.layers += holds(*winding);
    }
}
