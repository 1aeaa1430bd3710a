//! `sphpack check`.

use std::fmt::Write as _;

use sphpack_geometry::{HoleLimit, Mesh, Soup};
use sphpack_neighbors::words::{corners, place};

use super::arguments::CheckArguments;
use super::plain_text::visible;
use super::{outputs, say, threads};
use crate::Error;
use crate::body_file::body_format;
use crate::error::{BAD_INPUT, DONE};
use crate::examined::{Examine, Examined, Mend, MendedBody};
use crate::files::AtomicFiles;
use crate::findings::{DefectFound, MeshFindings, OutlineFindings};
use crate::picture::grouped;

/// Holes and shells that are named one by one, at most.
const MOST_LISTED: usize = 8;

pub(super) fn run(arguments: &CheckArguments) -> Result<u8, Error> {
    for (name, value) in [
        ("--spacing", arguments.spacing),
        ("--fill-holes", arguments.fill_holes),
        ("--wrap", arguments.wrap),
    ] {
        if let Some(value) = value
            && !(value > 0.0 && value.is_finite())
        {
            return Err(Error::Usage(format!(
                "{name} is {value}; it must be a positive, finite number"
            )));
        }
    }
    for (name, is_given) in [
        ("--fill-holes", arguments.fill_holes.is_some()),
        ("--wrap", arguments.wrap.is_some()),
    ] {
        if is_given && arguments.repair.is_none() {
            return Err(Error::Usage(format!(
                "{name} goes with --repair OUT.stl: the mended mesh must go somewhere"
            )));
        }
    }
    if arguments.wrap.is_some() && arguments.fill_holes.is_some() {
        return Err(Error::Usage(
            "--wrap closes all holes; leave out --fill-holes".into(),
        ));
    }
    for path in arguments.repair.iter().chain(&arguments.report) {
        outputs::check_name(path)?;
    }
    let dimension = body_format(&arguments.body)?.dimension();
    let (ending, what) = match dimension {
        2 => ("csv", "the mended outline is rows of x,y"),
        _ => ("stl", "the mended mesh is an STL file"),
    };
    if dimension == 2 && (arguments.wrap.is_some() || arguments.fill_holes.is_some()) {
        return Err(Error::Usage(
            "--wrap and --fill-holes are for meshes; an outline is mended by --repair OUT.csv alone".into(),
        ));
    }
    for (path, wanted, words) in [
        (&arguments.repair, ending, what),
        (&arguments.report, "json", "the report is JSON"),
    ] {
        if let Some(path) = path {
            let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
            if ending.as_deref() != Some(wanted) {
                return Err(Error::input(path, format!("{words}; name it .{wanted}")));
            }
        }
    }
    let paths: Vec<_> = arguments.repair.iter().chain(&arguments.report).collect();
    outputs::check(
        &paths,
        std::slice::from_ref(&arguments.body),
        arguments.force,
    )?;
    threads::start(None)?;
    let what = Examine {
        spacing: arguments.spacing,
        mend: match (arguments.wrap, arguments.fill_holes) {
            (Some(cell), _) => Mend::Wrap(cell),
            (None, Some(across)) => Mend::FillHoles(across),
            (None, None) => Mend::AsPacking,
        },
    };
    let (examined, body) = Examined::of(&arguments.body, &what)?;
    let mut files = AtomicFiles::new(arguments.force);
    let mut written = Vec::new();
    if let (Some(path), Some(body)) = (&arguments.repair, &body) {
        match body {
            MendedBody::Mesh(mesh) => {
                let mended = as_in_a_file(mesh)
                    .map_err(|e| Error::input(path, format!("the mended mesh does not survive the 32-bit numbers of an STL file ({e}); nothing was written")))?;
                files.write(path, |to| mended.write_stl(to))?;
            }
            MendedBody::Outline(outline) => files.write(path, |to| outline.write_csv(to))?,
        }
        written.push(visible(&path.display().to_string()));
    }
    let json = examined.to_json();
    if let Some(path) = &arguments.report {
        files.write(path, |to| to.write_all(json.as_bytes()))?;
        written.push(visible(&path.display().to_string()));
    }
    files.finish()?;
    if arguments.json {
        say(&json)?;
    } else {
        say(&words(&examined, &written, arguments))?;
    }
    Ok(if examined.can_be_packed {
        DONE
    } else {
        BAD_INPUT
    })
}

/// The mesh as it is read again from an STL file, if it still is a body then.
fn as_in_a_file(mesh: &Mesh) -> Result<Soup, sphpack_geometry::GeometryError> {
    let place = |v: u32| mesh.vertices()[v as usize].map(|x| f64::from(x as f32));
    let corners: Vec<[[f64; 3]; 3]> = mesh.triangles().iter().map(|t| t.map(place)).collect();
    // Corners that have become one make triangles that are none.
    let mended = Soup::from_loose(&corners)?.repaired(HoleLimit::Small);
    let soup = mended.soup.clone();
    mended.body()?;
    Ok(soup)
}

fn line(text: &mut String, what: &str, words: &str) {
    let _ = writeln!(text, "  {what:10} {words}");
}

/// Four digits.
fn short(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return x.to_string();
    }
    let digits = (3.0 - x.abs().log10().floor()).clamp(0.0, 300.0) as usize;
    if digits > 8 {
        return format!("{x:.3e}");
    }
    let fixed = format!("{x:.digits$}");
    if fixed.contains('.') {
        fixed.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        fixed
    }
}

fn list(values: &[f64], between: &str) -> String {
    let words: Vec<String> = values.iter().map(|&x| short(x)).collect();
    words.join(between)
}

/// The longest edge of a body's box.
fn longest(examined: &Examined) -> f64 {
    (examined.max.iter().zip(&examined.min))
        .map(|(b, a)| b - a)
        .fold(0.0, f64::max)
}

fn words(examined: &Examined, written: &[String], arguments: &CheckArguments) -> String {
    let mut text = String::new();
    let size: Vec<f64> = (examined.max.iter())
        .zip(&examined.min)
        .map(|(b, a)| b - a)
        .collect();
    line(&mut text, "read", examined.format.description());
    line(
        &mut text,
        "size",
        &format!(
            "{} from {}",
            list(&size, " × "),
            corners(&examined.min, &examined.max)
        ),
    );
    if let Some(mesh) = &examined.mesh {
        mesh_words(&mut text, mesh, longest(examined));
    }
    if let Some(outline) = &examined.outline {
        outline_words(&mut text, outline);
    }
    for (number, repair) in examined.repairs.iter().enumerate() {
        line(&mut text, if number == 0 { "mended" } else { "" }, repair);
    }
    let (measure, volume) = if examined.dimension == 2 {
        ("perimeter", "area")
    } else {
        ("area", "volume")
    };
    if examined.can_be_packed {
        line(
            &mut text,
            "body",
            &format!(
                "{measure} {}, {volume} {}",
                short(examined.measure),
                short(examined.volume)
            ),
        );
    }
    if let Some(thin) = &examined.thin {
        let words = if thin.part_of_surface > 0.0 {
            format!(
                "{} % of the surface bounds parts thinner than ∆s = {}, the thinnest {} near {}",
                short(100.0 * thin.part_of_surface),
                short(thin.spacing),
                short(thin.thinnest),
                place(&thin.place, longest(examined))
            )
        } else {
            format!("nothing is thinner than ∆s = {}", short(thin.spacing))
        };
        line(&mut text, "thin", &words);
    }
    if !written.is_empty() {
        line(&mut text, "wrote", &written.join(", "));
    }
    let verdict = match &examined.reason {
        Some(reason) => {
            let mut verdict = format!("cannot be packed: {reason}");
            let holes = examined.mesh.as_ref().and_then(|mesh| mesh.holes.first());
            if let (Some(hole), None) = (holes, arguments.fill_holes) {
                let _ = write!(
                    verdict,
                    "; or `--repair OUT.stl --fill-holes {}` closes them as flat as can be",
                    short(1.01 * hole.size)
                );
            }
            if examined.mesh.is_some() && arguments.wrap.is_none() {
                let cell = arguments
                    .spacing
                    .map_or(0.01 * longest(examined), |s| 0.25 * s);
                let _ = write!(
                    verdict,
                    "; or `sphpack check {} --repair OUT.stl --wrap {}` makes a new, closed mesh on a grid with cells of that size",
                    visible(&arguments.body.display().to_string()),
                    short(cell)
                );
            }
            verdict
        }
        None if examined.repairs.is_empty() => "can be packed as it is".into(),
        None if arguments.repair.is_some() => "the mended body can be packed".into(),
        None => "can be packed: `sphpack pack` mends this by itself, and says so".into(),
    };
    line(&mut text, "verdict", &verdict);
    text
}

fn mesh_words(text: &mut String, mesh: &MeshFindings, size: f64) {
    line(
        text,
        "mesh",
        &format!(
            "{} triangles, {} vertices",
            grouped(mesh.triangles),
            grouped(mesh.vertices)
        ),
    );
    for (number, shell) in mesh.shells.iter().enumerate().take(MOST_LISTED) {
        let inside = match shell.inside {
            Some(outer) => format!(", inside shell {}", outer + 1),
            None => String::new(),
        };
        let facing = if shell.is_inverted {
            ", inside out"
        } else {
            ""
        };
        line(
            text,
            if number == 0 { "shells" } else { "" },
            &format!(
                "{}: {}{facing}{inside}; {} triangles, area {}, volume {}, from {}",
                number + 1,
                shell.role.name(),
                grouped(shell.triangles),
                short(shell.area),
                short(shell.volume),
                corners(&shell.bounds.min, &shell.bounds.max)
            ),
        );
    }
    if mesh.shells.len() > MOST_LISTED {
        line(
            text,
            "",
            &format!("and {} more", grouped(mesh.shells.len() - MOST_LISTED)),
        );
    }
    defect_words(text, &mesh.defects);
    for (number, hole) in mesh.holes.iter().enumerate().take(MOST_LISTED) {
        line(
            text,
            if number == 0 { "holes" } else { "" },
            &format!(
                "{} edges, {} across, near {}",
                hole.edges,
                short(hole.size),
                place(&hole.place, size)
            ),
        );
    }
    if mesh.holes.len() > MOST_LISTED {
        line(
            text,
            "",
            &format!(
                "and {} smaller ones",
                grouped(mesh.holes.len() - MOST_LISTED)
            ),
        );
    }
}

fn defect_words(text: &mut String, defects: &[DefectFound]) {
    for (number, defect) in defects.iter().enumerate() {
        let what = if number == 0 { "defects" } else { "" };
        line(text, what, &defect.words);
    }
}

fn outline_words(text: &mut String, outline: &OutlineFindings) {
    line(
        text,
        "outline",
        &format!("{} points", grouped(outline.points)),
    );
    for (number, one) in outline.loops.iter().enumerate().take(MOST_LISTED) {
        let inside = match one.inside {
            Some(outer) => format!(", inside loop {}", outer + 1),
            None => String::new(),
        };
        line(
            text,
            if number == 0 { "loops" } else { "" },
            &format!(
                "{}: {}{inside}; {} points, {}, length {}, area {}, from {}",
                number + 1,
                one.role,
                grouped(one.points),
                if one.is_clockwise {
                    "clockwise"
                } else {
                    "counter-clockwise"
                },
                short(one.length),
                short(one.area),
                corners(&one.min, &one.max)
            ),
        );
    }
    if outline.loops.len() > MOST_LISTED {
        line(
            text,
            "",
            &format!("and {} more", grouped(outline.loops.len() - MOST_LISTED)),
        );
    }
    defect_words(text, &outline.defects);
}
