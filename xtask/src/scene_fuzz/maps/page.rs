//! The page of maps for users, a section for each map; sections that are not made anew stay.

use std::fmt::Write as _;
use std::fs;

use super::bench::Method;
use super::edges::{Grid, sentences};
use super::panel::{Map, Panel};
use super::picture;
use super::table::MAPS;
use crate::workspace::root;

const PAGE: &str = "docs/failure-maps.md";

const HEAD: &str = "# Failure maps: what to expect at your corner

Where each method stops working: how sharp, how thin, how near, how small. Look for what your body has that is out of the
ordinary, and read off whether to expect an even packing, an uneven one, or a message.

Each tile of a map is one scene, packed by the command as you would run it, all settings the defaults, and judged by a program that
shares no code with it ([reliability.md](reliability.md)): every body has its volume, no particle is on the wrong side, no two are
nearer than half a spacing, all sums are what brute force says.

- **passes**: so judged, the density's largest deviation from its median (L∞, the number in the tile, in %) is at most 2 %, and no pair
  is nearer than 0.6 ∆s.
- **degraded**: judged right, but less even than that, or a part too small for a particle got none, and a warning says so.
- **refused**: exit status 2 before any work, with the reason.
- **exit 3, said**: worked on, and said that it is not settled or not sound, with the place.
- **fails in silence**: exit status 0, and wrong: a fault of ours.

All lengths are in spacings ∆s: a wall that is 2 ∆s thick in the map is 2 ∆s thick in your scene. Where your tile is not blue, a finer
spacing moves you along the axis; `[refinement]` does so near one body only. Methods other than the default are asked for bodies up to 40 ∆s.

Regenerate a section with `cargo xtask stability map NAME --write`, all of them with `cargo xtask stability map --write`. Results are kept in
target/maps and taken from there until the code changes.
";

/// The file name of a picture.
fn picture_name(map: &Map, method: Method) -> String {
    format!("failure-map-{}-{}.svg", map.name, method.name)
}

/// What a map has to say, with a picture for each method.
pub(super) struct Section {
    pub(super) text: String,
    /// File names in docs, and what is in them.
    pictures: Vec<(String, String)>,
}

impl Section {
    pub(super) fn of(map: &Map, all: &[(Method, Vec<(&Panel, Grid)>)]) -> Self {
        let mut text = format!("## {}\n\n{}\n\n", map.title, map.about);
        let mut pictures = Vec::new();
        for (method, panels) in all {
            let name = picture_name(map, *method);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "### {}, by {}\n", map.title, method.name);
            let _ = writeln!(text, "![{}, by {}]({name})\n", map.title, method.name);
            for (panel, grid) in panels {
                let _ = writeln!(text, "- {}. {}", panel.title, sentences(panel, grid));
            }
            text.push('\n');
            let title = format!("{}, by {}", map.title, method.name);
            pictures.push((name, picture::svg(&title, panels)));
        }
        Self { text, pictures }
    }

    /// Puts it in its place in the page, and its pictures beside it.
    pub(super) fn write(&self, map: &Map) -> Result<(), String> {
        for (name, svg) in &self.pictures {
            put(&format!("docs/{name}"), svg)?;
        }
        let old = fs::read_to_string(root().join(PAGE)).unwrap_or_default();
        put(PAGE, &placed(&old, map.title, &self.text))
    }
}

fn put(name: &str, text: &str) -> Result<(), String> {
    let path = root().join(name);
    fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
}

/// The page with a section of this title in place of an old one, all in the order of the maps.
fn placed(old: &str, title: &str, text: &str) -> String {
    let mut page = HEAD.to_owned();
    for map in &MAPS {
        let section = if map.title == title {
            Some(text.to_owned())
        } else {
            section(old, map.title)
        };
        if let Some(section) = section {
            page.push('\n');
            page.push_str(section.trim_end());
            page.push('\n');
        }
    }
    page
}

/// The section of a title in a page.
fn section(page: &str, title: &str) -> Option<String> {
    let heading = format!("## {title}");
    let mut lines = page.lines().skip_while(|line| *line != heading);
    let mut text = format!("{}\n", lines.next()?);
    for line in lines.take_while(|line| !line.starts_with("## ")) {
        text.push_str(line);
        text.push('\n');
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_stay_in_the_order_of_the_maps() {
        let [first, second] = [MAPS[0].title, MAPS[1].title];
        let page = placed("", second, &format!("## {second}\n\n### a\n\nthin\n"));
        let page = placed(&page, first, &format!("## {first}\n\nsharp\n\n"));
        let page = placed(&page, first, &format!("## {first}\n\nsharper\n"));
        assert_eq!(
            page.strip_prefix(HEAD),
            Some(format!("\n## {first}\n\nsharper\n\n## {second}\n\n### a\n\nthin\n").as_str())
        );
    }
}
