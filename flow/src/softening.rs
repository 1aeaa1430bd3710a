//! What keeps quotients by r² finite.

/// ε in r² + ε: 0.01 h².
pub(crate) fn softening(smoothing_length: f64) -> f64 {
    0.01 * smoothing_length * smoothing_length
}
