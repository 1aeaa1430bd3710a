//! Text from files and command lines as it can be shown: no control characters, no endless values.

/// The most letters of a quoted value that are shown.
const MOST_QUOTED: usize = 60;

/// The most letters of one word: file systems have no longer names, and a few signs may follow.
const MOST_WORD: usize = 258;

/// The most letters of a message.
const MOST: usize = 6000;

/// The text with control characters, and those that turn the direction of text, as escapes.
pub(super) fn visible(text: &str) -> String {
    let is_hidden = |c: char| {
        c.is_control()
            || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let mut all = String::with_capacity(text.len());
    for c in text.chars() {
        if is_hidden(c) {
            all.extend(c.escape_default());
        } else {
            all.push(c);
        }
    }
    all
}

/// A message in one visible line, what is quoted in it shortened. A quotation mark within a value ends it; what follows
/// is shown, up to the length of a long message.
pub(super) fn message(text: &str) -> String {
    let mut all = String::new();
    for (number, part) in text.split('"').enumerate() {
        if number > 0 {
            all.push('"');
        }
        if number % 2 == 1 {
            all += &shortened(part, MOST_QUOTED);
        } else {
            all += part;
        }
    }
    let words = all.split_inclusive([' ', '/', '\\']);
    let word = |word: &str| match word.chars().count() {
        0..=MOST_WORD => word.to_owned(),
        // Its end as well, with what follows a name in a sentence.
        count => {
            let end: String = word.chars().skip(count - 10).collect();
            shortened(word, MOST_QUOTED - 10) + &end
        }
    };
    let words: String = words.map(word).collect();
    visible(&shortened(&words, MOST))
}

/// The beginning of a long text.
fn shortened(text: &str, most: usize) -> String {
    if text.chars().nth(most).is_none() {
        return text.to_owned();
    }
    text.chars().take(most - 1).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_hides_and_nothing_floods() {
        assert_eq!(message("a\u{1b}[31mb\n"), "a\\u{1b}[31mb\\n");
        assert_eq!(visible("öl \u{202e}x"), "öl \\u{202e}x");
        let long = "ä".repeat(1000);
        let said = message(&format!("unknown key \"{long}\"; did you mean \"body\"?"));
        assert!(said.contains(&format!("\"{}…\"; did you mean \"body\"?", "ä".repeat(59))));
        assert_eq!(message(&long.repeat(10)).chars().count(), 60);
        assert_eq!(message(&"so it is ".repeat(1000)).chars().count(), MOST);
        let fits = "x".repeat(60);
        assert_eq!(message(&format!("\"{fits}\"")), format!("\"{fits}\""));
    }
}
