//! Labels the points of a grid: which are in the disc, which in the starfish, which in the fluid around both. Draws them as letters.
//!
//! `cargo run -p sphpack-separation --example label_grid -- [rows]`

use std::error::Error;

use sphpack_geometry::{Ball, Outline, Surface};
use sphpack_separation::{separate, separate_by_flood};

/// Letters are about twice as high as wide.
const HIGH_OVER_WIDE: f64 = 2.0;

fn main() -> Result<(), Box<dyn Error>> {
    let rows: usize = match std::env::args().nth(1) {
        Some(text) => text.parse()?,
        None => 24,
    };
    let disc = Ball::new([-0.9, 0.0], 0.6)?;
    let star = Outline::starfish([0.9, 0.0], 0.6, 0.25, 5)?;
    let bodies: [&dyn Surface<2>; 2] = [&disc, &star];

    // The box from (−2, −1) to (2, 1).
    let step = 2.0 / rows as f64;
    let columns = (2.0 * HIGH_OVER_WIDE * rows as f64).round() as usize;
    let points: Vec<[f64; 2]> = (0..rows * columns)
        .map(|n| {
            let (row, column) = ((n / columns) as f64, (n % columns) as f64);
            let x = -2.0 + step / HIGH_OVER_WIDE * (column + 0.5);
            [x, 1.0 - step * (row + 0.5)]
        })
        .collect();
    let labels = separate(&points, &bodies)?;

    let letters: Vec<char> = (labels.body.iter())
        .map(|body| match body {
            Some(0) => 'o',
            Some(_) => '*',
            None => '.',
        })
        .collect();
    for row in letters.chunks(columns) {
        println!("{}", row.iter().collect::<String>());
    }
    // Faster for many points: those within two steps of a surface are asked about, the others take the label of a
    // neighbour. No point is known to sit on a surface.
    let on_surface = vec![None; points.len()];
    if labels != separate_by_flood(&points, &on_surface, &bodies, 2.0 * step)? {
        return Err("asking about a layer of points gives other labels".into());
    }
    Ok(())
}
