//! Bodies in parts, packed at many spacings and judged part by part by code that shares nothing with what packs.

mod boxes;
mod contacts;
mod drawn;
mod frame;
mod giants;
mod kinds;
mod plane;
mod row;
mod shapes;
mod space;
mod thin;
mod turned;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use sphpack::{Options, Scene, run as pack};
use sphpack_packing::{Kind, Silent};

use crate::arguments::Arguments;
use crate::workspace::root;
use row::{CLOSEST, LINF, Row};

/// Spacings of each case, from a tenth of its smallest part to half of it.
const SPACINGS: usize = 40;

/// Of these, in the short form.
const QUICK_SPACINGS: usize = 2;

/// From the bodies to the sides of the box, in ∆s.
const MARGIN: f64 = 6.0;

/// A particle as the judge sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Particle {
    place: [f64; 3],
    is_solid: bool,
    volume: f64,
}

/// A connected piece of space.
#[derive(Debug, Clone)]
pub(crate) struct Region {
    name: String,
    /// Exact.
    volume: f64,
}

/// A body in parts.
pub(crate) trait Case {
    fn name(&self) -> &'static str;

    /// 2 or 3.
    fn dimension(&self) -> usize;

    /// How thin its thinnest part is.
    fn size(&self) -> f64;

    /// Writes the body to a file in a folder, and gives its name.
    fn write(&self, folder: &Path) -> Result<String, String>;

    /// Every part and every pocket but the fluid around all.
    fn regions(&self) -> Vec<Region>;

    /// The region of a particle.
    fn region(&self, particle: &Particle) -> Option<usize>;
}

/// What to run.
#[derive(Debug, Clone, Default)]
pub(crate) struct Settings {
    quick: bool,
    only: Option<String>,
    write: bool,
}

impl Settings {
    /// A few spacings of the bodies in the plane.
    pub(crate) fn quick() -> Self {
        Self {
            quick: true,
            ..Self::default()
        }
    }

    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--quick", "--only NAME", "--write"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        Ok(Self {
            quick: arguments.has("--quick"),
            only: arguments.text("--only"),
            write: arguments.has("--write"),
        })
    }
}

/// Packs and judges them all; fails where any of them is wrong.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let folder = root().join("target/bodies");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut rows: Vec<Row> = Vec::new();
    let path = root().join("docs/bodies.md");
    // Rows of other runs stay; each is written when it is there.
    let write = |rows: &[Row]| {
        if !settings.write {
            return Ok(());
        }
        let old = fs::read_to_string(&path).unwrap_or_default();
        fs::write(&path, document(&old, rows))
            .map_err(|error| format!("{}: {error}", path.display()))
    };
    let is_asked = |name: &str| settings.only.as_deref().is_none_or(|only| only == name);
    // The short form leaves space out.
    let space = if settings.quick {
        Vec::new()
    } else {
        space::cases()
    };
    for case in plane::cases() {
        if is_asked(case.name()) {
            rows.push(judge(case.as_ref(), &folder, settings.quick)?);
            println!("{}", rows.last().map(line).unwrap_or_default());
            write(&rows)?;
        }
    }
    for kind in kinds::KINDS {
        if is_asked(kind.name) {
            rows.push(kinds::row(kind, &folder, settings.quick)?);
            println!("{}", rows.last().map(line).unwrap_or_default());
            write(&rows)?;
        }
    }
    for case in space {
        if is_asked(case.name()) {
            rows.push(judge(case.as_ref(), &folder, settings.quick)?);
            println!("{}", rows.last().map(line).unwrap_or_default());
            write(&rows)?;
        }
    }
    let wrong: Vec<String> = rows.into_iter().flat_map(|row| row.wrong).collect();
    if wrong.is_empty() {
        Ok(())
    } else {
        Err(format!("wrong, and not said:\n{}", wrong.join("\n")))
    }
}

fn judge(case: &dyn Case, folder: &Path, quick: bool) -> Result<Row, String> {
    let file = case.write(folder)?;
    let count = if quick { QUICK_SPACINGS } else { SPACINGS };
    let mut row = Row::new(case.name());
    for k in 0..count {
        let step = k as f64 / (count - 1) as f64;
        // The short form begins with a quarter of the size.
        let most = if quick { 4.0 } else { 10.0 };
        let spacing = case.size() / most * (0.5 * most).powf(step);
        row.scenes += 1;
        let text = format!(
            "spacing = {spacing:?}\n[domain]\nmargin = {:?}\n[[body]]\nname = \"body\"\nshape = {{ file = {file:?} }}\n",
            MARGIN * spacing
        );
        let path = folder.join("scene.toml");
        let scene = Scene::parse(&text, &path).map_err(|error| error.to_string())?;
        let Ok(outcome) = pack(&scene, &Options::default(), &mut Silent) else {
            row.refused += 1;
            continue;
        };
        let report = &outcome.report;
        if !(report.converged && report.audit.passed) {
            row.said += 1;
            continue;
        }
        let table = &outcome.table;
        let particles = (0..table.len())
            .filter(|&i| table.kind[i] != Kind::Frozen)
            .map(|i| Particle {
                place: table.position[i],
                is_solid: table.body[i].is_some(),
                volume: table.volume[i],
            });
        let regions = case.regions();
        let mut held = vec![0.0; regions.len()];
        for particle in particles {
            if let Some(region) = case.region(&particle) {
                held[region] += particle.volume;
            }
        }
        let each = spacing.powi(case.dimension() as i32);
        let mut worst: f64 = 0.0;
        for (region, held) in regions.iter().zip(held) {
            // Half a particle, or one in a hundred.
            let allowed = (0.5 * each).max(0.01 * region.volume);
            let off = (held - region.volume) / allowed;
            // What is too small for a particle has none, which is said.
            let is_omitted = held == 0.0 && region.volume < 0.5 * each;
            if off.abs() > 1.0 + 1e-9 && !is_omitted {
                row.wrong.push(format!(
                    "{} at {spacing:.5}: {} has {:+.2} particles",
                    case.name(),
                    region.name,
                    off * allowed / each
                ));
            }
            worst = worst.max(off.abs());
        }
        let closest = report.closest_pair_over_spacing;
        row.right += usize::from(worst <= 1.0 + 1e-9);
        row.even += usize::from(report.density.linf <= LINF && closest >= CLOSEST);
        row.worst = [
            row.worst[0].max(worst),
            row.worst[1].max(report.density.linf),
            row.worst[2].min(closest),
        ];
    }
    Ok(row)
}

fn line(row: &Row) -> String {
    format!(
        "| {} | {} | {} | {} | {} | {} | {} | {:.2} | {:.2} % | {:.2} |",
        row.name,
        row.scenes,
        row.right,
        row.even,
        row.said,
        row.refused,
        row.wrong.len(),
        row.worst[0],
        100.0 * row.worst[1],
        row.worst[2]
    )
}

/// The page, with the rows of an old one that are not among the new ones before these.
fn document(old: &str, rows: &[Row]) -> String {
    let mut text = format!(
        "# Bodies in parts

Regenerate this page with `cargo xtask bodies --write`. Every body is packed at {SPACINGS} spacings, from a tenth of its thinnest
part to half of it, by the default method. The judge tells by winding numbers and plain shapes which part or pocket a
particle is in, and compares their volumes with the exact ones. *Right*: every part and every pocket has its mass to half a
particle, or to 1 % where that is more. *Even*: L∞ of the density at most {:.1} % and no pair nearer than {CLOSEST} ∆s.
*Said*: exit status 3 with the place and the cure. *Wrong*: done, but a mass is off, or what else is asked.

Below are random bodies at one spacing each, judged by their own formulas: none of the body outside it, none of the fluid more than
0.12 ∆s inside, its volume to half a particle or 1 %, no two particles nearer than half a spacing.
*Walls* and *periodic cells* pass a side of the box, lie on one, are as long as the box or meet their images, in the plane and in space; volumes
are by counting cells of the box, images are counted. *Thin* are strips and plates of 0.02 to 6 ∆s at any angle, two in five of them watertight:
then no gap along the middle of a strip is wider than 1.2 ∆s, no hole of a plate wider than that times √2, a fifth more than in a layer of
squares. *Contacts* are blocks of one
file that share a side, a part of one, an edge or a point, or are flush at their ends; no surface particle is on an inner wall. *Turned parts* are
pipes with flanges or fins, cones, needles, sharp rings and cups, at 1/25 to 1/50 of the diagonal. *Giants* are 10 to 10⁵ ∆s large in a box of 7 to 12 ∆s, two in five with a
ball that cuts them or is cut by them.

Small and narrow parts that would not settle evenly with as many particles as lengths and volumes ask for get counts that were
tried out (`packing/src/methods/balanced/tried.rs`): with the usual ones 22 of the 40 packings of sixteen squares are even, with those 40. Around
what an energy still leaves uneven, as in the fluid between sides that are a half-odd number of ∆s apart, a last stage takes steps down the densities and
close pairs themselves (`packing/src/finish/uneven.rs`): without it 27 of 40 packings of blocks that face each other are even, 23 of the window, 35 of
the target, 38 of the strips. What is not even after it is coarse: pockets of fluid two to three ∆s wide, whose volume asks for one particle more or
less than the room between their sides holds, and gaps of some 0.4 ∆s where three bodies meet. Two other cures were tried and do not pay: as many particles on
the sides as make whole rows is worse, for the sides' rows stay ∆s/2 deep while evenness wants them half a row's width deep;
corners that slide take mass out of the corners, and are half a cure where the body turns inward.

| body | scenes | right | even | said | refused | wrong | worst mass, in allowances | worst L∞ | closest pair |
|---|---|---|---|---|---|---|---|---|---|
",
        100.0 * LINF
    );
    let is_new = |line: &str| {
        let name = line.trim_start_matches("| ").split(" |").next();
        rows.iter().any(|row| Some(row.name.as_str()) == name)
    };
    let kept = (old
        .lines()
        .skip_while(|line| !line.starts_with("|---"))
        .skip(1))
    .filter(|line| line.starts_with("| ") && !is_new(line));
    for line in kept.map(str::to_owned).chain(rows.iter().map(line)) {
        let _ = writeln!(text, "{line}");
    }
    text
}
