//! A NACA airfoil, moved inward: its corners are resolved, and points are spread evenly over it, the trailing edge first.
//!
//! `cargo run -p sphpack-geometry --example airfoil -- [digits] [points]`. Prints rows "x,y,nx,ny".

use std::error::Error;

use sphpack_geometry::{Outline, Surface};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let digits = arguments.next().unwrap_or_else(|| "0015".to_owned());
    let count: usize = match arguments.next() {
        Some(text) => text.parse()?,
        None => 40,
    };
    let wing = Outline::naca(&digits, 1.0)?;
    // Boundary particles sit half a spacing inside.
    let spacing = wing.measure() / count as f64;
    let inset = wing.inset(0.5 * spacing)?;
    eprintln!(
        "NACA {digits}: length {:.4}, area {:.5}; half of {spacing:.4} inside: {:.4}, {:.5}",
        wing.measure(),
        wing.volume(),
        inset.measure(),
        inset.volume()
    );
    println!("x,y,nx,ny");
    for hit in inset.sample(count)? {
        let ([x, y], [nx, ny]) = (hit.point, hit.normal);
        println!("{x:.6},{y:.6},{nx:.6},{ny:.6}");
    }
    Ok(())
}
