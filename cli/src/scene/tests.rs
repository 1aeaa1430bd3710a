//! Scenes that are right, and messages for those that are not.

use super::*;
use crate::Error;

const GOOD: &str = r#"
spacing = 0.1
[domain]
min = [-2.0, -2.0]
max = [2, 2]
[[body]]
name = "cylinder"
shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
"#;

#[track_caller]
fn parse(text: &str) -> Scene {
    Scene::parse(text, "folder/good.toml").unwrap()
}

/// The message for `text`, which must name the file, the line and every part.
#[track_caller]
fn refuse(text: &str, line: usize, parts: &[&str]) {
    match Scene::parse(text, "bad.toml") {
        Ok(scene) => panic!("accepted: {scene:?}"),
        Err(error) => {
            let message = error.to_string();
            assert!(
                matches!(error, Error::Scene { .. }) && error.status() == 2,
                "{message}"
            );
            assert!(
                message.starts_with(&format!("bad.toml:{line}:")),
                "{message} (line {line})"
            );
            for part in parts {
                assert!(message.contains(part), "{message} lacks {part}");
            }
        }
    }
}

#[test]
fn defaults_are_filled_in() {
    let scene = parse(GOOD);
    assert_eq!(scene.name, "good");
    assert_eq!(scene.packing, PackingSpec::default());
    assert_eq!(scene.body[0].surface, Inset(0.5));
    assert_eq!(scene.judge(), (KernelKind::Quintic, 1.2));
    let is_default = |kind: Kind| scene.includes(kind) == (kind != Kind::Frozen);
    assert!(Kind::ALL.into_iter().all(is_default));
    assert_eq!(
        scene.resolve(Path::new("body.stl")),
        Path::new("folder/body.stl")
    );
}

#[test]
fn the_template_refines() {
    let with = |more: &[&str]| -> String {
        TEMPLATE
            .lines()
            .map(|line| {
                let is_wanted = more.iter().any(|start| line.starts_with(start));
                let line = if is_wanted { &line[2..] } else { line };
                line.to_owned() + "\n"
            })
            .collect()
    };
    let keys = [
        "# [refinement",
        "# coarsest",
        "# finest",
        "# growth",
        "# region",
    ];
    let scene = parse(&with(&keys));
    let refinement = scene.refinement.as_ref().expect("a refinement");
    assert_eq!((refinement.growth, refinement.region.len()), (1.08, 1));
    assert_eq!(scene.no_finer(0.001), 0.01);
    // What particles of many sizes do not have is refused by name.
    for (line, word) in [
        ("# surroundings", "surroundings"),
        ("# thin = ", ""),
        ("# spacing = ", ""),
        ("# curvature = ", ""),
    ] {
        let text = with(&[&keys[..], &[line]].concat());
        let parsed = Scene::parse(&text, "s.toml");
        match (word, parsed) {
            ("", parsed) => assert!(parsed.is_ok(), "{parsed:?}"),
            (word, Err(error)) => assert!(error.to_string().contains(word), "{error}"),
            (_, Ok(_)) => panic!("{line} is taken"),
        }
    }
    for (from, to, words) in [
        ("growth = 1.08", "growth = 1.5", "between 1.02 and 1.3"),
        (
            "coarsest = 0.4",
            "coarsest = 0.05",
            "coarser than refinement.coarsest",
        ),
        (
            "# method = \"balanced\"",
            "method = \"hybrid\"",
            "particles of one size",
        ),
        (
            "# finish = \"even\"",
            "finish = \"both\"",
            "particles of one size",
        ),
        (
            "# masses = \"equal\"",
            "masses = \"corrected\"",
            "particles of one size",
        ),
        (
            "# frozen = \"lattice\"",
            "frozen = \"square\"",
            "particles of one size",
        ),
    ] {
        let text = with(&keys).replacen(from, to, 1);
        let error = Scene::parse(&text, "s.toml").expect_err(to).to_string();
        assert!(error.contains(words), "{to}: {error}");
    }
    let text = with(&["# spacing = 0.1 "]);
    let error = Scene::parse(&text, "s.toml")
        .expect_err("no table")
        .to_string();
    assert!(error.contains("[refinement]"), "{error}");
}

#[test]
fn the_template_packs_and_knows_every_key() {
    assert_eq!(parse(TEMPLATE).body.len(), 1);
    // Every key that a serialised scene has stands in the template.
    let json = serde_json::to_value(parse(TEMPLATE)).unwrap();
    for table in ["fluid", "packing", "quality", "output"] {
        for key in json[table].as_object().unwrap().keys() {
            let stands = [format!("{key} = "), format!("# {key}.")];
            assert!(
                stands.iter().any(|text| TEMPLATE.contains(text)),
                "{table}.{key}"
            );
        }
    }
    // And with its comments off it is still a scene.
    let whole: String = TEMPLATE
        .lines()
        .filter(|line| {
            ![
                "# margin",
                "# shape",
                "# rotate =",
                // A word for the scale.
                "# units",
                // Goes with the method "auto".
                "# accuracy",
                "# Pack",
                "# Keys",
                "# Other",
                "# A ",
                // Not beside the surroundings of a lattice: tried by itself below.
                "# [refinement",
                "# coarsest",
                "# finest",
                "# growth",
                "# region",
                "# field",
                "# curvature",
                "# spacing",
            ]
            .iter()
            .any(|start| line.starts_with(start))
        })
        .map(|line| line.strip_prefix("# ").unwrap_or(line).to_owned() + "\n")
        .collect();
    let scene = parse(&whole);
    // Where leaving a key out has no word of its own, the template names what it comes to.
    let default = PackingSpec::default();
    let settling = default.settling_in(2);
    assert_eq!(
        scene.packing.settling_in(2).tolerance(),
        settling.tolerance()
    );
    let of_scene = scene.packing.settling_in(2);
    assert_eq!(of_scene.minimiser, settling.minimiser);
    assert_eq!(of_scene.levelling, settling.levelling);
    assert_eq!(scene.packing.kernel(), default.kernel());
    assert_eq!(scene.packing.h_over_spacing(), default.h_over_spacing());
    let said = PackingSpec {
        kernel: scene.packing.kernel,
        h_over_spacing: scene.packing.h_over_spacing,
        levelling: scene.packing.levelling,
        minimiser: scene.packing.minimiser,
        residual_tolerance: scene.packing.residual_tolerance,
        hybrid: HybridOptions {
            moving: scene.packing.hybrid.moving,
            ..default.hybrid
        },
        ..default
    };
    assert_eq!(scene.packing, said);
    assert_eq!(scene.domain.periodic, Some(vec![false, false]));
}

#[test]
fn everything_of_the_format_is_read() {
    let scene = parse(
        r#"
spacing = 0.05
domain = { margin = 0.5 }
[[body]]
shape = { file = "tank.stl" }
role = "container"
scale = 10
rotate = { axis = [0, 0, 1], degrees = 17.0 }
translate = [0.0, 1.0, 2.0]
density = 2.5
surface = "exact"
[[body]]
shape = { torus = { center = [0, 0, 0], axis = [0, 0, 1], major = 1, minor = 0.3 } }
role = "void"
surface = 0.25
[fluid]
density = 0.9
fill = false
[packing]
method = "hybrid"
kernel = "wendland-c2"
h_over_spacing = 1.3
lattice = "fcc"
frozen = "square"
velocity_tolerance = 1e-5
residual_tolerance = 1e-4
minimiser = "fire"
masses = "corrected"
mass_spread = 0.01
finish = "even"
max_iterations = 7
seed = 3
[quality]
kernel = "cubic"
h_over_spacing = 2
[output]
include = ["free", "boundary"]
"#,
    );
    assert_eq!(scene.body[0].name, "body");
    assert_eq!(scene.body[1].name, "body 2");
    assert_eq!(scene.body[0].surface, Inset(0.0));
    assert_eq!(scene.body[1].surface, Inset(0.25));
    assert_eq!(scene.body[0].role, Role::Container);
    assert_eq!(scene.packing.lattice, Some(Lattice::Fcc));
    assert_eq!(scene.packing.frozen, Frozen::Square);
    assert_eq!(scene.judge(), (KernelKind::Cubic, 2.0));
    assert!(!scene.includes(Kind::Frozen));
}

#[test]
fn coupled_starts_from_the_papers_lattice() {
    let mut packing = parse(GOOD).packing;
    packing.lattice = None;
    assert_eq!(packing.lattice_in(2), None);
    packing.method = Method::Coupled;
    assert_eq!(packing.lattice_in(2), Some(Lattice::Square));
    assert_eq!(packing.lattice_in(3), Some(Lattice::SimpleCubic));
    packing.lattice = Some(Lattice::Fcc);
    assert_eq!(packing.lattice_in(3), Some(Lattice::Fcc));
}

#[test]
fn a_scene_survives_json() {
    let scene = parse(GOOD);
    let json = serde_json::to_string(&scene).unwrap();
    let again: Scene =
        serde_json::from_str(&json.replace("\"kernel\":null", "\"kernel\":\"quintic\"")).unwrap();
    assert_eq!(again.body, scene.body);
    assert_eq!(again.packing, scene.packing);
}

#[test]
fn unknown_names_offer_the_nearest() {
    let with = |from: &str, to: &str| GOOD.replace(from, to);
    refuse(
        &with("spacing", "spacng"),
        2,
        &["unknown key \"spacng\"", "did you mean \"spacing\"?"],
    );
    refuse(&with("name =", "nmae ="), 7, &["did you mean \"name\"?"]);
    refuse(
        &with("{ circle", "{ cirlce"),
        8,
        &[
            "unknown name \"cirlce\"",
            "did you mean \"circle\"?",
            "torus",
        ],
    );
    refuse(&with("radius", "raduis"), 8, &["did you mean \"radius\"?"]);
    let packing = |line: &str| format!("{GOOD}[packing]\n{line}\n");
    refuse(
        &packing("kernel = \"quintc\""),
        10,
        &[
            "no kernel is called \"quintc\"",
            "\"quintic\"?",
            "wendland-c6",
        ],
    );
    refuse(
        &packing("lattice = \"hexagon\""),
        10,
        &["\"hexagonal\"?", "auto"],
    );
    refuse(&packing("method = \"hybird\""), 10, &["\"hybrid\"?"]);
    refuse(&packing("finish = \"evn\""), 10, &["\"even\"?"]);
    refuse(
        &packing("epsilon = 1"),
        10,
        &["unknown key \"epsilon\"", "velocity_tolerance"],
    );
    refuse(&format!("{GOOD}role = \"tank\""), 9, &["container", "void"]);
    refuse(
        &format!("{GOOD}[output]\ninclude = [\"fre\"]"),
        10,
        &["\"free\"?"],
    );
    refuse(&format!("{GOOD}[fluids]"), 9, &["did you mean \"fluid\"?"]);
}

#[test]
fn numbers_out_of_range_are_named() {
    let with = |from: &str, to: &str| GOOD.replace(from, to);
    for bad in ["0", "-0.1", "nan", "inf"] {
        refuse(
            &with("spacing = 0.1", &format!("spacing = {bad}")),
            2,
            &["spacing is", "positive"],
        );
    }
    refuse(
        &with("max = [2, 2]", "max = [2, -3]"),
        5,
        &["domain.max[1] is -3", "larger"],
    );
    refuse(
        &with("max = [2, 2]", "max = [2, 2, 2]"),
        5,
        &["domain.max has 3 entries"],
    );
    refuse(
        &with("min = [-2.0, -2.0]", "min = [-2.0]"),
        4,
        &["two (2-D) or three (3-D)"],
    );
    refuse(
        &with("max = [2, 2]", "max = [2, 2]\nmargin = 1"),
        6,
        &["either margin"],
    );
    refuse(
        &with("max = [2, 2]", "max = [2, 2]\nperiodic = [true]"),
        6,
        &["periodic has 1 entries"],
    );
    refuse(
        &with("radius = 1.0", "radius = -1.0"),
        8,
        &["circle.radius is -1", "cylinder"],
    );
    refuse(
        &with("center = [0.0, 0.0]", "center = [0.0, 0.0, 1.0]"),
        8,
        &["circle.center has 3 entries"],
    );
    refuse(
        &with("circle", "sphere"),
        8,
        &["sphere.center has 2 entries; it needs 3"],
    );
    refuse(
        &with(
            "circle = { center = [0.0, 0.0]",
            "sphere = { center = [0.0, 0.0, 0.0]",
        ),
        8,
        &["3-dimensional", "the domain is 2-dimensional"],
    );
    for (line, part) in [
        ("scale = 0", "scale is 0"),
        ("density = -1", "density is -1"),
        ("surface = -0.5", "\"inset\", \"exact\""),
        ("surface = \"insert\"", "\"inset\", \"exact\""),
        ("rotate = { axis = [0, 0, 0], degrees = 1 }", "axis is zero"),
        (
            "rotate = { axis = [0, 0, 1], degrees = 1 }",
            "rotate_degrees = 1",
        ),
        ("translate = [1]", "translate has 1 entries"),
        (
            "scale = \"big\"",
            "scale is the text \"big\"; it must be a number",
        ),
    ] {
        refuse(&format!("{GOOD}{line}"), 9, &[part]);
    }
    for (line, part) in [
        ("h_over_spacing = 20", "between 0.5 and 5"),
        ("velocity_tolerance = 0", "velocity_tolerance is 0"),
        ("max_iterations = -1", "-1"),
        ("method = \"relaxed\"", "relaxation"),
        ("minimiser = \"newton\"", "no minimiser is called"),
        ("mass_spread = 1.5", "mass_spread is 1.5"),
        ("levelling = -1", "levelling is -1"),
        ("hybrid.predicted = 1.5", "hybrid.predicted is 1.5"),
        ("hybrid.moving = 0", "hybrid.moving is 0"),
        ("hybrid.projection_growth = 0.5", "projection_growth is 0.5"),
        ("hybrid.capture = [0.5, 2.0]", "capture is [0.5, 2]"),
        ("hybrid.time_step = 0", "time_step is 0"),
        ("hybrid.time_step = 100", "time_step is 100"),
        ("agitated.agitators = \"still\"", "turning, resting, none"),
        ("agitated.steady_revolutions = 0", "steady_revolutions is 0"),
    ] {
        refuse(&format!("{GOOD}[packing]\n{line}"), 10, &[part]);
    }
    refuse(
        &format!("{GOOD}[packing]\nmethod = \"hybrid\"\nfinish = \"consistent\""),
        11,
        &["finish = \"even\""],
    );
    // It packs fluid between walls.
    refuse(
        &format!("{GOOD}[packing]\nmethod = \"ppa\""),
        10,
        &["\"cylinder\"", "role \"void\"", "method = \"balanced\""],
    );
    refuse(
        &format!(
            "{GOOD}[[body]]\nname = \"cylinder\"\nshape = {{ naca = {{ digits = \"0015\", chord = 1 }} }}"
        ),
        10,
        &["both called"],
    );
}

#[test]
fn broken_text_is_located() {
    refuse("spacing = \n", 1, &[]);
    refuse("spacing = 0.1\n[domain\n", 2, &[]);
    refuse("[domain]\nmargin = 1", 1, &["\"spacing\" is missing"]);
    refuse("spacing = 1\n[domain]\nmargin = 1", 3, &["[[body]]"]);
    refuse("spacing = 1\n[domain]\n", 2, &["domain needs min and max"]);
}

#[test]
fn levelling_goes_by_the_kernel() {
    let packing = |keys: &str| parse(&format!("{GOOD}[packing]\n{keys}\n")).packing;
    let at = |keys: &str| packing(keys).settling_in(2).levelling;
    let in_space = |keys: &str| packing(keys).settling_in(3).levelling;
    assert_eq!(at(""), 10.0);
    assert_eq!(at("h_over_spacing = 1.5"), 10.0);
    assert!((at("h_over_spacing = 1.0") - 4.82).abs() < 0.01);
    assert_eq!(at("h_over_spacing = 1.0\nlevelling = 7.0"), 7.0);
    assert_eq!(at("masses = \"corrected\""), 200.0);
    assert_eq!(at("method = \"complex\""), 1000.0);
    assert_eq!(at("method = \"complex\"\nlevelling = 0.0"), 0.0);
    assert_eq!(in_space(""), 10.0);
    let wendland = "kernel = \"wendland-c2\"\nh_over_spacing";
    assert_eq!(at(&format!("{wendland} = 1.5")), 10.0);
    assert_eq!(in_space(&format!("{wendland} = 1.5")), 60.0);
    assert!((in_space(&format!("{wendland} = 1.0")) - 6.7).abs() < 0.1);
    assert_eq!(in_space(&format!("{wendland} = 1.5\nlevelling = 7.0")), 7.0);
}

#[test]
fn limits_of_iterations_limit_what_is_estimated() {
    let evaluations = |method: &str, more: &str| {
        let scene = parse(&format!(
            "spacing = 1.0\n[domain]\nmin = [0.0, 0.0]\nmax = [9.0, 9.0]\n[packing]\nmethod = \"{method}\"\n{more}"
        ));
        scene.packing.typical_evaluations(2)
    };
    assert_eq!(evaluations("hybrid", "max_iterations = 7"), 7.0);
    assert!(evaluations("hybrid", "") > 1000.0);
    assert_eq!(evaluations("coupled", "max_iterations = 7"), 7.0);
    let consistent = evaluations("balanced", "finish = \"consistent\"");
    assert!(consistent > 2.0 * evaluations("balanced", ""));
}
