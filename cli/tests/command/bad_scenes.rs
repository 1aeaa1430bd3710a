//! Scenes that make no sense.

use crate::{CYLINDER, Desk, cube, stl};

/// The small cylinder with something changed must be refused with these words.
#[track_caller]
fn refuse(from: &str, to: &str, parts: &[&str]) {
    assert!(CYLINDER.contains(from), "{from}");
    let desk = Desk::new().with("scene.toml", CYLINDER.replacen(from, to, 1));
    let mut all = vec!["scene.toml"];
    all.extend(parts);
    desk.refuse(&["pack", "scene.toml"], &all);
}

#[test]
fn unknown_words_are_located() {
    refuse(
        "spacing",
        "spacng",
        &["scene.toml:1:1", "did you mean \"spacing\"?"],
    );
    refuse(
        "circle",
        "circel",
        &["scene.toml:7:", "did you mean \"circle\"?"],
    );
    refuse(
        "velocity_tolerance",
        "velocity",
        &["scene.toml:9:", "velocity_tolerance"],
    );
    refuse(
        "[packing]",
        "[packing]\nkernel = \"quintik\"",
        &["scene.toml:9:10", "did you mean \"quintic\"?"],
    );
    refuse(
        "[packing]",
        "[packing]\nmethod = \"relaxed\"",
        &["scene.toml:9:10", "relaxation"],
    );
    refuse("[packing]", "[packing", &["scene.toml:8:"]);
}

#[test]
fn numbers_are_checked() {
    for bad in ["0", "-1", "nan", "inf", "1e400"] {
        refuse(
            "spacing = 0.2",
            &format!("spacing = {bad}"),
            &["scene.toml:1:"],
        );
    }
    refuse(
        "spacing = 0.2",
        "spacing = 3.0",
        &["larger than body", "use a spacing below"],
    );
    refuse(
        "spacing = 0.2",
        "spacing = 1e-9",
        &["GiB", "larger spacing"],
    );
    refuse(
        "max = [2.0, 2.0]",
        "max = [2.0, -2.0]",
        &["scene.toml:4:", "domain.max[1]"],
    );
    refuse(
        "max = [2.0, 2.0]",
        "max = [-1.2, 2.0]",
        &["lies outside the domain", "enlarge the domain"],
    );
    refuse(
        "center = [0.0, 0.0]",
        "center = [30000.1, 0.0]",
        &[
            "outside the domain",
            "body from (29999.1, -1) to (30001.1, 1)",
        ],
    );
    refuse("max = [2.0, 2.0]", "max = [1e300, 2.0]", &[""]);
    refuse("max = [2.0, 2.0]", "max = [1e308, 1e308]", &[""]);
    refuse(
        "spacing = 0.2\n[domain]",
        "spacing = 0.9\n[domain]\nperiodic = [true, false]",
        &["periodic", "longer"],
    );
    refuse(
        "[packing]",
        "surface = 9.9\n[packing]",
        &["cylinder", "nothing of the body is left"],
    );
    refuse(
        "[packing]",
        "[packing]\nlattice = \"fcc\"",
        &["fcc", "3-dimensional"],
    );
    refuse(
        "[packing]",
        "[quality]\nh_over_spacing = 0\n[packing]",
        &["quality.h_over_spacing"],
    );
}

#[test]
fn outlines_are_checked() {
    let circle = "{ circle = { center = [0.0, 0.0], radius = 1.0 } }";
    refuse(
        circle,
        "{ polygon = { points = [[0, 0], [1, 1], [1, 0], [0, 1]] } }",
        &["meets itself"],
    );
    refuse(
        circle,
        "{ polygon = { points = [[0, 0], [1, 1]] } }",
        &["2 different points"],
    );
    refuse(
        circle,
        "{ polygon = { points = [[0, 0], [1], [1, 0]] } }",
        &["points[1] has 1 entries"],
    );
    refuse(
        circle,
        "{ naca = { digits = \"15\", chord = 1 } }",
        &["cylinder", "four or five digits"],
    );
    refuse(
        circle,
        "{ starfish = { center = [0, 0], radius = 0.5, amplitude = 2, arms = 5 } }",
        &["amplitude"],
    );
    refuse(circle, "{ file = \"nothing.csv\" }", &["nothing.csv"]);
    refuse(
        circle,
        "{ sphere = { center = [0, 0, 0], radius = 1 } }",
        &["3-dimensional"],
    );
}

#[test]
fn dimensions_of_files_must_agree() {
    let desk = Desk::new().with("cube.stl", stl(&cube())).with(
        "scene.toml",
        CYLINDER.replace(
            "{ circle = { center = [0.0, 0.0], radius = 1.0 } }",
            "{ file = \"cube.stl\" }",
        ),
    );
    desk.refuse(
        &["pack", "scene.toml"],
        &["scene.toml", "3-dimensional", "all must agree"],
    );
}

#[test]
fn files_that_are_no_scenes() {
    for (content, part) in [
        (&b""[..], "missing"),
        (b"hello", "scene.toml:1:"),
        (&[0xff, 0xfe, 0], "not text"),
    ] {
        let desk = Desk::new().with("scene.toml", content);
        desk.refuse(&["pack", "scene.toml"], &["scene.toml", part]);
    }
    let desk = Desk::new().with("scene.toml", CYLINDER);
    desk.refuse(
        &["pack", "scene.toml", "--spacing", "0.1"],
        &["--spacing", "set spacing in it"],
    );
}

#[test]
fn solids_that_overlap_are_named() {
    let scene = |role: &str, x: f64| {
        format!(
            "spacing = 0.1\n[domain]\nmin = [-2.0, -2.0]\nmax = [3.0, 2.0]\n[[body]]\nname = \"disc\"\nshape = {{ circle = {{ center = [0.0, 0.0], radius = 1.0 }} }}\n[[body]]\nname = \"plate\"\nrole = \"{role}\"\nshape = {{ box = {{ min = [{x}, -1.0], max = [{}, 1.0] }} }}\n",
            x + 0.9
        )
    };
    let desk = Desk::new()
        .with("overlap.toml", scene("solid", 0.8))
        .with("touch.toml", scene("solid", 1.0))
        .with("void.toml", scene("void", 0.8));
    desk.refuse(
        &["pack", "overlap.toml", "--dry-run"],
        &[
            "overlap.toml",
            "\"disc\" and \"plate\" overlap",
            "is in both",
            "precedence = 1",
            "move one",
        ],
    );
    desk.succeed(&["pack", "touch.toml", "--dry-run"]);
    desk.refuse(
        &["pack", "void.toml", "--dry-run"],
        &["\"plate\" crosses", "\"disc\""],
    );
}

/// A body on a side would be carried on as far as the box goes, for minutes; that nobody can hold so much is known before.
#[test]
fn a_box_beyond_all_memory_is_refused_at_once() {
    let scene = "spacing = 1.0
[domain]
min = [0.0, 0.0, 0.0]
max = [12.0, 8.0, 1e12]
[[body]]
name = \"ball\"
shape = { sphere = { center = [6.0, 4.0, 3.0], radius = 3.0 } }
";
    let desk = Desk::new().with("scene.toml", scene);
    let begin = std::time::Instant::now();
    desk.refuse(
        &["pack", "scene.toml", "--dry-run"],
        &["of memory, more than the", "particles"],
    );
    assert!(begin.elapsed().as_secs() < 20);
}
