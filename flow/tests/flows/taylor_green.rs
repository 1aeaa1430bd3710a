//! The Taylor–Green vortices, which decay and keep their shape.

use std::f64::consts::{PI, TAU};

use sphpack_flow::{COURANT, Edac, EdacSettings, Medium, Particles};
use sphpack_neighbors::Domain;
use sphpack_neighbors::random::SplitMix64;

const REYNOLDS: f64 = 100.0;
const SOUND_SPEED: f64 = 10.0;

/// Velocity and pressure at a time, in the unit box.
fn exact([x, y]: [f64; 2], time: f64) -> ([f64; 2], f64) {
    let decay = (-8.0 * PI * PI / REYNOLDS * time).exp();
    let (x2, y2) = (TAU * x, TAU * y);
    let velocity = [-decay * x2.cos() * y2.sin(), decay * x2.sin() * y2.cos()];
    let pressure = -0.25 * decay * decay * ((2.0 * x2).cos() + (2.0 * y2).cos());
    (velocity, pressure)
}

/// A square lattice of `count`² particles, shaken by up to 0.2 ∆s, with the vortices carried by a wind.
fn vortices(count: usize, wind: [f64; 2]) -> Edac<2> {
    let spacing = 1.0 / count as f64;
    let mut random = SplitMix64::new(1);
    let mut particles = Particles::default();
    for i in 0..count * count {
        let at = [i % count, i / count]
            .map(|n| (n as f64 + 0.5 + 0.2 * (2.0 * random.unit() - 1.0)) * spacing);
        let (u, p) = exact(at, 0.0);
        particles.add_fluid(at, [u[0] + wind[0], u[1] + wind[1]], spacing * spacing, p);
    }
    let domain = Domain::new([0.0; 2], [1.0; 2]).with_periodic([true; 2]);
    let medium = Medium {
        smoothing_length: 1.2 * spacing,
        density: 1.0,
        sound_speed: SOUND_SPEED,
        force: [0.0; 2],
    };
    Edac::new(
        &domain,
        particles,
        EdacSettings::new(medium, 1.0 / REYNOLDS),
    )
}

/// The error of speeds, Σ |‖u‖ − ‖u_e‖|/Σ ‖u_e‖, mean over t = 0.1, 0.2, … up to `end`.
fn error(count: usize, wind: [f64; 2], end: f64) -> f64 {
    let mut flow = vortices(count, wind);
    let medium = Medium {
        smoothing_length: 1.2 / count as f64,
        density: 1.0,
        sound_speed: SOUND_SPEED,
        force: [0.0; 2],
    };
    let looks = (10.0 * end).round() as usize;
    let steps = (0.1 / medium.time_step(COURANT, 1.0, 1.0 / REYNOLDS)).ceil() as usize;
    let mut sum = 0.0;
    for _ in 0..looks {
        flow.run(steps, 0.1 / steps as f64).expect("a stable run");
        let (mut off, mut all) = (0.0, 0.0);
        for (x, u) in flow
            .particles()
            .position
            .iter()
            .zip(&flow.particles().velocity)
        {
            let at = [x[0] - wind[0] * flow.time(), x[1] - wind[1] * flow.time()];
            let (expected, _) = exact(at, flow.time());
            let expected = expected[0].hypot(expected[1]);
            off += ((u[0] - wind[0]).hypot(u[1] - wind[1]) - expected).abs();
            all += expected;
        }
        sum += off / all;
    }
    sum / looks as f64
}

#[test]
fn vortices_of_25_particles_are_right_to_2_5_per_cent() {
    let error = error(25, [0.0; 2], 2.5);
    assert!(error <= 0.025, "{error}");
}

#[test]
fn vortices_of_50_particles_are_right_to_1_5_per_cent() {
    let error = error(50, [0.0; 2], 2.5);
    assert!(error <= 0.015, "{error}");
}

#[test]
fn a_wind_changes_the_error_by_0_2_per_cent_at_most() {
    let [still, carried] = [[0.0; 2], [1.0, 0.0]].map(|wind| error(25, wind, 1.0));
    assert!((still - carried).abs() <= 2e-3, "{still} and {carried}");
}
