//! Outlines joined, intersected and cut.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use sphpack_neighbors::{Bounds, point};

use super::{Outline, engine, offset, winding_number};
use crate::segment::signed_area;

/// Pieces and holes that are thinner on average than this, in parts of the outline's size, are left out: they come of
/// curves that run along each other and are sampled at different points.
const SLIVER: f64 = 1e-6;

impl Outline {
    /// What is left of the body where `other` has all its room, O(n log n) for n points of both; `None` where nothing
    /// is. Exact to 10⁻¹⁵ of the size. Pieces and holes thinner than 10⁻⁶ of the size are left out; pieces may meet in
    /// points.
    ///
    /// ```
    /// use sphpack_geometry::{Outline, Surface};
    /// let square = |x: f64| Outline::polygon(&[[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
    /// let left = square(0.0)?.minus(&square(0.75)?);
    /// assert!(left.is_some_and(|left| (left.volume() - 0.75).abs() < 1e-12));
    /// assert!(square(0.0)?.minus(&square(0.0)?).is_none());
    /// # Ok::<(), sphpack_geometry::GeometryError>(())
    /// ```
    #[must_use]
    pub fn minus(&self, other: &Self) -> Option<Self> {
        self.with(other, OverlayRule::Difference)
    }

    /// What both bodies hold; `None` where that is nothing. As exact, and at the same cost, as [`Outline::minus`].
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        self.with(other, OverlayRule::Intersect)
    }

    /// What either body holds: one outline, of several pieces where the bodies are apart. As exact, and at the same
    /// cost, as [`Outline::minus`]. `None` only where both are thinner than 10⁻⁶ of their common size.
    ///
    /// ```
    /// use sphpack_geometry::{Outline, Surface};
    /// let square = |x: f64| Outline::polygon(&[[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
    /// let (a, b) = (square(0.0)?, square(0.75)?);
    /// assert!(a.union(&b).is_some_and(|whole| (whole.volume() - 1.75).abs() < 1e-12));
    /// assert!(a.intersection(&b).is_some_and(|both| (both.volume() - 0.25).abs() < 1e-12));
    /// # Ok::<(), sphpack_geometry::GeometryError>(())
    /// ```
    #[must_use]
    pub fn union(&self, other: &Self) -> Option<Self> {
        self.with(other, OverlayRule::Union)
    }

    /// The body without its pieces of less than `area` (scene units squared, holes not counted as theirs); `None` where
    /// none is left. O(n) for each piece that is left out.
    #[must_use]
    pub fn without_crumbs(&self, area: f64) -> Option<Self> {
        let is_small = |points: &&[[f64; 2]]| (0.0..area).contains(&signed_area(points));
        let small: Vec<&[[f64; 2]]> = self.loops().filter(is_small).collect();
        if small.is_empty() {
            return Some(self.clone());
        }
        // A hole goes with its piece: their loops may meet in points, so the middle of a side tells.
        let within = |points: &[[f64; 2]], hole: &[[f64; 2]]| {
            let middle = point::scale(point::add(hole[0], hole[1]), 0.5);
            winding_number(points, middle) != 0
        };
        let left: Vec<Vec<[f64; 2]>> = self
            .loops()
            .filter(|points| !is_small(points) && !small.iter().any(|piece| within(piece, points)))
            .map(<[_]>::to_vec)
            .collect();
        (!left.is_empty()).then(|| Self::assemble(left))
    }

    fn with(&self, other: &Self, rule: OverlayRule) -> Option<Self> {
        let size = match rule {
            OverlayRule::Union => self.extent().max(other.extent()),
            _ => self.extent(),
        };
        let loops =
            |outline: &Self| -> Vec<Vec<[f64; 2]>> { outline.loops().map(<[_]>::to_vec).collect() };
        let shapes = engine::overlay(&loops(self), &loops(other), rule, FillRule::NonZero);
        let left = without_slivers(shapes, size);
        (!left.is_empty()).then(|| Self::assemble(left))
    }
}

/// The loops of shapes as the engine gives them: outer ones counter-clockwise, holes clockwise; neither where they are
/// thin.
fn without_slivers(shapes: Vec<Vec<Vec<[f64; 2]>>>, size: f64) -> Vec<Vec<[f64; 2]>> {
    let mut left = Vec::new();
    for shape in shapes {
        // The outer loop of a piece, then its holes.
        for (number, points) in shape.into_iter().enumerate() {
            let mut points = offset::tidy(points, offset::MERGE * size);
            let area = signed_area(&points);
            let is_thin =
                points.len() < 3 || 2.0 * area.abs() <= SLIVER * size * perimeter(&points);
            if is_thin && number == 0 {
                break;
            }
            if !is_thin {
                if (area > 0.0) != (number == 0) {
                    points.reverse();
                }
                left.push(points);
            }
        }
    }
    left
}

/// Which places belong to what loops bound, by how often they wind around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Filled {
    /// Once or more counter-clockwise.
    Positive,
    /// Once or more clockwise.
    Negative,
    /// Any odd number of times.
    Odd,
    /// More often one way than the other.
    Nonzero,
}

/// The boundary of what loops in any position bound, O(n log n) for n sides and crossings, as exact as
/// [`Outline::minus`]: outer loops counter-clockwise, holes clockwise, thin ones left out.
pub(crate) fn resolved(loops: &[Vec<[f64; 2]>], filled: Filled) -> Vec<Vec<[f64; 2]>> {
    let rule = match filled {
        Filled::Positive => FillRule::Positive,
        Filled::Negative => FillRule::Negative,
        Filled::Odd => FillRule::EvenOdd,
        Filled::Nonzero => FillRule::NonZero,
    };
    let size = loops
        .iter()
        .map(|points| Bounds::of(points))
        .reduce(Bounds::union)
        .map_or(0.0, |bounds| bounds.diagonal());
    let shapes = engine::overlay(loops, &[], OverlayRule::Subject, rule);
    without_slivers(shapes, size)
}

/// The boundary of what both sets of loops, each as [`resolved`] gives them, hold; thin pieces and holes left out.
pub(crate) fn common(one: &Loops, other: &Loops) -> Vec<Vec<[f64; 2]>> {
    let size = one
        .iter()
        .map(|points| Bounds::of(points))
        .reduce(Bounds::union)
        .map_or(0.0, |bounds| bounds.diagonal());
    let shapes = engine::overlay(one, other, OverlayRule::Intersect, FillRule::NonZero);
    without_slivers(shapes, size)
}

/// The boundary of what the first loops bound and the others do not; thin pieces and holes left out.
pub(crate) fn without(one: &Loops, other: &Loops) -> Vec<Vec<[f64; 2]>> {
    let size = one
        .iter()
        .map(|points| Bounds::of(points))
        .reduce(Bounds::union)
        .map_or(0.0, |bounds| bounds.diagonal());
    let shapes = engine::overlay(one, other, OverlayRule::Difference, FillRule::NonZero);
    without_slivers(shapes, size)
}

/// Whether both sets of loops, each as [`resolved`] gives them, have room in common: a piece of it, at least, that is not
/// thin, as [`Outline::intersection`] measures it, in parts of `size`.
pub(crate) fn have_common_room(one: &Loops, other: &Loops, size: f64) -> bool {
    leave(one, other, OverlayRule::Intersect, size)
}

/// Whether the first set of loops has room that the other has not, measured as by [`have_common_room`].
pub(crate) fn has_own_room(one: &Loops, other: &Loops, size: f64) -> bool {
    leave(one, other, OverlayRule::Difference, size)
}

type Loops = [Vec<[f64; 2]>];

fn leave(one: &Loops, other: &Loops, rule: OverlayRule, size: f64) -> bool {
    let shapes = engine::overlay(one, other, rule, FillRule::NonZero);
    !without_slivers(shapes, size).is_empty()
}

/// The length of a loop.
pub(crate) fn perimeter(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points
        .iter()
        .zip(next)
        .map(|(&a, &b)| point::distance(a, b))
        .sum()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;
    use crate::{Similarity, Surface};

    fn rectangle(min: [f64; 2], max: [f64; 2]) -> Outline {
        Outline::polygon(&[min, [max[0], min[1]], max, [min[0], max[1]]]).unwrap()
    }

    #[track_caller]
    fn check(body: &Outline, other: &Outline, loops: usize, area: f64, tolerance: f64) -> Outline {
        let left = body.minus(other).unwrap();
        assert_eq!(left.loops().len(), loops);
        let off = left.volume() - area;
        assert!(off.abs() <= tolerance, "{} is {off:.1e} off", left.volume());
        left
    }

    #[test]
    fn pieces_and_holes() {
        let unit = rectangle([0.0; 2], [1.0; 2]);
        check(&unit, &rectangle([0.6, 0.7], [2.0; 2]), 1, 0.88, 1e-14);
        check(&unit, &rectangle([0.4, -1.0], [0.7, 2.0]), 2, 0.7, 1e-14);
        check(&unit, &rectangle([1.0, 0.0], [2.0, 1.0]), 1, 1.0, 1e-14);
        check(&unit, &rectangle([3.0, 0.0], [4.0, 1.0]), 1, 1.0, 1e-14);
        let ring = check(&unit, &rectangle([0.4; 2], [0.6; 2]), 2, 0.96, 1e-14);
        assert!(ring.inside([0.3, 0.5]) && !ring.inside([0.5, 0.5]));
        // A body with a hole cuts: what is in its hole stays.
        let left = check(&unit, &ring, 1, 0.04, 1e-14);
        assert!(left.inside([0.5, 0.5]));
        assert!(unit.minus(&rectangle([-1.0; 2], [2.0; 2])).is_none());
        assert!(unit.minus(&unit).is_none());
        // Four pieces that meet in points.
        let diamond = Outline::polygon(&[[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]]).unwrap();
        let corners = check(&unit, &diamond, 4, 0.5, 1e-14);
        assert!(corners.inside([0.1, 0.1]) && !corners.inside([0.5, 0.5]));
        assert!(corners.inset(0.02).unwrap().volume() < 0.5);
    }

    #[test]
    fn crumbs() {
        let frame = rectangle([0.0; 2], [1.0; 2]).minus(&rectangle([0.1; 2], [0.9; 2]));
        let far = rectangle([3.0, 0.0], [4.0, 0.01]);
        let both = frame.unwrap().union(&far).unwrap();
        let loops = |area: f64| {
            both.without_crumbs(area)
                .map(|o| (o.loops().len(), o.volume()))
        };
        assert_eq!(loops(0.005), Some((3, both.volume())));
        assert!(loops(0.02).is_some_and(|(n, area)| n == 2 && (area - 0.36).abs() < 1e-12));
        // The frame's outer loop is measured, and its hole goes with it.
        assert_eq!(loops(0.999).map(|l| l.0), Some(2));
        assert!(loops(2.0).is_none());
    }

    #[test]
    fn curves() {
        let circle = |x: f64| Outline::ellipse([x, 0.0], [1.0, 1.0]).unwrap();
        assert!((circle(0.0).volume() / PI - 1.0).abs() < 4e-7);
        let lens = 2.0 * PI / 3.0 - 0.5 * 3.0_f64.sqrt();
        check(&circle(0.0), &circle(1.0), 1, PI - lens, 2e-6);
        // The same curve, sampled at other points.
        let turned = circle(0.0).transformed(&Similarity::<2>::new(1.0, 0.1, [0.0; 2]).unwrap());
        assert!(circle(0.0).minus(&turned).is_none());
        check(&circle(0.0), &circle(2.0), 1, PI, 2e-6);
    }

    #[test]
    fn bad_ellipses() {
        assert!(Outline::ellipse([0.0; 2], [0.0, 1.0]).is_err());
        assert!(Outline::ellipse([f64::NAN, 0.0], [1.0, 1.0]).is_err());
    }

    fn area(outline: Option<&Outline>) -> f64 {
        outline.map_or(0.0, Surface::volume)
    }

    /// A polygon with reflex corners.
    fn star(arms: usize, inner: f64) -> Outline {
        let points: Vec<[f64; 2]> = (0..2 * arms)
            .map(|k| {
                let (sin, cos) = (PI * k as f64 / arms as f64).sin_cos();
                let radius = if k % 2 == 0 { 1.0 } else { inner };
                [radius * cos, radius * sin]
            })
            .collect();
        Outline::polygon(&points).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn areas_add_up(
            arms in (3..9_usize, 3..9_usize),
            inner in (0.2..0.9, 0.2..0.9),
            turn in 0.0..360.0,
            shift in [-1.5..1.5, -1.5..1.5],
            p in [-1.0..1.0, -1.0..1.0],
        ) {
            let a = star(arms.0, inner.0);
            let b = star(arms.1, inner.1)
                .transformed(&Similarity::<2>::new(0.8, turn, shift).unwrap());
            let (whole, both) = (a.union(&b).unwrap(), a.intersection(&b));
            let (left, right) = (a.minus(&b), b.minus(&a));
            // Pieces that are thinner than 10⁻⁶ may be missing.
            let parts = area(left.as_ref()) + area(both.as_ref()) + area(right.as_ref());
            prop_assert!((whole.volume() - parts).abs() < 2e-6);
            let sum = whole.volume() + area(both.as_ref()) - a.volume() - b.volume();
            prop_assert!(sum.abs() < 2e-6, "{}", sum);
            if a.closest(p).distance.abs() > 1e-5 && b.closest(p).distance.abs() > 1e-5 {
                let (in_a, in_b) = (a.inside(p), b.inside(p));
                let holds = |part: &Option<Outline>| part.as_ref().is_some_and(|o| o.inside(p));
                prop_assert_eq!(whole.inside(p), in_a || in_b);
                prop_assert_eq!(holds(&both), in_a && in_b);
                prop_assert_eq!(holds(&left), in_a && !in_b);
            }
            prop_assert!(a.minus(&a).is_none());
            prop_assert!((area(a.union(&a).as_ref()) - a.volume()).abs() < 1e-12);
        }
    }

    #[test]
    fn exact_where_nothing_is_thin() {
        let (a, b) = (
            rectangle([0.0; 2], [1.0; 2]),
            rectangle([0.6, 0.7], [2.0; 2]),
        );
        let sum = area(a.union(&b).as_ref()) + area(a.intersection(&b).as_ref());
        assert!((sum - a.volume() - b.volume()).abs() < 1e-14, "{sum}");
        let away = rectangle([3.0, 0.0], [4.0, 1.0]);
        assert!(a.intersection(&away).is_none());
        assert_eq!(a.union(&away).map(|whole| whole.loops().len()), Some(2));
        assert_eq!(area(a.minus(&away).as_ref()), 1.0);
    }
}
