//! SVG drawings.

use std::f64::consts::PI;

use super::*;
use crate::FLATTENING_OVER_SIZE;

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
    let relative = loops(&path("m1 2 h2 v2 h-2z m5 0l1,0 0 1zl0-1-1 0z"));
    assert_eq!(
        relative,
        [
            vec![[1.0, -2.0], [3.0, -2.0], [3.0, -4.0], [1.0, -4.0]],
            vec![[6.0, -2.0], [7.0, -2.0], [7.0, -3.0]],
            vec![[6.0, -2.0], [6.0, -1.0], [5.0, -1.0]]
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
            svg("<g transform='scale(1e-30)'><circle r='1e30'/></g>"),
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
    // The ring's hole is one, though both its circles go the same way round or not.
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

#[test]
fn bad_drawings_say_where() {
    let bad = |content: &str, parts: &[&str]| refused(BodyFormat::Svg, content, parts);
    bad(&path("M0 0L1 1 1 0"), &["line 2", "not closed"]);
    bad(&path("M0 0L1 1z L"), &["line 2", "character 12", "number"]);
    bad(&path("M0 0L1 1 1 0z!"), &["character 14", "command"]);
    bad(&path("L1 1"), &["start"]);
    bad(&path("M0 0 A1 1 0 2 0 1 1"), &["flag"]);
    bad(&path("M0 0 R1 1"), &["commands"]);
    bad(&path("M0 0 L1e400 1 1 1z"), &["number"]);
    bad(&path("M0 0 L1e200 1 1 1z"), &["line 2", "too large"]);
    bad(&svg("\n<use href='#a'/>"), &["line 3", "unlink"]);
    bad(&svg("<svg/>"), &["line 2", "ungroup"]);
    bad(&svg("<g transform='turn(3)'/>"), &["line 2", "transform"]);
    bad(&svg("<circle r='5%'/>"), &["\"5%\"", "length"]);
    bad(&svg("<polygon points='1 2 3'/>"), &["pairs"]);
    bad(&svg("<path d='&d;'/>"), &["value of d"]);
    bad(&svg("<g></f>"), &["line 2", "damaged"]);
    bad("<svg><g>", &["cut off"]);
    bad(&svg("<text>A</text>"), &["no closed paths"]);
    refused(BodyFormat::Svg, b"<svg>\n\xff</svg>", &["line 2", "UTF-8"]);
    // Curves that would need many more points than the file has bytes.
    let curves = "c1 9-9 9 0 0".repeat(20_000);
    bad(&path(&format!("M0 0{curves}z")), &["simplify"]);
}
