//! 000's Taylor–Couette flow: fluid between a shaft that turns and a ring at rest.

use sphpack_flow::{COURANT, Edac, EdacSettings, Medium, Particles};
use sphpack_neighbors::{Domain, point};

use super::finding::{Findings, Row};
use super::progress::Progress;
use super::run::{Run, Runs};
use super::start::{Start, packed};
use crate::chart::{Axis, Chart, Series};

/// The shaft's and the ring's radius.
const SHAFT: f64 = 0.25;
const RING: f64 = 0.5;
/// How fast the shaft turns.
const TURNS: f64 = 1.0;
const VISCOSITY: f64 = 0.2;
/// Ten times the shaft's speed.
const SOUND_SPEED: f64 = 2.5;
/// Steady long before, at Re 0.3: the shorter time is for quick runs.
const ENDS: [f64; 2] = [1.5, 3.0];

/// The speed around, at a distance from the axis.
fn exact(r: f64) -> f64 {
    let (a2, b2) = (SHAFT * SHAFT, RING * RING);
    let rigid = -TURNS * a2 / (b2 - a2);
    let vortex = TURNS * a2 * b2 / (b2 - a2);
    rigid * r + vortex / r
}

/// What the shaft is turned by, per density: 4πν a²b²Ω/(b² − a²).
fn exact_torque() -> f64 {
    let (a2, b2) = (SHAFT * SHAFT, RING * RING);
    4.0 * std::f64::consts::PI * VISCOSITY * a2 * b2 * TURNS / (b2 - a2)
}

/// Fluid, shaft, ring.
type Parts = [Vec<([f64; 2], f64)>; 3];

fn parts(spacing: f64, start: Start) -> Result<Parts, String> {
    // The ring is what is around the fluid, the fluid a disk that the shaft cuts.
    let text = format!(
        "spacing = {spacing}\n[domain]\nmin = [-0.75, -0.75]\nmax = [0.75, 0.75]\n\
         [[body]]\nname = \"shaft\"\nprecedence = 1\nshape = {{ circle = {{ center = [0.0, 0.0], radius = {SHAFT} }} }}\n\
         [[body]]\nname = \"fluid\"\nshape = {{ circle = {{ center = [0.0, 0.0], radius = {RING} }} }}\n"
    );
    let found = packed(&text, start)?;
    let all = found.bodies.concat();
    let all = [all, found.around].concat();
    // Wherever a method has put them: what counts is the side of the true surface.
    let mut parts = Parts::default();
    for (at, volume) in all {
        let r = point::norm(at);
        let depth = 4.0 * spacing;
        match r {
            _ if r < SHAFT - depth || r > RING + depth => {}
            _ if r < SHAFT => parts[1].push((at, volume)),
            _ if r < RING => parts[0].push((at, volume)),
            _ => parts[2].push((at, volume)),
        }
    }
    Ok(parts)
}

fn run(count: usize, from: Start, end: f64) -> Result<Run, String> {
    let spacing = SHAFT / count as f64;
    let medium = Medium {
        smoothing_length: 1.2 * spacing,
        density: 1.0,
        sound_speed: SOUND_SPEED,
        force: [0.0; 2],
    };
    let [fluid, shaft, ring] = parts(spacing, from)?;
    let mut particles = Particles::default();
    for &(at, volume) in &fluid {
        particles.add_fluid(at, [0.0; 2], volume, 0.0);
    }
    for &(at, volume) in shaft.iter().chain(&ring) {
        particles.add_wall(at, volume);
    }
    let first = fluid.len();
    let mut out = Run::default();
    let area: f64 = fluid.iter().map(|(_, volume)| volume).sum();
    let true_area = std::f64::consts::PI * (RING * RING - SHAFT * SHAFT);
    out.set("area", area / true_area - 1.0);
    let domain = Domain::new([-1.0; 2], [1.0; 2]);
    let settings = EdacSettings::new(medium, VISCOSITY);
    let mut flow = Edac::new(&domain, particles, settings);
    let step = medium.time_step(COURANT, SHAFT * TURNS, VISCOSITY);
    let steps = (end / step).ceil() as usize;
    let mut progress = Progress::new(format!("Taylor–Couette {count}, {}", from.name()));
    // Measured over the last third.
    let measured_from = steps - steps / 3;
    let (mut off, mut all, mut radial, mut torque) = (0.0, 0.0, 0.0, 0.0);
    for done in 0..steps {
        turn(&mut flow, first, &shaft);
        flow.run(1, step).map_err(|error| error.to_string())?;
        progress.at(done as f64 / steps as f64);
        if done < measured_from {
            continue;
        }
        let of = flow.particles();
        for i in 0..first {
            let (x, force) = (of.position[i], flow.rates()[i].on_walls);
            let r = point::norm(x);
            if r < 0.5 * (SHAFT + RING) {
                // What the fluid does to the shaft holds it back.
                for part in force {
                    torque -= x[0] * part[1] - x[1] * part[0];
                }
            }
            if done % 20 == 0 {
                let u = of.velocity[i];
                let around = (x[0] * u[1] - x[1] * u[0]) / r;
                let outward = point::dot(x, u) / r;
                off += (around - exact(r)).powi(2);
                radial += outward * outward;
                all += exact(r).powi(2);
            }
        }
    }
    out.set("error", f64::sqrt(off / all));
    out.set("radial", f64::sqrt(radial / all));
    // Pairs exchange η ∂u/∂n, but the stress is symmetric: on a wall that turns as a rigid body its other half is a torque of
    // 2ηΩ times the body's area, and none on a wall that does not turn.
    let other_half = 2.0 * VISCOSITY * TURNS * std::f64::consts::PI * SHAFT * SHAFT;
    let torque = torque / (steps - measured_from) as f64 + other_half;
    out.set("torque", torque / exact_torque() - 1.0);
    let of = flow.particles();
    let mut beyond = 0;
    for i in 0..first {
        let x = of.position[i];
        let r = point::norm(x);
        beyond += usize::from(!(SHAFT..RING).contains(&r));
        let u = of.velocity[i];
        out.push("speed", r, (x[0] * u[1] - x[1] * u[0]) / r);
    }
    out.set("beyond", beyond as f64);
    Ok(out)
}

/// Turns the shaft's particles to where they are now. They move with it, but fluid sees the speed of the surface next to them:
/// with their own the wall would turn too slowly by what they lie within it.
fn turn(flow: &mut Edac<2>, first: usize, shaft: &[([f64; 2], f64)]) {
    let (sine, cosine) = (TURNS * flow.time()).sin_cos();
    let particles = flow.particles_mut();
    for (w, &([x, y], _)) in shaft.iter().enumerate() {
        let at = [cosine * x - sine * y, sine * x + cosine * y];
        let r = point::norm(at);
        particles.position[first + w] = at;
        particles.velocity[first + w] = [-at[1], at[0]].map(|v| TURNS * SHAFT * v / r);
        particles.wall_acceleration[w] = point::scale(at, -TURNS * TURNS);
    }
}

/// Runs the case.
pub(super) fn find(runs: &Runs, quick: bool) -> Result<Findings, String> {
    let mut found = Findings::default();
    let end = ENDS[usize::from(!quick)];
    let counts: &[usize] = if quick { &[10] } else { &[10, 20] };
    for &count in counts {
        let get = |start: Start| {
            let of = format!("Couette {count} {start:?} {end}");
            runs.get(&of, || run(count, start, end))
        };
        let clipped = get(Start::Clipped)?;
        let balanced = get(Start::Balanced)?;
        let name = format!("Taylor–Couette, a/∆s = {count}");
        let bar = if count == 10 { 0.02 } else { 0.013 };
        let what = format!("{name}, balanced: speed around, L2");
        let row = Row::at_most(what, "exact", bar, balanced.number("error")).percent();
        found.rows.push(row);
        let bar = if count == 10 { 0.04 } else { 0.02 };
        let what = format!("{name}, balanced: torque off by");
        let row = Row::at_most(what, "exact", bar, balanced.number("torque").abs()).percent();
        found.rows.push(row);
        let what = format!("{name}, balanced: particles beyond the true surfaces");
        found.rows.push(Row::at_most(
            what,
            "–",
            0.005 * 5000.0,
            balanced.number("beyond"),
        ));
        let numbers = [
            ("error", "speed around, L2", true),
            ("radial", "speed outward, over the speed around", true),
            ("torque", "torque off by", true),
            ("area", "area of the fluid off by", true),
        ];
        found.compare(&name, [&clipped, &balanced], &numbers);
        let theory = (0..=50).map(|k| SHAFT + (RING - SHAFT) * f64::from(k) / 50.0);
        let curve = |name: &str, points: Vec<[f64; 2]>, joined| Series {
            name: name.to_owned(),
            points,
            joined,
        };
        let chart = Chart {
            title: "Taylor–Couette: speed around the axis",
            axes: [
                Axis::linear("distance from the axis"),
                Axis::linear("speed around"),
            ],
            series: vec![
                curve("clipped", clipped.curves["speed"].clone(), false),
                curve("balanced", balanced.curves["speed"].clone(), false),
                curve("exact", theory.map(|r| [r, exact(r)]).collect(), true),
            ],
        };
        if count == 10 {
            found.charts = vec![("flow-couette", chart)];
        }
    }
    Ok(found)
}
