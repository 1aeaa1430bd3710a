//! Times as people read them.

/// A time for people.
pub(super) fn duration(seconds: f64) -> String {
    if seconds < 0.9995e-3 {
        format!("{:.0} µs", 1e6 * seconds)
    } else if seconds < 0.9995 {
        format!("{:.0} ms", 1000.0 * seconds)
    } else if seconds < 99.95 {
        format!("{seconds:.1} s")
    } else if seconds < 5400.0 {
        format!("{:.0} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_read_well() {
        let read = [3.2e-4, 0.0414, 1.04, 12.0, 240.0, 9000.0].map(duration);
        assert_eq!(
            read,
            ["320 µs", "41 ms", "1.0 s", "12.0 s", "4 min", "2.5 h"]
        );
    }
}
