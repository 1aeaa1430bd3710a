//! Body files that cannot be packed.

use crate::{Desk, cube, stl, text_stl};

/// A body file that must be refused with these words.
#[track_caller]
fn refuse(name: &str, content: impl AsRef<[u8]>, parts: &[&str]) {
    let desk = Desk::new().with(name, content);
    let mut all = vec![name];
    all.extend(parts);
    desk.refuse(&["pack", name, "--spacing", "0.2"], &all);
}

#[test]
fn other_units_are_thought_of() {
    let cube_of = |size: f32| -> Vec<_> {
        (cube().iter())
            .map(|corners| corners.map(|corner| corner.map(|x| size * x)))
            .collect()
    };
    let scene = |more: &str| {
        format!(
            "spacing = 0.1\n[domain]\n{more}\n[[body]]\nname = \"part\"\nshape = {{ file = \"large.stl\" }}\n"
        )
    };
    let desk = Desk::new()
        .with("large.stl", stl(&cube_of(2000.0)))
        .with("small.stl", stl(&cube_of(0.002)))
        .with("margin.toml", scene("margin = 1.0"))
        .with(
            "wide.toml",
            scene("min = [-1.0, -1.0, -1.0]\nmax = [3000.0, 3000.0, 3000.0]"),
        )
        .with(
            "box.toml",
            scene("min = [-1.0, -1.0, -1.0]\nmax = [3.0, 3.0, 3.0]") + "role = \"container\"\n",
        );
    for (arguments, advice) in [
        (
            &["pack", "large.stl", "--spacing", "0.1"][..],
            "if large.stl is in millimetres, --scale 0.001 makes it 20 spacings across",
        ),
        (
            &["pack", "large.stl", "--spacing", "0.1", "--scale", "0.5"],
            "--scale 0.0005 makes it 10 spacings",
        ),
        (
            &["pack", "small.stl", "--spacing", "0.1"],
            "if small.stl is in metres and the spacing in millimetres, --scale 1000 makes it 20",
        ),
        (
            &["pack", "margin.toml"],
            "large.stl is in millimetres, scale = 0.001 in body \"part\" makes it 20",
        ),
        (&["pack", "box.toml"], "scale = 0.001 in body \"part\""),
    ] {
        desk.refuse(arguments, &[advice]);
    }
    // Where that would not help, nothing is said.
    for arguments in [
        &["pack", "large.stl", "--spacing", "0.00001"][..],
        &[
            "pack",
            "large.stl",
            "--spacing",
            "1.0",
            "--margin",
            "100000",
        ],
        &["pack", "small.stl", "--spacing", "10"],
        &["pack", "wide.toml"],
    ] {
        let ending = desk.run(arguments);
        assert_eq!(ending.status, Some(2), "{arguments:?}: {ending:?}");
        assert!(!ending.stderr.contains("scale"), "{ending:?}");
    }
}

#[test]
fn missing_files() {
    for name in ["nothing.stl", "nothing.csv", "no/folder.stl"] {
        Desk::new().refuse(
            &["pack", name, "--spacing", "0.2"],
            &[name, "no such file", "check the name"],
        );
    }
    let desk = Desk::new();
    desk.refuse(&["pack", "nothing.toml"], &["nothing.toml", "no such file"]);
    desk.refuse(&["pack", ".", "--spacing", "0.2"], &["not a file"]);
}

#[test]
fn stl_files() {
    let whole = stl(&cube());
    refuse("empty.stl", "", &["empty", "export"]);
    refuse(
        "cut.stl",
        &whole[..whole.len() - 30],
        &["cut off", "export"],
    );
    refuse("head.stl", &whole[..50], &["no STL file", "export"]);
    let mut lying = whole.clone();
    lying[80..84].copy_from_slice(&4_000_000_000_u32.to_le_bytes());
    refuse("lying.stl", &lying, &["STL", "export"]);
    lying[80..84].copy_from_slice(&5_u32.to_le_bytes());
    refuse("short.stl", &lying, &["5 triangles", "export"]);
    for bad in [f32::NAN, f32::INFINITY] {
        let mut triangles = cube();
        triangles[3][1][2] = bad;
        refuse(
            "nan.stl",
            stl(&triangles),
            &["not a finite number", "correct"],
        );
        refuse("nan-text.stl", text_stl(&triangles), &[""]);
    }
    let mut open = cube();
    open.pop();
    refuse("open.stl", stl(&open), &["not closed", "close the holes"]);
    refuse(
        "open-text.stl",
        text_stl(&open),
        &["not closed", "close the holes"],
    );
    // A strip that has only one side.
    let strip: Vec<[[f32; 3]; 3]> = (0..5)
        .map(|i| {
            [i, i + 1, i + 2].map(|k: i32| {
                let angle = (k % 5) as f32 * 1.3;
                [angle.cos(), angle.sin(), 0.3 * (k % 5 % 3) as f32]
            })
        })
        .collect();
    refuse("strip.stl", stl(&strip), &["opposite ways", "consistent"]);
    let flat: Vec<_> = cube()
        .iter()
        .map(|t| t.map(|[x, y, _]| [x, y, 0.0]))
        .collect();
    refuse("flat.stl", stl(&flat), &[""]);
    let text = text_stl(&cube());
    refuse("cut-text.stl", &text[..text.len() / 2], &["export"]);
    refuse("words.stl", "solid nonsense\nfacet\n", &["export"]);
    refuse("garbage.stl", [7; 1000], &["STL", "export"]);
}

#[test]
fn outline_files() {
    refuse("empty.csv", "", &["0 different points", "at least 3"]);
    refuse("two.csv", "x,y\n0,0\n1,1\n", &["2 different points"]);
    refuse("line.csv", "0,0\n1,1\n2,2\n", &["area"]);
    refuse(
        "nan.csv",
        "0,0\n1,0\n1,nan\n0,1\n",
        &[":", "finite numbers"],
    );
    refuse("cut.csv", "0,0\n1,0\n1,1\n0.", &["line 4", "two numbers"]);
    refuse(
        "words.csv",
        "x,y\n0,0\n1,zero\n1,1\n",
        &["line 3", "decimal points"],
    );
    refuse(
        "bow-tie.csv",
        "0,0\n2,2\n2,0\n0,1\n",
        &["1 pair of sides", "cross", "in the order"],
    );
    refuse(
        "astride.csv",
        "0,0\n2,0\n2,2\n0,2\n\n1,1\n1,3\n3,3\n3,1\n",
        &["overlap", "near (2, 1)", "the same way round"],
    );
    refuse("binary.csv", [200, 1, 2, 3, 200], &["text"]);
}

#[test]
fn other_meshes() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    refuse(
        "open.obj",
        format!("{three}f 1 2 3\n"),
        &["not closed", "close the holes"],
    );
    refuse(
        "far.obj",
        format!("{three}f 1 2 4\n"),
        &["line 4", "vertex 4", "export"],
    );
    refuse("points.obj", three, &["no faces", "export"]);
    refuse("cut.ply", "ply\nformat ascii 1.0\n", &["cut off", "export"]);
    refuse(
        "cloud.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
        &["1 points", "closed surface"],
    );
    refuse(
        "lying.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
        &["byte 124", "cut off", "export"],
    );
}

#[test]
fn other_outlines() {
    refuse(
        "count.dat",
        "NACA 0012\n 61. 61.\n\n0 0\n1 0\n",
        &["line 2", "61", "2 follow"],
    );
    refuse(
        "damaged.svg",
        "<svg>\n<path d='M0 0 1 one'/></svg>",
        &["line 2"],
    );
    refuse(
        "clone.svg",
        "<svg>\n<use href='#a'/></svg>",
        &["paints nothing", "fill"],
    );
    refuse("cut.svg", "<svg><path", &["line 1", "save it again"]);
    refuse("empty.svg", "<svg/>", &["paints nothing"]);
}

#[test]
fn other_formats_say_what_to_do() {
    refuse(
        "body.step",
        "ISO-10303-21;\n",
        &["STEP", "export the body as .stl, .obj or .ply"],
    );
    refuse(
        "body.3mf",
        "PK\x03\x04",
        &["archive", "export the body as .stl"],
    );
    refuse(
        "body.dae",
        "<COLLADA/>",
        &["no SVG", "export the body as .stl"],
    );
    refuse(
        "body.txt",
        "a body\n",
        &["no mesh (3-D) and no outline (2-D)"],
    );
    // A mesh among outlines.
    let desk = Desk::new()
        .with("square.csv", "0,0\n1,0\n1,1\n0,1\n")
        .with("cube.stl", stl(&cube()))
        .with(
            "scene.toml",
            "spacing = 0.1\n[domain]\nmargin = 0.5\n[[body]]\nshape = { file = \"square.csv\" }\n[[body]]\nshape = { file = \"cube.stl\" }\n",
        );
    desk.refuse(
        &["pack", "scene.toml"],
        &["cube.stl, an STL mesh", "3-dimensional", "2-dimensional"],
    );
}

#[test]
fn spacings_and_sizes() {
    let desk = Desk::new()
        .with("cube.stl", stl(&cube()))
        .with("square.csv", "0,0\n1,0\n1,1\n0,1\n");
    for body in ["cube.stl", "square.csv"] {
        for (spacing, part) in [
            ("0", "--spacing is 0"),
            ("-0.1", "--spacing is -0.1"),
            ("nan", "--spacing is NaN"),
            ("inf", "--spacing is inf"),
            ("5", "larger than body"),
            ("1e-7", "larger spacing"),
            ("1e-200", ""),
            ("1e200", ""),
        ] {
            desk.refuse(&["pack", body, "--spacing", spacing], &[part]);
        }
        desk.refuse(&["pack", body], &[body, "--spacing LENGTH"]);
        desk.refuse(
            &["pack", body, "--spacing", "0.1", "--margin", "-1"],
            &["--margin is -1"],
        );
        desk.refuse(
            &["pack", body, "--spacing", "0.1", "--scale", "0"],
            &["--scale is 0"],
        );
        desk.refuse(
            &["pack", body, "--spacing", "0.1", "--scale", "1e300"],
            &[""],
        );
        desk.refuse(
            &["pack", body, "--spacing", "0.1", "--method", "hybird"],
            &["did you mean \"hybrid\"?"],
        );
    }
    // Moved inward by half a spacing, nothing of a thin body is left: too little for a method that captures.
    let thin = Desk::new().with("thin.csv", "0,0\n1,0\n1,0.05\n0,0.05\n");
    thin.refuse(
        &["pack", "thin.csv", "--spacing", "0.2", "--method", "hybrid"],
        &["thin", "smaller spacing"],
    );
    thin.succeed(&["pack", "thin.csv", "--spacing", "0.2", "--quiet"]);
}
