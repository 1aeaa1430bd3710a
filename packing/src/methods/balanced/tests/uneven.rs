//! What an energy leaves uneven, and what the last stage makes of it.

use sphpack_geometry::{Cuboid, Outline};
use sphpack_neighbors::Domain;

use super::super::{Balanced, Goal, UNEVEN_WIDTH, goals};
use crate::finish::unevenness;
use crate::{Kind, Packed, Problem, RunLog, Silent};

/// Two blocks of 1 beside each other and one above them, with so wide a gap between them, in ∆s.
fn blocks(spacing: f64, gap: f64) -> Problem<2> {
    let gap = gap * spacing;
    let block = |x: f64, y: f64, width: f64, height: f64| {
        let corners = [
            [x, y],
            [x + width, y],
            [x + width, y + height],
            [x, y + height],
        ];
        Outline::polygon(&corners).expect("an outline")
    };
    let room = 6.0 * spacing;
    let domain = Domain::new([-room; 2], [2.0 + gap + room, 2.0 + gap + room]);
    Problem::new(domain, spacing)
        .body("left", block(0.0, 0.0, 1.0, 1.0))
        .body("right", block(1.0 + gap, 0.0, 1.0, 1.0))
        .body("above", block(0.3, 1.0 + gap, 1.1, 1.0))
}

/// With the usual counts, and these goals.
fn pack<const D: usize>(problem: &Problem<D>, goals: &[Goal]) -> Packed<D> {
    let usual = |problem: &Problem<D>, _: &_, _: &mut RunLog<'_>| vec![None; problem.bodies.len()];
    Balanced::default()
        .pack_counted(problem, &mut RunLog::new(&mut Silent), goals, &usual)
        .expect("a sound problem")
}

fn evened<const D: usize>(problem: &Problem<D>) -> Packed<D> {
    pack(problem, &goals::of(&Balanced::default().settling))
}

fn worst<const D: usize>(packed: &Packed<D>) -> f64 {
    let quality = packed.quality();
    unevenness(
        quality.density.linf_lattice,
        quality.closest_pair_over_spacing,
    )
}

/// That it is no worse than without a last stage, that nothing but positions differs, and those only where it was uneven; how
/// uneven it was and is.
fn before_and_after<const D: usize>(problem: &Problem<D>) -> (f64, f64) {
    let (plain, evened) = (pack(problem, &[]), evened(problem));
    let (before, after) = (worst(&plain), worst(&evened));
    assert!(after <= before, "{before} {after}");
    assert_eq!(plain.particles.volume, evened.particles.volume);
    assert_eq!(plain.particles.kind, evened.particles.kind);
    assert_eq!(plain.particles.body, evened.particles.body);
    if before < 0.9 {
        assert!(plain.particles == evened.particles, "{before}");
        assert_eq!(plain.force_evaluations, evened.force_evaluations);
    }
    for (i, &place) in evened.particles.position.iter().enumerate() {
        let of_body = evened.particles.on_surface(i);
        if evened.particles.kind[i] == Kind::Boundary {
            let surface = &evened.surfaces[usize::from(of_body.expect("a body"))].surface;
            let off = surface.closest(place).distance.abs();
            assert!(off < 1e-9 * problem.spacing(), "{off}");
        }
    }
    (before, after)
}

#[test]
fn gaps_between_blocks_are_evened_out() {
    let mut found = Vec::new();
    for spacing in [0.13, 0.11] {
        for tenths in 3..12 {
            found.push(before_and_after(&blocks(spacing, 0.1 * f64::from(tenths))));
        }
    }
    // By how much they are worse than even, taken together.
    let excess = |which: fn(&(f64, f64)) -> f64| -> f64 {
        found.iter().map(|pair| (which(pair) - 1.0).max(0.0)).sum()
    };
    let (before, after) = (excess(|pair| pair.0), excess(|pair| pair.1));
    assert!(before > 10.0 && after < before / 5.0, "{found:?}");
}

/// The two narrow gaps are uneven, what is two blocks' corners away from them stays.
#[test]
fn what_is_far_from_uneven_places_stays() {
    let spacing = 0.06;
    let problem = blocks(spacing, 0.6);
    let (plain, evened) = (pack(&problem, &[]), evened(&problem));
    let from_gaps = |[x, y]: [f64; 2]| {
        let upright = (x - 1.018).hypot((y - 1.0).max(0.0));
        let level = (y - 1.018).hypot((0.3 - x).max(x - 1.4).max(0.0));
        upright.min(level)
    };
    let reach = UNEVEN_WIDTH * problem.support() + 2.0 * spacing;
    let mut moved = 0;
    let (from, to) = (&plain.particles.position, &evened.particles.position);
    for (&from, &to) in from.iter().zip(to) {
        if from != to {
            moved += 1;
            assert!(from_gaps(from) < reach, "{from:?} {to:?}");
        }
    }
    assert!((20..from.len() / 2).contains(&moved), "{moved}");
}

#[test]
fn a_gap_between_cubes_gets_no_worse() {
    for tenths in [3, 6, 7] {
        let gap = 0.22 * 0.1 * f64::from(tenths);
        let cube = |x: f64| Cuboid::new([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]).expect("a cube");
        let domain = Domain::new([-0.7; 3], [2.7 + gap, 1.7, 1.7]);
        let problem = Problem::new(domain, 0.22)
            .body("left", cube(0.0))
            .body("right", cube(1.0 + gap));
        before_and_after(&problem);
    }
}

#[test]
fn threads_change_no_bit_of_it() {
    let problem = blocks(0.13, 0.6);
    let with_threads = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        pool.expect("a thread pool")
            .install(|| evened(&problem).particles)
    };
    assert!(with_threads(1) == with_threads(3));
}

#[test]
fn it_can_be_stopped_and_gone_on_with() {
    let problem = blocks(0.13, 0.6);
    assert!(evened(&problem).force_evaluations > 20 + pack(&problem, &[]).force_evaluations);
    crate::resumed::check(&|observer| {
        Balanced::default().pack_in(&problem, &mut RunLog::new(observer))
    });
}
