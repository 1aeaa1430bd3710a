//! Files of a crate that import each other in a ring: none can be read without all the others.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A module, by the names that lead to it from its crate; none is the crate itself.
type Module = Vec<String>;

/// The pairs that may be: a trait whose default methods are a file of their own.
const ALLOWED: [[&str; 2]; 1] = [["sample", "surface"]];

/// The rings among a crate's files, each as the names of its modules. `files` have paths from the crate's `src` on; tests are
/// left out. Only paths that are written from `crate`, `self` or `super` on count, and re-exports lead to where a name is from.
pub(super) fn rings(files: &[(String, String)]) -> Vec<Vec<String>> {
    let texts: BTreeMap<Module, String> = (files.iter())
        .filter(|(path, _)| !path.contains("tests"))
        .map(|(path, text)| (module_of(path), code(text)))
        .collect();
    let mut exported: BTreeMap<(Module, String), Module> = BTreeMap::new();
    for (module, text) in &texts {
        for (is_public, path) in uses(text) {
            let from = from_root(module, &path);
            if let (true, Some((name, from))) = (is_public, from.split_last())
                && texts.contains_key(from)
            {
                exported.insert((module.clone(), name.clone()), from.to_vec());
            }
        }
    }
    let mut edges: BTreeMap<&Module, BTreeSet<Module>> = BTreeMap::new();
    for (module, text) in &texts {
        let to = edges.entry(module).or_default();
        let inline = inline_paths(text);
        for path in uses(text).into_iter().map(|(_, path)| path).chain(inline) {
            if !matches!(path[0].as_str(), "crate" | "self" | "super") {
                continue;
            }
            let target = home(from_root(module, &path), &texts, &exported);
            if !target.is_empty() && target != *module {
                to.insert(target);
            }
        }
    }
    // Whoever reaches itself is in a ring with all that it reaches, and that reach it.
    let reached: BTreeMap<&Module, BTreeSet<Module>> = (edges.keys())
        .map(|module| (*module, reach(module, &edges)))
        .collect();
    let mut found: BTreeSet<Vec<String>> = BTreeSet::new();
    for (module, all) in &reached {
        if all.contains(*module) {
            let ring = all.iter().filter(|other| {
                reached
                    .get(other)
                    .is_some_and(|theirs| theirs.contains(*module))
            });
            found.insert(ring.map(|module| module.join("/")).collect());
        }
    }
    found
        .into_iter()
        .filter(|ring| !ALLOWED.iter().any(|pair| ring == pair))
        .collect()
}

fn reach(from: &Module, edges: &BTreeMap<&Module, BTreeSet<Module>>) -> BTreeSet<Module> {
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(module) = open.pop() {
        for next in edges.get(module).into_iter().flatten() {
            if reached.insert(next.clone()) {
                open.push(next);
            }
        }
    }
    reached
}

/// The file that a path leads to, behind re-exports.
fn home(
    path: Module,
    texts: &BTreeMap<Module, String>,
    exported: &BTreeMap<(Module, String), Module>,
) -> Module {
    let mut end = path.len();
    while !texts.contains_key(&path[..end]) && end > 0 {
        end -= 1;
    }
    let mut module = path[..end].to_vec();
    let Some(name) = path.get(end) else {
        return module;
    };
    // A name may be exported again and again, but not for ever.
    for _ in 0..8 {
        match exported.get(&(module.clone(), name.clone())) {
            Some(from) if *from != module => module = from.clone(),
            _ => break,
        }
    }
    module
}

fn module_of(path: &str) -> Module {
    let mut names: Module = (Path::new(path).with_extension("").iter())
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    names.pop_if(|last| ["mod", "lib", "main"].contains(&last.as_str()));
    names
}

/// The text without comments, and without the tests at its end.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or("");
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

/// The path from the crate's root on; names of other crates stay as they are.
fn from_root(module: &Module, path: &[String]) -> Module {
    let mut from = module.clone();
    let mut names = path.iter().peekable();
    if names.next_if(|name| *name == "crate").is_some() {
        from.clear();
    }
    while let Some(name) = names.next_if(|name| ["self", "super"].contains(&name.as_str())) {
        if name == "super" {
            from.pop();
        }
    }
    from.extend(names.cloned());
    from
}

/// Every path that is used, and whether it is exported again.
fn uses(text: &str) -> Vec<(bool, Module)> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find("use ") {
        let before = rest[..at].rsplit('\n').next().unwrap_or("").trim();
        rest = &rest[at + 4..];
        if !(before.is_empty() || before.starts_with("pub")) {
            continue;
        }
        let Some(end) = rest.find(';') else { break };
        let mut paths = Vec::new();
        expand(&[], &rest[..end], &mut paths);
        found.extend(paths.into_iter().map(|path| (!before.is_empty(), path)));
        rest = &rest[end..];
    }
    found
}

/// The paths of a tree of names.
fn expand(before: &[String], tree: &str, paths: &mut Vec<Module>) {
    let tree = tree.trim();
    let (head, inner) = match tree.split_once('{') {
        Some((head, inner)) => (head, inner.strip_suffix('}')),
        None => (tree, None),
    };
    let head = head.split(" as ").next().unwrap_or("");
    let mut path = before.to_vec();
    path.extend(
        (head.split("::").map(str::trim))
            .filter(|name| !name.is_empty())
            .map(str::to_owned),
    );
    let Some(inner) = inner else {
        if !path.is_empty() {
            paths.push(path);
        }
        return;
    };
    let (mut depth, mut start) = (0, 0);
    for (at, letter) in inner.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                expand(&path, &inner[start..at], paths);
                start = at + 1;
            }
            _ => {}
        }
    }
    if !inner[start..].trim().is_empty() {
        expand(&path, &inner[start..], paths);
    }
}

/// Paths that are written out where they are needed.
fn inline_paths(text: &str) -> Vec<Module> {
    let mut found = Vec::new();
    for start in ["crate::", "super::"] {
        for (at, _) in text.match_indices(start) {
            let is_name = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == ':';
            if text[..at].ends_with(is_name) {
                continue;
            }
            let end = text[at..].find(|letter| !is_name(letter));
            let path = &text[at..end.map_or(text.len(), |end| at + end)];
            let names = path.split("::").filter(|name| !name.is_empty());
            found.push(names.map(str::to_owned).collect());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<Vec<String>> {
        let files: Vec<(String, String)> = (files.iter())
            .map(|(path, text)| ((*path).to_owned(), (*text).to_owned()))
            .collect();
        rings(&files)
    }

    #[test]
    fn rings_are_found_however_they_are_written() {
        let none = [
            ("lib.rs", "mod a;\nmod b;\npub use a::One;"),
            ("a.rs", "use crate::b::{self, Two};\npub struct One;"),
            (
                "b.rs",
                "// use crate::a::One;\npub struct Two;\n#[cfg(test)]\nmod tests {\n    use crate::a::One;\n}",
            ),
        ];
        assert!(found(&none).is_empty());
        for back in [
            "use crate::a::One;",
            "use super::{\n    a::{One, Three},\n    c,\n};",
            "use crate::One;",
            "fn f() -> crate::a::One { todo() }",
            "pub(crate) use super::a::One;",
        ] {
            let mut ring = none;
            ring[2].1 = back;
            assert_eq!(found(&ring), [["a", "b"]], "{back}");
        }
        // Of three, and of a folder with what is in it.
        let three = [
            ("a/mod.rs", "mod inner;\nuse crate::b::Two;"),
            ("b.rs", "use crate::c::Three;"),
            ("c.rs", "use crate::a::inner::Four;"),
            ("a/inner.rs", "use super::One;"),
        ];
        assert_eq!(found(&three), [["a", "a/inner", "b", "c"]]);
        assert_eq!(
            found(&[
                ("sample.rs", "use crate::surface::Surface;"),
                ("surface.rs", "use crate::sample::even;")
            ]),
            Vec::<Vec<String>>::new()
        );
    }
}
