//! What paper 004 shows of its methods: density by their own kernel, and the fluid's first layer at the interface.

use std::fmt::Write as _;

use sphpack::scene::Method;
use sphpack::{Options, Outcome, Packing, run as pack};
use sphpack_packing::{Kind, Silent};

use crate::reproduce::{Settings, load};

const HEAD: &str = "\
| scene | ∆s | method | tolerance | Γ/Γ₀ − 1 | of the fluid | first fluid layer, h Σ V ∇W max, mean | iterations | |
|---|---|---|---|---|---|---|---|---|
";

/// Scene, ∆s, the residual tolerance.
const ROWS: [(&str, f64, f64); 5] = [
    ("cylinder", 0.1, 1e-3),
    ("starfish", 0.075, 1e-3),
    ("starfish", 0.075, 1e-4),
    ("zigzag", 0.05, 1e-3),
    ("zigzag", 0.05, 1e-4),
];

/// Separate and complex relaxation, judged by the kernel and h/∆s of the fluid, all particles seen.
pub(crate) fn interface(settings: &Settings) -> Result<String, String> {
    let mut table = HEAD.to_owned();
    print!("\n{HEAD}");
    for (name, spacing, tolerance) in ROWS {
        if !settings.wants(name, name == "cylinder") {
            continue;
        }
        for method in [Method::Relaxation, Method::Complex] {
            let Some(mut scene) = load(name, settings)? else {
                continue;
            };
            scene.spacing = spacing;
            scene.packing.method = method;
            scene.packing.residual_tolerance = Some(tolerance);
            let (kernel, h) = method.kernel();
            scene.quality.kernel = Some(kernel);
            scene.quality.h_over_spacing = Some(h);
            let outcome = pack(&scene, &Options::default(), &mut Silent)
                .map_err(|error| error.to_string())?;
            let [low, high, fluid_low, fluid_high, max, mean] = figures(&outcome);
            let mut line = String::new();
            // Writing to a string cannot fail.
            let _ = writeln!(
                line,
                "| {name} | {spacing} | {} | {tolerance:e} | {:+.2} … {:+.2} % | {:+.2} … {:+.2} % | {max:.1e}, {mean:.1e} | {} | {} |",
                method.name(),
                100.0 * low,
                100.0 * high,
                100.0 * fluid_low,
                100.0 * fluid_high,
                outcome.report.iterations,
                outcome.report.stop_reason,
            );
            print!("{line}");
            table.push_str(&line);
        }
    }
    Ok(table)
}

/// Least and largest Γ/Γ₀ − 1, of all and of the fluid; largest and mean h |Σ V ∇W| of the fluid ∆s/2 to 3∆s/2 outside.
fn figures(outcome: &Outcome) -> [f64; 6] {
    let Packing::Plane(solution) = &outcome.packing else {
        return [f64::NAN; 6];
    };
    let (packed, bodies) = (&solution.packed, &solution.problem.bodies);
    let [mut low, mut high, mut fluid_low, mut fluid_high] = [
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ];
    let (mut max, mut sum, mut count): (f64, f64, usize) = (0.0, 0.0, 0);
    for i in (0..packed.particles.len()).filter(|&i| packed.particles.kind[i] != Kind::Frozen) {
        let off = solution.fields.gamma[i] / solution.quality.density.lattice - 1.0;
        (low, high) = (low.min(off), high.max(off));
        if packed.particles.body[i].is_some() {
            continue;
        }
        (fluid_low, fluid_high) = (fluid_low.min(off), fluid_high.max(off));
        let p = packed.particles.position[i];
        let distance = (bodies.iter())
            .map(|body| body.surface.closest(p).distance / packed.spacing)
            .fold(f64::INFINITY, f64::min);
        if distance < 1.5 {
            let residual = solution.fields.residual(i);
            max = max.max(residual);
            sum += residual;
            count += 1;
        }
    }
    [
        low,
        high,
        fluid_low,
        fluid_high,
        max,
        sum / count.max(1) as f64,
    ]
}
