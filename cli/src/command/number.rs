//! Numbers on the command line.

use std::str::FromStr;

/// A number; what is none is refused with the number that may be meant.
pub(super) fn number(text: &str) -> Result<f64, String> {
    if let Ok(number) = text.trim().parse() {
        return Ok(number);
    }
    let with_point = text.replacen(',', ".", 1);
    if with_point.parse::<f64>().is_ok_and(f64::is_finite) {
        return Err(format!("a number is written with a point: {with_point}"));
    }
    let bare = text.trim_end_matches(char::is_alphabetic);
    if bare.parse::<f64>().is_ok() {
        return Err(format!("it must be a number without a unit: {bare}"));
    }
    Err("it must be a number, such as 0.02".into())
}

/// A whole number, 0 or more.
pub(super) fn whole<T: FromStr>(text: &str) -> Result<T, String> {
    (text.trim().parse()).map_err(|_| "it must be a whole number, such as 4".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_told_how_to_be_one() {
        assert_eq!(number("-1e-3"), Ok(-1e-3));
        for (text, words) in [
            ("abc", "such as 0.02"),
            ("", "such as 0.02"),
            ("0,02", "with a point: 0.02"),
            ("2mm", "without a unit: 2"),
            ("0,1,2", "such as 0.02"),
        ] {
            assert!(number(text).unwrap_err().contains(words), "{text}");
        }
        assert_eq!(whole::<u64>("7"), Ok(7));
        assert!(whole::<u64>("-7").unwrap_err().contains("whole"));
        assert!(whole::<usize>("four").unwrap_err().contains("such as 4"));
    }
}
