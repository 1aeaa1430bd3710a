//! Sums over particles: their volumes, Γ and its gradient.

use super::{Fault, Faults, Scene};

/// Of relative figures that must be the same but for rounding.
const SAME: f64 = 1e-9;

/// Methods that take from their papers how much every particle weighs, and do not share out the box.
const DO_NOT_SHARE: [&str; 3] = ["standard", "ppa", "triangulated"];

/// All volumes together are the box.
pub(super) fn volume(scene: &Scene<'_>, faults: &mut Faults, notes: &mut Vec<Fault>) {
    if scene.leaves_out() {
        return;
    }
    let own = scene.rows.iter().filter(|row| !row.is_frozen());
    let sum: f64 = own.map(|row| row.volume).sum();
    let off = sum / scene.volume() - 1.0;
    if off.abs() > SAME {
        let class = if off.abs() < 1e-6 {
            "sum of volumes off by a hair"
        } else {
            "sum of volumes"
        };
        let detail = format!("{off:+.3e} of the box's volume");
        if DO_NOT_SHARE.contains(&scene.case.method()) {
            notes.push(Fault {
                class: format!("{class} ({})", scene.case.method()),
                detail,
            });
        } else {
            faults.add(class, detail);
        }
    }
}

/// Γ and h |∇Γ| against sums over all pairs, and the report's figures against the columns.
pub(super) fn fields(scene: &Scene<'_>, faults: &mut Faults) {
    let dimension = scene.case.dimension;
    let (kernel, ratio) = scene.case.judges();
    let most = kernel.support() * ratio * scene.coarsest();
    let (packs, packs_ratio) = scene.case.packs();
    // So far frozen rows reach.
    let is_seen = kernel.support() * ratio <= packs.support() * packs_ratio;
    let has_rim = scene.case.includes("frozen") && is_seen;
    let all = scene.with_images(most);
    if !scene.leaves_out() {
        for row in scene.rows.iter().filter(|row| !row.is_frozen()) {
            let h = ratio * scene.spacing(row);
            let reach = kernel.support() * h;
            let is_near_side = scene.axes().any(|k| {
                !scene.case.periodic[k]
                    && (row.at[k] - scene.min[k]).min(scene.max[k] - row.at[k]) < reach
            });
            if is_near_side && !has_rim {
                continue;
            }
            let (mut gamma, mut gradient) = (0.0, [0.0; 3]);
            for (j, p) in &all {
                let d: [f64; 3] = std::array::from_fn(|k| row.at[k] - p[k]);
                let r2 = d.iter().map(|x| x * x).sum::<f64>();
                if r2 >= reach * reach {
                    continue;
                }
                let r = r2.sqrt();
                let volume = scene.rows[*j].volume;
                let (w, slope) = kernel.at(r, h, dimension);
                gamma += volume * w;
                if r > 0.0 {
                    for k in 0..3 {
                        gradient[k] += volume * slope * d[k] / r;
                    }
                }
            }
            let residual = h * gradient.iter().map(|x| x * x).sum::<f64>().sqrt();
            // Far from the origin places have fewer digits.
            let far = row.at.iter().fold(0.0_f64, |m, x| m.max(x.abs())) / scene.spacing(row);
            let slack = SAME * (1.0 + 1e-3 * far);
            if (row.gamma - gamma).abs() > slack * gamma {
                let detail = format!("{} in the file, is {gamma}: {row:?}", row.gamma);
                faults.add("gamma column", detail);
            }
            if (row.residual - residual).abs() > slack {
                let detail = format!("{} in the file, is {residual}: {row:?}", row.residual);
                faults.add("residual column", detail);
            }
        }
        columns(scene, faults);
    }
}

/// The report's figures of the columns.
fn columns(scene: &Scene<'_>, faults: &mut Faults) {
    let gammas = || {
        let own = scene.rows.iter().filter(|row| !row.is_frozen());
        own.map(|row| row.gamma)
    };
    let min = gammas().fold(f64::INFINITY, f64::min);
    let max = gammas().fold(f64::NEG_INFINITY, f64::max);
    let linf = (max - 1.0).abs().max((1.0 - min).abs());
    for (key, is) in [("min", min), ("max", max), ("linf", linf)] {
        let said = scene.figure(&["density", key]);
        if said.is_none_or(|said| (said - is).abs() > 1e-12) {
            faults.add(
                "density in the report",
                format!("{key} is {is}, report says {said:?}"),
            );
        }
    }
}
