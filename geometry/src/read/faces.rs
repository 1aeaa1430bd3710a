//! Polygons of mesh files, cut into triangles.

use sphpack_neighbors::point;

use super::lines::whole;
use crate::GeometryError;
use crate::mesh::triangle::area_vector;
use crate::soup::{MOST_POINTS, least_area};

/// The faces of a part of a file. A polygon is a fan about its first corner until all vertices are known.
#[derive(Debug, Default)]
pub(super) struct Faces {
    triangles: Vec<[u32; 3]>,
    /// Where fans of two triangles or more begin, and how many they have.
    fans: Vec<(usize, usize)>,
}

impl Faces {
    /// Adds a polygon; nothing where it has fewer than three corners.
    pub(super) fn add(&mut self, corners: &[u32]) {
        let Some(&first) = corners.first() else {
            return;
        };
        let start = self.triangles.len();
        let pairs = corners.windows(2).skip(1);
        self.triangles
            .extend(pairs.map(|pair| [first, pair[0], pair[1]]));
        let count = self.triangles.len() - start;
        if count > 1 {
            self.fans.push((start, count));
        }
    }

    /// The triangles as they are so far.
    pub(super) fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The triangles, each its three corners. Fans that fold, since their polygon has reflex corners, are replaced by the
    /// triangles of least area.
    ///
    /// # Errors
    /// [`ReadError::BadFile`](crate::ReadError::BadFile) where a polygon with reflex corners has too many of them.
    pub(super) fn loose(
        mut self,
        vertices: &[[f64; 3]],
    ) -> Result<Vec<[[f64; 3]; 3]>, GeometryError> {
        for (start, count) in std::mem::take(&mut self.fans) {
            let fan = &mut self.triangles[start..start + count];
            let place = |v: u32| vertices[v as usize];
            if !folds(fan, place) {
                continue;
            }
            let corners: Vec<u32> = [fan[0][0], fan[0][1]]
                .into_iter()
                .chain(fan.iter().map(|t| t[2]))
                .collect();
            if corners.len() > MOST_POINTS {
                return Err(whole(format!(
                    "a face of {} corners bends inward; cut faces into triangles where you export the body",
                    corners.len()
                )));
            }
            let points: Vec<[f64; 3]> = corners.iter().map(|&v| place(v)).collect();
            let Some(triangles) = least_area(&points, |_, _| false) else {
                continue;
            };
            for (old, new) in fan.iter_mut().zip(triangles) {
                *old = new.map(|k| corners[k]);
            }
        }
        Ok(self
            .triangles
            .iter()
            .map(|t| t.map(|v| vertices[v as usize]))
            .collect())
    }
}

/// Whether a triangle of the fan faces the other way than all of them together.
fn folds(fan: &[[u32; 3]], place: impl Fn(u32) -> [f64; 3]) -> bool {
    let areas = fan.iter().map(|t| area_vector(&t.map(&place)));
    let whole = areas.clone().fold([0.0; 3], point::add);
    let least = -1e-12 * point::norm_squared(whole);
    areas
        .into_iter()
        .any(|area| point::dot(area, whole) < least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::triangle::area;

    /// An L in the plane z = 0, of area 3, begun at each of its corners.
    #[test]
    fn reflex_corners() {
        let corners = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
        ];
        let vertices = corners.map(|[x, y]| [x, y, 0.0]);
        for begin in 0..6 {
            let mut faces = Faces::default();
            let polygon: Vec<u32> = (0..6).map(|k| (begin + k) % 6).collect();
            faces.add(&polygon);
            faces.add(&polygon[..2]);
            faces.add(&[]);
            let triangles = faces.loose(&vertices).unwrap();
            assert_eq!(triangles.len(), 4);
            let sum: f64 = triangles.iter().map(area).sum();
            assert!((sum - 3.0).abs() < 1e-12, "{sum}");
            assert!(triangles.iter().all(|t| area_vector(t)[2] >= 0.0));
        }
    }

    #[test]
    fn too_many_reflex_corners() {
        let n = 400;
        let star: Vec<[f64; 3]> = (0..n)
            .map(|k| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
                let radius = if k % 2 == 0 { 1.0 } else { 0.1 };
                [radius * cos, radius * sin, 0.0]
            })
            .collect();
        let mut faces = Faces::default();
        faces.add(&(0..n as u32).collect::<Vec<u32>>());
        let message = faces.loose(&star).unwrap_err().to_string();
        assert!(message.contains("400 corners") && message.contains("triangles"));
    }
}
