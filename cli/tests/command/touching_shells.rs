//! Shells that touch: along a side cut along other diagonals, flush in a corner, along an edge; and cracks of no width.

use serde_json::Value;

use crate::{Desk, cube, stl};

type Triangles = Vec<[[f32; 3]; 3]>;

/// The unit cube stretched and moved; with `is_mirrored` its sides are cut along the other diagonals.
fn block(low: [f32; 3], size: [f32; 3], is_mirrored: bool) -> Triangles {
    let place = |p: [f32; 3]| std::array::from_fn(|k| low[k] + size[k] * p[k]);
    (cube().into_iter())
        .map(|[a, b, c]| {
            if is_mirrored {
                [a, c, b].map(|[x, y, z]| place([x, 1.0 - y, z]))
            } else {
                [a, b, c].map(place)
            }
        })
        .collect()
}

#[test]
fn touching_blocks_are_packed_as_one_body() {
    // A crack: one side of the cube meets a corner in the middle of its edge.
    let mut cracked = block([0.0; 3], [1.0; 3], false);
    let [a, b, c] = cracked.swap_remove(0);
    let middle = std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
    cracked.extend([[a, middle, c], [middle, b, c]]);
    let plate = block([0.0; 3], [1.0, 1.0, 0.3], false);
    for (name, triangles, volume, word) in [
        (
            "side",
            [
                block([0.0; 3], [0.6; 3], false),
                block([0.6, 0.0, 0.0], [0.6; 3], true),
            ]
            .concat(),
            0.432,
            "wall of no thickness",
        ),
        (
            "corner",
            [plate, block([0.0, 0.0, 0.3], [0.5; 3], true)].concat(),
            0.425,
            "wall of no thickness",
        ),
        (
            "edge",
            [
                block([0.0; 3], [0.6; 3], false),
                block([0.6, 0.6, 0.0], [0.6; 3], false),
            ]
            .concat(),
            0.432,
            "touch along edges",
        ),
        ("crack", cracked, 1.0, "crack of no width"),
    ] {
        let desk = Desk::new().with("body.stl", stl(&triangles));
        desk.succeed(&[
            "pack",
            "body.stl",
            "--spacing",
            "0.1",
            "--margin",
            "0.4",
            "-o",
            "out.csv",
            "--report",
            "out.json",
        ]);
        let report: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
        let number = |value: &Value| value.as_f64().expect("a number");
        let linf = number(&report["density"]["linf"]);
        let closest = number(&report["closest_pair_over_spacing"]);
        assert!(linf < 5e-3 && closest > 0.75, "{name}: {linf} {closest}");
        assert!(number(&report["force_evaluations"]) < 200.0, "{name}");
        let body = &report["bodies"][0];
        assert!(
            (number(&body["volume_true"]) - volume).abs() < 1e-4,
            "{name}: {body}"
        );
        assert!(body["repairs"].to_string().contains(word), "{name}: {body}");
    }
}
