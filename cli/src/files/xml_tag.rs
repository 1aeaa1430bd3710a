//! The tags of XML files, one after the other.

use std::collections::BTreeMap;

/// An opening tag: its name and what it says.
pub(super) struct Tag<'a> {
    pub(super) name: &'a str,
    pub(super) attributes: BTreeMap<&'a str, &'a str>,
    /// What follows it.
    pub(super) rest: &'a str,
}

impl<'a> Tag<'a> {
    /// The next tag of `text`.
    pub(super) fn next(text: &'a str) -> Option<Self> {
        let start = text.find('<')? + 1;
        let length = text[start..].find('>')?;
        let inner = text[start..start + length].trim_end_matches('/');
        let (name, mut list) = inner.split_once(char::is_whitespace).unwrap_or((inner, ""));
        let mut attributes = BTreeMap::new();
        while let Some((key, after)) = list.split_once('=') {
            let after = after.trim_start();
            let Some(quote) = after.chars().next().filter(|c| matches!(c, '"' | '\'')) else {
                break;
            };
            let Some((value, more)) = after[1..].split_once(quote) else {
                break;
            };
            attributes.insert(key.trim(), value);
            list = more;
        }
        Some(Self {
            name,
            attributes,
            rest: &text[start + length + 1..],
        })
    }

    /// What it says of `key`; empty where it says nothing.
    pub(super) fn get(&self, key: &str) -> &'a str {
        self.attributes.get(key).copied().unwrap_or("")
    }
}
