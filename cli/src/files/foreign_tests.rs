//! Particle files of others, and files that are damaged or mean ill.

use std::path::Path;

use super::tests::{one_particle, written};
use super::*;

#[test]
fn npz_of_others() {
    // numpy.savez_compressed of x (32 bits), y (whole numbers), an array of two axes and one of another length.
    let columns = read_npz(include_bytes!("others.npz"), Path::new("p.npz")).unwrap();
    assert_eq!(columns.numbers["x"], [0.5, 1.5, -2.0]);
    assert_eq!(columns.numbers["y"], [1.0, 2.0, 3.0]);
    assert_eq!(columns.words["kind"], ["free", "frozen", "é"]);
    assert_eq!(columns.numbers.len() + columns.words.len(), 3);
    let good = written(ParticleFormat::Npz, &one_particle(3));
    let mut bad = good.clone();
    bad[140] ^= 1;
    for (bytes, part) in [
        (&b"PK"[..], "no NPZ file"),
        (&good[..good.len() - 60], "no NPZ file"),
        (&bad[..], "checksum"),
    ] {
        let message = read_npz(bytes, Path::new("p.npz")).unwrap_err().to_string();
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[test]
fn vtu_with_names_as_strings_and_normals_as_vectors() {
    let text = r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid><FieldData>
<DataArray type="String" Name="kind_names" NumberOfTuples="2" format="ascii">102 114 101 101 0 98 0</DataArray>
<DataArray type="Int32" Name="side:a &lt;&quot;b&quot;&gt;" NumberOfTuples="1" format="ascii"> 1 </DataArray>
<DataArray type="Int32" Name="side:far" NumberOfTuples="1" format="ascii">999999999999</DataArray>
</FieldData><Piece NumberOfPoints="2" NumberOfCells="0">
<Points><DataArray type="Float64" Name="p" NumberOfComponents="3" format="ascii">0 0 0 1 2 0</DataArray></Points>
<PointData><DataArray type="Int32" Name="kind" format="ascii">1 0</DataArray>
<DataArray type="Int32" Name="side" format="ascii">0 1</DataArray>
<DataArray type="Float64" Name="normal" NumberOfComponents="3" format="ascii">0 1 0 0.6 0.8 0</DataArray>
</PointData></Piece></UnstructuredGrid></VTKFile>"#;
    let columns = read_vtu(text.as_bytes(), Path::new("p.vtu")).unwrap();
    assert_eq!(columns.words["kind"], ["b", "free"]);
    assert_eq!(columns.words["side"], ["", "a <\"b\">"]);
    assert_eq!(columns.numbers["nx"], [0.0, 0.6]);
    assert_eq!(columns.numbers["ny"], [1.0, 0.8]);
}

#[test]
fn npz_that_would_fill_the_memory() {
    // Its directory claims what deflate could make of it.
    let mut bytes = written(ParticleFormat::Npz, &one_particle(3));
    let entry = bytes
        .windows(4)
        .position(|four| four == b"PK\x01\x02")
        .unwrap();
    bytes[entry + 24..entry + 28].copy_from_slice(&0xf000_0000_u32.to_le_bytes());
    let message = read_npz(&bytes, Path::new("p.npz"))
        .unwrap_err()
        .to_string();
    assert!(message.contains("would grow to 40265"), "{message}");
}

#[test]
fn csv_that_is_no_text_in_lines() {
    let endless = vec![b'7'; 3 << 20];
    let late = [&endless[..], b"\n1,2\n"].concat();
    for bytes in [
        &b"x,y\0\n1,2\n"[..],
        &[0; 4096],
        &endless,
        &late,
        b"x,y\n\xff,1\n",
    ] {
        let message = read_csv(bytes, Path::new("p.csv")).unwrap_err().to_string();
        assert!(message.contains("not text in lines"), "{message}");
    }
    let columns = read_csv(b"x,y\n1,2", Path::new("p.csv")).unwrap();
    assert_eq!(columns.numbers["y"], [2.0]);
}

#[test]
fn vtk_of_others() {
    let text = "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n1 2 0\n3 4 0\n\
        METADATA\nINFORMATION 0\n\nVERTICES 3 2\nOFFSETS vtktypeint64\n0 1 2\nCONNECTIVITY vtktypeint64\n0 1\n\
        POINT_DATA 2\nSCALARS volume double 1\nLOOKUP_TABLE default\n0.5 0.25\nNORMALS Normals float\n0 0 1 0 0 1\n\
        FIELD FieldData 2\nthe%20id 1 2 vtktypeint64\n7 8\nMETADATA\nINFORMATION 0\n\nkind 1 2 string\nfree\nfro%7Aen\n";
    let columns = read_vtk(text.as_bytes(), Path::new("p.vtk")).unwrap();
    assert_eq!(columns.numbers["y"], [2.0, 4.0]);
    assert_eq!(columns.numbers["volume"], [0.5, 0.25]);
    assert_eq!(columns.numbers["the id"], [7.0, 8.0]);
    assert_eq!(columns.words["kind"], ["free", "frozen"]);
    for (from, to, part) in [
        ("# vtk", "#vtk", "no legacy VTK file"),
        ("ASCII", "TEXT", "neither ASCII nor BINARY"),
        ("POLYDATA", "STRUCTURED_POINTS", "STRUCTURED_POINTS"),
        ("POINTS 2", "POINTS many", "no number of things"),
        (
            "POINTS 2",
            "POINTS 99999999999999999999",
            "no number of things",
        ),
        (
            "POINTS 2",
            "POINTS 18446744073709551615",
            "more numbers than there can be",
        ),
        ("POINTS 2", "POINTS 3", "no number"),
        ("POINT_DATA 2", "POINT_DATA 3", "more or fewer points"),
        (
            "1 2 vtktypeint64",
            "1 1 vtktypeint64",
            "1 numbers for 2 points",
        ),
        ("double", "complex", "no type of numbers"),
        ("0.5 0.25", "0.5 a_quarter", "a_quarter"),
        ("NORMALS", "TENSORS", "TENSORS"),
        ("free\nfro%7Aen\n", "free", "cut off"),
        ("CONNECTIVITY", "CONNECTION", "no CONNECTIVITY"),
    ] {
        let message = read_vtk(text.replacen(from, to, 1).as_bytes(), Path::new("p.vtk"))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains(part) && message.starts_with("p.vtk"),
            "{message} lacks {part}"
        );
    }
    // Sizes that binary files claim are not believed.
    let head = "# vtk DataFile Version 3.0\n\nBINARY\nDATASET UNSTRUCTURED_GRID\n";
    for claim in [
        "POINTS 4611686018427387904 double\n",
        "POINTS 1000000000000 double\n1234",
        "FIELD FieldData 9999999999999\n",
    ] {
        let message = read_vtk((head.to_owned() + claim).as_bytes(), Path::new("p.vtk"))
            .unwrap_err()
            .to_string();
        assert!(message.contains("damaged"), "{message}");
    }
}

#[test]
fn ply_of_others() {
    let text = "ply\r\nformat ascii 1.0\ncomment by hand\nelement thing 1\nproperty list uchar int all\nelement vertex 2\n\
        property float x\nproperty float y\nproperty uchar kind\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n\
        3 0 1 2\n1 2 0\n3 4 3\n";
    let columns = read_ply(text.as_bytes(), Path::new("p.ply")).unwrap();
    assert_eq!(columns.numbers["x"], [1.0, 3.0]);
    assert_eq!(columns.numbers["kind"], [0.0, 3.0]);
    for (from, to, part) in [
        ("ply", "PLY!", "no PLY file"),
        ("end_header", "end", "no PLY file"),
        ("vertex 2", "vertex 9", "fewer than 9"),
        ("3 4 3", "3 four 3", "3 four 3"),
        ("float y", "real y", "type of y"),
        ("ascii", "binary_big_endian", "lists"),
        ("element vertex", "element point", "no vertices"),
    ] {
        let message = read_ply(text.replacen(from, to, 1).as_bytes(), Path::new("p.ply"))
            .unwrap_err()
            .to_string();
        assert!(message.contains(part), "{message} lacks {part}");
    }
    let mut big = b"ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty short x\nproperty double y\nend_header\n".to_vec();
    big.extend((-7_i16).to_be_bytes());
    big.extend(0.25_f64.to_be_bytes());
    let columns = read_ply(&big, Path::new("p.ply")).unwrap();
    assert_eq!(
        [columns.numbers["x"][0], columns.numbers["y"][0]],
        [-7.0, 0.25]
    );
}

#[track_caller]
fn refuse(text: &str, parts: &[&str]) {
    let message = read_csv(text.as_bytes(), Path::new("p.csv"))
        .unwrap_err()
        .to_string();
    for part in parts {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[test]
fn csv_of_others() {
    let columns = read_csv(
        b"# made by hand\nX;Y;colour\n1;2;red\n\n3;4;blue\n",
        Path::new("p.csv"),
    )
    .unwrap();
    assert_eq!(columns.numbers["x"], [1.0, 3.0]);
    assert_eq!(columns.words["colour"], ["red", "blue"]);
    refuse("", &["p.csv", "empty"]);
    refuse("a,b\n1,2\n", &["p.csv:1", "no column \"x\""]);
    refuse("x,y,x\n1,2,3\n", &["called \"x\""]);
    refuse("x,y\n1,2\n3\n", &["p.csv:3", "1 fields"]);
    refuse("x,y\n1,2\n3,nan\n", &["p.csv:3", "y is \"nan\""]);
    refuse("x,y,volume\n1,2,big\n", &["p.csv:2", "volume"]);
}

#[track_caller]
fn rows(text: &str) -> Columns {
    read_csv(text.as_bytes(), Path::new("p.csv")).unwrap()
}

#[test]
fn csv_of_numpy() {
    // numpy.savetxt("p.csv", a, header="x y") and with commas, on every system.
    for text in [
        "# x y volume\n1.0e+00 2.0e+00 5.0e-01\n3.0e+00 -4.0e+00 2.5e-01\n",
        "# x,y,volume\r\n1.0e+00,2.0e+00,5.0e-01\r\n\r\n3.0e+00,-4.0e+00,2.5e-01\r\n",
        "# x,y,volume\n1 2 0.5\n3 -4 0.25\n",
        "# made by hand, x to the right\n#X; Y; Volume\n# in metres\n1;2;.5;\n3;-4;.25;\n",
        "x,y,volume\n  1    2 0.5\n  3   -4 0.25\n",
        "x y volume\n1\t2\t0.5\n3\t-4\t0.25\n",
        "x\ty\tvolume\t\n1\t2\t0.5\t\n3\t-4\t0.25\t\n",
        "\"x\" \"y\" \"volume\"\n1 2 0.5\n3 -4 0.25 \n",
    ] {
        let columns = rows(text);
        assert_eq!(columns.numbers["x"], [1.0, 3.0], "{text}");
        assert_eq!(columns.numbers["y"], [2.0, -4.0], "{text}");
        assert_eq!(columns.numbers["volume"], [0.5, 0.25], "{text}");
        assert_eq!(columns.numbers.len() + columns.words.len(), 3, "{text}");
    }
    let columns = rows("x y kind body\n1 2 free \"left wing\"\n3 4 frozen none\n");
    assert_eq!(columns.words["body"], ["left wing", "none"]);
    // A separator at the end of the rows only, or a last column without a name.
    assert_eq!(rows("x,y\n1,2,\n3,4,\n").numbers.len(), 2);
    assert_eq!(rows("x,y,\n1,2,7\n3,4,8\n").numbers[""], [7.0, 8.0]);
}

#[test]
fn csv_without_names() {
    for text in [
        "1 2\n3 4\n",
        "# made by hand\n1,2\n3,4\n",
        "\n1;2;\n3;4;\n",
        "1\t2\r\n3\t4",
    ] {
        let columns = rows(text);
        assert_eq!(columns.numbers["x"], [1.0, 3.0], "{text}");
        assert_eq!(columns.numbers["y"], [2.0, 4.0], "{text}");
        assert_eq!(columns.numbers.len(), 2, "{text}");
    }
    assert_eq!(rows("1 2 3\n4 5 6e-1\n").numbers["z"], [3.0, 0.6]);
    refuse(
        "1 2 3 4\n",
        &["p.csv:1", "4 numbers", "x,y,z", "volume (or m and rho)"],
    );
    refuse("# x,y\n1,2,3,4\n", &["p.csv:2", "4 numbers"]);
    refuse("1 2\n3\n", &["p.csv:2", "1 fields", "first row has 2"]);
    refuse("1 2\n3 four\n", &["p.csv:2", "y is \"four\""]);
    refuse("nan 2\n3 4\n", &["p.csv:1", "x is \"nan\""]);
    refuse("# x y x\n1 2 3\n", &["called \"x\""]);
}

#[test]
fn names_in_capitals() {
    let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float X\nproperty float Y\n\
        property float m\nproperty float M\nend_header\n1 2 3 4\n";
    let columns = Columns::parse(ParticleFormat::Ply, text.as_bytes(), Path::new("p.ply")).unwrap();
    let names: Vec<&str> = columns.numbers.keys().map(String::as_str).collect();
    assert_eq!(names, ["M", "m", "x", "y"]);
}

#[test]
fn vtu_of_others() {
    let text = "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\
        <Piece NumberOfPoints=\"2\" NumberOfCells=\"0\"><PointData><DataArray type=\"Float32\" Name=\"volume\" format=\"ascii\">0.5 0.25</DataArray></PointData>\
        <Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">1 2 0 3 4 0</DataArray></Points></Piece></UnstructuredGrid></VTKFile>";
    let columns = read_vtu(text.as_bytes(), Path::new("p.vtu")).unwrap();
    assert_eq!(columns.numbers["x"], [1.0, 3.0]);
    assert_eq!(columns.numbers["volume"], [0.5, 0.25]);
    for (from, to, part) in [
        (
            "LittleEndian\"",
            "LittleEndian\" compressor=\"vtkZLibDataCompressor\"",
            "compressed",
        ),
        ("LittleEndian", "BigEndian", "big-endian"),
        ("UnstructuredGrid", "ImageData", "ImageData"),
        ("\"2\"", "\"9\"", "9 points"),
        ("0.25", "a quarter", "no number"),
        ("format=\"ascii\">1", "format=\"binary\">1", "binary"),
    ] {
        let message = read_vtu(text.replace(from, to).as_bytes(), Path::new("p.vtu"))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains(part) && message.starts_with("p.vtu"),
            "{message} lacks {part}"
        );
    }
}
