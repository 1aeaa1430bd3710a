//! The Brillouin zone: the least eigenvalue of every wave.

use std::f64::consts::PI;
use std::fmt::Write as _;

use rayon::prelude::*;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::point;
use sphpack_packing::Lattice;

use super::ink::{WAVES, begin, digits, tiles};
use crate::crystal::Crystal;

/// A few that are typical.
const CASES: [(Lattice, KernelKind, f64); 6] = [
    (Lattice::Square, KernelKind::Quintic, 1.1),
    (Lattice::Hexagonal, KernelKind::Quintic, 1.2),
    (Lattice::Hexagonal, KernelKind::Quintic, 1.3),
    (Lattice::SimpleCubic, KernelKind::Quintic, 1.1),
    (Lattice::Bcc, KernelKind::Quintic, 1.3),
    (Lattice::Hcp, KernelKind::Quintic, 1.2),
];

/// Tiles along an edge, their size, and how far the map goes, in 1/∆s.
const TILES: usize = 56;
const TILE: f64 = 5.0;
const REACH: f64 = 4.5;

/// Corners nearer than this are one.
const SAME: f64 = 1e-6;

/// A panel with its axes.
const PANEL: [f64; 2] = [340.0, 366.0];

struct Map {
    title: String,
    rows: Vec<Vec<f64>>,
    softest: [f64; 2],
    is_stable: bool,
    /// The corners of the zone, in the plane.
    outline: Vec<[f64; 2]>,
}

/// The maps on one sheet.
pub(super) fn svg(is_quick: bool) -> Result<String, String> {
    let cases = if is_quick { &CASES[..1] } else { &CASES[..] };
    let maps: Vec<Map> = cases
        .iter()
        .map(|&(lattice, kernel, h)| {
            if lattice.dimension() == 2 {
                map::<2>(lattice, kernel, h)
            } else {
                map::<3>(lattice, kernel, h)
            }
        })
        .collect::<Result<_, _>>()?;
    let rows = maps.len().div_ceil(3);
    let (width, height) = (3.0 * PANEL[0] + 20.0, 96.0 + rows as f64 * PANEL[1]);
    let mut out = begin(width, height, "Waves of lattices: which grow, which swing");
    let below = 50.0 + WAVES.legend(&mut out, [16.0, 50.0], width - 32.0);
    for (i, map) in maps.iter().enumerate() {
        let corner = [
            (i % 3) as f64 * PANEL[0],
            below + 6.0 + (i / 3) as f64 * PANEL[1],
        ];
        map.draw(&mut out, corner);
    }
    out.push_str("</svg>\n");
    Ok(out)
}

fn map<const D: usize>(lattice: Lattice, kernel: KernelKind, h: f64) -> Result<Map, String> {
    let crystal = Crystal::<D>::new(lattice, kernel, h);
    let extremes = crystal.extremes()?;
    let softest = crystal.cell.shortest(extremes.softest);
    let at = |i: usize| REACH * ((2 * i + 1) as f64 / TILES as f64 - 1.0);
    let rows: Vec<Vec<f64>> = (0..TILES)
        .into_par_iter()
        .map(|row| {
            (0..TILES)
                .map(|column| {
                    let mut k = softest;
                    // The first row is on top.
                    (k[0], k[1]) = (at(column), -at(row));
                    Ok(crystal.values(k)?[0] / extremes.greatest)
                })
                .collect()
        })
        .collect::<Result<_, String>>()?;
    let cut = match softest.get(2) {
        Some(&z) => format!(", k_z ∆s = {}", digits(z)),
        None => String::new(),
    };
    let outline = if D == 2 {
        let reciprocal = crystal.cell.reciprocal();
        zone([0, 1].map(|i| [reciprocal[i][0], reciprocal[i][1]]))
    } else {
        Vec::new()
    };
    Ok(Map {
        title: format!("{lattice}, {kernel}, h/∆s = {h}{cut}"),
        rows,
        softest: [softest[0], softest[1]],
        is_stable: super::sweep::is_stable(extremes.ratio()),
        outline,
    })
}

/// The corners of the Brillouin zone in the plane: what is nearer to 0 than to any other of the reciprocal lattice.
fn zone([a, b]: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
    let far = 10.0 * PI;
    let mut corners = vec![[-far, -far], [far, -far], [far, far], [-far, far]];
    for i in -2..=2 {
        for j in -2..=2 {
            let to = point::add(point::scale(a, f64::from(i)), point::scale(b, f64::from(j)));
            if i == 0 && j == 0 {
                continue;
            }
            let beyond = |p: [f64; 2]| point::dot(p, to) - 0.5 * point::norm_squared(to);
            let mut kept = Vec::new();
            for n in 0..corners.len() {
                let (here, next) = (corners[n], corners[(n + 1) % corners.len()]);
                let (before, after) = (beyond(here), beyond(next));
                if before <= 0.0 {
                    kept.push(here);
                }
                if (before < 0.0) != (after < 0.0) && before != after {
                    let part = before / (before - after);
                    kept.push(point::add_scaled(here, part, point::sub(next, here)));
                }
            }
            // A side through a corner leaves it twice.
            kept.dedup_by(|a, b| point::distance(*a, *b) < SAME);
            if kept.len() > 1 && point::distance(kept[0], kept[kept.len() - 1]) < SAME {
                kept.pop();
            }
            corners = kept;
        }
    }
    corners
}

impl Map {
    fn draw(&self, out: &mut String, corner: [f64; 2]) {
        let (left, top) = (corner[0] + 50.0, corner[1] + 24.0);
        let edge = TILE * TILES as f64;
        let x = |k: f64| left + 0.5 * edge * (1.0 + k / REACH);
        let y = |k: f64| top + 0.5 * edge * (1.0 - k / REACH);
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<text x=\"{left}\" y=\"{:.1}\">{}</text>",
            top - 7.0,
            self.title
        );
        tiles(out, [left, top], [TILE; 2], &self.rows, &WAVES);
        for k in [-4, -2, 0, 2, 4].map(f64::from) {
            let _ = writeln!(
                out,
                "<path d=\"M{:.1} {:.1}v5M{left} {:.1}h-5\" stroke=\"#333\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{k}</text><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{k}</text>",
                x(k),
                top + edge,
                y(k),
                x(k),
                top + edge + 18.0,
                left - 8.0,
                y(k) + 4.0
            );
        }
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">k_x ∆s</text><text transform=\"translate({:.1} {:.1}) rotate(-90)\" text-anchor=\"middle\">k_y ∆s</text>",
            x(0.0),
            top + edge + 34.0,
            corner[0] + 22.0,
            y(0.0)
        );
        if !self.outline.is_empty() {
            let way: Vec<String> = (self.outline.iter())
                .map(|p| format!("{:.1} {:.1}", x(p[0]), y(p[1])))
                .collect();
            let _ = writeln!(
                out,
                "<path d=\"M{}Z\" fill=\"none\" stroke=\"black\" stroke-width=\"1.2\"/>",
                way.join("L")
            );
        }
        if !self.is_stable {
            let _ = writeln!(
                out,
                "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"6\" fill=\"none\" stroke=\"white\" stroke-width=\"4\"/><circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"6\" fill=\"none\" stroke=\"black\" stroke-width=\"2\"/>",
                x(self.softest[0]),
                y(self.softest[1]),
                x(self.softest[0]),
                y(self.softest[1])
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_zone_of_a_square_lattice_is_a_square_and_that_of_a_hexagonal_one_a_hexagon() {
        let tau = 2.0 * PI;
        let square = zone([[tau, 0.0], [0.0, tau]]);
        assert_eq!(square.len(), 4, "{square:?}");
        assert!(square.iter().all(|p| (p[0].abs() - PI).abs() < 1e-9));
        let crystal = Crystal::<2>::new(Lattice::Hexagonal, KernelKind::Quintic, 1.2);
        let hexagon = zone(*crystal.cell.reciprocal());
        let lengths: Vec<f64> = hexagon.iter().map(|p| point::norm(*p)).collect();
        let first = lengths[0];
        assert!(
            lengths.iter().all(|length| (length - first).abs() < 1e-9),
            "{hexagon:?}"
        );
        assert_eq!(hexagon.len(), 6, "{hexagon:?}");
    }
}
