//! The page of maps for users, a section for each map and method; sections that are not made anew stay.

use std::fmt::Write as _;
use std::fs;

use super::bench::{METHODS, Method};
use super::edges::{Grid, sentences};
use super::panel::{Map, Panel};
use super::picture;
use super::table::MAPS;
use crate::workspace::root;

const PAGE: &str = "docs/failure-maps.md";

const HEAD: &str = "# Failure maps: what to expect at your corner

Where each method stops working: how sharp, how thin, how near, how small. Look for what your body has that is out of the
ordinary, and read off whether to expect an even packing, an uneven one, or a message.

Each tile of a map is one scene, packed by the command as you would run it, all settings the defaults but those that the map is of, and
judged by a program that shares no code with it ([reliability.md](reliability.md)): every body has its volume, no particle is on the wrong side, no two are
nearer than half a spacing, all sums are what brute force says.

- **passes**: so judged, the density's largest deviation from its median (L∞, the number in the tile, in %) is at most 1 %, and no pair
  is nearer than 0.6 ∆s.
- **degraded**: judged right, but less even than that, or a part too small for a particle got none, and a warning says so.
- **refused**: exit status 2 before any work, with the reason.
- **exit 3, said**: worked on, and said that it is not settled or not sound, with the place.
- **fails in silence**: exit status 0, and wrong: a fault of ours.

All lengths are in spacings ∆s: a wall that is 2 ∆s thick in the map is 2 ∆s thick in your scene. Where your tile is not blue, a finer
spacing moves you along the axis; `[refinement]` does so near one body only. Methods other than the default are asked for bodies up to 40 ∆s.

Regenerate the sections of a map with `cargo xtask stability map NAME --write` (of one method with `--method METHOD`), all of them with
`cargo xtask stability map --write`. Results are kept in target/maps and taken from there until the code changes.
";

/// The file name of a picture.
fn picture_name(map: &Map, method: Method) -> String {
    format!("failure-map-{}-{}.svg", map.name, method.name)
}

/// What the map of a method has to say, with its picture.
pub(super) struct Section {
    pub(super) text: String,
    /// The file name in docs, and what is in it.
    picture: (String, String),
}

impl Section {
    pub(super) fn of(map: &Map, method: Method, panels: &[(&Panel, Grid)]) -> Self {
        let (title, name) = (title(map, method), picture_name(map, method));
        let mut text = format!("### {title}\n\n![{title}]({name})\n\n");
        for (panel, grid) in panels {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "- {}. {}", panel.title, sentences(panel, grid));
        }
        Self {
            text,
            picture: (name, picture::svg(&title, panels)),
        }
    }

    /// Puts it in its place in the page, and its picture beside it.
    pub(super) fn write(&self, map: &Map, method: Method) -> Result<(), String> {
        let (name, svg) = &self.picture;
        put(&format!("docs/{name}"), svg)?;
        let old = fs::read_to_string(root().join(PAGE)).unwrap_or_default();
        put(PAGE, &placed(&old, &title(map, method), &self.text))
    }
}

fn title(map: &Map, method: Method) -> String {
    format!("{}, by {}", map.title, method.name)
}

fn put(name: &str, text: &str) -> Result<(), String> {
    let path = root().join(name);
    fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
}

/// The page with a section in place of an old one of this title, all in the order of maps and methods.
fn placed(old: &str, new: &str, text: &str) -> String {
    let mut page = HEAD.to_owned();
    for map in &MAPS {
        let sections: Vec<String> = (METHODS.into_iter())
            .filter_map(|method| {
                let title = title(map, method);
                if title == new {
                    Some(text.to_owned())
                } else {
                    section(old, &title)
                }
            })
            .collect();
        if sections.is_empty() {
            continue;
        }
        // Writing to a string cannot fail.
        let _ = writeln!(page, "\n## {}\n\n{}", map.title, map.about);
        for section in sections {
            let _ = writeln!(page, "\n{}", section.trim_end());
        }
    }
    page
}

/// The section of a title in a page.
fn section(page: &str, title: &str) -> Option<String> {
    let heading = format!("### {title}");
    let mut lines = page.lines().skip_while(|line| *line != heading);
    let mut text = format!("{}\n", lines.next()?);
    for line in lines.take_while(|line| !line.starts_with("##")) {
        text.push_str(line);
        text.push('\n');
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_stay_in_the_order_of_maps_and_methods() {
        let of = |map: usize, method: usize| title(&MAPS[map], METHODS[method]);
        let mut page = String::new();
        for (map, method, words) in [(1, 1, "b"), (0, 0, "a"), (1, 0, "c"), (0, 0, "d")] {
            let title = of(map, method);
            page = placed(&page, &title, &format!("### {title}\n\n{words}\n"));
        }
        let [first, second] =
            [&MAPS[0], &MAPS[1]].map(|map| format!("\n## {}\n\n{}\n", map.title, map.about));
        let expected = format!(
            "{HEAD}{first}\n### {}\n\nd\n{second}\n### {}\n\nc\n\n### {}\n\nb\n",
            of(0, 0),
            of(1, 0),
            of(1, 1)
        );
        assert_eq!(page, expected);
    }
}
