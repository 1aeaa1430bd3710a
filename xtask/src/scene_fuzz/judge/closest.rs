//! How near particles are to each other.

use super::{Faults, Scene};

/// The least distance of two particles, over the mean of their sizes.
const LEAST: f64 = 0.5;

pub(super) fn judge(scene: &Scene<'_>, faults: &mut Faults) {
    let spacing = scene.coarsest();
    let power = 1.0 / scene.case.dimension as f64;
    let size = |i: usize| scene.rows[i].volume.max(0.0).powf(power);
    let all = scene.with_images(2.0 * spacing);
    // The closest pair by sizes, and by distance alone.
    let mut worst = (f64::INFINITY, 0, 0);
    let mut closest = f64::INFINITY;
    for (i, row) in scene.rows.iter().enumerate() {
        if row.is_frozen() {
            continue;
        }
        for (place, (j, p)) in all.iter().enumerate() {
            // The particle itself; its images come later.
            if place == i {
                continue;
            }
            let r2 = (0..3).map(|k| (row.at[k] - p[k]).powi(2)).sum::<f64>();
            if r2 < closest * closest {
                closest = r2.sqrt();
            }
            if r2 < 4.0 * spacing * spacing {
                let share = r2.sqrt() / (0.5 * (size(i) + size(*j)));
                if share < worst.0 {
                    worst = (share, i, *j);
                }
            }
        }
    }
    if worst.0 < LEAST {
        let (share, i, j) = worst;
        let class = if share < 0.05 {
            "pair in one place"
        } else {
            "close pair"
        };
        faults.add(
            class,
            format!(
                "{share:.4} of their sizes apart: {:?} {:?} {:?} and {:?} {:?} {:?}",
                scene.rows[i].kind,
                scene.rows[i].body,
                scene.rows[i].at,
                scene.rows[j].kind,
                scene.rows[j].body,
                scene.rows[j].at
            ),
        );
    }
    // Particles of many sizes are told of by the mean of both, as far as neighbours are.
    let (is, most) = if scene.is_graded() {
        (worst.0, 1.5)
    } else {
        (closest / spacing, 2.0)
    };
    let Some(said) = scene.figure(&["closest_pair_over_spacing"]) else {
        if !scene.is_graded() || is < most {
            faults.add("report lacks the closest pair", String::new());
        }
        return;
    };
    let knows_all = !scene.leaves_out() && scene.case.includes("frozen");
    if is < most && (said > is + 1e-9 || (knows_all && said < is - 1e-9)) {
        faults.add(
            "closest pair in the report",
            format!("is {is}, report says {said}"),
        );
    }
}
