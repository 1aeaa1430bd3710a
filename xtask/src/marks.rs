//! Tables in pages that people write: each between marks of its name.

use std::fs;

use crate::workspace::root;

/// Puts a table between its marks in docs/reliability.md.
pub(crate) fn write(mark: &str, table: &str) -> Result<(), String> {
    let path = root().join("docs/reliability.md");
    let fail = |error| format!("{}: {error}", path.display());
    let old = fs::read_to_string(&path).map_err(fail)?;
    let new = between(&old, mark, table)
        .ok_or_else(|| format!("{} lacks <!-- {mark} --> or its end", path.display()))?;
    fs::write(&path, new).map_err(fail)
}

/// The page with the table in place of what was between the marks.
fn between(page: &str, mark: &str, table: &str) -> Option<String> {
    let (begin, end) = (format!("<!-- {mark} -->"), format!("<!-- /{mark} -->"));
    let (before, rest) = page.split_once(&begin)?;
    let (_, after) = rest.split_once(&end)?;
    let table = table.trim_end();
    Some(format!("{before}{begin}\n{table}\n{end}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_keep_what_is_around_the_table() {
        let page = "a\n<!-- x -->\nold\n<!-- /x -->\nb\n";
        let new = between(page, "x", "new\n").unwrap();
        assert_eq!(new, "a\n<!-- x -->\nnew\n<!-- /x -->\nb\n");
        assert_eq!(between(&new, "x", "new\n").unwrap(), new);
        assert!(between("nothing", "x", "y").is_none());
    }
}
