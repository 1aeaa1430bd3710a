//! The Eulerian scheme: against plain sums over all pairs, and what it conserves.

use sphpack_flow::{Eulerian, EulerianSettings, Fringe, Medium, Particles};
use sphpack_kernels::{Kernel, Quintic};
use sphpack_neighbors::Domain;
use sphpack_neighbors::point::{add, add_scaled, dot, norm, of_slice, scale, sub};
use sphpack_neighbors::random::SplitMix64;

use super::all_pairs::pairs;

const SPACING: f64 = 0.1;
const H: f64 = 1.2 * SPACING;
const SOUND_SPEED: f64 = 8.0;
const VISCOSITY: f64 = 0.03;
const DENSITY: f64 = 1.3;
const DAMPING: f64 = 0.07;
const STEP: f64 = 1e-3;

fn settings<const D: usize>() -> EulerianSettings<D> {
    let medium = Medium {
        smoothing_length: H,
        density: DENSITY,
        sound_speed: SOUND_SPEED,
        force: of_slice(&[0.2, -0.9, 0.4]),
    };
    EulerianSettings {
        damping: DAMPING,
        ..EulerianSettings::new(medium, VISCOSITY)
    }
}

/// Shaken fluid, in a periodic box; of the lowest layers, as many as asked, a wall. Every second of its particles has a normal.
fn scene<const D: usize>(wide: usize, layers: usize) -> (Domain<D>, Particles<D>, Vec<[f64; D]>) {
    let mut random = SplitMix64::new(8);
    let mut draw = |size: f64| size * (2.0 * random.unit() - 1.0);
    let mut particles = Particles::default();
    let mut walls = Vec::new();
    for place in 0..wide.pow(D as u32) {
        let lattice: [usize; D] = std::array::from_fn(|k| place / wide.pow(k as u32) % wide);
        let at = lattice.map(|n| (n as f64 + 0.5 + draw(0.2)) * SPACING);
        if lattice[1] < layers {
            walls.push(at);
        } else {
            let mass = DENSITY * SPACING.powi(D as i32) * (1.0 + draw(0.05));
            let velocity = std::array::from_fn(|_| draw(0.5));
            particles.add_fluid(at, velocity, mass, draw(1.0));
        }
    }
    for at in walls {
        particles.add_wall(at, DENSITY * SPACING.powi(D as i32));
    }
    let fluid = particles.fluid;
    particles.velocity[fluid..].fill(of_slice(&[0.3, 0.1, -0.2]));
    let normals = (fluid..particles.len())
        .map(|w| match w % 2 {
            0 => of_slice(&[0.0, 1.0, 0.0]),
            _ => [0.0; D],
        })
        .collect();
    let size = wide as f64 * SPACING;
    let domain = Domain::new([0.0; D], [size; D]).with_periodic([true; D]);
    (domain, particles, normals)
}

/// By elimination.
fn inverse<const D: usize>(mut of: [[f64; D]; D]) -> [[f64; D]; D] {
    let mut out = [[0.0; D]; D];
    for k in 0..D {
        out[k][k] = 1.0;
    }
    for k in 0..D {
        let pivot = of[k][k];
        for c in 0..D {
            of[k][c] /= pivot;
            out[k][c] /= pivot;
        }
        for row in (0..D).filter(|&row| row != k) {
            let factor = of[row][k];
            for c in 0..D {
                of[row][c] -= factor * of[k][c];
                out[row][c] -= factor * out[k][c];
            }
        }
    }
    out
}

fn times<const D: usize>(matrix: &[[f64; D]; D], vector: [f64; D]) -> [f64; D] {
    std::array::from_fn(|row| dot(matrix[row], vector))
}

/// What is between two: p*, u*, ρ*.
fn between<const D: usize>(
    e: [f64; D],
    velocity: [[f64; D]; 2],
    pressure: [f64; 2],
    density: [f64; 2],
) -> (f64, [f64; D], f64) {
    let closing = -dot(e, sub(velocity[0], velocity[1]));
    let limiter = (15.0 * closing.max(0.0) / SOUND_SPEED).min(1.0);
    let impedance = DENSITY * SOUND_SPEED;
    let p = 0.5 * (pressure[0] + pressure[1] + impedance * closing * limiter);
    let slower = 0.5 * (pressure[0] - pressure[1]) * (limiter * limiter).max(DAMPING) / impedance;
    let mean = scale(add(velocity[0], velocity[1]), 0.5);
    (
        p,
        add_scaled(mean, -slower, e),
        0.5 * (density[0] + density[1]),
    )
}

fn agrees<K: Kernel<D>, const D: usize>(kernel: K, wide: usize) {
    let (domain, plain, normals) = scene::<D>(wide, 4);
    let settings = settings::<D>();
    let mut flow = Eulerian::new(&domain, plain.clone(), normals.clone(), settings);
    let fluid = plain.fluid;
    let volume: Vec<f64> = plain.mass.iter().map(|m| m / DENSITY).collect();
    let c2 = SOUND_SPEED * SOUND_SPEED;
    let density: Vec<f64> = plain.pressure.iter().map(|p| DENSITY + p / c2).collect();
    let mut moments = vec![[[0.0; D]; D]; plain.len()];
    pairs(kernel, &domain, &plain, |i, j, apart, _, gradient| {
        for row in 0..D {
            for column in 0..D {
                moments[i][row][column] -= volume[j] * apart[row] * gradient[column];
            }
        }
    });
    let corrections: Vec<[[f64; D]; D]> = moments.into_iter().map(inverse).collect();
    // Everything that goes from j to i, per V_i: the flux of mass, and of momentum by pressure and by friction.
    let flux = |of: &Particles<D>, i: usize, j: usize, apart: [f64; D], gradient: [f64; D]| {
        let r = norm(apart);
        if r == 0.0 {
            return (0.0, [0.0; D], [0.0; D]);
        }
        let mut e = scale(apart, 1.0 / r);
        let (mut velocity, mut pressure, mut own) = (of.velocity[j], of.pressure[j], density[j]);
        let mut corrected = times(&corrections[i], gradient);
        let mut viscosity = 2.0 * DENSITY * VISCOSITY;
        let apart_by = sub(of.velocity[i], velocity);
        if j < fluid {
            corrected = scale(add(corrected, times(&corrections[j], gradient)), 0.5);
        } else {
            velocity = sub(scale(velocity, 2.0), of.velocity[i]);
            (pressure, own) = (of.pressure[i], density[i]);
            viscosity *= 2.0;
            if normals[j - fluid] != [0.0; D] {
                e = normals[j - fluid];
            }
        }
        let (p, u, rho) = between(
            e,
            [of.velocity[i], velocity],
            [of.pressure[i], pressure],
            [density[i], own],
        );
        let through = -2.0 * volume[j] * rho * dot(u, corrected);
        let pushed = add_scaled(scale(u, through), -2.0 * volume[j] * p, corrected);
        let slope = volume[j] * viscosity * kernel.slope(r) / (r + 0.01 * H);
        (through, pushed, scale(apart_by, slope))
    };
    let mut rate = vec![[0.0; D]; fluid];
    let mut on_walls = vec![[[0.0; D]; 2]; fluid];
    pairs(kernel, &domain, &plain, |i, j, apart, _, gradient| {
        if i < fluid {
            let (_, pushed, rubbed) = flux(&plain, i, j, apart, gradient);
            rate[i] = add(rate[i], add(pushed, rubbed));
            if j >= fluid {
                on_walls[i][0] = add_scaled(on_walls[i][0], -volume[i], pushed);
                on_walls[i][1] = add_scaled(on_walls[i][1], -volume[i], rubbed);
            }
        }
    });
    let mut after = plain.clone();
    let mut momentum = vec![[0.0; D]; fluid];
    for i in 0..fluid {
        let mass = density[i] * volume[i];
        let pushed = add_scaled(scale(plain.velocity[i], mass), STEP * volume[i], rate[i]);
        momentum[i] = add_scaled(pushed, STEP * mass, settings.medium.force);
        after.velocity[i] = scale(momentum[i], 1.0 / mass);
    }
    let mut new = density.clone();
    pairs(kernel, &domain, &plain, |i, j, apart, _, gradient| {
        if i < fluid {
            new[i] += STEP * flux(&after, i, j, apart, gradient).0;
        }
    });
    flow.run(1, STEP).expect("a stable step");
    let mut felt = 0.0_f64;
    for i in 0..fluid {
        let close = |found: f64, expected: f64, size: f64| {
            assert!(
                (found - expected).abs() < 1e-11 * size,
                "{found} {expected}"
            );
        };
        let mass = DENSITY * volume[i];
        close(flow.particles().density[i], new[i], 1.0);
        for k in 0..D {
            close(flow.momentum()[i][k], momentum[i][k], mass);
            for part in 0..2 {
                let found = flow.on_walls()[i][part][k];
                close(found, on_walls[i][part][k], volume[i] * 100.0);
                felt = felt.max(found.abs());
            }
        }
    }
    assert!(felt > 0.0, "walls are felt");
}

#[test]
fn a_step_is_what_all_pairs_say() {
    agrees::<_, 2>(Quintic::<2>::new(H), 16);
    agrees::<_, 3>(Quintic::<3>::new(H), 9);
}

#[test]
fn mass_and_momentum_are_kept_to_rounding() {
    let (domain, particles, normals) = scene::<2>(16, 0);
    let mut settings = settings::<2>();
    settings.medium.force = [0.0; 2];
    let mut flow = Eulerian::new(&domain, particles, normals, settings);
    let mass = |flow: &Eulerian<2>| flow.particles().mass.iter().sum::<f64>();
    let momentum = |flow: &Eulerian<2>| flow.momentum().iter().fold([0.0; 2], |a, &b| add(a, b));
    let before = (mass(&flow), momentum(&flow));
    let step = settings.medium.time_step(0.25, 1.0, VISCOSITY);
    flow.run(200, step).expect("a stable run");
    assert!((mass(&flow) / before.0 - 1.0).abs() < 1e-13);
    let off = sub(momentum(&flow), before.1);
    assert!(norm(off) < 1e-13 * before.0, "{off:?}");
}

#[test]
fn a_stream_through_a_lattice_stays_uniform() {
    let mut particles = Particles::default();
    for i in 0..20 {
        for j in 0..10 {
            let at = [i, j].map(|n| (f64::from(n) + 0.5) * SPACING);
            particles.add_fluid(at, [1.0, 0.0], DENSITY * SPACING * SPACING, 0.0);
        }
    }
    let domain = Domain::new([0.0; 2], [2.0, 1.0]).with_periodic([true; 2]);
    let mut settings = settings::<2>();
    settings.medium.force = [0.0; 2];
    settings.fringe = Some(Fringe {
        from: 1.2,
        to: 2.0,
        strength: 10.0,
        velocity: [1.0, 0.0],
    });
    let mut flow = Eulerian::new(&domain, particles, Vec::new(), settings);
    let step = settings.medium.time_step(0.25, 1.0, VISCOSITY);
    flow.run(200, step).expect("a stable run");
    for (u, p) in (flow.particles().velocity.iter()).zip(&flow.particles().pressure) {
        assert!(norm(sub(*u, [1.0, 0.0])) < 1e-12 && p.abs() < 1e-10);
    }
}

#[test]
fn fluid_at_rest_stays_at_rest_between_walls() {
    let (domain, mut particles, normals) = scene::<2>(16, 4);
    particles.velocity.fill([0.0; 2]);
    particles.pressure.fill(0.0);
    let mut settings = settings::<2>();
    settings.medium.force = [0.0; 2];
    let mut flow = Eulerian::new(&domain, particles, normals, settings);
    flow.run(50, 1e-3).expect("a stable run");
    assert_eq!(flow.particles().fastest(), 0.0);
}

#[test]
fn threads_change_no_bit_of_it() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool").install(|| {
            let (domain, particles, normals) = scene::<2>(70, 4);
            let mut flow = Eulerian::new(&domain, particles, normals, settings());
            flow.run(5, 1e-3).expect("a stable run");
            flow.particles().clone()
        })
    };
    assert!(run(1) == run(3));
}
