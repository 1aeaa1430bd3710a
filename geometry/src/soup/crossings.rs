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
    /// The length of its shortest edge.
    shortest: f64,
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
            shortest: edges(corners).fold(f64::INFINITY, f64::min),
        }
    }

    /// Whether all `corners` that are not `skipped` are above the triangle, and whether all are below it, whatever
    /// rounding did. Triangles that share a skipped corner lie apart by their angle there, of which rounding takes the more, the
    /// shorter the edges.
    fn beyond(&self, corners: &[[f64; 3]; 3], skipped: impl Fn(usize) -> bool) -> [bool; 2] {
        let mut slack = self.rounding * (self.far + largest_coordinate(corners));
        if (0..3).any(&skipped) {
            let longest = edges(corners).fold(0.0, f64::max);
            slack *= (longest / self.shortest).max(1.0);
        }
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

/// The lengths of a triangle's edges.
fn edges(corners: &[[f64; 3]; 3]) -> impl Iterator<Item = f64> + '_ {
    (0..3).map(|k| point::distance(corners[k], corners[(k + 1) % 3]))
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
    let normals: Vec<Outlook> = (0..soup.triangles.len())
        .map(|t| {
            let corners = soup.corners(t);
            Outlook::new(triangle::area_vector(&corners), &corners)
        })
        .collect();
    // Along a triangle's normal, and outwards in its plane from each edge: most pairs lie apart in one of these ways, clear
    // of rounding, and need no exact sign. Of a fan in one plane all do, whose signs are the slowest there are (volumes
    // of nothing). The ways from edges are for the few pairs that come so far, and are not kept: four to a triangle are 224 bytes.
    let is_beside = |i: usize, j: usize| {
        let (mine, other) = (&soup.triangles[i], &soup.triangles[j]);
        let corners = soup.corners(j);
        // A common vertex is in both, whatever rounding says.
        if normals[i].beyond(&corners, |k| mine.contains(&other[k])) != [false; 2] {
            return true;
        }
        let own = soup.corners(i);
        (0..3).any(|e| {
            let along = point::sub(own[(e + 1) % 3], own[e]);
            let outwards = Outlook::new(point::cross(along, normals[i].normal), &own);
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

#[cfg(test)]
mod tests {
    use sphpack_neighbors::random::scrambled;

    use super::*;

    /// Triangles over few places, whole or nearly so, with many common vertices, many in one plane, slivers: what is passed over without
    /// exact signs is what exact signs call apart.
    #[test]
    fn only_pairs_that_are_apart_are_passed_over() {
        for seed in 0..600_u64 {
            let draw = |n: u64, below: u64| scrambled(seed << 32 | n) % below;
            let flat = if seed % 3 == 0 { 1 } else { 3 };
            let jitter = [0.0, 1e-15, 1e-9, 0.2][(seed % 4) as usize];
            let far = [0.0, 1e6][(seed / 4 % 2) as usize];
            let vertices: Vec<[f64; 3]> = (0..14)
                .map(|v| {
                    let at = |k: u64| {
                        let off = draw(100 + 3 * v + k, 1000) as f64 / 1000.0 - 0.5;
                        far + draw(3 * v + k, if k == 2 { flat } else { 5 }) as f64 + jitter * off
                    };
                    [at(0), at(1), at(2)]
                })
                .collect();
            let triangles: Vec<[u32; 3]> = (0..30)
                .map(|t| [0, 1, 2].map(|k| draw(1000 + 3 * t + k, 14) as u32))
                .collect();
            let soup = Soup {
                vertices,
                triangles,
                welded: 0,
            };
            let mut exact = Vec::new();
            for j in 0..soup.triangles.len() {
                for i in 0..j {
                    let meeting = meeting(&soup, i, j);
                    if meeting != Meeting::Apart {
                        exact.push((i as u32, j as u32, meeting));
                    }
                }
            }
            exact.sort_by_key(|&(i, j, _)| (i, j));
            assert_eq!(all(&soup), exact, "{seed}");
        }
    }
}
