//! Arithmetic on points and vectors, which are plain arrays `[f64; D]`.

/// The first `D` of `values`, zero where there are fewer: from what a file holds, or from a plane to space.
///
/// ```
/// use sphpack_neighbors::point;
/// assert_eq!(point::of_slice::<3>(&[1.0, 2.0]), [1.0, 2.0, 0.0]);
/// assert_eq!(point::of_slice::<2>(&[1.0, 2.0, 3.0]), [1.0, 2.0]);
/// ```
#[inline]
pub fn of_slice<const D: usize>(values: &[f64]) -> [f64; D] {
    std::array::from_fn(|k| values.get(k).copied().unwrap_or(0.0))
}

/// `a + b`.
#[inline(always)]
pub fn add<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] + b[k])
}

/// `a − b`.
#[inline(always)]
pub fn sub<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// `s a`.
#[inline(always)]
pub fn scale<const D: usize>(a: [f64; D], s: f64) -> [f64; D] {
    std::array::from_fn(|k| s * a[k])
}

/// `a + s b`.
#[inline(always)]
pub fn add_scaled<const D: usize>(a: [f64; D], s: f64, b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] + s * b[k])
}

/// Scalar product.
#[inline(always)]
pub fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    let mut sum = 0.0;
    for k in 0..D {
        sum += a[k] * b[k];
    }
    sum
}

/// Squared length.
#[inline(always)]
pub fn norm_squared<const D: usize>(a: [f64; D]) -> f64 {
    dot(a, a)
}

/// Length.
#[inline(always)]
pub fn norm<const D: usize>(a: [f64; D]) -> f64 {
    norm_squared(a).sqrt()
}

/// Squared distance between two points.
#[inline(always)]
pub fn distance_squared<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    norm_squared(sub(a, b))
}

/// Distance between two points.
#[inline(always)]
pub fn distance<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    distance_squared(a, b).sqrt()
}

/// The vector of length one along `a`; `None` where `a` has no direction (zero, or not finite).
#[inline]
pub fn unit<const D: usize>(a: [f64; D]) -> Option<[f64; D]> {
    let length = norm(a);
    (length > 0.0 && length.is_finite()).then(|| scale(a, 1.0 / length))
}

/// The part of `a` that is perpendicular to the unit vector `n`.
#[inline(always)]
pub fn reject<const D: usize>(a: [f64; D], n: [f64; D]) -> [f64; D] {
    add_scaled(a, -dot(a, n), n)
}

/// Vector product in 3-D.
#[inline(always)]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Whether every coordinate is a finite number.
#[inline]
pub fn is_finite<const D: usize>(a: [f64; D]) -> bool {
    a.iter().all(|x| x.is_finite())
}
