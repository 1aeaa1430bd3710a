//! How many particles go how many steps in a second of one core.

use std::fs;

use sphpack_flow::{
    COURANT, Edac, EdacSettings, Eulerian, EulerianSettings, Medium, Particles, Standard,
    StandardSettings,
};
use sphpack_neighbors::Domain;
use sphpack_neighbors::random::SplitMix64;

use super::finding::{Findings, Row};

/// Particles along a side of the box.
const COUNT: usize = 160;
/// Until the particles are no lattice any more; and by the clock.
const BEFORE: usize = 100;
const STEPS: usize = 200;

/// Seconds that this thread has had a core for: others on the machine do not count.
fn seconds() -> Result<f64, String> {
    let path = "/proc/thread-self/schedstat";
    let text = fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?;
    let nanoseconds = text
        .split_whitespace()
        .next()
        .and_then(|first| first.parse::<f64>().ok());
    nanoseconds
        .map(|n| 1e-9 * n)
        .ok_or_else(|| format!("{path} has no time"))
}

/// Particle-steps per second of the one thread that `go` runs on.
fn rate(mut go: impl FnMut(usize) -> Result<(), String> + Send) -> Result<f64, String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.map_err(|error| error.to_string())?.install(|| {
        go(BEFORE)?;
        let begun = seconds()?;
        go(STEPS)?;
        Ok((COUNT * COUNT * STEPS) as f64 / (seconds()? - begun))
    })
}

/// Vortices, two by two, as in the Taylor–Green case, from a shaken lattice.
fn particles(medium: &Medium<2>) -> Particles<2> {
    let spacing = medium.smoothing_length / 1.2;
    let mut random = SplitMix64::new(1);
    let mut particles = Particles::default();
    for i in 0..COUNT * COUNT {
        let at = [i % COUNT, i / COUNT]
            .map(|n| (n as f64 + 0.5 + 0.2 * (2.0 * random.unit() - 1.0)) * spacing);
        let [x, y] = at.map(|x| std::f64::consts::TAU * x);
        let velocity = [-x.cos() * y.sin(), x.sin() * y.cos()];
        particles.add_fluid(at, velocity, spacing * spacing, 0.0);
    }
    particles
}

/// Runs the case.
pub(super) fn find() -> Result<Findings, String> {
    let medium = Medium {
        smoothing_length: 1.2 / COUNT as f64,
        density: 1.0,
        sound_speed: 10.0,
        force: [0.0; 2],
    };
    let domain = Domain::new([0.0; 2], [1.0; 2]).with_periodic([true; 2]);
    let mut found = Findings::default();
    let mut row = |scheme: &str, peer: &str, bar: f64, rate: f64| {
        let what = format!("{scheme}: million particle-steps per core-second");
        found.rows.push(Row::at_least(what, peer, bar, 1e-6 * rate));
    };
    let settings = EdacSettings::new(medium, 0.01);
    let step = medium.time_step(COURANT, 1.0, 0.01);
    let mut flow = Edac::new(&domain, particles(&medium), settings);
    let edac = rate(|steps| flow.run(steps, step).map_err(|error| error.to_string()))?;
    row("EDAC, plane", "0.34 (PySPH)", 2.5, edac);
    eprintln!("EDAC: {} steps, {} lists", flow.steps(), flow.list_builds());
    let settings = StandardSettings {
        medium,
        viscosity: 0.02,
        friction: 0.0,
    };
    let mut flow = Standard::new(&domain, particles(&medium), settings);
    let standard = rate(|steps| flow.run(steps, step).map_err(|error| error.to_string()))?;
    row("standard, plane", "0.47 (PySPH)", 4.0, standard);
    eprintln!(
        "standard: {} steps, {} lists",
        flow.steps(),
        flow.list_builds()
    );
    let settings = EulerianSettings::new(medium, 0.01);
    let step = medium.time_step(0.25, 1.0, 0.01);
    let mut flow = Eulerian::new(&domain, particles(&medium), Vec::new(), settings);
    let eulerian = rate(|steps| flow.run(steps, step).map_err(|error| error.to_string()))?;
    row("Eulerian, plane", "–", 4.0, eulerian);
    Ok(found)
}
