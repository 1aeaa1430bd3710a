//! Fluid between a plate that swings along itself and one at rest (Stokes' second problem).

use std::f64::consts::TAU;

use sphpack_flow::{COURANT, Edac, EdacSettings, Medium, Particles};
use sphpack_neighbors::Domain;

const ACROSS: usize = 20;
const SPACING: f64 = 1.0 / ACROSS as f64;
const VISCOSITY: f64 = 0.1;
/// ω: the swing reaches √(2ν/ω) = 1/3 into the fluid, seven spacings.
const FREQUENCY: f64 = 18.0 * VISCOSITY;

/// Re (e^{iωt} sinh(λ(1 − y))/sinh λ), λ = (1 + i) √(ω/2ν).
fn exact(y: f64, time: f64) -> f64 {
    let k = (0.5 * FREQUENCY / VISCOSITY).sqrt();
    // sinh(a + ia), its real and its imaginary part.
    let sinh = |a: f64| [a.sinh() * a.cos(), a.cosh() * a.sin()];
    let [a, b] = sinh(k * (1.0 - y));
    let [c, d] = sinh(k);
    let quotient = [(a * c + b * d), (b * c - a * d)].map(|part| part / (c * c + d * d));
    let (sine, cosine) = (FREQUENCY * time).sin_cos();
    quotient[0] * cosine - quotient[1] * sine
}

#[test]
fn the_swing_reaches_into_the_fluid_as_the_theory_says() {
    let mut particles = Particles::default();
    let at = |i: usize, j: f64| [(i as f64 + 0.5) * SPACING, (j + 0.5) * SPACING];
    for i in 0..10 {
        for j in 0..ACROSS {
            let at = at(i, j as f64);
            particles.add_fluid(at, [exact(at[1], 0.0), 0.0], SPACING * SPACING, 0.0);
        }
    }
    let first = particles.len();
    for layer in 0..4 {
        for i in 0..10 {
            particles.add_wall(at(i, -1.0 - f64::from(layer)), SPACING * SPACING);
        }
    }
    let swings = particles.len();
    for layer in 0..4 {
        for i in 0..10 {
            let y = ACROSS as f64 + f64::from(layer);
            particles.add_wall(at(i, y), SPACING * SPACING);
        }
    }
    let domain = Domain::new([0.0, -0.25], [10.0 * SPACING, 1.25]).with_periodic([true, false]);
    let medium = Medium {
        smoothing_length: 1.2 * SPACING,
        density: 1.0,
        sound_speed: 10.0,
        force: [0.0; 2],
    };
    let mut flow = Edac::new(&domain, particles, EdacSettings::new(medium, VISCOSITY));
    let step = medium.time_step(COURANT, 1.0, VISCOSITY);
    let per_look = (TAU / FREQUENCY / 8.0 / step).round() as usize;
    for _ in 0..10 {
        for _ in 0..per_look {
            // What the plate has at the middle of the step, where the rates are evaluated.
            let (sine, cosine) = (FREQUENCY * (flow.time() + 0.5 * step)).sin_cos();
            let of = flow.particles_mut();
            of.velocity[first..swings].fill([cosine, 0.0]);
            of.wall_acceleration[..swings - first].fill([-FREQUENCY * sine, 0.0]);
            flow.run(1, step).expect("a stable run");
        }
        let of = flow.particles();
        let off: f64 = (of.position.iter().zip(&of.velocity).take(of.fluid))
            .map(|(x, u)| (u[0] - exact(x[1], flow.time())).powi(2) + u[1] * u[1])
            .sum();
        // Root mean square over the plate's largest speed.
        let error = f64::sqrt(off / of.fluid as f64);
        assert!(error < 0.01, "{error} at {}", flow.time());
    }
}
