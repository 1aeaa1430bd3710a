//! Bodies in the plane: closed polygons and finely sampled curves.

pub(crate) mod booleans;
pub(crate) mod check;
mod engine;
mod inside;
mod naca;
mod offset;
mod pieces;
mod shapes;
mod surface;
mod swept;
#[cfg(test)]
mod tests;

pub(crate) use inside::crosses;
pub use inside::{angle_sum, crossing_number, winding_number};
pub use offset::MITRE_LIMIT;

use sphpack_neighbors::{Bounds, point};

use crate::segment::Segment;
use crate::{Bvh, GeometryError, Similarity};

/// A vertex of an outline at which the direction turns by more than this is a corner; at less it is a node of a
/// smooth curve. Twelve nodes on a circle turn by 30°; the sampled shapes here turn by less than a degree.
pub const CORNER_DEGREES: f64 = 30.0;

/// Consecutive points nearer than this, in parts of the outline's size, are one point.
pub(crate) const SAME_POINT: f64 = 1e-13;

/// A closed outline: one or several loops of straight sides that do not meet, outer ones counter-clockwise, holes
/// clockwise, so that the body is always on the left and normals point out of it.
///
/// ```
/// use sphpack_geometry::{Outline, Surface};
/// let wing = Outline::naca("0015", 1.0)?;
/// assert_eq!(wing.features().corners, [[1.0, 0.0]]);
/// assert!((wing.volume() - 0.102).abs() < 1e-3);
/// let hit = wing.closest([0.5, 0.0]);
/// assert!(hit.distance < 0.0 && (hit.point[1].abs() - 0.066).abs() < 1e-3);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Outline {
    points: Vec<[f64; 2]>,
    /// Where each loop starts in `points`, and their number at the end.
    starts: Vec<usize>,
    /// Side `i` runs from point `i` to the next of its loop.
    sides: Vec<Segment>,
    /// End point of side `i`.
    next: Vec<u32>,
    /// Negi & Ramachandran (2021), eq. 10.
    node_normals: Vec<[f64; 2]>,
    corner: Vec<bool>,
    bvh: Bvh<2>,
    length: f64,
    area: f64,
}

impl Outline {
    /// The outline of one or several loops. The order of the points and of the loops is free: orientation follows
    /// from nesting (even-odd). Repeated points, also the first at the end, are removed. O(n log n) for n points
    /// that spread out.
    ///
    /// # Errors
    /// An [`OutlineError`](crate::OutlineError): too few points, no finite number, no area, or
    /// the two sides and the place where the outline crosses or touches
    /// itself.
    pub fn new(loops: Vec<Vec<[f64; 2]>>) -> Result<Self, GeometryError> {
        let loops = check::without_repeats(loops)?;
        let outline = Self::assemble(loops);
        check::no_meetings(&outline)?;
        Ok(outline.nested())
    }

    /// The outline of one loop, as [`Outline::new`].
    ///
    /// # Errors
    /// As [`Outline::new`].
    pub fn polygon(points: &[[f64; 2]]) -> Result<Self, GeometryError> {
        Self::new(vec![points.to_vec()])
    }

    /// From loops known to be clean.
    fn from_clean(loops: Vec<Vec<[f64; 2]>>) -> Self {
        Self::assemble(loops).nested()
    }

    /// Turns loops as their nesting asks: counter-clockwise inside an even number of others, else clockwise.
    fn nested(self) -> Self {
        let mut loops: Vec<Vec<[f64; 2]>> = self.loops().map(<[_]>::to_vec).collect();
        let mut turned = false;
        for k in 0..loops.len() {
            // It is inside an odd number of others just where a ray crosses their sides an odd number of times.
            let (p, own) = (loops[k][0], self.starts[k]..self.starts[k + 1]);
            let mut is_hole = false;
            self.beside(p, |i| {
                let [a, b] = self.side(i);
                is_hole ^= !own.contains(&i) && crosses(a, b, p);
            });
            let counter_clockwise = crate::segment::signed_area(&loops[k]) > 0.0;
            if counter_clockwise == is_hole {
                // The first point stays the first.
                loops[k][1..].reverse();
                turned = true;
            }
        }
        if turned { Self::assemble(loops) } else { self }
    }

    /// Sides, normals, corners and tree of the loops as they are.
    pub(crate) fn assemble(loops: Vec<Vec<[f64; 2]>>) -> Self {
        let mut starts = vec![0];
        let mut points = Vec::with_capacity(loops.iter().map(Vec::len).sum());
        for one in &loops {
            points.extend_from_slice(one);
            starts.push(points.len());
        }
        let mut next = vec![0; points.len()];
        let mut previous = vec![0; points.len()];
        for range in starts.windows(2) {
            for i in range[0]..range[1] {
                let after = if i + 1 < range[1] { i + 1 } else { range[0] };
                next[i] = after as u32;
                previous[after] = i;
            }
        }
        let sides: Vec<Segment> = (0..points.len())
            .map(|i| Segment::new(points[i], points[next[i] as usize]))
            .collect();
        let turn_limit = CORNER_DEGREES.to_radians().cos();
        let mut node_normals = Vec::with_capacity(points.len());
        let mut corner = Vec::with_capacity(points.len());
        for i in 0..points.len() {
            let (before, after) = (sides[previous[i]], sides[i]);
            let sum = point::add(before.normal, after.normal);
            // Where the outline turns straight back, out is along the spike.
            node_normals.push(
                point::unit(sum)
                    .or_else(|| point::unit(before.edge))
                    .unwrap_or(after.normal),
            );
            corner.push(point::dot(before.normal, after.normal) < turn_limit);
        }
        let boxes: Vec<Bounds<2>> = (0..points.len())
            .map(|i| Bounds::of(&[points[i], points[next[i] as usize]]))
            .collect();
        Self {
            length: sides.iter().map(Segment::length).sum(),
            area: starts
                .windows(2)
                .map(|r| crate::segment::signed_area(&points[r[0]..r[1]]))
                .sum(),
            bvh: Bvh::build(&boxes),
            points,
            starts,
            sides,
            next,
            node_normals,
            corner,
        }
    }

    /// The loops, each without its first point repeated: outer ones counter-clockwise, holes clockwise.
    pub fn loops(&self) -> impl ExactSizeIterator<Item = &[[f64; 2]]> {
        self.starts.windows(2).map(|r| &self.points[r[0]..r[1]])
    }

    /// All points, loop after loop.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Outward unit normal at each point of [`Outline::points`]: the mean of the two sides' normals (Negi &
    /// Ramachandran 2021, eq. 10, which needs counter-clockwise order).
    pub fn node_normals(&self) -> &[[f64; 2]] {
        &self.node_normals
    }

    /// The outline scaled, rotated and moved.
    #[must_use]
    pub fn transformed(&self, by: &Similarity<2>) -> Self {
        Self::assemble(
            self.loops()
                .map(|one| one.iter().map(|&p| by.point(p)).collect())
                .collect(),
        )
    }

    /// The ends of side `i`.
    pub(crate) fn side(&self, i: usize) -> [[f64; 2]; 2] {
        [self.points[i], self.points[self.next[i] as usize]]
    }

    /// Which of [`Outline::points`] are corners.
    pub(crate) fn is_corner(&self) -> &[bool] {
        &self.corner
    }

    /// The sides that the ray from `p` in the direction +x may cross, and some more.
    pub(crate) fn beside(&self, p: [f64; 2], each: impl FnMut(usize)) {
        self.bvh.visit(
            |b| b.min[1] <= p[1] && p[1] <= b.max[1] && p[0] <= b.max[0],
            each,
        );
    }

    /// Loop and place within it of point `i`, and of the side that begins there.
    pub(crate) fn address(&self, i: usize) -> (usize, usize) {
        let k = self.starts.partition_point(|&start| start <= i) - 1;
        (k, i - self.starts[k])
    }
}
