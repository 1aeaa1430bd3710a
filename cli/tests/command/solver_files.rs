//! Files for solvers, as a person asks for them.

use sphpack::files::Columns;

use crate::Desk;

/// Two bodies in a box, quickly.
const SCENE: &str = "\
spacing = 0.2
[domain]
min = [-2.0, -1.0]
max = [2.0, 1.0]
[[body]]
name = \"left\"
shape = { circle = { center = [-1.0, 0.0], radius = 0.6 } }
[[body]]
name = \"right\"
density = 2.5
shape = { circle = { center = [1.0, 0.0], radius = 0.6 } }
";

#[test]
fn every_solver_gets_its_files() {
    let desk = Desk::new().with("two.toml", SCENE);
    let mut arguments = vec!["pack", "two.toml", "-o", "o.csv"];
    let names = ["o.data", "Reload.xml", "left_rld.xml", "o.bgeo", "o.bi4"];
    arguments.extend(names.iter().flat_map(|name| ["-o", name]));
    let said = desk.succeed(&arguments).stdout;
    let read = |name: &str| Columns::read(&desk.path().join(name)).expect("columns");
    let csv = read("o.csv");
    let count = csv.numbers["x"].len();
    for name in names {
        let columns = read(name);
        let rows = match name {
            "left_rld.xml" => (csv.words["body"].iter())
                .filter(|body| *body == "left")
                .count(),
            _ => count,
        };
        assert_eq!(columns.numbers["x"].len(), rows, "{name}");
        assert!(
            said.contains(&format!("{name} ({rows} particles")),
            "{said}"
        );
        // One body alone has no neighbours.
        if rows == count {
            desk.succeed(&["quality", name, "--spacing", "0.2"]);
        }
    }
    assert!(said.contains(", o.xml"), "{said}");
    assert!(String::from_utf8_lossy(&desk.read("o.xml")).contains("comment=\"right\""));
}

#[test]
fn a_file_for_each_body_or_side() {
    let hole = "[[body]]\nname = \"hole\"\nrole = \"void\"\nshape = { circle = { center = [0.0, 0.7], radius = 0.25 } }\n";
    let scene = format!("{SCENE}{hole}");
    let desk = Desk::new().with("two.toml", scene.as_str());
    let names = ["all.csv", "of-{body}.csv", "{side}.npz", "{body}_rld.xml"];
    let mut arguments = vec!["pack", "two.toml"];
    arguments.extend(names.iter().flat_map(|name| ["-o", name]));
    let said = desk.succeed(&arguments).stdout;
    let made = [
        "all.csv",
        "fluid.npz",
        "fluid_rld.xml",
        "left_rld.xml",
        "of-fluid.csv",
        "of-left.csv",
        "of-right.csv",
        "right_rld.xml",
        "solid.npz",
        "two.toml",
    ];
    assert_eq!(desk.files(), made);
    let read = |name: &str| Columns::read(&desk.path().join(name)).expect("columns");
    let all = read("all.csv");
    let places = |of: &Columns, is_in: &dyn Fn(usize) -> bool| {
        let [x, y] = ["x", "y"].map(|axis| &of.numbers[axis]);
        let rows = (0..x.len()).filter(|&i| is_in(i));
        rows.map(|i| [x[i], y[i]]).collect::<Vec<_>>()
    };
    for (name, column, word) in [
        ("of-left.csv", "body", "left"),
        ("of-right.csv", "body", "right"),
        ("of-fluid.csv", "body", ""),
        ("solid.npz", "side", "solid"),
        ("fluid.npz", "side", "fluid"),
        ("left_rld.xml", "body", "left"),
        ("fluid_rld.xml", "body", ""),
    ] {
        let expected = places(&all, &|i| all.words[column][i] == word);
        assert!(!expected.is_empty());
        assert_eq!(places(&read(name), &|_| true), expected, "{name}");
        assert!(
            said.contains(&format!("{name} ({} particles", expected.len())),
            "{said}"
        );
    }
    // Every one of them is asked about.
    desk.refuse(
        &["pack", "two.toml", "-o", "of-{body}.csv"],
        &["of-left.csv", "--force"],
    );
    desk.refuse(
        &["pack", "two.toml", "-o", "{body}-{side}.csv"],
        &["of one body or of one side"],
    );
    for name in ["a/b", "a:b", " "] {
        let desk = Desk::new().with("two.toml", scene.replace("left", name));
        desk.refuse(
            &["pack", "two.toml", "-o", "{body}.csv"],
            &[name, "which no file can be"],
        );
        assert_eq!(desk.files(), ["two.toml"]);
    }
    let desk = Desk::new().with("two.toml", scene.replace("left", "fluid"));
    desk.refuse(
        &["pack", "two.toml", "-o", "{body}.csv"],
        &["a body is called \"fluid\""],
    );
}

#[test]
fn particles_go_to_standard_output() {
    let desk = Desk::new().with("two.toml", SCENE);
    let alone = desk.succeed(&["pack", "two.toml", "-o", "-"]);
    assert_eq!(desk.files(), ["two.toml"]);
    assert!(
        alone.stderr.contains("audit      passed"),
        "{}",
        alone.stderr
    );
    let both = desk.succeed(&["pack", "two.toml", "-o", "-", "-o", "o.csv", "--quiet"]);
    assert_eq!(both.stdout.as_bytes(), desk.read("o.csv"));
    assert_eq!((both.stdout, both.stderr.as_str()), (alone.stdout, ""));
    desk.refuse(
        &["pack", "two.toml", "-o", "-", "-o", "-"],
        &["asked for twice"],
    );
}

#[test]
fn what_a_solver_cannot_hold_is_refused_before_the_work() {
    let with = |more: &str| Desk::new().with("two.toml", SCENE.to_owned() + more);
    let refuse = |desk: &Desk, name: &str, parts: &[&str]| {
        desk.refuse(&["pack", "two.toml", "-o", name], parts);
        assert_eq!(desk.files(), ["two.toml"]);
    };
    let corrected = with("[packing]\nmasses = \"corrected\"\n");
    let hydrostatic = with(
        "[fluid]\nhydrostatic = { gravity = [0.0, -9.81], level = 4.0, sound_speed = 90.0 }\n",
    );
    for name in ["o.data", "o.bi4"] {
        refuse(
            &corrected,
            name,
            &[name, "one mass", "packing.masses = \"equal\""],
        );
        refuse(&hydrostatic, name, &[name, "one mass", "fluid.hydrostatic"]);
    }
    let frozen = with("[output]\ninclude = [\"free\", \"frozen\"]\n");
    refuse(
        &frozen,
        "o.bi4",
        &["frozen particles have one of their own", "output.include"],
    );
    let void = "role = \"void\"\nsurface = \"exact\"\n";
    refuse(
        &with(void),
        "o.bi4",
        &["exact surface of \"right\"", "inset"],
    );
    let periodic = SCENE.replace("[domain]", "[domain]\nperiodic = [true, false]");
    let periodic = Desk::new().with("two.toml", periodic);
    refuse(&periodic, "o.bi4", &["o.bi4", "period", "domain.periodic"]);
    refuse(
        &with(""),
        "lfet_rld.xml",
        &["lfet", "did you mean \"left\"?"],
    );
    let fluid = Desk::new().with("two.toml", SCENE.replace("left", "fluid"));
    refuse(
        &fluid,
        "Reload.xml",
        &["a body is called \"fluid\"", "another name"],
    );
}

#[test]
fn both_files_of_a_case_are_asked_about() {
    let desk = Desk::new()
        .with("two.toml", SCENE)
        .with("o.xml", "precious");
    desk.refuse(&["pack", "two.toml", "-o", "o.bi4"], &["o.xml", "--force"]);
    assert_eq!(desk.read("o.xml"), b"precious");
    let twice = ["pack", "two.toml", "-o", "o.bi4", "-o", "o.xml", "--force"];
    desk.refuse(&twice, &["o.xml", "asked for twice"]);
    assert_eq!(desk.files(), ["o.xml", "two.toml"]);
}
