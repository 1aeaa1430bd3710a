//! What an evaluation takes, beside that of particles of one size.

use std::fmt::Write as _;

use sphpack::{Options, Scene, run as pack};
use sphpack_packing::Silent;

use crate::workspace::root;

/// Runs of each; the quickest counts.
const REPEATS: usize = 3;

/// Two scenes with about as many particles that all move: of one size, and graded 8 : 1 or so.
const PAIRS: [(&str, &str, &str); 2] = [
    (
        "circle, periodic",
        "spacing = 0.0289
[domain]
min = [-1.4, -1.4]
max = [1.4, 1.4]
periodic = [true, true]
[[body]]
name = \"circle\"
shape = { circle = { center = [0.0, 0.0], radius = 0.5 } }
",
        "spacing = 0.02
[refinement]
coarsest = 0.16
[domain]
min = [-4.0, -4.0]
max = [4.0, 4.0]
periodic = [true, true]
[[body]]
name = \"circle\"
shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
",
    ),
    (
        "sphere, periodic",
        "spacing = 0.058
[domain]
min = [-1.0, -1.0, -1.0]
max = [1.0, 1.0, 1.0]
periodic = [true, true, true]
[[body]]
name = \"ball\"
shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 0.5 } }
",
        "spacing = 0.05
[refinement]
coarsest = 0.4
[domain]
min = [-2.0, -2.0, -2.0]
max = [2.0, 2.0, 2.0]
periodic = [true, true, true]
[[body]]
name = \"ball\"
shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 0.5 } }
",
    ),
];

/// Particles, and microseconds that settling takes for each and every evaluation.
fn measured(text: &str) -> Result<(usize, f64), String> {
    let path = root().join("scenes/time.toml");
    let mut scene = Scene::parse(text, &path).map_err(|error| error.to_string())?;
    if scene.refinement.is_none() {
        // All move, and as long as graded ones.
        scene.packing.band = sphpack::scene::BandWidth::Full;
        scene.packing.residual_tolerance = Some(1e-12);
        scene.packing.max_iterations = 110;
    }
    let mut quickest = f64::INFINITY;
    let mut count = 0;
    for _ in 0..REPEATS {
        let outcome =
            pack(&scene, &Options::default(), &mut Silent).map_err(|error| error.to_string())?;
        let report = outcome.report;
        let seconds = report.seconds.neighbors
            + report.seconds.forces
            + report.seconds.projection
            + report.seconds.minimiser;
        count = report.particles.total - report.particles.frozen;
        quickest = f64::min(
            quickest,
            1e6 * seconds / (count as f64 * report.force_evaluations as f64),
        );
    }
    Ok((count, quickest))
}

/// The table.
pub(super) fn table() -> Result<String, String> {
    let mut text = "\
| scene | particles of one size, graded | µs for each and every evaluation | ratio (bar) |
|---|---|---|---|
"
    .to_owned();
    for (what, uniform, graded) in PAIRS {
        let (one, own) = measured(uniform)?;
        let (many, graded) = measured(graded)?;
        let ratio = graded / own;
        let bar = if ratio <= 1.6 { "holds" } else { "**missed**" };
        let _ = writeln!(
            text,
            "| {what} | {one}, {many} | {own:.3}, {graded:.3} | {ratio:.2} (1.6: {bar}) |"
        );
    }
    Ok(text)
}
