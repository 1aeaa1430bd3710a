//! A mesh from a file, or a cube made here: what it is, the closest point to a place, even points, and its inset.
//!
//! `cargo run -p sphpack-geometry --example mesh_queries -- [mesh file] [inset depth] [points]`

use std::error::Error;

use sphpack_geometry::{GeometryError, Mesh, Surface};
use sphpack_neighbors::point;

/// The unit cube: two triangles a side, anticlockwise seen from outside.
fn cube() -> Result<Mesh, GeometryError> {
    let corners = (0..8_u32)
        .map(|k| [k & 1, k >> 1 & 1, k >> 2 & 1].map(f64::from))
        .collect();
    let triangles = vec![
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
    ];
    Mesh::new(corners, triangles)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mesh = match arguments.first() {
        Some(path) => Mesh::read(path)?,
        None => cube()?,
    };
    let bounds = mesh.bounds();
    let size = bounds.diagonal();
    let depth = match arguments.get(1) {
        Some(text) => text.parse()?,
        None => 0.02 * size,
    };
    let count = match arguments.get(2) {
        Some(text) => text.parse()?,
        None => 200,
    };
    let (triangles, corners) = (mesh.triangles().len(), mesh.features().corners.len());
    println!("{triangles} triangles, {corners} sharp corners");
    println!("area {:.6}, volume {:.6}", mesh.measure(), mesh.volume());

    let place = bounds.grown(0.1 * size).max;
    let hit = mesh.closest(place);
    println!(
        "closest to {place:?}: {:?}, distance {:.6}",
        hit.point, hit.distance
    );

    let even = mesh.sample(count)?;
    let nearest = |p: [f64; 3]| {
        let others = even.iter().map(|other| point::distance(other.point, p));
        others.filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min)
    };
    let apart = even.iter().map(|hit| nearest(hit.point));
    let least = apart.fold(f64::INFINITY, f64::min);
    println!("{} even points, no two nearer than {least:.6}", even.len());

    let inset = mesh.inset(depth)?;
    println!(
        "{depth:.6} further in: area {:.6}, volume {:.6}",
        inset.measure(),
        inset.volume()
    );
    if inset.volume() >= mesh.volume() {
        return Err("the inset is no smaller than the body".into());
    }
    Ok(())
}
