//! The nearest point of a triangle, and where a ray meets it.

use sphpack_neighbors::point;

/// The part of a triangle a point is nearest to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    Face,
    /// Side `k`, from corner `k` to the next.
    Side(usize),
    Corner(usize),
}

/// Weights of the corners at the point of the triangle nearest to `p`, and the part it lies on.
///
/// The plane is divided into the regions of the corners, sides and face by scalar products with the sides
/// (Ericson, Real-Time Collision Detection, section 5.1.5).
#[inline]
pub(crate) fn nearest(t: &[[f64; 3]; 3], p: [f64; 3]) -> ([f64; 3], Part) {
    let [a, b, c] = *t;
    let (ab, ac) = (point::sub(b, a), point::sub(c, a));
    let ap = point::sub(p, a);
    let (a1, a2) = (point::dot(ab, ap), point::dot(ac, ap));
    if a1 <= 0.0 && a2 <= 0.0 {
        return ([1.0, 0.0, 0.0], Part::Corner(0));
    }
    let bp = point::sub(p, b);
    let (b1, b2) = (point::dot(ab, bp), point::dot(ac, bp));
    if b1 >= 0.0 && b2 <= b1 {
        return ([0.0, 1.0, 0.0], Part::Corner(1));
    }
    let cp = point::sub(p, c);
    let (c1, c2) = (point::dot(ab, cp), point::dot(ac, cp));
    if c2 >= 0.0 && c1 <= c2 {
        return ([0.0, 0.0, 1.0], Part::Corner(2));
    }
    let of_c = a1 * b2 - b1 * a2;
    if of_c <= 0.0 && a1 >= 0.0 && b1 <= 0.0 {
        let s = a1 / (a1 - b1);
        return ([1.0 - s, s, 0.0], Part::Side(0));
    }
    let of_b = c1 * a2 - a1 * c2;
    if of_b <= 0.0 && a2 >= 0.0 && c2 <= 0.0 {
        let s = a2 / (a2 - c2);
        return ([1.0 - s, 0.0, s], Part::Side(2));
    }
    let of_a = b1 * c2 - c1 * b2;
    let (along, back) = (b2 - b1, c1 - c2);
    if of_a <= 0.0 && along >= 0.0 && back >= 0.0 {
        let s = along / (along + back);
        return ([0.0, 1.0 - s, s], Part::Side(1));
    }
    let scale = 1.0 / (of_a + of_b + of_c);
    let (v, w) = (of_b * scale, of_c * scale);
    ([1.0 - v - w, v, w], Part::Face)
}

/// The point with these weights.
#[inline(always)]
pub(crate) fn place(t: &[[f64; 3]; 3], weights: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| weights[0] * t[0][k] + weights[1] * t[1][k] + weights[2] * t[2][k])
}

/// Twice the area along the normal.
pub(crate) fn area_vector(t: &[[f64; 3]; 3]) -> [f64; 3] {
    point::cross(point::sub(t[1], t[0]), point::sub(t[2], t[0]))
}

/// Area.
pub(crate) fn area(t: &[[f64; 3]; 3]) -> f64 {
    0.5 * point::norm(area_vector(t))
}

/// Interior angle at corner `k`, radians.
pub(crate) fn angle(t: &[[f64; 3]; 3], k: usize) -> f64 {
    let (u, v) = (
        point::sub(t[(k + 1) % 3], t[k]),
        point::sub(t[(k + 2) % 3], t[k]),
    );
    point::norm(point::cross(u, v)).atan2(point::dot(u, v))
}

/// How a ray meets a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meeting {
    Miss,
    Hit,
    /// Too near a side, or too nearly along the plane, to tell.
    Unclear,
}

/// Weights nearer to zero than this make a hit unclear.
const UNCLEAR: f64 = 1e-9;

/// Whether the ray `origin + t direction`, t ≥ 0, meets the triangle (Möller and Trumbore's solution of the 3×3
/// system).
pub(crate) fn meet(t: &[[f64; 3]; 3], origin: [f64; 3], direction: [f64; 3]) -> Meeting {
    let (ab, ac) = (point::sub(t[1], t[0]), point::sub(t[2], t[0]));
    let across = point::cross(direction, ac);
    let determinant = point::dot(ab, across);
    let from = point::sub(origin, t[0]);
    let size = point::norm(ab) * point::norm(ac) * point::norm(direction);
    if determinant.abs() <= 1e-12 * size {
        // Along the plane: harmless unless it is the ray's own plane.
        let normal = point::cross(ab, ac);
        let height = point::dot(from, normal).abs();
        let reach = point::norm(normal) * (point::norm(from) + point::norm(ab) + point::norm(ac));
        return if height > 1e-9 * reach {
            Meeting::Miss
        } else {
            Meeting::Unclear
        };
    }
    let u = point::dot(from, across) / determinant;
    let turned = point::cross(from, ab);
    let v = point::dot(direction, turned) / determinant;
    let along = point::dot(ac, turned) / determinant;
    let least = u.min(v).min(1.0 - u - v);
    if least < -UNCLEAR || along < 0.0 {
        Meeting::Miss
    } else if least > UNCLEAR {
        Meeting::Hit
    } else {
        Meeting::Unclear
    }
}
