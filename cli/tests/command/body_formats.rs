//! Bodies in files of every format.

use crate::{Desk, cube, stl, text_stl};

/// An OBJ file; numbers to the bit.
pub(crate) fn obj(triangles: &[[[f32; 3]; 3]]) -> String {
    let mut text = "o cube\n".to_owned();
    for triangle in triangles {
        for p in triangle {
            let [x, y, z] = p.map(f64::from);
            text += &format!("v {x} {y} {z}\n");
        }
        text += "f -3 -2 -1\n";
    }
    text
}

/// A binary PLY file, the highest byte first.
pub(crate) fn ply(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_big_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_index\nend_header\n",
        3 * triangles.len(),
        triangles.len()
    )
    .into_bytes();
    for x in triangles.as_flattened().as_flattened() {
        bytes.extend(x.to_be_bytes());
    }
    for k in 0..triangles.len() as i32 {
        bytes.push(3);
        bytes.extend(
            [3 * k, 3 * k + 1, 3 * k + 2]
                .map(i32::to_be_bytes)
                .as_flattened(),
        );
    }
    bytes
}

#[test]
fn bodies_of_every_format() {
    let desk = Desk::new()
        .with("cube.stl", stl(&cube()))
        .with("text.stl", text_stl(&cube()))
        .with("cube.obj", obj(&cube()))
        .with("cube.ply", ply(&cube()))
        .with("square.csv", "x,y\n0,0\n1,0\n1,1\n0,1\n")
        .with("square.dat", "a square\n3. 3.\n\n0 0\n0 1\n1 1\n\n0 0\n1 0\n1 1\n")
        .with(
            "square.svg",
            "<svg viewBox='0 0 5 5'><g transform='translate(1 1)'><rect width='1' height='1'/></g></svg>",
        )
        // Content counts, not the name.
        .with("really.csv", ply(&cube()));
    for (body, read, measure) in [
        (
            "cube.stl",
            "an STL mesh, 12 triangles, 1.00 × 1.00 × 1.00",
            "volume 1.00",
        ),
        ("text.stl", "an STL mesh, 12 triangles", "volume 1.00"),
        ("cube.obj", "an OBJ mesh, 12 triangles", "volume 1.00"),
        ("cube.ply", "a PLY mesh, 12 triangles", "volume 1.00"),
        (
            "square.csv",
            "rows of x,y, 4 points, 1.00 × 1.00 scene units",
            "area 1.00",
        ),
        (
            "square.dat",
            "an airfoil's coordinates, 4 points",
            "area 1.00",
        ),
        ("square.svg", "an SVG drawing, 4 points", "area 1.00"),
        ("really.csv", "a PLY mesh, 12 triangles", "volume 1.00"),
    ] {
        let ending = desk.succeed(&[
            "pack",
            body,
            "--spacing",
            "0.25",
            "--margin",
            "0.5",
            "-o",
            "out.csv",
            "--force",
        ]);
        for part in [read, measure] {
            assert!(ending.stdout.contains(part), "{body}: {}", ending.stdout);
        }
        let plan = desk.succeed(&["pack", body, "--spacing", "0.25", "--dry-run"]);
        assert!(plan.stdout.contains(read), "{body}: {}", plan.stdout);
    }
}
