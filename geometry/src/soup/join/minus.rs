//! Meshes cut by meshes: the body to be cut and the other one turned inside out are joined.

use sphpack_neighbors::Bounds;

use super::{GROWTH, cut, grow};
use crate::soup::Soup;
use crate::soup::check::Survey;
use crate::soup::crossings::{self, Meeting};
use crate::{CutError, GeometryError, Mesh};

impl Mesh {
    /// What is left of the body where `other` has all its room; `None` where nothing is. Exact to rounding where the
    /// two meshes cross; where they touch, as where faces lie in one plane, `other` is grown by some 10⁻⁶ of the size
    /// first. O(n log n) for n triangles of both that spread out.
    ///
    /// # Errors
    /// [`CutError::NotCut`] where the result would not be a closed mesh that agrees with the winding numbers of
    /// the two.
    pub fn minus(&self, other: &Self) -> Result<Option<Self>, GeometryError> {
        let soup = |mesh: &Self| Soup::new(mesh.vertices().to_vec(), mesh.triangles().to_vec());
        let left = minus(&soup(self)?, &soup(other)?).ok_or(CutError::NotCut)?;
        if left.triangles.is_empty() {
            return Ok(None);
        }
        Self::new(left.vertices, left.triangles)
            .map(Some)
            .map_err(|_| CutError::NotCut.into())
    }
}

/// Winds around what is left once: 1 for `body` less 1 for `other`, which counts nothing outside `body`.
fn minus(body: &Soup, other: &Soup) -> Option<Soup> {
    let size = Bounds::of(&body.vertices).diagonal();
    let pieces = Survey::new(other).pieces;
    let own = body.triangles.len();
    for attempt in 0..5 {
        let both = match attempt {
            0 => with_hole(body, other),
            n => with_hole(
                body,
                &grow(other, &pieces, GROWTH * f64::from(1 << (n - 1)) * size),
            ),
        };
        let mut pairs = crossings::all(&both);
        pairs.retain(|&(i, j, _)| ((i as usize) < own) != ((j as usize) < own));
        if pairs.iter().all(|&(_, _, m)| m == Meeting::Crossing) {
            let pairs: Vec<(u32, u32)> = pairs.iter().map(|&(i, j, _)| (i, j)).collect();
            return cut(&both, &pairs, size).filter(|left| super::agrees(left, &both));
        }
    }
    None
}

/// The triangles of `body`, then those of `other` turned inside out.
fn with_hole(body: &Soup, other: &Soup) -> Soup {
    let mut both = body.clone();
    let first = body.vertices.len() as u32;
    both.vertices.extend(&other.vertices);
    both.triangles.extend(
        other
            .triangles
            .iter()
            .map(|&[a, b, c]| [c + first, b + first, a + first]),
    );
    both
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Surface;
    use crate::soup::tests::{ball, cuboid};

    type Loose = Vec<[[f64; 3]; 3]>;

    fn mesh(loose: &[[[f64; 3]; 3]]) -> Mesh {
        Mesh::from_loose(loose).unwrap()
    }

    #[track_caller]
    fn check(body: &Loose, other: &Loose, volume: f64, tolerance: f64) -> Mesh {
        let left = mesh(body).minus(&mesh(other)).unwrap().unwrap();
        let off = left.volume() - volume;
        assert!(off.abs() <= tolerance, "{} is {off:.1e} off", left.volume());
        left
    }

    #[test]
    fn boxes() {
        let unit = cuboid([0.0; 3], [1.0; 3]);
        let corner = cuboid([0.6, 0.55, 0.5], [1.6, 1.5, 1.7]);
        let left = check(&unit, &corner, 1.0 - 0.4 * 0.45 * 0.5, 1e-9);
        assert!(!left.inside([0.7, 0.6, 0.6]) && left.inside([0.5, 0.5, 0.45]));
        // Through, so that two pieces are left; and within, so that a cavity is.
        check(
            &unit,
            &cuboid([0.4, -1.0, -1.1], [0.7, 2.0, 2.1]),
            0.7,
            1e-9,
        );
        check(&unit, &cuboid([0.4; 3], [0.6; 3]), 1.0 - 0.008, 1e-9);
        check(&unit, &cuboid([2.0; 3], [3.0; 3]), 1.0, 1e-9);
        // Faces in one plane.
        check(&unit, &cuboid([0.5, 0.0, 0.0], [1.5, 1.0, 1.0]), 0.5, 2e-5);
        check(&unit, &cuboid([0.5, 0.2, 0.0], [1.0, 0.8, 0.6]), 0.82, 2e-5);
        check(&unit, &cuboid([1.0, 0.0, 0.0], [1.5, 1.0, 1.0]), 1.0, 2e-5);
        let nothing = |other: &Loose| mesh(&unit).minus(&mesh(other)).unwrap().is_none();
        assert!(nothing(&cuboid([-1.0; 3], [2.0; 3])));
        assert!(nothing(&unit));
    }

    #[test]
    fn spheres() {
        let body = ball(3, 1.0, [0.0; 3]);
        for k in 0..24 {
            let k = f64::from(k);
            let part = |a: f64| (a * (k + 1.0)) % 1.0 - 0.5;
            let place = [0.3 + part(0.819), 0.4 + part(0.671), 0.2 + part(0.55)];
            let other = ball(2 + (k as usize) % 2, 0.7 + 0.3 * part(0.33), place);
            // What both have together is known by the union.
            let both = Soup::from_loose(&[body.clone(), other.clone()].concat()).unwrap();
            let union = both.body().unwrap().mesh.volume();
            check(&body, &other, union - mesh(&other).volume(), 1e-9);
        }
    }

    #[test]
    fn spheres_at_the_same_place() {
        let body = ball(3, 1.0, [0.0; 3]);
        let whole = mesh(&body).volume();
        check(&body, &ball(3, 0.5, [0.0; 3]), 0.875 * whole, 1e-9);
        // Vertices and edges of both lie on the same planes of symmetry.
        let other = ball(3, 1.0, [0.5, 0.0, 0.0]);
        let both = Soup::from_loose(&[body.clone(), other.clone()].concat()).unwrap();
        let union = both.body().unwrap().mesh.volume();
        check(&body, &other, union - whole, 1e-4);
    }
}
