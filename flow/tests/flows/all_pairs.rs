//! Both schemes against plain sums over all pairs, walls that slip and move among them, in the plane and in space.

use sphpack_flow::{Edac, EdacSettings, Medium, Particles, Standard, StandardSettings};
use sphpack_kernels::{Kernel, Quintic};
use sphpack_neighbors::Domain;
use sphpack_neighbors::point::{add_scaled, dot, norm, of_slice, scale, sub};
use sphpack_neighbors::random::SplitMix64;

const SPACING: f64 = 0.1;
const H: f64 = 1.2 * SPACING;
const EPSILON: f64 = 0.01 * H * H;
const SOUND_SPEED: f64 = 8.0;
const VISCOSITY: f64 = 0.03;
const STEP: f64 = 1e-3;

fn medium<const D: usize>() -> Medium<D> {
    Medium {
        smoothing_length: H,
        density: 1.3,
        sound_speed: SOUND_SPEED,
        force: of_slice(&[0.2, -0.9, 0.4]),
    }
}

/// Fluid on a wall of four layers, all shaken; half of the wall lets it slip, all of it moves.
fn scene<const D: usize>(wide: usize) -> (Domain<D>, Particles<D>) {
    let mut random = SplitMix64::new(5);
    let mut draw = |size: f64| size * (2.0 * random.unit() - 1.0);
    let mut particles = Particles::default();
    let mut walls = Vec::new();
    for place in 0..wide.pow(D as u32) {
        let lattice: [usize; D] = std::array::from_fn(|k| place / wide.pow(k as u32) % wide);
        let at = lattice.map(|n| (n as f64 + 0.5 + draw(0.2)) * SPACING);
        if lattice[1] < 4 {
            walls.push(at);
        } else {
            let mass = 1.3 * SPACING.powi(D as i32) * (1.0 + draw(0.05));
            let velocity = std::array::from_fn(|_| draw(0.5));
            particles.add_fluid(at, velocity, mass, draw(1.0));
        }
    }
    for at in walls {
        particles.add_wall(at, 1.3 * SPACING.powi(D as i32));
    }
    let fluid = particles.fluid;
    for w in 0..particles.len() - fluid {
        particles.velocity[fluid + w] = of_slice(&[0.3, -0.1, 0.2]);
        particles.wall_acceleration[w] = of_slice(&[1.0, 0.5, -0.7]);
        if w % 2 == 0 {
            particles.slip_normal[w] = of_slice(&[0.0, 1.0, 0.0]);
        }
    }
    let size = wide as f64 * SPACING;
    let periodic = std::array::from_fn(|k| k != 1);
    let domain = Domain::new([0.0; D], [size; D]).with_periodic(periodic);
    (domain, particles)
}

/// Sums over all pairs, a particle with itself too: `add` gets both numbers, r_ij, W, and ∇W.
pub(super) fn pairs<K: Kernel<D>, const D: usize>(
    w: K,
    domain: &Domain<D>,
    of: &Particles<D>,
    mut add: impl FnMut(usize, usize, [f64; D], f64, [f64; D]),
) {
    for i in 0..of.len() {
        for j in 0..of.len() {
            let apart = domain.difference(of.position[i], of.position[j]);
            let r = norm(apart);
            if r < w.support() {
                add(i, j, apart, w.value(r), w.gradient(apart));
            }
        }
    }
}

/// Pressures and viscous velocities of walls, by the densities at hand.
fn walls<K: Kernel<D>, const D: usize>(
    w: K,
    domain: &Domain<D>,
    of: &mut Particles<D>,
) -> Vec<[f64; D]> {
    let fluid = of.fluid;
    let count = of.len();
    let (mut shepard, mut pressure, mut theirs) =
        (vec![0.0; count], vec![0.0; count], vec![[0.0; D]; count]);
    pairs(w, domain, of, |i, j, apart, w, _| {
        if i >= fluid && j < fluid {
            let inertia = sub(medium::<D>().force, of.wall_acceleration[i - fluid]);
            shepard[i] += w;
            pressure[i] += (of.pressure[j] + of.density[j] * dot(inertia, apart)) * w;
            theirs[i] = add_scaled(theirs[i], w, of.velocity[j]);
        }
    });
    let mut dummy = of.velocity.clone();
    for i in fluid..count {
        of.pressure[i] = 0.0;
        if shepard[i] > 0.0 {
            of.pressure[i] = pressure[i] / shepard[i];
            let theirs = scale(theirs[i], 1.0 / shepard[i]);
            let (own, n) = (of.velocity[i], of.slip_normal[i - fluid]);
            dummy[i] = if n == [0.0; D] {
                sub(scale(own, 2.0), theirs)
            } else {
                add_scaled(theirs, -2.0 * dot(sub(theirs, own), n), n)
            };
        }
    }
    dummy
}

/// du/dt, dp/dt, ã of the fluid, and its forces on walls.
type EdacRates<const D: usize> = (Vec<[f64; D]>, Vec<f64>, Vec<[f64; D]>, Vec<[[f64; D]; 2]>);

/// EDAC's rates; densities become those of the volumes, as the scheme has them in its next evaluation.
fn edac_rates<K: Kernel<D>, const D: usize>(
    w: K,
    domain: &Domain<D>,
    of: &mut Particles<D>,
    transport: &[[f64; D]],
) -> EdacRates<D> {
    let fluid = of.fluid;
    let count = of.len();
    let dummy = walls(w, domain, of);
    let (mut sigma, mut sum, mut near) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    pairs(w, domain, of, |i, j, _, w, _| {
        sigma[i] += w;
        sum[i] += of.pressure[j];
        near[i] += 1.0;
    });
    for i in 0..fluid {
        of.density[i] = of.mass[i] * sigma[i];
    }
    let (c2, nu_e) = (SOUND_SPEED * SOUND_SPEED, 0.5 * H * SOUND_SPEED / 8.0);
    let mut rates: EdacRates<D> = (
        vec![medium().force; fluid],
        vec![0.0; fluid],
        vec![[0.0; D]; fluid],
        vec![[[0.0; D]; 2]; fluid],
    );
    pairs(w, domain, of, |i, j, apart, _, gradient| {
        if i >= fluid {
            return;
        }
        let (rho_i, rho_j, p_i, p_j) =
            (of.density[i], of.density[j], of.pressure[i], of.pressure[j]);
        let both = sigma[i].powi(-2) + sigma[j].powi(-2);
        let per_mass = both / of.mass[i];
        let mean = sum[i] / near[i];
        let between = (rho_j * (p_i - mean) + rho_i * (p_j - mean)) / (rho_i + rho_j);
        let whole = (rho_j * p_i + rho_i * p_j) / (rho_i + rho_j);
        let over = dot(apart, gradient) / (dot(apart, apart) + EPSILON);
        let harmonic = |nu: f64| 2.0 * nu * rho_i * rho_j / (rho_i + rho_j);
        let apart_u = sub(of.velocity[i], dummy[j]);
        let friction = harmonic(VISCOSITY) * over;
        let a = &mut rates.0[i];
        *a = add_scaled(*a, -per_mass * between, gradient);
        *a = add_scaled(*a, per_mass * friction, apart_u);
        if j < fluid {
            for k in [i, j] {
                let flux = dot(sub(transport[k], of.velocity[k]), gradient) * of.density[k];
                *a = add_scaled(*a, 0.5 * per_mass * flux, of.velocity[k]);
            }
        } else {
            let [thrust, drag] = &mut rates.3[i];
            *thrust = add_scaled(*thrust, both * whole, gradient);
            *drag = add_scaled(*drag, -both * friction, apart_u);
        }
        rates.1[i] += rho_i * c2 / sigma[j] * dot(sub(of.velocity[i], of.velocity[j]), gradient)
            + per_mass * harmonic(nu_e) * over * (p_i - p_j);
        rates.2[i] = add_scaled(rates.2[i], -1.3 * c2 * per_mass, gradient);
    });
    rates
}

#[track_caller]
fn check(name: &str, found: f64, expected: f64, size: f64) {
    assert!(
        (found - expected).abs() <= 1e-11 * size,
        "{name}: {found}, by all pairs {expected} (of {size})"
    );
}

fn size<const D: usize>(vectors: &[[f64; D]]) -> f64 {
    vectors.iter().map(|&v| norm(v)).fold(1e-3, f64::max)
}

fn edac_agrees<K: Kernel<D>, const D: usize>(w: K, wide: usize) {
    let (domain, mut plain) = scene::<D>(wide);
    let settings = EdacSettings::new(medium(), VISCOSITY);
    let mut flow = Edac::new(&domain, plain.clone(), settings);
    plain.density.fill(1.3);
    let mut transport = plain.velocity[..plain.fluid].to_vec();
    let mut rates = edac_rates(w, &domain, &mut plain, &transport);
    for step in 0..2 {
        // The order of the scheme's particles has changed after the first.
        let places = flow.particles().by_id();
        let sizes = [size(&rates.0), size(&rates.2)];
        let forces = rates
            .3
            .iter()
            .flatten()
            .map(|&f| norm(f))
            .fold(0.0, f64::max);
        let most = rates.1.iter().fold(0.0, |most: f64, p| most.max(p.abs()));
        assert!(forces > 0.0 && most > 0.0, "walls are felt");
        for i in 0..plain.fluid {
            let at = places[i];
            for k in 0..D {
                check(
                    "du/dt",
                    flow.rates()[at].acceleration[k],
                    rates.0[i][k],
                    sizes[0],
                );
                check("ã", flow.rates()[at].transport[k], rates.2[i][k], sizes[1]);
                for part in 0..2 {
                    let found = flow.rates()[at].on_walls[part][k];
                    check("force", found, rates.3[i][part][k], forces);
                }
            }
            check("dp/dt", flow.rates()[at].pressure, rates.1[i], most);
        }
        if step == 0 {
            flow.run(1, STEP).expect("a stable step");
            for i in 0..plain.fluid {
                plain.velocity[i] = add_scaled(plain.velocity[i], 0.5 * STEP, rates.0[i]);
                transport[i] = add_scaled(plain.velocity[i], 0.5 * STEP, rates.2[i]);
                plain.position[i] = add_scaled(plain.position[i], 0.5 * STEP, transport[i]);
                plain.pressure[i] += 0.5 * STEP * rates.1[i];
            }
            rates = edac_rates(w, &domain, &mut plain, &transport);
        }
    }
}

#[test]
fn edac_is_what_all_pairs_say() {
    edac_agrees::<_, 2>(Quintic::<2>::new(H), 16);
    edac_agrees::<_, 3>(Quintic::<3>::new(H), 9);
}

fn standard_agrees<K: Kernel<D>, const D: usize>(w: K, wide: usize) {
    let (domain, mut plain) = scene::<D>(wide);
    let settings = StandardSettings {
        medium: medium(),
        viscosity: 0.1,
        friction: 0.3,
    };
    let flow = Standard::new(&domain, plain.clone(), settings);
    let (fluid, c2) = (plain.fluid, SOUND_SPEED * SOUND_SPEED);
    let density = |p: f64| 1.3 * (1.0 + 7.0 * p / (1.3 * c2)).powf(1.0 / 7.0);
    for i in 0..fluid {
        plain.density[i] = density(plain.pressure[i]);
    }
    walls(w, &domain, &mut plain);
    for i in fluid..plain.len() {
        plain.pressure[i] = plain.pressure[i].max(0.0);
        plain.density[i] = density(plain.pressure[i]);
    }
    let of = &plain;
    let (mut acceleration, mut rate) = (vec![medium::<D>().force; fluid], vec![0.0; fluid]);
    let mut force = vec![[0.0; D]; fluid];
    pairs(w, &domain, of, |i, j, apart, _, gradient| {
        if i >= fluid {
            return;
        }
        let between = sub(of.velocity[i], of.velocity[j]);
        let volume = of.mass[j] / of.density[j];
        let mut pressure = of.pressure[i] + of.pressure[j];
        if j < fluid {
            let closing = dot(between, apart) / (dot(apart, apart) + EPSILON);
            pressure -= 0.1 * SOUND_SPEED * H * 1.3 * closing;
        } else {
            let own = of.mass[i] / of.density[i];
            force[i] = add_scaled(force[i], own * volume * pressure, gradient);
        }
        rate[i] += of.density[i] * volume * dot(between, gradient);
        let push = -volume * pressure / of.density[i];
        acceleration[i] = add_scaled(acceleration[i], push, gradient);
    });
    let most = rate.iter().fold(0.0, |most: f64, p| most.max(p.abs()));
    for i in 0..fluid {
        let expected = add_scaled(acceleration[i], -0.3, of.velocity[i]);
        for k in 0..D {
            check(
                "du/dt",
                flow.rates()[i].acceleration[k],
                expected[k],
                size(&acceleration),
            );
            check(
                "force",
                flow.rates()[i].on_walls[k],
                force[i][k],
                size(&force),
            );
        }
        check("dρ/dt", flow.rates()[i].density, rate[i], most);
    }
}

#[test]
fn standard_is_what_all_pairs_say() {
    standard_agrees::<_, 2>(Quintic::<2>::new(H), 16);
    standard_agrees::<_, 3>(Quintic::<3>::new(H), 9);
}
