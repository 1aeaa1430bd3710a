//! Bodies given by a formula.

mod ball;
mod cuboid;
mod cylinder;
mod ellipsoid;
#[cfg(test)]
mod tests;
mod torus;

pub use ball::Ball;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use ellipsoid::Ellipsoid;
pub use torus::Torus;

use sphpack_neighbors::point;

/// A unit vector perpendicular to the unit vector `axis`.
fn perpendicular(axis: [f64; 3]) -> [f64; 3] {
    let k = (1..3).fold(0, |a, k| if axis[k].abs() < axis[a].abs() { k } else { a });
    let mut e = [0.0; 3];
    e[k] = 1.0;
    point::unit(point::reject(e, axis)).unwrap_or(e)
}
