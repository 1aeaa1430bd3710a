//! Gaps at trailing edges where bodies and fluid are parsed each on its own grid (004 §2.2, figs. 4, 8 and 20).

use std::fmt::Write as _;

use sphpack_packing::Particles;

use crate::drawing;
use crate::relaxed_airfoils::{Airfoil, Figures, SPACING, Way, airfoils, trailing_edge};
use crate::selection::Selection;
use crate::shown_table::ShownTable;
use crate::workspace::write;

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

/// The table; the picture where the page is written.
pub(crate) fn tables(selection: &Selection) -> Result<String, String> {
    let mut table = ShownTable::new(HEAD);
    let mut panels = Vec::new();
    let all = airfoils(selection)?;
    for airfoil in &all {
        for way in Way::ALL {
            let particles = airfoil.relaxed(way)?;
            let (boundary, method) = (way.boundary(), way.relaxation());
            let figures = Figures::of(airfoil, &particles);
            table.push(&format!(
                "| {} | {boundary} | {method} | {:.2} | {:.2} | {:.3} | {:.3} | {:.3} |\n",
                airfoil.name,
                figures.hole[0],
                figures.hole[1],
                figures.least[0],
                figures.least[1],
                figures.greatest,
            ));
            if panels.len() < 3 {
                panels.push((format!("{method}, fluid bounded by {boundary}"), particles));
            }
        }
    }
    if all.len() < 2 {
        table.push("| 30P30N | no data | | | | | | |\n");
    }
    if selection.write {
        write("docs/gaps.svg", &picture(&all[0], &panels))?;
    }
    Ok(table.into_text())
}

/// Half the width of a panel in ∆s, and pixels per ∆s.
const HALF: [f64; 2] = [8.0, 6.0];
const PIXELS: f64 = 20.0;

/// Room for the titles above the panels, and for what marks mean below them.
const HEAD_ROOM: f64 = 28.0;
const FOOT_ROOM: f64 = 30.0;

/// Solid and fluid particles.
const COLOURS: [&str; 2] = ["#d55e00", "#56b4e9"];

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
    let mut out = drawing::begin(whole, height + HEAD_ROOM + FOOT_ROOM);
    for (n, (title, particles)) in panels.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<svg x=\"{}\" y=\"{HEAD_ROOM}\" width=\"{width}\" height=\"{height}\"><rect width=\"{width}\" height=\"{height}\" fill=\"#f4f4f4\"/>",
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
                    COLOURS[usize::from(!is_solid)]
                );
            }
        }
        let _ = writeln!(
            out,
            "</svg><text x=\"{}\" y=\"18\">{title}</text>",
            (width + 12.0) * n as f64 + 4.0
        );
    }
    let y = height + HEAD_ROOM + 17.0;
    for (x, colour, words) in [(12.0, COLOURS[0], "solid"), (90.0, COLOURS[1], "fluid")] {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"8\" fill=\"{colour}\"/><text x=\"{}\" y=\"{}\">{words}</text>",
            x + 14.0,
            y + 4.5
        );
    }
    let end = 170.0 + 2.0 * PIXELS;
    let _ = writeln!(
        out,
        "<path d=\"M170 {y}H{end}M170 {}v8M{end} {}v8\" stroke=\"black\"/><text x=\"{}\" y=\"{}\">2 ∆s</text>",
        y - 4.0,
        y - 4.0,
        end + 8.0,
        y + 4.5
    );
    out.push_str("</svg>\n");
    out
}
