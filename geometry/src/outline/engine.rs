//! The overlay engine, behind one function: only this file and those who name its rules know it.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::ShapeType;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::overlay::FloatOverlay;
use i_overlay::i_float::adapter::FloatPointAdapter;
use i_overlay::i_float::float::rect::FloatRect;
use sphpack_neighbors::Bounds;

/// By how much the grid is larger than what lies on it, in parts of that: a crossing may be rounded to a place beyond.
const MARGIN: f64 = 1e-14;

/// Beyond this the engine does not compute (its limit is 2⁵⁰⁰).
const LARGEST: f64 = 1e150;

/// The shapes that a rule leaves of loops and others; each an outer loop, counter-clockwise, and its holes, clockwise. The
/// engine's 64-bit grid moves points by 10⁻¹⁶ of their extent. Nothing where coordinates are beyond 10¹⁵⁰.
pub(super) fn overlay(
    loops: &[Vec<[f64; 2]>],
    others: &[Vec<[f64; 2]>],
    rule: OverlayRule,
    fill: FillRule,
) -> Vec<Vec<Vec<[f64; 2]>>> {
    let boxes = loops
        .iter()
        .chain(others)
        .filter(|points| !points.is_empty());
    let Some(bounds) = boxes.map(|points| Bounds::of(points)).reduce(Bounds::union) else {
        return Vec::new();
    };
    let bounds = bounds.grown(MARGIN * bounds.diagonal());
    let ([x, y], [x_end, y_end]) = (bounds.min, bounds.max);
    if [x, y, x_end, y_end].iter().any(|c| c.abs() > LARGEST) {
        return Vec::new();
    }
    let Ok(rect) = FloatRect::new(x, x_end, y, y_end) else {
        return Vec::new();
    };
    let adapter = FloatPointAdapter::<[f64; 2], i64>::new_conservative(rect);
    let points = loops.iter().chain(others).map(Vec::len).sum();
    FloatOverlay::with_adapter(adapter, points)
        .unsafe_add_source(loops, ShapeType::Subject)
        .unsafe_add_source(others, ShapeType::Clip)
        .overlay(rule, fill)
}
