//! Is a point inside a loop? Three classical answers, O(n) each; [`Surface::inside`](crate::Surface::inside) is the
//! fast one.

use sphpack_neighbors::point;

use crate::segment::{cross, side_of};

/// The sum of the signed angles that the sides of the loop subtend at `p`, radians: 2π inside a counter-clockwise
/// loop, −2π inside a clockwise one, 0 outside; inside where the sum exceeds π (Negi & Ramachandran's
/// preprint, eq. 14). O(n) with an arc tangent per side; a point on the loop gives something between.
pub fn angle_sum(points: &[[f64; 2]], p: [f64; 2]) -> f64 {
    let mut sum = 0.0;
    for (i, &a) in points.iter().enumerate() {
        let (a, b) = (
            point::sub(a, p),
            point::sub(points[(i + 1) % points.len()], p),
        );
        sum += cross(a, b).atan2(point::dot(a, b));
    }
    sum
}

/// How many times the loop winds around `p` counter-clockwise. O(n), no divisions or angles.
pub fn winding_number(points: &[[f64; 2]], p: [f64; 2]) -> i64 {
    let mut turns = 0;
    for (i, &a) in points.iter().enumerate() {
        let b = points[(i + 1) % points.len()];
        if a[1] <= p[1] {
            if b[1] > p[1] && side_of(a, b, p) > 0.0 {
                turns += 1;
            }
        } else if b[1] <= p[1] && side_of(a, b, p) < 0.0 {
            turns -= 1;
        }
    }
    turns
}

/// How many sides of the loop the ray from `p` in the direction +x crosses: odd inside. O(n).
pub fn crossing_number(points: &[[f64; 2]], p: [f64; 2]) -> usize {
    (0..points.len())
        .filter(|&i| crosses(points[i], points[(i + 1) % points.len()], p))
        .count()
}

/// Whether the ray from `p` in the direction +x crosses the side `ab`, its upper end excluded: then a ray through a
/// vertex counts right.
#[inline]
pub(crate) fn crosses(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> bool {
    if (a[1] <= p[1]) == (b[1] <= p[1]) {
        return false;
    }
    (side_of(a, b, p) > 0.0) == (b[1] > a[1])
}
