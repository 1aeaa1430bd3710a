//! Readers against files in the corpus, files written here, and damaged ones.

mod corpus;
mod detection;
mod drawings;
mod mangled;
mod meshes;
mod outlines;

use std::path::PathBuf;

use crate::{BodyFormat, GeometryError, Mesh, Outline, Sketch, Surface};

/// The folder of a format in the corpus.
fn folder(format: BodyFormat) -> &'static str {
    match format {
        BodyFormat::Stl => "stl",
        BodyFormat::Obj => "obj",
        BodyFormat::Ply => "ply",
        BodyFormat::Csv => "csv",
        BodyFormat::Airfoil => "airfoil",
        BodyFormat::Svg => "svg",
    }
}

/// The corpus's files of a format, by name.
fn files(format: BodyFormat) -> Vec<(String, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("corpus")
        .join(folder(format));
    let mut files: Vec<(String, Vec<u8>)> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, std::fs::read(path).unwrap())
        })
        .collect();
    files.sort();
    files
}

fn file(format: BodyFormat, name: &str) -> Vec<u8> {
    files(format)
        .into_iter()
        .find(|file| file.0 == name)
        .unwrap()
        .1
}

/// Volume or area of the body in a file.
fn contents(format: BodyFormat, bytes: &[u8]) -> Result<f64, GeometryError> {
    Ok(match format.dimension() {
        3 => Mesh::from_bytes(format, bytes)?.volume(),
        _ => Sketch::from_bytes(format, bytes)?.body()?.outline.volume(),
    })
}

/// A file that must be refused with these words.
#[track_caller]
fn refused(format: BodyFormat, bytes: impl AsRef<[u8]>, parts: &[&str]) {
    let message = contents(format, bytes.as_ref()).unwrap_err().to_string();
    for part in parts {
        assert!(message.contains(part), "{message} lacks \"{part}\"");
    }
}
