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

Regenerate with `cargo xtask flow --write`. The schemes are `flow/`'s: EDAC with transport velocity (Ramachandran & Puri 2019), standard
weakly compressible SPH with a free surface (Monaghan 2005), and an Eulerian scheme whose particles stay; quintic spline, h/∆s = 1.2, C = 0.4, c = 10 U. A case runs unchanged from
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
        "cylinder" => {
            "## 000's cylinder at Re 200\n\n\
             EDAC, D = 2, ν = 0.01; the box is periodic both ways, and a fringe of 1.75 D at its end makes the stream uniform again, where the\n\
             paper has an inlet, an outlet and sides to slip along. Behind the body the stream is pushed aside at the beginning. Numbers are of\n\
             U t/R > 42 (000's box: 75 … 150). Fluid around the body is a lattice in both; speed and pressure at the true surface are Shepard\n\
             sums over fluid and walls, of 360 points, every 50 steps.\n\n"
        }
        "airfoil" => {
            "## 000's NACA0015\n\n\
             EDAC, chord 2 without incidence, ν = 0.01, box of 10 × 6 chords, otherwise as the cylinder; numbers are of 26 < t < 46. The paper has\n\
             pictures of particles and no number. By symmetry there is no lift.\n\n"
        }
        "wing" => {
            "## 004's NACA5515\n\n\
             Eulerian, Re 420, 5° of incidence, c = 10 U, C = 0.25, box of 5 × 3 chords, periodic both ways with a fringe of one chord; the stream begins\n\
             as sin² within t = 1. Means are of 4 < t < 8. With L₀ = 0, as published, pressures that alternate from particle to particle are not damped. The paper's\n\
             spacing is c/250, and its curves are drawn only.\n\n"
        }
        "drop" => {
            "## 002's elliptical drop\n\n\
             Standard scheme, α = 0.01; R = A₀ = ρ = 1, velocities (A₀x, −A₀y), the pressure of the theory. Semi-axes are 2√⟨x²⟩ and\n\
             2√⟨y²⟩. The paper has pictures and no number.\n\n"
        }
        "tank" => {
            "## 002's trapezoidal tank\n\n\
             Standard scheme, α = 0.02; corners (0, 0), (2, 0), (3, 1), (0, 1), c = 10 √(gH), pressure and density by the weight above, the lid off at\n\
             t = 0. Walls are the same four layers of dummy particles for all. Times are in √(H/g). What moves is the packing's doing.\n\
             *Settled by itself* is the clipped lattice after 10,000 steps with du/dt −= κu, κ = 10⁻³ c/∆s, from which it is freed at t = 0.\n\n"
        }
        "hull" => {
            "## 002's hull, afloat\n\n\
             Standard scheme as for the tank; water 4 wide and 1 deep, a section of beam 1 and draught 0.5 with rounded edges, its mass what it displaces,\n\
             its centre of mass 0.3 above the keel, free to heave, drift and roll for 20 √(H/g). The paper has a picture and no dimensions.\n\n"
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
