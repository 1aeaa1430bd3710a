//! What is uniform stays so: rest, and a free stream.

use sphpack_flow::{
    COURANT, Edac, EdacSettings, Fringe, Medium, Particles, Standard, StandardSettings,
};
use sphpack_neighbors::Domain;
use sphpack_neighbors::random::SplitMix64;

const SPACING: f64 = 0.05;

fn medium(force: [f64; 2]) -> Medium<2> {
    Medium {
        smoothing_length: 1.2 * SPACING,
        density: 1.0,
        sound_speed: 10.0,
        force,
    }
}

/// A box of 40 × 20 particles, shaken by a part of ∆s, with a square of 6 × 6 wall particles in its middle where asked.
fn stream(velocity: f64, shaken: f64, walls: bool) -> Particles<2> {
    let mut random = SplitMix64::new(3);
    let mut particles = Particles::default();
    let is_wall = |i: usize, j: usize| walls && (17..23).contains(&i) && (7..13).contains(&j);
    let mut solid = Vec::new();
    for i in 0..40 {
        for j in 0..20 {
            let at =
                [i, j].map(|n| (n as f64 + 0.5 + shaken * (2.0 * random.unit() - 1.0)) * SPACING);
            if is_wall(i, j) {
                solid.push(at);
            } else {
                particles.add_fluid(at, [velocity, 0.0], SPACING * SPACING, 0.0);
            }
        }
    }
    for at in solid {
        particles.add_wall(at, SPACING * SPACING);
    }
    particles
}

fn domain() -> Domain<2> {
    Domain::new([0.0; 2], [2.0, 1.0]).with_periodic([true; 2])
}

#[test]
fn fluid_at_rest_beside_a_body_stays_at_rest() {
    // Particles lie unevenly and are pushed about by the transport velocity: the fluid does not feel it.
    let settings = EdacSettings::new(medium([0.0; 2]), 0.01);
    let mut flow = Edac::new(&domain(), stream(0.0, 0.2, true), settings);
    let step = settings.medium.time_step(COURANT, 1.0, 0.01);
    let before = flow.particles().clone();
    flow.run(50, step).expect("a stable run");
    assert_eq!(flow.particles().fastest(), 0.0);
    let places = flow.particles().by_id();
    let moved = (places.iter().zip(&before.position))
        .map(|(&i, x)| domain().difference(flow.particles().position[i], *x))
        .map(|d| d[0].hypot(d[1]))
        .fold(0.0, f64::max);
    assert!(moved > 0.1 * SPACING, "the particles spread by {moved}");
}

#[test]
fn a_uniform_stream_stays_uniform_through_the_fringe() {
    let mut settings = EdacSettings::new(medium([0.0; 2]), 0.01);
    settings.fringe = Some(Fringe {
        from: 1.5,
        to: 2.0,
        strength: 10.0,
        velocity: [1.0, 0.0],
    });
    let mut flow = Edac::new(&domain(), stream(1.0, 0.0, false), settings);
    let step = settings.medium.time_step(COURANT, 1.0, 0.01);
    flow.run(300, step).expect("a stable run");
    for (u, p) in (flow.particles().velocity.iter()).zip(&flow.particles().pressure) {
        assert!((u[0] - 1.0).abs() < 1e-12 && u[1].abs() < 1e-12, "{u:?}");
        assert!(p.abs() < 1e-10, "{p}");
    }
}

#[test]
fn the_fringe_makes_a_disturbed_stream_uniform() {
    let fringe = Fringe {
        from: 1.0,
        to: 2.0,
        strength: 20.0,
        velocity: [1.0, 0.0],
    };
    let off = |fringe| {
        let mut settings = EdacSettings::new(medium([0.0; 2]), 1e-3);
        settings.fringe = fringe;
        let mut particles = stream(1.0, 0.0, false);
        for (x, u) in particles.position.iter().zip(&mut particles.velocity) {
            if x[0] < 1.0 {
                u[1] = 0.2 * (std::f64::consts::TAU * x[1]).sin();
            }
        }
        let mut flow = Edac::new(&domain(), particles, settings);
        let step = settings.medium.time_step(COURANT, 1.2, 1e-3);
        // The disturbance passes the strip once.
        flow.run((2.0 / step) as usize, step).expect("a stable run");
        (flow.particles().velocity.iter())
            .map(|u| (u[0] - 1.0).abs().max(u[1].abs()))
            .fold(0.0, f64::max)
    };
    let (with, without) = (off(Some(fringe)), off(None));
    assert!(
        with < 5e-3 && without > 0.05,
        "{with} with, {without} without"
    );
}

#[test]
fn a_tank_at_rest_stands() {
    // A column on a floor between two walls, pressure and density as its weight asks for.
    let medium = medium([0.0, -1.0]);
    let (wide, high) = (16, 20);
    let mut particles = Particles::default();
    let at = |i: i32, j: i32| {
        [
            (f64::from(i) + 0.5) * SPACING,
            (f64::from(j) + 0.5) * SPACING,
        ]
    };
    for i in 0..wide {
        for j in 0..high {
            let at = at(i, j);
            let pressure = f64::from(high) * SPACING - at[1];
            let mass = medium.density_at(pressure) * SPACING * SPACING;
            particles.add_fluid(at, [0.0; 2], mass, pressure);
        }
    }
    for i in -4..wide + 4 {
        for j in -4..high {
            if j < 0 || i < 0 || i >= wide {
                particles.add_wall(at(i, j), SPACING * SPACING);
            }
        }
    }
    let domain = Domain::new([-0.2; 2], [1.0, 1.5]);
    let settings = StandardSettings {
        medium,
        viscosity: 0.02,
        friction: 0.0,
    };
    let mut flow = Standard::new(&domain, particles, settings);
    let weight: f64 = (flow.particles().mass[..flow.particles().fluid].iter()).sum();
    let step = medium.time_step(COURANT, 1.0, 0.0);
    let mut floor = 0.0;
    let steps = (2.0 / step) as usize;
    for _ in 0..steps {
        flow.run(1, step).expect("a stable run");
        floor += (flow.rates().iter())
            .map(|rate| rate.on_walls[1])
            .sum::<f64>()
            / steps as f64;
    }
    // It creeps into place by a few thousandths of √(gH), and no further: with the wrong sign of the walls' pressure it falls through.
    let energy = flow.particles().kinetic_energy() / weight;
    assert!(energy < 2e-3, "{energy}");
    assert!((floor / -weight - 1.0).abs() < 0.02, "{floor}, {weight}");
    let lowest = (flow.particles().position[..flow.particles().fluid].iter())
        .map(|x| x[1])
        .fold(f64::INFINITY, f64::min);
    assert!(lowest > 0.2 * SPACING, "{lowest}");
}
