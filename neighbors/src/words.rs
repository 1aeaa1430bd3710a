//! Places and boxes in words, with as many digits as tell their parts apart, wherever they are.

use std::ops::Range;

/// Digits of a length that are shown.
const DIGITS: i32 = 4;

/// Powers of ten that are not written as such.
const FIXED: Range<i32> = -6..15;

/// An edge that is a smaller part of the longest is none: its ends differ by rounding.
const FLAT: f64 = 1e-9;

/// A length: `0.3`.
pub fn length(x: f64) -> String {
    coordinate(x, x.abs())
}

/// A place in something of a size: `(30000.25, 0.5)` in a body of 1.
///
/// ```
/// assert_eq!(sphpack_neighbors::words::place(&[0.1 + 0.2, 30_000.25], 1.0), "(0.3, 30000.25)");
/// ```
pub fn place(point: &[f64], size: f64) -> String {
    in_parentheses(point.iter().map(|&x| coordinate(x, size)))
}

/// A box by its lower and its upper corner: `(0, 30000) to (1, 30001)`.
pub fn corners(min: &[f64], max: &[f64]) -> String {
    let edges = || min.iter().zip(max).map(|(low, high)| high - low);
    let longest = edges().fold(0.0, f64::max);
    let corner = |of: &[f64]| {
        in_parentheses(of.iter().zip(edges()).map(|(&x, edge)| {
            let is_flat = edge <= FLAT * longest;
            coordinate(x, if is_flat { longest } else { edge })
        }))
    };
    format!("{} to {}", corner(min), corner(max))
}

fn in_parentheses(words: impl Iterator<Item = String>) -> String {
    format!("({})", words.collect::<Vec<_>>().join(", "))
}

/// The power of ten that a number begins with; what rounding has made a little smaller than one counts as that.
fn power(x: f64) -> i32 {
    (x.abs().log10() + 1e-9).floor() as i32
}

/// A coordinate of something of a size.
fn coordinate(x: f64, size: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !x.is_finite() {
        return x.to_string();
    }
    // A place without a size has its own.
    let has_size = size > 0.0 && size.is_finite();
    let decimals = DIGITS - 1 - power(if has_size { size } else { x });
    // After the first; no number has more.
    let digits = (decimals + power(x)).min(16);
    let all = if FIXED.contains(&power(x)) {
        format!("{x:.*}", (digits - power(x)).max(0) as usize)
    } else if digits < 0 {
        return "0".into();
    } else {
        format!("{x:.*e}", digits as usize)
    };
    // Zeros at the end go.
    let (number, exponent) = all.split_once('e').unwrap_or((&all, ""));
    let number = if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        number
    };
    match (number, exponent) {
        ("-0" | "0", _) => "0".into(),
        (number, "") => number.to_owned(),
        (number, exponent) => format!("{number}e{exponent}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_told_apart() {
        for (min, max, words) in [
            ([0.0, 0.0], [1.0, 1.0], "(0, 0) to (1, 1)"),
            (
                [30_000.0, -0.5],
                [30_001.0, 0.5],
                "(30000, -0.5) to (30001, 0.5)",
            ),
            (
                [29_999.123_456, 0.1 + 0.2],
                [30_000.123_456, 1.3],
                "(29999.123, 0.3) to (30000.123, 1.3)",
            ),
            ([0.0, 5.0], [1000.0, 5.001], "(0, 5) to (1000, 5.001)"),
            ([2.5, 0.0], [2.5, 30.0], "(2.5, 0) to (2.5, 30)"),
            (
                [1.0, -1e-17],
                [1.000_001, 1e-6],
                "(1, 0) to (1.000001, 0.000001)",
            ),
            ([0.0, 1e-12], [3e-12, 2e-12], "(0, 1e-12) to (3e-12, 2e-12)"),
            (
                [-1e20, 12_345.678],
                [1e20, 123_456.78],
                "(-1e20, 12346) to (1e20, 123457)",
            ),
            (
                [1e9, 0.0],
                [1e9 + 1e-6, 1e-6],
                "(1000000000, 0) to (1000000000.000001, 0.000001)",
            ),
        ] {
            assert_eq!(corners(&min, &max), words);
        }
    }

    #[test]
    fn places_of_any_kind() {
        assert_eq!(place(&[0.123_456, -7.0, 0.0], 0.01), "(0.12346, -7, 0)");
        assert_eq!(
            [0.1 + 0.2, f64::from(0.002_f32), 1e-9, 12_345.678].map(length),
            ["0.3", "0.002", "1e-9", "12346"]
        );
        assert_eq!(place(&[f64::NAN, f64::INFINITY], 1.0), "(NaN, inf)");
        assert_eq!(place(&[1.0 / 3.0, -0.0], 0.0), "(0.3333, 0)");
        assert_eq!(place(&[5e-324, f64::MAX], f64::MAX), "(0, 1.798e308)");
    }
}
