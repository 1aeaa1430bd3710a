//! What papers 001 and 002 print of their methods, beside ours.

use sphpack::scene::Method;
use sphpack::{Outcome, Packing};
use sphpack_kernels::KernelKind;
use sphpack_packing::{Kind, Packed};

use crate::bench::Bench;
use crate::selection::Selection;
use crate::shipped::{iterations_together, load};
use crate::shown_table::ShownTable;

const VARIATION: &str = "\
| scene | ∆s | method | total variation, paper 001 | ours, all particles | ours, to ∆s inside |
|---|---|---|---|---|---|
";

/// Scene, ∆s, method, what 001 §4 prints in per cent.
const PRINTED: [(&str, f64, Method, f64); 6] = [
    ("cylinder", 0.1, Method::Standard, 8.0),
    ("cylinder", 0.1, Method::Coupled, 16.0),
    ("cylinder", 0.1, Method::Hybrid, 2.0),
    ("zigzag", 0.05, Method::Standard, 10.0),
    ("zigzag", 0.05, Method::Coupled, 30.0),
    ("zigzag", 0.05, Method::Hybrid, 3.0),
];

/// Total variations of 001's three methods.
pub(crate) fn variation(selection: &Selection) -> Result<String, String> {
    let bench = Bench::open(&[file!()])?;
    let mut table = ShownTable::new(VARIATION);
    for (name, spacing, method, printed) in PRINTED {
        if !selection.wants(name, name == "cylinder") {
            continue;
        }
        let Some(mut scene) = load(name, selection)? else {
            continue;
        };
        scene.spacing = spacing;
        scene.packing.method = method;
        scene.packing.max_iterations = iterations_together(method, scene.packing.max_iterations);
        scene.quality.kernel = Some(KernelKind::Quintic);
        scene.quality.h_over_spacing = Some(1.0);
        let [all, near] = bench.packed(&scene, variations)?;
        table.push(&format!(
            "| {name} | {spacing} | {} | {printed} % | {:.2} % | {:.2} % |\n",
            method.name(),
            100.0 * all,
            100.0 * near,
        ));
    }
    Ok(table.into_text())
}

/// max Γ − min Γ over all particles, and as [`variation_near`].
fn variations(outcome: &Outcome) -> [f64; 2] {
    let near = match &outcome.packing {
        Packing::Plane(solution) => variation_near(&solution.packed, &solution.fields.gamma),
        Packing::Space(solution) => variation_near(&solution.packed, &solution.fields.gamma),
    };
    [outcome.report.density.total_variation, near]
}

/// max Γ − min Γ over the particles outside the bodies or within ∆s of their surfaces.
pub(crate) fn variation_near<const D: usize>(packed: &Packed<D>, gamma: &[f64]) -> f64 {
    let particles = &packed.particles;
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for (i, &gamma) in gamma.iter().enumerate() {
        let is_deep = (packed.surfaces.iter()).any(|surface| {
            surface.surface.closest(particles.position[i]).distance < -0.51 * packed.spacing
        });
        if particles.kind[i] != Kind::Frozen && !is_deep {
            (least, most) = (least.min(gamma), most.max(gamma));
        }
    }
    most - least
}

const TANK: &str = "\
| tank | H/∆x | iterations (002: 2,000 to 2,500) | mean of ½u²/β below 10⁻⁸ | L∞ | residual max, mean | particles | seconds |
|---|---|---|---|---|---|---|---|
";

/// 002's tanks at rest.
pub(crate) fn tanks(selection: &Selection) -> Result<String, String> {
    let bench = Bench::open(&[file!()])?;
    let mut table = ShownTable::new(TANK);
    for (name, cells) in [
        ("trapezoid", 25.0),
        ("trapezoid", 50.0),
        ("trapezoid", 100.0),
        ("bends", 50.0),
    ] {
        if !selection.wants(name, cells == 25.0) {
            continue;
        }
        let Some(mut scene) = load(name, selection)? else {
            continue;
        };
        scene.spacing = 1.0 / cells;
        let figures = bench.packed(&scene, tank)?;
        table.push(&format!("| {name} | {cells} | {figures} |\n"));
    }
    Ok(table.into_text())
}

/// A tank's row, from its iterations on.
fn tank(outcome: &Outcome) -> String {
    let report = &outcome.report;
    format!(
        "{} | {} | {:.2} % | {:.1e}, {:.1e} | {} | {:.1}",
        report.iterations,
        report.stop_reason,
        100.0 * report.density.linf,
        report.residual.max,
        report.residual.mean,
        report.particles.fluid,
        report.seconds.total,
    )
}
