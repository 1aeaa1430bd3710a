//! Meshes written and read again, and what real files are like.

use std::fmt::Write as _;

use super::*;
use crate::Solid;

/// A body of two tetrahedra that share nothing, its numbers such that 32 bits hold them.
fn body() -> Vec<Solid> {
    let tetrahedron = |x: f64| {
        let v = [
            [x, 0.0, -0.5],
            [x + 1.25, 0.0, 0.0],
            [x, 1.0, 3e-5_f32.into()],
            [x, 0.0, 1e10],
        ];
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|t: [usize; 3]| t.map(|k| v[k]))
    };
    ["left", "right part"]
        .into_iter()
        .zip([0.0, 7.0])
        .map(|(name, x)| Solid {
            name: name.into(),
            triangles: tetrahedron(x).to_vec(),
        })
        .collect()
}

fn all(solids: &[Solid]) -> Vec<[[f64; 3]; 3]> {
    solids.iter().flat_map(|s| s.triangles.clone()).collect()
}

fn text_stl(solids: &[Solid]) -> String {
    let mut text = String::new();
    for solid in solids {
        let _ = writeln!(text, "solid {}", solid.name);
        for t in &solid.triangles {
            text += "facet normal 0 0 1\nouter loop\n";
            for [x, y, z] in t {
                let _ = writeln!(text, "vertex {x:e} {y} {z}");
            }
            text += "endloop\nendfacet\n";
        }
        let _ = writeln!(text, "endsolid {}", solid.name);
    }
    text
}

fn binary_stl(triangles: &[[[f64; 3]; 3]], title: &[u8]) -> Vec<u8> {
    let mut bytes = title.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for t in triangles {
        bytes.extend([0; 12]);
        for x in t.as_flattened() {
            bytes.extend((*x as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn obj(solids: &[Solid]) -> String {
    let mut text = String::new();
    for solid in solids {
        let _ = writeln!(text, "o {}", solid.name);
        for t in &solid.triangles {
            for [x, y, z] in t {
                let _ = writeln!(text, "v {x} {y:e} {z}");
            }
            text += "f -3 -2 -1\n";
        }
    }
    text
}

fn ply(triangles: &[[[f64; 3]; 3]], format: &str) -> Vec<u8> {
    let n = triangles.len();
    let mut bytes = format!(
        "ply\nformat {format} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {n}\nproperty list uchar uint vertex_indices\nend_header\n",
        3 * n
    )
    .into_bytes();
    let [text, little] = ["ascii", "binary_little_endian"].map(|name| format == name);
    for corner in triangles.as_flattened() {
        for x in corner {
            match (text, little) {
                (true, _) => bytes.extend(format!("{x} ").bytes()),
                (_, true) => bytes.extend(x.to_le_bytes()),
                _ => bytes.extend(x.to_be_bytes()),
            }
        }
        bytes.extend(text.then_some(b'\n'));
    }
    for k in 0..n as u32 {
        let corners = [3 * k, 3 * k + 1, 3 * k + 2];
        if text {
            let [a, b, c] = corners;
            bytes.extend(format!("3 {a} {b} {c}\n").bytes());
            continue;
        }
        bytes.push(3);
        for corner in corners {
            bytes.extend(if little {
                corner.to_le_bytes()
            } else {
                corner.to_be_bytes()
            });
        }
    }
    bytes
}

#[test]
fn every_format_gives_the_same_triangles_again() {
    let solids = body();
    let loose = all(&solids);
    let named = |bytes: &[u8], format: BodyFormat| format.solids(bytes).unwrap();
    assert_eq!(named(text_stl(&solids).as_bytes(), BodyFormat::Stl), solids);
    assert_eq!(named(obj(&solids).as_bytes(), BodyFormat::Obj), solids);
    let rounded: Vec<_> = loose
        .iter()
        .map(|t| t.map(|v| v.map(|x| f64::from(x as f32))))
        .collect();
    for title in ["", "a body", "solid body", " \tsolid"] {
        let read = named(&binary_stl(&loose, title.as_bytes()), BodyFormat::Stl);
        assert_eq!(all(&read), rounded);
    }
    assert_eq!(
        named(&binary_stl(&loose, b"a body"), BodyFormat::Stl)[0].name,
        "a body"
    );
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let bytes = ply(&loose, format);
        assert_eq!(all(&named(&bytes, BodyFormat::Ply)), loose, "{format}");
        assert_eq!(
            BodyFormat::detect(&bytes, "txt"),
            Ok(BodyFormat::Ply),
            "{format}"
        );
    }
}

#[test]
fn corpus_bodies_have_their_volumes() {
    for (format, name, volume) in [
        (BodyFormat::Stl, "binary.stl", 0.25),
        (BodyFormat::Stl, "two_solids.stl", 0.5),
        (BodyFormat::Stl, "upper_case_crlf.stl", 0.25),
        (BodyFormat::Obj, "tetrahedron.obj", 0.25),
        (BodyFormat::Obj, "cube.obj", 1.0),
        (BodyFormat::Ply, "text.ply", 0.25),
        (BodyFormat::Ply, "little.ply", 0.25),
        (BodyFormat::Ply, "big.ply", 0.25),
        (BodyFormat::Ply, "many_properties.ply", 1.0 / 3.0),
        (BodyFormat::Ply, "quads.ply", 1.0),
        (BodyFormat::Ply, "strips.ply", 1.0),
        (BodyFormat::Ply, "strips_text.ply", 1.0),
        (BodyFormat::Stl, "no_count.stl", 0.25),
        (BodyFormat::Stl, "facet_names.stl", 0.25),
    ] {
        let read = contents(format, &file(format, name)).unwrap();
        assert!((read - volume).abs() < 1e-12, "{name}: {read}");
    }
    // Exporters that write the head first and never go back to the count; strips; names behind "endfacet".
    for count in [0, u32::MAX] {
        let mut bytes = file(BodyFormat::Stl, "binary.stl");
        bytes[80..84].copy_from_slice(&count.to_le_bytes());
        assert_eq!(contents(BodyFormat::Stl, &bytes), Ok(0.25));
        assert_eq!(BodyFormat::detect(&bytes, ""), Ok(BodyFormat::Stl));
        bytes.pop();
        refused(BodyFormat::Stl, &bytes, &["STL"]);
    }
    let names = |format: BodyFormat, name| -> Vec<String> {
        let solids = format.solids(&file(format, name)).unwrap();
        solids.into_iter().map(|solid| solid.name).collect()
    };
    assert_eq!(names(BodyFormat::Stl, "two_solids.stl"), ["left", "right"]);
    assert_eq!(names(BodyFormat::Stl, "binary.stl"), ["a tetrahedron"]);
    assert_eq!(
        names(BodyFormat::Obj, "cube.obj"),
        ["bottom", "top", "sides"]
    );
}

#[test]
fn groups_that_come_again_are_one_part() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng a b\nf 1 2 3\ng c\no d\nf 1 3 2\ng a b\nf 3 2 1\nf 1 2\n";
    let solids = BodyFormat::Obj.solids(text.as_bytes()).unwrap();
    let parts: Vec<(&str, usize)> = solids
        .iter()
        .map(|s| (s.name.as_str(), s.triangles.len()))
        .collect();
    assert_eq!(parts, [("", 1), ("a b", 2), ("d", 1)]);
}

#[test]
fn bad_stl_files_say_where() {
    let stl = |content: &str, parts: &[&str]| refused(BodyFormat::Stl, content, parts);
    stl("solid a\nendsolid\n", &["no triangles", "export"]);
    stl("solid a\n\nfacet nonsense\n", &["line 3", "facet normal"]);
    stl(
        "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 nan\n",
        &["line 4", "finite"],
    );
    stl(
        "solid a\r\nfacet normal 0 0 0\r\nvertex 0 0\r\n",
        &["line 3", "three"],
    );
    let quad = "solid a\nfacet normal 0 0 0\nouter loop\n".to_owned() + &"vertex 0 0 0\n".repeat(4);
    stl(&quad, &["line 7", "triangle"]);
    stl("solid a\nsolid b\n", &["line 2", "endsolid"]);
    stl("solid a\nendsolid\nvertex 0 0 0\n", &["line 3", "outside"]);
    refused(
        BodyFormat::Stl,
        file(BodyFormat::Obj, "cube.obj"),
        &["no STL file"],
    );
    let called_solid = file(BodyFormat::Stl, "binary_called_solid.stl");
    refused(
        BodyFormat::Stl,
        &called_solid[..200],
        &["4 triangles", "cut off"],
    );
    refused(
        BodyFormat::Csv,
        file(BodyFormat::Stl, "binary.stl"),
        &["text"],
    );
    refused(BodyFormat::Svg, "<svg", &["line 1", "damaged"]);
    let error = BodyFormat::Svg.solids(b"<svg/>").unwrap_err();
    assert!(error.to_string().contains("2-D"), "{error}");
    let error = BodyFormat::Ply.loops(b"ply\n").unwrap_err();
    assert!(error.to_string().contains("3-D"), "{error}");
}

#[test]
fn bad_obj_files_say_where() {
    let obj = |content: &str, parts: &[&str]| refused(BodyFormat::Obj, content, parts);
    obj("v 0 0\n", &["line 1", "three finite numbers"]);
    obj("v 0 0 0\nf 1 2 3\n", &["line 2", "vertex 3", "only 1"]);
    obj("v 0 0 0\n\nf 0 1 1\n", &["line 3", "count from 1"]);
    obj("v 0 0 0\nf -2 1 1\n", &["line 2", "does not have"]);
    obj("v 0 0 0\nf 1 x 1\n", &["line 2", "\"x\""]);
    obj("v 0 0 0\nf 1 99999999999 1\n", &["line 2"]);
    obj("v 0 0 0\nf 1 -9223372036854775808 1\n", &["line 2"]);
    obj("v 0 0 0\n", &["no faces"]);
    obj("cstype bezier\n", &["free-form"]);
    obj("v 0 0 0\nf 1 1 1\n", &["volume"]);
}

#[test]
fn bad_ply_files_say_where() {
    let ply = |content: &str, parts: &[&str]| refused(BodyFormat::Ply, content, parts);
    let vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let face = "element face 1\nproperty list uchar int vertex_index\n";
    let text =
        |middle: &str, rows: &str| format!("ply\nformat ascii 1.0\n{middle}end_header\n{rows}");
    ply("ply\nformat ascii 1.0\n", &["cut off"]);
    ply("ply\nformat utf8 1.0\n", &["line 2", "ascii"]);
    ply("ply\nend_header\n", &["line 2", "format"]);
    ply("ply\nelement vertex -1\n", &["line 2", "count"]);
    ply("ply\nproperty float x\n", &["line 2", "element"]);
    ply("ply\nelement v 1\nproperty real x\n", &["line 3", "type"]);
    ply(
        "ply\nelement v 1\nproperty list int x\n",
        &["line 3", "two types"],
    );
    ply("ply\nlement v 1\n", &["line 2", "not known"]);
    ply(
        &text(vertex, "0 0 0\n1 0 0\n0 1 0\n"),
        &["3 points", "no faces"],
    );
    ply(
        &text("element vertex 1\nproperty float x\n", "0\n"),
        &["y or z"],
    );
    ply(
        &text("element face 1\nproperty int x\n", "0\n"),
        &["vertex_indices"],
    );
    ply(
        &text("element tristrips 1\nproperty int x\n", ""),
        &["strips"],
    );
    let both = format!("{vertex}{face}");
    ply(&text(&both, "0 0 0\n1 0 0\n"), &["line 11", "missing"]);
    ply(&text(&both, "0 0 0\n1 0\n"), &["line 11", "too few"]);
    ply(
        &text(&both, "0 0 0\n1 0 0 7\n"),
        &["line 11", "1 numbers more"],
    );
    ply(&text(&both, "0 0 0\n1 x 0\n"), &["line 11", "no number"]);
    ply(
        &text(&both, "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"),
        &["vertex 0", "finite"],
    );
    let points = "0 0 0\n1 0 0\n0 1 0\n";
    ply(
        &text(&both, &format!("{points}3 0 1 3\n")),
        &["vertex 3", "only 3"],
    );
    ply(
        &text(&both, &format!("{points}3 0 1 -1\n")),
        &["line 13", "vertex -1"],
    );
    ply(
        &text(&both, &format!("{points}3.5 0 1 2\n")),
        &["line 13", "3.5 entries"],
    );
    ply(
        &text(&both, &format!("{points}4000000000 0 1\n")),
        &["line 13"],
    );
    // A count that the file does not bear out, and nothing to read for it.
    let endless = "element vertex 18446744073709551615\nproperty float x\nproperty float y\nproperty float z\n";
    ply(&text(endless, "0 0 0\n"), &["missing"]);
    let mut binary =
        format!("ply\nformat binary_big_endian 1.0\n{endless}end_header\n").into_bytes();
    let start = binary.len();
    binary.extend([0; 17]);
    refused(
        BodyFormat::Ply,
        &binary,
        &[&format!("byte {}", start + 12), "cut off"],
    );
}
