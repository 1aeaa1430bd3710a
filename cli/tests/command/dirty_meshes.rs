//! Meshes with the defects that users meet: packed right, with a warning, or refused with the reason and the cure.

use serde_json::Value;

use crate::{Desk, stl};

pub(crate) type Triangles = Vec<[[f32; 3]; 3]>;

/// A sphere of radius ½ about `center`: an icosahedron with every triangle cut in four, four times; 5,120 triangles.
pub(crate) fn sphere(center: [f64; 3]) -> Triangles {
    let g = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mut corners: Vec<[f64; 3]> = Vec::new();
    for (a, b) in [(1.0, g), (1.0, -g), (-1.0, g), (-1.0, -g)] {
        corners.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let difference = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let is_near = |a, b| {
        let d = difference(a, b);
        dot(d, d) < 4.1
    };
    let outward = |t: [[f64; 3]; 3]| {
        let (u, v) = (difference(t[1], t[0]), difference(t[2], t[0]));
        let normal = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        if dot(normal, t[0]) > 0.0 {
            t
        } else {
            [t[0], t[2], t[1]]
        }
    };
    let mut triangles = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                let t = [corners[i], corners[j], corners[k]];
                if is_near(t[0], t[1]) && is_near(t[1], t[2]) && is_near(t[2], t[0]) {
                    triangles.push(outward(t));
                }
            }
        }
    }
    let on_sphere = |p: [f64; 3]| p.map(|x| 0.5 * x / dot(p, p).sqrt());
    for _ in 0..4 {
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let middle =
                    |p: [f64; 3], q: [f64; 3]| on_sphere([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
                let [a, b, c] = [a, b, c].map(on_sphere);
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let place = |p: [f64; 3]| [0, 1, 2].map(|k| (p[k] + center[k]) as f32);
    triangles.iter().map(|t| t.map(place)).collect()
}

/// Particles per packing: few enough for a test.
const ARGUMENTS: [&str; 4] = ["--spacing", "0.04", "--margin", "0.16"];

/// Volume of the packed body, L∞ of the density, what was mended, and what was said on standard error.
fn pack(triangles: &Triangles) -> (f64, f64, Vec<String>, String) {
    let desk = Desk::new().with("body.stl", stl(triangles));
    let mut arguments = vec!["pack", "body.stl", "-o", "out.vtu", "--report", "out.json"];
    arguments.extend(ARGUMENTS);
    let ending = desk.succeed(&arguments);
    let report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    let body = &report["bodies"][0];
    let repairs: Vec<String> = body["repairs"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|words| words.as_str().expect("a sentence").to_owned())
        .collect();
    for words in &repairs {
        assert!(ending.stderr.contains(words), "{}", ending.stderr);
    }
    assert_eq!(
        repairs.len(),
        ending
            .stderr
            .matches("sphpack: warning: body \"body\": ")
            .count()
    );
    (
        body["volume"].as_f64().expect("a number"),
        report["density"]["linf"].as_f64().expect("a number"),
        repairs,
        ending.stderr,
    )
}

/// One of so many triangles; with 256, some of the 20 holes meet in a vertex.
fn is_chosen(number: usize, every: usize) -> bool {
    number % every == every / 3
}

#[test]
fn holes_flips_and_inversion_are_mended_and_told() {
    let clean = sphere([0.0; 3]);
    assert_eq!(clean.len(), 5120);
    let (volume, linf, repairs, _) = pack(&clean);
    assert!(repairs.is_empty());
    let exact = std::f64::consts::PI / 6.0;
    assert!((volume / exact - 1.0).abs() < 0.01, "{volume}");

    let holed = (0..clean.len())
        .filter(|&i| !is_chosen(i, 256))
        .map(|i| clean[i])
        .collect();
    let turn = |t: &[[f32; 3]; 3]| [t[0], t[2], t[1]];
    let flipped = clean
        .iter()
        .enumerate()
        .map(|(i, t)| if is_chosen(i, 20) { turn(t) } else { *t })
        .collect();
    let inverted = clean.iter().map(turn).collect();
    for (name, triangles, words) in [
        (
            "20 missing",
            holed,
            "14 holes were closed with 20 triangles",
        ),
        (
            "5 % flipped",
            flipped,
            "256 of 5120 triangles faced the other way",
        ),
        ("inverted", inverted, "the body was inside out"),
    ] {
        let (v, l, repairs, said) = pack(&triangles);
        eprintln!(
            "{name}: volume {:+.4} %, L∞ {l:.5} (clean {linf:.5})",
            100.0 * (v / volume - 1.0)
        );
        assert!((v / volume - 1.0).abs() < 0.03, "{name}: {v}, not {volume}");
        assert!(l < 2.0 * linf, "{name}: {l}, not {linf}");
        assert_eq!(repairs.len(), 1, "{name}: {repairs:?}");
        assert!(said.contains(words), "{name}: {said}");
    }
}

#[test]
fn a_missing_cap_is_refused_with_the_cure() {
    let capless: Triangles = sphere([0.0; 3])
        .into_iter()
        .filter(|t| t.iter().any(|p| p[2] <= 0.45))
        .collect();
    let desk = Desk::new().with("body.stl", stl(&capless));
    let mut arguments = vec!["pack", "body.stl"];
    arguments.extend(ARGUMENTS);
    desk.refuse(
        &arguments,
        &[
            "body.stl",
            "not closed",
            "1 hole of",
            "across",
            "near (",
            "close the holes",
            "sphpack check body.stl",
            "`sphpack check body.stl --repair OUT.stl --wrap 0.01`",
        ],
    );
}

#[test]
fn whatever_there_is_can_be_wrapped() {
    let whole = sphere([0.0; 3]);
    let capless: Triangles = (whole.iter().copied())
        .filter(|t| t.iter().any(|p| p[2] <= 0.45))
        .collect();
    let sparse: Triangles = (0..whole.len())
        .filter(|&i| (0.618_034 * i as f64) % 1.0 >= 0.1)
        .map(|i| whole[i])
        .collect();
    let up = |p: [f32; 3]| [p[0], p[1], -p[2]];
    // The second one open below, and facing outward again after the turn.
    let second = capless.iter().map(|&[a, b, c]| {
        [a, c, b].map(|p| {
            let [x, y, z] = up(p);
            [x + 0.5, y, z]
        })
    });
    let crossing: Triangles = capless.iter().copied().chain(second).collect();
    let ball = std::f64::consts::PI / 6.0;
    let lens = std::f64::consts::PI * 2.5 * 0.25 / 12.0;
    for (name, triangles, exact) in [
        ("without a cap", capless.clone(), ball),
        ("nine of ten", sparse, ball),
        ("two that cross", crossing, 2.0 * ball - lens),
    ] {
        let desk = Desk::new().with("body.stl", stl(&triangles));
        let wrap = |more: &[&str]| {
            let mut arguments = vec!["check", "body.stl", "--wrap", "0.02"];
            arguments.extend(more);
            desk.run(&arguments)
        };
        let said = wrap(&["--repair", "out.stl"]);
        assert_eq!(said.status, Some(0), "{name}: {said:?}");
        assert!(
            said.stdout.contains("wrapped in a new mesh"),
            "{}",
            said.stdout
        );
        let json = desk.succeed(&["check", "out.stl", "--json"]).stdout;
        let found: Value = serde_json::from_str(&json).expect("JSON");
        assert_eq!(
            found["mesh"]["defects"].as_array().map(Vec::len),
            Some(0),
            "{name}: {json}"
        );
        let volume = found["volume"].as_f64().expect("a number");
        eprintln!("{name}: {:+.3} %", 100.0 * (volume / exact - 1.0));
        assert!(
            (volume / exact - 1.0).abs() < 0.03,
            "{name}: {volume}, not {exact}"
        );
        desk.refuse(
            &["check", "body.stl", "--wrap", "0.02"],
            &["--wrap goes with --repair OUT.stl"],
        );
        if name == "without a cap" {
            let mut pack = vec!["pack", "out.stl", "--quiet"];
            pack.extend(ARGUMENTS);
            desk.succeed(&pack);
        }
    }
}

#[test]
fn overlapping_shells_are_packed_as_one() {
    let mut both = sphere([0.0; 3]);
    both.extend(sphere([0.6, 0.05, 0.03]));
    let (volume, linf, repairs, said) = pack(&both);
    let d = 0.6_f64.hypot(0.05).hypot(0.03);
    let lens = std::f64::consts::PI * (2.0 + d) * (1.0 - d).powi(2) / 12.0;
    let exact = std::f64::consts::PI / 3.0 - lens;
    eprintln!(
        "overlapping: volume {:+.4} %, L∞ {linf:.5}",
        100.0 * (volume / exact - 1.0)
    );
    assert!((volume / exact - 1.0).abs() < 0.03, "{volume}, not {exact}");
    let (_, alone, _, _) = pack(&sphere([0.0; 3]));
    assert!(linf < 2.0 * alone, "{linf}, not {alone}");
    assert_eq!(repairs.len(), 1);
    assert!(
        said.contains("2 shells that overlapped or touched were joined"),
        "{said}"
    );
    assert!(said.contains("counts once"), "{said}");
}
