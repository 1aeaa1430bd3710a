//! A sheet of discs, lines and words in pixels, which becomes an SVG or a PNG.

use super::canvas::Canvas;
use super::colour::{Colour, INK, Scale};
use super::font;

/// Where a text's given point is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    /// At its left end.
    Start,
    /// In its middle.
    Middle,
}

/// Something on a sheet; pixels, y down.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Mark {
    /// A filled disc, with a ring of another colour inside its rim.
    Disc {
        center: [f64; 2],
        radius: f64,
        fill: Colour,
        ring: Option<(f64, Colour)>,
    },
    /// A polyline.
    Line {
        points: Vec<[f64; 2]>,
        is_closed: bool,
        width: f64,
    },
    /// A filled rectangle.
    Rectangle {
        from: [f64; 2],
        to: [f64; 2],
        fill: Colour,
    },
    /// A text; `at` is the middle of its height.
    Text {
        at: [f64; 2],
        height: f64,
        anchor: Anchor,
        text: String,
    },
}

/// Marks, drawn one after the other.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sheet {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) marks: Vec<Mark>,
}

/// Height of headings, pixels.
pub(super) const HEADING: f64 = 24.0;
/// Height of labels, pixels.
pub(super) const LABEL: f64 = 16.0;
/// Room that the colour bar takes with its labels, pixels.
pub(super) const BAR_ROOM: f64 = 190.0;

impl Sheet {
    pub(super) fn text(
        &mut self,
        at: [f64; 2],
        height: f64,
        anchor: Anchor,
        text: impl Into<String>,
    ) {
        self.marks.push(Mark::Text {
            at,
            height,
            anchor,
            text: text.into(),
        });
    }

    /// The title at `at`, smaller where it would not end on the sheet: letters are as wide as they are high, at most.
    pub(super) fn title(&mut self, at: [f64; 2], title: String) {
        let room = self.width as f64 - 2.0 * at[0];
        let height = if title.chars().count() as f64 * HEADING <= room {
            HEADING
        } else {
            LABEL
        };
        self.text(at, height, Anchor::Start, title);
    }

    /// The colour bar, its left edge and its middle at `at`.
    pub(super) fn colour_bar(&mut self, at: [f64; 2], scale: Scale) {
        const WIDTH: f64 = 34.0;
        const HEIGHT: f64 = 440.0;
        const STEPS: usize = 220;
        let [left, middle] = at;
        let top = middle - 0.5 * HEIGHT;
        let height_of = |t: f64| middle - 0.5 * HEIGHT * t;
        for step in 0..STEPS {
            let share = step as f64 / STEPS as f64;
            let y = top + HEIGHT * share;
            self.marks.push(Mark::Rectangle {
                from: [left, y],
                to: [left + WIDTH, y + HEIGHT / STEPS as f64],
                fill: scale.colour(1.0 + scale.half * (1.0 - 2.0 * (share + 0.5 / STEPS as f64))),
            });
        }
        let (right, bottom) = (left + WIDTH, top + HEIGHT);
        self.marks.push(Mark::Line {
            points: vec![[left, top], [right, top], [right, bottom], [left, bottom]],
            is_closed: true,
            width: 1.5,
        });
        let digits = (1.0 - (0.5 * scale.half).log10().floor()).clamp(1.0, 12.0) as usize;
        for t in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            let y = height_of(t);
            self.marks.push(Mark::Line {
                points: vec![[right, y], [right + 8.0, y]],
                is_closed: false,
                width: 1.5,
            });
            let value = 1.0 + t * scale.half;
            self.text(
                [right + 14.0, y],
                LABEL,
                Anchor::Start,
                format!("{value:.digits$}"),
            );
        }
        self.text([left, top - 30.0], LABEL, Anchor::Start, "density Γ");
    }
}

/// A sheet in pixels.
pub(super) fn painted(sheet: &Sheet) -> Canvas {
    let mut canvas = Canvas::new(sheet.width, sheet.height);
    paint(&mut canvas, &sheet.marks);
    canvas
}

/// Draws marks on a canvas.
pub(super) fn paint(canvas: &mut Canvas, marks: &[Mark]) {
    for mark in marks {
        match mark {
            Mark::Disc {
                center,
                radius,
                fill,
                ring,
            } => match ring {
                Some((width, colour)) => {
                    canvas.disc(*center, *radius, *colour);
                    canvas.disc(*center, radius - width, *fill);
                }
                None => canvas.disc(*center, *radius, *fill),
            },
            Mark::Line {
                points,
                is_closed,
                width,
            } => {
                let closing = is_closed.then(|| points.first()).flatten();
                let ends = points.iter().skip(1).chain(closing);
                for (a, b) in points.iter().zip(ends) {
                    canvas.line(*a, *b, *width, INK);
                }
            }
            Mark::Rectangle { from, to, fill } => canvas.rectangle(*from, *to, *fill),
            Mark::Text {
                at,
                height,
                anchor,
                text,
            } => {
                let left = match anchor {
                    Anchor::Start => at[0],
                    Anchor::Middle => at[0] - 0.5 * font::width(text, *height),
                };
                font::write(canvas, text, [left, at[1] - 0.5 * height], *height, INK);
            }
        }
    }
}
