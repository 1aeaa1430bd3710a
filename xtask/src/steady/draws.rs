//! The same body, with another offset and turn of the lattice, another seed, in other units.

use sphpack_neighbors::random::SplitMix64;

use super::{Figures, Section, parsed};
use crate::bench::Bench;
use crate::shown_table::ShownTable;

/// This file measures.
pub(super) const SOURCE: &str = file!();

/// Draws of each body.
const DRAWS: usize = 20;
const FEW: usize = 3;

/// Bodies of the quick form.
const QUICK: [&str; 2] = ["0012", TIP];
const TIP: &str = "tip of 6°, sides of 12 ∆s";

/// Units: powers of ten from −this to this.
const EXPONENTS: i32 = 6;

/// A body that is drawn.
struct Body {
    name: &'static str,
    /// ∆s in scene units, and half the box's edge beside it.
    spacing: f64,
    half: f64,
    /// `shape` of a scene, in scene units of one.
    shape: Shape,
    bar: Bar,
}

enum Shape {
    Naca(&'static str),
    Sphere(f64),
    /// A sector: its angle in degrees and the length of its sides.
    Sector(f64, f64),
}

/// What the draws have to keep.
enum Bar {
    /// The largest L∞ is no more than this above the smallest, in parts of one.
    Spread(f64),
    /// No L∞ is above this, in parts of one, no pair nearer than so many ∆s.
    Spike(f64, f64),
}

const BODIES: [Body; 8] = [
    naca("0012"),
    naca("0006"),
    naca("2412"),
    naca("4418"),
    naca("6409"),
    Body {
        name: "sphere of 7.5 ∆s' radius",
        spacing: 0.1,
        half: 1.3,
        shape: Shape::Sphere(0.75),
        bar: Bar::Spread(0.001),
    },
    sector("corner of 90°, sides of 12 ∆s", 90.0, 0.01),
    sector(TIP, 6.0, 0.15),
];

const fn naca(digits: &'static str) -> Body {
    Body {
        name: digits,
        spacing: 0.02,
        half: 0.8,
        shape: Shape::Naca(digits),
        bar: Bar::Spread(0.002),
    }
}

const fn sector(name: &'static str, angle: f64, spike: f64) -> Body {
    Body {
        name,
        spacing: 1.0,
        half: 20.0,
        shape: Shape::Sector(angle, 12.0),
        bar: Bar::Spike(spike, 0.6),
    }
}

const ABOUT: &str = "\
Each body is packed from lattices moved by any part of a cell and turned by any angle (the body is turned; a sphere is not), with other seeds, in
units from 10⁻⁶ to 10⁶. L∞ is max |Γ − 1|. The bars: L∞ of NACA's four-digit sections differs by less than 0.2 percentage points, that of the sphere by less than
0.1; at a corner of 90° it is at most 1 %, at a tip of 6° at most 15 %, with no pair nearer than 0.6 ∆s.

";

const HEAD: &str = "\
| body | ∆s | draws | L∞, least | greatest | bar | closest pair / ∆s | evaluations, most | |
|---|---|---|---|---|---|---|---|---|
";

pub(super) fn section(bench: &Bench, is_quick: bool) -> Result<Section, String> {
    let mut table = ShownTable::new(HEAD);
    let mut rows = Vec::new();
    let draws = if is_quick { FEW } else { DRAWS };
    for (number, body) in BODIES.iter().enumerate() {
        if is_quick && !QUICK.contains(&body.name) {
            continue;
        }
        let mut random = SplitMix64::new(number as u64);
        let mut found = Vec::new();
        for draw in 0..draws {
            let scene = parsed(&body.scene(draw, &mut random))?;
            found.push(bench.packed(&scene, Figures::of)?);
        }
        let linf = |start: f64, of: fn(f64, f64) -> f64| {
            found.iter().fold(start, |linf, one| of(linf, one.linf))
        };
        let (least, greatest) = (linf(f64::INFINITY, f64::min), linf(0.0, f64::max));
        let closest = (found.iter()).fold(f64::INFINITY, |least, one| least.min(one.closest_pair));
        let most = found.iter().map(|one| one.evaluations).max().unwrap_or(0);
        let is_right = found.iter().all(|one| one.is_right);
        let (bar, holds) = match body.bar {
            Bar::Spread(spread) => (
                format!("{:.1} % apart", 100.0 * spread),
                greatest - least < spread,
            ),
            Bar::Spike(spike, apart) => (
                format!("{:.0} %, {apart} ∆s", 100.0 * spike),
                greatest <= spike && closest >= apart,
            ),
        };
        let verdict = match (is_right, holds) {
            (true, true) => "holds",
            (false, _) => "**not all right**",
            (true, false) => "**missed**",
        };
        // A few draws do not tell how far all are apart.
        if !is_quick || matches!(body.bar, Bar::Spike(..)) || !is_right {
            // Whatever else is known: that it is not right never is.
            let what = if is_right { "" } else { ", not all right" };
            rows.push((format!("{}{what}", body.name), verdict == "holds"));
        }
        table.push(&format!(
            "| {} | {} | {draws} | {:.3} % | {:.3} % | {bar} | {closest:.2} | {most} | {verdict} |\n",
            body.name,
            body.spacing,
            100.0 * least,
            100.0 * greatest,
        ));
    }
    Ok(Section {
        text: format!("{ABOUT}{}", table.into_text()),
        rows,
    })
}

impl Body {
    /// The scene of a draw: a box with its lower corner anywhere within ∆s, in some unit.
    fn scene(&self, draw: usize, random: &mut SplitMix64) -> String {
        let exponent = (random.unit() * f64::from(2 * EXPONENTS + 1)).floor() as i32 - EXPONENTS;
        let unit = 10.0_f64.powi(exponent);
        let dimension = match self.shape {
            Shape::Sphere(_) => 3,
            _ => 2,
        };
        let corner = |side: f64, random: &mut SplitMix64| {
            let along = (0..dimension).map(|_| {
                let shift = if side < 0.0 { random.unit() } else { 0.0 };
                format!("{:e}", unit * (side * self.half - shift * self.spacing))
            });
            along.collect::<Vec<_>>().join(", ")
        };
        let (min, max) = (corner(-1.0, random), corner(1.0, random));
        let turn = 360.0 * random.unit();
        let (shape, turned) = match self.shape {
            Shape::Naca(digits) => (
                format!("{{ naca = {{ digits = \"{digits}\", chord = {unit:e} }} }}"),
                true,
            ),
            Shape::Sphere(radius) => (
                format!(
                    "{{ sphere = {{ center = [0.0, 0.0, 0.0], radius = {:e} }} }}",
                    unit * radius
                ),
                false,
            ),
            Shape::Sector(angle, side) => (
                format!(
                    "{{ polygon = {{ points = [{}] }} }}",
                    sector_points(angle, unit * side)
                ),
                true,
            ),
        };
        let turn = if turned {
            format!("rotate_degrees = {turn}\n")
        } else {
            String::new()
        };
        format!(
            "spacing = {:e}\n[domain]\nmin = [{min}]\nmax = [{max}]\n[[body]]\nname = \"body\"\nshape = {shape}\n{turn}[packing]\nseed = {draw}\n",
            unit * self.spacing
        )
    }
}

/// A sector's outline: its tip, and its arc in steps of about a degree.
fn sector_points(degrees: f64, side: f64) -> String {
    let steps = degrees.ceil() as usize;
    let arc = (0..=steps).map(|k| {
        let angle = (degrees * (k as f64 / steps as f64 - 0.5)).to_radians();
        format!("[{:e}, {:e}]", side * angle.cos(), side * angle.sin())
    });
    let points: Vec<String> = std::iter::once("[0.0, 0.0]".to_owned())
        .chain(arc)
        .collect();
    points.join(", ")
}
