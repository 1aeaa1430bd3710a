//! Flow between two plates, set off by a force along them (Poiseuille).

use std::f64::consts::PI;

use sphpack_flow::{COURANT, Edac, EdacSettings, Medium, Particles};
use sphpack_neighbors::Domain;

const ACROSS: usize = 20;
const SPACING: f64 = 1.0 / ACROSS as f64;
const VISCOSITY: f64 = 0.1;
/// The speed in the middle is 1 in the end.
const FORCE: f64 = 8.0 * VISCOSITY;

/// The speed at a height of 0 … 1, a time after the force set in.
fn exact(y: f64, time: f64) -> f64 {
    let steady = FORCE / (2.0 * VISCOSITY) * y * (1.0 - y);
    let waves = (0..30).map(|n| {
        let k = (2 * n + 1) as f64 * PI;
        4.0 * FORCE / (VISCOSITY * k.powi(3)) * (k * y).sin() * (-VISCOSITY * k * k * time).exp()
    });
    steady - waves.sum::<f64>()
}

/// A channel along x, at rest.
fn channel(slip: bool) -> Edac<2> {
    let mut particles = Particles::default();
    let at = |i: usize, j: f64| [(i as f64 + 0.5) * SPACING, (j + 0.5) * SPACING];
    for i in 0..10 {
        for j in 0..ACROSS {
            particles.add_fluid(at(i, j as f64), [0.0; 2], SPACING * SPACING, 0.0);
        }
    }
    for i in 0..10 {
        for layer in 0..4 {
            let layer = f64::from(layer);
            particles.add_wall(at(i, -1.0 - layer), SPACING * SPACING);
            particles.add_wall(at(i, ACROSS as f64 + layer), SPACING * SPACING);
        }
    }
    if slip {
        particles.slip_normal.fill([0.0, 1.0]);
    }
    let domain = Domain::new([0.0, -0.25], [10.0 * SPACING, 1.25]).with_periodic([true, false]);
    let medium = Medium {
        smoothing_length: 1.2 * SPACING,
        density: 1.0,
        sound_speed: 10.0,
        force: [FORCE, 0.0],
    };
    Edac::new(&domain, particles, EdacSettings::new(medium, VISCOSITY))
}

fn time_step() -> f64 {
    // The force is no gravity: nothing falls by it.
    COURANT * 1.2 * SPACING / 11.0
}

#[test]
fn the_profile_grows_as_the_series_says() {
    let mut flow = channel(false);
    let mut force = 0.0;
    for time in [0.5, 2.0] {
        let steps = ((time - flow.time()) / time_step()).round() as usize;
        flow.run(steps, time_step()).expect("a stable run");
        let mut off = 0.0;
        for (x, u) in (flow.particles().position.iter())
            .zip(&flow.particles().velocity)
            .take(flow.particles().fluid)
        {
            let expected = exact(x[1], flow.time());
            off += (u[0] - expected).powi(2) / flow.particles().fluid as f64;
        }
        // Root mean square over the largest speed. Most of it is slip at the walls, by 0.04 ∆s.
        let error = f64::sqrt(off) / exact(0.5, flow.time());
        assert!(error < 0.01, "{error} at {time}");
        force = (flow.rates().iter().map(|rate| rate.on_walls[1][0])).sum();
    }
    // Friction at both walls: 2 ν du/dy per length.
    let slope = exact(1e-6, flow.time()) / 1e-6;
    let expected = 2.0 * VISCOSITY * slope * 10.0 * SPACING;
    assert!((force / expected - 1.0).abs() < 0.02, "{force}, {expected}");
}

#[test]
fn fluid_slips_along_walls_without_friction() {
    let mut flow = channel(true);
    flow.run(100, time_step()).expect("a stable run");
    // Nothing holds it: all goes as fast as the force has made it.
    let expected = FORCE * flow.time();
    for u in &flow.particles().velocity[..flow.particles().fluid] {
        assert!((u[0] / expected - 1.0).abs() < 1e-3, "{u:?}, {expected}");
    }
}
