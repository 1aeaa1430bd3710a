//! Nothing says that it is done unless it is: what was packed is right, or the command says what is wrong.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::{Desk, Ending};

/// A particle, as its row in a CSV file says.
struct Row {
    place: Vec<f64>,
    kind: String,
    body: String,
    volume: f64,
}

/// What was packed, read back and judged by sums over all pairs.
struct Packed {
    ending: Ending,
    rows: Vec<Row>,
    report: serde_json::Value,
}

fn scene(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/scenes")
        .join(name);
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Packs a scene that may end with 0 or 3.
fn pack(text: &str) -> Packed {
    let desk = Desk::new().with("scene.toml", text);
    let ending = desk.run(&[
        "pack",
        "scene.toml",
        "-o",
        "out.csv",
        "--report",
        "out.json",
    ]);
    assert!(matches!(ending.status, Some(0 | 3)), "{ending:?}");
    let report = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    let table = String::from_utf8(desk.read("out.csv")).expect("text");
    let mut lines = table.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let rows = lines
        .map(|line| {
            let cells: BTreeMap<&str, &str> = names.iter().copied().zip(line.split(',')).collect();
            let number = |name: &str| cells[name].parse::<f64>().expect("a number");
            let axes = ["x", "y", "z"]
                .into_iter()
                .filter(|axis| cells.contains_key(axis));
            Row {
                place: axes.map(number).collect(),
                kind: cells["kind"].to_owned(),
                body: cells["body"].to_owned(),
                volume: number("volume"),
            }
        })
        .collect();
    Packed {
        ending,
        rows,
        report,
    }
}

impl Packed {
    fn numbers(&self, key: &str) -> Vec<f64> {
        let values = self.report["scene"]["domain"][key]
            .as_array()
            .expect("numbers");
        values
            .iter()
            .map(|x| x.as_f64().expect("a number"))
            .collect()
    }

    fn spacing(&self) -> f64 {
        self.report["spacing"].as_f64().expect("a number")
    }

    /// What holds of every packing that is called done.
    #[track_caller]
    fn is_sound(&self) {
        assert_eq!(
            self.ending.status,
            Some(0),
            "{} {}",
            self.ending.stdout,
            self.ending.stderr
        );
        assert!(self.report["audit"]["passed"].as_bool().expect("a word"));
        let (min, max) = (self.numbers("min"), self.numbers("max"));
        let periodic: Vec<bool> = (self.report["scene"]["domain"]["periodic"]
            .as_array()
            .expect("words"))
        .iter()
        .map(|word| word.as_bool().expect("a word"))
        .collect();
        for row in &self.rows {
            for (k, &x) in row.place.iter().enumerate() {
                assert!(min[k] <= x && x <= max[k], "{:?}", row.place);
            }
        }
        let size = |row: &Row| row.volume.powf(1.0 / row.place.len() as f64);
        let mut closest = f64::INFINITY;
        for (i, a) in self.rows.iter().enumerate() {
            for b in &self.rows[..i] {
                let square: f64 = (0..a.place.len())
                    .map(|k| {
                        let (d, edge) = (a.place[k] - b.place[k], max[k] - min[k]);
                        let d = if periodic[k] {
                            d - edge * (d / edge).round()
                        } else {
                            d
                        };
                        d * d
                    })
                    .sum();
                let r = square.sqrt();
                assert!(
                    r >= 0.25 * (size(a) + size(b)),
                    "{:?} {:?}: {r}",
                    a.place,
                    b.place
                );
                closest = closest.min(r / self.spacing());
            }
        }
        let told = self.report["closest_pair_over_spacing"]
            .as_f64()
            .expect("a number");
        // Frozen particles count there too.
        assert!(told <= closest + 1e-9, "{told} {closest}");
    }

    /// The volume of a body's rows; those on an exact surface count in half.
    fn volume(&self, body: &str, on_surface: f64) -> f64 {
        let share = |row: &Row| if row.kind == "free" { 1.0 } else { on_surface };
        let own = self.rows.iter().filter(|row| row.body == body);
        own.map(|row| share(row) * row.volume).sum()
    }

    fn total(&self) -> f64 {
        self.rows.iter().map(|row| row.volume).sum()
    }

    fn linf(&self) -> f64 {
        self.report["density"]["linf"].as_f64().expect("a number")
    }
}

#[track_caller]
fn is_near(value: f64, wanted: f64, within: f64) {
    assert!((value - wanted).abs() <= within, "{value} for {wanted}");
}

#[track_caller]
fn refuse(text: &str, parts: &[&str]) {
    let desk = Desk::new().with("scene.toml", text);
    desk.refuse(&["pack", "scene.toml"], parts);
    desk.refuse(&["pack", "scene.toml", "--dry-run"], parts);
}

#[test]
fn channels_hold_their_particles() {
    for name in ["channel.toml", "channel-coarse.toml"] {
        let packed = pack(&scene(name));
        packed.is_sound();
        assert!(packed.linf() < 3e-3, "{name}: {}", packed.linf());
    }
}

/// A numbered place in the unit square, spread evenly.
fn spread(n: u32) -> [f64; 3] {
    let root = 1.220_744_084_605_76_f64;
    std::array::from_fn(|k| (f64::from(n) * root.powi(-(k as i32 + 1))).fract())
}

#[test]
fn cells_and_ducts_hold_their_particles() {
    for n in 1..9 {
        let [a, b, c] = spread(n);
        let [w, h] = [16.0 + 6.0 * a, 16.0 + 6.0 * b];
        let radius = 1.5 + 1.5 * c;
        // From one side of the box to the other.
        let x = radius + (w - 2.0 * radius) * b;
        let y = radius + (h - 2.0 * radius) * c;
        let periodic = ["true, false", "false, true", "true, true"][n as usize % 3];
        let packed = pack(&format!(
            "spacing = 1.0\n[domain]\nmin = [0, 0]\nmax = [{w}, {h}]\nperiodic = [{periodic}]\n[[body]]\nname = \"disc\"\nshape = {{ circle = {{ center = [{x}, {y}], radius = {radius} }} }}\n"
        ));
        packed.is_sound();
        is_near(packed.total(), w * h, 1e-9 * w * h);
        let area = std::f64::consts::PI * radius * radius;
        is_near(packed.volume("disc", 1.0), area, 0.5);
    }
    let packed = pack(
        "spacing = 1.0\n[domain]\nmin = [0, 0, 0]\nmax = [9, 10, 9.5]\nperiodic = [true, false, true]\n[[body]]\nname = \"ball\"\nshape = { sphere = { center = [2.1, 5, 7.2], radius = 2.0 } }\n",
    );
    packed.is_sound();
    is_near(packed.total(), 855.0, 1e-6);
}

#[test]
fn the_closest_pair_knows_images() {
    // Frozen particles are neighbours too.
    let all = "[output]\ninclude = [\"free\", \"boundary\", \"fixed\", \"frozen\"]\n";
    let packed = pack(&(scene("walls-across-seam.toml") + all));
    let width = 23.0;
    let mut closest = f64::INFINITY;
    for (i, a) in packed.rows.iter().enumerate() {
        for (j, b) in packed.rows.iter().enumerate() {
            if i != j && a.kind != "frozen" {
                let x = (a.place[0] - b.place[0]).abs();
                let r = x.min(width - x).hypot(a.place[1] - b.place[1]);
                closest = closest.min(r / packed.spacing());
            }
        }
    }
    let told = packed.report["closest_pair_over_spacing"].as_f64();
    is_near(told.expect("a number"), closest, 1e-9);
}

/// A needle through a disc: it is too thin for a particle, which is said, and cuts the disc in two.
#[test]
fn a_sliver_of_precedence_is_cut() {
    let packed = pack(&scene("precedence-sliver.toml"));
    packed.is_sound();
    assert!(
        packed.ending.stderr.contains("\"needle\"")
            && packed.ending.stderr.contains("no particles"),
        "{}",
        packed.ending.stderr
    );
    is_near(packed.total(), 144.0, 1e-6);
    is_near(
        packed.volume("disc", 1.0),
        12.25 * std::f64::consts::PI,
        0.5,
    );
}

#[test]
fn a_body_that_is_the_box_leaves_no_fluid() {
    let packed = pack(&scene("body-is-box.toml"));
    packed.is_sound();
    is_near(packed.total(), 105.0, 1e-9);
    assert!(packed.rows.iter().all(|row| !row.body.is_empty()));
}

#[test]
fn roles_that_exclude_each_other_name_both() {
    let void = ["\"solid\"", "\"hole\"", "void"];
    refuse(&scene("solid-in-void.toml"), &void);
    let crossing = scene("solid-in-void-complex.toml");
    refuse(&crossing, &void);
    refuse(
        &crossing.replace("\"void\"", "\"container\""),
        &["\"solid\"", "\"hole\"", "container"],
    );
    let outside = scene("solid-in-container.toml").replace(
        "center = [10.0, 10.0], radius = 4.0",
        "center = [1.5, 1.5], radius = 1.2",
    );
    refuse(&outside, &["\"solid\"", "\"hole\"", "container"]);
}

#[test]
fn a_solid_stands_in_a_container() {
    for is_first in [false, true] {
        let text = scene("solid-in-container.toml");
        let text = if is_first {
            // The same bodies the other way round.
            let [head, hole, solid] = text.split("[[body]]").collect::<Vec<_>>()[..] else {
                panic!("two bodies");
            };
            format!("{head}[[body]]{solid}\n[[body]]{hole}")
        } else {
            text
        };
        let packed = pack(&text);
        packed.is_sound();
        is_near(
            packed.volume("solid", 1.0),
            16.0 * std::f64::consts::PI,
            0.5,
        );
        is_near(packed.total(), 49.0 * std::f64::consts::PI, 0.01 * 154.0);
    }
}

/// A tank has fluid within its wall alone, so its box may end at the wall: what is beyond is nobody's.
#[test]
fn a_container_may_fill_its_box() {
    let tanks = [
        "polygon = { points = [[0, 0], [2, 0], [3, 1], [0, 1]] }",
        "box = { min = [0, 0], max = [3, 1] }",
        "polygon = { points = [[0, 0], [3, 0.2], [2.9, 1], [1.2, 0.7], [0.1, 1]] }",
    ];
    for (n, tank) in tanks.iter().enumerate() {
        for surface in ["inset", "exact"] {
            // From no room at all to some.
            for step in 0..5 {
                let spacing = 0.05 + 0.007 * f64::from(step) + 0.003 * n as f64;
                let room = [0.0, 0.1, 0.5, 1.0, 2.0][step as usize] * spacing;
                let packed = pack(&format!(
                    "spacing = {spacing}\n[domain]\nmin = [{low}, {low}]\nmax = [{}, {}]\n[[body]]\nname = \"tank\"\n\
                     role = \"container\"\nsurface = \"{surface}\"\nshape = {{ {tank} }}",
                    3.0 + room,
                    1.0 + room,
                    low = -room,
                ));
                packed.is_sound();
                let off = packed.report["density"]["linf"].as_f64().expect("a number");
                assert!(off < 0.01, "{tank}, {surface}, {spacing}, {room}: {off}");
            }
        }
    }
}

/// Published methods make what they make; nothing is called done that is not.
#[test]
fn methods_that_fail_say_so() {
    for name in [
        "ppa-crowded.toml",
        "relaxation-small.toml",
        "zigzag-floor.toml",
        "thin-exact.toml",
        "deep-surface-at-wall.toml",
    ] {
        let packed = pack(&scene(name));
        match packed.ending.status {
            Some(0) => packed.is_sound(),
            _ => {
                let words = &packed.ending.stdout;
                assert!(
                    words.contains("audit      FAILED") || words.contains("unfinished"),
                    "{name}: {words}"
                );
            }
        }
        let (min, max) = (packed.numbers("min"), packed.numbers("max"));
        for row in &packed.rows {
            let is_in = |k: usize| min[k] <= row.place[k] && row.place[k] <= max[k];
            assert!((0..row.place.len()).all(is_in), "{name}: {:?}", row.place);
        }
    }
}

/// A polygon with `count` spikes.
fn spiky(count: u32) -> String {
    let corners = (0..2 * count).map(|n| {
        let angle = std::f64::consts::TAU * f64::from(n) / f64::from(2 * count);
        let radius = if n % 2 == 0 { 1.0 } else { 1.2 };
        format!("[{}, {}]", radius * angle.cos(), radius * angle.sin())
    });
    let corners: Vec<String> = corners.collect();
    format!(
        "spacing = 0.1\n[domain]\nmin = [-2, -2]\nmax = [2, 2]\n[[body]]\nshape = {{ polygon = {{ points = [{}] }} }}\n",
        corners.join(", ")
    )
}

/// Outlines far finer than a spacing get an answer, of whatever kind.
#[test]
fn fine_outlines_get_an_answer() {
    for text in [
        scene("starfish-small.toml"),
        scene("zigzag-teeth.toml"),
        spiky(1500),
    ] {
        let desk = Desk::new().with("scene.toml", text);
        let ending = desk.run(&["pack", "scene.toml", "-o", "out.csv"]);
        assert!(matches!(ending.status, Some(0 | 2 | 3)), "{ending:?}");
    }
}

/// The frozen particles of a file are as many as the kernel sees that its densities are from.
#[test]
fn frozen_particles_reach_as_far_as_the_kernel_that_judges() {
    let packed = pack(
        "spacing = 0.2\n[domain]\nmin = [-2, -2]\nmax = [2, 2]\n[[body]]\nname = \"disc\"\nshape = { circle = { center = [0, 0], radius = 1 } }\n[packing]\nmax_iterations = 5\n[quality]\nkernel = \"quintic\"\nh_over_spacing = 2.0\n[output]\ninclude = [\"free\", \"boundary\", \"fixed\", \"frozen\"]\n",
    );
    let farthest = (packed.rows.iter())
        .filter(|row| row.kind == "frozen")
        .map(|row| row.place[0])
        .fold(0.0, f64::max);
    // A lattice site every ∆s at most.
    assert!(farthest > 2.0 + 6.0 * 0.2 - 0.2, "{farthest}");
}
