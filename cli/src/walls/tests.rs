//! Scenes with layers, judged by their tables.

use sphpack_packing::{Kind, Silent};
use sphpack_separation::Side;

use crate::files::{write_bi4, write_csv};
use crate::{Options, Outcome, Scene, run};

fn scene(body: &str) -> String {
    format!("spacing = 0.1\ndomain = {{ min = [-1.2, -1.2], max = [1.2, 1.2] }}\n{body}")
}

fn outcome(text: &str) -> Outcome {
    let scene = Scene::parse(text, "walls.toml").expect("a scene");
    run(&scene, &Options::default(), &mut Silent).expect("a packing")
}

const CIRCLE: &str =
    "[[body]]\nname = \"cylinder\"\nshape = { circle = { center = [0, 0], radius = 0.7 } }\n";
const TANK: &str = "[[body]]\nname = \"tank\"\nrole = \"container\"\nshape = { box = { min = [-0.8, -0.8], max = [0.8, 0.8] } }\n";

#[test]
fn a_solid_with_layers_is_a_shell_and_the_fluid_is_as_without() {
    let full = outcome(&scene(CIRCLE));
    let shell = outcome(&scene(&format!("{CIRCLE}layers = 3\ndensity = 2.0")));
    assert!(shell.report.audit.passed, "{:?}", shell.report.audit);
    let fluid = |outcome: &Outcome| -> Vec<(u32, [f64; 3], f64)> {
        let table = &outcome.table;
        (0..table.len())
            .filter(|&i| table.side[i] == Side::Fluid)
            .map(|i| (table.id[i], table.position[i], table.volume[i]))
            .collect()
    };
    assert_eq!(fluid(&full), fluid(&shell));
    let table = &shell.table;
    let solid: Vec<usize> = (0..table.len())
        .filter(|&i| table.side[i] == Side::Solid)
        .collect();
    assert!(solid.iter().all(|&i| table.kind[i] != Kind::Free));
    for &i in &solid {
        let [x, y, _] = table.position[i];
        let depth = 0.7 - x.hypot(y);
        assert!((table.distance[i] + depth).abs() < 1e-9);
        let layer = (depth / 0.1).floor();
        assert!((0.0..3.0).contains(&layer) && (depth / 0.1 - layer - 0.5).abs() < 1e-3);
        let [nx, ny, _] = table.normal(i);
        assert!(
            (nx * x + ny * y - x.hypot(y)).abs() < 1e-9,
            "out of the body"
        );
        assert!((table.mass[i] - 2.0 * table.volume[i]).abs() < 1e-15);
    }
    let volume: f64 = solid.iter().map(|&i| table.volume[i]).sum();
    let exact = std::f64::consts::PI * (0.7_f64.powi(2) - 0.4_f64.powi(2));
    assert!((volume / exact - 1.0).abs() < 1e-4, "{volume}");
    let body = &shell.report.bodies[0];
    assert!((body.volume - volume).abs() < 1e-12);
    let wall = body.wall.as_ref().expect("a wall");
    let counts: Vec<usize> = wall.layers.iter().map(|layer| layer.count).collect();
    assert_eq!(counts.iter().sum::<usize>(), solid.len());
    assert_eq!(counts, [41, 35, 28]);
    assert!(full.report.bodies[0].wall.is_none() && full.table.distance.is_empty());
    let inner = table.filtered(|i| table.kind[i] != Kind::Frozen);
    write_bi4(&inner, &mut Vec::new()).expect("a case of DualSPHysics");
}

#[test]
fn a_container_with_layers_has_its_wall_outside_and_fluid_up_to_it() {
    let tank = outcome(&scene(&format!("{TANK}layers = 3")));
    assert!(tank.report.audit.passed, "{:?}", tank.report.audit);
    let table = &tank.table;
    let mut fluid = 0.0;
    for i in 0..table.len() {
        let [x, y, _] = table.position[i];
        let (u, v) = (x.abs() - 0.8, y.abs() - 0.8);
        let depth = u.max(0.0).hypot(v.max(0.0)) + u.max(v).min(0.0);
        match table.side[i] {
            Side::Fluid => {
                assert!(depth < -0.04 && table.kind[i] == Kind::Free && !table.is_wall(i));
                assert_eq!(table.normal(i), [0.0; 3]);
                fluid += table.volume[i];
            }
            Side::Solid => {
                assert!((table.distance[i] + depth).abs() < 1e-9 && depth > 0.04);
                let [nx, ny, _] = table.normal(i);
                // Along it the wall's surface is that far away.
                let foot = [x + depth * nx, y + depth * ny];
                let on = foot.map(|c: f64| c.abs() - 0.8);
                assert!(on[0].max(on[1]).abs() < 1e-9, "into the fluid");
            }
        }
    }
    assert!((fluid / 2.56 - 1.0).abs() < 0.01, "{fluid}");
    // Files say the same.
    let mut text = Vec::new();
    write_csv(table, &mut text).expect("text");
    let text = String::from_utf8(text).expect("text");
    assert!(
        text.lines()
            .next()
            .expect("a header")
            .ends_with(",distance")
    );
}

#[test]
fn what_layers_do_not_go_with_is_refused_in_words() {
    let cases = [
        ("layers = 0", "1 to 20"),
        ("layers = 3\nsurface = \"exact\"", "leave surface out"),
        ("layers = 3\nthin = \"watertight\"", "watertight"),
        ("layers = 3\nrole = \"void\"", "void"),
        ("layers = 3\n[packing]\nmethod = \"hybrid\"", "balanced"),
        ("layers = 3\n[packing]\nmasses = \"corrected\"", "corrected"),
        ("layers = 3\n[refinement]\ncoarsest = 0.2", "[refinement]"),
        ("layers = 3\ntranslate = [0.6, 0.0]", "side of the domain"),
    ];
    for (more, word) in cases {
        let text = scene(&format!("{CIRCLE}{more}"));
        let error = Scene::parse(&text, "walls.toml")
            .map_err(|error| error.to_string())
            .and_then(|scene| crate::plan(&scene, None).map_err(|error| error.to_string()))
            .expect_err(more);
        assert!(error.contains(word), "{more}: {error}");
    }
}
