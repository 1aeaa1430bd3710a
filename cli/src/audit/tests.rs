//! Every kind of damage is found, by its name.

use sphpack_packing::{Kind, Silent};
use sphpack_separation::Side;

use super::Audit;
use crate::asked::Asked;
use crate::content::Content;
use crate::run::{Options, run};
use crate::scene::Scene;
use crate::solution::{Packing, Solution};

const DISC: &str = r#"
spacing = 0.2
[domain]
min = [-2.0, -2.0]
max = [2.0, 2.0]
[[body]]
name = "disc"
shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
"#;

fn packed() -> (Scene, Solution<2>) {
    let scene = Scene::parse(DISC, "disc.toml").expect("a scene");
    let outcome = run(&scene, &Options::default(), &mut Silent).expect("a packing");
    assert!(outcome.report.audit.passed, "{:?}", outcome.report.audit);
    match outcome.packing {
        Packing::Plane(solution) => (scene, solution),
        Packing::Space(_) => panic!("a disc in space"),
    }
}

/// Audits after some damage, with measures taken anew.
fn after(damage: impl Fn(&mut Solution<2>)) -> Audit {
    let (scene, mut solution) = packed();
    damage(&mut solution);
    let packed = &solution.packed;
    solution.fields = packed.fields(packed.kernel, packed.h_over_spacing);
    solution.quality = packed.quality_by(&solution.fields);
    let volumes = Content::of(&solution.problem, &solution).volumes;
    Audit::of(&Asked::by(&scene), &solution, &volumes)
}

#[track_caller]
fn finds(words: &str, damage: impl Fn(&mut Solution<2>)) -> Audit {
    let audit = after(damage);
    assert!(!audit.passed);
    assert!(
        audit.messages.iter().any(|m| m.contains(words)),
        "{words}: {audit:?}"
    );
    // What was found, and the cure.
    assert!(audit.messages.len() >= 2);
    audit
}

fn first(solution: &Solution<2>, side: Side) -> usize {
    (0..solution.packed.particles.len())
        .find(|&i| {
            solution.packed.particles.kind[i] == Kind::Free && solution.labels.side[i] == side
        })
        .expect("a particle")
}

#[test]
fn nothing_is_found_where_nothing_is_wrong() {
    let audit = after(|_| {});
    assert!(audit.passed && audit.messages.is_empty() && audit.worst_at.is_empty());
    assert!(audit.volume_error < 1e-9, "{}", audit.volume_error);
}

#[test]
fn what_is_outside_is_found() {
    let audit = finds("outside the box", |s| {
        let i = first(s, Side::Fluid);
        s.packed.particles.position[i] = [2.5, 0.3];
    });
    assert_eq!(audit.outside, 1);
    assert_eq!(audit.worst_at, [2.5, 0.3]);
}

#[test]
fn numbers_that_are_none_are_found() {
    finds("no finite", |s| {
        s.packed.particles.position[3][0] = f64::NAN;
    });
    finds("no finite", |s| {
        s.packed.particles.volume[3] = -1.0;
    });
    finds("have the number", |s| {
        s.packed.particles.id[3] = s.packed.particles.id[4];
    });
}

#[test]
fn two_in_one_place_are_found() {
    let audit = finds("of their size apart", |s| {
        let i = first(s, Side::Fluid);
        let p = s.packed.particles.position[i];
        s.packed.particles.position[i + 1] = [p[0] + 0.01, p[1]];
    });
    assert!((audit.closest_pair_over_spacing - 0.05).abs() < 1e-9);
}

#[test]
fn volumes_are_found() {
    finds("body \"disc\"", |s| {
        let all = &mut s.packed.particles;
        for i in 0..all.len() {
            if s.labels.side[i] == Side::Solid {
                all.volume[i] *= 1.03;
            }
        }
    });
    let audit = finds("all particles together", |s| {
        s.packed.particles.volume[0] *= 1.0001;
    });
    assert!(audit.volume_error < 1e-4);
}

#[test]
fn the_wrong_side_is_found() {
    // Labels changed, places kept.
    let audit = finds("wrong side", |s| {
        let i = first(s, Side::Solid);
        s.labels.side[i] = Side::Fluid;
        s.labels.body[i] = None;
    });
    assert_eq!(audit.wrong_side, 1);
    finds("wrong side", |s| {
        let i = first(s, Side::Fluid);
        s.labels.side[i] = Side::Solid;
        s.labels.body[i] = Some(0);
    });
    finds("off its surface", |s| {
        let all = &mut s.packed.particles;
        let i = (0..all.len())
            .find(|&i| all.kind[i] == Kind::Boundary)
            .expect("one");
        all.position[i][0] += 0.01;
    });
}

#[test]
fn a_hole_in_the_density_is_found() {
    finds("density is off", |s| {
        // Two particles of the fluid go where others are.
        let i = first(s, Side::Fluid);
        let p = s.packed.particles.position[i];
        for k in 1..3 {
            s.packed.particles.position[i + 40 + k] = [p[0] + 0.12, p[1] + 0.12 * k as f64 - 0.1];
        }
    });
}

#[test]
fn sums_that_are_not_those_of_the_neighbours_are_found() {
    let (scene, mut solution) = packed();
    let volumes = Content::of(&solution.problem, &solution).volumes;
    let i = (solution.packed.particles.kind.iter())
        .position(|&kind| kind != Kind::Frozen)
        .expect("a particle");
    solution.fields.gamma[i] += 1e-8;
    let found = |solution: &Solution<2>| {
        Audit::of(&Asked::by(&scene), solution, &volumes)
            .messages
            .concat()
    };
    assert!(found(&solution).contains("gamma of particle"));
    solution.fields.gamma[i] -= 1e-8;
    solution.fields.gradient[i][0] *= 1.01;
    assert!(found(&solution).contains("residual of particle"));
    // A rim that is thinner than the kernel's reach.
    solution.fields.gradient[i][0] /= 1.01;
    let frozen = (solution.packed.particles.kind.iter()).rposition(|&kind| kind == Kind::Frozen);
    let edge = (solution.packed.particles.position.iter())
        .zip(&solution.packed.particles.kind)
        .position(|(p, &kind)| kind != Kind::Frozen && p[0] > 1.8);
    assert!(frozen.is_some() && edge.is_some());
    for p in &mut solution.packed.particles.position {
        if p[0] > 2.2 {
            p[0] += 10.0;
        }
    }
    assert!(found(&solution).contains("is a fault of sphpack"));
}
