//! Derivatives against differences; what the finishes come to.

use sphpack_geometry::Ball;
use sphpack_neighbors::{Domain, point};

use super::objective::Objective;
use crate::minimise::{Movable, vectors::dot};
use crate::particles::Kind;
use crate::{
    Balanced, Finish, Packed, PackingError, Particles, Problem, RunLog, Settling, Silent,
    StopReason,
};

fn disc(spacing: f64) -> Problem<2> {
    Problem::new(Domain::new([-1.4, -1.2], [1.3, 1.25]), spacing)
        .body("disc", Ball::new([0.03, -0.02], 0.7).expect("a disc"))
}

fn pack<const D: usize>(problem: &Problem<D>, finish: Finish) -> Result<Packed<D>, PackingError> {
    let balanced = Balanced {
        settling: Settling {
            finish,
            ..Settling::default()
        },
        ..Balanced::default()
    };
    balanced.pack_in(problem, &mut RunLog::new(&mut Silent))
}

/// The largest |Γ − Γ₀|, the largest h|∇Γ| of free particles, and the closest pair over ∆s: by all pairs.
fn figures<const D: usize>(problem: &Problem<D>, packed: &Packed<D>) -> [f64; 3] {
    struct AllPairs<'a, const D: usize>(&'a Particles<D>);
    impl<const D: usize> sphpack_kernels::WithKernel<D> for AllPairs<'_, D> {
        type Output = Vec<(f64, [f64; D])>;

        fn call<K: sphpack_kernels::Kernel<D>>(self, kernel: K) -> Self::Output {
            let (x, v) = (&self.0.position, &self.0.volume);
            let of_one = |&p: &[f64; D]| {
                let (mut gamma, mut gradient) = (0.0, [0.0; D]);
                for (&q, v) in x.iter().zip(v) {
                    let apart = point::sub(p, q);
                    gamma += v * kernel.value(point::norm(apart));
                    gradient = point::add_scaled(gradient, *v, kernel.gradient(apart));
                }
                (gamma, gradient)
            };
            x.iter().map(of_one).collect()
        }
    }
    let h = problem.smoothing_length();
    let particles = &packed.particles;
    let sums = problem.kernel.with(h, AllPairs(particles));
    let mut found = [0.0_f64, 0.0, f64::INFINITY];
    for (i, (gamma, gradient)) in sums.iter().enumerate() {
        if particles.kind[i] == Kind::Frozen {
            continue;
        }
        found[0] = found[0].max((gamma - problem.perfect_gamma()).abs());
        if particles.kind[i] == Kind::Free {
            found[1] = found[1].max(h * point::norm(*gradient));
        }
        for (j, &q) in particles.position.iter().enumerate() {
            if j != i {
                let apart = point::distance(particles.position[i], q) / problem.spacing();
                found[2] = found[2].min(apart);
            }
        }
    }
    found
}

#[test]
fn both_is_level_and_consistent_at_once_with_pairs_apart() {
    for spacing in [0.08, 0.1] {
        let problem = disc(spacing);
        let even = pack(&problem, Finish::Even).expect("a sound problem");
        let both = pack(&problem, Finish::Both).expect("a sound problem");
        assert_eq!(both.stop_reason, StopReason::Converged);
        let (before, after) = (figures(&problem, &even), figures(&problem, &both));
        assert!(after[0] <= 5e-4 && after[1] <= 6e-4, "{before:?} {after:?}");
        assert!(before[0] > 5e-4 && before[1] > 6e-4, "{before:?}");
        assert!(after[2] >= 0.85, "{after:?}");
        let volume = |packed: &Packed<2>| packed.particles.volume.clone();
        assert_eq!(volume(&even), volume(&both));
    }
}

#[test]
fn a_balance_shifts_what_comes_down() {
    let problem = disc(0.1);
    let at = |balance: f64| {
        let balanced = Balanced {
            settling: Settling {
                finish: Finish::Both,
                balance,
                ..Settling::default()
            },
            ..Balanced::default()
        };
        let packed = balanced.pack_in(&problem, &mut RunLog::new(&mut Silent));
        figures(&problem, &packed.expect("a sound problem"))
    };
    let (consistent, even) = (at(0.1), at(0.9));
    assert!(
        consistent[0] > even[0] && consistent[1] < even[1],
        "{consistent:?} {even:?}"
    );
}

#[test]
fn calm_comes_to_rest_with_pairs_apart() {
    let problem = disc(0.1);
    let calm = pack(&problem, Finish::Calm).expect("a sound problem");
    assert_eq!(calm.stop_reason, StopReason::Converged);
    let found = figures(&problem, &calm);
    assert!(
        found[0] <= 2.5e-3 && found[1] <= 1e-6 && found[2] >= 0.85,
        "{found:?}"
    );
    // Surface particles are on their surface still.
    for (i, &p) in calm.particles.position.iter().enumerate() {
        if calm.particles.kind[i] == Kind::Boundary {
            let off = point::distance(p, [0.03, -0.02]) - (0.7 - 0.5 * 0.1);
            assert!(off.abs() < 1e-9, "{off}");
        }
    }
}

#[test]
fn calm_refuses_what_is_too_much_for_it() {
    let problem = disc(0.02);
    let refused = pack(&problem, Finish::Calm);
    assert!(matches!(refused, Err(PackingError::TooManyAtRest { .. })));
}

#[test]
fn threads_change_no_bit() {
    let problem = disc(0.1);
    for finish in [Finish::Both, Finish::Calm] {
        let with_threads = |count: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
            pool.expect("a thread pool")
                .install(|| pack(&problem, finish).expect("a sound problem").particles)
        };
        assert!(with_threads(1) == with_threads(3), "{finish:?}");
    }
}

/// −∇F and the Gauss–Newton matrix against differences of F and of residuals, surfaces and close pairs among them, in the
/// plane and in space.
fn derivatives<const D: usize>(problem: &Problem<D>) {
    let packed = pack(problem, Finish::Even).expect("a sound problem");
    let mut particles = packed.particles.clone();
    let noise =
        |i: usize, k: usize| ((i * 7 + k * 13 + 1) as f64 * 0.618_033_988_749).fract() - 0.5;
    for (i, x) in particles.position.iter_mut().enumerate() {
        if particles.kind[i] == Kind::Free {
            *x = std::array::from_fn(|k| x[k] + 0.1 * problem.spacing() * noise(i, k));
        }
    }
    let movable = Movable::new(
        &mut particles,
        &packed.surfaces,
        problem.domain,
        problem.support(),
    );
    let close = (0.9 * problem.spacing(), 0.3);
    let mut objective = Objective::new(problem, movable, &[], [0.7, 1.3], close);
    objective.evaluate();
    objective.emphasise(5.0);
    let mut descent = Vec::new();
    let held = objective.descent(&mut descent);
    assert!(held.is_empty());
    let mut start = Vec::new();
    objective.movable.places(&mut start);
    let mut step: Vec<[f64; D]> = (0..start.len())
        .map(|i| std::array::from_fn(|k| problem.spacing() * noise(i, k + 4)))
        .collect();
    objective.restrict(&mut step, &[]);
    let size = 1e-5;
    let mut at = |part: f64| {
        objective.movable.move_to(&start, part, &step);
        objective.evaluate();
        let mut slope = Vec::new();
        objective.descent(&mut slope);
        (objective.value(), dot(&slope, &step))
    };
    let (up, down) = (at(size), at(-size));
    let difference = (up.0 - down.0) / (2.0 * size);
    let slope = -dot(&descent, &step);
    assert!(
        (difference - slope).abs() < 1e-5 * slope.abs(),
        "{difference} {slope}"
    );
    let _ = at(0.0);
    // The matrix is symmetric, and positive.
    let mut other: Vec<[f64; D]> = step
        .iter()
        .map(|s| std::array::from_fn(|k| s[D - 1 - k]))
        .collect();
    objective.restrict(&mut other, &[]);
    let (mut a, mut b) = (Vec::new(), Vec::new());
    objective.product(&step, &[], &mut a);
    objective.product(&other, &[], &mut b);
    let (one, two) = (dot(&other, &a), dot(&step, &b));
    assert!((one - two).abs() < 1e-9 * dot(&step, &a), "{one} {two}");
    assert!(dot(&step, &a) > 0.0 && dot(&other, &b) > 0.0);
}

#[test]
fn derivatives_are_those_of_the_objective() {
    derivatives(&disc(0.13));
    let ball = Ball::new([0.0; 3], 0.6).expect("a ball");
    derivatives(&Problem::new(Domain::new([-1.0; 3], [1.0; 3]), 0.25).body("ball", ball));
}
