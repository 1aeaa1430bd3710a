//! Whether all particles are there, once each, and in the box.

use std::collections::BTreeSet;

use super::{Faults, Scene};

/// How far beyond a side counts as rounding, in ∆s.
const SLACK: f64 = 1e-9;

pub(super) fn judge(scene: &Scene<'_>, faults: &mut Faults) {
    let spacing = scene.case.spacing;
    let mut ids = BTreeSet::new();
    // How far the farthest is outside, and which.
    let mut worst = (0.0, String::new(), 0);
    for row in scene.rows {
        if !ids.insert(&row.id) {
            faults.add("id twice", format!("id {} is there twice", row.id));
        }
        let numbers = [row.at[0], row.at[1], row.at[2], row.volume, row.mass];
        let judged = [row.gamma, row.residual];
        if numbers.iter().any(|x| !x.is_finite())
            || (!row.is_frozen() && judged.iter().any(|x| !x.is_finite()))
        {
            faults.add("not finite", format!("{row:?}"));
        }
        if row.volume <= 0.0 {
            faults.add("volume not positive", format!("{row:?}"));
        }
        if !scene.case.includes(&row.kind) {
            let class = match &scene.case.include {
                Some(_) => "kind not asked for",
                None => "kind that is not in the default",
            };
            faults.add(class, format!("{row:?}"));
        }
        for axis in scene.axes() {
            let x = row.at[axis];
            let (min, max) = (scene.min[axis], scene.max[axis]);
            let is_periodic = scene.case.periodic[axis];
            if is_periodic && !(min <= x && x < max) && (row.is_frozen() || (min <= x && x <= max))
            {
                faults.add(
                    "not wrapped",
                    format!("{x} along the periodic axis {axis}, {min} to {max}: {row:?}"),
                );
            } else if !row.is_frozen() {
                let beyond = (min - x).max(x - max) / spacing;
                if beyond > SLACK.max(4.0 * f64::EPSILON * x.abs() / spacing) {
                    let count = worst.2 + 1;
                    if beyond > worst.0 {
                        worst = (beyond, format!("{row:?}"), count);
                    }
                    worst.2 = count;
                }
            }
        }
    }
    if worst.2 > 0 {
        let class = if worst.0 > 0.01 {
            "outside"
        } else {
            "outside by a hair"
        };
        faults.add(
            class,
            format!(
                "{} particles, the farthest {:.3e} ∆s: {}",
                worst.2, worst.0, worst.1
            ),
        );
    }
    let asked = ["free", "boundary", "fixed", "frozen"];
    for kind in asked.into_iter().filter(|kind| scene.case.includes(kind)) {
        let is = scene.rows.iter().filter(|row| row.kind == kind).count();
        if scene.figure(&["particles", kind]) != Some(is as f64) {
            faults.add(
                "report counts otherwise",
                format!(
                    "{is} {kind} rows, report {:?}",
                    scene.figure(&["particles", kind])
                ),
            );
        }
    }
}
