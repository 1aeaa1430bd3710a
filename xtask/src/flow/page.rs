//! docs/flow.md.

use super::Found;
use super::finding::{Change, Findings, Row};
use crate::workspace;

const ROWS: &str = "\
| | published | bar | ours | |
|---|---|---|---|---|
";

const CHANGES: &str = "\
| | clipped | packed | ratio |
|---|---|---|---|
";

/// A case's tables.
pub(super) fn tables(found: &Findings) -> String {
    let mut out = ROWS.to_owned();
    out.extend(found.rows.iter().map(Row::line));
    if !found.changes.is_empty() {
        out += "\n";
        out += CHANGES;
        out.extend(found.changes.iter().map(Change::line));
    }
    out + "\n"
}

const ABOUT: &str = "\
# Flows: what a packing changes

Regenerate with `cargo xtask flow --write`. The schemes are `flow/`'s: EDAC with transport velocity (Ramachandran & Puri 2019), and standard
weakly compressible SPH with a free surface (Monaghan 2005); quintic spline, h/∆s = 1.2, C = 0.4, c = 10 U. A case runs unchanged from
every packing; *clipped* is the square lattice, clipped by the body.

";

/// What is to be known of a case.
fn about(case: &str) -> &'static str {
    match case {
        "taylor-green" => {
            "## Taylor–Green vortices\n\n\
             EDAC in a periodic unit box, c = 10, mean of the error at t = 0.1, 0.2, …, 2.5. *balanced* is packed around a circle of radius 0.2,\n\
             and what is in it is fluid too. A straight lattice is the worst start of a run that moves particles: stagnation\n\
             lines string them up.\n\n"
        }
        "couette" => {
            "## 000's Taylor–Couette flow\n\n\
             EDAC, a = 0.25 turning once in 2π, b = 0.5 at rest, ν = 0.2, c = 2.5; over the last third of t = 3. The shaft's particles turn; fluid sees the\n\
             speed of the shaft's surface. The paper has pictures of two packings and no number.\n\n"
        }
        "drop" => {
            "## 002's elliptical drop\n\n\
             Standard scheme, α = 0.01; R = A₀ = ρ = 1, velocities (A₀x, −A₀y), the pressure of the theory. Semi-axes are 2√⟨x²⟩ and\n\
             2√⟨y²⟩. The paper has pictures and no number.\n\n"
        }
        "tank" => {
            "## 002's trapezoidal tank\n\n\
             Standard scheme, α = 0.02; corners (0, 0), (2, 0), (3, 1), (0, 1), c = 10 √(gH), pressure and density by the weight above, the lid off at\n\
             t = 0. Walls are the same four layers of dummy particles for all. Times are in √(H/g). What moves is the packing's doing.\n\n"
        }
        _ => {
            "## Speed\n\n\
             Whole steps, one thread, seconds that the thread had a core for; 160² particles from a shaken lattice, lists included.\n\n"
        }
    }
}

/// Writes the page and its pictures.
pub(super) fn write(all: &[Found]) -> Result<(), String> {
    let mut text = ABOUT.to_owned();
    for (case, found) in all {
        text += about(case);
        text += &tables(found);
        for (name, chart) in &found.charts {
            workspace::write(&format!("docs/{name}.svg"), &chart.svg())?;
            text += &format!("![{}]({name}.svg)\n\n", chart.title);
        }
    }
    workspace::write("docs/flow.md", &format!("{}\n", text.trim_end()))
}
