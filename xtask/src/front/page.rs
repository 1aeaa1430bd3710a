//! The chart as files: a page that needs no other, all points for programs, a page for the docs.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::advice::{self, short};
use super::errors::Error;
use super::judged;
use super::judges;
use super::sheet::{Price, Sheet};
use super::table::Table;

/// A picture for the docs is no larger.
const MOST_BYTES: usize = 60_000;

/// Writes `index.html`, `points.csv` and the pictures into a folder; `missing` are scenes that are still to come.
pub(super) fn write(folder: &Path, sheets: &[Sheet], missing: &[&str]) -> Result<(), String> {
    let style = "body{font:16px/1.5 system-ui,sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222}\
                 table{border-collapse:collapse;margin:.7em 0}th,td{padding:.2em .7em;border-bottom:1px solid #ddd;text-align:left;font-size:14px}";
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Speed against accuracy</title>\n<style>{style}</style></head><body>\n"
    );
    for part in parts(sheets, missing) {
        page += &match part {
            Part::Heading(1, text) => format!("<h1>{text}</h1>\n"),
            Part::Heading(_, text) => format!("<h2>{text}</h2>\n"),
            Part::Text(text) => format!("<p>{}</p>\n", with_code(&text)),
            Part::Table(table) => table.html().replace("**", ""),
            Part::Picture(sheet) => sheet.svg(),
        };
    }
    page += "</body></html>\n";
    put(&folder.join("index.html"), &page)?;
    put(&folder.join("points.csv"), &csv(sheets))?;
    for sheet in sheets {
        put(
            &folder.join(format!("{}.svg", sheet.place.scene)),
            &sheet.svg(),
        )?;
    }
    Ok(())
}

/// Writes chart.md and its pictures into the folder of the docs.
pub(super) fn document(folder: &Path, sheets: &[Sheet], missing: &[&str]) -> Result<(), String> {
    let mut page = String::new();
    for part in parts(sheets, missing) {
        page += &match part {
            Part::Heading(level, text) => format!("{} {text}\n\n", "#".repeat(level)),
            Part::Text(text) => format!("{text}\n\n"),
            Part::Table(table) => table.markdown() + "\n",
            Part::Picture(sheet) => {
                let (name, svg) = (format!("chart-{}.svg", sheet.place.scene), sheet.svg());
                if svg.len() > MOST_BYTES {
                    format!(
                        "Its picture is in `target/chart/{}.svg`.\n\n",
                        sheet.place.scene
                    )
                } else {
                    put(&folder.join(&name), &svg)?;
                    format!(
                        "![Speed against accuracy, {}]({name})\n\n",
                        sheet.place.scene
                    )
                }
            }
        };
    }
    put(&folder.join("chart.md"), &format!("{}\n", page.trim_end()))
}

/// The advice of [`document`], in its place in the folder of the docs.
pub(super) fn advise(folder: &Path, sheets: &[Sheet]) -> Result<(), String> {
    let path = folder.join("chart.md");
    let page = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let heading = format!("## {ADVICE}\n");
    let cut = page.split_once(heading.as_str());
    let (before, rest) = cut.ok_or_else(|| format!("{} has no \"{ADVICE}\"", path.display()))?;
    let after = rest.find("\n## ").map_or("", |at| &rest[at..]);
    let table = advice::table(sheets).markdown();
    put(
        &path,
        &format!("{before}{heading}\n{}\n\n{table}{after}", advice::RULE),
    )
}

/// The heading of the advice.
const ADVICE: &str = "Which method and settings to take when";

fn put(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Text with what is between backticks as code.
fn with_code(text: &str) -> String {
    let pieces = text.split('`').map(|piece| piece.replace('<', "&lt;"));
    (pieces.enumerate())
        .map(|(k, piece)| {
            if k % 2 == 1 {
                format!("<code>{piece}</code>")
            } else {
                piece
            }
        })
        .collect()
}

/// A piece of a page.
enum Part<'a> {
    Heading(usize, String),
    Text(String),
    Table(Table),
    Picture(&'a Sheet),
}

fn parts<'a>(sheets: &'a [Sheet], missing: &[&str]) -> Vec<Part<'a>> {
    let mut parts = vec![
        Part::Heading(1, "Speed against accuracy".to_owned()),
        Part::Text(about()),
    ];
    if !missing.is_empty() {
        parts.push(Part::Text(format!(
            "Not yet packed: {}. The same command goes on with what is missing.",
            missing.join(", ")
        )));
    }
    parts.extend([
        Part::Heading(2, ADVICE.to_owned()),
        Part::Text(advice::RULE.to_owned()),
        Part::Table(advice::table(sheets)),
    ]);
    for sheet in sheets {
        let Sheet { place, .. } = sheet;
        parts.push(Part::Heading(
            2,
            format!("{}, ∆s = {}", place.scene, place.spacing),
        ));
        parts.push(Part::Picture(sheet));
        parts.push(Part::Text(growth(sheet)));
        parts.push(Part::Table(fronts(sheet)));
        if !sheet.left_out.is_empty() {
            let all: Vec<String> = (sheet.left_out.iter())
                .map(|(name, why)| format!("{name} ({why})"))
                .collect();
            parts.push(Part::Text(format!("Left out: {}.", all.join("; "))));
        }
    }
    parts.push(Part::Heading(
        2,
        "Kernels that pack, kernels that judge".to_owned(),
    ));
    parts.push(Part::Text(
        "The largest |Γ − Γ₀| by each judge, Γ₀ that of the packing's own lattice, of packings that the kernels of the rows made;\n\
         the least of each judge is bold. Each kernel packs from the lattice that rests with it, where there is one."
            .to_owned(),
    ));
    for sheet in sheets {
        parts.push(Part::Text(format!(
            "{}, ∆s = {}:",
            sheet.place.scene, sheet.place.spacing
        )));
        parts.push(Part::Table(judged::table(sheet)));
    }
    parts
}

fn about() -> String {
    let build = if cfg!(debug_assertions) {
        "development profile (optimised, with checks)"
    } else {
        "release profile"
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "Every method with its defaults, and the default, balanced even, with one setting changed at a time; all judged by the\n\
         {} kernel. Regenerate with `cargo xtask chart --data DIR --write`, where DIR holds `bunny.stl`; without it the bunny\n\
         is left out. The page with all pictures is then in `target/chart/index.html`, every point in `target/chart/points.csv`,\n\
         every scene as it was packed in `target/chart/packings`: what is there is not packed again until the code changes, or\n\
         the folder is removed, as it should be before times are measured on a machine at rest. Times are wall-clock seconds on\n\
         {cores} cores, {build}, the quickest of some repeats where they are short; they depend on the machine and on what else it\n\
         does. A packing that takes more than two minutes of processor time is left out, as is said below; in space slow methods\n\
         stop after 2,000 iterations. On the fronts is what nothing else beats in both figures, among packings that have at least\n\
         nine tenths of N_s on the surface and no pair nearer than ∆s/2: a clipped lattice is as even as any lattice, and is\n\
         not the body. \"masses ±1 %\" has masses corrected by so much at most; \"κ\" is `levelling`, \"tolerance\"\n\
         `residual_tolerance`, \"evaluations\" `max_iterations`, a kernel's number its h/∆s. Pairs are those that all\n\
         sums go over, about: whatever the machine. Errors of an interpolated wave and of its derivative (sin(r²/u²), r from the\n\
         middle of the box and u a quarter of its longest edge) are apart from those of the packing's own lattice, undisturbed, by\n\
         so much.",
        judges::name(judges::DENSITY)
    )
}

/// The growth of the default's seconds, in a sentence.
fn growth(sheet: &Sheet) -> String {
    let dimension = sheet.place.dimension as f64;
    match sheet.growth() {
        Some(law) => format!(
            "The default's time grows with the number of particles to the power {:.2} ± {:.2} (one standard error of the fitted slope); particles \
             near the surface alone grow to the power {:.2}.",
            law.exponent,
            law.standard_error,
            (dimension - 1.0) / dimension
        ),
        None => "Too few spacings were packed to say how time grows with the number of particles."
            .to_owned(),
    }
}

/// What is on which front of a scene, and what it comes to.
fn fronts(sheet: &Sheet) -> Table {
    let mut table = Table::new(&["front", "from the cheapest to the most accurate"]);
    for (price, error) in [
        (Price::Seconds, Error::Linf),
        (Price::Evaluations, Error::Linf),
        (Price::Seconds, Error::Residual),
        (Price::Seconds, Error::Function),
        (Price::Seconds, Error::Derivative),
    ] {
        let all: Vec<String> = (sheet.front(price, error).into_iter())
            .map(|(name, [x, y])| format!("{name} ({}, {})", short(x), short(y)))
            .collect();
        table.rows.push(vec![
            format!("{} against {}", error.title(), price.title()),
            all.join("; "),
        ]);
    }
    table
}

/// Every point of every scene.
fn csv(sheets: &[Sheet]) -> String {
    let mut text = "scene,spacing,factor,name,particles,evaluations,pairs,seconds,processor_seconds,peak_memory_bytes,linf,residual,\
                    function_over_lattice,derivative_over_lattice,closest_pair_over_spacing,on_surface_over_target,stop_reason,judged_by,judged_linf\n"
        .to_owned();
    for sheet in sheets {
        let names: Vec<String> = (judges::judges(sheet.place.dimension).iter())
            .map(|&judge| judges::name(judge))
            .collect();
        for (point, figures) in &sheet.measured {
            let some = |value: Option<f64>| value.map_or_else(String::new, |v| v.to_string());
            let judged: Vec<String> = figures.judged.iter().map(f64::to_string).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
                sheet.place.scene,
                point.scene.spacing,
                point.factor.name(),
                point.name,
                figures.particles,
                figures.evaluations,
                figures.pairs,
                figures.seconds,
                figures.processor_seconds,
                figures.peak_memory_bytes,
                figures.linf,
                figures.residual,
                some(figures.function),
                some(figures.derivative),
                figures.closest_pair,
                figures.on_surface,
                figures.stop_reason,
                names.join(";"),
                judged.join(";"),
            );
        }
    }
    text
}
