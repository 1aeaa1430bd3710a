//! A slice through a scene in space: one layer of particles.

use sphpack_packing::Kind;
use sphpack_separation::Side;

use super::Subject;
use super::colour::Scale;
use super::marks::{Anchor, LABEL, Mark, Sheet};
use super::plane::{View, particle};

/// The letters of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// A plane across an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cut {
    /// 0, 1 or 2.
    pub(super) axis: usize,
    /// Where along it.
    pub(super) at: f64,
}

impl Cut {
    /// Through the middle of the first body, across the axis that shows most of the solid.
    pub(super) fn of(subject: &Subject<'_>) -> Self {
        let table = subject.table;
        let first = first_body(subject);
        let solid: Vec<[f64; 3]> = (0..table.len())
            .filter(|&i| table.side[i] == Side::Solid && table.body[i] == first)
            .map(|i| table.position[i])
            .collect();
        let middle: [f64; 3] = if solid.is_empty() {
            let [a, b] = subject.domain;
            std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
        } else {
            std::array::from_fn(|k| {
                let (low, high) = solid
                    .iter()
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| {
                        (l.min(p[k]), h.max(p[k]))
                    });
                0.5 * (low + high)
            })
        };
        let shown = |axis: usize| {
            solid
                .iter()
                .filter(|p| (p[axis] - middle[axis]).abs() < 0.5 * subject.spacing)
                .count()
        };
        // The last of equals is z, which people expect; a few particles more do not turn the picture.
        let counts: [usize; 3] = std::array::from_fn(shown);
        let most = counts.into_iter().max().unwrap_or(0);
        let axis = (0..3)
            .rev()
            .find(|&axis| counts[axis] as f64 >= 0.9 * most as f64)
            .unwrap_or(2);
        Self {
            axis,
            at: middle[axis],
        }
    }

    /// The two axes of the picture, to the right and up.
    fn across(self) -> [usize; 2] {
        match self.axis {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        }
    }
}

/// The first body that has particles.
fn first_body(subject: &Subject<'_>) -> Option<u16> {
    subject.table.body.iter().flatten().min().copied()
}

/// Draws the slice into a box of the sheet, and below it what it shows and how long things are in it.
pub(super) fn add(
    sheet: &mut Sheet,
    subject: &Subject<'_>,
    scale: Scale,
    [left, top]: [f64; 2],
    size: f64,
) {
    let cut = Cut::of(subject);
    let [h, v] = cut.across();
    let radius = 0.5 * subject.spacing;
    let [a, b] = subject.domain;
    let depth = subject
        .table
        .position
        .iter()
        .fold(0.0, |most: f64, p| most.max(a[h] - p[h]).max(a[v] - p[v]))
        .min(4.5 * subject.spacing);
    let low = [a[h] - depth - radius, a[v] - depth - radius];
    let high = [b[h] + depth + radius, b[v] + depth + radius];
    let zoom = size / (high[0] - low[0]).max(high[1] - low[1]);
    let view = View {
        low,
        origin: [
            left + 0.5 * (size - zoom * (high[0] - low[0])),
            top + 0.5 * (size + zoom * (high[1] - low[1])),
        ],
        zoom,
    };
    let table = subject.table;
    // Particles of a slice overlap: it is a spacing thick, and a lattice has several layers in that.
    let own = |i: usize| table.spacing_of(i);
    let is_near = |i: usize| {
        let p = table.position[i];
        (p[cut.axis] - cut.at).abs() < 0.5 * own(i)
            && (low[0]..=high[0]).contains(&p[h])
            && (low[1]..=high[1]).contains(&p[v])
    };
    for rank in [Kind::Frozen, Kind::Free, Kind::Boundary, Kind::Fixed] {
        for i in (0..table.len()).filter(|&i| table.kind[i] == rank && is_near(i)) {
            let rim = match (rank, table.side[i]) {
                (Kind::Boundary | Kind::Fixed, _) => 0.18,
                (_, Side::Solid) => 0.07,
                _ => 0.0,
            };
            let p = table.position[i];
            sheet.marks.push(particle(
                rank,
                view.place([p[h], p[v]]),
                0.85 * own(i) * zoom,
                scale.colour(table.gamma[i]),
                rim,
            ));
        }
    }
    sheet.marks.push(Mark::Line {
        points: [[a[h], a[v]], [b[h], a[v]], [b[h], b[v]], [a[h], b[v]]]
            .map(|p| view.place(p))
            .to_vec(),
        is_closed: true,
        width: 1.0,
    });
    sheet.text(
        [left + 0.5 * size, top + size + 26.0],
        LABEL,
        Anchor::Middle,
        format!(
            "slice {} = {}, {} right, {} up; rings: solid, thick ones: surface",
            AXES[cut.axis],
            rounded(cut.at, subject.spacing),
            AXES[h],
            AXES[v]
        ),
    );
    sheet.length_bar([left, top + size + 62.0], 0.25 * size, zoom);
}

/// A place to a hundredth of a spacing.
fn rounded(value: f64, spacing: f64) -> String {
    let digits = (2.0 - spacing.log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    match text {
        "-0" => "0".to_owned(),
        other => other.to_owned(),
    }
}
