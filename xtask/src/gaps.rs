//! Gaps at trailing edges where bodies and fluid are parsed each on its own grid (004 §2.2, figs. 4, 8 and 20).

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use sphpack_geometry::{Outline, Surface};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Domain, KdTree, point};
use sphpack_packing::{
    Complex, Fields, Method, Packed, Particles, Problem, Relaxation, RunLog, Silent,
};

use crate::parsed::parsed;
use crate::selection::Selection;
use crate::workspace::root;

pub(crate) const ABOUT: &str = "
The airfoils NACA 5515 and 30P30N (its three elements read from DIR/30p30n) at ∆s = c/250, 004's kernel and h/∆s. As in
the paper a body is what a grid of distances with cells of ∆s and its origin at the body's corner keeps of it. Without
the Boolean the fluid is bounded by what another grid, with its origin at the domain's corner, keeps. The box is chosen so
that this grid is half a cell off that of the first element: where both happen to coincide, they keep the same, and
there is no gap either. With the Boolean it is bounded by the
very outline of the solid (eq. 11). The last row of each has the exact outline for both, as scenes are packed.

A hole is the distance from a place to the nearest particle, looked for within ∆s of the airfoil's surface: on a perfect
hexagonal lattice the largest is 0.62 ∆s, on a square one 0.71. Γ is summed at the same places by the quintic kernel at
h/∆s = 1.2; an even packing has 1 everywhere. \"At the trailing edge\" is within 6 ∆s of one.

So the gap is there without the Boolean, and gone with it and complex relaxation, whatever the grid has kept of the
tail: no hole is larger than a lattice's by more than a tenth of ∆s, and the sum at the trailing edge is within two per cent of 1. Separate
relaxation with the Boolean has no gap left at NACA 5515 but a deficit, \"a small void\" in the paper's words; between the
elements of 30P30N, where one surface stays ∆s from the next whatever sits there, it is as bad as without.

![Particles at the trailing edge of NACA 5515](gaps.svg)
";

const HEAD: &str = "\
| airfoil | fluid bounded by | relaxation | largest hole / ∆s: surface | trailing edge | least Γ: surface | trailing edge | \
greatest Γ |
|---|---|---|---|---|---|---|---|
";

const SPACING: f64 = 1.0 / 250.0;
const TOLERANCE: f64 = 1e-4;
const MOST_ITERATIONS: usize = 1500;

/// How far from a trailing edge still is at it, in ∆s.
const AT_EDGE: f64 = 6.0;

/// Places per ∆s where holes are looked for.
const FINENESS: f64 = 8.0;

/// An airfoil: its elements, and the box around it.
struct Airfoil {
    name: &'static str,
    elements: Vec<Outline>,
    domain: Domain<2>,
}

fn airfoils(selection: &Selection) -> Result<Vec<Airfoil>, String> {
    let around = |elements: Vec<Outline>, name| {
        let bounds = (elements.iter().skip(1))
            .fold(elements[0].bounds(), |all, one| all.union(one.bounds()))
            // Half a cell off the grid of the first element.
            .grown(20.5 * SPACING);
        let domain = Domain::new(bounds.min, bounds.max);
        Airfoil {
            name,
            elements,
            domain,
        }
    };
    let naca = Outline::naca("5515", 1.0).map_err(|error| error.to_string())?;
    let mut all = vec![around(vec![naca], "NACA 5515")];
    let folder = (selection.data.clone())
        .unwrap_or_else(|| root().join("data"))
        .join("30p30n");
    let files = [
        "airfoil_flap_front.dat",
        "airfoil_wing.dat",
        "airfoil_flap_rear.dat",
    ];
    let paths: Vec<PathBuf> = files.iter().map(|file| folder.join(file)).collect();
    if paths.iter().all(|path| path.is_file()) {
        let elements: Result<Vec<Outline>, _> = paths.iter().map(Outline::read).collect();
        all.push(around(
            elements.map_err(|error| error.to_string())?,
            "30P30N",
        ));
    }
    Ok(all)
}

/// The table; the picture where the page is written.
pub(crate) fn tables(selection: &Selection) -> Result<String, String> {
    let mut text = HEAD.to_owned();
    print!("\n{HEAD}");
    let mut panels = Vec::new();
    let all = airfoils(selection)?;
    for airfoil in &all {
        let error = |error: &dyn std::fmt::Display| format!("{}: {error}", airfoil.name);
        let seen = |origin: &dyn Fn(&Outline) -> [f64; 2]| -> Result<Vec<Outline>, String> {
            (airfoil.elements.iter())
                .map(|one| parsed(one, SPACING, origin(one)).map_err(|e| error(&e)))
                .collect()
        };
        let solid = seen(&|one| one.bounds().min)?;
        let fluid = seen(&|_| airfoil.domain.bounds.min)?;
        let relaxation = Relaxation {
            residual_tolerance: TOLERANCE,
            max_iterations: MOST_ITERATIONS,
            ..Relaxation::default()
        };
        let apart = |bodies: &[Outline]| {
            let packed = relaxation.pack(&problem(airfoil, bodies), &mut RunLog::new(&mut Silent));
            packed.map_err(|e| error(&e))
        };
        let together = |bodies: &[Outline]| {
            let complex = Complex {
                relaxation,
                ..Complex::default()
            };
            let packed = complex.pack(&problem(airfoil, bodies), &mut RunLog::new(&mut Silent));
            packed.map_err(|e| error(&e))
        };
        let with = apart(&solid)?;
        let rows: [(&str, &str, Particles<2>); 4] = [
            ("its own grid", "separate", joined(&with, &apart(&fluid)?)),
            ("the solid's outline", "separate", with.particles),
            (
                "the solid's outline",
                "complex",
                together(&solid)?.particles,
            ),
            (
                "the exact outline",
                "complex",
                together(&airfoil.elements)?.particles,
            ),
        ];
        for (boundary, method, particles) in rows {
            let figures = Figures::of(airfoil, &particles);
            let line = format!(
                "| {} | {boundary} | {method} | {:.2} | {:.2} | {:.3} | {:.3} | {:.3} |\n",
                airfoil.name,
                figures.hole[0],
                figures.hole[1],
                figures.least[0],
                figures.least[1],
                figures.greatest,
            );
            print!("{line}");
            text.push_str(&line);
            if panels.len() < 3 {
                panels.push((format!("{method}, fluid bounded by {boundary}"), particles));
            }
        }
    }
    if all.len() < 2 {
        text.push_str("| 30P30N | no data | | | | | | |\n");
    }
    if selection.write {
        let path = root().join("docs/gaps.svg");
        fs::write(&path, picture(&all[0], &panels))
            .map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(text)
}

fn problem(airfoil: &Airfoil, bodies: &[Outline]) -> Problem<2> {
    let mut problem = Problem::new(airfoil.domain, SPACING);
    for (number, body) in bodies.iter().enumerate() {
        problem = problem.body(&format!("element {number}"), body.clone());
    }
    (problem.kernel, problem.h_over_spacing) = (KernelKind::WendlandC2, 1.3);
    problem
}

/// The solids of one packing in the fluid of another.
fn joined(solids: &Packed<2>, fluid: &Packed<2>) -> Particles<2> {
    let mut all = Particles::new(fluid.particles.sizes.clone());
    for (of, wants_solids) in [(&solids.particles, true), (&fluid.particles, false)] {
        for i in (0..of.len()).filter(|&i| of.body[i].is_some() == wants_solids) {
            all.push(of.position[i], of.kind[i], of.volume[i], of.body[i]);
        }
    }
    all
}

/// Holes and sums within ∆s of the surface, and of these within [`AT_EDGE`] ∆s of a trailing edge.
struct Figures {
    hole: [f64; 2],
    least: [f64; 2],
    greatest: f64,
}

impl Figures {
    fn of(airfoil: &Airfoil, particles: &Particles<2>) -> Self {
        let step = SPACING / FINENESS;
        let mut places: Vec<([f64; 2], bool)> = Vec::new();
        let edges: Vec<[f64; 2]> = airfoil.elements.iter().map(trailing_edge).collect();
        for element in &airfoil.elements {
            let bounds = element.bounds().grown(SPACING);
            let count = bounds.size().map(|size| (size / step) as usize);
            for n in 0..count[0] * count[1] {
                let p = [
                    bounds.min[0] + step * (n % count[0]) as f64,
                    bounds.min[1] + step * (n / count[0]) as f64,
                ];
                if element.closest_within(p, SPACING).is_some() {
                    let is_near = |edge: &[f64; 2]| point::distance(p, *edge) < AT_EDGE * SPACING;
                    places.push((p, edges.iter().any(is_near)));
                }
            }
        }
        let mut positions = particles.position.clone();
        let mut volumes = particles.volume.clone();
        positions.extend(places.iter().map(|(p, _)| *p));
        volumes.resize(positions.len(), 0.0);
        let first = particles.len();
        let fields = Fields::measure(
            &airfoil.domain,
            &positions,
            &volumes,
            |i| i >= first,
            KernelKind::Quintic,
            1.2 * SPACING,
        );
        let tree = KdTree::new(&particles.position).ok();
        let mut figures = Self {
            hole: [0.0; 2],
            least: [f64::INFINITY; 2],
            greatest: 0.0,
        };
        for (k, (p, is_at_edge)) in places.iter().enumerate() {
            let hit = tree.as_ref().and_then(|tree| tree.nearest(*p));
            let hole = hit.map_or(f64::NAN, |hit| hit.distance / SPACING);
            let gamma = fields.gamma[first + k];
            for n in 0..=usize::from(*is_at_edge) {
                figures.hole[n] = figures.hole[n].max(hole);
                figures.least[n] = figures.least[n].min(gamma);
            }
            figures.greatest = figures.greatest.max(gamma);
        }
        figures
    }
}

/// The rearmost point of an element.
fn trailing_edge(element: &Outline) -> [f64; 2] {
    let rearmost = element.points().iter().max_by(|a, b| a[0].total_cmp(&b[0]));
    rearmost.copied().unwrap_or_default()
}

/// Half the width of a panel in ∆s, and pixels per ∆s.
const HALF: [f64; 2] = [8.0, 6.0];
const PIXELS: f64 = 20.0;

/// The packings around the trailing edge, side by side.
fn picture(airfoil: &Airfoil, panels: &[(String, Particles<2>)]) -> String {
    let edge = trailing_edge(&airfoil.elements[0]);
    let middle = [edge[0] - 3.0 * SPACING, edge[1]];
    let [width, height] = HALF.map(|half| 2.0 * half * PIXELS);
    let at = |p: [f64; 2]| {
        [
            ((p[0] - middle[0]) / SPACING + HALF[0]) * PIXELS,
            (HALF[1] - (p[1] - middle[1]) / SPACING) * PIXELS,
        ]
    };
    let whole = (width + 12.0) * panels.len() as f64;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {whole} {}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"{whole}\" height=\"{}\" fill=\"white\"/>\n",
        height + 28.0,
        height + 28.0
    );
    for (n, (title, particles)) in panels.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<svg x=\"{}\" y=\"28\" width=\"{width}\" height=\"{height}\"><rect width=\"{width}\" height=\"{height}\" fill=\"#f4f4f4\"/>",
            (width + 12.0) * n as f64
        );
        let way: Vec<String> = (airfoil.elements[0].points().iter())
            .map(|p| at(*p))
            .filter(|p| p[0] > -width && p[0] < 2.0 * width)
            .map(|p| format!("{:.1} {:.1}", p[0], p[1]))
            .collect();
        let _ = writeln!(
            out,
            "<path d=\"M{}\" fill=\"none\" stroke=\"black\"/>",
            way.join("L")
        );
        for i in 0..particles.len() {
            let p = at(particles.position[i]);
            if (-9.0..width + 9.0).contains(&p[0]) && (-9.0..height + 9.0).contains(&p[1]) {
                let is_solid = particles.body[i].is_some();
                let _ = writeln!(
                    out,
                    "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"8\" fill=\"{}\"/>",
                    p[0],
                    p[1],
                    if is_solid { "#d55e00" } else { "#56b4e9" }
                );
            }
        }
        let _ = writeln!(
            out,
            "</svg><text x=\"{}\" y=\"18\">{title}</text>",
            (width + 12.0) * n as f64 + 4.0
        );
    }
    out.push_str("</svg>\n");
    out
}
