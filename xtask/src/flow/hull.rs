//! 002's hull, afloat: a section that weighs what it displaces, free to heave, drift and roll. It should stay where it is.

use std::f64::consts::FRAC_PI_2;

use sphpack_flow::{COURANT, Medium, Particles, Standard, StandardSettings};
use sphpack_neighbors::{Domain, point};

use super::finding::{Findings, Row};
use super::progress::Progress;
use super::run::{Run, Runs};
use super::start::{Start, packed};
use super::tank::walls;
use crate::chart::{Axis, Chart, Series};

/// The basin is so wide and filled up to here. The paper gives no dimensions.
const WIDTH: f64 = 4.0;
const DEPTH: f64 = 1.0;

/// The section's middle line, half its beam, its keel and deck, and the radius of its edges.
const MIDDLE: f64 = 2.0;
const HALF_BEAM: f64 = 0.5;
const KEEL: f64 = 0.5;
const DECK: f64 = 1.4;
const ROUND: f64 = 0.2;
/// Its centre of mass above the keel; the metacentre is 0.12 above that.
const CENTRE: f64 = 0.3;

/// Artificial viscosity, as for the tank.
const VISCOSITY: f64 = 0.02;
const SOUND_SPEED: f64 = 10.0;
const GRAVITY: f64 = 1.0;

/// Why it does not stay where it is to a hundredth of ∆s.
const STIRS: &str = "it stays at first, then rises and rolls slowly; why is not known";

/// Segments of an edge.
const SEGMENTS: usize = 24;

/// From the waterline or the deck on the left around the keel to the same on the right.
fn below(height: f64) -> Vec<[f64; 2]> {
    let mut points = vec![[MIDDLE - HALF_BEAM, height]];
    for (side, begin) in [(-1.0, 2.0), (1.0, 3.0)] {
        let middle = [MIDDLE + side * (HALF_BEAM - ROUND), KEEL + ROUND];
        for k in 0..=SEGMENTS {
            let (sine, cosine) = (FRAC_PI_2 * (begin + k as f64 / SEGMENTS as f64)).sin_cos();
            points.push(point::add_scaled(middle, ROUND, [cosine, sine]));
        }
    }
    points.push([MIDDLE + HALF_BEAM, height]);
    points
}

fn area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    let twice = points
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0]);
    0.5 * twice.sum::<f64>()
}

/// Whether a place is in the section, whose deck has no rounded edges.
fn is_inside([x, y]: [f64; 2]) -> bool {
    let across = (x - MIDDLE).abs();
    let corner = [across - (HALF_BEAM - ROUND), KEEL + ROUND - y];
    let is_round = corner[0] > 0.0 && corner[1] > 0.0;
    across < HALF_BEAM && y > KEEL && y < DECK && !(is_round && point::norm(corner) > ROUND)
}

/// A rigid body in the plane.
#[derive(Debug, Clone, Copy)]
struct Hull {
    mass: f64,
    inertia: f64,
    centre: [f64; 2],
    angle: f64,
    velocity: [f64; 2],
    turning: f64,
}

impl Hull {
    /// Newton and Euler: new speeds by force and torque, new places by the new speeds.
    fn go(&mut self, force: [f64; 2], torque: f64, step: f64) -> ([f64; 2], f64) {
        let acceleration = [force[0] / self.mass, force[1] / self.mass - GRAVITY];
        let turned = torque / self.inertia;
        self.velocity = point::add_scaled(self.velocity, step, acceleration);
        self.turning += step * turned;
        self.centre = point::add_scaled(self.centre, step, self.velocity);
        self.angle += step * self.turning;
        (acceleration, turned)
    }
}

/// Numbers: `drift` (the farthest that the centre was from where it began, over ∆s), `roll` (the largest angle). Curves: `rise` (over ∆s),
/// `roll`.
fn run(count: usize, from: Start, end: f64) -> Result<Run, String> {
    let spacing = 1.0 / count as f64;
    let medium = Medium {
        smoothing_length: 1.2 * spacing,
        density: 1.0,
        sound_speed: SOUND_SPEED,
        force: [0.0, -GRAVITY],
    };
    let outline: Vec<String> = (below(DECK).iter())
        .map(|[x, y]| format!("[{x:?}, {y:?}]"))
        .collect();
    let text = format!(
        "spacing = {spacing}\n[domain]\nmin = [-0.3, -0.3]\nmax = [4.3, 1.7]\n\
         [[body]]\nname = \"hull\"\nprecedence = 1\nshape = {{ polygon = {{ points = [{}] }} }}\n\
         [[body]]\nname = \"water\"\nshape = {{ polygon = {{ points = [[0.0, 0.0], [{WIDTH:?}, 0.0], [{WIDTH:?}, {DEPTH:?}], [0.0, {DEPTH:?}]] }} }}\n",
        outline.join(", ")
    );
    let all = packed(&text, from)?.bodies.concat();
    let mut particles = Particles::default();
    for &(at, volume) in all.iter().filter(|(at, _)| !is_inside(*at)) {
        let pressure = GRAVITY * (DEPTH - at[1]);
        particles.add_fluid(at, [0.0; 2], volume * medium.density_at(pressure), pressure);
    }
    let fluid = particles.fluid;
    let section: Vec<[f64; 2]> = (all.iter())
        .filter(|(at, _)| is_inside(*at))
        .map(|(at, _)| *at)
        .collect();
    for &at in &section {
        particles.add_wall(at, spacing * spacing);
    }
    let basin = [
        [[0.0, DEPTH], [0.0, 0.0]],
        [[0.0, 0.0], [WIDTH, 0.0]],
        [[WIDTH, 0.0], [WIDTH, DEPTH]],
    ];
    for at in walls(&basin, spacing) {
        particles.add_wall(at, spacing * spacing);
    }
    let mass = area(&below(DEPTH));
    let height = DECK - KEEL;
    let begin = [MIDDLE, KEEL + CENTRE];
    let mut hull = Hull {
        mass,
        inertia: mass * (4.0 * HALF_BEAM * HALF_BEAM + height * height) / 12.0,
        centre: begin,
        angle: 0.0,
        velocity: [0.0; 2],
        turning: 0.0,
    };
    let settings = StandardSettings {
        medium,
        viscosity: VISCOSITY,
        friction: 0.0,
    };
    let domain = Domain::new([-1.0; 2], [5.0, 3.0]);
    let mut flow = Standard::new(&domain, particles, settings);
    let step = medium.time_step(COURANT, 1.0, 0.0);
    let steps = (end / step).ceil() as usize;
    let mut progress = Progress::new(format!("hull {count}, {}", from.name()));
    let mut out = Run::default();
    let (mut drift, mut roll) = (0.0_f64, 0.0_f64);
    for done in 0..steps {
        let (mut force, mut torque) = ([0.0; 2], 0.0);
        let of = flow.particles();
        for i in 0..fluid {
            let arm = point::sub(of.position[i], hull.centre);
            // No particle sees both the hull and the basin.
            if arm[0].abs() < 2.0 * HALF_BEAM && of.position[i][1] > 0.5 * KEEL {
                let part = flow.rates()[i].on_walls;
                force = point::add(force, part);
                torque += arm[0] * part[1] - arm[1] * part[0];
            }
        }
        let (acceleration, turned) = hull.go(force, torque, step);
        place(&mut flow, &hull, &section, begin, (acceleration, turned));
        flow.run(1, step).map_err(|error| error.to_string())?;
        drift = drift.max(point::distance(hull.centre, begin) / spacing);
        roll = roll.max(hull.angle.abs());
        if done % 20 == 0 {
            out.push("rise", flow.time(), (hull.centre[1] - begin[1]) / spacing);
            out.push("roll", flow.time(), hull.angle);
        }
        progress.at((done + 1) as f64 / steps as f64);
    }
    out.set("drift", drift);
    out.set("roll", roll);
    Ok(out)
}

/// Puts the section's particles where the hull is, from where they were in the packing: nothing adds up.
fn place(
    flow: &mut Standard<2>,
    hull: &Hull,
    section: &[[f64; 2]],
    begin: [f64; 2],
    (acceleration, turned): ([f64; 2], f64),
) {
    let (sine, cosine) = hull.angle.sin_cos();
    let particles = flow.particles_mut();
    let first = particles.fluid;
    for (w, &at) in section.iter().enumerate() {
        let [x, y] = point::sub(at, begin);
        let arm = [cosine * x - sine * y, sine * x + cosine * y];
        let across = [-arm[1], arm[0]];
        particles.position[first + w] = point::add(hull.centre, arm);
        particles.velocity[first + w] = point::add_scaled(hull.velocity, hull.turning, across);
        let spun = point::add_scaled(acceleration, turned, across);
        particles.wall_acceleration[w] = point::add_scaled(spun, -hull.turning * hull.turning, arm);
    }
}

/// Runs the case.
pub(super) fn find(runs: &Runs, quick: bool) -> Result<Findings, String> {
    let (count, end) = if quick { (20, 2.0) } else { (50, 20.0) };
    let get = |start: Start| {
        let of = format!("hull {count} {start:?} {end}");
        runs.get(&of, || run(count, start, end))
    };
    let clipped = get(Start::Clipped)?;
    let balanced = get(Start::Balanced)?;
    let mut found = Findings::default();
    let name = format!("hull, 1/∆s = {count}");
    let what = format!("{name}: largest roll, clipped over balanced");
    let ratio = clipped.number("roll") / balanced.number("roll");
    let row = Row::at_least(what, "–", 10.0, ratio);
    // In the quick form it has to hold.
    found
        .rows
        .push(if quick { row } else { row.because(STIRS) });
    if !quick {
        let what = format!("{name}, balanced: farthest drift over ∆s");
        let drift = Row::at_most(what, "stays", 0.01, balanced.number("drift"));
        found.rows.push(drift.because(STIRS));
        let what = format!("{name}, balanced: largest roll");
        let roll = Row::at_most(what, "stays", 1e-3, balanced.number("roll"));
        found.rows.push(roll.because(STIRS));
    }
    let numbers = [
        ("drift", "farthest drift over ∆s", false),
        ("roll", "largest roll", false),
    ];
    found.compare(&name, [&clipped, &balanced], &numbers);
    let series = [("clipped", &clipped), ("balanced", &balanced)]
        .map(|(name, run)| Series::curve(name, run.curves["rise"].clone()));
    let chart = Chart {
        title: "Floating hull: how far it rises",
        axes: [Axis::linear("t √(g/H)"), Axis::linear("rise over ∆s")],
        series: series.into(),
    };
    if !quick {
        found.charts.push(("flow-hull", chart));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_section_is_what_its_outline_holds() {
        let whole = area(&below(DECK));
        let exact = 2.0 * HALF_BEAM * (DECK - KEEL) - (2.0 - FRAC_PI_2) * ROUND * ROUND;
        assert!((whole - exact).abs() < 1e-3, "{whole} {exact}");
        let cells = (0..1000 * 1000)
            .map(|k| [(k % 1000) as f64 + 0.5, (k / 1000) as f64 + 0.5])
            .filter(|&[x, y]| is_inside([1.0 + 0.002 * x, 0.4 + 0.0011 * y]))
            .count();
        assert!(
            (cells as f64 * 0.002 * 0.0011 - exact).abs() < 2e-3,
            "{cells}"
        );
    }
}
