//! The ranges of h/∆s over which something holds, in words.

/// "0.84–0.94, 1.18–1.31" for the runs of numbers at which it holds; a dash where it never does.
pub(super) fn ranges(numbers: &[f64], holds: impl Fn(usize) -> bool) -> String {
    let mut runs: Vec<[f64; 2]> = Vec::new();
    let mut is_open = false;
    for (i, &number) in numbers.iter().enumerate() {
        match (holds(i), runs.last_mut()) {
            (true, Some(last)) if is_open => last[1] = number,
            (true, _) => runs.push([number, number]),
            (false, _) => {}
        }
        is_open = holds(i);
    }
    if runs.is_empty() {
        return "–".to_owned();
    }
    let words: Vec<String> = (runs.iter())
        .map(|[from, to]| {
            if from == to {
                format!("{from:.2}")
            } else {
                format!("{from:.2}–{to:.2}")
            }
        })
        .collect();
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::ranges;

    #[test]
    fn runs_are_found() {
        let numbers = [0.7, 0.8, 0.9, 1.0, 1.1];
        let of = |holds: [bool; 5]| ranges(&numbers, |i| holds[i]);
        assert_eq!(of([false; 5]), "–");
        assert_eq!(of([true; 5]), "0.70–1.10");
        assert_eq!(of([true, true, false, true, false]), "0.70–0.80, 1.00");
        assert_eq!(of([false, false, false, false, true]), "1.10");
    }
}
