//! What the fluid does on a body's true surface.

use std::f64::consts::TAU;

use sphpack_flow::Edac;
use sphpack_kernels::{Kernel, Quintic};
use sphpack_neighbors::point;

use super::run::Run;

/// Waves around the body that the flow has; those that are shorter are the particles'.
const LONG_WAVES: usize = 10;

/// Points of a surface, and sums over the times that it was looked at.
pub(super) struct Surface<'a> {
    points: &'a [[f64; 2]],
    kernel: Quintic<2>,
    looks: usize,
    /// Mean squares over the points, summed over the looks: of the speed, and of what of speed and pressure is short.
    slip: f64,
    slip_rough: f64,
    pressure_rough: f64,
}

impl<'a> Surface<'a> {
    /// Of a body around which points follow one another evenly.
    pub(super) fn new(points: &'a [[f64; 2]], smoothing_length: f64) -> Self {
        Self {
            points,
            kernel: Quintic::new(smoothing_length),
            looks: 0,
            slip: 0.0,
            slip_rough: 0.0,
            pressure_rough: 0.0,
        }
    }

    /// Takes velocity and pressure as fluid and walls have them, the walls' as viscosity and pressure see them: without slip the
    /// velocity vanishes.
    pub(super) fn look(&mut self, flow: &Edac<2>) {
        let particles = flow.particles();
        let [mut low, mut high] = [self.points[0]; 2];
        for &at in self.points {
            for k in 0..2 {
                low[k] = f64::min(low[k], at[k]);
                high[k] = f64::max(high[k], at[k]);
            }
        }
        let reach = self.kernel.support();
        let is_near =
            |at: &[f64; 2]| (0..2).all(|k| (low[k] - reach..=high[k] + reach).contains(&at[k]));
        let near: Vec<usize> = (0..particles.len())
            .filter(|&i| is_near(&particles.position[i]))
            .collect();
        let of_one = |&at: &[f64; 2]| {
            let (mut weight, mut velocity, mut pressure) = (0.0, [0.0; 2], 0.0);
            for &i in &near {
                let r = point::norm(point::sub(at, particles.position[i]));
                if r >= reach {
                    continue;
                }
                let w = flow.volume()[i] * self.kernel.value(r);
                let u = match i.checked_sub(particles.fluid) {
                    Some(wall) => flow.dummy_velocity()[wall],
                    None => particles.velocity[i],
                };
                weight += w;
                velocity = point::add_scaled(velocity, w, u);
                pressure += w * particles.pressure[i];
            }
            (point::norm(velocity) / weight, pressure / weight)
        };
        let (speed, pressure): (Vec<f64>, Vec<f64>) = self.points.iter().map(of_one).unzip();
        self.slip += mean_square(&speed);
        self.slip_rough += mean_square(&without_long_waves(&speed));
        self.pressure_rough += mean_square(&without_long_waves(&pressure));
        self.looks += 1;
    }

    /// `slip`, `slip-rough`, and `pressure-rough` over ½ρU², of a stream and a density of 1.
    pub(super) fn tell(&self, out: &mut Run) {
        let rms = |sum: f64| (sum / self.looks as f64).sqrt();
        out.set("slip", rms(self.slip));
        out.set("slip-rough", rms(self.slip_rough));
        out.set("pressure-rough", 2.0 * rms(self.pressure_rough));
    }
}

fn mean_square(of: &[f64]) -> f64 {
    of.iter().map(|x| x * x).sum::<f64>() / of.len() as f64
}

/// What is left of values around a body without their mean and their longest waves.
fn without_long_waves(of: &[f64]) -> Vec<f64> {
    let count = of.len() as f64;
    let mut left = of.to_vec();
    for wave in 0..=LONG_WAVES {
        let angle = |k: usize| TAU * (wave * k) as f64 / count;
        let (mut cosine, mut sine) = (0.0, 0.0);
        for (k, value) in of.iter().enumerate() {
            cosine += value * angle(k).cos();
            sine += value * angle(k).sin();
        }
        let scale = if wave == 0 { 1.0 } else { 2.0 } / count;
        for (k, left) in left.iter_mut().enumerate() {
            *left -= scale * (cosine * angle(k).cos() + sine * angle(k).sin());
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_waves_are_taken_away_and_short_ones_stay() {
        let wave = |n: f64, shift: f64| move |k: usize| (n * TAU * k as f64 / 90.0 + shift).sin();
        let of: Vec<f64> = (0..90)
            .map(|k| 2.0 + wave(1.0, 0.3)(k) + wave(10.0, 1.0)(k) + 0.5 * wave(11.0, 0.1)(k))
            .collect();
        for (k, left) in without_long_waves(&of).into_iter().enumerate() {
            assert!((left - 0.5 * wave(11.0, 0.1)(k)).abs() < 1e-12);
        }
    }
}
