//! 000's NACA0015 without incidence.

use super::finding::{Findings, Row};
use super::run::{Run, Runs};
use super::start::Start;
use super::stream::Stream;

const CHORD: f64 = 2.0;
const SHAPE: &str = "naca = { digits = \"0015\", chord = 2.0 }";

/// Half the thickness at a place along the chord (Ladson & Brooks 1975, its end closed).
fn half_thickness(x: f64) -> f64 {
    let x = (x / CHORD).clamp(0.0, 1.0);
    let polynomial = x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x)));
    5.0 * 0.15 * CHORD * (0.2969 * x.sqrt() + polynomial)
}

fn is_inside([x, y]: [f64; 2]) -> bool {
    (0.0..CHORD).contains(&x) && y.abs() < half_thickness(x)
}

/// Points around, evenly.
fn surface() -> Vec<[f64; 2]> {
    const FINE: usize = 4000;
    const COUNT: usize = 400;
    let fine: Vec<[f64; 2]> = (0..=FINE)
        .map(|k| {
            let angle = std::f64::consts::TAU * k as f64 / FINE as f64;
            let x = 0.5 * CHORD * (1.0 + angle.cos());
            let side = if 2 * k < FINE { 1.0 } else { -1.0 };
            [x, side * half_thickness(x)]
        })
        .collect();
    let mut way = vec![0.0];
    for pair in fine.windows(2) {
        let step = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
        way.push(way[way.len() - 1] + step);
    }
    let all = way[FINE];
    (0..COUNT)
        .map(|k| fine[way.partition_point(|&to| to < all * k as f64 / COUNT as f64)])
        .collect()
}

fn run(quick: bool, start: Start) -> Result<Run, String> {
    let (spacing, end, measured_from) = if quick {
        (0.2, 8.0, 6.0)
    } else {
        (0.08, 46.0, 26.0)
    };
    let stream = Stream {
        name: "NACA0015",
        shape: SHAPE,
        is_inside,
        surface: &surface(),
        low: [-6.0, -6.0],
        high: [14.0, 6.0],
        spacing,
        viscosity: 0.01,
        pushed: None,
        end,
        measured_from,
    };
    stream.run(start)
}

/// Runs the case.
pub(super) fn find(runs: &Runs, quick: bool) -> Result<Findings, String> {
    let get = |start: Start| runs.get(&format!("NACA0015 {quick} {start:?}"), || run(quick, start));
    let clipped = get(Start::Clipped)?;
    let balanced = get(Start::Balanced)?;
    let mut found = Findings::default();
    let name = if quick {
        "NACA0015 Re 200, L/∆s = 10"
    } else {
        "NACA0015 Re 200, L/∆s = 25"
    };
    let what = format!("{name}, balanced: mean lift");
    let lift = balanced.number("lift").abs();
    found.rows.push(Row::at_most(what, "0", 0.01, lift));
    let what = format!("{name}, balanced: particles that crossed the true surface");
    let crossed = balanced.number("crossed");
    found.rows.push(Row::at_most(what, "–", 0.0, crossed));
    let numbers = [
        ("lift", "mean lift, 0 by symmetry", false),
        ("swing", "lift, √2 times its RMS about the mean", false),
        ("drag", "drag", false),
        ("friction", "drag by friction", false),
        (
            "ringing",
            "drag, changes within a quarter of L/2U, RMS",
            false,
        ),
        ("slip", "speed at the surface, RMS over the stream's", true),
        ("slip-rough", "its waves shorter than a tenth around", true),
        (
            "pressure-rough",
            "the same of the pressure, over ½ρU²",
            true,
        ),
        ("crossed", "particles that crossed the true surface", false),
    ];
    found.compare(name, [&clipped, &balanced], &numbers);
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_evenly_around() {
        let points = surface();
        let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let ways: Vec<f64> = (0..points.len())
            .map(|k| apart(points[k], points[(k + 1) % points.len()]))
            .collect();
        let mean = ways.iter().sum::<f64>() / ways.len() as f64;
        assert!(ways.iter().all(|way| (0.5..1.5).contains(&(way / mean))));
        assert!((mean * ways.len() as f64 - 4.12).abs() < 0.05, "{mean}");
    }
}
