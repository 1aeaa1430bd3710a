//! A round patch of fluid that a straining motion draws out to an ellipse, its whole surface free.

use sphpack_flow::{COURANT, Medium, Particles, Standard, StandardSettings};
use sphpack_neighbors::Domain;

/// The semi-axis a of the ellipse at a time, 1 at the start, by ȧ = A a, Ȧ = A² (b² − a²)/(a² + b²), ab = 1.
fn exact(time: f64) -> f64 {
    let steps = 10_000;
    let dt = time / f64::from(steps);
    let rates = |[a, rate]: [f64; 2]| {
        let (a2, b2) = (a * a, 1.0 / (a * a));
        [rate * a, rate * rate * (b2 - a2) / (a2 + b2)]
    };
    let mut state = [1.0, 1.0];
    for _ in 0..steps {
        let half = rates(state);
        let middle = [state[0] + 0.5 * dt * half[0], state[1] + 0.5 * dt * half[1]];
        let full = rates(middle);
        state = [state[0] + dt * full[0], state[1] + dt * full[1]];
    }
    state[0]
}

#[test]
fn a_drop_becomes_the_ellipse_of_the_theory() {
    // Rings of particles, all of one size: no lattice that the strain could line up.
    let rings = 25;
    let spacing = 1.0 / (f64::from(rings) + 0.5);
    let medium = Medium {
        smoothing_length: 1.2 * spacing,
        density: 1.0,
        sound_speed: 10.0,
        force: [0.0; 2],
    };
    let mut particles = Particles::default();
    let volume = std::f64::consts::PI * spacing * spacing;
    let mut add = |x: f64, y: f64, volume: f64| {
        let pressure = 0.5 * (1.0 - x * x - y * y);
        let mass = volume * medium.density_at(pressure);
        particles.add_fluid([x, y], [x, -y], mass, pressure);
    };
    add(0.0, 0.0, 0.25 * volume);
    for ring in 1..=rings {
        let (radius, count) = (f64::from(ring) * spacing, 6 * ring);
        let share = volume * (2.0 * f64::from(ring)) / f64::from(count);
        for k in 0..count {
            let angle =
                std::f64::consts::TAU * (f64::from(k) + 0.37 * f64::from(ring)) / f64::from(count);
            add(radius * angle.cos(), radius * angle.sin(), share);
        }
    }
    let domain = Domain::new([-4.0; 2], [4.0; 2]);
    let settings = StandardSettings {
        medium,
        viscosity: 0.01,
        friction: 0.0,
    };
    let mut flow = Standard::new(&domain, particles, settings);
    let before = flow.particles().momentum();
    let steps = (1.0 / medium.time_step(COURANT, 1.0, 0.0)).ceil() as usize;
    flow.run(steps, 1.0 / steps as f64).expect("a stable run");
    let of = flow.particles();
    let mass: f64 = of.mass.iter().sum();
    let semi_axis = |k: usize| {
        let spread = of
            .position
            .iter()
            .zip(&of.mass)
            .map(|(x, m)| m * x[k] * x[k]);
        2.0 * (spread.sum::<f64>() / mass).sqrt()
    };
    let a = exact(1.0);
    // A clipped lattice of twice as many per radius has ten per cent.
    assert!(
        (semi_axis(0) / a - 1.0).abs() < 0.02,
        "{} {a}",
        semi_axis(0)
    );
    assert!(
        (semi_axis(1) * a - 1.0).abs() < 0.02,
        "{} {a}",
        semi_axis(1)
    );
    let after = of.momentum();
    for k in 0..2 {
        assert!((after[k] - before[k]).abs() < 1e-13, "{before:?} {after:?}");
    }
}
