//! Particles of many sizes, against sums over all pairs.

use proptest::prelude::*;
use sphpack_geometry::Surface;
use sphpack_kernels::{Kernel, KernelKind, Quintic};
use sphpack_neighbors::random::SplitMix64;
use sphpack_neighbors::{Domain, point};
use sphpack_pairs::Repulsion;

use crate::forces::Forces;
use crate::minimise::{Energy, Potential};
use crate::quality::Fields;
use crate::{Kind, PackingError, Particles, Problem, Resolution, Sizes, Spacing, SpacingField};

/// Scattered particles whose spacings differ by up to `ratio`.
fn scattered<const D: usize>(count: usize, ratio: f64, seed: u64) -> Particles<D> {
    let mut random = SplitMix64::new(seed);
    let mut particles = Particles::new(Sizes::uniform(1.0, 1.2));
    let mut spacings = Vec::new();
    for i in 0..count {
        let place = std::array::from_fn(|_| 4.0 * random.unit());
        let spacing = 0.1 * ratio.powf(random.unit());
        let kind = if i % 5 == 0 { Kind::Frozen } else { Kind::Free };
        particles.push(place, kind, spacing.powi(D as i32), None);
        spacings.push(spacing);
    }
    particles.sizes = Sizes::each(&spacings, 1.2);
    particles
}

/// Γ, ∇Γ and repulsion.
type Sums<const D: usize> = (f64, [f64; D], [f64; D]);

/// The sums of every particle, and the energy of the targets.
fn by_all_pairs<const D: usize>(
    particles: &Particles<D>,
    domain: &Domain<D>,
    repulsion: Repulsion,
) -> (Vec<Sums<D>>, f64) {
    let sizes = &particles.sizes;
    let mut energy = 0.0;
    let sums = (0..particles.len())
        .map(|i| {
            let kernel = Quintic::<D>::new(sizes.smoothing_length(i));
            let (mut gamma, mut gradient, mut push) = (0.0, [0.0; D], [0.0; D]);
            let is_target = particles.kind[i] != Kind::Frozen;
            for j in 0..particles.len() {
                let apart = domain.difference(particles.position[i], particles.position[j]);
                let r = point::norm(apart);
                let (value, slope) = kernel.value_and_slope(r);
                let volume = particles.volume[j];
                gamma += volume * value;
                let others = particles.kind[j] == Kind::Frozen;
                if is_target {
                    energy += if others { 1.0 } else { 0.5 } * volume * value;
                }
                if i == j {
                    continue;
                }
                gradient = point::add_scaled(gradient, volume * slope / r, apart);
                let mean = 0.5 * (sizes.over_finest(i) + sizes.over_finest(j));
                push = point::add_scaled(push, repulsion.force(r / mean) / mean / r, apart);
                if is_target {
                    energy += if others { 1.0 } else { 0.5 } * repulsion.potential(r / mean);
                }
            }
            (gamma, gradient, push)
        })
        .collect();
    (sums, energy)
}

fn agree<const D: usize>(
    count: usize,
    ratio: f64,
    periodic: bool,
    seed: u64,
) -> Result<(), TestCaseError> {
    let domain = Domain::new([0.0; D], [4.0; D]).with_periodic([periodic; D]);
    let mut particles = scattered::<D>(count, ratio, seed);
    let finest = particles.sizes.finest();
    let repulsion = Repulsion::new(finest, 0.005);
    let h = particles.sizes.smallest_smoothing_length();
    let mut forces = Forces::new(&domain, KernelKind::Quintic, h, 0.3 * finest, repulsion);
    // The list holds while particles move a little, and is built anew when they move far.
    for moved in [0.0, 0.03, 0.5] {
        for i in 0..particles.len() {
            let s = particles.sizes.spacing(i);
            let p = point::add_scaled(particles.position[i], moved * s, [1.0; D]);
            particles.position[i] = if periodic { domain.wrap(p) } else { p };
        }
        forces.evaluate(&particles);
        let (sums, energy) = by_all_pairs(&particles, &domain, repulsion);
        for (i, (gamma, gradient, push)) in sums.into_iter().enumerate() {
            if particles.kind[i] == Kind::Frozen {
                prop_assert_eq!(forces.gamma(i), 0.0);
                continue;
            }
            prop_assert!((forces.gamma(i) - gamma).abs() < 1e-12 * gamma.max(1.0));
            let off = point::distance(forces.gradient(i), gradient);
            prop_assert!(off < 1e-11 / finest * gamma.max(1.0), "{off}");
            let pushed = point::add(forces.acceleration(i), forces.gradient(i));
            let scale = 1.0 + point::norm(push) + gamma / finest;
            prop_assert!(point::distance(pushed, push) < 1e-11 * scale);
        }
        prop_assert!((forces.energy() - energy).abs() < 1e-11 * energy);
    }
    Ok(())
}

// Ratios end where a coarse particle would see another's second image, which the plain sums leave out.
proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn sums_in_the_plane(ratio in 1.0..5.0_f64, periodic in any::<bool>(), seed in any::<u64>()) {
        agree::<2>(180, ratio, periodic, seed)?;
    }

    #[test]
    fn sums_in_space(ratio in 1.0..4.0_f64, periodic in any::<bool>(), seed in any::<u64>()) {
        agree::<3>(180, ratio, periodic, seed)?;
    }
}

/// One size that is given to each is that of all.
#[test]
fn equal_sizes_are_one() {
    let domain = Domain::new([0.0; 3], [4.0; 3]);
    let mut particles = scattered::<3>(400, 1.0, 3);
    let evaluate = |particles: &Particles<3>| {
        let repulsion = Repulsion::new(0.1, 0.005);
        let mut forces = Forces::new(&domain, KernelKind::Quintic, 0.12, 0.03, repulsion);
        forces.evaluate(particles);
        forces
    };
    let each = evaluate(&particles);
    particles.sizes = Sizes::uniform(0.1, 1.2);
    let all = evaluate(&particles);
    assert!((each.energy() - all.energy()).abs() < 1e-12 * all.energy());
    for i in 0..particles.len() {
        assert!((each.gamma(i) - all.gamma(i)).abs() < 1e-13);
        let off = point::distance(each.acceleration(i), all.acceleration(i));
        assert!(off < 1e-11, "{off}");
    }
}

/// A set may have one size first and many later.
#[test]
fn an_evaluator_follows_its_particles() {
    let domain = Domain::new([0.0; 2], [4.0; 2]);
    let mut particles = scattered::<2>(200, 3.0, 11);
    let many = particles.sizes.clone();
    let finest = many.finest();
    let new = || {
        Forces::new(
            &domain,
            KernelKind::Quintic,
            1.2 * finest,
            0.0,
            Repulsion::none(),
        )
    };
    let mut forces = new();
    for sizes in [
        Sizes::uniform(finest, 1.2),
        many.clone(),
        Sizes::uniform(finest, 1.2),
        many,
    ] {
        particles.sizes = sizes;
        forces.evaluate(&particles);
        let mut fresh = new();
        fresh.evaluate(&particles);
        for i in 0..particles.len() {
            assert!((forces.gamma(i) - fresh.gamma(i)).abs() < 1e-13);
        }
    }
}

/// What measures goes by each particle's own h.
#[test]
fn measures_have_each_its_own_h() {
    let domain = Domain::new([0.0; 2], [4.0; 2]);
    let particles = scattered::<2>(200, 4.0, 5);
    let fields = Fields::measure_each(
        &domain,
        &particles.position,
        &particles.volume,
        particles.sizes.clone(),
        |i| particles.kind[i] != Kind::Frozen,
        KernelKind::Quintic,
    );
    let (sums, _) = by_all_pairs(&particles, &domain, Repulsion::none());
    for (i, (gamma, gradient, _)) in sums.into_iter().enumerate() {
        if particles.kind[i] != Kind::Frozen {
            assert!((fields.gamma[i] - gamma).abs() < 1e-12 * gamma.max(1.0));
            let residual = particles.sizes.smoothing_length(i) * point::norm(gradient);
            assert!((fields.residual(i) - residual).abs() < 1e-11 * residual.max(1.0));
        }
    }
}

/// A step means the same part of its spacing to every particle, and forces say what such a step brings.
#[test]
fn a_step_is_in_parts_of_each_spacing() {
    let domain = Domain::new([0.0; 2], [4.0; 2]);
    let mut particles = scattered::<2>(100, 6.0, 8);
    let before = particles.clone();
    let sizes = before.sizes.clone();
    let h = sizes.smallest_smoothing_length();
    let forces = Forces::new(&domain, KernelKind::Quintic, h, 0.0, Repulsion::none());
    let mut energy = Energy::new(&mut particles, &[], forces, 1.0);
    let force = energy.force().to_vec();
    let (mut places, step) = (Vec::new(), [0.01 * sizes.finest(), 0.0]);
    energy.places(&mut places);
    for (k, &i) in energy.mobile().to_vec().iter().enumerate() {
        let i = i as usize;
        let weight = before.volume[i] / sizes.finest().powi(2);
        let own = energy.forces().weighted_acceleration(i, weight);
        let scaled = point::scale(own, sizes.over_finest(i));
        assert!(point::distance(force[k], scaled) <= 1e-12 * point::norm(scaled));
    }
    let direction = vec![step; energy.len()];
    energy.move_to(&places, 1.0, &direction);
    let after = energy.particles();
    for i in 0..after.len() {
        let way = point::sub(after.position[i], before.position[i]);
        let wanted = match before.kind[i] {
            Kind::Frozen => 0.0,
            _ => 0.01 * sizes.spacing(i),
        };
        assert!((way[0] - wanted).abs() < 1e-14 && way[1].abs() < 1e-14);
    }
}

/// Twice as coarse for every unit to the right.
#[derive(Debug)]
struct Coarser;

impl SpacingField<2> for Coarser {
    fn at(&self, place: [f64; 2]) -> Spacing<2> {
        let value = 0.1 * place[0].exp2();
        Spacing {
            value,
            gradient: [value * std::f64::consts::LN_2, 0.0],
        }
    }

    fn range(&self) -> [f64; 2] {
        [0.1, 0.2]
    }

    fn count_in(&self, surface: &dyn Surface<2>) -> f64 {
        surface.volume() / 0.02
    }
}

/// Nobody gets one size who asked for many: a method places particles by any field, or refuses it.
#[test]
fn a_field_is_followed_or_refused() {
    let field: Resolution<2> = Coarser.into();
    assert_eq!((field.uniform(), field.finest()), (None, 0.1));
    assert!((field.at([1.0, 0.0]).value - 0.2).abs() < 1e-15);
    let problem = Problem::new(Domain::new([0.0; 2], [1.0; 2]), field);
    let packed = problem
        .pack(&crate::Balanced::default())
        .expect("a packing");
    let all: f64 = (0..packed.particles.len())
        .filter(|&i| packed.particles.kind[i] != Kind::Frozen)
        .map(|i| packed.particles.volume[i])
        .sum();
    assert!((all - 1.0).abs() < 1e-12);
    assert!(packed.quality().density.linf < 5e-3, "{}", packed.quality());
    let small = Problem::new(Domain::new([0.0; 2], [0.5, 1.0]), Coarser);
    assert!(matches!(
        small.pack(&crate::Balanced::default()),
        Err(PackingError::NarrowDomain { axis: 0, .. })
    ));
    #[cfg(feature = "published")]
    for refused in [
        problem.pack(&crate::Hybrid::default()),
        problem.pack(&crate::Clipped),
    ] {
        assert!(matches!(
            refused,
            Err(PackingError::Graded { least, greatest }) if (least, greatest) == (0.1, 0.2)
        ));
    }
    assert_eq!(
        Problem::new(Domain::new([0.0; 2], [1.0; 2]), 0.1).check(),
        Ok(())
    );
}
