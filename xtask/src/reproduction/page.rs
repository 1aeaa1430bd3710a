//! The reproduction as files: a page with its pictures in it, a table for programs, and curves.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::SCENES;
use super::claims::FIGURES;
use super::row::{Figure, Published, Row};
use super::setup::Setup;
use super::thumbnail::thumbnail;

/// A row, and what came of it.
pub(crate) struct Result {
    pub(crate) row: Row,
    /// None where its body's file is not there.
    pub(crate) ours: Option<f64>,
    /// The figure against h/∆s, where the number is of several.
    pub(crate) curve: Vec<[f64; 2]>,
    pub(crate) verdict: Verdict,
    pub(crate) seconds: f64,
    /// The picture of its packing.
    pub(crate) picture: Option<std::path::PathBuf>,
}

/// How a row ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Within its bar.
    Holds,
    /// Not, as is known.
    KnownMiss,
    /// Not, which nobody knew; or a known miss that holds.
    Changed,
    /// Not judged.
    Beside,
    /// Its body's file is not there.
    NoData,
}

impl Verdict {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::KnownMiss => "known miss",
            Self::Changed => "CHANGED",
            Self::Beside => "beside",
            Self::NoData => "no data",
        }
    }
}

/// What a paper says, in a cell.
pub(crate) fn published(row: &Row) -> String {
    match row.published {
        Published::Text(value) => figure(value),
        Published::Words(words) => words.to_owned(),
    }
}

/// A number in a cell.
pub(crate) fn figure(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size >= 1000.0 => format!("{value:.0}"),
        size if size >= 0.01 => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

/// Writes `index.html`, `summary.json` and `rows.csv` into a folder.
pub(crate) fn write(
    folder: &Path,
    results: &[Result],
    is_quick: bool,
) -> std::result::Result<(), String> {
    let put = |name: &str, text: String| {
        let path = folder.join(name);
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
    };
    put("index.html", html(results, is_quick)?)?;
    let rows: Vec<Value> = results.iter().map(summary).collect();
    let text = serde_json::to_string_pretty(&json!({ "schema": 1, "rows": rows }));
    put(
        "summary.json",
        text.map_err(|error| error.to_string())? + "\n",
    )?;
    let mut csv =
        "paper,figure,scene,spacing,method,measure,published,ours,verdict,seconds\n".to_owned();
    for result in results {
        let row = &result.row;
        let [scene, spacing, method] = row.subject.columns();
        // Writing to a string cannot fail.
        let _ = writeln!(
            csv,
            "{},{},{},{},{},\"{}\",\"{}\",{},{},{:.3}",
            row.paper,
            row.figure,
            scene,
            spacing,
            method,
            row.measure.name(),
            published(row),
            result
                .ours
                .map_or_else(String::new, |value| value.to_string()),
            result.verdict.name(),
            result.seconds
        );
    }
    put("rows.csv", csv)
}

fn summary(result: &Result) -> Value {
    let row = &result.row;
    json!({
        "paper": row.paper,
        "figure": row.figure,
        "scene": row.subject.packing().map(|setup| setup.scene),
        "setup": row.subject.words(),
        "scene_file": row.subject.packing().map(scene_file),
        "taken": row.taken.words(),
        "measure": row.measure.name(),
        "published": match row.published {
            Published::Text(value) => json!(value),
            Published::Words(words) => json!(words),
        },
        "ours": result.ours,
        "verdict": result.verdict.name(),
        "seconds": result.seconds,
    })
}

/// Where a packing's scene is, from the page.
fn scene_file(setup: &Setup) -> String {
    format!("{SCENES}/{}", setup.file_name())
}

/// Pictures of a figure, at most.
const PICTURES: usize = 3;

const HEAD: &str = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Packing, published and ours</title>\n<style>\
body{font:16px/1.5 system-ui,sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222}\
table{border-collapse:collapse;margin:.7em 0}th,td{padding:.2em .7em;border-bottom:1px solid #ddd;text-align:left;font-size:14px}\
td.n{text-align:right;font-variant-numeric:tabular-nums}td.v{white-space:nowrap}.holds{color:#00694c}.miss{color:#a34700}.changed{color:#fff;background:#b00020}\
.pictures{display:flex;flex-wrap:wrap;gap:1em}figure{margin:0;width:540px;max-width:100%}figure:has(:checked){width:100%}figure img{width:100%;cursor:zoom-in}figcaption{font-size:13px;color:#555}\
</style></head><body>\n";

fn html(results: &[Result], is_quick: bool) -> std::result::Result<String, String> {
    let mut out = HEAD.to_owned();
    let form = if is_quick { ", the quick rows" } else { "" };
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "<h1>Packing, published and ours{form}</h1>\n<p>What five papers print about packing, beside what this program gets. \
         Papers go by the numbers of docs/papers.md. A row <em>holds</em> where our number is within its bar; rows <em>beside</em> are not judged. \
         Ratios are the named method's number over the first one's. A packing's name leads to its scene, which <code>sphpack pack FILE</code> packs again. \
         A picture is larger after a click on it.</p>\n"
    );
    // Figures share packings: each picture is shown with the first.
    let mut shown = Vec::new();
    for figure in &FIGURES {
        let own: Vec<&Result> = results
            .iter()
            .filter(|r| (r.row.paper, r.row.figure) == (figure.paper, figure.figure))
            .collect();
        if !own.is_empty() || figure.missing.is_some() {
            section(&mut out, figure, &own, &mut shown)?;
        }
    }
    out.push_str("</body></html>\n");
    Ok(out)
}

fn section<'a>(
    out: &mut String,
    figure: &Figure,
    own: &[&'a Result],
    shown: &mut Vec<&'a Path>,
) -> std::result::Result<(), String> {
    let _ = writeln!(
        out,
        "<h2>{} {}: {}</h2>",
        figure.paper, figure.figure, figure.claim
    );
    if let Some(why) = figure.missing {
        let _ = writeln!(out, "<p>Not yet done: {why}.</p>");
        return Ok(());
    }
    out.push_str("<table><tr><th>packing</th><th>figure</th><th>published</th><th>ours</th><th></th><th>seconds</th></tr>\n");
    for result in own {
        let row = &result.row;
        let class = match result.verdict {
            Verdict::Holds => "holds",
            Verdict::KnownMiss => "miss",
            Verdict::Changed => "changed",
            Verdict::Beside | Verdict::NoData => "",
        };
        let taken = row.taken.words();
        let words = row.subject.words();
        let packing = (row.subject.packing()).map_or_else(
            || words.clone(),
            |setup| format!("<a href=\"{}\">{words}</a>", scene_file(setup)),
        );
        let _ = writeln!(
            out,
            "<tr><td>{packing}{taken}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n v\">{}</td><td class=\"{class}\">{}</td><td class=\"n\">{:.1}</td></tr>",
            row.measure.name(),
            published(row),
            result.ours.map_or_else(|| "–".to_owned(), self::figure),
            result.verdict.name(),
            result.seconds
        );
    }
    out.push_str("</table>\n<div class=\"pictures\">\n");
    let most = shown.len() + PICTURES;
    for result in own {
        let Some(picture) = &result.picture else {
            continue;
        };
        if shown.contains(&picture.as_path()) || shown.len() == most {
            continue;
        }
        shown.push(picture);
        let bytes = thumbnail(picture)?;
        let subject = &result.row.subject;
        let words = subject.words();
        let from = (subject.packing()).map_or_else(String::new, |setup| {
            format!("; scenes/{}.toml", setup.scene)
        });
        let _ = writeln!(
            out,
            "<figure><label><input type=\"checkbox\" hidden><img alt=\"{words}\" src=\"data:image/png;base64,{}\"></label>\
             <figcaption>{words}{from}</figcaption></figure>",
            base64(&bytes),
        );
    }
    out.push_str("</div>\n");
    Ok(())
}

/// RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let all = (0..3).fold(0_u32, |all, k| {
            all << 8 | u32::from(three.get(k).copied().unwrap_or(0))
        });
        for k in 0..4 {
            if k <= three.len() {
                let six = all >> (18 - 6 * k) & 63;
                text.push(char::from(LETTERS[six as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        let of = |text: &str| base64(text.as_bytes());
        assert_eq!(of(""), "");
        assert_eq!(of("f"), "Zg==");
        assert_eq!(of("fo"), "Zm8=");
        assert_eq!(of("foobar"), "Zm9vYmFy");
    }
}
