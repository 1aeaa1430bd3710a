//! The picture of a scene in space: a slice on the left, the surface particles as spheres on the right.

use sphpack_neighbors::point;

use super::Subject;
use super::canvas::Canvas;
use super::colour::{Scale, WHITE, mixed};
use super::marks::{Anchor, BAR_ROOM, LABEL, Sheet, paint};
use super::plane::title;
use super::slice;

/// Edge of either panel, pixels.
const PANEL: f64 = 780.0;
/// Around the panels, pixels.
const MARGIN: f64 = 40.0;
/// The title's room, pixels.
const TITLE: f64 = 70.0;
/// Room for the words below the panels, pixels.
const FOOT: f64 = 120.0;
/// Radius of a sphere in ∆s: neighbours overlap, so that the surface closes.
const RADIUS: f64 = 0.58;

/// Draws a scene in space.
pub(super) fn painted(subject: &Subject<'_>) -> Canvas {
    let scale = Scale::holding(subject.table.linf());
    let mut sheet = Sheet {
        width: (2.0 * PANEL + 3.0 * MARGIN + BAR_ROOM) as usize,
        height: (PANEL + TITLE + FOOT) as usize,
        marks: Vec::new(),
    };
    sheet.title([MARGIN, 0.5 * TITLE + 6.0], title(subject));
    slice::add(&mut sheet, subject, scale, [MARGIN, TITLE], PANEL);
    let mut canvas = super::marks::painted(&sheet);
    let left = 2.0 * MARGIN + PANEL;
    let shown: Vec<usize> = (0..subject.table.len())
        .filter(|&i| subject.table.kind[i].is_on_surface())
        .collect();
    // Twice as large, then halved: smooth rims.
    let view = seen(subject, scale, &shown, 2 * PANEL as usize).halved();
    canvas.paste(&view, left as usize, TITLE as usize);
    let mut words = Sheet {
        marks: Vec::new(),
        ..sheet
    };
    words.text(
        [left + 0.5 * PANEL, TITLE + PANEL + 26.0],
        LABEL,
        Anchor::Middle,
        if shown.is_empty() {
            "no particles on surfaces".to_owned()
        } else {
            format!("the {} particles on surfaces", super::grouped(shown.len()))
        },
    );
    words.colour_bar([2.0 * PANEL + 3.0 * MARGIN, TITLE + 0.5 * PANEL], scale);
    paint(&mut canvas, &words.marks);
    canvas
}

/// To the right, up, and towards the eye, for a look from the front right and above; z is up.
fn camera() -> [[f64; 3]; 3] {
    let (sin_turn, cos_turn) = (-55.0_f64).to_radians().sin_cos();
    let (sin_rise, cos_rise) = 25.0_f64.to_radians().sin_cos();
    let towards = [cos_rise * cos_turn, cos_rise * sin_turn, sin_rise];
    let right = [-sin_turn, cos_turn, 0.0];
    [right, point::cross(towards, right), towards]
}

/// Spheres with a z-buffer, in parallel projection.
fn seen(subject: &Subject<'_>, scale: Scale, shown: &[usize], size: usize) -> Canvas {
    let mut canvas = Canvas::new(size, size);
    let axes = camera();
    let table = subject.table;
    let placed: Vec<[f64; 3]> = shown
        .iter()
        .map(|&i| axes.map(|axis| point::dot(axis, table.position[i])))
        .collect();
    let radius = RADIUS * subject.spacing;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in &placed {
        for k in 0..2 {
            low[k] = low[k].min(p[k] - 1.5 * radius);
            high[k] = high[k].max(p[k] + 1.5 * radius);
        }
    }
    let zoom = size as f64 / (high[0] - low[0]).max(high[1] - low[1]);
    if !zoom.is_finite() {
        return canvas;
    }
    let middle: [f64; 2] = std::array::from_fn(|k| 0.5 * (low[k] + high[k]));
    let light = point::unit([-0.45, 0.55, 0.9]).unwrap_or([0.0, 0.0, 1.0]);
    let mut depth = vec![f64::NEG_INFINITY; size * size];
    for (p, &i) in placed.iter().zip(shown) {
        let radius = RADIUS * table.spacing_of(i);
        let colour = scale.colour(table.gamma[i]);
        let center = [
            0.5 * size as f64 + zoom * (p[0] - middle[0]),
            0.5 * size as f64 - zoom * (p[1] - middle[1]),
        ];
        let reach = zoom * radius;
        let range = |c: f64| {
            let clamp = |v: f64| v.clamp(0.0, size as f64) as usize;
            clamp((c - reach).floor())..clamp((c + reach).ceil())
        };
        for y in range(center[1]) {
            for x in range(center[0]) {
                let right = (x as f64 + 0.5 - center[0]) / reach;
                let up = (center[1] - y as f64 - 0.5) / reach;
                let flat = right * right + up * up;
                if flat > 1.0 {
                    continue;
                }
                let normal = [right, up, (1.0 - flat).sqrt()];
                let nearness = p[2] + radius * normal[2];
                let cell = y * size + x;
                if nearness > depth[cell] {
                    depth[cell] = nearness;
                    canvas.pixels[cell] = shaded(colour, normal, light);
                }
            }
        }
    }
    canvas
}

/// A colour in the light: dark where the surface turns away, a little gloss where it mirrors.
fn shaded(colour: [u8; 3], normal: [f64; 3], light: [f64; 3]) -> [u8; 3] {
    let lit = point::dot(normal, light).max(0.0);
    let dark = mixed(colour, [16, 18, 24], 0.62 * (1.0 - lit));
    let half = point::unit(point::add(light, [0.0, 0.0, 1.0])).unwrap_or(light);
    let gloss = point::dot(normal, half).max(0.0).powi(40);
    mixed(dark, WHITE, 0.18 * gloss)
}
