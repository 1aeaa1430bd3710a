//! Scenes of a fixed family, whose sizes, bodies and kernels differ as far as estimates depend on them.

use std::fmt::Write;

use sphpack::scene::Method;

/// A scene to be packed.
#[derive(Debug, Clone)]
pub(super) struct Job {
    pub(super) method: &'static str,
    /// What is special about it.
    pub(super) about: String,
    pub(super) dimension: usize,
    pub(super) text: String,
    /// Stopped, as by Ctrl-C, after so much processor time: iterations that no limit ends would take minutes.
    pub(super) stopped_after: Option<f64>,
    pub(super) is_quick: bool,
}

/// Balls, or discs, on a square or cubic grid in a box of edge 1 spacing × `edge`.
#[derive(Debug, Clone, Copy)]
struct Shape {
    dimension: usize,
    edge: usize,
    /// Balls along an edge.
    balls: usize,
    /// Their part of the box.
    part: f64,
}

impl Shape {
    /// One in the middle that has a quarter of the box.
    const fn new(dimension: usize, edge: usize) -> Self {
        Self {
            dimension,
            edge,
            balls: 1,
            part: 0.25,
        }
    }

    /// The scene up to its bodies; `domain` is more of the box.
    fn text(&self, domain: &str) -> String {
        let Self {
            dimension,
            edge,
            balls,
            part,
        } = *self;
        let list = |x: String| vec![x; dimension].join(", ");
        let (low, high) = (list("0.0".into()), list(format!("{edge}.0")));
        let mut text =
            format!("spacing = 1.0\n[domain]\nmin = [{low}]\nmax = [{high}]\n{domain}\n");
        let cell = edge as f64 / balls as f64;
        let (shape, unit) = match dimension {
            2 => ("circle", std::f64::consts::PI),
            _ => ("sphere", 4.0 / 3.0 * std::f64::consts::PI),
        };
        let radius = cell * (part / unit).powf(1.0 / dimension as f64);
        for number in 0..balls.pow(dimension as u32) {
            let mut rest = number;
            let center: Vec<String> = (0..dimension)
                .map(|_| {
                    let along = rest % balls;
                    rest /= balls;
                    format!("{:.3}", (along as f64 + 0.5) * cell)
                })
                .collect();
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "[[body]]\nname = \"b{number}\"\nshape = {{ {shape} = {{ center = [{}], radius = {radius:.3} }} }}",
                center.join(", ")
            );
        }
        text
    }

    fn job(&self, method: &'static str, about: &str, packing: &str) -> Job {
        let mut text = self.text("");
        if method == "ppa" {
            // It fills no bodies.
            text = text.replace("shape =", "role = \"void\"\nshape =");
        }
        Job {
            method,
            about: about.to_owned(),
            dimension: self.dimension,
            text: format!("{text}[packing]\nmethod = \"{method}\"\n{packing}\n"),
            stopped_after: None,
            is_quick: false,
        }
    }
}

/// Iterations of the large ones: enough to forget the first list.
const SHORT: [&str; 2] = ["max_iterations = 40", "max_iterations = 20"];

/// Edges of boxes, in the plane and in space, whose packings take 64 MiB to 200.
const LARGE: [usize; 2] = [400, 46];
/// Of those whose surfaces take most of the memory.
const CONFINED: [usize; 2] = [400, 34];
/// Of those that are packed to the end by every method.
const SMALL: [usize; 2] = [40, 10];

/// All of them.
pub(super) fn jobs() -> Vec<Job> {
    let mut jobs = Vec::new();
    for info in Method::ALL.map(Method::info) {
        for &dimension in info.dimensions {
            let at = |edges: [usize; 2]| Shape::new(dimension, edges[dimension - 2]);
            let is_confined = matches!(info.name, "relaxation" | "complex");
            let large = at(if is_confined { CONFINED } else { LARGE });
            let short = match info.name {
                "balanced" => "",
                _ => SHORT[dimension - 2],
            };
            jobs.push(Job {
                stopped_after: (info.name == "coupled").then_some(10.0),
                is_quick: dimension == 2,
                ..large.job(info.name, "large", short)
            });
            jobs.push(Job {
                is_quick: matches!(info.name, "balanced" | "hybrid" | "relaxation"),
                ..at(SMALL).job(info.name, "to the end", "")
            });
        }
    }
    let space = Shape::new(3, 40);
    for (about, shape, method, packing) in [
        ("h/∆s = 1", space, "balanced", "h_over_spacing = 1.0"),
        (
            "h/∆s = 2",
            Shape::new(3, 36),
            "balanced",
            "h_over_spacing = 2.0",
        ),
        (
            "h/∆s = 2",
            Shape::new(3, 36),
            "hybrid",
            "h_over_spacing = 2.0\nmax_iterations = 20",
        ),
        (
            "all move",
            Shape {
                part: 0.002,
                ..space
            },
            "balanced",
            "band = \"full\"",
        ),
        (
            "a small body",
            Shape {
                part: 0.002,
                ..Shape::new(3, 60)
            },
            "balanced",
            "",
        ),
        ("27 bodies", Shape { balls: 3, ..space }, "balanced", ""),
        (
            "27 bodies",
            Shape { balls: 3, ..space },
            "agitated",
            "max_iterations = 20",
        ),
        (
            "100 bodies",
            Shape {
                balls: 10,
                ..Shape::new(2, 300)
            },
            "relaxation",
            "max_iterations = 40",
        ),
        (
            "100 bodies",
            Shape {
                balls: 10,
                ..Shape::new(2, 400)
            },
            "balanced",
            "",
        ),
        (
            "frozen ones written",
            space,
            "balanced",
            "[output]\ninclude = [\"free\", \"boundary\", \"fixed\", \"frozen\"]",
        ),
        (
            "frozen ones written",
            space,
            "clipped",
            "[output]\ninclude = [\"free\", \"boundary\", \"fixed\", \"frozen\"]",
        ),
        ("800,000 sites", Shape::new(3, 93), "clipped", ""),
    ] {
        jobs.push(shape.job(method, about, packing));
    }
    let periodic = space.text("periodic = [true, true, true]");
    jobs.push(Job {
        text: format!("{periodic}[packing]\nmethod = \"balanced\"\n"),
        ..space.job("balanced", "periodic", "")
    });
    jobs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_has_its_scenes_and_they_are_sound() {
        let jobs = jobs();
        for job in &jobs {
            let scene = sphpack::Scene::parse(&job.text, "estimates.toml").unwrap();
            assert_eq!(scene.packing.method.name(), job.method);
        }
        for info in Method::ALL.map(Method::info) {
            for &dimension in info.dimensions {
                let own = (jobs.iter())
                    .filter(|job| job.method == info.name && job.dimension == dimension);
                assert!(own.count() >= 2, "{} {dimension}", info.name);
            }
        }
    }
}
