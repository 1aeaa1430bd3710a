//! Slips of the pen that leave a text no TOML at all: brackets, quotes and marks that are missing.

use super::parser_words::parser_words;
use super::wrong::Wrong;

/// Keys that hold a list, as a person would write one.
const LISTS: [&str; 13] = [
    "min",
    "max",
    "center",
    "semi_axes",
    "points",
    "start",
    "end",
    "axis",
    "translate",
    "gravity",
    "capture",
    "periodic",
    "include",
];

/// Whether a key holds a list.
pub(super) fn is_list(key: &str) -> bool {
    LISTS.contains(&key)
}

/// What a parser of TOML refuses: the slip where it is a common one, else the parser's words.
pub(super) fn explained(text: &str, error: &toml::de::Error) -> Wrong {
    let at = error.span();
    let slip = at.as_ref().and_then(|at| in_line(text, at.start));
    Wrong {
        message: slip.unwrap_or_else(|| parser_words(error.message())),
        at,
    }
}

/// The slip in the line of a byte, in what is the last value to begin before that byte.
fn in_line(text: &str, byte: usize) -> Option<String> {
    let start = text.get(..byte)?.rfind('\n').map_or(0, |end| end + 1);
    let line = text.get(start..)?.lines().next()?;
    let before = line.get(..byte - start).unwrap_or(line);
    // A parser that stops at the mark itself has not come to the value.
    let equals = before.rfind('=').or_else(|| {
        let begins = line[before.len()..].trim_start().starts_with('=');
        begins.then(|| line.find('=')).flatten()
    });
    let Some(equals) = equals else {
        return colon(line);
    };
    let key = last_word(&line[..equals])?;
    slip(key, line[equals + 1..].trim_start())
}

/// `spacing: 0.1`, as other formats have it.
fn colon(line: &str) -> Option<String> {
    let (key, value) = line.split_once(':')?;
    let (key, value) = (key.trim().trim_matches('"'), value.trim());
    let is_key = !key.is_empty() && key.chars().all(is_of_key);
    let value = value.trim_end_matches(',');
    is_key.then(|| format!("a key and its value have = between them: {key} = {value}"))
}

fn is_of_key(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_' || c == '-'
}

fn last_word(before: &str) -> Option<&str> {
    let before = before.trim_end();
    let word = &before[before.trim_end_matches(is_of_key).len()..];
    (!word.is_empty()).then_some(word)
}

/// What is wrong with the value of a key; `value` goes on to the end of the line.
fn slip(key: &str, value: &str) -> Option<String> {
    let unbracketed = value.trim_start_matches(['(', '{']);
    let numbers = numbers(unbracketed);
    if numbers.len() > 1 {
        let is_pair = value.starts_with(&format!("{},{}", numbers[0], numbers[1]));
        if !is_list(key) && numbers.len() == 2 && is_pair {
            let [whole, part] = [numbers[0], numbers[1]];
            return Some(format!(
                "a number is written with a point: {key} = {whole}.{part}"
            ));
        }
        let list = numbers.join(", ");
        return Some(format!("a list is written in brackets: {key} = [{list}]"));
    }
    let end = value.find(|c: char| c.is_whitespace() || ",]}#".contains(c));
    let word = &value[..end.unwrap_or(value.len())];
    let begins = word.chars().next()?;
    match word {
        "True" | "TRUE" | "yes" | "on" => return Some(format!("write {key} = true")),
        "False" | "FALSE" | "no" | "off" => return Some(format!("write {key} = false")),
        _ => {}
    }
    if begins.is_alphabetic() || begins == '/' || word.starts_with("./") || word.starts_with("../")
    {
        return Some(format!("text is written in quotes: {key} = \"{word}\""));
    }
    let digits = word.trim_start_matches(['+', '-']);
    let number: f64 = word
        .parse()
        .ok()
        .filter(|x: &f64| x.is_finite())
        .or_else(|| {
            let unit = digits.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
            let is_unit = !unit.is_empty() && unit.chars().all(char::is_alphabetic);
            let number = &word[..word.len() - unit.len()];
            number.parse().ok().filter(|_| is_unit)
        })?;
    if word.ends_with(char::is_alphabetic) {
        return Some(format!(
            "a number has no unit here; lengths are in the scene's one unit: {key} = {number}"
        ));
    }
    if key == "digits" {
        return Some(format!("digits are written in quotes: {key} = \"{word}\""));
    }
    let has_zeros =
        digits.starts_with('0') && digits[1..].starts_with(|c: char| c.is_ascii_digit());
    let is_toml = !digits.starts_with('.') && !digits.ends_with('.') && !has_zeros;
    (!is_toml).then(|| {
        format!("a number has digits before and after its point and no zeros before them: {key} = {number:?}")
    })
}

/// The numbers that a text begins with, parted by commas, semicolons or spaces.
fn numbers(text: &str) -> Vec<&str> {
    let mut rest = text.trim_start();
    let mut found = Vec::new();
    loop {
        let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)));
        let word = &rest[..end.unwrap_or(rest.len())];
        if word.parse::<f64>().is_err() {
            return found;
        }
        found.push(word);
        rest = rest[word.len()..].trim_start_matches([',', ';', ' ', '\t']);
    }
}

/// The numbers that a whole text is, in whatever brackets.
pub(super) fn all_numbers(text: &str) -> Option<String> {
    let inner = text.trim().trim_matches(|c| "[](){}".contains(c));
    let found = numbers(inner);
    let length: usize = found.iter().map(|word| word.len()).sum();
    let marks = inner.chars().filter(|c| ",; \t".contains(*c)).count();
    (!found.is_empty() && length + marks == inner.len()).then(|| found.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_told() {
        let of = |text: &str| {
            let error = toml::de::DeTable::parse(text).expect_err(text);
            explained(text, &error).message
        };
        for (text, words) in [
            ("center = 0,1", "in brackets: center = [0, 1]"),
            (
                "a = 1\ncenter = 0, 1, 2 # x",
                "in brackets: center = [0, 1, 2]",
            ),
            ("min = -2.0 -2.0", "in brackets: min = [-2.0, -2.0]"),
            ("max = (1, 2)", "in brackets: max = [1, 2]"),
            ("max = {1, 2}", "in brackets: max = [1, 2]"),
            (
                "shape = { circle = { center = 0,1, radius = 1.0 } }",
                "in brackets: center = [0, 1]",
            ),
            (
                "shape = { circle = { radius = 1.0, center = 0,1 } }",
                "in brackets: center = [0, 1]",
            ),
            ("spacing = 0,1", "with a point: spacing = 0.1"),
            (
                "spacing = .1",
                "before and after its point and no zeros before them: spacing = 0.1",
            ),
            ("spacing = 1.", "spacing = 1.0"),
            ("spacing = 2mm", "has no unit here"),
            ("spacing: 0.1", "= between them: spacing = 0.1"),
            ("role = solid", "in quotes: role = \"solid\""),
            (
                "shape = { file = body.stl }",
                "in quotes: file = \"body.stl\"",
            ),
            (
                "shape = { file = ../body.stl }",
                "in quotes: file = \"../body.stl\"",
            ),
            ("fill = False", "write fill = false"),
            ("digits = 0015", "in quotes: digits = \"0015\""),
        ] {
            assert!(of(text).contains(words), "{text}: {}", of(text));
        }
        // What is no slip that is known keeps the parser's words.
        for text in ["[domain", "spacing =", "a = \"b", "=", "\u{e9} = 1"] {
            assert!(!of(text).is_empty(), "{text}");
        }
    }

    #[test]
    fn lists_in_any_brackets() {
        assert_eq!(all_numbers("0,1").as_deref(), Some("0, 1"));
        assert_eq!(all_numbers(" [0 -1e3]").as_deref(), Some("0, -1e3"));
        assert_eq!(all_numbers("0,x"), None);
        assert_eq!(all_numbers(""), None);
    }
}
