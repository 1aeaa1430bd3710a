//! Which keys are one table, and which a list of them.

use toml::de::{DeTable, DeValue};

use super::document::Document;
use super::wrong::Wrong;

/// Lists of tables: a head in double brackets begins one more.
const LISTS: [&[&str]; 2] = [&["body"], &["refinement", "region"]];

/// Single tables.
const SINGLE: [&[&str]; 10] = [
    &["domain"],
    &["refinement"],
    &["fluid"],
    &["fluid", "hydrostatic"],
    &["packing"],
    &["packing", "hybrid"],
    &["packing", "agitated"],
    &["quality"],
    &["output"],
    &["output", "surroundings"],
];

/// Refuses a single table where a list of them stands, and the other way round.
pub(super) fn check(document: &Document<'_>, text: &str) -> Result<(), Wrong> {
    let lists = LISTS.into_iter().map(|path| (path, true));
    for (path, is_list) in lists.chain(SINGLE.into_iter().map(|path| (path, false))) {
        let Some((value, at)) = found(&document.table, path) else {
            continue;
        };
        if is_list != matches!(value, DeValue::Table(_)) {
            continue;
        }
        let (name, last) = (path.join("."), path[path.len() - 1]);
        let head = if is_list { "[" } else { "[[" };
        let is_head = (text.get(at.clone())).is_some_and(|text| text.starts_with(head));
        let message = match (is_list, is_head) {
            (true, true) => format!("there may be several: write [[{name}]] instead of [{name}]"),
            (true, false) => format!(
                "{name} is a list of tables; put it in brackets, as one for each: {last} = [{{ … }}]"
            ),
            (false, true) => format!("there is only one: write [{name}] instead of [[{name}]]"),
            (false, false) => format!(
                "{name} is a table of keys: write [{name}] and its keys below, or {last} = {{ … }}"
            ),
        };
        return Err(Wrong {
            at: Some(at),
            message,
        });
    }
    Ok(())
}

fn found<'a, 't>(
    table: &'a DeTable<'t>,
    path: &[&str],
) -> Option<(&'a DeValue<'t>, std::ops::Range<usize>)> {
    let (first, rest) = path.split_first()?;
    let value = table.get(*first)?;
    match (rest, value.get_ref()) {
        ([], here) => Some((here, value.span())),
        (rest, DeValue::Table(inner)) => found(inner, rest),
        _ => None,
    }
}
