//! SVG drawings.

use std::f64::consts::PI;

use super::*;
use crate::{FLATTENING_OVER_SIZE, OutlineRepair};

fn svg(content: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\">\n{content}\n</svg>")
}

fn path(data: &str) -> String {
    svg(&format!("<path d=\"{data}\"/>"))
}

#[track_caller]
fn loops(content: &str) -> Vec<Vec<[f64; 2]>> {
    BodyFormat::Svg.loops(content.as_bytes()).unwrap()
}

#[test]
fn straight_paths_are_kept_to_the_bit() {
    let triangle = vec![[0.1, -0.2], [3.0, -0.2], [3.0, -5.5e-3]];
    for data in [
        "M.1.2L3 .2 3 5.5e-3z",
        "M 0.1,0.2 H3 V0.0055 Z",
        "  M0.1 0.2\n3,0.2\t3 0.55E-2\r\nz ",
        "M9 9M+.1.2L3,.2L3,.0055Z",
    ] {
        assert_eq!(
            loops(&path(data)),
            std::slice::from_ref(&triangle),
            "{data}"
        );
    }
    let relative = loops(&path("m1 2 h2 v2 h-2z m5 0l1,0 0 1zm0 5l0-1-1 0z"));
    assert_eq!(
        relative,
        [
            vec![[1.0, -2.0], [3.0, -2.0], [3.0, -4.0], [1.0, -4.0]],
            vec![[6.0, -2.0], [7.0, -2.0], [7.0, -3.0]],
            vec![[6.0, -7.0], [6.0, -6.0], [5.0, -6.0]]
        ]
    );
}

#[test]
fn curves_are_within_the_tolerance() {
    // The unit circle in as many ways as there are; a far and huge one too.
    for (name, content) in [
        ("circle", svg("<circle r='1'/>")),
        ("ellipse", svg("<ellipse rx='1'/>")),
        (
            "round",
            svg("<rect x='-1' y='-1' width='2' height='2' rx='5'/>"),
        ),
        ("arcs", path("M-1 0A1 1 0 0 1 1 0A1 1 0 0 1-1 0Z")),
        ("flags", path("M-1 0a1 1 0 012 0 1 1 0 01-2 0")),
        ("small", path("M-1 0A.1.1 0 0 1 1 0A.1.1 0 0 1-1 0Z")),
        ("one arc", path("M-1 0A1 1 0 1 1-1 1e-9Z")),
        (
            "scaled",
            svg("<g transform='scale(1e-6)'><circle r='1e6'/></g>"),
        ),
    ] {
        let loops = loops(&content);
        assert_eq!(loops.len(), 1, "{name}");
        let mut turned = 0.0;
        for (k, p) in loops[0].iter().enumerate() {
            let q = loops[0][(k + 1) % loops[0].len()];
            let middle = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
            let size = 2.0 * 2.0_f64.sqrt();
            for at in [*p, middle] {
                let off = (at[0].hypot(at[1]) - 1.0).abs();
                assert!(off < FLATTENING_OVER_SIZE * size, "{name}: {off:e}");
            }
            turned += (p[0] * q[1] - p[1] * q[0]).atan2(p[0] * q[0] + p[1] * q[1]);
        }
        assert!((turned.abs() - 2.0 * PI).abs() < 1e-6, "{name}: {turned}");
        let count = loops[0].len();
        assert!((500..2000).contains(&count), "{name}: {count}");
    }
    // Under a parabola, and under a cubic with a smooth continuation.
    let area = contents(BodyFormat::Svg, path("M0 0Q1 2 2 0Z").as_bytes()).unwrap();
    assert!((area - 4.0 / 3.0).abs() < 1e-5, "{area}");
    let area = contents(
        BodyFormat::Svg,
        path("M0 0C0 1 2 1 2 0S4-1 4 0V2H0Z").as_bytes(),
    )
    .unwrap();
    assert!((area - 8.0).abs() < 1e-5, "{area}");
}

#[test]
fn a_drawing_has_all_its_shapes_and_nothing_else() {
    let outline =
        Outline::from_bytes(BodyFormat::Svg, &file(BodyFormat::Svg, "shapes.svg")).unwrap();
    let rounded = 80.0 - (4.0 - PI) * 4.0;
    let curved = outline
        .loops()
        .last()
        .map(crate::segment::signed_area)
        .unwrap();
    let straight = PI * 25.0 + PI * 24.0 + 80.0 + rounded + 35.0 + 35.0 + 50.0 - 8.0;
    assert_eq!(outline.loops().len(), 9);
    assert!((outline.volume() - straight - curved).abs() < 0.02);
    // A hole, as the circle in the other goes the other way round.
    let ring = contents(BodyFormat::Svg, &file(BodyFormat::Svg, "arcs.svg")).unwrap();
    assert!((ring - 0.75 * PI).abs() < 1e-5, "{ring}");
}

#[test]
fn transforms_act_from_the_inside_out() {
    let at = |transform: &str| {
        let content = svg(&format!(
            "<g transform='translate(10)'><path transform='{transform}' d='M1 0 2 0 2 1z'/></g>"
        ));
        let [x, y] = loops(&content)[0][0];
        [x.round() as i32, y.round() as i32]
    };
    for (transform, expected) in [
        ("", [11, 0]),
        ("translate(2,3)", [13, -3]),
        ("rotate(90)", [10, -1]),
        ("rotate(90 1 1)", [12, -1]),
        ("scale(3) rotate(90)", [10, -3]),
        (" scale( 3 , 4 ),translate(1 1)", [16, -4]),
        ("skewX(45) translate(0 2)", [13, -2]),
        ("skewY(45)", [11, -1]),
        ("matrix(0 1 1 0 5 6)", [15, -7]),
    ] {
        assert_eq!(at(transform), expected, "{transform}");
    }
}

/// What a drawing of the corpus paints, and what is said of it.
#[track_caller]
fn painted(name: &str) -> (f64, Vec<OutlineRepair>) {
    let sketch = Sketch::from_bytes(BodyFormat::Svg, &file(BodyFormat::Svg, name)).unwrap();
    let mended = sketch.body().unwrap();
    (mended.outline.volume(), mended.done)
}

#[track_caller]
fn paints(name: &str, area: f64) -> Vec<OutlineRepair> {
    let (read, done) = painted(name);
    assert!((read - area).abs() < 1e-4 * area, "{name}: {read}");
    done
}

#[test]
fn what_is_not_painted_is_no_body() {
    assert_eq!(paints("painted.svg", 1600.0 + 100.0 * PI), []);
    assert_eq!(paints("rules.svg", 84.0 + 100.0 + 150.0), []);
    let page = "<path d='M0 0h24v24H0z' fill='none'/><circle cx='12' cy='12' r='10'/>";
    let area = contents(BodyFormat::Svg, svg(page).as_bytes()).unwrap();
    assert!((area - 100.0 * PI).abs() < 1e-2, "{area}");
}

#[test]
fn what_is_referred_to_stands_where_it_is_used() {
    assert_eq!(
        paints("referred.svg", 3.0 * 50.0 + 4.0 * 8.0 + 50.0 + 4.0 + 2.0),
        []
    );
    let sketch = Sketch::from_bytes(BodyFormat::Svg, &file(BodyFormat::Svg, "referred.svg"));
    let bounds = sketch.unwrap().check().bounds;
    assert_eq!((bounds.min, bounds.max), ([-40.0, -32.0], [100.0, 40.0]));
}

#[test]
fn clips_cut() {
    let corner = 10.0 * 2.0;
    assert_eq!(paints("clipped.svg", 0.5 * PI * 400.0 + corner), []);
}

#[test]
fn fills_close_their_paths() {
    let done = paints("open_fills.svg", 6400.0 + 100.0);
    let [OutlineRepair::ClosedPaths { paths: 2, widest }] = done[..] else {
        panic!("{done:?}");
    };
    assert_eq!(widest, 80.0);
    assert!(
        done[0].to_string().contains("widest gap was 80"),
        "{}",
        done[0]
    );
}

#[test]
fn strokes_are_as_wide_as_they_are_drawn() {
    let (ring, butt, round, dashes) = (PI * (21.0 * 21.0 - 19.0 * 19.0), 60.0, 60.0 + PI, 30.0);
    let bent = 40.0 + 40.0;
    let done = paints("strokes.svg", ring + butt + round + dashes + bent);
    let [
        OutlineRepair::Stroked {
            strokes: 5,
            widest: 2.0,
            is_all: true,
        },
    ] = done[..]
    else {
        panic!("{done:?}");
    };
    let both = svg(
        "<rect width='10' height='10' stroke='red' stroke-width='.5' stroke-linejoin='round'/>",
    );
    let area = contents(BodyFormat::Svg, both.as_bytes()).unwrap();
    assert!((area - 110.0 - PI / 16.0).abs() < 1e-3, "{area}");
}

#[test]
fn what_is_left_out_is_named() {
    let done = paints("left_out.svg", 400.0);
    let expected = [
        OutlineRepair::LeftOutEffects(1),
        OutlineRepair::LeftOutTexts(1),
        OutlineRepair::LeftOutImages(1),
    ];
    assert_eq!(done, expected);
    let words: Vec<String> = done.iter().map(ToString::to_string).collect();
    assert!(
        words[1].contains("1 text of the drawing was left out"),
        "{words:?}"
    );
}

#[test]
fn loops_that_meet_nothing_stay_as_they_are() {
    // Within a body's paint a second one bounds nothing.
    let read = loops(&svg(
        "<path d='M0 0H8V8H0z'/><path d='M1 1V2H2z'/><path d='M9 0V1H10z'/>",
    ));
    let square = vec![[0.0, -0.0], [8.0, -0.0], [8.0, -8.0], [0.0, -8.0]];
    assert_eq!(read, [square, vec![[9.0, -0.0], [9.0, -1.0], [10.0, -1.0]]]);
    // A page that clips what lies within it.
    let nested = svg("<svg width='20' height='20'><path d='M.1.2L3 .2 3 5.5z'/></svg>");
    assert_eq!(loops(&nested), [[[0.1, -0.2], [3.0, -0.2], [3.0, -5.5]]]);
}

#[test]
fn bad_drawings_say_where() {
    let bad = |content: &str, parts: &[&str]| refused(BodyFormat::Svg, content, parts);
    bad(&path("M0 0L1 1z L"), &["line 2", "d=", "path", "save"]);
    bad(&path("M0 0L1 1 1 0z!"), &["line 2"]);
    bad(&path("L1 1"), &["line 2"]);
    bad(&path("M0 0 A1 1 0 2 0 1 1"), &["line 2"]);
    bad(&path("M0 0 R1 1"), &["line 2"]);
    bad(&path("M0 0 L1 1"), &["paints nothing"]);
    bad(&svg("\n<use href='#a'/>"), &["paints nothing"]);
    bad(&svg("<g transform='turn(3)'/>"), &["line 2", "transform"]);
    bad(&svg("<circle r='5 %'/>"), &["line 2", "\"5 %\"", "length"]);
    bad(&svg("<polygon points='1 2 3'/>"), &["line 2", "pairs"]);
    bad(&svg("<path d='&d;'/>"), &["line 2", "damaged"]);
    bad(&svg("<g></f>"), &["line 2", "damaged"]);
    bad("<svg><g>", &["damaged"]);
    bad("<html><svg/></html>", &["\"html\"", "no SVG drawing"]);
    bad(&svg("<text>A</text>"), &["only 1 text", "paths"]);
    refused(BodyFormat::Svg, b"<svg>\n\xff</svg>", &["line 2", "UTF-8"]);
    bad(&path("M9e6 0h1v1h-1z"), &["away from its origin", "nearer"]);
    let deep = "<g>".repeat(200);
    bad(&svg(&deep), &["damaged"]);
    bad(
        &svg(&(deep.clone() + &"</g>".repeat(200))),
        &["line 2", "ungroup"],
    );
    let laughs = file(BodyFormat::Svg, "bad_laughs.svg");
    refused(
        BodyFormat::Svg,
        laughs,
        &["refers to parts of itself", "unlink"],
    );
    // Curves that would need many more points than the file has bytes.
    let curves = "c1 9-9 9 0 0".repeat(20_000);
    bad(&path(&format!("M0 0{curves}z")), &["simplify"]);
    // Dashes without end.
    let dashes = "<path d='M0 0H9' stroke='red' stroke-dasharray='1e-7'/>";
    bad(&svg(dashes), &["dashes"]);
}
