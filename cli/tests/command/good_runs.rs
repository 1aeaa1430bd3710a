//! Scenes that are packed.

use serde_json::Value;

use crate::{CYLINDER, Desk, cube, stl, text_stl};

/// A CSV file's header and rows.
fn rows(bytes: Vec<u8>) -> (String, Vec<Vec<String>>) {
    let text = String::from_utf8(bytes).expect("text");
    let mut lines = text.lines();
    let header = lines.next().expect("a header").to_owned();
    (
        header,
        lines
            .map(|line| line.split(',').map(str::to_owned).collect())
            .collect(),
    )
}

fn keys(value: &Value) -> Vec<&str> {
    value
        .as_object()
        .expect("an object")
        .keys()
        .map(String::as_str)
        .collect()
}

#[test]
fn a_cylinder_with_every_file() {
    let all = "[output]\ninclude = [\"free\", \"boundary\", \"fixed\", \"frozen\"]\n";
    let desk = Desk::new().with("scene.toml", format!("{CYLINDER}{all}"));
    let ending = desk.succeed(&[
        "pack",
        "scene.toml",
        "-o",
        "out.vtu",
        "-o",
        "out.csv",
        "--report",
        "out.json",
        "--picture",
        "out.svg",
    ]);
    assert_eq!(
        desk.files(),
        ["out.csv", "out.json", "out.svg", "out.vtu", "scene.toml"]
    );
    for part in [
        "geometry",
        "perimeter 6.28",
        "settling",
        "density",
        "out.vtu",
        "out.json",
    ] {
        assert!(
            ending.stdout.contains(part),
            "{} lacks {part}",
            ending.stdout
        );
    }
    assert!(!ending.stderr.contains('\x1b') && !ending.stdout.contains('\x1b'));

    let report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    let mut expected = vec![
        "schema",
        "version",
        "scene",
        "dimension",
        "spacing",
        "method",
        "kernel",
        "h_over_spacing",
        "seed",
        "threads",
        "converged",
        "stop_reason",
        "iterations",
        "force_evaluations",
        "particles",
        "density",
        "residual",
        "closest_pair_over_spacing",
        "surface",
        "bodies",
        "warnings",
        "audit",
        "seconds",
        "peak_memory_bytes",
        "history",
    ];
    expected.sort_unstable();
    let mut found = keys(&report);
    found.sort_unstable();
    assert_eq!(found, expected);
    for (table, names) in [
        ("particles", "boundary fixed fluid free frozen solid total"),
        (
            "density",
            "lattice linf linf_lattice max min rms total_variation",
        ),
        ("residual", "max max_tangential mean rms"),
        (
            "seconds",
            "forces geometry measuring minimiser neighbors output projection seeding total",
        ),
    ] {
        let mut found = keys(&report[table]);
        found.sort_unstable();
        assert_eq!(found.join(" "), names);
    }
    assert_eq!(keys(&report["surface"][0]).len(), 7);
    assert_eq!(
        keys(&report["bodies"][0]),
        ["mass", "name", "repairs", "rigid", "volume", "volume_true"]
    );
    assert_eq!(keys(&report["history"][0]).len(), 5);
    assert_eq!(report["converged"], true);
    assert_eq!(report["scene"]["packing"]["lattice"], "hexagonal");
    assert!(report["density"]["linf"].as_f64().expect("a number") < 0.02);
    let number = |key: &str| report["particles"][key].as_u64().expect("a number") as usize;
    let kinds = ["free", "boundary", "fixed", "frozen"];
    assert_eq!(kinds.map(number).iter().sum::<usize>(), number("total"));
    assert_eq!(
        number("solid") + number("fluid") + number("frozen"),
        number("total")
    );

    let (header, rows) = rows(desk.read("out.csv"));
    assert_eq!(
        header,
        "id,x,y,kind,side,body,volume,mass,density,h,spacing,gamma,residual,nx,ny"
    );
    assert_eq!(rows.len(), number("total"));
    for kind in kinds {
        assert_eq!(
            rows.iter().filter(|row| row[3] == kind).count(),
            number(kind)
        );
    }
    for row in &rows {
        let [x, y, nx, ny] =
            [1, 2, 13, 14].map(|k: usize| row[k].parse::<f64>().expect("a number"));
        if row[3] == "boundary" {
            assert_eq!([&row[4], &row[5]], ["solid", "cylinder"]);
            assert!((x.hypot(y) - 0.9).abs() < 1e-9, "on the inset circle");
            assert!(
                (nx * x + ny * y - 0.9).abs() < 1e-9,
                "the normal points outward"
            );
        } else {
            assert_eq!([nx, ny], [0.0, 0.0]);
            assert_eq!(row[4] == "solid", x.hypot(y) < 0.9 && row[3] != "frozen");
        }
    }
    // What was written is measured alike.
    for file in ["out.csv", "out.vtu"] {
        let ending = desk.succeed(&["quality", file, "--spacing", "0.2", "--json"]);
        let again: Value = serde_json::from_str(&ending.stdout).expect("JSON");
        for (table, key) in [
            ("density", "linf"),
            ("density", "rms"),
            ("residual", "max"),
            ("residual", "max_tangential"),
        ] {
            let [a, b] = [&report, &again].map(|v| v[table][key].as_f64().expect("a number"));
            assert!((a - b).abs() < 1e-12, "{file}: {table}.{key} {a} {b}");
        }
    }
}

#[test]
fn a_sphere_and_a_cube_in_space() {
    let sphere = "\
spacing = 0.15
[domain]
min = [-0.75, -0.75, -0.75]
max = [0.75, 0.75, 0.75]
[[body]]
name = \"sphere\"
density = 2.0
shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 0.45 } }
[packing]
velocity_tolerance = 1e-2
h_over_spacing = 1.0
[quality]
h_over_spacing = 1.2
[output]
include = [\"free\", \"boundary\", \"fixed\"]
";
    let desk = Desk::new().with("sphere.toml", sphere);
    desk.succeed(&[
        "pack",
        "sphere.toml",
        "-o",
        "s.csv",
        "--picture",
        "s.png",
        "--report",
        "s.json",
        "--quiet",
    ]);
    let (header, rows) = rows(desk.read("s.csv"));
    assert_eq!(
        header,
        "id,x,y,z,kind,side,body,volume,mass,density,h,spacing,gamma,residual,nx,ny,nz"
    );
    assert!(rows.iter().all(|row| row[4] != "frozen"));
    let mass_over_volume = |row: &Vec<String>| {
        row[8].parse::<f64>().unwrap_or(0.0) / row[7].parse::<f64>().unwrap_or(1.0)
    };
    assert!(rows.iter().all(|row| {
        (mass_over_volume(row) - if row[5] == "solid" { 2.0 } else { 1.0 }).abs() < 1e-12
    }));
    assert!(desk.read("s.png").starts_with(b"\x89PNG"));
    // Judged by a kernel that reaches farther than the one that packed, the edge of the box is no worse than the rest.
    let report: Value = serde_json::from_slice(&desk.read("s.json")).expect("JSON");
    assert!(
        report["density"]["min"].as_f64().expect("a number") > 0.95,
        "{}",
        report["density"]
    );

    for (name, content) in [
        ("cube.stl", stl(&cube())),
        ("text.stl", text_stl(&cube()).into_bytes()),
    ] {
        let desk = Desk::new().with(name, content);
        let ending = desk.run(&[
            "pack",
            name,
            "--spacing",
            "0.25",
            "--margin",
            "0.5",
            "--quiet",
        ]);
        assert!(matches!(ending.status, Some(0 | 3)), "{ending:?}");
        assert_eq!(ending.stdout, "");
        assert_eq!(ending.stderr, "");
        assert_eq!(desk.files().len(), 2);
    }
}

#[test]
fn corrected_masses_are_reported_and_keep_bodies_whole() {
    // On an exact surface half of a particle is not quite half inside: the sum that stays leaves an error.
    for (surface, part) in [("", 0.8), ("surface = \"exact\"\n", 1.0)] {
        let scene = CYLINDER.replace(
            "[packing]",
            &format!("{surface}[packing]\nmasses = \"corrected\""),
        );
        let desk = Desk::new().with("scene.toml", scene);
        desk.succeed(&["pack", "scene.toml", "--report", "r.json", "--quiet"]);
        let report: Value = serde_json::from_slice(&desk.read("r.json")).expect("JSON");
        let number = |value: &Value| value.as_f64().expect("a number");
        let correction = &report["mass_correction"];
        let linf = number(&report["density"]["linf"]);
        assert!(linf < part * number(&correction["linf_before"]));
        assert!(number(&correction["spread"]) <= 0.02 + 1e-9);
        let body = &report["bodies"][0];
        let (is, should) = (number(&body["volume"]), number(&body["volume_true"]));
        assert!((is / should - 1.0).abs() < 1e-9, "{is} {should}");
    }
}

#[test]
fn a_dry_run_writes_nothing() {
    let desk = Desk::new().with("scene.toml", CYLINDER);
    let ending = desk.succeed(&[
        "pack",
        "scene.toml",
        "--dry-run",
        "--picture",
        "p.svg",
        "--report",
        "r.json",
    ]);
    for part in ["particles", "memory", "time", "nothing was written"] {
        assert!(ending.stdout.contains(part), "{}", ending.stdout);
    }
    assert_eq!(desk.files(), ["scene.toml"]);
}

#[test]
fn threads_do_not_change_a_bit() {
    let desk = Desk::new().with(
        "scene.toml",
        CYLINDER.replace("spacing = 0.2", "spacing = 0.1"),
    );
    desk.succeed(&[
        "pack",
        "scene.toml",
        "-o",
        "one.csv",
        "--threads",
        "1",
        "--quiet",
    ]);
    desk.succeed(&[
        "pack",
        "scene.toml",
        "-o",
        "two.csv",
        "--threads",
        "2",
        "--quiet",
    ]);
    assert!(desk.read("one.csv") == desk.read("two.csv"));
}

#[test]
fn giving_up_is_said() {
    let desk = Desk::new().with(
        "scene.toml",
        CYLINDER.replace("1e-3", "1e-12\nmethod = \"hybrid\"\nmax_iterations = 60"),
    );
    let ending = desk.run(&[
        "pack",
        "scene.toml",
        "--report",
        "r.json",
        "--picture",
        "p.svg",
    ]);
    assert_eq!(ending.status, Some(3));
    assert!(
        ending.stdout.contains("not converged in 60 iterations"),
        "{}",
        ending.stdout
    );
    assert!(
        ending.stdout.contains("max_iterations"),
        "{}",
        ending.stdout
    );
    let report: Value = serde_json::from_slice(&desk.read("r.json")).expect("JSON");
    assert_eq!(report["converged"], false);
    assert_eq!(report["stop_reason"], "iteration-limit");
    assert!(String::from_utf8_lossy(&desk.read("p.svg")).contains("unfinished"));
    assert!(!desk.read("scene.vtu").is_empty());
}

/// Sides, bodies and distances from the origin of the rows that are not frozen.
fn sorted(scene: &str) -> Vec<(String, String, f64)> {
    let desk = Desk::new().with("scene.toml", scene);
    desk.succeed(&["pack", "scene.toml", "-o", "o.csv", "--quiet"]);
    let (_, rows) = rows(desk.read("o.csv"));
    let number = |text: &str| text.parse::<f64>().expect("a number");
    rows.into_iter()
        .filter(|row| row[3] != "frozen")
        .map(|row| {
            (
                row[4].clone(),
                row[5].clone(),
                number(&row[1]).hypot(number(&row[2])),
            )
        })
        .collect()
}

#[test]
fn roles_leave_particles_out() {
    let with = |line: &str| CYLINDER.replace("[packing]", &format!("{line}\n[packing]"));
    let tank = sorted(&with("role = \"container\""));
    assert!(tank.iter().all(|(_, _, r)| *r < 0.9 + 1e-9));
    assert!(
        tank.iter()
            .all(|(side, body, r)| (side == "solid") == (*r > 0.9 - 1e-9)
                && (body == "cylinder") == (side == "solid"))
    );
    assert!(
        tank.iter().any(|(side, ..)| side == "fluid")
            && tank.iter().any(|(side, ..)| side == "solid")
    );
    let void = sorted(&with("role = \"void\""));
    assert!(
        void.iter()
            .all(|(side, body, r)| side == "fluid" && body.is_empty() && *r > 0.9)
    );
    let alone = sorted(&with("[fluid]\nfill = false"));
    assert!(!alone.is_empty() && alone.iter().all(|(side, ..)| side == "solid"));
}

#[test]
fn a_box_without_bodies_is_packed() {
    let rows =
        sorted("spacing = 0.25\n[domain]\nmin = [0, 0]\nmax = [2, 2]\nperiodic = [true, false]\n");
    assert!(rows.iter().all(|(side, ..)| side == "fluid") && rows.len() > 50);
}

#[test]
fn the_first_scene_and_the_lists() {
    let desk = Desk::new();
    let ending = desk.succeed(&["init"]);
    desk.succeed(&["init", "first.toml"]);
    assert_eq!(desk.read("first.toml"), ending.stdout.as_bytes());
    desk.succeed(&["pack", "first.toml", "--dry-run"]);
    for (list, part) in [
        ("methods", "hybrid"),
        ("kernels", "wendland-c6"),
        ("lattices", "simple-cubic"),
        ("shapes", "starfish"),
    ] {
        assert!(desk.succeed(&["list", list]).stdout.contains(part));
    }
    assert!(desk.succeed(&["--help"]).stdout.contains("Examples:"));
    assert!(
        desk.succeed(&["pack", "--help"])
            .stdout
            .contains("Examples:")
    );
    assert!(
        desk.succeed(&["--version"])
            .stdout
            .contains(env!("CARGO_PKG_VERSION"))
    );
}
