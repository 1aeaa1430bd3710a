//! 002's elliptical drop: a round patch of fluid that a straining motion draws out, its surface free all around.

use std::f64::consts::{PI, TAU};

use sphpack_flow::{COURANT, Medium, Particles, Standard, StandardSettings};
use sphpack_neighbors::{CellList, Domain, point};

use super::finding::{Change, Findings, Row};
use super::progress::Progress;
use super::run::{Run, Runs};
use super::start::{Start, packed};
use crate::chart::{Axis, Chart, Series};

/// Artificial viscosity; Bouscasse et al. give none.
const VISCOSITY: f64 = 0.01;
const END: f64 = 2.0;
/// Looks per unit of time.
const LOOKS: usize = 20;
/// In how many sectors the outline is looked at.
const SECTORS: usize = 90;

/// The long semi-axis at a time: ȧ = A a, Ȧ = A² (b² − a²)/(a² + b²), ab = 1, and a = A = 1 at the start.
fn exact(time: f64) -> f64 {
    let steps = 2000;
    let dt = time / f64::from(steps);
    let rates = |[a, rate]: [f64; 2]| {
        let (a2, b2) = (a * a, 1.0 / (a * a));
        [rate * a, rate * rate * (b2 - a2) / (a2 + b2)]
    };
    let mut state = [1.0, 1.0];
    for _ in 0..steps {
        let middle = point::add_scaled(state, 0.5 * dt, rates(state));
        state = point::add_scaled(state, dt, rates(middle));
    }
    state[0]
}

fn start(spacing: f64, start: Start) -> Result<(Medium<2>, Particles<2>), String> {
    let medium = Medium {
        smoothing_length: 1.2 * spacing,
        density: 1.0,
        sound_speed: 10.0,
        force: [0.0; 2],
    };
    let text = format!(
        "spacing = {spacing}\n[domain]\nmargin = 0.3\n[[body]]\nname = \"drop\"\n\
         shape = {{ circle = {{ center = [0.0, 0.0], radius = 1.0 }} }}\n{}",
        // What is held reaches to the surface; what is solid has its outermost particles half a spacing within.
        if start == Start::Ppa {
            "surface = \"exact\"\n"
        } else {
            ""
        }
    );
    let mut particles = Particles::default();
    for &([x, y], volume) in packed(&text, start)?.bodies.iter().flatten() {
        let pressure = 0.5 * (1.0 - x * x - y * y);
        let mass = volume * medium.density_at(pressure);
        particles.add_fluid([x, y], [x, -y], mass, pressure);
    }
    Ok((medium, particles))
}

fn run(count: usize, from: Start) -> Result<Run, String> {
    let spacing = 1.0 / count as f64;
    let (medium, particles) = start(spacing, from)?;
    let settings = StandardSettings {
        medium,
        viscosity: VISCOSITY,
        friction: 0.0,
    };
    let domain = Domain::new([-5.0; 2], [5.0; 2]);
    let mut out = Run::default();
    out.set("particles", particles.fluid as f64);
    out.set("area", particles.mass.iter().sum::<f64>());
    let mut flow = Standard::new(&domain, particles, settings);
    let steps = (1.0 / LOOKS as f64 / medium.time_step(COURANT, 1.0, 0.0)).ceil() as usize;
    let looks = (END * LOOKS as f64).round() as usize;
    let mut progress = Progress::new(format!("drop {count}, {}", from.name()));
    for look in 1..=looks {
        (flow.run(steps, 1.0 / (LOOKS * steps) as f64)).map_err(|error| error.to_string())?;
        let time = flow.time();
        let a = exact(time);
        let of = flow.particles();
        let mass: f64 = of.mass.iter().sum();
        let semi_axis = |k: usize| {
            let moments = of
                .position
                .iter()
                .zip(&of.mass)
                .map(|(x, m)| m * x[k] * x[k]);
            2.0 * (moments.sum::<f64>() / mass).sqrt()
        };
        out.push("long", time, semi_axis(0) / a - 1.0);
        out.push("short", time, semi_axis(1) * a - 1.0);
        out.push("spread", time, outline_spread(&of.position, a));
        let nearest = nearest(&of.position, &domain, spacing);
        let close = nearest.iter().filter(|&&r| r < 0.6).count();
        out.push("close", time, close as f64 / nearest.len() as f64);
        progress.at(look as f64 / looks as f64);
    }
    Ok(out)
}

/// The outermost particle of every sector, in units of the ellipse: how much that varies.
fn outline_spread(positions: &[[f64; 2]], a: f64) -> f64 {
    let mut outermost = [0.0_f64; SECTORS];
    for x in positions {
        let scaled = [x[0] / a, x[1] * a];
        let angle = (scaled[1].atan2(scaled[0]) + PI) / TAU;
        let sector = ((angle * SECTORS as f64) as usize).min(SECTORS - 1);
        outermost[sector] = outermost[sector].max(point::norm(scaled));
    }
    let mean = outermost.iter().sum::<f64>() / SECTORS as f64;
    let squares = outermost.iter().map(|r| (r - mean) * (r - mean));
    (squares.sum::<f64>() / SECTORS as f64).sqrt()
}

/// Every particle's way to the nearest other one, over the spacing; 2 where none is nearer.
fn nearest(positions: &[[f64; 2]], domain: &Domain<2>, spacing: f64) -> Vec<f64> {
    let mut list = CellList::new(domain, 2.0 * spacing);
    list.update(positions);
    (0..positions.len())
        .map(|i| {
            (list.around(i, positions))
                .map(|(_, apart)| point::norm(apart) / spacing)
                .fold(2.0, f64::min)
        })
        .collect()
}

/// Runs the case.
pub(super) fn find(runs: &Runs, quick: bool) -> Result<Findings, String> {
    let count = if quick { 25 } else { 50 };
    let get = |start: Start| runs.get(&format!("drop {count} {start:?}"), || run(count, start));
    let clipped = get(Start::Clipped)?;
    let ppa = get(Start::Ppa)?;
    let balanced = get(Start::Balanced)?;
    let hybrid = get(Start::Hybrid)?;
    let mut found = Findings::default();
    let packings = [("ppa", &ppa), ("balanced", &balanced), ("hybrid", &hybrid)];
    for (name, packed) in packings {
        for (time, bar) in [(1.0, 0.005), (1.5, 0.01)] {
            let what = format!("drop, R/∆s = {count}, {name}: short semi-axis off at A₀t = {time}");
            let off = packed.at("short", time).abs();
            found.rows.push(Row::at_most(what, "0", bar, off).percent());
        }
        for time in [1.0, 1.5] {
            found.changes.push(Change {
                what: format!("drop, R/∆s = {count}: short semi-axis off at A₀t = {time}"),
                clipped: clipped.at("short", time),
                packed: packed.at("short", time),
                by: name,
                as_percent: true,
            });
        }
        for (curve, time, what, as_percent) in [
            (
                "spread",
                1.0,
                "outline, spread over the angle, at A₀t = 1",
                false,
            ),
            (
                "close",
                0.5,
                "share of particles with another within 0.6 ∆s at A₀t = 0.5",
                true,
            ),
        ] {
            found.changes.push(Change {
                what: format!("drop, R/∆s = {count}: {what}"),
                clipped: clipped.at(curve, time),
                packed: packed.at(curve, time),
                by: name,
                as_percent,
            });
        }
    }
    let ratio = (clipped.at("short", 1.5) / ppa.at("short", 1.5)).abs();
    let what = format!("drop, R/∆s = {count}: short semi-axis off at A₀t = 1.5, clipped over ppa");
    found.rows.push(Row::at_least(what, "–", 10.0, ratio));
    let series = [
        ("clipped", &clipped),
        ("ppa", &ppa),
        ("balanced", &balanced),
        ("hybrid", &hybrid),
    ];
    let series = series.map(|(name, run)| Series {
        name: name.to_owned(),
        points: run.curves["short"]
            .iter()
            .map(|&[t, off]| [t, 100.0 * off])
            .collect(),
        joined: true,
    });
    let chart = Chart {
        title: "Elliptical drop: the short semi-axis",
        axes: [Axis::linear("A₀ t"), Axis::linear("off by, per cent")],
        series: series.into(),
    };
    found.charts.push(("flow-drop", chart));
    Ok(found)
}
