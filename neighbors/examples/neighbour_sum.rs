//! The same sum over neighbours by a cell list and by a kd-tree: a smooth count of who is how near.
//!
//! `cargo run -p sphpack-neighbors --example neighbour_sum -- [points a side]`

use std::error::Error;
use std::time::Instant;

use sphpack_neighbors::{CellList, Domain, KdTree, point};

/// A neighbour at this many spacings and beyond counts nothing.
const REACH: f64 = 2.5;

/// What a neighbour counts, by its squared distance in squared spacings.
fn weight(r_squared: f64) -> f64 {
    (1.0 - r_squared / (REACH * REACH)).max(0.0).powi(2)
}

fn main() -> Result<(), Box<dyn Error>> {
    let side: usize = match std::env::args().nth(1) {
        Some(text) => text.parse()?,
        None => 20,
    };
    // A cubic lattice, each site moved a little.
    let points: Vec<[f64; 3]> = (0..side.pow(3))
        .map(|n| {
            let site = [n % side, n / side % side, n / (side * side)];
            let shake = (n as f64 * 0.7).sin() * 0.2;
            site.map(|k| k as f64 + shake)
        })
        .collect();
    let edge = side as f64;
    let domain = Domain::new([-0.5; 3], [edge - 0.5; 3]);

    let start = Instant::now();
    let mut list = CellList::new(&domain, REACH);
    list.update(&points);
    let by_list: Vec<f64> = (0..points.len())
        .map(|i| {
            let near = list.around(i, &points);
            near.map(|(_, apart)| weight(point::norm_squared(apart)))
                .sum()
        })
        .collect();
    println!("cell list: {:.1} ms", 1e3 * start.elapsed().as_secs_f64());

    let start = Instant::now();
    let tree = KdTree::new(&points)?;
    let by_tree: Vec<f64> = (points.iter().enumerate())
        .map(|(i, &p)| {
            let near = tree.within(p, REACH).into_iter();
            let others = near.filter(|hit| hit.index != i);
            others.map(|hit| weight(hit.distance * hit.distance)).sum()
        })
        .collect();
    println!("kd-tree:   {:.1} ms", 1e3 * start.elapsed().as_secs_f64());

    let apart = (by_list.iter().zip(&by_tree))
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    let mean = by_list.iter().sum::<f64>() / by_list.len() as f64;
    println!("{} points, sum {mean:.3} in the mean", points.len());
    if apart > 1e-9 {
        return Err(format!("the sums differ by {apart}").into());
    }
    Ok(())
}
