//! A body at rest in a stream: what the fluid does to it, and what it looks like on its surface.

use sphpack_flow::{COURANT, Edac, EdacSettings, Fringe, Medium, Particles};
use sphpack_neighbors::{Domain, point};

use super::progress::Progress;
use super::run::Run;
use super::start::{Start, packed};
use super::surface::Surface;

/// A body in a stream of speed 1 and density 1 along x, in a box that is periodic both ways; a fringe at its end makes the stream
/// uniform again. The body is 2 long.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stream<'a> {
    /// What is said of its progress.
    pub(super) name: &'a str,
    /// A scene's shape.
    pub(super) shape: &'a str,
    /// Whether a place is in the true body.
    pub(super) is_inside: fn([f64; 2]) -> bool,
    /// Points of the true surface, in the order in which they follow one another.
    pub(super) surface: &'a [[f64; 2]],
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
    pub(super) spacing: f64,
    pub(super) viscosity: f64,
    /// Behind the body the stream is pushed aside at the beginning, around here, so that it sheds vortices soon.
    pub(super) pushed: Option<[f64; 2]>,
    pub(super) end: f64,
    /// Numbers are of times from here on.
    pub(super) measured_from: f64,
}

/// The stream's own, and ten times its speed.
const SPEED: f64 = 1.0;
const SOUND_SPEED: f64 = 10.0;
/// The body's length.
const LENGTH: f64 = 2.0;

/// Length of the fringe, and λ₀ (ten U/D).
const FRINGE: f64 = 1.75 * LENGTH;
const STRENGTH: f64 = 10.0 * SPEED / LENGTH;

/// How fast it is pushed aside.
const PUSH: f64 = 0.3;

/// Steps between two looks at the surface, and between two points of a curve.
const LOOK_EVERY: usize = 50;
const POINT_EVERY: usize = 25;

/// What changes faster than in this time is the particles' doing, not the flow's: a quarter of what the stream takes for half the body.
const FAST: f64 = 0.25;

/// The coefficients of a force, 2F/(ρU²D), at every step.
#[derive(Debug, Default)]
struct Forces {
    /// The step's ∆t.
    step: f64,
    drag: Vec<f64>,
    /// The part of it that is friction.
    friction: Vec<f64>,
    lift: Vec<f64>,
}

impl Stream<'_> {
    fn particles(&self, start: Start) -> Result<(Particles<2>, Vec<bool>), String> {
        let [x0, y0] = self.low;
        let [x1, y1] = self.high;
        let text = format!(
            "spacing = {}\n[domain]\nmin = [{x0:?}, {y0:?}]\nmax = [{x1:?}, {y1:?}]\nperiodic = [true, true]\n\
             [[body]]\nname = \"body\"\nshape = {{ {} }}\n",
            self.spacing, self.shape
        );
        let found = packed(&text, start)?;
        let mut particles = Particles::default();
        for &(at, volume) in &found.around {
            let mut velocity = [SPEED, 0.0];
            if let Some(behind) = self.pushed {
                let off = point::norm_squared(point::sub(at, behind));
                velocity[1] = PUSH * (-off).exp();
            }
            particles.add_fluid(at, velocity, volume, 0.0);
        }
        for &(at, volume) in found.bodies.iter().flatten() {
            particles.add_wall(at, volume);
        }
        let began_inside = (particles.position.iter())
            .map(|&at| (self.is_inside)(at))
            .collect();
        Ok((particles, began_inside))
    }

    /// From that packing to the end. Numbers: `drag`, `friction` (its part), `lift` (mean), `swing` (√2 times the lift's RMS about its
    /// mean: an amplitude), `extreme` (the largest lift), `strouhal`, `ringing` (RMS of what of the drag is fast), of the surface `slip`
    /// (RMS of the speed), `slip-rough`, `pressure-rough` (over ½ρU²), `crossed` (particles of fluid in the true body at the end that were
    /// not at the beginning) and `fluid`. Curves: `drag`, `lift`.
    pub(super) fn run(&self, start: Start) -> Result<Run, String> {
        let medium = Medium {
            smoothing_length: 1.2 * self.spacing,
            density: 1.0,
            sound_speed: SOUND_SPEED,
            force: [0.0; 2],
        };
        let (particles, began_inside) = self.particles(start)?;
        let fluid = particles.fluid;
        let domain = Domain::new(self.low, self.high).with_periodic([true; 2]);
        let settings = EdacSettings {
            fringe: Some(Fringe {
                from: self.high[0] - FRINGE,
                to: self.high[0],
                strength: STRENGTH,
                velocity: [SPEED, 0.0],
            }),
            ..EdacSettings::new(medium, self.viscosity)
        };
        let mut flow = Edac::new(&domain, particles, settings);
        let step = medium.time_step(COURANT, SPEED, self.viscosity);
        let steps = (self.end / step).ceil() as usize;
        let mut progress = Progress::new(format!("{}, {}", self.name, start.name()));
        let mut forces = Forces {
            step,
            ..Forces::default()
        };
        let mut surface = Surface::new(self.surface, medium.smoothing_length);
        for done in 0..steps {
            flow.run(1, step).map_err(|error| error.to_string())?;
            forces.take(&flow);
            progress.at((done + 1) as f64 / steps as f64);
            if flow.time() >= self.measured_from && done % LOOK_EVERY == 0 {
                surface.look(&flow);
            }
        }
        let mut out = Run::default();
        forces.tell(&mut out, self.measured_from);
        surface.tell(&mut out);
        let of = flow.particles();
        let crossed = (0..fluid)
            .filter(|&i| {
                let at = domain.wrap(of.position[i]);
                (self.is_inside)(at) && !began_inside[of.id[i] as usize]
            })
            .count();
        out.set("crossed", crossed as f64);
        out.set("fluid", fluid as f64);
        Ok(out)
    }
}

impl Forces {
    fn take(&mut self, flow: &Edac<2>) {
        let mut sum = [[0.0; 2]; 2];
        for rate in flow.rates() {
            for (sum, part) in sum.iter_mut().zip(rate.on_walls) {
                *sum = point::add(*sum, part);
            }
        }
        let [pressure, friction] = sum;
        let unit = 0.5 * SPEED * SPEED * LENGTH;
        self.drag.push((pressure[0] + friction[0]) / unit);
        self.friction.push(friction[0] / unit);
        self.lift.push((pressure[1] + friction[1]) / unit);
    }

    fn tell(&self, out: &mut Run, measured_from: f64) {
        let time = |k: usize| (k + 1) as f64 * self.step;
        let first = (measured_from / self.step) as usize;
        let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
        let about = |of: &[f64], middle: f64| {
            let squares: Vec<f64> = of.iter().map(|x| (x - middle).powi(2)).collect();
            mean(&squares).sqrt()
        };
        let (drag, lift) = (&self.drag[first..], &self.lift[first..]);
        out.set("drag", mean(drag));
        out.set("friction", mean(&self.friction[first..]));
        let middle = mean(lift);
        out.set("lift", middle);
        out.set("swing", std::f64::consts::SQRT_2 * about(lift, middle));
        let largest = lift.iter().map(|x| x.abs()).fold(0.0, f64::max);
        out.set("extreme", largest);
        let window = (FAST / self.step).ceil() as usize;
        let fast: Vec<f64> = (drag.windows(window))
            .map(|around| around[window / 2] - mean(around))
            .collect();
        out.set("ringing", about(&fast, 0.0));
        // A cycle ends where the lift, smoothed likewise, rises through its mean.
        let smooth: Vec<f64> = lift.windows(window).map(mean).collect();
        let rises: Vec<f64> = (smooth.windows(2).enumerate())
            .filter(|(_, pair)| pair[0] < middle && pair[1] >= middle)
            .map(|(k, pair)| k as f64 + (middle - pair[0]) / (pair[1] - pair[0]))
            .collect();
        if let [begin, .., end] = rises[..] {
            let cycle = (end - begin) * self.step / (rises.len() - 1) as f64;
            out.set("strouhal", LENGTH / (SPEED * cycle));
        }
        for (name, of) in [("drag", &self.drag), ("lift", &self.lift)] {
            for (k, part) in of.chunks(POINT_EVERY).enumerate() {
                out.push(name, time(k * POINT_EVERY + part.len() / 2), mean(part));
            }
        }
    }
}
