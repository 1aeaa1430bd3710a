//! Words of solvers for what a scene calls `spacing` and `h_over_spacing`.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Scene;
use super::document::Document;
use super::wrong::Wrong;

/// The particle spacing, as DualSPHysics (`dp`) and PySPH (`dx`) call it.
const SPACINGS: [&str; 2] = ["dp", "dx"];

/// The tables that have a smoothing length.
const TABLES: [&str; 2] = ["packing", "quality"];

/// A scene's own key for it.
const RATIO: &str = "h_over_spacing";

/// What a word makes of the smoothing length h, for particles of the spacing ∆s in D dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Meaning {
    /// `hdx` of PySPH, `hdp` of DualSPHysics: h/∆s.
    Ratio,
    /// `h` itself, a length.
    Length,
    /// `coefh` of DualSPHysics: h = coefh √(D ∆s²), half the diagonal of a cell for coefh = 0.5.
    OfDiagonal,
}

const LENGTHS: [(&str, Meaning); 4] = [
    ("hdx", Meaning::Ratio),
    ("hdp", Meaning::Ratio),
    ("h", Meaning::Length),
    ("coefh", Meaning::OfDiagonal),
];

/// What was read as something else.
#[derive(Debug, Default)]
pub(super) struct Read {
    /// A sentence about each.
    notes: Vec<String>,
    /// The tables whose ratio needs more than the number that is written.
    ratios: Vec<(&'static str, Meaning)>,
}

/// Gives values that are written by a solver's words the keys of scenes. Their numbers stay until [`Read::settle`].
pub(super) fn translate(document: &mut Document<'_>) -> Result<Read, Wrong> {
    let mut read = Read::default();
    let is_graded = document.table.contains_key("refinement");
    if let Some((word, _)) = renamed(&mut document.table, "", &SPACINGS, "spacing")? {
        read.notes.push(format!("{word} is read as spacing"));
    }
    for name in TABLES {
        let Some(DeValue::Table(table)) = document.table.get_mut(name).map(Spanned::get_mut) else {
            continue;
        };
        let words = LENGTHS.map(|(word, _)| word);
        let Some((word, at)) = renamed(table, &format!("{name}."), &words, RATIO)? else {
            continue;
        };
        let meaning = (LENGTHS.into_iter()).find(|(known, _)| *known == word);
        let (word, meaning) = meaning.unwrap_or((RATIO, Meaning::Ratio));
        if is_graded && meaning == Meaning::Length {
            return Err(Wrong {
                at: Some(at),
                message: format!(
                    "{name}.{word} is one length, and with [refinement] every particle has its own; write {RATIO} = …, the ratio of both"
                ),
            });
        }
        let how = match meaning {
            Meaning::Ratio => format!("{name}.{word} is read as {RATIO}"),
            Meaning::Length => {
                format!("{name}.{word} is read as a length: {RATIO} = {word} / spacing")
            }
            Meaning::OfDiagonal => {
                format!("{name}.{word} is read as {RATIO} = {word} x sqrt(D), in D dimensions")
            }
        };
        read.notes.push(how);
        if meaning != Meaning::Ratio {
            read.ratios.push((name, meaning));
        }
    }
    Ok(read)
}

impl Read {
    /// Makes ratios of the numbers that were written, as far as the dimension is known, and leaves the notes with the scene.
    pub(super) fn settle(self, scene: &mut Scene) {
        for (name, meaning) in &self.ratios {
            let spacing = scene.spacing;
            let (ratio, of_diagonal) = match *name {
                "packing" => (
                    &mut scene.packing.h_over_spacing,
                    &mut scene.packing.h_over_diagonal,
                ),
                _ => (
                    &mut scene.quality.h_over_spacing,
                    &mut scene.quality.h_over_diagonal,
                ),
            };
            match meaning {
                Meaning::Ratio => {}
                Meaning::Length => *ratio = ratio.map(|h| rounded(h / spacing)),
                Meaning::OfDiagonal => *of_diagonal = ratio.take(),
            }
        }
        scene.notes.extend(self.notes);
        let of_shapes = scene.body.iter().find_map(|body| body.shape.dimension());
        if let Some(dimension) = (scene.domain.min.as_ref().map(Vec::len)).or(of_shapes) {
            scene.settle_diagonals(dimension);
        }
    }
}

impl Scene {
    /// What a `coefh` comes to, once the dimension is known.
    pub(crate) fn settle_diagonals(&mut self, dimension: usize) {
        let diagonal = (dimension as f64).sqrt();
        for (ratio, of_diagonal) in [
            (
                &mut self.packing.h_over_spacing,
                &mut self.packing.h_over_diagonal,
            ),
            (
                &mut self.quality.h_over_spacing,
                &mut self.quality.h_over_diagonal,
            ),
        ] {
            if let Some(coefficient) = of_diagonal.take() {
                *ratio = Some(rounded(coefficient * diagonal));
            }
        }
    }
}

/// Without the last digits, which the division leaves: 0.12 / 0.1 is 1.2.
fn rounded(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}

/// Gives the value of one of some words the key that they stand for: the word, and its place. `of` is the table's name in
/// messages.
fn renamed<'w>(
    table: &mut DeTable<'_>,
    of: &str,
    words: &[&'w str],
    key: &'static str,
) -> Result<Option<(&'w str, Range<usize>)>, Wrong> {
    let mut written = (words.iter().copied()).filter(|word| table.contains_key(*word));
    let Some(word) = written.next() else {
        return Ok(None);
    };
    let other = written.next().or(table.contains_key(key).then_some(key));
    let Some((name, value)) = table.remove_entry(word) else {
        return Ok(None);
    };
    if let Some(other) = other {
        return Err(Wrong {
            at: Some(name.span()),
            message: format!(
                "{of}{word} and {of}{other} are both given, and are two words for the same; keep one"
            ),
        });
    }
    let at = name.span();
    table.insert(Spanned::new(name.span(), key.into()), value);
    Ok(Some((word, at)))
}
