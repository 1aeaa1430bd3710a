//! 002's trapezoidal tank: fluid at rest under gravity, the lid off at t = 0. All that moves is the packing's doing; or that of a lattice
//! which settles by itself first.

use sphpack_flow::{COURANT, Medium, Particles, Standard, StandardSettings};
use sphpack_neighbors::{Domain, point};

use super::finding::{Change, Findings, Row};
use super::progress::Progress;
use super::run::{Run, Runs};
use super::start::{Start, packed};
use crate::chart::{Axis, Chart, Scale, Series};

/// Artificial viscosity; Bouscasse et al. give none.
const VISCOSITY: f64 = 0.02;

/// The tank, its height 1.
const CORNERS: &str = "[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [0.0, 1.0]";

fn text(spacing: f64, start: Start) -> String {
    format!(
        "spacing = {spacing}\n[domain]\nmin = [-0.3, -0.3]\nmax = [3.3, 1.3]\n[[body]]\nname = \"tank\"\n\
         shape = {{ polygon = {{ points = [{CORNERS}] }} }}\n{}",
        // What is held reaches to the wall; what is solid has its outermost particles half a spacing within.
        if start == Start::Ppa {
            "surface = \"exact\"\n"
        } else {
            ""
        }
    )
}

/// Pressure and density as the weight above asks for.
fn start(spacing: f64, from: Start) -> Result<(Medium<2>, Particles<2>), String> {
    let medium = Medium {
        smoothing_length: 1.2 * spacing,
        density: 1.0,
        sound_speed: 10.0,
        force: [0.0, -1.0],
    };
    let mut particles = Particles::default();
    for &(at, volume) in packed(&text(spacing, from), from)?.bodies.iter().flatten() {
        let pressure = 1.0 - at[1];
        let mass = volume * medium.density_at(pressure);
        particles.add_fluid(at, [0.0; 2], mass, pressure);
    }
    for at in walls(&SIDES, spacing) {
        particles.add_wall(at, spacing * spacing);
    }
    Ok((medium, particles))
}

/// The side, the floor and the slope.
const SIDES: [[[f64; 2]; 2]; 3] = [
    [[0.0, 1.0], [0.0, 0.0]],
    [[0.0, 0.0], [2.0, 0.0]],
    [[2.0, 0.0], [3.0, 1.0]],
];

/// Four layers behind sides that follow one another with the fluid to their left, the same for all packings; at both ends they go on for five
/// spacings, so that nothing spills over.
pub(super) fn walls(sides: &[[[f64; 2]; 2]], spacing: f64) -> Vec<[f64; 2]> {
    let mut walls: Vec<[f64; 2]> = Vec::new();
    for &[from, to] in sides {
        let way: [f64; 2] = point::sub(to, from);
        let length = point::norm(way);
        let outward = [way[1] / length, -way[0] / length];
        let count = (length / spacing).round();
        for layer in 0..4 {
            for place in -5..count as i32 + 5 {
                let along = point::add_scaled(from, (f64::from(place) + 0.5) / count, way);
                let depth = (f64::from(layer) + 0.5) * spacing;
                let at = point::add_scaled(along, depth, outward);
                // Around corners the layers of two sides overlap.
                let is_free = |other: &[f64; 2]| point::distance(at, *other) > 0.7 * spacing;
                if walls.iter().all(is_free) {
                    walls.push(at);
                }
            }
        }
    }
    walls
}

/// How far a place is beyond the side, the floor or the slope, whichever it is farthest beyond; negative within.
fn beyond([x, y]: [f64; 2]) -> f64 {
    (-x).max(-y)
        .max((x - 2.0 - y) * std::f64::consts::FRAC_1_SQRT_2)
}

/// Steps that fluid settles for by itself, and its friction κ then, in c/∆s.
const SETTLING: usize = 10_000;
const FRICTION: f64 = 1e-3;

/// Kinetic energy over M g H, until `end`, in units of √(H/g); before that so many steps with friction.
fn run(count: usize, from: Start, end: f64, settling: usize) -> Result<Run, String> {
    let spacing = 1.0 / count as f64;
    let (medium, particles) = start(spacing, from)?;
    let settings = StandardSettings {
        medium,
        viscosity: VISCOSITY,
        friction: 0.0,
    };
    let weight: f64 = particles.mass[..particles.fluid].iter().sum();
    let domain = Domain::new([-1.0; 2], [4.0, 2.0]);
    let mut out = Run::default();
    out.set("fluid", particles.fluid as f64);
    out.set("walls", (particles.len() - particles.fluid) as f64);
    let mut flow = Standard::new(&domain, particles, settings);
    let first = (flow.rates().iter()).map(|rate| point::norm_squared(rate.acceleration));
    out.set(
        "first",
        (first.sum::<f64>() / flow.particles().fluid as f64).sqrt(),
    );
    let steps = (0.25 / medium.time_step(COURANT, 1.0, 0.0)).ceil() as usize;
    let looks = (4.0 * end).round() as usize;
    let mut progress = Progress::new(format!("tank {count}, {}", from.name()));
    if settling > 0 {
        flow.set_friction(FRICTION * medium.sound_speed / spacing);
        (flow.run(settling, 0.25 / steps as f64)).map_err(|error| error.to_string())?;
        flow.set_friction(0.0);
    }
    let begun = flow.time();
    for look in 1..=looks {
        (flow.run(steps, 0.25 / steps as f64)).map_err(|error| error.to_string())?;
        out.push(
            "energy",
            flow.time() - begun,
            flow.particles().kinetic_energy() / weight,
        );
        progress.at(look as f64 / looks as f64);
    }
    let of = flow.particles();
    let count = |depth: f64| {
        let fluid = &of.position[..of.fluid];
        fluid.iter().filter(|&&at| beyond(at) > depth).count() as f64
    };
    // The first layer of walls is half a spacing behind the surface.
    out.set("beyond", count(0.0));
    out.set("lost", count(0.5 * spacing));
    Ok(out)
}

/// Runs the case.
pub(super) fn find(runs: &Runs, quick: bool) -> Result<Findings, String> {
    let mut found = Findings::default();
    let end = if quick { 5.0 } else { 20.0 };
    let counts: &[usize] = if quick { &[25] } else { &[25, 50] };
    for &count in counts {
        let get = |start: Start, settling: usize| {
            let of = format!("tank {count} {start:?} {end} {settling}");
            runs.get(&of, || run(count, start, end, settling))
        };
        let clipped = get(Start::Clipped, 0)?;
        let ppa = get(Start::Ppa, 0)?;
        let balanced = get(Start::Balanced, 0)?;
        let name = format!("tank, H/∆s = {count}");
        let last = ppa.at("energy", end);
        if !quick {
            let bar = if count == 25 { 5e-7 } else { 3e-7 };
            let what = format!("{name}, ppa: kinetic energy over MgH at t = 20");
            found
                .rows
                .push(Row::at_most(what, "10⁻⁷ … 10⁻⁸", bar, last));
        }
        let what = format!("{name}: kinetic energy at t = {end}, clipped over ppa");
        let ratio = clipped.at("energy", end) / last;
        found.rows.push(Row::at_least(what, "≥ 100", 100.0, ratio));
        let what = format!("{name}, ppa: particles that passed the first layer of walls");
        (found.rows).push(Row::at_most(what, "–", 0.0, ppa.number("lost")));
        let mut packings = vec![("ppa", &ppa), ("balanced", &balanced)];
        let settled;
        if !quick {
            settled = get(Start::Clipped, SETTLING)?;
            let what = format!("{name}: kinetic energy at t = {end}, settled by itself over ppa");
            let ratio = settled.at("energy", end) / last;
            found.rows.push(Row::at_least(what, "above", 1.0, ratio));
            packings.push(("settled by itself", &settled));
        }
        for &(by, packed) in &packings {
            let mut times = vec![5.0];
            if !quick {
                times.push(end);
            }
            for time in times {
                found.changes.push(Change {
                    what: format!("{name}: kinetic energy over MgH at t = {time}"),
                    clipped: clipped.at("energy", time),
                    packed: packed.at("energy", time),
                    by,
                    as_percent: false,
                });
            }
            found.changes.push(Change {
                what: format!("{name}: root mean square of the first acceleration over g"),
                clipped: clipped.number("first"),
                packed: packed.number("first"),
                by,
                as_percent: false,
            });
        }
        let series = [("clipped", &clipped)].into_iter().chain(packings);
        let series = series.map(|(name, run)| Series {
            name: name.to_owned(),
            points: run.curves["energy"].clone(),
            joined: true,
        });
        let chart = Chart {
            title: "Trapezoidal tank: kinetic energy",
            axes: [
                Axis::linear("t √(g/H)"),
                Axis {
                    title: "kinetic energy over MgH",
                    scale: Scale::Logarithmic,
                },
            ],
            series: series.collect(),
        };
        // The finest one is drawn.
        found.charts = vec![("flow-tank", chart)];
    }
    Ok(found)
}
