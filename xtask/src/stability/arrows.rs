//! The unstable wave of a lattice, drawn: where it carries each site.

use std::fmt::Write as _;

use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Odometer, point};
use sphpack_packing::Lattice;

use super::ink::{begin, digits};
use crate::crystal::Crystal;

/// A few that are typical.
const CASES: [(Lattice, KernelKind, f64); 6] = [
    (Lattice::Square, KernelKind::Quintic, 1.1),
    (Lattice::Hexagonal, KernelKind::Quintic, 1.3),
    (Lattice::SimpleCubic, KernelKind::Quintic, 1.1),
    (Lattice::Bcc, KernelKind::Quintic, 1.3),
    (Lattice::Fcc, KernelKind::Quintic, 1.2),
    (Lattice::Hcp, KernelKind::Quintic, 1.2),
];

/// How much of a lattice is drawn, in ∆s, and how large.
const WINDOW: f64 = 9.0;
const SCALE: f64 = 31.0;

/// The longest arrow, in ∆s.
const LONGEST: f64 = 0.6;

const PANEL: [f64; 2] = [330.0, 372.0];

struct Drawn {
    title: String,
    about: String,
    /// Sites, and where arrows end.
    arrows: Vec<[[f64; 2]; 2]>,
}

/// The waves on one sheet.
pub(super) fn svg(is_quick: bool) -> Result<String, String> {
    let cases = if is_quick { &CASES[..1] } else { &CASES[..] };
    let drawn: Vec<Drawn> = cases
        .iter()
        .map(|&(lattice, kernel, h)| {
            if lattice.dimension() == 2 {
                wave::<2>(lattice, kernel, h)
            } else {
                wave::<3>(lattice, kernel, h)
            }
        })
        .collect::<Result<_, _>>()?;
    let rows = drawn.len().div_ceil(3);
    let (width, height) = (3.0 * PANEL[0] + 20.0, 44.0 + rows as f64 * PANEL[1]);
    let mut out = begin(
        width,
        height,
        "The wave that grows fastest, on the sites of one layer",
    );
    for (i, drawn) in drawn.iter().enumerate() {
        let corner = [
            16.0 + (i % 3) as f64 * PANEL[0],
            40.0 + (i / 3) as f64 * PANEL[1],
        ];
        drawn.draw(&mut out, corner);
    }
    out.push_str("</svg>\n");
    Ok(out)
}

fn wave<const D: usize>(lattice: Lattice, kernel: KernelKind, h: f64) -> Result<Drawn, String> {
    let crystal = Crystal::<D>::new(lattice, kernel, h);
    let extremes = crystal.extremes()?;
    let k = crystal.cell.shortest(extremes.softest);
    let modes = crystal.modes(k)?;
    let mode = modes.first().ok_or("a lattice has waves")?;
    let cell = lattice.unit_cell::<D>();
    let edges = cell.cell();
    // Enough unit cells about the origin.
    let far = edges.map(|edge| (WINDOW / edge).ceil() as i64);
    let sites: Vec<[f64; D]> = Odometer::new(far.map(|n| -n), far.map(|n| n + 1))
        .flat_map(|n| {
            let shift: [f64; D] = std::array::from_fn(|axis| n[axis] as f64 * edges[axis]);
            cell.sites()
                .into_iter()
                .map(move |site| point::add(site, shift))
        })
        .collect();
    let field = crystal.field(mode, &sites);
    let power = |axis: usize| field.iter().map(|way| way[axis] * way[axis]).sum::<f64>();
    // The plane in which sites move, one layer of it.
    let left_out = (0..D).min_by(|a, b| power(*a).total_cmp(&power(*b)));
    let left_out = left_out.filter(|_| D == 3);
    let axes: Vec<usize> = (0..D).filter(|axis| Some(*axis) != left_out).collect();
    let layer = left_out.map_or(0.0, |axis| cell.sites()[0][axis]);
    let longest = field
        .iter()
        .map(|way| point::norm(*way))
        .fold(0.0, f64::max);
    let arrows = (sites.iter().zip(&field))
        .filter(|(site, _)| left_out.is_none_or(|axis| (site[axis] - layer).abs() < 0.1))
        .map(|(site, way)| {
            let from = [site[axes[0]], site[axes[1]]];
            let by = [way[axes[0]], way[axes[1]]];
            [from, point::add_scaled(from, LONGEST / longest, by)]
        })
        .filter(|[from, _]| from.iter().all(|x| x.abs() <= 0.5 * WINDOW))
        .collect();
    let named: Vec<String> = k.iter().map(|k| digits(*k)).collect();
    let plane: String = axes.iter().map(|axis| ["x", "y", "z"][*axis]).collect();
    Ok(Drawn {
        title: format!("{lattice}, {kernel}, h/∆s = {h}"),
        about: format!(
            "{plane} plane; k ∆s = ({}), length {:.1} ∆s",
            named.join(", "),
            std::f64::consts::TAU / point::norm(k)
        ),
        arrows,
    })
}

impl Drawn {
    fn draw(&self, out: &mut String, corner: [f64; 2]) {
        let edge = WINDOW * SCALE;
        let middle = [corner[0] + 0.5 * edge, corner[1] + 56.0 + 0.5 * edge];
        let at = |p: [f64; 2]| [middle[0] + SCALE * p[0], middle[1] - SCALE * p[1]];
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-weight=\"bold\">{}</text><text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\">{}</text>",
            corner[0],
            corner[1] + 14.0,
            self.title,
            corner[0],
            corner[1] + 31.0,
            self.about
        );
        let (mut dots, mut way) = (String::new(), String::new());
        for [from, to] in &self.arrows {
            let [a, b] = [at(*from), at(*to)];
            let _ = write!(dots, "M{:.1} {:.1}h.01", a[0], a[1]);
            let along = point::sub(b, a);
            let length = point::norm(along);
            if length < 1.5 {
                continue;
            }
            let head = (0.4 * length).min(6.0) / length;
            let [x, y] = along;
            let [left, right] = [1.0, -1.0].map(|side| {
                [
                    b[0] - head * (x + 0.6 * side * y),
                    b[1] - head * (y - 0.6 * side * x),
                ]
            });
            let _ = write!(
                way,
                "M{:.1} {:.1}L{:.1} {:.1}M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}",
                a[0], a[1], b[0], b[1], left[0], left[1], b[0], b[1], right[0], right[1]
            );
        }
        let _ = writeln!(
            out,
            "<path d=\"{dots}\" stroke=\"#999\" stroke-width=\"6\" stroke-linecap=\"round\"/><path d=\"{way}\" stroke=\"#b33000\" stroke-width=\"1.6\" fill=\"none\"/>"
        );
    }
}
