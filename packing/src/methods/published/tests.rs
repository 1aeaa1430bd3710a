//! What holds of every published method.

use std::ops::ControlFlow;

use sphpack_geometry::{Ball, Outline};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::Domain;

use crate::{
    Agitated, Clipped, Complex, Coupled, Hybrid, Kind, Lattice, Observer, Packed, PackingError,
    Ppa, Problem, Progress, Quality, Relaxation, RunLog, Silent, Standard, StopReason,
    Triangulated,
};

/// Packs with so many iterations at most.
type Pack<const D: usize> =
    fn(&Problem<D>, usize, &mut dyn Observer) -> Result<Packed<D>, PackingError>;

/// No limit but the method's own.
const WHOLE: usize = usize::MAX;

const SHORT: Relaxation = Relaxation {
    residual_tolerance: 3e-3,
    max_iterations: 600,
    solid_h_over_spacing: 1.05,
};

const LEVELLED: Complex = Complex {
    relaxation: SHORT,
    levelling: 1000.0,
    gradient_penalty: 100.0,
};

/// Each with limits that a test can afford.
fn methods<const D: usize>() -> Vec<(&'static str, Pack<D>)> {
    vec![
        ("clipped", |p, _, o| Clipped.pack_in(p, &mut RunLog::new(o))),
        ("hybrid", |p, most, o| {
            let hybrid = Hybrid {
                velocity_tolerance: 1e-3,
                ..Hybrid::default()
            };
            Hybrid {
                max_iterations: hybrid.max_iterations.min(most),
                ..hybrid
            }
            .pack_in(p, &mut RunLog::new(o))
        }),
        ("coupled", |p, most, o| {
            Coupled {
                velocity_tolerance: 1e-3,
                apart_iterations: most.min(300),
                max_iterations: 2 * most.min(300) + most.min(1000),
                ..Coupled::default()
            }
            .pack_in(p, &mut RunLog::new(o))
        }),
        ("relaxation", |p, most, o| {
            short(most).pack_in(p, &mut RunLog::new(o))
        }),
        ("complex", |p, most, o| {
            Complex {
                relaxation: short(most),
                ..LEVELLED
            }
            .pack_in(p, &mut RunLog::new(o))
        }),
        ("agitated", |p, most, o| {
            Agitated {
                revolution: 90.0,
                max_iterations: most.min(if D == 2 { 5000 } else { 500 }),
                ..Agitated::default()
            }
            .pack_in(p, &mut RunLog::new(o))
        }),
        ("ppa", |p, most, o| {
            Ppa {
                max_iterations: most.min(1500),
                energy_tolerance: 1e-6,
                ..Ppa::default()
            }
            .pack_in(p, &mut RunLog::new(o))
        }),
    ]
}

/// [`SHORT`], shorter.
fn short(most: usize) -> Relaxation {
    Relaxation {
        max_iterations: most.min(SHORT.max_iterations),
        ..SHORT
    }
}

fn plane_methods() -> Vec<(&'static str, Pack<2>)> {
    let mut all = methods::<2>();
    all.push(("standard", |p, most, o| {
        let standard = Standard {
            velocity_tolerance: 1e-3,
            ..Standard::default()
        };
        Standard {
            max_iterations: standard.max_iterations.min(most),
            ..standard
        }
        .pack_in(p, &mut RunLog::new(o))
    }));
    all.push(("triangulated", |p, _, o| {
        Triangulated.pack_in(p, &mut RunLog::new(o))
    }));
    all
}

fn disc() -> Problem<2> {
    Problem::new(Domain::new([-1.2; 2], [1.2; 2]), 0.12)
        .body("disc", Ball::new([0.0; 2], 0.6).expect("a disc"))
}

fn ball() -> Problem<3> {
    Problem::new(Domain::new([-1.0; 3], [1.0; 3]), 0.2)
        .body("ball", Ball::new([0.0; 3], 0.6).expect("a ball"))
}

/// What a method must come to, judged by the quintic kernel at h/∆s = 1.2. The start is what stands after one iteration: the
/// surface has its first particles, and nothing has settled. Bars are what was measured and a quarter or so.
struct Bar {
    /// max |Γ − 1| at the end.
    linf: f64,
    /// How many times as large it was at the start, at least.
    gain: f64,
    /// How many times as large the largest residual of a free particle was, at least.
    residual_gain: f64,
    /// Particles on the surface over N_s, from and to.
    on_surface: [f64; 2],
}

/// Of the disc and of the ball.
fn bar(name: &str, dimension: usize) -> Bar {
    let of = |linf, gain, residual_gain, on_surface| Bar {
        linf,
        gain,
        residual_gain,
        on_surface,
    };
    match (name, dimension) {
        ("hybrid", 2) => of(0.003, 25.0, 12.0, [1.0, 1.07]),
        ("hybrid", _) => of(0.010, 8.0, 22.0, [1.0, 1.08]),
        // It crowds its surface, and comes to rest all the same.
        ("coupled", 2) => of(0.165, 1.6, 80.0, [1.2, 1.6]),
        ("coupled", _) => of(0.055, 10.0, 25.0, [1.2, 1.6]),
        ("relaxation", 2) => of(0.023, 5.5, 4.5, [1.0, 1.0]),
        ("relaxation", _) => of(0.055, 1.9, 2.8, [1.0, 1.05]),
        ("complex", 2) => of(0.004, 40.0, 40.0, [1.0, 1.0]),
        ("complex", _) => of(0.005, 18.0, 9.0, [1.0, 1.05]),
        ("agitated", 2) => of(0.030, 2.8, 2.0, [0.95, 1.05]),
        // Stopped on its way.
        ("agitated", _) => of(0.045, 1.8, 1.8, [0.95, 1.05]),
        // The fluid goes to the walls, and no particle is on them.
        ("ppa", 2) => of(0.003, 25.0, 20.0, [0.0, 0.0]),
        ("ppa", _) => of(0.004, 10.0, 15.0, [0.0, 0.0]),
        ("standard", _) => of(0.045, 2.6, 2.2, [1.0, 1.0]),
        // What does not move: the lattice, which is even and at rest but on no surface, and triangles, which are neither.
        ("clipped", _) => of(3e-4, 1.0, 1.0, [0.0, 0.0]),
        _ => of(0.16, 1.0, 1.0, [0.0, 0.0]),
    }
}

fn quality<const D: usize>(packed: &Packed<D>) -> Quality {
    packed.quality_by(&packed.fields(KernelKind::Quintic, 1.2))
}

fn check<const D: usize>(name: &str, problem: &Problem<D>, pack: Pack<D>) {
    let start = quality(&pack(problem, 1, &mut Silent).expect(name));
    let packed = pack(problem, WHOLE, &mut Silent).expect(name);
    let end = quality(&packed);
    let bar = bar(name, D);
    let figures = |q: &Quality| [q.density.linf, q.residual.max];
    let ([linf, residual], before) = (figures(&end), figures(&start));
    let said = format!("{name} in {D}-D: {before:?}, then {linf} {residual}");
    assert!(linf < bar.linf, "{said}");
    assert!(before[0] >= bar.gain * linf, "{said}");
    assert!(before[1] >= bar.residual_gain * residual, "{said}");
    if name == "clipped" {
        assert!(residual < 1e-12, "{said}");
    }
    let surface = &end.surface[0];
    let share = surface.count as f64 / surface.target_count.max(1) as f64;
    let [least, most] = bar.on_surface;
    assert!(share >= least && share <= most, "{said}, {share}");
    // What is captured is uneven at first.
    if ["hybrid", "agitated"].contains(&name) {
        let even = [start.surface[0].spacing_cv, surface.spacing_cv];
        assert!(even[1] < 0.5 * even[0], "{name}: {even:?}");
    }
    for i in 0..packed.particles.len() {
        let (kind, p) = (packed.particles.kind[i], packed.particles.position[i]);
        assert!(p.iter().all(|x| x.is_finite()), "{name}");
        if kind == Kind::Boundary {
            let off = packed.surfaces[0].surface.closest(p).distance;
            assert!(off.abs() < 1e-9, "{name}: {off}");
        }
        if kind != Kind::Frozen {
            let around = problem.domain.bounds.grown(0.5 * problem.spacing());
            assert!(around.contains(p), "{name}: {p:?}");
        }
    }
}

#[test]
fn every_method_packs_a_disc_and_its_surface() {
    for (name, pack) in plane_methods() {
        check(name, &disc(), pack);
    }
}

#[test]
fn every_method_packs_a_ball_and_its_surface() {
    for (name, pack) in methods::<3>() {
        check(name, &ball(), pack);
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let problem = disc();
    for (name, pack) in plane_methods() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("a thread pool");
            pool.install(|| pack(&problem, WHOLE, &mut Silent).expect(name).particles)
        };
        assert!(with(1) == with(3), "{name}");
    }
}

struct Impatient;

impl Observer for Impatient {
    fn progress(&mut self, _: &Progress) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

#[test]
fn every_method_stops_when_told_and_copes_without_bodies() {
    let empty = Problem::new(Domain::new([0.0; 2], [1.0; 2]), 0.1);
    for (name, pack) in plane_methods() {
        let stopped = pack(&disc(), WHOLE, &mut Impatient).expect(name);
        assert_eq!(stopped.stop_reason, StopReason::Interrupted, "{name}");
        let packed = pack(&empty, WHOLE, &mut Silent).expect(name);
        assert!(packed.particles.count(Kind::Free) > 80, "{name}");
    }
}

#[test]
fn layers_are_for_the_plane() {
    let refused = Standard::default().pack_in(&ball(), &mut RunLog::new(&mut Silent));
    assert!(matches!(refused, Err(PackingError::OnlyPlane { .. })));
}

#[test]
fn a_tank_keeps_its_fluid() {
    let corners = [[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [0.0, 1.0]];
    let tank = Outline::polygon(&corners).expect("a tank");
    let problem = Problem::new(Domain::new([-0.4, -0.4], [3.4, 1.4]), 0.08).body("tank", tank);
    let ppa = Ppa {
        containers: vec![true],
        ..Ppa::default()
    };
    let packed = ppa
        .pack_in(&problem, &mut RunLog::new(&mut Silent))
        .expect("a sound problem");
    assert_eq!(packed.stop_reason, StopReason::Converged);
    assert!(packed.iterations <= 4000, "{}", packed.iterations);
    let particles = &packed.particles;
    let fluid: Vec<usize> = (0..particles.len())
        .filter(|&i| particles.kind[i] == Kind::Free)
        .collect();
    let volume: f64 = fluid.iter().map(|&i| particles.volume[i]).sum();
    assert!((volume / 2.5 - 1.0).abs() < 1e-12);
    for &i in &fluid {
        assert!(problem.bodies[0].surface.inside(particles.position[i]));
    }
}

/// Corners of every kind: walls that point into the fluid keep it at rest, acute corners press no two into one.
#[test]
fn a_tank_with_bends_comes_to_rest() {
    let corners = [
        [0.0, 0.0],
        [0.7, 0.0],
        [1.0, -0.15],
        [1.5, -0.1],
        [1.7, 0.3],
        [2.3, 0.7],
        [1.1, 0.7],
        [0.9, 0.4],
        [0.7, 0.7],
        [0.1, 0.7],
        [0.16, 0.4],
    ];
    let tank = Outline::polygon(&corners).expect("a tank");
    let problem = Problem::new(Domain::new([-0.3, -0.4], [2.5, 1.0]), 0.04).body("tank", tank);
    let ppa = Ppa {
        containers: vec![true],
        ..Ppa::default()
    };
    let packed = ppa
        .pack_in(&problem, &mut RunLog::new(&mut Silent))
        .expect("a sound problem");
    assert_eq!(packed.stop_reason, StopReason::Converged);
    let quality = packed.quality_by(&packed.fields(problem.kernel, problem.h_over_spacing));
    let closest = quality.closest_pair_over_spacing;
    assert!(closest > 0.5, "{closest}");
}

/// Triangles fill a body, with a hole too, to within the chords of its outline, one for each ∆s² in the mean.
#[test]
fn triangles_carry_the_area_of_their_body() {
    let square = |half: f64| vec![[-half, -half], [half, -half], [half, half], [-half, half]];
    let ring = Outline::new(vec![square(0.8), square(0.33)]).expect("an outline");
    let disc = Ball::new([0.0; 2], 0.7).expect("a disc");
    let box_of = || Problem::new(Domain::new([-1.2; 2], [1.2; 2]), 0.08);
    for (problem, exact) in [
        (box_of().body("ring", ring), true),
        (box_of().body("disc", disc), false),
    ] {
        let packed = Triangulated
            .pack_in(&problem, &mut RunLog::new(&mut Silent))
            .expect("triangles");
        let body = problem.bodies[0].surface.as_ref();
        let mine: Vec<usize> = (0..packed.particles.len())
            .filter(|&i| packed.particles.body[i] == Some(0))
            .collect();
        let area: f64 = mine.iter().map(|&i| packed.particles.volume[i]).sum();
        let off = area / body.volume() - 1.0;
        assert!(off.abs() < if exact { 1e-9 } else { 0.01 }, "{off}");
        let wanted = body.volume() / 0.08_f64.powi(2);
        assert!(
            (mine.len() as f64 / wanted - 1.0).abs() < 0.15,
            "{} {wanted}",
            mine.len()
        );
        assert!(
            mine.iter()
                .all(|&i| body.inside(packed.particles.position[i]))
        );
    }
}

/// The body of scenes/zigzag.toml, with the kernel and h/∆s of Zhao et al. (2025).
fn zigzag(spacing: f64) -> Problem<2> {
    let corners = [
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, 0.0],
        [0.75, 0.25],
        [0.25, -0.25],
        [-0.25, 0.25],
        [-0.75, -0.25],
        [-1.0, 0.0],
    ];
    let body = Outline::polygon(&corners).expect("a wall");
    let mut problem =
        Problem::new(Domain::new([-1.6, -1.6], [1.6, 0.9]), spacing).body("wall", body);
    (problem.kernel, problem.h_over_spacing) = (KernelKind::WendlandC2, 1.3);
    problem
}

/// Largest and mean h |Σ V ∇W| of the fluid within ∆s of the body (Zhao et al. 2025, eq. 13).
fn first_layer(problem: &Problem<2>, packed: &Packed<2>) -> (f64, f64) {
    let fields = packed.fields(problem.kernel, problem.h_over_spacing);
    let particles = &packed.particles;
    let layer: Vec<f64> = (0..particles.len())
        .filter(|&i| particles.kind[i] == Kind::Free && particles.body[i].is_none())
        .filter(|&i| {
            let hit = problem.bodies[0].surface.closest(particles.position[i]);
            hit.distance < problem.spacing()
        })
        .map(|i| fields.residual(i))
        .collect();
    let largest = layer.iter().copied().fold(0.0, f64::max);
    (largest, layer.iter().sum::<f64>() / layer.len() as f64)
}

#[test]
fn complex_relaxation_brings_the_first_layer_to_rest() {
    let relaxation = Relaxation {
        residual_tolerance: 1e-4,
        max_iterations: 4000,
        ..Relaxation::default()
    };
    let layers = |problem: &Problem<2>| {
        let apart = relaxation
            .pack_in(problem, &mut RunLog::new(&mut Silent))
            .expect("apart");
        let complex = Complex {
            relaxation,
            levelling: 0.0,
            ..LEVELLED
        };
        let complex = complex
            .pack_in(problem, &mut RunLog::new(&mut Silent))
            .expect("together");
        (first_layer(problem, &apart), first_layer(problem, &complex))
    };
    let mut smooth = disc();
    (smooth.kernel, smooth.h_over_spacing) = (KernelKind::WendlandC2, 1.3);
    let (apart, complex) = layers(&smooth);
    assert!(apart.1 > 0.01, "{apart:?}");
    assert!(complex.0 < 1e-3, "{complex:?}");
    // In its notches φ > 0 holds a particle back.
    let (apart, complex) = layers(&zigzag(0.1));
    assert!(complex.0 < 0.25 * apart.0, "{apart:?} {complex:?}");
    assert!(complex.1 < 0.02 * apart.1, "{apart:?} {complex:?}");
}

#[test]
fn relaxed_bodies_keep_their_volume_and_their_places_apart() {
    let problem = zigzag(0.05);
    let packed = LEVELLED
        .pack_in(&problem, &mut RunLog::new(&mut Silent))
        .expect("a sound problem");
    let quality = quality(&packed);
    let particles = &packed.particles;
    let solid: f64 = (0..particles.len())
        .filter(|&i| particles.body[i].is_some())
        .map(|i| particles.volume[i])
        .sum();
    assert!((solid / problem.bodies[0].surface.volume() - 1.0).abs() < 1e-12);
    let closest = quality.closest_pair_over_spacing;
    assert!(closest > 0.85, "{closest}");
    assert!(quality.density.linf < 0.006, "{}", quality.density.linf);
}

/// Least and largest Γ/Γ₀ − 1 of the fluid's particles or the solids', by Wendland's C2 at h/∆s.
fn off(packed: &Packed<2>, h_over_spacing: f64, is_fluid: bool) -> [f64; 2] {
    let kernel = KernelKind::WendlandC2;
    let lattice = Lattice::auto(2, kernel, h_over_spacing).gamma(kernel, h_over_spacing);
    let fields = packed.fields(kernel, h_over_spacing);
    let particles = &packed.particles;
    (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen && particles.body[i].is_none() == is_fluid)
        .map(|i| fields.gamma[i] / lattice - 1.0)
        .fold([0.0; 2], |[low, high], off| [low.min(off), high.max(off)])
}

#[test]
fn levelling_keeps_each_side_within_the_papers_range_by_its_own_h() {
    for spacing in [0.1, 0.05] {
        let problem = zigzag(spacing);
        let sides = |complex: Complex| {
            let packed = complex
                .pack_in(&problem, &mut RunLog::new(&mut Silent))
                .expect("a sound problem");
            [off(&packed, 1.05, false), off(&packed, 1.3, true)]
        };
        let plain = sides(Complex {
            levelling: 0.0,
            ..LEVELLED
        });
        for ([low, high], before) in sides(LEVELLED).into_iter().zip(plain) {
            assert!(low > -0.004 && high < 0.004, "{low} {high}");
            assert!(before[1] - before[0] > 0.015, "{before:?}");
        }
    }
}

#[test]
fn surface_particles_may_sit_on_the_surface_or_near_it() {
    for (inset, apart, levelled) in [(0.0, 0.115, 0.0095), (0.25, 0.07, 0.005)] {
        let mut problem = zigzag(0.1);
        problem.bodies[0].inset_over_spacing = inset;
        let linf = |packed: Result<Packed<2>, PackingError>| {
            quality(&packed.expect("a sound problem")).density.linf
        };
        let start = linf(short(1).pack_in(&problem, &mut RunLog::new(&mut Silent)));
        let off = linf(SHORT.pack_in(&problem, &mut RunLog::new(&mut Silent)));
        assert!(off < apart && off < 0.5 * start, "{inset}: {start} {off}");
        let off = linf(LEVELLED.pack_in(&problem, &mut RunLog::new(&mut Silent)));
        assert!(
            off < levelled && off < 0.05 * start,
            "{inset}: {start} {off}"
        );
    }
}

#[test]
fn solids_start_from_the_lattice_that_rests_at_their_h() {
    let least = |dimension, h| Lattice::auto(dimension, KernelKind::WendlandC2, h);
    assert_eq!(least(2, 1.05), Lattice::Square);
    assert_eq!(least(2, 1.3), Lattice::Hexagonal);
    assert_eq!(least(3, 1.05), Lattice::SimpleCubic);
    assert_eq!(least(3, 1.3), Lattice::Bcc);
}
