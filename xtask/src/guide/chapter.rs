//! A chapter of the guide: files, commands and what they must say, in its fenced blocks.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::python::Built;

/// A fenced block.
#[derive(Debug, PartialEq)]
struct Block<'a> {
    /// The word after the fence.
    language: &'a str,
    text: String,
    /// The line of its fence, from 1.
    line: usize,
}

fn blocks(chapter: &str) -> Result<Vec<Block<'_>>, String> {
    let mut all: Vec<Block<'_>> = Vec::new();
    let mut is_open = false;
    for (n, line) in chapter.lines().enumerate() {
        match (line.strip_prefix("```"), is_open) {
            (Some(""), true) => is_open = false,
            (Some(language), false) if !language.is_empty() => {
                is_open = true;
                let (text, line) = (String::new(), n + 1);
                all.push(Block {
                    language,
                    text,
                    line,
                });
            }
            (Some(_), _) => return Err(format!("line {}: a fence that opens none", n + 1)),
            (None, true) => {
                if let Some(block) = all.last_mut() {
                    block.text.push_str(line);
                    block.text.push('\n');
                }
            }
            (None, false) => {}
        }
    }
    match (is_open, all.last()) {
        (true, Some(block)) => Err(format!("line {}: a fence that is never closed", block.line)),
        _ => Ok(all),
    }
}

/// Does what the blocks of a chapter say. A file begins with its name in a comment and is written as it stands; lines of `sh` are
/// commands, which must end with 0, or with the status in their comment; lines of `text` must be in what the command before them
/// said; `python` is run where the package is built; `console` is for the reader alone.
pub(super) fn run(
    chapter: &str,
    folder: &Path,
    program: &Path,
    python: Option<&Built>,
) -> Result<(), String> {
    let mut said = String::new();
    for block in blocks(chapter)? {
        let done = match block.language {
            "sh" => commands(&block.text, folder, program).map(|answer| said = answer),
            "text" => (block.text.lines()).try_for_each(|line| has(&said, line)),
            "python" => python.map_or(Ok(()), |built| script(&block.text, folder, built)),
            "console" => Ok(()),
            "toml" | "csv" | "obj" => file(&block.text, folder),
            other => Err(format!("nobody knows what to do with {other:?}")),
        };
        done.map_err(|message| format!("line {}: {message}", block.line))?;
    }
    Ok(())
}

fn has(said: &str, line: &str) -> Result<(), String> {
    (said.contains(line.trim()))
        .then_some(())
        .ok_or_else(|| format!("{line:?} is not in\n{said}"))
}

/// Writes a block that begins with `# NAME`.
fn file(text: &str, folder: &Path) -> Result<(), String> {
    let name = (text.lines().next())
        .and_then(|line| line.strip_prefix("# "))
        .filter(|name| !name.contains(['/', '\\', ' ']))
        .ok_or("the first line is no comment with the file's name")?;
    fs::write(folder.join(name), text).map_err(|error| format!("{name}: {error}"))
}

/// Runs each line; what the last one has said.
fn commands(text: &str, folder: &Path, program: &Path) -> Result<String, String> {
    let mut said = String::new();
    for line in text.lines() {
        let (command, status) = match line.split_once(" # exit status ") {
            Some((command, status)) => (
                command,
                status
                    .parse()
                    .map_err(|_| format!("{status:?} is no exit status"))?,
            ),
            None => (line, 0),
        };
        let words = (command.strip_prefix("sphpack "))
            .ok_or_else(|| format!("{command:?} is no command of ours"))?;
        let answer = Command::new(program)
            .args(words.split_whitespace())
            .current_dir(folder)
            .output()
            .map_err(|error| format!("{}: {error}", program.display()))?;
        said = [answer.stdout, answer.stderr]
            .map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
            .concat();
        if answer.status.code() != Some(status) {
            return Err(format!("{command:?} ends with {}\n{said}", answer.status));
        }
    }
    Ok(said)
}

fn script(text: &str, folder: &Path, built: &Built) -> Result<(), String> {
    let answer = Command::new(&built.python)
        .args(["-c", text])
        .env("PYTHONPATH", &built.site)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .current_dir(folder)
        .output()
        .map_err(|error| format!("{}: {error}", built.python.display()))?;
    let words = String::from_utf8_lossy(&answer.stderr);
    (answer.status.success())
        .then_some(())
        .ok_or_else(|| format!("the script fails: {words}"))
}

/// Where the links of a page go, without the places in the pages.
pub(super) fn links(page: &str) -> Vec<String> {
    (page.split("](").skip(1))
        .filter_map(|rest| rest.split([')', '#']).next())
        .map(str::to_owned)
        .collect()
}

/// The keys of a scene, those in comments too.
pub(super) fn keys(scene: &str) -> Vec<String> {
    let mut all: Vec<String> = (scene.lines())
        .filter_map(|line| {
            let line = line.strip_prefix("# ").unwrap_or(line);
            let (key, _) = line.split_once(" = ")?;
            let is_key = |c: char| c.is_ascii_lowercase() || c == '_' || c == '.';
            key.chars().all(is_key).then(|| key.to_owned())
        })
        .collect();
    all.sort();
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::{Block, blocks, file, has, keys, links};

    #[test]
    fn blocks_have_languages_and_lines() {
        let page = "a\n```sh\none\ntwo\n```\nb\n```toml\n# x.toml\n```\n";
        let block = |language, text: &str, line| Block {
            language,
            text: text.to_owned(),
            line,
        };
        assert_eq!(
            blocks(page).unwrap(),
            [block("sh", "one\ntwo\n", 2), block("toml", "# x.toml\n", 7)]
        );
        for (page, message) in [
            ("a\n```\n", "line 2: a fence that opens none"),
            ("```sh\na\n```sh\n", "line 3: a fence that opens none"),
            ("```sh\na\n", "line 1: a fence that is never closed"),
        ] {
            assert_eq!(blocks(page).unwrap_err(), message);
        }
    }

    #[test]
    fn keys_are_those_of_lines_and_comments() {
        let scene = "a = 1 # b = 2\n# c_d = 3\n# hybrid.x = 1\n#   e = 4\n# Some words = none\n[t]\na = 2\n";
        assert_eq!(keys(scene), ["a", "c_d", "hybrid.x"]);
    }

    #[test]
    fn links_go_to_pages() {
        assert_eq!(links("[a](b.md) and [c](d.md#e), (f)"), ["b.md", "d.md"]);
    }

    #[test]
    fn files_need_names_and_words_must_be_said() {
        let folder = std::env::temp_dir();
        for text in ["spacing = 1\n", "# ../x\n", "# a b\n", ""] {
            assert!(file(text, &folder).is_err(), "{text:?}");
        }
        assert!(has("one two\nthree", "  two ").is_ok());
        assert!(has("one two\nthree", "four").is_err());
    }
}
