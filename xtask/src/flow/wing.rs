//! 004's NACA5515 by the Eulerian scheme, whose particles stay where a packing has put them.

use sphpack_flow::{Eulerian, EulerianSettings, Fringe, Medium, Particles};
use sphpack_neighbors::{Domain, point};

use super::finding::{Findings, Row};
use super::progress::Progress;
use super::run::{Run, Runs};
use super::start::{Start, packed};
use crate::chart::{Axis, Chart, Series};

const SPEED: f64 = 1.0;
const SOUND_SPEED: f64 = 10.0;
const CHORD: f64 = 1.0;
const REYNOLDS: f64 = 420.0;
/// As published.
const COURANT: f64 = 0.25;

/// Where the fringe begins before the box's end, and λ₀: e⁻⁹ of a wake is left.
const FRINGE: f64 = CHORD;
const STRENGTH: f64 = 18.0;

/// The stream begins as U sin²(πt/2T₀): sound that a sudden one sets off crosses a periodic box again and again.
const BEGIN: f64 = 1.0;

/// The nose, whose radius is 0.025 chords, ends here.
const BEHIND_NOSE: f64 = 0.2 * CHORD;

/// Why pressures are as high there as they are.
const NOSE: &str = "at the nose, whose radius is 0.025 chords: dummy walls ask for three spacings";

/// Steps between two points of a curve.
const POINT_EVERY: usize = 50;

/// What one run is of.
#[derive(Debug, Clone, Copy)]
struct Flight {
    /// Particles along the chord.
    count: usize,
    low: [f64; 2],
    high: [f64; 2],
    end: f64,
    /// L₀.
    damping: f64,
}

/// The stream's, at a time.
fn speed(time: f64) -> f64 {
    let sine = (0.5 * std::f64::consts::PI * (time / BEGIN).min(1.0)).sin();
    SPEED * sine * sine
}

/// Numbers: `drag` and its part `thrust` by pressure, `lift` (means of the second half), `highest` (the largest ‖p‖ over ½ρU² at the end),
/// `rough` (root mean square, over the fluid next to the wing behind its nose at the end, of how much a pressure differs from a plane
/// through its neighbours', over ½ρU²), `lasted` (the time that was reached). Curves: `drag`, `lift`.
fn run(flight: &Flight, start: Start) -> Result<Run, String> {
    let spacing = CHORD / flight.count as f64;
    let ([x0, y0], [x1, y1]) = (flight.low, flight.high);
    let text = format!(
        "spacing = {spacing}\n[domain]\nmin = [{x0:?}, {y0:?}]\nmax = [{x1:?}, {y1:?}]\nperiodic = [true, true]\n\
         [[body]]\nname = \"wing\"\nshape = {{ naca = {{ digits = \"5515\", chord = {CHORD:?} }} }}\nrotate_degrees = -5.0\n"
    );
    let found = packed(&text, start)?;
    let medium = Medium {
        smoothing_length: 1.2 * spacing,
        density: 1.0,
        sound_speed: SOUND_SPEED,
        force: [0.0; 2],
    };
    let mut particles = Particles::default();
    for &(at, volume) in &found.around {
        particles.add_fluid(at, [0.0; 2], volume, 0.0);
    }
    for &(at, volume) in found.bodies.iter().flatten() {
        particles.add_wall(at, volume);
    }
    let fluid = particles.fluid;
    let domain = Domain::new(flight.low, flight.high).with_periodic([true; 2]);
    let fringe = |speed: f64| Fringe {
        from: x1 - FRINGE,
        to: x1,
        strength: STRENGTH,
        velocity: [speed, 0.0],
    };
    let settings = EulerianSettings {
        damping: flight.damping,
        fringe: Some(fringe(0.0)),
        ..EulerianSettings::new(medium, SPEED * CHORD / REYNOLDS)
    };
    let mut flow = Eulerian::new(&domain, particles, found.normals.concat(), settings);
    let step = medium.time_step(COURANT, SPEED, settings.viscosity);
    let steps = (flight.end / step).ceil() as usize;
    let mut progress = Progress::new(format!("wing c/{}, {}", flight.count, start.name()));
    let unit = 0.5 * SPEED * SPEED * CHORD;
    let mut out = Run::default();
    let (mut thrust, mut drag, mut lift, mut counted) = (0.0, 0.0, 0.0, 0.0);
    for done in 0..steps {
        let speed = speed(flow.time() + step);
        let gain = speed - self::speed(flow.time());
        flow.settings_mut().medium.force = [gain / step, 0.0];
        flow.settings_mut().fringe = Some(fringe(speed));
        if flow.run(1, step).is_err() {
            break;
        }
        progress.at((done + 1) as f64 / steps as f64);
        let mut sum = [[0.0; 2]; 2];
        for parts in flow.on_walls() {
            for (sum, part) in sum.iter_mut().zip(parts) {
                *sum = point::add(*sum, *part);
            }
        }
        let both = point::scale(point::add(sum[0], sum[1]), 1.0 / unit);
        if 2 * done >= steps {
            thrust += sum[0][0] / unit;
            drag += both[0];
            lift += both[1];
            counted += 1.0;
        }
        if done % POINT_EVERY == 0 {
            out.push("drag", flow.time(), both[0]);
            out.push("lift", flow.time(), both[1]);
        }
    }
    out.set("lasted", flow.time());
    out.set("thrust", thrust / counted);
    out.set("drag", drag / counted);
    out.set("lift", lift / counted);
    let of = flow.particles();
    let pressure = &of.pressure[..fluid];
    let highest = pressure.iter().map(|p| p.abs()).fold(0.0, f64::max);
    out.set("highest", 2.0 * highest / (SPEED * SPEED));
    let mut near = found.near(spacing);
    near.retain(|&i| of.position[i][0] > BEHIND_NOSE);
    out.set("rough", roughness(&of.position, pressure, &near));
    Ok(out)
}

/// Root mean square over `near`, particles of fluid, of how much a pressure differs from what the eight next to it make of it: a plane
/// through them by least squares.
fn roughness(positions: &[[f64; 2]], pressure: &[f64], near: &[usize]) -> f64 {
    let mut sum = 0.0;
    for &i in near {
        let mut others: Vec<(f64, usize)> = (0..pressure.len())
            .filter(|&j| j != i)
            .map(|j| (point::norm(point::sub(positions[j], positions[i])), j))
            .collect();
        others.select_nth_unstable_by(7, |a, b| a.0.total_cmp(&b.0));
        // p = a + b·x by normal equations about the particle.
        let mut rows = [[0.0; 4]; 3];
        for &(_, j) in &others[..8] {
            let [x, y] = point::sub(positions[j], positions[i]);
            let terms = [1.0, x, y];
            for row in 0..3 {
                for column in 0..3 {
                    rows[row][column] += terms[row] * terms[column];
                }
                rows[row][3] += terms[row] * pressure[j];
            }
        }
        for k in 0..3 {
            for row in (0..3).filter(|&row| row != k) {
                let factor = rows[row][k] / rows[k][k];
                for column in k..4 {
                    rows[row][column] -= factor * rows[k][column];
                }
            }
        }
        sum += (pressure[i] - rows[0][3] / rows[0][0]).powi(2);
    }
    2.0 * (sum / near.len() as f64).sqrt() / (SPEED * SPEED)
}

/// Runs the case.
pub(super) fn find(runs: &Runs, quick: bool) -> Result<Findings, String> {
    let flight = if quick {
        Flight {
            count: 25,
            low: [-1.2, -1.0],
            high: [2.8, 1.0],
            end: 1.0,
            damping: 0.05,
        }
    } else {
        Flight {
            count: 60,
            low: [-1.5, -1.5],
            high: [3.5, 1.5],
            end: 8.0,
            damping: 0.05,
        }
    };
    let get = |flight: &Flight, start: Start| {
        let of = format!("wing {flight:?} {start:?}");
        runs.get(&of, || run(flight, start))
    };
    let mut found = Findings::default();
    let name = format!("NACA5515 Re 420, c/∆s = {}", flight.count);
    let clipped = get(&flight, Start::Clipped)?;
    let balanced = get(&flight, Start::Balanced)?;
    let what = format!("{name}, balanced: time that was reached, of what was asked");
    let lasted = balanced.number("lasted") / flight.end;
    found.rows.push(Row::at_least(what, "–", 1.0, lasted));
    let rough = clipped.number("rough") / balanced.number("rough");
    let what = format!("{name}: roughness of the pressure behind the nose, clipped over balanced");
    found.rows.push(Row::at_least(what, "–", 1.0, rough));
    let what = format!("{name}, balanced: largest pressure over ½ρU²");
    let highest = balanced.number("highest");
    (found.rows).push(Row::at_most(what, "–", 2.0, highest).because(NOSE));
    let numbers = [
        (
            "rough",
            "pressure next to the wing, roughness over ½ρU²",
            true,
        ),
        ("drag", "drag", false),
        ("thrust", "drag by pressure", false),
        ("lift", "lift", false),
        ("highest", "largest pressure over ½ρU²", false),
    ];
    found.compare(&name, [&clipped, &balanced], &numbers);
    if quick {
        return Ok(found);
    }
    let bare = Flight {
        damping: 0.0,
        end: 2.0,
        ..flight
    };
    let damped = Flight { end: 2.0, ..flight };
    for start in [
        Start::Clipped,
        Start::Balanced,
        Start::Complex,
        Start::Relaxation,
    ] {
        let (with, without) = (get(&damped, start)?, get(&bare, start)?);
        let name = format!("{name}, {}, t = 2", start.name());
        let what = format!("{name}: largest pressure over ½ρU² with L₀ = 0.05");
        let highest = with.number("highest");
        (found.rows).push(Row::at_most(what, "–", 2.0, highest).because(NOSE));
        let what = format!("{name}: largest pressure with L₀ = 0 over that");
        let ratio = without.number("highest") / highest;
        found.rows.push(Row::at_least(what, "–", 1.0, ratio));
    }
    let begun = |run: &Run, of: &str| -> Vec<[f64; 2]> {
        let points = run.curves[of].iter().copied();
        points.filter(|point| point[0] > 0.5).collect()
    };
    let chart = Chart {
        title: "NACA5515, Re 420, 5°, Eulerian: drag and lift",
        axes: [Axis::linear("time, U t/c"), Axis::linear("coefficient")],
        series: vec![
            Series::curve("drag, clipped", begun(&clipped, "drag")),
            Series::curve("drag, balanced", begun(&balanced, "drag")),
            Series::curve("lift, clipped", begun(&clipped, "lift")),
            Series::curve("lift, balanced", begun(&balanced, "lift")),
        ],
    };
    found.charts.push(("flow-wing", chart));
    Ok(found)
}
