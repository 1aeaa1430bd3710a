//! Any triangles wrapped into a closed mesh.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, point};

use super::{HoleLimit, Mended, Repair, Soup};
use crate::level_set::{Field, LevelSet};
use crate::{FastWinding, GeometryError, MeshError};

/// Where the winding number is within this of ½, a hole may be near: there it varies smoothly from 0 to 1, while away
/// from holes it jumps at the triangles.
const OPEN: f64 = 0.45;

/// What triangles wind around by more than ½, either way.
#[derive(Debug)]
struct Wound {
    winding: FastWinding,
    /// Half the distance over which the winding number's slope is taken.
    step: f64,
}

impl Wound {
    fn winding(&self, p: [f64; 3]) -> f64 {
        self.winding.at(p).abs()
    }
}

impl Field<3> for Wound {
    /// The distance to the triangles, or, in a hole, to the place where the winding number will be ½ by its value and
    /// slope, whichever is less.
    fn at(&self, p: [f64; 3]) -> (f64, [f64; 3]) {
        let winding = self.winding(p);
        let sign = if winding > 0.5 { -1.0 } else { 1.0 };
        let (distance, away) = match self.winding.nearest(p) {
            Some((q, normal)) => {
                let away = point::sub(p, q);
                let out = point::unit(away).map(|n| point::scale(n, sign));
                (point::norm(away), out.unwrap_or(normal))
            }
            None => (f64::MAX, [1.0, 0.0, 0.0]),
        };
        let missing = 0.5 - winding;
        if missing.abs() < OPEN {
            let fall: [f64; 3] = std::array::from_fn(|k| {
                let [mut before, mut after] = [p; 2];
                before[k] -= self.step;
                after[k] += self.step;
                (self.winding(before) - self.winding(after)) / (2.0 * self.step)
            });
            let steepness = point::norm(fall);
            if missing.abs() < distance * steepness {
                return (missing / steepness, point::scale(fall, 1.0 / steepness));
            }
        }
        (sign * distance, away)
    }
}

impl Soup {
    /// A closed mesh around what the triangles, whatever is wrong with them, wind around by more than ½: where they are
    /// closed that is their inside, holes are closed by the smooth sheet on which the winding number is ½, shells that
    /// overlap become one, and inner walls are left out (after Jacobson, Kavan, Sorkine-Hornung, ACM TOG 32, 2013).
    /// `cell` (scene units) is the size of the grid's cells on which that is done: the mesh follows the triangles within
    /// a fraction of a cell, rounds edges within a cell where shells or holes meet, and loses parts and gaps thinner
    /// than a cell. A [`Soup::repaired`] soup is wrapped, so that triangles agree where they can.
    ///
    /// ```
    /// use sphpack_geometry::{Soup, Surface};
    ///
    /// // A tetrahedron that lacks its largest side.
    /// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let sides = [[0, 2, 1], [0, 1, 3], [0, 3, 2]].map(|side| side.map(|k: usize| corners[k]));
    /// let closed = Soup::from_loose(&sides)?.wrapped(0.05)?;
    /// assert!(closed.mesh.inside([0.1; 3]) && !closed.mesh.inside([0.5; 3]));
    /// # Ok::<(), sphpack_geometry::GeometryError>(())
    /// ```
    ///
    /// Costs a winding number and a nearest triangle, O(log n), for each node near the surface, and memory as
    /// [`LevelSet`] says.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless `cell` is positive, finite, and large enough for the grid;
    /// [`MeshError::NothingInside`] where no node is wound around.
    pub fn wrapped(&self, cell: f64) -> Result<Mended, GeometryError> {
        let Self {
            vertices,
            triangles,
            ..
        } = self.repaired(HoleLimit::Small).soup;
        let corners: Vec<[[f64; 3]; 3]> = triangles
            .iter()
            .map(|t| t.map(|v| vertices[v as usize]))
            .collect();
        let bounds = Bounds::of(corners.as_flattened());
        if corners.is_empty() {
            return Err(MeshError::NothingInside { cell }.into());
        }
        let wound = Arc::new(Wound {
            winding: FastWinding::new(corners),
            step: 0.5 * cell,
        });
        let near = |p| {
            let nearest = wound.winding.nearest(p);
            nearest.map_or(f64::INFINITY, |(q, _)| point::distance(p, q))
        };
        let mesh = LevelSet::of_field(wound.clone(), cell, &bounds, near)?
            .mesh()?
            .ok_or(MeshError::NothingInside { cell })?;
        let done = vec![Repair::Wrapped {
            cell,
            triangles: self.triangles.len(),
        }];
        Ok(Mended { mesh, done })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::Surface;
    use crate::soup::tests::{ball, cuboid};

    type Loose = Vec<[[f64; 3]; 3]>;

    /// Wraps, checks that the mesh is clean, and compares its volume.
    #[track_caller]
    fn check(name: &str, loose: &Loose, cell: f64, volume: f64, tolerance: f64) {
        let mesh = Soup::from_loose(loose).unwrap().wrapped(cell).unwrap().mesh;
        let soup = Soup::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).unwrap();
        let report = soup.check();
        assert!(report.is_clean(), "{name}: {:?}", report.defects);
        let off = mesh.volume() / volume - 1.0;
        eprintln!(
            "{name}: volume {:+.3} %, {} triangles, {} shells",
            100.0 * off,
            mesh.triangles().len(),
            report.shells.len()
        );
        assert!(off.abs() < tolerance, "{name}: {off}");
    }

    fn without(loose: &Loose, is_out: impl Fn(usize, &[[f64; 3]; 3]) -> bool) -> Loose {
        let kept = loose.iter().enumerate().filter(|&(i, t)| !is_out(i, t));
        kept.map(|(_, t)| *t).collect()
    }

    const BALL: f64 = PI / 6.0;

    #[test]
    fn spheres_with_holes() {
        let whole = ball(4, 0.5, [0.0; 3]);
        check("whole", &whole, 0.04, BALL, 0.01);
        let capless = without(&whole, |_, t| t.iter().all(|p| p[2] > 0.45));
        check("without a cap", &capless, 0.04, BALL, 0.03);
        check("without a cap, fine", &capless, 0.02, BALL, 0.03);
        // One of ten, without a pattern.
        let sparse = without(&whole, |i, _| (0.618_034 * i as f64) % 1.0 < 0.1);
        assert!((4600..4620).contains(&sparse.len()), "{}", sparse.len());
        check("nine of ten", &sparse, 0.04, BALL, 0.03);
        // All facing inward.
        let turned = capless.iter().map(|&[a, b, c]| [a, c, b]).collect();
        check("inside out", &turned, 0.04, BALL, 0.03);
    }

    #[test]
    fn open_shells_that_cross() {
        let half = |x: f64, up: f64| {
            without(&ball(4, 0.5, [x, 0.0, 0.0]), |_, t| {
                t.iter().all(|p| up * p[2] > 0.45)
            })
        };
        let both = [half(0.0, 1.0), half(0.5, -1.0)].concat();
        let lens = PI * (2.0 + 0.5) * (0.5_f64).powi(2) / 12.0;
        check("two that cross", &both, 0.04, 2.0 * BALL - lens, 0.03);
    }

    #[test]
    fn boxes_without_a_side_and_along_an_edge() {
        let open = cuboid([0.0; 3], [1.0; 3])[..10].to_vec();
        // The sheet over an open side bulges inward: there half the directions lead out.
        check("open box", &open, 0.05, 1.0, 0.25);
        let pinched = [
            cuboid([0.0; 3], [1.0; 3]),
            cuboid([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]),
        ]
        .concat();
        check("two boxes at an edge", &pinched, 0.05, 2.0, 0.02);
    }

    #[test]
    fn what_encloses_nothing() {
        let sheet = vec![[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]];
        let soup = Soup::from_loose(&sheet).unwrap();
        let error = soup.wrapped(0.1).unwrap_err();
        assert!(
            matches!(error, GeometryError::Mesh(MeshError::NothingInside { .. })),
            "{error}"
        );
        let none = Soup::from_loose(&[]).unwrap();
        assert!(none.wrapped(0.1).is_err());
        for cell in [0.0, f64::NAN, 1e-9] {
            let soup = Soup::from_loose(&ball(1, 1.0, [0.0; 3])).unwrap();
            assert!(soup.wrapped(cell).unwrap_err().to_string().contains("cell"));
        }
    }
}
