//! Where a body stands, and how it is turned.

use std::f64::consts::TAU;

use crate::scene_fuzz::random::Random;

/// Axes of its own, orthonormal, and where they begin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    axes: [[f64; 3]; 3],
    origin: [f64; 3],
}

impl Frame {
    /// As the box stands.
    pub(super) fn upright() -> Self {
        Self {
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            origin: [0.0; 3],
        }
    }

    /// Turned by any angle, in the plane about z; moved by up to 1.
    pub(super) fn random(random: &mut Random, dimension: usize) -> Self {
        let angle = random.between(0.0, TAU);
        Self::turned(random, dimension, angle)
    }

    /// Turned by an angle, in the plane about z, in space about any axis; moved by up to 1.
    pub(super) fn turned(random: &mut Random, dimension: usize, angle: f64) -> Self {
        let mut about = [0.0, 0.0, 1.0];
        if dimension == 3 {
            let (high, around) = (random.between(-1.0, 1.0), random.between(0.0, TAU));
            let flat = (1.0_f64 - high * high).sqrt();
            about = [flat * around.cos(), flat * around.sin(), high];
        }
        let origin = std::array::from_fn(|k| {
            if k < dimension {
                random.between(-1.0, 1.0)
            } else {
                0.0
            }
        });
        let (sin, cos) = angle.sin_cos();
        // Rodrigues' formula, for each axis.
        let turn = |v: [f64; 3]| {
            let along: f64 = (0..3).map(|k| about[k] * v[k]).sum();
            let across = [
                about[1] * v[2] - about[2] * v[1],
                about[2] * v[0] - about[0] * v[2],
                about[0] * v[1] - about[1] * v[0],
            ];
            std::array::from_fn(|k| v[k] * cos + across[k] * sin + about[k] * along * (1.0 - cos))
        };
        Self {
            axes: Self::upright().axes.map(turn),
            origin,
        }
    }

    /// From the body's own coordinates.
    pub(super) fn place(&self, own: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| {
            self.origin[k] + (0..3).map(|a| own[a] * self.axes[a][k]).sum::<f64>()
        })
    }

    /// To the body's own coordinates.
    pub(super) fn own(&self, place: [f64; 3]) -> [f64; 3] {
        let from: [f64; 3] = std::array::from_fn(|k| place[k] - self.origin[k]);
        self.axes
            .map(|axis| (0..3).map(|k| from[k] * axis[k]).sum())
    }
}

/// How far a place is from a block about the origin with these half edges; below zero inside, by how deep.
pub(super) fn outside_block(half: [f64; 3], p: [f64; 3], dimension: usize) -> f64 {
    let off: [f64; 3] = std::array::from_fn(|k| p[k].abs() - half[k]);
    let out: f64 = (off[..dimension].iter())
        .map(|o| o.max(0.0).powi(2))
        .sum::<f64>()
        .sqrt();
    let deepest = off[..dimension].iter().copied().fold(f64::MIN, f64::max);
    if deepest > 0.0 { out } else { deepest }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let mut random = Random::new(3, 5);
        for dimension in [2, 3] {
            let frame = Frame::random(&mut random, dimension);
            let own = [0.3, -0.7, if dimension == 2 { 0.0 } else { 1.1 }];
            let place = frame.place(own);
            let back = frame.own(place);
            for k in 0..3 {
                assert!((back[k] - own[k]).abs() < 1e-12, "{back:?}");
            }
            // A turn keeps lengths.
            let other = frame.place([0.3, 0.2, own[2]]);
            let apart: f64 = (0..3).map(|k| (place[k] - other[k]).powi(2)).sum();
            assert!((apart.sqrt() - 0.9).abs() < 1e-12);
        }
    }

    #[test]
    fn distances_from_a_block() {
        let half = [1.0, 2.0, 3.0];
        assert_eq!(outside_block(half, [0.5, 0.0, 0.0], 3), -0.5);
        assert_eq!(outside_block(half, [4.0, 6.0, 9.0], 2), 5.0);
        assert_eq!(outside_block(half, [0.0, -2.5, 0.0], 3), 0.5);
    }
}
