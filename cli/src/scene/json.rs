//! Scenes as JSON: the same tree of values as TOML's, each with its place in the text.

use std::borrow::Cow;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::parser_words::TOO_DEEP;
use super::wrong::Wrong;

/// The values of a text in JSON. A key whose value is null is left out, as a report writes it.
pub(super) fn table(text: &str) -> Result<Spanned<DeTable<'_>>, Wrong> {
    // Whether it is JSON at all, and not too deep, is known from here on: what follows need not ask.
    let value: serde_json::Value = serde_json::from_str(text).map_err(|e| refused(text, &e))?;
    if !value.is_object() {
        return Err(Wrong {
            at: Some(0..1),
            message: "a scene in JSON is an object; begin it with { and end it with }".into(),
        });
    }
    let mut reader = Reader { text, at: 0 };
    let value = reader.value()?;
    let span = value.as_ref().map_or(0..0, Spanned::span);
    let table = match value.map(Spanned::into_inner) {
        Some(DeValue::Table(table)) => table,
        _ => DeTable::new(),
    };
    Ok(Spanned::new(span, table))
}

/// The parser's words, without the place that they end with.
fn refused(text: &str, error: &serde_json::Error) -> Wrong {
    let words = error.to_string();
    let words = words
        .rsplit_once(" at line ")
        .map_or(&*words, |(words, _)| words);
    let message = if words.contains("recursion limit") {
        TOO_DEEP.into()
    } else if !text.trim_start().starts_with(['{', '[']) {
        "this is not JSON, which begins with {; give a scene in TOML the ending .toml".into()
    } else {
        format!("this is not JSON: {words}")
    };
    let line_start = (text
        .split_inclusive('\n')
        .take(error.line().saturating_sub(1)))
    .map(str::len)
    .sum::<usize>();
    let byte = (line_start + error.column().saturating_sub(1)).min(text.len());
    Wrong {
        at: Some(byte..byte),
        message,
    }
}

/// Goes through a text that is JSON.
struct Reader<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Reader<'t> {
    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn skip_space(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start_matches([' ', '\t', '\r', '\n']).len();
    }

    /// Goes past a mark, where that comes next.
    fn takes(&mut self, mark: char) -> bool {
        self.skip_space();
        let comes = self.rest().starts_with(mark);
        self.at += usize::from(comes);
        comes
    }

    /// The next value; `None` is null.
    fn value(&mut self) -> Result<Option<Spanned<DeValue<'t>>>, Wrong> {
        self.skip_space();
        let start = self.at;
        let value = match self.rest().chars().next() {
            Some('{') => DeValue::Table(self.object()?),
            Some('[') => DeValue::Array(self.list()?),
            Some('"') => DeValue::String(self.string()),
            _ => {
                let rest = self.rest();
                let end = rest.find([',', ']', '}', ' ', '\t', '\r', '\n']);
                let word = &rest[..end.unwrap_or(rest.len())];
                self.at += word.len();
                match word {
                    "null" => return Ok(None),
                    "true" => DeValue::Boolean(true),
                    "false" => DeValue::Boolean(false),
                    // JSON's numbers are TOML's too.
                    number => (DeValue::parse(number).map(Spanned::into_inner))
                        .map_err(|e| wrong(start..self.at, e.message().to_owned()))?,
                }
            }
        };
        Ok(Some(Spanned::new(start..self.at, value)))
    }

    fn object(&mut self) -> Result<DeTable<'t>, Wrong> {
        let mut table = DeTable::new();
        self.takes('{');
        while !self.takes('}') {
            let start = self.at;
            let key = self.string();
            let span = start..self.at;
            self.takes(':');
            let value = self.value()?;
            self.takes(',');
            let Some(value) = value else { continue };
            if table.contains_key(&*key) {
                let message = format!("the key \"{key}\" stands here twice; keep one");
                return Err(wrong(span, message));
            }
            table.insert(Spanned::new(span, key), value);
        }
        Ok(table)
    }

    fn list(&mut self) -> Result<DeArray<'t>, Wrong> {
        let mut list = DeArray::new();
        self.takes('[');
        while !self.takes(']') {
            let start = self.at;
            let Some(value) = self.value()? else {
                let message = "null stands in a list; write a value, or leave it out".into();
                return Err(wrong(start..self.at, message));
            };
            list.push(value);
            self.takes(',');
        }
        Ok(list)
    }

    fn string(&mut self) -> Cow<'t, str> {
        self.skip_space();
        let rest = self.rest();
        let mut is_escaped = false;
        let end = rest.char_indices().skip(1).find(|&(_, c)| {
            let ends = c == '"' && !is_escaped;
            is_escaped = c == '\\' && !is_escaped;
            ends
        });
        let quoted = &rest[..end.map_or(rest.len(), |(at, _)| at + 1)];
        self.at += quoted.len();
        Cow::Owned(serde_json::from_str(quoted).unwrap_or_default())
    }
}

fn wrong(at: Range<usize>, message: String) -> Wrong {
    Wrong {
        at: Some(at),
        message,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_their_places() {
        let text =
            "{ \"a\" : [1, -2.5e3,\n {\"q\\\"\\u00e4\": \"x\"}], \"none\": null, \"yes\": true }";
        let table = table(text).unwrap().into_inner();
        let mut keys: Vec<&str> = table.keys().map(|key| &**key.get_ref()).collect();
        keys.sort_unstable();
        assert_eq!(keys, ["a", "yes"]);
        let DeValue::Array(list) = table.get("a").unwrap().get_ref() else {
            panic!("no list");
        };
        assert_eq!(&text[list.get(1).unwrap().span()], "-2.5e3");
        assert!(list.first().unwrap().get_ref().is_integer());
        let inner = list.get(2).unwrap().get_ref().as_table().unwrap();
        assert_eq!(inner.get("q\"ä").unwrap().get_ref().as_str(), Some("x"));
    }

    #[test]
    fn what_is_no_scene_is_refused() {
        for (text, at, words) in [
            ("{ \"a\": 1, }", 10, "not JSON: trailing comma"),
            ("[1]", 0, "is an object"),
            ("{\"a\": 1, \"a\": 2}", 9, "\"a\" stands here twice"),
            ("{\"a\": [null]}", 7, "null stands in a list"),
            ("spacing = 1", 0, "the ending .toml"),
            ("", 0, "not JSON"),
        ] {
            let wrong = table(text).unwrap_err();
            assert_eq!(wrong.at.unwrap().start, at, "{text}");
            assert!(wrong.message.contains(words), "{text}: {}", wrong.message);
        }
        let deep = format!("{{\"a\": {}{}}}", "[".repeat(1000), "]".repeat(1000));
        assert_eq!(table(&deep).unwrap_err().message, TOO_DEEP);
    }
}
