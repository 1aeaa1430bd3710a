//! Guessing what was meant by a misspelt name.

/// The known name nearest to `name` by edit distance, where it is near enough to be a slip.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted: Vec<char> = name.to_lowercase().chars().take(64).collect();
    known
        .into_iter()
        .map(|candidate| {
            (
                distance(&wanted, &candidate.chars().collect::<Vec<_>>()),
                candidate,
            )
        })
        .filter(|&(steps, candidate)| steps <= 1 + candidate.chars().count().max(wanted.len()) / 3)
        .min_by_key(|&(steps, _)| steps)
        .map(|(_, candidate)| candidate)
}

/// "; did you mean \"spacing\"?" or nothing, and then what there is.
pub(crate) fn advice(name: &str, known: &[&str]) -> String {
    let guess = nearest(name, known.iter().copied())
        .map_or_else(String::new, |near| format!("did you mean \"{near}\"? "));
    format!("{guess}there are {}", known.join(", "))
}

/// Fewest insertions, removals, replacements and swaps of neighbours that turn `a` into `b`.
fn distance(a: &[char], b: &[char]) -> usize {
    let width = b.len() + 1;
    let mut table = vec![0; (a.len() + 1) * width];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            table[i * width + j] = if i == 0 || j == 0 {
                i + j
            } else {
                let same = usize::from(a[i - 1] != b[j - 1]);
                let mut least = (table[(i - 1) * width + j] + 1)
                    .min(table[i * width + j - 1] + 1)
                    .min(table[(i - 1) * width + j - 1] + same);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    least = least.min(table[(i - 2) * width + j - 2] + 1);
                }
                least
            };
        }
    }
    table[a.len() * width + b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(name: &str, expected: Option<&str>) {
        let known = ["spacing", "domain", "body", "fluid", "packing", "quality"];
        assert_eq!(nearest(name, known), expected);
    }

    #[test]
    fn slips_are_recognised() {
        check("spacng", Some("spacing"));
        check("sapcing", Some("spacing"));
        check("Domain", Some("domain"));
        check("bodies", Some("body"));
        check("packng", Some("packing"));
        check("xyzzy", None);
        check("", None);
    }

    #[test]
    fn distances() {
        let count = |a: &str, b: &str| {
            distance(
                &a.chars().collect::<Vec<_>>(),
                &b.chars().collect::<Vec<_>>(),
            )
        };
        assert_eq!(count("", "abc"), 3);
        assert_eq!(count("kitten", "sitting"), 3);
        assert_eq!(count("ab", "ba"), 1);
    }
}
