//! Triangles that pass through each other, decided exactly.

use robust::{Coord, Coord3D, orient2d, orient3d};
use sphpack_neighbors::{Bounds, point};

use super::{Soup, is_degenerate};
use crate::Bvh;
use crate::mesh::triangle;

/// How two triangles that share at most one vertex lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meeting {
    Apart,
    /// One passes through the other.
    Crossing,
    /// They meet in a way that the slightest shift changes.
    Touching,
}

/// On which side of the plane through `a`, `b`, `c` the point `p` is: the sign of a volume, exact.
pub(super) fn side(a: [f64; 3], b: [f64; 3], c: [f64; 3], p: [f64; 3]) -> i8 {
    let [a, b, c, p] = [a, b, c, p].map(|[x, y, z]| Coord3D { x, y, z });
    sign(orient3d(a, b, c, p))
}

fn sign(x: f64) -> i8 {
    i8::from(x > 0.0) - i8::from(x < 0.0)
}

/// How the segment `pq` meets the triangle `t`; where it only touches the triangle's plane or rim, `Touching`.
pub(super) fn pierces(p: [f64; 3], q: [f64; 3], t: &[[f64; 3]; 3]) -> Meeting {
    let (above, below) = (side(t[0], t[1], t[2], p), side(t[0], t[1], t[2], q));
    if above * below > 0 {
        return Meeting::Apart;
    }
    if above == 0 && below == 0 {
        // In one plane: that is for the whole triangles to say.
        return Meeting::Apart;
    }
    let turns: [i8; 3] = std::array::from_fn(|k| side(p, q, t[k], t[(k + 1) % 3]));
    let (least, most) = turns
        .iter()
        .fold((1, -1), |(a, b), &x| (a.min(x), b.max(x)));
    if least < 0 && most > 0 {
        Meeting::Apart
    } else if above * below < 0 && (least > 0 || most < 0) {
        Meeting::Crossing
    } else {
        Meeting::Touching
    }
}

/// Whether two triangles of one plane have area in common.
fn share_area(s: &[[f64; 3]; 3], t: &[[f64; 3]; 3]) -> bool {
    // Projected along the axis in which the plane is seen largest.
    let normal = triangle::area_vector(s).map(f64::abs);
    let axis = (0..3).fold(0, |a, k| if normal[k] > normal[a] { k } else { a });
    let flat = |v: [f64; 3]| Coord {
        x: v[(axis + 1) % 3],
        y: v[(axis + 2) % 3],
    };
    let (s, t) = (s.map(flat), t.map(flat));
    let separates = |s: &[Coord<f64>; 3], t: &[Coord<f64>; 3]| {
        let facing = sign(orient2d(s[0], s[1], s[2]));
        facing == 0
            || (0..3).any(|k| {
                t.iter()
                    .all(|&v| sign(orient2d(s[k], s[(k + 1) % 3], v)) * facing <= 0)
            })
    };
    !separates(&s, &t) && !separates(&t, &s)
}

/// How triangles `i` and `j` lie. Neighbours across an edge count as apart, and so do those at a common vertex
/// unless one passes through the other.
pub(super) fn meeting(soup: &Soup, i: usize, j: usize) -> Meeting {
    let (a, b) = (soup.triangles[i], soup.triangles[j]);
    if is_degenerate(&a) || is_degenerate(&b) {
        return Meeting::Apart;
    }
    let shared = a.iter().filter(|v| b.contains(v)).count();
    if shared >= 2 {
        return Meeting::Apart;
    }
    let (s, t) = (soup.corners(i), soup.corners(j));
    let over = |s: &[[f64; 3]; 3], t: &[[f64; 3]; 3]| t.map(|p| side(s[0], s[1], s[2], p));
    let (of_t, of_s) = (over(&s, &t), over(&t, &s));
    for signs in [of_t, of_s] {
        if signs.iter().all(|&x| x > 0) || signs.iter().all(|&x| x < 0) {
            return Meeting::Apart;
        }
    }
    let mut found = Meeting::Apart;
    if of_t == [0; 3] {
        if shared == 0 && share_area(&s, &t) {
            found = Meeting::Touching;
        }
        return found;
    }
    for (from, ids, into, others) in [(&s, a, &t, b), (&t, b, &s, a)] {
        for k in 0..3 {
            let next = (k + 1) % 3;
            // An edge that begins in the common vertex meets the other triangle there anyway.
            if others.contains(&ids[k]) || others.contains(&ids[next]) {
                continue;
            }
            match pierces(from[k], from[next], into) {
                Meeting::Apart => {}
                Meeting::Crossing => return Meeting::Crossing,
                Meeting::Touching if shared == 0 => found = Meeting::Touching,
                Meeting::Touching => {}
            }
        }
    }
    found
}

impl Soup {
    /// The triangles that cross or touch others, sorted.
    pub(crate) fn crossing_triangles(&self) -> Vec<u32> {
        let pairs = all(self);
        let mut found: Vec<u32> = pairs.iter().flat_map(|&(i, j, _)| [i, j]).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// The way in which a triangle is looked along, to see whether another lies beyond it. Any way is a fair one:
/// that of a sliver is rough, so what counts is how high the triangle's own corners stand in it.
struct Outlook {
    normal: [f64; 3],
    /// How low and how high the triangle's own corners stand, as products with the normal.
    low: f64,
    high: f64,
    /// What rounding may do to a product, for corners no farther from the origin than the unit.
    rounding: f64,
    /// The largest coordinate of the triangle's own corners.
    far: f64,
}

impl Outlook {
    fn new(normal: [f64; 3], corners: &[[f64; 3]; 3]) -> Self {
        let heights = corners.map(|p| point::dot(normal, p));
        Self {
            normal,
            low: heights.into_iter().fold(f64::INFINITY, f64::min),
            high: heights.into_iter().fold(f64::NEG_INFINITY, f64::max),
            rounding: 1e-12 * point::norm(normal),
            far: largest_coordinate(corners),
        }
    }

    /// Whether all `corners` that are not `skipped` are above the triangle, and whether all are below it, whatever
    /// rounding did.
    fn beyond(&self, corners: &[[f64; 3]; 3], skipped: impl Fn(usize) -> bool) -> [bool; 2] {
        let slack = self.rounding * (self.far + largest_coordinate(corners));
        let heights = || {
            (0..3)
                .filter(|&k| !skipped(k))
                .map(|k| point::dot(self.normal, corners[k]))
        };
        [
            heights().all(|h| h > self.high + slack),
            heights().all(|h| h < self.low - slack),
        ]
    }
}

fn largest_coordinate(corners: &[[f64; 3]; 3]) -> f64 {
    corners
        .as_flattened()
        .iter()
        .fold(0.0_f64, |a, x| a.max(x.abs()))
}

/// All pairs of triangles that cross or touch, with how; sorted. O(n log n) for triangles that spread out.
pub(super) fn all(soup: &Soup) -> Vec<(u32, u32, Meeting)> {
    let boxes: Vec<Bounds<3>> = (0..soup.triangles.len())
        .map(|t| Bounds::of(&soup.corners(t)))
        .collect();
    // Along every triangle's normal, and outwards in its plane from each edge. Most pairs lie apart in one of these
    // ways, clear of rounding, and need no exact sign: of a fan in one plane all do, whose signs are the slowest
    // there are (volumes of nothing).
    let outlooks: Vec<[Outlook; 4]> = (0..soup.triangles.len())
        .map(|t| {
            let corners = soup.corners(t);
            let normal = triangle::area_vector(&corners);
            let outwards = |k: usize| {
                let along = point::sub(corners[(k + 1) % 3], corners[k]);
                Outlook::new(point::cross(along, normal), &corners)
            };
            [
                Outlook::new(normal, &corners),
                outwards(0),
                outwards(1),
                outwards(2),
            ]
        })
        .collect();
    let is_beside = |i: usize, j: usize| {
        let [normal, edges @ ..] = &outlooks[i];
        let (mine, other) = (&soup.triangles[i], &soup.triangles[j]);
        let corners = soup.corners(j);
        // A common vertex is in both, whatever rounding says.
        let common = |k: usize| mine.contains(&other[k]);
        normal.beyond(&corners, common).contains(&true)
            || edges.iter().enumerate().any(|(e, outwards)| {
                let ends = [mine[e], mine[(e + 1) % 3]];
                let [above, _] = outwards.beyond(&corners, |k| ends.contains(&other[k]));
                above
            })
    };
    let shares_edge = |i: usize, j: usize| {
        let b = &soup.triangles[j];
        soup.triangles[i].iter().filter(|v| b.contains(v)).count() >= 2
    };
    let bvh = Bvh::build(&boxes);
    let pairs = bvh.pairs(&boxes, |i, j| {
        !shares_edge(i, j)
            && !is_beside(i, j)
            && !is_beside(j, i)
            && meeting(soup, i, j) != Meeting::Apart
    });
    pairs
        .into_iter()
        .map(|(i, j)| (i, j, meeting(soup, i as usize, j as usize)))
        .collect()
}
