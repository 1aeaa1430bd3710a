//! Faces that lie on each other and look at each other: a wall of no thickness between two bodies, or a gap of no width.

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use sphpack_neighbors::{Bounds, point};

use super::shells::Joined;
use super::{Soup, check, cracks};
use crate::Bvh;
use crate::mesh::{topology, triangle};
use crate::outline::booleans::{common, without};
use crate::outline::winding_number;
use crate::segment::signed_area;

/// Cosine of the angle up to which faces are opposite.
const OPPOSITE: f64 = -1.0 + 1e-9;

type Loops = Vec<Vec<[f64; 2]>>;

/// A plane, as it is looked at from the side that some of its faces look to.
#[derive(Debug, Clone, Copy)]
struct Plane {
    origin: [f64; 3],
    axes: [[f64; 3]; 2],
}

impl Plane {
    fn flat(&self, p: [f64; 3]) -> [f64; 2] {
        let p = point::sub(p, self.origin);
        self.axes.map(|axis| point::dot(p, axis))
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let along = point::add_scaled(self.origin, x, self.axes[0]);
        point::add_scaled(along, y, self.axes[1])
    }
}

impl Soup {
    /// Takes out what of two faces lies on each other, where they look at each other: there the bodies behind them are one, or
    /// touch with nothing between. Edges that then end in the middle of others are cut. Returns how many such
    /// walls went; none where that would leave open edges that were not there.
    pub(super) fn drop_flush_walls(&mut self) -> usize {
        let mut mended = self.clone();
        let count = mended.drop_walls();
        if count > 0 {
            mended.close_cracks();
            if mended.open_edges() <= self.open_edges() {
                *self = mended;
                return count;
            }
        }
        0
    }

    /// Whether there are such walls.
    pub(super) fn has_flush_walls(&self) -> bool {
        self.clone().drop_walls() > 0
    }

    fn open_edges(&self) -> usize {
        let sides = check::sides(self);
        topology::edges(&sides)
            .filter(|edge| edge.len() % 2 == 1)
            .count()
    }

    fn drop_walls(&mut self) -> usize {
        let width = cracks::WIDTH * Bounds::of(&self.vertices).diagonal();
        let corners: Vec<[[f64; 3]; 3]> =
            (0..self.triangles.len()).map(|t| self.corners(t)).collect();
        let normals: Vec<Option<[f64; 3]>> = (corners.iter())
            .map(|t| point::unit(triangle::area_vector(t)))
            .collect();
        let boxes: Vec<Bounds<3>> = corners
            .iter()
            .map(|t| Bounds::of(t).grown(0.5 * width))
            .collect();
        let mut joined = Joined::new(corners.len());
        let mut faces: Vec<usize> = Vec::new();
        let tree = Bvh::build(&boxes);
        for i in 0..corners.len() {
            let Some(normal) = normals[i] else { continue };
            tree.overlapping(&boxes[i], |j| {
                let is_opposite =
                    j > i && normals[j].is_some_and(|other| point::dot(normal, other) < OPPOSITE);
                if is_opposite && lie_on_each_other(&corners[i], &corners[j], normal, width) {
                    joined.join(i as u32, j as u32);
                    faces.extend([i, j]);
                }
            });
        }
        faces.sort_unstable();
        faces.dedup();
        let mut walls: std::collections::BTreeMap<u32, Vec<usize>> =
            std::collections::BTreeMap::new();
        for &t in &faces {
            walls.entry(joined.find(t as u32)).or_default().push(t);
        }
        let mut gone = vec![false; self.triangles.len()];
        let mut count = 0;
        for members in walls.into_values() {
            if let Some(left) = self.what_is_left(&members, width) {
                for t in members {
                    gone[t] = true;
                }
                gone.resize(gone.len() + left.len(), false);
                self.triangles.extend(left);
                count += 1;
            }
        }
        let mut t = 0;
        self.triangles.retain(|_| {
            t += 1;
            !gone[t - 1]
        });
        count
    }

    /// The triangles that are left of some in one plane where they lie on each other; `None` where hardly anything does.
    fn what_is_left(&mut self, members: &[usize], width: f64) -> Option<Vec<[u32; 3]>> {
        let first = self.corners(members[0]);
        let normal = point::unit(triangle::area_vector(&first))?;
        let along = point::unit(point::sub(first[1], first[0]))?;
        let plane = Plane {
            origin: first[0],
            axes: [along, point::cross(normal, along)],
        };
        let mut looks: [Loops; 2] = [Vec::new(), Vec::new()];
        let mut known: Vec<(u32, [f64; 2])> = Vec::new();
        for &t in members {
            let corners = self.corners(t);
            let mut flat: Vec<[f64; 2]> = corners.iter().map(|&p| plane.flat(p)).collect();
            known.extend(self.triangles[t].into_iter().zip(flat.iter().copied()));
            let looks_back = point::dot(triangle::area_vector(&corners), normal) < 0.0;
            if looks_back {
                flat.reverse();
            }
            looks[usize::from(looks_back)].push(flat);
        }
        let area = |loops: &Loops| loops.iter().map(|points| signed_area(points)).sum::<f64>();
        let length: f64 = Bounds::of(&known.iter().map(|(_, p)| *p).collect::<Vec<_>>()).diagonal();
        if area(&common(&looks[0], &looks[1])) <= 10.0 * width * length {
            return None;
        }
        let mut left = Vec::new();
        for (own, other) in [(0, 1), (1, 0)] {
            let loops = without(&looks[own], &looks[other]);
            for [a, b, c] in self.triangulated(&loops, &plane, &mut known, width) {
                left.push(if own == 0 { [a, b, c] } else { [a, c, b] });
            }
        }
        Some(left)
    }

    /// Triangles over what loops bound, counter-clockwise in the plane, of known vertices where these are near.
    fn triangulated(
        &mut self,
        loops: &Loops,
        plane: &Plane,
        known: &mut Vec<(u32, [f64; 2])>,
        width: f64,
    ) -> Vec<[u32; 3]> {
        let mut net = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
        // Corners take the very place of a vertex that is there.
        let mut taken: Vec<(spade::handles::FixedVertexHandle, u32)> = Vec::new();
        let mut bounds: Loops = Vec::new();
        for points in loops {
            let mut ring = Vec::new();
            let mut handles = Vec::new();
            for &p in points {
                let near = (known.iter()).find(|(_, q)| point::distance(p, *q) <= width);
                let (v, p) = match near {
                    Some(&(v, q)) => (v, q),
                    None => {
                        self.vertices.push(plane.place(p));
                        let v = self.vertices.len() as u32 - 1;
                        known.push((v, p));
                        (v, p)
                    }
                };
                ring.push(p);
                if let Ok(handle) = net.insert(Point2::new(p[0], p[1])) {
                    taken.push((handle, v));
                    handles.push(handle);
                }
            }
            for (i, &from) in handles.iter().enumerate() {
                let to = handles[(i + 1) % handles.len()];
                if from != to && net.can_add_constraint(from, to) {
                    net.add_constraint(from, to);
                }
            }
            bounds.push(ring);
        }
        let mut triangles = Vec::new();
        for face in net.inner_faces() {
            let middle = face.center();
            let winds: i64 = (bounds.iter())
                .map(|ring| winding_number(ring, [middle.x, middle.y]))
                .sum();
            if winds == 0 {
                continue;
            }
            let ids = face.vertices().map(|vertex| {
                let own = taken.iter().find(|(handle, _)| *handle == vertex.fix());
                own.map_or(0, |(_, v)| *v)
            });
            // Corners on a line, but for rounding, make no triangle; edges that then end in the middle of others are cut.
            let corners = ids.map(|v| self.vertices[v as usize]);
            let longest = (0..3)
                .map(|k| point::distance(corners[k], corners[(k + 1) % 3]))
                .fold(0.0, f64::max);
            if triangle::area(&corners) > 0.5 * width * longest {
                triangles.push(ids);
            }
        }
        triangles
    }
}

/// Whether two triangles with opposite normals have room in common: both in one plane, and no side of either parts them.
fn lie_on_each_other(
    one: &[[f64; 3]; 3],
    other: &[[f64; 3]; 3],
    normal: [f64; 3],
    width: f64,
) -> bool {
    let is_in_plane =
        (other.iter()).all(|&p| point::dot(point::sub(p, one[0]), normal).abs() <= width);
    let parts = |of: &[[f64; 3]; 3], from: &[[f64; 3]; 3], up: [f64; 3]| {
        (0..3).any(|k| {
            let way = point::sub(of[(k + 1) % 3], of[k]);
            let out = point::unit(point::cross(way, up)).unwrap_or(up);
            from.iter()
                .all(|&p| point::dot(point::sub(p, of[k]), out) >= -width)
        })
    };
    is_in_plane && !parts(one, other, normal) && !parts(other, one, point::scale(normal, -1.0))
}

#[cfg(test)]
mod tests {
    use sphpack_neighbors::random::Congruential;

    use super::*;
    use crate::{Similarity, Surface};

    /// A box with sides that are cut along one diagonal or the other, as `bits` say.
    fn brick(low: [f64; 3], high: [f64; 3], bits: u32) -> Vec<[[f64; 3]; 3]> {
        let corner =
            |k: usize| std::array::from_fn(|a| if k >> a & 1 == 1 { high[a] } else { low[a] });
        let sides = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        (sides.iter().enumerate())
            .flat_map(|(n, &[a, b, c, d])| {
                if bits >> n & 1 == 0 {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                }
            })
            .map(|t| t.map(corner))
            .collect()
    }

    #[test]
    fn shared_sides_with_other_diagonals() {
        for bits in 0..64 {
            let both = [
                brick([-0.5; 3], [0.5; 3], 0),
                brick([0.5, -0.5, -0.5], [1.5, 0.5, 0.5], bits),
            ];
            let body = Soup::from_loose(&both.concat()).unwrap().body().unwrap();
            assert!((body.mesh.volume() - 2.0).abs() < 1e-12, "{:?}", body.done);
            assert!(
                (body.mesh.measure() - 10.0).abs() < 1e-12,
                "{:?}",
                body.done
            );
        }
    }

    #[test]
    fn a_box_on_a_plate() {
        // In the middle, at an edge, in a corner, over the edge.
        for (x, y, area) in [
            (0.7, 0.4, 14.0),
            (0.7, 0.0, 14.0),
            (0.0, 0.0, 14.0),
            (-0.3, 0.4, 14.0 + 2.0 * 0.3 * 0.5),
        ] {
            let plate = brick([0.0; 3], [2.0, 2.0, 0.5], 13);
            let low = [x, y, 0.5];
            let block = brick(low, [x + 0.5, y + 0.5, 1.5], 37);
            let exact = 2.0 + 0.25;
            let _ = area;
            let body = Soup::from_loose(&[plate, block].concat())
                .unwrap()
                .body()
                .unwrap();
            assert!(
                (body.mesh.volume() - exact).abs() < 1e-9,
                "{x} {y}: {:?}",
                body.done
            );
            let shared = 0.5 * (0.5 + x.min(0.0));
            let all = 2.0 * 4.0 + 8.0 * 0.5 + 2.0 * 0.25 + 4.0 * 0.5 - 2.0 * shared;
            assert!(
                (body.mesh.measure() - all).abs() < 1e-9,
                "{x} {y}: {} {all}",
                body.mesh.measure()
            );
        }
    }

    /// Small whole numbers from a seed.
    fn next(random: &mut Congruential, below: u64) -> u64 {
        (random.bits() >> 33) % below
    }

    /// Boxes of whole sizes that fill a grid in part, turned, some in single precision: one body of the cells that they fill, or
    /// refused; mostly the former.
    #[test]
    fn stacks_of_boxes_are_one_body() {
        const SIZE: usize = 5;
        let mut refused = 0;
        for seed in 0..150 {
            let mut random = Congruential::new(seed);
            let mut filled = [[[false; SIZE]; SIZE]; SIZE];
            let mut faces = Vec::new();
            let mut volume = 0;
            for _ in 0..4 {
                let low: [usize; 3] = std::array::from_fn(|_| next(&mut random, 3) as usize);
                let high: [usize; 3] =
                    std::array::from_fn(|k| low[k] + 1 + next(&mut random, 2) as usize);
                let cells = || {
                    (low[0]..high[0]).flat_map(move |i| {
                        (low[1]..high[1])
                            .flat_map(move |j| (low[2]..high[2]).map(move |k| [i, j, k]))
                    })
                };
                if cells().any(|[i, j, k]| filled[i][j][k]) {
                    continue;
                }
                for [i, j, k] in cells() {
                    filled[i][j][k] = true;
                    volume += 1;
                }
                let bits = next(&mut random, 64) as u32;
                faces.extend(brick(low.map(|x| x as f64), high.map(|x| x as f64), bits));
            }
            let is_full = |i: isize, j: isize, k: isize| {
                let inner = |x: isize| (0..SIZE as isize).contains(&x);
                inner(i) && inner(j) && inner(k) && filled[i as usize][j as usize][k as usize]
            };
            let mut area = 0;
            for i in 0..SIZE as isize {
                for j in 0..SIZE as isize {
                    for k in 0..SIZE as isize {
                        if is_full(i, j, k) {
                            let around = [
                                (i - 1, j, k),
                                (i + 1, j, k),
                                (i, j - 1, k),
                                (i, j + 1, k),
                                (i, j, k - 1),
                                (i, j, k + 1),
                            ];
                            area += around
                                .iter()
                                .filter(|&&(i, j, k)| !is_full(i, j, k))
                                .count();
                        }
                    }
                }
            }
            let turn =
                Similarity::<3>::new(1.0, [0.4, 1.0, 0.3], seed as f64, [0.3, 0.1, 0.7]).unwrap();
            let is_single = seed % 2 == 1;
            for p in faces.iter_mut().flatten() {
                *p = turn.point(*p);
                if is_single {
                    *p = p.map(|x| f64::from(x as f32));
                }
            }
            match Soup::from_loose(&faces).unwrap().body() {
                Ok(body) => {
                    let (v, a) = (body.mesh.volume(), body.mesh.measure());
                    assert!(
                        (v - f64::from(volume)).abs() < 1e-3,
                        "{seed}: {v} {volume} {:?}",
                        body.done
                    );
                    assert!(
                        (a - area as f64).abs() < 1e-3,
                        "{seed}: {a} {area} {:?}",
                        body.done
                    );
                }
                Err(_) => refused += 1,
            }
        }
        assert!(refused <= 15, "{refused} of 150");
    }
}
