//! The picture of a plane scene.

use sphpack_packing::Kind;

use super::colour::{Colour, GREY, INK, Scale};
use super::marks::{Anchor, BAR_ROOM, LABEL, Mark, Sheet};
use super::{Subject, grouped};
use crate::table::Table;

/// Width of the picture, pixels.
const WIDTH: f64 = 1600.0;
/// Height of the picture at least, and of its drawing at most, pixels.
const HEIGHTS: [f64; 2] = [900.0, 1340.0];
/// Around the drawing, pixels.
const MARGIN: f64 = 40.0;
/// The title's room, pixels.
const TITLE: f64 = 70.0;

/// Radius of a particle and of a frozen one, in ∆s.
const RADII: [f64; 2] = [0.46, 0.2];

/// From scene units to pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    /// The scene's lower left corner.
    pub(super) low: [f64; 2],
    /// Where that is on the sheet.
    pub(super) origin: [f64; 2],
    /// Pixels per scene unit.
    pub(super) zoom: f64,
}

impl View {
    /// The place of a point.
    pub(super) fn place(&self, p: [f64; 2]) -> [f64; 2] {
        [
            self.origin[0] + (p[0] - self.low[0]) * self.zoom,
            self.origin[1] - (p[1] - self.low[1]) * self.zoom,
        ]
    }
}

/// How a particle is drawn.
pub(super) fn particle(kind: Kind, center: [f64; 2], spacing: f64, fill: Colour, rim: f64) -> Mark {
    if kind == Kind::Frozen {
        return Mark::Disc {
            center,
            radius: RADII[1] * spacing,
            fill: GREY,
            ring: None,
        };
    }
    Mark::Disc {
        center,
        radius: RADII[0] * spacing,
        fill,
        ring: (rim > 0.0).then_some((rim * spacing, INK)),
    }
}

/// The title line.
pub(super) fn title(subject: &Subject<'_>) -> String {
    let inside = subject
        .table
        .kind
        .iter()
        .filter(|&&k| k != Kind::Frozen)
        .count();
    let name: String = subject
        .name
        .chars()
        .filter(|c| !c.is_control())
        .take(30)
        .collect();
    let unfinished = if subject.is_unfinished {
        ", unfinished"
    } else {
        ""
    };
    let coarsest = (subject.table.spacing.iter()).fold(subject.spacing, |most, &s| most.max(s));
    let spacing = if coarsest > subject.spacing {
        format!(
            "{} … {}",
            three_digits(subject.spacing),
            three_digits(coarsest)
        )
    } else {
        subject.spacing.to_string()
    };
    format!(
        "{name}: ∆s = {spacing}, {} particles, max |Γ − 1| = {:.2} %{unfinished}",
        grouped(inside),
        100.0 * subject.table.linf()
    )
}

/// Three digits that count, without zeros at the end.
fn three_digits(value: f64) -> f64 {
    let unit = 10_f64.powf(2.0 - value.log10().floor());
    (value * unit).round() / unit
}

/// Draws a plane scene.
pub(super) fn sheet(subject: &Subject<'_>) -> Sheet {
    let table = subject.table;
    let scale = Scale::holding(table.linf());
    let radius = RADII[0] * subject.spacing;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in table.position.iter().chain(&subject.domain) {
        for k in 0..2 {
            low[k] = low[k].min(p[k] - radius);
            high[k] = high[k].max(p[k] + radius);
        }
    }
    let size = [high[0] - low[0], high[1] - low[1]];
    let room = [WIDTH - 2.0 * MARGIN - BAR_ROOM, HEIGHTS[1]];
    let zoom = (room[0] / size[0]).min(room[1] / size[1]);
    let drawn = size.map(|s| s * zoom);
    let height = (drawn[1] + TITLE + 2.0 * MARGIN).max(HEIGHTS[0]);
    let view = View {
        low,
        origin: [
            MARGIN + 0.5 * (room[0] - drawn[0]),
            TITLE + 0.5 * (height - TITLE - MARGIN + drawn[1]),
        ],
        zoom,
    };
    let mut sheet = Sheet {
        width: WIDTH as usize,
        height: height.ceil() as usize,
        marks: Vec::with_capacity(table.len() + 300),
    };
    sheet.title([MARGIN, 0.5 * TITLE + 6.0], title(subject));
    let pixels = subject.spacing * zoom;
    for rank in [Kind::Frozen, Kind::Free, Kind::Boundary, Kind::Fixed] {
        let rim = match rank {
            Kind::Boundary => 0.1,
            Kind::Fixed => 0.2,
            _ => 0.0,
        };
        for i in (0..table.len()).filter(|&i| table.kind[i] == rank) {
            let [x, y, _] = table.position[i];
            sheet.marks.push(particle(
                rank,
                view.place([x, y]),
                zoom * table.spacing_of(i),
                scale.colour(table.gamma[i]),
                rim,
            ));
        }
    }
    let [a, b] = subject.domain;
    let corners = [[a[0], a[1]], [b[0], a[1]], [b[0], b[1]], [a[0], b[1]]];
    sheet.marks.push(Mark::Line {
        points: corners.map(|p| view.place(p)).to_vec(),
        is_closed: true,
        width: 1.0,
    });
    for one in subject.loops {
        sheet.marks.push(Mark::Line {
            points: one.iter().map(|&p| view.place(p)).collect(),
            is_closed: true,
            width: (0.08 * pixels).clamp(1.2, 3.0),
        });
    }
    let left = WIDTH - BAR_ROOM;
    let middle = view.origin[1] - 0.5 * drawn[1];
    sheet.colour_bar([left, middle], scale);
    let below = legend(&mut sheet, table, [left, middle + 260.0]);
    sheet.length_bar([left, below + 16.0], BAR_ROOM - 2.0 * MARGIN, zoom);
    sheet
}

/// What rings and small discs mean, of those that there are; gives where it ends.
fn legend(sheet: &mut Sheet, table: &Table, [left, top]: [f64; 2]) -> f64 {
    const SIZE: f64 = 24.0;
    const LINE: f64 = 32.0;
    let middle = super::colour::WHITE;
    let mut y = top;
    for (kind, rim, words) in [
        (Kind::Boundary, 0.1, "boundary"),
        (Kind::Fixed, 0.2, "fixed"),
        (Kind::Frozen, 0.0, "frozen"),
    ] {
        if !table.kind.contains(&kind) {
            continue;
        }
        sheet
            .marks
            .push(particle(kind, [left + 12.0, y], SIZE, middle, rim));
        sheet.text([left + 32.0, y], LABEL, Anchor::Start, words);
        y += LINE;
    }
    y
}
