//! What holds in any flow: mass, momentum, mirrors, and the same bits for any number of threads.

use rayon::ThreadPoolBuilder;
use sphpack_flow::{COURANT, Edac, EdacSettings, Medium, Particles, Standard, StandardSettings};
use sphpack_neighbors::Domain;
use sphpack_neighbors::random::SplitMix64;

const SPACING: f64 = 1.0 / 24.0;

fn medium(force: [f64; 2]) -> Medium<2> {
    Medium {
        smoothing_length: 1.2 * SPACING,
        density: 1.0,
        sound_speed: 10.0,
        force,
    }
}

/// Uneven particles at uneven speeds in a periodic unit box; with walls in its lower quarter where asked.
fn stirred(seed: u64, walls: bool) -> Particles<2> {
    let mut random = SplitMix64::new(seed);
    let mut draw = |size: f64| size * (2.0 * random.unit() - 1.0);
    let mut particles = Particles::default();
    let mut below = Vec::new();
    for j in 0..24 {
        for i in 0..24 {
            let at = [i, j].map(|n| (f64::from(n) + 0.5 + draw(0.2)) * SPACING);
            if walls && j < 6 {
                below.push(at);
            } else {
                let mass = SPACING * SPACING * (1.0 + draw(0.02));
                particles.add_fluid(at, [draw(0.3), draw(0.3)], mass, draw(0.2));
            }
        }
    }
    for at in below {
        particles.add_wall(at, SPACING * SPACING);
    }
    particles
}

fn domain() -> Domain<2> {
    Domain::new([0.0; 2], [1.0; 2]).with_periodic([true; 2])
}

fn edac(particles: Particles<2>, force: [f64; 2], steps: usize) -> Edac<2> {
    let settings = EdacSettings::new(medium(force), 0.01);
    let mut flow = Edac::new(&domain(), particles, settings);
    let step = settings.medium.time_step(COURANT, 1.0, 0.01);
    flow.run(steps, step).expect("a stable run");
    flow
}

fn standard(particles: Particles<2>, force: [f64; 2], steps: usize) -> Standard<2> {
    let settings = StandardSettings {
        medium: medium(force),
        viscosity: 0.1,
        friction: 0.0,
    };
    let mut flow = Standard::new(&domain(), particles, settings);
    let step = settings.medium.time_step(COURANT, 1.0, 0.0);
    flow.run(steps, step).expect("a stable run");
    flow
}

/// By id, for the order changes.
fn by_id<T: Copy>(particles: &Particles<2>, of: &[T]) -> Vec<T> {
    particles.by_id().iter().map(|&i| of[i]).collect()
}

#[test]
fn masses_stay_and_momentum_is_exact_to_rounding() {
    let start = stirred(1, false);
    let flow = standard(start.clone(), [0.0; 2], 300);
    let of = flow.particles();
    assert_eq!(by_id(of, &of.mass), start.mass);
    for k in 0..2 {
        let change = of.momentum()[k] - start.momentum()[k];
        assert!(change.abs() < 1e-14, "{change}");
    }
}

#[test]
fn the_mean_pressure_costs_edac_little_momentum() {
    let start = stirred(1, false);
    let flow = edac(start.clone(), [0.0; 2], 300);
    let of = flow.particles();
    assert_eq!(by_id(of, &of.mass), start.mass);
    let speeds: f64 = (start.velocity.iter().zip(&start.mass))
        .map(|(u, m)| m * u[0].hypot(u[1]))
        .sum();
    for k in 0..2 {
        let change = of.momentum()[k] - start.momentum()[k];
        // Pairs take each its own mean from the pressure, so what one gains the other does not lose.
        assert!(change.abs() < 0.02 * speeds, "{change} of {speeds}");
    }
}

#[test]
fn a_mirror_image_flows_as_the_mirror_image() {
    let start = stirred(2, true);
    let mut mirrored = start.clone();
    for x in &mut mirrored.position {
        x[0] = 1.0 - x[0];
    }
    for u in &mut mirrored.velocity {
        u[0] = -u[0];
    }
    let (force, against) = ([0.3, -0.5], [-0.3, -0.5]);
    let compare = |one: &Particles<2>, other: &Particles<2>| {
        let pairs = by_id(one, &one.velocity);
        for (a, b) in pairs.iter().zip(by_id(other, &other.velocity)) {
            let off = (a[0] + b[0]).abs().max((a[1] - b[1]).abs());
            assert!(off < 1e-10, "{a:?} {b:?}");
        }
    };
    let (one, other) = (
        edac(start.clone(), force, 25),
        edac(mirrored.clone(), against, 25),
    );
    compare(one.particles(), other.particles());
    let (one, other) = (standard(start, force, 25), standard(mirrored, against, 25));
    compare(one.particles(), other.particles());
}

#[test]
fn threads_change_no_bit() {
    let on = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| {
            let force = [0.1, -0.2];
            (
                edac(stirred(3, true), force, 220).particles().clone(),
                standard(stirred(3, true), force, 220).particles().clone(),
            )
        })
    };
    let (one, two) = (on(1), on(2));
    assert_eq!(one, two);
    assert_ne!(one.0.velocity, stirred(3, true).velocity);
}

#[test]
fn what_flies_apart_is_said() {
    let start = stirred(1, false);
    let settings = EdacSettings::new(medium([0.0; 2]), 0.01);
    let mut flow = Edac::new(&domain(), start, settings);
    let said = flow
        .run(200, 0.1)
        .expect_err("steps far too long")
        .to_string();
    assert!(said.contains("faster than sound"), "{said}");
    assert!(said.contains("smaller time step"), "{said}");
}
