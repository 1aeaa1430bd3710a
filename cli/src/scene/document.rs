//! A scene's text as a tree of values, each with its place: TOML, or JSON with the same keys.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::Scene;
use super::fault::Key;
use super::wrong::Wrong;
use super::{json, slips};

/// The values of a text.
#[derive(Debug)]
pub(super) struct Document<'t> {
    /// By their keys; what keys mean is not known here.
    pub(super) table: DeTable<'t>,
    /// Of the whole.
    span: Range<usize>,
}

impl<'t> Document<'t> {
    /// Reads JSON where `is_json`, TOML otherwise.
    pub(super) fn read(text: &'t str, is_json: bool) -> Result<Self, Wrong> {
        let table = if is_json {
            json::table(text)?
        } else {
            DeTable::parse(text).map_err(|e| slips::explained(text, &e))?
        };
        Ok(Self {
            span: table.span(),
            table: table.into_inner(),
        })
    }

    /// The scene that it is.
    pub(super) fn scene(self) -> Result<Scene, toml::de::Error> {
        Scene::deserialize(Deserializer::from(Spanned::new(self.span, self.table)))
    }

    /// Where a value stands; the innermost of its keys that can be found.
    pub(super) fn locate(&self, keys: &[Key]) -> Option<Range<usize>> {
        let mut place = None;
        let mut here: Option<&DeValue<'_>> = None;
        for key in keys {
            let found = match (key, here) {
                (Key::Name(name), None) => self.table.get(*name),
                (Key::Name(name), Some(DeValue::Table(inner))) => inner.get(*name),
                (Key::Index(index), Some(DeValue::Array(inner))) => inner.get(*index),
                _ => None,
            };
            let Some(value) = found else { break };
            place = Some(value.span());
            here = Some(value.get_ref());
        }
        place
    }

    /// The keys of a table.
    pub(super) fn keys_of(&self, table: &str) -> Vec<String> {
        match self.table.get(table).map(Spanned::get_ref) {
            Some(DeValue::Table(keys)) => {
                keys.keys().map(|key| key.get_ref().to_string()).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Where the key stands whose value a byte is in; the innermost.
    pub(super) fn key_at(&self, byte: usize) -> Option<Range<usize>> {
        key_in(&self.table, byte)
    }
}

fn key_in(table: &DeTable<'_>, byte: usize) -> Option<Range<usize>> {
    table.iter().find_map(|(key, value)| {
        let inner = match value.get_ref() {
            DeValue::Table(inner) => key_in(inner, byte),
            DeValue::Array(list) => list.iter().find_map(|entry| match entry.get_ref() {
                DeValue::Table(inner) => key_in(inner, byte),
                _ => None,
            }),
            _ => None,
        };
        let is_here = || value.span().contains(&byte);
        inner.or_else(|| is_here().then(|| key.span()))
    })
}
