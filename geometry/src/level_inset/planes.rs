//! A handful of planes and the nearest point behind all of them.

use sphpack_neighbors::point;

/// The half space `normal · x ≤ offset`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane<const D: usize> {
    pub(super) normal: [f64; D],
    pub(super) offset: f64,
}

/// Normals with `1 − cos²` below this are one.
const SAME: f64 = 1e-10;

/// At most `D` planes, oldest first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Planes<const D: usize> {
    planes: [Plane<D>; D],
    count: usize,
}

impl<const D: usize> Default for Planes<D> {
    fn default() -> Self {
        Self {
            planes: [Plane {
                normal: [0.0; D],
                offset: 0.0,
            }; D],
            count: 0,
        }
    }
}

impl<const D: usize> Planes<D> {
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Whether a plane with this normal is among them.
    pub(super) fn holds(&self, normal: [f64; D]) -> bool {
        self.planes[..self.count]
            .iter()
            .any(|p| same(p.normal, normal))
    }

    /// Adds a plane. It takes the place of one with the same normal, else, where there are `D`, of a similar one
    /// (a newer tangent of the same side), else of the oldest.
    pub(super) fn add(&mut self, plane: Plane<D>) {
        let similar = |p: &Plane<D>, limit: f64| point::dot(p.normal, plane.normal) > limit;
        let full = self.count == D;
        let slot = (0..self.count)
            .find(|&k| same(self.planes[k].normal, plane.normal))
            .or_else(|| (0..self.count).find(|&k| full && similar(&self.planes[k], 0.9)))
            .or(full.then_some(0));
        if let Some(k) = slot {
            self.remove(k);
        }
        self.planes[self.count] = plane;
        self.count += 1;
    }

    fn remove(&mut self, k: usize) {
        self.planes[k..self.count].rotate_left(1);
        self.count -= 1;
    }

    /// The nearest point to `p` behind all planes, dropping those that do not hold it back: p − Σ λ_k n_k with
    /// λ ≥ 0, where the Gram matrix times λ is how far p is beyond each.
    pub(super) fn project(&mut self, p: [f64; D]) -> [f64; D] {
        while self.count > 0 {
            let Some(lambda) = self.multipliers(p) else {
                self.remove(0);
                continue;
            };
            let worst = (0..self.count)
                .filter(|&k| lambda[k] < 0.0)
                .min_by(|&i, &j| lambda[i].total_cmp(&lambda[j]));
            match worst {
                // The newest plane stays: it is where the last point failed.
                Some(k) if self.count > 1 => {
                    self.remove(if k + 1 == self.count { 0 } else { k });
                }
                _ => {
                    let mut x = p;
                    for k in 0..self.count {
                        x = point::add_scaled(x, -lambda[k], self.planes[k].normal);
                    }
                    return x;
                }
            }
        }
        p
    }

    /// The nearest point to `p` on all planes at once; `p` itself where they are nearly parallel.
    pub(super) fn project_on_all(&self, p: [f64; D]) -> [f64; D] {
        let lambda = self.multipliers(p).unwrap_or([0.0; D]);
        let mut x = p;
        for k in 0..self.count {
            x = point::add_scaled(x, -lambda[k], self.planes[k].normal);
        }
        x
    }

    /// λ of [`Planes::project`] by Gaussian elimination; `None` where planes are nearly parallel.
    fn multipliers(&self, p: [f64; D]) -> Option<[f64; D]> {
        let n = self.count;
        let mut rows = [[0.0; D]; D];
        let mut right = [0.0; D];
        for i in 0..n {
            for j in 0..n {
                rows[i][j] = point::dot(self.planes[i].normal, self.planes[j].normal);
            }
            right[i] = point::dot(self.planes[i].normal, p) - self.planes[i].offset;
        }
        for i in 0..n {
            // The matrix is symmetric and positive: no exchange of rows is needed.
            if rows[i][i] < SAME {
                return None;
            }
            for j in i + 1..n {
                let factor = rows[j][i] / rows[i][i];
                for k in i..n {
                    rows[j][k] -= factor * rows[i][k];
                }
                right[j] -= factor * right[i];
            }
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                right[i] -= rows[i][k] * right[k];
            }
            right[i] /= rows[i][i];
        }
        Some(right)
    }

    /// Keeps the planes that pass within `tolerance` of `x`.
    pub(super) fn keep_touching(&mut self, x: [f64; D], tolerance: f64) {
        for k in (0..self.count).rev() {
            let plane = self.planes[k];
            if (point::dot(plane.normal, x) - plane.offset).abs() > tolerance {
                self.remove(k);
            }
        }
    }

    /// Unit vector along the sum of the normals.
    pub(super) fn mean_normal(&self) -> [f64; D] {
        let mut sum = [0.0; D];
        for plane in &self.planes[..self.count] {
            sum = point::add(sum, plane.normal);
        }
        point::unit(sum).unwrap_or(self.planes[0].normal)
    }

    /// How many of the normals differ from every earlier counted one by more than the angle with this cosine.
    pub(super) fn count_different(&self, cosine: f64) -> usize {
        let mut counted = [[0.0; D]; D];
        let mut count = 0;
        for plane in &self.planes[..self.count] {
            if counted[..count]
                .iter()
                .all(|&c| point::dot(c, plane.normal) < cosine)
            {
                counted[count] = plane.normal;
                count += 1;
            }
        }
        count
    }
}

fn same<const D: usize>(a: [f64; D], b: [f64; D]) -> bool {
    let cos = point::dot(a, b);
    cos > 0.0 && 1.0 - cos * cos < SAME
}
