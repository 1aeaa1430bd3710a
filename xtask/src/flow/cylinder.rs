//! 000's cylinder at Re 200.

use std::f64::consts::TAU;

use sphpack_neighbors::point;

use super::finding::{Findings, Row};
use super::run::{Run, Runs};
use super::start::Start;
use super::stream::Stream;
use crate::chart::{Axis, Chart, Series};

const SHAPE: &str = "circle = { center = [0.0, 0.0], radius = 1.0 }";

/// What 000 gets, and cites.
const DRAG: f64 = 1.46;
const LIFT: f64 = 0.693;
/// Of computations without walls near.
const STROUHAL: f64 = 0.2;

/// How large the box is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Room {
    /// The same with a spacing of a tenth of the diameter, and not for long.
    Quick,
    /// 10 × 7 diameters.
    Narrow,
    /// 000's own: 15 × 15 diameters.
    Wide,
}

fn run(room: Room, start: Start) -> Result<Run, String> {
    let points: Vec<[f64; 2]> = (0..360)
        .map(|k| {
            let (sine, cosine) = (TAU * f64::from(k) / 360.0).sin_cos();
            [cosine, sine]
        })
        .collect();
    let (low, high, spacing, end, measured_from) = match room {
        Room::Quick => ([-7.0, -7.0], [13.0, 7.0], 0.2, 7.0, 5.0),
        Room::Narrow => ([-7.0, -7.0], [13.0, 7.0], 0.1, 70.0, 42.0),
        Room::Wide => ([-10.0, -15.0], [20.0, 15.0], 0.1, 150.0, 75.0),
    };
    let stream = Stream {
        name: "cylinder Re 200",
        shape: SHAPE,
        is_inside: |at| point::norm(at) < 1.0,
        surface: &points,
        low,
        high,
        spacing,
        viscosity: 0.01,
        pushed: Some([2.0, 0.0]),
        end,
        measured_from,
    };
    stream.run(start)
}

/// Runs the case.
pub(super) fn find(runs: &Runs, quick: bool) -> Result<Findings, String> {
    let get = |room: Room, start: Start| {
        runs.get(&format!("cylinder {room:?} {start:?}"), || run(room, start))
    };
    let mut found = Findings::default();
    let room = if quick { Room::Quick } else { Room::Narrow };
    let clipped = get(room, Start::Clipped)?;
    let balanced = get(room, Start::Balanced)?;
    let name = if quick {
        "cylinder Re 200, D/∆s = 10, box of 10 × 7 D"
    } else {
        "cylinder Re 200, D/∆s = 20, box of 10 × 7 D"
    };
    let rough = clipped.number("slip-rough") / balanced.number("slip-rough");
    let what = format!("{name}: roughness of the speed at the surface, clipped over balanced");
    found.rows.push(Row::at_least(what, "–", 2.0, rough));
    let what = format!("{name}, balanced: particles that crossed the true surface");
    let crossed = balanced.number("crossed");
    found.rows.push(Row::at_most(what, "–", 0.0, crossed));
    let both = [&clipped, &balanced];
    let numbers = [
        ("slip", "speed at the surface, RMS over the stream's", true),
        ("slip-rough", "its waves shorter than a tenth around", true),
        (
            "pressure-rough",
            "the same of the pressure, over ½ρU²",
            true,
        ),
        (
            "ringing",
            "drag, changes within a quarter of D/2U, RMS",
            false,
        ),
        ("friction", "drag by friction", false),
        ("drag", "drag", false),
    ];
    found.compare(name, both, &numbers);
    if quick {
        // Nothing is shed by then.
        return Ok(found);
    }
    let shed = [
        ("swing", "lift, amplitude", false),
        ("extreme", "lift, largest", false),
        ("strouhal", "Strouhal number", false),
    ];
    found.compare(name, both, &shed);
    let wide = get(Room::Wide, Start::Balanced)?;
    let name = "cylinder Re 200, D/∆s = 20, 000's box, balanced";
    for (number, what, published, shown, bar) in [
        ("drag", "drag off by", DRAG, "1.46", 0.04),
        ("swing", "amplitude of the lift off by", LIFT, "0.693", 0.08),
    ] {
        let what = format!("{name}: {what}");
        let off = (wide.number(number) / published - 1.0).abs();
        let row = Row::at_most(what, shown, bar, off).percent();
        found.rows.push(row);
    }
    let off = (wide.number("strouhal") - STROUHAL).abs();
    let what = format!("{name}: Strouhal number off by");
    found.rows.push(Row::at_most(what, "0.20", 0.01, off));
    // The first moments ring and would set the axis.
    let after = |run: &Run, name: &str| -> Vec<[f64; 2]> {
        let points = run.curves[name].iter().copied();
        points.filter(|point| point[0] > 2.0).collect()
    };
    let chart = Chart {
        title: "Cylinder, Re 200, box of 10 × 7 D: drag and lift",
        axes: [Axis::linear("time, U t/R"), Axis::linear("coefficient")],
        series: vec![
            Series::curve("drag, clipped", after(&clipped, "drag")),
            Series::curve("drag, balanced", after(&balanced, "drag")),
            Series::curve("lift, clipped", after(&clipped, "lift")),
            Series::curve("lift, balanced", after(&balanced, "lift")),
        ],
    };
    found.charts.push(("flow-cylinder", chart));
    Ok(found)
}
