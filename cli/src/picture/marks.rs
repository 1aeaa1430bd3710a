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
    /// A text; `at` is the middle of its capitals.
    Text {
        at: [f64; 2],
        size: f64,
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

/// Letter size of headings, pixels.
pub(super) const HEADING: f64 = 32.0;
/// Letter size of labels, pixels.
pub(super) const LABEL: f64 = 22.0;
/// Room that the colour bar takes with its labels, pixels.
pub(super) const BAR_ROOM: f64 = 220.0;
/// Right of labels, pixels.
const EDGE: f64 = 16.0;

impl Sheet {
    pub(super) fn text(
        &mut self,
        at: [f64; 2],
        size: f64,
        anchor: Anchor,
        text: impl Into<String>,
    ) {
        self.marks.push(Mark::Text {
            at,
            size,
            anchor,
            text: text.into(),
        });
    }

    /// The title at `at`, smaller where it would not end on the sheet.
    pub(super) fn title(&mut self, at: [f64; 2], title: String) {
        let room = self.width as f64 - 2.0 * at[0];
        self.text_within(at, room, HEADING, title);
    }

    /// A text that begins at `at`, smaller than `size` where it would be wider than `room`.
    fn text_within(&mut self, at: [f64; 2], room: f64, size: f64, text: String) {
        let part = room / font::width(&text, size);
        self.text(at, size * part.min(1.0), Anchor::Start, text);
    }

    /// A bar of a round length in scene units, its left end at `at`, no longer than `most`, and below it what it measures; `zoom` has
    /// pixels per scene unit.
    pub(super) fn length_bar(&mut self, [left, y]: [f64; 2], most: f64, zoom: f64) {
        const END: f64 = 6.0;
        let Some(length) = round_below(most / zoom) else {
            return;
        };
        let right = left + length * zoom;
        for points in [
            vec![[left, y], [right, y]],
            vec![[left, y - END], [left, y + END]],
            vec![[right, y - END], [right, y + END]],
        ] {
            self.marks.push(Mark::Line {
                points,
                is_closed: false,
                width: 2.0,
            });
        }
        let unit = if length == 1.0 { "unit" } else { "units" };
        let words = format!("{length} scene {unit}");
        self.text_within([left, y + 28.0], BAR_ROOM - EDGE, LABEL, words);
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
            let room = BAR_ROOM - WIDTH - 18.0 - EDGE;
            let label = format!("{value:.digits$}");
            self.text_within([right + 18.0, y], room, LABEL, label);
        }
        self.text([left, top - 30.0], LABEL, Anchor::Start, "density Γ");
    }
}

/// The greatest of 1, 2 or 5 times a power of ten that is no more than `most`.
fn round_below(most: f64) -> Option<f64> {
    let power = most.log10().floor();
    let step = [5.0, 2.0, 1.0].into_iter();
    let mut lengths = step.map(|step| {
        // By division where it is a fraction: 0.05, not 0.05000000000000001.
        if power < 0.0 {
            step / 10_f64.powf(-power)
        } else {
            step * 10_f64.powf(power)
        }
    });
    lengths.find(|&length| length <= most && length > 0.0 && length.is_finite())
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
                size,
                anchor,
                text,
            } => {
                let left = match anchor {
                    Anchor::Start => at[0],
                    Anchor::Middle => at[0] - 0.5 * font::width(text, *size),
                };
                let from = [left, font::baseline(at[1], *size)];
                font::write(canvas, text, from, *size, INK);
            }
        }
    }
}
