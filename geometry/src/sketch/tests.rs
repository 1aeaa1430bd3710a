//! Every defect is found, counted and mended or refused; what is mended is found clean.

use proptest::prelude::*;
use sphpack_neighbors::random::SplitMix64;

use super::*;
use crate::outline::booleans::perimeter;
use crate::{BodyFormat, Outline, Similarity, Surface};

type Points = Vec<[f64; 2]>;

fn rectangle(min: [f64; 2], max: [f64; 2]) -> Points {
    vec![min, [max[0], min[1]], max, [min[0], max[1]]]
}

fn turned(mut points: Points) -> Points {
    points.reverse();
    points
}

fn sketch(loops: &[Points]) -> Sketch {
    Sketch::new(loops.to_vec()).unwrap()
}

#[track_caller]
fn finds(sketch: &Sketch, expected: &[(OutlineDefectKind, usize)]) -> OutlineReport {
    let report = sketch.check();
    let found: Vec<_> = report.defects.iter().map(|d| (d.kind, d.count)).collect();
    assert_eq!(found, expected, "{:?}", report.defects);
    report
}

/// Mends, writes, reads again, and finds nothing.
#[track_caller]
fn mends(sketch: &Sketch, area: f64) -> Vec<OutlineRepair> {
    let mended = sketch.body().unwrap();
    assert!(
        (mended.outline.volume() - area).abs() < 1e-9,
        "{}",
        mended.outline.volume()
    );
    let again = written(&mended.outline);
    assert!(again.check().is_clean(), "{:?}", again.check().defects);
    let outline = again.body().unwrap().outline;
    assert!((outline.volume() - area).abs() < 1e-9);
    mended.done
}

fn written(outline: &Outline) -> Sketch {
    let mut file = Vec::new();
    outline.write_csv(&mut file).unwrap();
    Sketch::from_bytes(BodyFormat::detect(&file, "csv").unwrap(), &file).unwrap()
}

#[track_caller]
fn refuses(sketch: &Sketch, words: &str) {
    let message = sketch.body().unwrap_err().to_string();
    assert!(message.contains(words), "{message}");
}

use OutlineDefectKind as Kind;

#[test]
fn nested_loops_are_clean() {
    let square = |r: f64| rectangle([-r; 2], [r; 2]);
    let rings = sketch(&[square(3.0), square(2.0), turned(square(1.0))]);
    let report = finds(&rings, &[]);
    let roles: Vec<_> = report.loops.iter().map(|l| (l.role, l.inside)).collect();
    use LoopRole::{Body, Hole};
    assert_eq!(roles, [(Body, None), (Hole, Some(0)), (Body, Some(1))]);
    assert_eq!(report.area(), 36.0 - 16.0 + 4.0);
    assert!(mends(&rings, 24.0).is_empty());
}

#[test]
fn figure_eight() {
    let eight = sketch(&[vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]]);
    let report = finds(&eight, &[(Kind::SelfIntersection, 1)]);
    assert_eq!(report.defects[0].place, [0.5, 0.5]);
    assert_eq!(report.loops[0].role, LoopRole::Undecided);
    refuses(&eight, "order");
}

#[test]
fn a_small_loop_the_wrong_way_round() {
    // At the top the sides cross and leave a small triangle.
    let top = vec![[0.0, 0.0], [1.0, 0.0], [0.49, 1.0], [0.51, 1.0]];
    let found = sketch(&[top]);
    finds(&found, &[(Kind::SelfIntersection, 1)]);
    let done = mends(&found, 0.5 / 1.02 / 1.02 * 1.02);
    assert!(matches!(
        done[..],
        [OutlineRepair::Untangled { loops: 1, .. }]
    ));
}

#[test]
fn a_loop_over_itself() {
    // A bar that goes once round a square and ends on its own beginning.
    let spiral = vec![
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
        [0.0, 0.5],
        [1.0, 0.5],
        [1.0, 3.0],
        [3.0, 3.0],
        [3.0, 1.0],
        [0.0, 1.0],
    ];
    let found = sketch(&[spiral]);
    let report = found.check();
    assert!(
        report.defect(Kind::SelfIntersection).is_some()
            || report.defect(Kind::SelfContact).is_some()
    );
    let done = mends(&found, 16.0 - 4.0);
    assert!(
        matches!(done[..], [OutlineRepair::Untangled { loops: 1, .. }]),
        "{done:?}"
    );
}

#[test]
fn a_hole_behind_a_cut() {
    // Once round, in along the cut, round the hole, and out again.
    let keyhole = vec![
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
        [0.0, 2.0],
        [1.0, 2.0],
        [1.0, 3.0],
        [3.0, 3.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let found = sketch(&[keyhole]);
    let report = found.check();
    assert!(report.defect(Kind::SelfContact).is_some(), "{report:?}");
    mends(&found, 12.0);
}

#[test]
fn two_that_overlap() {
    let (a, b) = (rectangle([0.0; 2], [1.0; 2]), rectangle([0.5; 2], [1.5; 2]));
    for two in [
        sketch(&[a.clone(), b.clone()]),
        sketch(&[turned(a.clone()), turned(b.clone())]),
    ] {
        let report = finds(&two, &[(Kind::Overlap, 1)]);
        assert!(
            report.defects[0]
                .to_string()
                .starts_with("1 pair of loops that overlap, near")
        );
        let done = mends(&two, 1.75);
        assert!(
            matches!(done[..], [OutlineRepair::Joined { loops: 2, shared_area }] if (shared_area - 0.25).abs() < 1e-12)
        );
    }
    // A hole that reaches over the edge, or a body? Nobody knows.
    refuses(
        &sketch(&[a.clone(), turned(b.clone())]),
        "the same way round",
    );
    // Nor where one of them is within another.
    let around = rectangle([-1.0; 2], [3.0; 2]);
    let across = rectangle([1.2, 1.2], [4.0, 2.0]);
    refuses(
        &sketch(&[around.clone(), b.clone(), across]),
        "none is within",
    );
    // Within something else they are one hole.
    let done = mends(&sketch(&[around, a, b]), 16.0 - 1.75);
    assert_eq!(done.len(), 1);
}

#[test]
fn loops_that_touch() {
    let a = rectangle([0.0; 2], [1.0; 2]);
    // Side by side they are one; a hole at the edge is a notch.
    let beside = sketch(&[a.clone(), rectangle([1.0, 0.25], [2.0, 0.75])]);
    finds(&beside, &[(Kind::Contact, 1)]);
    assert_eq!(mends(&beside, 1.5), [OutlineRepair::Merged(2)]);
    let notch = sketch(&[a.clone(), rectangle([0.5, 0.25], [1.0, 0.75])]);
    finds(&notch, &[(Kind::Contact, 1)]);
    assert_eq!(mends(&notch, 0.75), [OutlineRepair::Merged(2)]);
    // In a point they stay two, and it is said.
    let corner = sketch(&[a, rectangle([1.0; 2], [2.0; 2])]);
    let mended = corner.body().unwrap();
    assert_eq!(mended.done.len(), 2, "{:?}", mended.done);
    assert!(matches!(mended.done[1], OutlineRepair::LeftContacts(_)));
    assert_eq!(mended.outline.volume(), 2.0);
    assert!(mended.outline.inside([0.5; 2]) && mended.outline.inside([1.5; 2]));
    let again = written(&mended.outline).body().unwrap();
    assert_eq!(again.outline.volume(), 2.0);
}

#[test]
fn doubles() {
    let a = rectangle([0.0; 2], [1.0; 2]);
    let mut begun_elsewhere = turned(a.clone());
    begun_elsewhere.rotate_left(1);
    let twice = sketch(&[a.clone(), begun_elsewhere]);
    finds(&twice, &[(Kind::Duplicate, 1)]);
    assert_eq!(mends(&twice, 1.0), [OutlineRepair::DroppedDuplicates(1)]);
    // The same square with one point more.
    let mut more = a.clone();
    more.insert(1, [0.5, 0.0]);
    let twice = sketch(&[a, more]);
    finds(&twice, &[(Kind::Duplicate, 1)]);
    mends(&twice, 1.0);
}

#[test]
fn spikes() {
    let mut points = rectangle([0.0; 2], [1.0; 2]);
    // Out of a corner, and out of a side over two points and back.
    points.splice(
        2..2,
        [[1.0, 0.5], [2.0, 0.5], [3.0, 0.5], [2.0, 0.5], [1.0, 0.5]],
    );
    points.push([0.0, 3.0]);
    let spiky = sketch(&[points]);
    let report = finds(&spiky, &[(Kind::Spike, 2)]);
    assert_eq!(report.defects[0].place, [3.0, 0.5]);
    assert_eq!(mends(&spiky, 1.0), [OutlineRepair::DroppedSpikes(2)]);
    // At the seam.
    let seam = sketch(&[vec![
        [-1.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [0.0, 0.0],
    ]]);
    finds(&seam, &[(Kind::Spike, 1)]);
    mends(&seam, 1.0);
}

#[test]
fn loops_without_area() {
    let a = rectangle([0.0; 2], [1.0; 2]);
    let line = vec![[2.0, 0.0], [3.0, 1.0], [2.5, 0.5], [4.0, 2.0]];
    let two = vec![[5.0, 0.0], [6.0, 0.0], [5.0, 0.0]];
    let found = sketch(&[a.clone(), line.clone()]);
    finds(&found, &[(Kind::NoArea, 1)]);
    assert_eq!(mends(&found, 1.0), [OutlineRepair::DroppedEmpty(1)]);
    // Two points may be the rest of a loop.
    let found = sketch(&[a, line.clone(), two.clone()]);
    finds(&found, &[(Kind::NoArea, 1), (Kind::TooFewPoints, 1)]);
    refuses(&found, "parted into loops");
    refuses(&sketch(&[line, two]), "loop without area");
    assert!(Sketch::new(Vec::new()).is_err());
    assert!(Sketch::new(vec![vec![[f64::NAN, 0.0]]]).is_err());
    refuses(&sketch(&[Vec::new()]), "0 different points");
}

#[test]
fn everything_at_once() {
    let mut a = rectangle([0.0; 2], [2.0; 2]);
    a.splice(1..1, [[1.0, 0.0], [1.0, 0.0], [1.0, -1.0], [1.0, 0.0]]);
    let b = rectangle([1.0; 2], [3.0; 2]);
    let far = rectangle([10.0; 2], [12.0; 2]);
    let all = sketch(&[
        a,
        b,
        far.clone(),
        turned(far),
        rectangle([10.5; 2], [11.0; 2]),
        vec![[5.0, 5.0], [6.0, 6.0], [7.0, 7.0]],
        vec![[20.0, 0.0], [21.0, 0.0], [20.49, 1.0], [20.51, 1.0]],
        rectangle([12.0, 10.0], [13.0, 11.0]),
    ]);
    finds(
        &all,
        &[
            (Kind::SelfIntersection, 1),
            (Kind::Overlap, 1),
            (Kind::Duplicate, 1),
            (Kind::Contact, 1),
            (Kind::Spike, 1),
            (Kind::NoArea, 1),
            (Kind::Repeated, 1),
        ],
    );
    let done = mends(&all, 7.0 + 4.0 - 0.25 + 0.5 / 1.02 + 1.0);
    assert_eq!(done.len(), 7, "{done:?}");
}

#[test]
fn a_scribble_is_counted_and_refused() {
    let mut random = SplitMix64::new(1);
    let scribble = sketch(&[(0..300).map(|_| [random.unit(), random.unit()]).collect()]);
    let report = scribble.check();
    let crossings = report.defect(Kind::SelfIntersection).unwrap().count;
    assert!(crossings > 1000, "{crossings}");
    assert!(scribble.body().is_err());
}

/// Two regular polygons, the second larger, turned by degrees and moved: what overlaps is found, and joined where both run
/// the same way round.
#[track_caller]
fn union_of_two(sides: (usize, usize), turn: f64, shift: [f64; 2], clockwise: (bool, bool)) {
    let ring = |n: usize| -> Points {
        (0..n)
            .map(|k| {
                let (sin, cos) = (std::f64::consts::TAU * k as f64 / n as f64).sin_cos();
                [cos, sin]
            })
            .collect()
    };
    let by = Similarity::<2>::new(1.1, turn, shift).unwrap();
    let a = Outline::polygon(&ring(sides.0)).unwrap();
    let b = Outline::polygon(&ring(sides.1)).unwrap().transformed(&by);
    // All is decided at a thickness of 10⁻⁶ of at most 6.5.
    let is_thick = |part: &Option<Outline>| {
        part.iter().flat_map(Outline::loops).any(|points| {
            2.0 * crate::segment::signed_area(points).abs() > 1e-5 * perimeter(points)
        })
    };
    let shared = a.intersection(&b);
    let (both, sum) = (
        shared.as_ref().map_or(0.0, Surface::volume),
        a.volume() + b.volume(),
    );
    let way = |o: &Outline, is_turned: bool| {
        let points = o.points().to_vec();
        if is_turned { turned(points) } else { points }
    };
    let two = sketch(&[way(&a, clockwise.0), way(&b, clockwise.1)]);
    let body = two.body();
    if [&shared, &a.minus(&b), &b.minus(&a)]
        .into_iter()
        .all(is_thick)
    {
        assert!(two.check().defect(Kind::Overlap).is_some());
        assert_eq!(body.is_ok(), clockwise.0 == clockwise.1);
        if let Ok(mended) = body {
            assert!((mended.outline.volume() - sum + both).abs() < 1e-5);
            let again = written(&mended.outline).check();
            assert!(again.is_clean(), "{:?}", again.defects);
        }
    } else if both == 0.0 {
        assert!((body.unwrap().outline.volume() - sum).abs() < 1e-5);
    }
}

#[test]
fn a_small_overlap_at_two_corners_is_one() {
    // Both have an area of 2 × 10⁻⁵ in common.
    let shift = [-1.572_315_920_665_339_2, -1.371_362_143_252_186_5];
    union_of_two((8, 8), 306.547_366_535_687, shift, (false, false));
}

#[test]
fn corners_in_each_other_by_any_depth() {
    // The diagonal of the box around both is 2.8: pieces overlap from a thickness of 2.8 × 10⁻⁶ on, which is a depth of
    // 5.6 × 10⁻⁶.
    for (depth, overlaps) in [(1e-8, false), (5e-6, false), (6.5e-6, true), (1e-3, true)] {
        let a = rectangle([0.0; 2], [1.0; 2]);
        let b = rectangle([1.0 - depth; 2], [2.0 - depth; 2]);
        let two = sketch(&[a.clone(), b.clone()]);
        let kind = if overlaps {
            Kind::Overlap
        } else {
            Kind::Contact
        };
        finds(&two, &[(kind, 1)]);
        let done = two.body().unwrap().done;
        let is_joined = matches!(done[0], OutlineRepair::Joined { .. });
        assert_eq!(is_joined, overlaps, "{depth}: {done:?}");
        // What only touches is two bodies, whichever way round they run.
        assert_eq!(sketch(&[a, turned(b)]).body().is_ok(), !overlaps);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn unions_of_any_two(
        sides in (3..12_usize, 3..12_usize),
        turn in 0.0..360.0,
        shift in [-2.5..2.5, -2.5..2.5],
        clockwise in (any::<bool>(), any::<bool>()),
    ) {
        union_of_two(sides, turn, shift, clockwise);
    }

    #[test]
    fn what_adds_nothing_changes_nothing(
        heights in proptest::collection::vec(0.5..1.5, 3..20),
        at in any::<proptest::sample::Index>(),
        out in -2.0..2.0,
    ) {
        let n = heights.len();
        let star: Points = heights.iter().enumerate().map(|(k, r)| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / n as f64).sin_cos();
            [r * cos, r * sin]
        }).collect();
        let area = Outline::polygon(&star).unwrap().volume();
        let mut more = star;
        let k = at.index(n);
        let [x, y] = more[k];
        more.splice(k..k, [[x, y], [x + out, y + 0.5], [x, y]]);
        let mended = sketch(&[more.clone(), more]).body().unwrap();
        prop_assert!((mended.outline.volume() - area).abs() < 1e-12);
        prop_assert!(written(&mended.outline).check().is_clean());
    }
}
