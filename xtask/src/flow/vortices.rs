//! Taylor–Green vortices at Re 100: the scheme's own error, from lattices and packings.

use std::f64::consts::{PI, TAU};

use sphpack_flow::{COURANT, Edac, EdacSettings, Medium, Particles};
use sphpack_neighbors::Domain;
use sphpack_neighbors::random::SplitMix64;

use super::finding::{Change, Findings, Row};
use super::progress::Progress;
use super::run::{Run, Runs};
use super::start::{Start, packed};
use crate::chart::{Axis, Chart, Series};

const REYNOLDS: f64 = 100.0;

/// Why a packing around a circle misses.
const LATTICE: &str = "most of it is a lattice, whose particles stagnation lines string up";

/// What the vortices start from.
#[derive(Debug, Clone, Copy, PartialEq)]
enum From {
    /// The square lattice.
    Lattice,
    /// The same, shaken by up to 0.2 ∆s.
    Shaken,
    /// Packed around a circle that is fluid as all else.
    Packed(Start),
}

/// Velocity and pressure at a time.
fn exact([x, y]: [f64; 2], time: f64) -> ([f64; 2], f64) {
    let decay = (-8.0 * PI * PI / REYNOLDS * time).exp();
    let (x, y) = (TAU * x, TAU * y);
    let velocity = [-decay * x.cos() * y.sin(), decay * x.sin() * y.cos()];
    let pressure = -0.25 * decay * decay * ((2.0 * x).cos() + (2.0 * y).cos());
    (velocity, pressure)
}

fn places(count: usize, from: From) -> Result<Vec<([f64; 2], f64)>, String> {
    let spacing = 1.0 / count as f64;
    let mut random = SplitMix64::new(1);
    let mut lattice = |shaken: f64| {
        let place = |i: usize| {
            let at = [i % count, i / count]
                .map(|n| (n as f64 + 0.5 + shaken * (2.0 * random.unit() - 1.0)) * spacing);
            (at, spacing * spacing)
        };
        (0..count * count).map(place).collect()
    };
    match from {
        From::Lattice => Ok(lattice(0.0)),
        From::Shaken => Ok(lattice(0.2)),
        From::Packed(start) => {
            let text = format!(
                "spacing = {spacing}\n[domain]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nperiodic = [true, true]\n\
                 [[body]]\nname = \"circle\"\nshape = {{ circle = {{ center = [0.5, 0.5], radius = 0.2 }} }}\n"
            );
            let found = packed(&text, start)?;
            let [circle] = &found.bodies[..] else {
                return Err("one circle was to be packed".to_owned());
            };
            Ok([&circle[..], &found.around[..]].concat())
        }
    }
}

/// The error of speeds, Σ |‖u‖ − ‖u_e‖|/Σ ‖u_e‖, at t = 0.1, 0.2, …, 2.5, and its mean.
fn run(count: usize, from: From, wind: f64) -> Result<Run, String> {
    let medium = Medium {
        smoothing_length: 1.2 / count as f64,
        density: 1.0,
        sound_speed: 10.0,
        force: [0.0; 2],
    };
    let mut particles = Particles::default();
    for (at, volume) in places(count, from)? {
        let (u, p) = exact(at, 0.0);
        particles.add_fluid(at, [u[0] + wind, u[1]], volume, p);
    }
    let domain = Domain::new([0.0; 2], [1.0; 2]).with_periodic([true; 2]);
    let settings = EdacSettings::new(medium, 1.0 / REYNOLDS);
    let mut flow = Edac::new(&domain, particles, settings);
    let steps = (0.1 / medium.time_step(COURANT, 1.0, 1.0 / REYNOLDS)).ceil() as usize;
    let mut out = Run::default();
    let mut progress = Progress::new(format!("Taylor–Green {count}², {from:?}"));
    let mut sum = 0.0;
    for look in 1..=25 {
        (flow.run(steps, 0.1 / steps as f64)).map_err(|error| error.to_string())?;
        let (mut off, mut all) = (0.0, 0.0);
        for (x, u) in (flow.particles().position.iter()).zip(&flow.particles().velocity) {
            let ([u_e, v_e], _) = exact([x[0] - wind * flow.time(), x[1]], flow.time());
            let expected = u_e.hypot(v_e);
            off += ((u[0] - wind).hypot(u[1]) - expected).abs();
            all += expected;
        }
        sum += off / all;
        out.push("error", flow.time(), off / all);
        progress.at(f64::from(look) / 25.0);
    }
    out.set("error", sum / 25.0);
    Ok(out)
}

/// Runs the case.
pub(super) fn find(runs: &Runs, quick: bool) -> Result<Findings, String> {
    let get = |count: usize, from: From, wind: f64| {
        let of = format!("Taylor–Green {count} {from:?} {wind}");
        runs.get(&of, || run(count, from, wind))
    };
    let mut found = Findings::default();
    let mut bar = |count: usize, from: From, name: &str, bar: f64| -> Result<Run, String> {
        let run = get(count, from, 0.0)?;
        let what = format!("Taylor–Green Re 100, {count}², {name}: error of speeds");
        let row = Row::at_most(what, "exact", bar, run.number("error")).percent();
        found.rows.push(match from {
            From::Packed(_) => row.because(LATTICE),
            _ => row,
        });
        Ok(run)
    };
    bar(25, From::Shaken, "shaken lattice", 0.025)?;
    // 50² of a shaken lattice is a test of the crate's, too.
    let (count, most) = if quick { (25, 0.025) } else { (50, 0.015) };
    let shaken = if quick {
        get(count, From::Shaken, 0.0)?
    } else {
        bar(count, From::Shaken, "shaken lattice", most)?
    };
    let balanced = bar(count, From::Packed(Start::Balanced), "balanced", most)?;
    let clipped = get(count, From::Lattice, 0.0)?;
    if !quick {
        bar(100, From::Packed(Start::Balanced), "balanced", 0.01)?;
    }
    let still = get(25, From::Shaken, 0.0)?.number("error");
    let carried = get(25, From::Shaken, 1.0)?.number("error");
    let what = "the same at 25² in a wind of 1: change of the error".to_owned();
    (found.rows).push(Row::at_most(what, "0", 2e-3, (carried - still).abs()).percent());
    found.changes.push(Change {
        what: format!("Taylor–Green Re 100, {count}²: error of speeds"),
        clipped: clipped.number("error"),
        packed: balanced.number("error"),
        by: "balanced",
        as_percent: true,
    });
    let series = [
        ("lattice", clipped),
        ("shaken", shaken),
        ("balanced", balanced),
    ]
    .map(|(name, run)| Series {
        name: name.to_owned(),
        points: run.curves["error"].clone(),
        joined: true,
    });
    let chart = Chart {
        title: "Taylor–Green vortices, Re 100, 50²",
        axes: [Axis::linear("time"), Axis::linear("error of speeds")],
        series: series.into(),
    };
    found.charts.push(("flow-vortices", chart));
    Ok(found)
}
