//! Meshes that go on beyond the sides of a box.

mod contents;
mod moved;

use std::collections::HashMap;
use std::sync::Arc;

use sphpack_neighbors::{Domain, point};

use self::contents::pieces_in;
use self::moved::Moved;
use super::features::features_in;
use super::{Continued, Reach, Whole, into, moved_by, parts_by_images, slack, snapped};
use crate::mesh::{Mesh, triangle};
use crate::sample::{Candidates, spread};
use crate::soup::Soup;
use crate::surface::{Closest, Features, Surface};
use crate::{GeometryError, ParameterError};

/// A mesh and its images are joined where their volume is right to this part.
const VOLUME_WITHIN: f64 = 1e-5;

/// Part by which each point's place across its piece goes on from the last one's: the golden ratio.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Vertices, and triangles of them.
#[derive(Debug, Clone)]
struct Net {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// What of the body lies in the box, going on beyond its sides; `None` where it does not pass an open one, nor has a face on
    /// one, nor is as long as a period. O(n log n) for n triangles and their images.
    ///
    /// # Errors
    /// [`MeshError::Defective`](crate::MeshError::Defective) where the body and its images cannot be joined.
    pub fn continued(&self, domain: &Domain<3>) -> Result<Option<Continued<3>>, GeometryError> {
        let (shift, bounds) = into(self.bounds(), domain);
        let reach = [0, 1, 2].map(|axis| Reach::of(&bounds, domain, axis));
        let slack = slack(domain);
        let mut net = Net {
            vertices: (self.vertices().iter())
                .map(|&v| snapped(point::add(v, shift), domain, slack))
                .collect(),
            triangles: self.triangles().to_vec(),
        };
        net.triangles
            .retain(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        let mut goes_on = reach.iter().any(|reach| reach.periods > 0);
        for axis in (0..3).filter(|&axis| !domain.periodic[axis]) {
            goes_on |= reach[axis].passes != [false; 2];
            for upper in [false, true] {
                goes_on |= net.carry_on(domain, axis, upper);
            }
        }
        if !goes_on {
            return Ok(None);
        }
        for axis in (0..3).filter(|&axis| domain.periodic[axis]) {
            net = net.with_images(domain, axis, reach[axis])?;
        }
        let whole = Self::new(net.vertices, net.triangles)?;
        Ok(Some(Continued::new(Arc::new(whole), domain)))
    }
}

impl Net {
    /// Whether a triangle lies across an axis at such a level, to `slack`, and looks out of the box.
    fn is_on(&self, t: &[u32; 3], axis: usize, level: f64, out: f64, slack: f64) -> bool {
        let corners = t.map(|v| self.vertices[v as usize]);
        corners.iter().all(|c| (c[axis] - level).abs() <= slack)
            && triangle::area_vector(&corners)[axis] * out > 0.0
    }

    /// Moves the faces on an open side out by the size of the box, with walls behind them; whether there are any.
    fn carry_on(&mut self, domain: &Domain<3>, axis: usize, upper: bool) -> bool {
        let (side, out) = if upper {
            (domain.bounds.max[axis], 1.0)
        } else {
            (domain.bounds.min[axis], -1.0)
        };
        // Those beyond it too, as far as the box is large: a face less than ∆s/2 beyond would have its particles in the
        // box.
        let slack = slack(domain);
        let far = domain.bounds.diagonal();
        let on: Vec<usize> = (0..self.triangles.len())
            .filter(|&t| {
                let level = self.vertices[self.triangles[t][0] as usize][axis];
                (0.0..far).contains(&((level - side) * out))
                    && self.is_on(&self.triangles[t], axis, level, out, slack)
            })
            .collect();
        if on.is_empty() {
            return false;
        }
        let far = far * out;
        let mut moved: HashMap<u32, u32> = HashMap::new();
        // Sides of the faces with no face on the other side.
        let mut rim: HashMap<(u32, u32), i32> = HashMap::new();
        for &t in &on {
            let [a, b, c] = self.triangles[t];
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let sign = if from < to { 1 } else { -1 };
                *rim.entry((from.min(to), from.max(to))).or_insert(0) += sign;
            }
        }
        for &t in &on {
            let out = self.triangles[t].map(|v| {
                *moved.entry(v).or_insert_with(|| {
                    let mut p = self.vertices[v as usize];
                    p[axis] += far;
                    self.vertices.push(p);
                    self.vertices.len() as u32 - 1
                })
            });
            self.triangles[t] = out;
        }
        let mut rim: Vec<((u32, u32), i32)> = rim.into_iter().filter(|(_, n)| *n != 0).collect();
        rim.sort_unstable();
        for ((low, high), sign) in rim {
            let (a, b) = if sign > 0 { (low, high) } else { (high, low) };
            let (c, d) = (moved[&a], moved[&b]);
            self.triangles.push([a, b, d]);
            self.triangles.push([a, d, c]);
        }
        true
    }

    /// The body and its images along a periodic axis, joined where they meet.
    fn with_images(
        self,
        domain: &Domain<3>,
        axis: usize,
        reach: Reach,
    ) -> Result<Self, GeometryError> {
        let (min, max) = (domain.bounds.min[axis], domain.bounds.max[axis]);
        let count = reach.periods.max(1) as i32;
        let images = |between: &dyn Fn(&[u32; 3], i32) -> bool| {
            let mut all = Self {
                vertices: Vec::new(),
                triangles: Vec::new(),
            };
            for step in -count..=count {
                let first = all.vertices.len() as u32;
                all.vertices.extend(self.vertices.iter().map(|v| {
                    let mut v = *v;
                    v[axis] = moved_by(v[axis], step, [min, max]);
                    v
                }));
                let kept = self.triangles.iter().filter(|t| !between(t, step));
                all.triangles.extend(kept.map(|t| t.map(|v| v + first)));
            }
            all
        };
        if reach.periods == 0 {
            return Ok(images(&|_, _| false));
        }
        let whole = images(&|_, _| false);
        if reach.passes == [false; 2] {
            // Faces between two images go, and the images' rims become one.
            let open = images(&|t, step| {
                self.is_on(t, axis, max, 1.0, 0.0) && step < count
                    || self.is_on(t, axis, min, -1.0, 0.0) && step > -count
            });
            let volume = open.volume();
            let loose: Vec<[[f64; 3]; 3]> = (open.triangles.iter())
                .map(|t| t.map(|v| open.vertices[v as usize]))
                .collect();
            if let Ok(mended) = Soup::from_loose(&loose).and_then(|soup| soup.body())
                && (mended.mesh.volume() - volume.abs()).abs() <= VOLUME_WITHIN * volume.abs()
            {
                return Ok(Self::of(&mended.mesh));
            }
        }
        let joined = Soup::new(whole.vertices, whole.triangles)?.body()?;
        Ok(Self::of(&joined.mesh))
    }

    fn of(mesh: &Mesh) -> Self {
        Self {
            vertices: mesh.vertices().to_vec(),
            triangles: mesh.triangles().to_vec(),
        }
    }

    /// What the triangles enclose, those on periodic sides that cancel each other left out or not.
    fn volume(&self) -> f64 {
        let Some(&origin) = self.vertices.first() else {
            return 0.0;
        };
        let six: f64 = (self.triangles.iter())
            .map(|t| {
                let [a, b, c] = t.map(|v| point::sub(self.vertices[v as usize], origin));
                point::dot(a, point::cross(b, c))
            })
            .sum();
        six / 6.0
    }
}

impl Whole<3> for Mesh {
    fn contents(&self, domain: &Domain<3>) -> (f64, f64) {
        contents::of(self, domain).as_it_is()
    }

    fn moved_in(&self, depth: f64) -> Result<Arc<dyn Whole<3>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        let whole = Arc::new(self.clone());
        if depth == 0.0 {
            return Ok(whole);
        }
        Ok(Arc::new(Moved::new(whole, depth)?))
    }

    fn parts_in(&self, domain: &Domain<3>) -> Vec<Arc<dyn Whole<3>>> {
        let (parts, groups) = parts_by_images(self.pieces(), domain);
        if groups.len() < 2 {
            return Vec::new();
        }
        let whole = |group: Vec<usize>| {
            let mut all = Net {
                vertices: Vec::new(),
                triangles: Vec::new(),
            };
            for part in group.into_iter().map(|i| &parts[i]) {
                let first = all.vertices.len() as u32;
                all.vertices.extend(part.vertices());
                all.triangles
                    .extend(part.triangles().iter().map(|t| t.map(|v| v + first)));
            }
            Self::new(all.vertices, all.triangles).ok()
        };
        (groups.into_iter().filter_map(whole))
            .map(|part| Arc::new(part) as Arc<dyn Whole<3>>)
            .collect()
    }

    fn features_in(&self, domain: &Domain<3>) -> Features<3> {
        features_in(self.features(), domain)
    }

    fn scattered_in(&self, domain: &Domain<3>, count: usize) -> Candidates<3> {
        let pieces = pieces_in(self, domain);
        let mut across = 0.5;
        Candidates::systematic(
            count,
            &pieces,
            |(corners, _)| triangle::area(corners),
            |(corners, normal), before| {
                across = (across + GOLDEN) % 1.0;
                let way = before.sqrt();
                let weights = [1.0 - way, way * (1.0 - across), way * across];
                (triangle::place(corners, weights), *normal)
            },
        )
    }

    fn sample_in(
        &self,
        surface: &Continued<3>,
        count: usize,
    ) -> Result<Vec<Closest<3>>, GeometryError> {
        let scatter = |_, wanted| self.scattered_in(&surface.domain, wanted);
        spread(surface, count, &|p| surface.closest(p), scatter)
    }
}
