//! What paper 004 shows of its methods: density, and the fluid's first layer at the interface.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};
use sphpack::scene::Method;
use sphpack::{Outcome, Packing, Scene, Solution};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::point;
use sphpack_packing::{Fields, Kind, Lattice, Relaxation};

use crate::bench::Bench;
use crate::rest::at_rest;
use crate::selection::Selection;
use crate::shipped::load;
use crate::shown_table::ShownTable;

pub(crate) const ABOUT: &str = "Density by each side's own kernel and h, as
the paper has them: Wendland's C2 at h/∆s = 1.05 in solids and 1.3 in the fluid, over Γ₀ of the lattice that rests
there. KGS is 004 eq. 13 over all particles, of the fluid within ∆s of a body; kinetic energy 004 eq. 14 of the same
at one ∆t. The balanced method, which packs by the quintic kernel, stands beside for what the measure itself allows.

The paper's colours span ±0.4 %, of separate and complex relaxation alike. As its text has them, without levelling,
neither stays within that by Wendland's C2, and the last table says why: with this kernel what is no perfect lattice
rests unevenly, whether there is a body or not, and at 1.05 not even the hexagonal lattice is stable. So an even density
and a vanishing KGS cannot both be had. Levelling, on unless `levelling = 0`, gives up some of the one for the other:
it takes what density needs from the layers behind the first, which it keeps calm. Then both sides stay within
the paper's range, and the first layer's KGS stays below that of separate relaxation. Kinetic energy, of the background
pressure alone, falls toward zero in complex relaxation, levelled or not, and stays high in separate. The last rows are
where levelling fails: in a tail thinner than 2 ∆s every solid particle is a surface particle, and these are held.
";

const HEAD: &str = "\
| scene | ∆s | method | Γ/Γ₀ − 1, own kernel and h: solid | fluid | L∞ by the quintic | \
first fluid layer: h KGS max, mean | its kinetic energy, end / start | iterations | |
|---|---|---|---|---|---|---|---|---|---|
";

/// Scenes and spacings; three of each where the paper has curves for three, and a tail thinner than ∆s.
const ROWS: [(&str, f64); 8] = [
    ("cylinder", 0.1),
    ("starfish", 0.1),
    ("starfish", 0.075),
    ("starfish", 0.05),
    ("zigzag", 0.1),
    ("zigzag", 0.05),
    ("zigzag", 0.025),
    ("naca0015", 0.02),
];

/// Methods, and their levelling.
const WAYS: [(Method, Option<f64>); 4] = [
    (Method::Relaxation, None),
    (Method::Complex, Some(0.0)),
    (Method::Complex, None),
    (Method::Balanced, None),
];

/// The paper stops after a number of steps that it does not print; these come to rest as far as they do.
const TOLERANCE: f64 = 1e-4;
const MOST_ITERATIONS: usize = 4000;

/// The paper's kernel, and h/∆s in the fluid; in solids it is [`Relaxation::solid_h_over_spacing`].
const KERNEL: KernelKind = KernelKind::WendlandC2;
const FLUID_H: f64 = 1.3;

/// Separate relaxation, complex relaxation, plain and levelled, and our balanced method, judged alike.
pub(crate) fn interface(selection: &Selection) -> Result<String, String> {
    let bench = Bench::open(&[file!()])?;
    let mut table = ShownTable::new(HEAD);
    let mut factors = String::new();
    for (name, spacing) in ROWS {
        if !selection.wants(name, name == "cylinder") {
            continue;
        }
        let mut layers = Vec::new();
        for (method, levelling) in WAYS {
            let way = (method, levelling);
            let Some(scene) = scene(name, spacing, way, MOST_ITERATIONS, selection)? else {
                continue;
            };
            let Some(figures) = bench.packed(&scene, Figures::of)? else {
                continue;
            };
            let mut energy = "–".to_owned();
            if method != Method::Balanced {
                let begin = self::scene(name, spacing, way, 0, selection)?.unwrap_or(scene);
                let begin = bench.packed(&begin, Figures::of)?;
                let begin = begin.map_or(f64::NAN, |begin| begin.energy);
                energy = format!("{:.1e}", figures.energy / begin);
                layers.push(figures.layer);
            }
            let [solid, fluid] = figures.density;
            let percent = |x: f64| 100.0 * x;
            table.push(&format!(
                "| {name} | {spacing} | {} | {:+.2} … {:+.2} % | {:+.2} … {:+.2} % | {:.2} % | {:.1e}, {:.1e} | {energy} | {} |\n",
                if levelling == Some(0.0) {
                    format!("{}, levelling 0", method.name())
                } else {
                    method.name().to_owned()
                },
                percent(solid[0]),
                percent(solid[1]),
                percent(fluid[0]),
                percent(fluid[1]),
                percent(figures.quintic),
                figures.layer[0],
                figures.layer[1],
                figures.end,
            ));
        }
        if let [separate, plain, levelled] = layers[..] {
            let _ = write!(
                factors,
                "{}{name} {spacing}: {:.0} and {:.0}, levelled {:.1} and {:.1}",
                if factors.is_empty() { "" } else { "; " },
                separate[0] / plain[0],
                separate[1] / plain[1],
                separate[0] / levelled[0],
                separate[1] / levelled[1],
            );
        }
    }
    let factors = format!(
        "Complex relaxation lowers the layer's KGS by these factors, maximum and mean: {factors}.\n"
    );
    println!("\n{factors}");
    let rest = at_rest()?;
    Ok(format!("{}\n{factors}\n{rest}", table.into_text()))
}

/// A scene by a method; `None` where its body is not there.
fn scene(
    name: &str,
    spacing: f64,
    (method, levelling): (Method, Option<f64>),
    most: usize,
    selection: &Selection,
) -> Result<Option<Scene>, String> {
    let Some(mut scene) = load(name, selection)? else {
        return Ok(None);
    };
    scene.spacing = spacing;
    scene.packing.method = method;
    scene.packing.levelling = levelling;
    if method != Method::Balanced {
        scene.packing.residual_tolerance = Some(TOLERANCE);
        scene.packing.max_iterations = most;
    }
    Ok(Some(scene))
}

/// What is judged.
#[derive(Debug, Serialize, Deserialize)]
struct Figures {
    /// Least and largest Γ/Γ₀ − 1 of the solids' particles and of the fluid's, by their own kernel and h.
    density: [[f64; 2]; 2],
    /// Largest |Γ − 1| by the quintic kernel at h/∆s = 1.2.
    quintic: f64,
    /// Largest and mean h |Σ V ∇W| of the fluid within ∆s of a body (004's KGS, eq. 13).
    layer: [f64; 2],
    /// Σ V |Σ V ∇W|² of these: eq. 14 at a fixed ∆t, but for a factor.
    energy: f64,
    /// Iterations, and why there were no more.
    end: String,
}

impl Figures {
    /// Of a packing in the plane.
    fn of(outcome: &Outcome) -> Option<Self> {
        let report = &outcome.report;
        let end = format!("{} | {}", report.iterations, report.stop_reason);
        match &outcome.packing {
            Packing::Plane(solution) => Some(Self::of_plane(solution, end)),
            Packing::Space(_) => None,
        }
    }

    fn of_plane(solution: &Solution<2>, end: String) -> Self {
        let (packed, bodies) = (&solution.packed, &solution.problem.bodies);
        let particles = &packed.particles;
        let solid_h = Relaxation::default().solid_h_over_spacing;
        let by = [solid_h, FLUID_H].map(|h| {
            let fields: Fields<2> = packed.fields(KERNEL, h);
            (fields, Lattice::auto(2, KERNEL, h).gamma(KERNEL, h))
        });
        let quintic = packed.fields(KernelKind::Quintic, 1.2);
        let mut figures = Self {
            density: [[f64::INFINITY, f64::NEG_INFINITY]; 2],
            quintic: 0.0,
            layer: [0.0; 2],
            energy: 0.0,
            end,
        };
        let mut count = 0;
        for i in (0..particles.len()).filter(|&i| particles.kind[i] != Kind::Frozen) {
            let p = particles.position[i];
            let is_fluid = particles.body[i].is_none();
            let (fields, lattice) = &by[usize::from(is_fluid)];
            let off = fields.gamma[i] / lattice - 1.0;
            let [low, high] = &mut figures.density[usize::from(is_fluid)];
            (*low, *high) = (low.min(off), high.max(off));
            figures.quintic = figures.quintic.max((quintic.gamma[i] - 1.0).abs());
            let is_near = |surface: f64| surface < packed.spacing;
            let is_first = (bodies.iter()).any(|body| is_near(body.surface.closest(p).distance));
            if is_fluid && is_first {
                let residual = fields.residual(i);
                figures.layer[0] = figures.layer[0].max(residual);
                figures.layer[1] += residual;
                figures.energy +=
                    particles.volume[i] * point::dot(fields.gradient[i], fields.gradient[i]);
                count += 1;
            }
        }
        figures.layer[1] /= f64::from(count.max(1));
        figures
    }
}
