//! What kind of body a file holds, told from its content rather than its name.

use std::io::Read;
use std::path::Path;

use crate::Error;

/// The kinds of body files that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyFile {
    /// A triangle mesh, 3-D.
    Stl,
    /// Rows of x,y, 2-D.
    Csv,
}

/// As much of a file as is needed to know it.
const HEAD: u64 = 4096;

impl BodyFile {
    /// Looks into a file.
    ///
    /// # Errors
    /// [`Error::Input`] where it cannot be read, or is of a kind that cannot be read.
    pub fn detect(path: &Path) -> Result<Self, Error> {
        let file = crate::files::open(path)?;
        let size = file.metadata().map_or(0, |meta| meta.len());
        let mut head = Vec::new();
        file.take(HEAD)
            .read_to_end(&mut head)
            .map_err(|e| Error::input(path, format!("cannot be read ({e})")))?;
        let ending = path
            .extension()
            .map_or_else(String::new, |e| e.to_string_lossy().to_lowercase());
        let unread = |what: &str, cure: &str| {
            Err(Error::input(
                path,
                format!("{what} files are not read yet; {cure}"),
            ))
        };
        let mesh_cure = "export the body as STL";
        if head.starts_with(b"ply\n") || head.starts_with(b"ply\r\n") {
            return unread("PLY", mesh_cure);
        }
        if is_binary_stl(&head, size) || starts_with_word(&head, "solid") {
            return Ok(Self::Stl);
        }
        match ending.as_str() {
            "ply" => return unread("PLY", mesh_cure),
            "obj" => return unread("OBJ", mesh_cure),
            "dat" => return unread(".dat", "save the outline as rows of x,y in a .csv file"),
            _ => {}
        }
        let text = String::from_utf8_lossy(&head);
        if looks_like_obj(&text) {
            return unread("OBJ", mesh_cure);
        }
        if looks_like_rows(&text) {
            return Ok(Self::Csv);
        }
        match ending.as_str() {
            "stl" => Ok(Self::Stl),
            "csv" => Ok(Self::Csv),
            _ => Err(Error::input(
                path,
                "this is neither an STL mesh (3-D) nor rows of x,y (2-D); export the body as .stl or .csv",
            )),
        }
    }

    /// 2 or 3.
    pub fn dimension(self) -> usize {
        match self {
            Self::Stl => 3,
            Self::Csv => 2,
        }
    }
}

/// Whether the size is the one that the count in the head asks for.
fn is_binary_stl(head: &[u8], size: u64) -> bool {
    let Some(field) = head.get(80..84) else {
        return false;
    };
    let mut count = [0; 4];
    count.copy_from_slice(field);
    let count = u64::from(u32::from_le_bytes(count));
    count > 0 && size == 84 + 50 * count
}

fn starts_with_word(head: &[u8], word: &str) -> bool {
    let start = head
        .iter()
        .position(|b| !b.is_ascii_whitespace())
        .unwrap_or(head.len());
    let rest = &head[start..];
    rest.len() >= word.len()
        && rest[..word.len()].eq_ignore_ascii_case(word.as_bytes())
        && rest.get(word.len()).is_none_or(|b| b.is_ascii_whitespace())
}

fn looks_like_obj(text: &str) -> bool {
    text.lines()
        .map(str::trim)
        .find(|line| !line.is_empty() && !line.starts_with('#'))
        .is_some_and(|line| {
            let mut words = line.split_whitespace();
            matches!(
                words.next(),
                Some("v" | "vn" | "vt" | "o" | "g" | "mtllib" | "usemtl" | "f")
            ) && words.next().is_some()
        })
}

/// Whether the second line at the latest (the first may be a header) is two numbers.
fn looks_like_rows(text: &str) -> bool {
    text.trim_start_matches('\u{feff}')
        .lines()
        .map(|line| line.split('#').next().unwrap_or("").trim())
        .filter(|line| !line.is_empty())
        .take(2)
        .any(|line| {
            let numbers: Vec<bool> = line
                .split(|c: char| c == ',' || c == ';' || c.is_whitespace())
                .filter(|field| !field.is_empty())
                .map(|field| field.parse::<f64>().is_ok())
                .collect();
            numbers.len() == 2 && numbers.iter().all(|&is_number| is_number)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(name: &str, content: &[u8], expected: Result<BodyFile, &str>) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        match (BodyFile::detect(&path), expected) {
            (Ok(kind), Ok(wanted)) => assert_eq!(kind, wanted, "{name}"),
            (Err(error), Err(part)) => {
                let message = error.to_string();
                assert!(
                    message.contains(part) && message.contains(name),
                    "{message}"
                );
            }
            (got, wanted) => panic!("{name}: {got:?}, not {wanted:?}"),
        }
    }

    #[test]
    fn content_decides() {
        let mut binary = vec![b'x'; 84 + 50];
        binary[80..84].copy_from_slice(&1_u32.to_le_bytes());
        check("a.dat", &binary, Ok(BodyFile::Stl));
        check("a.csv", b"solid cube\nfacet", Ok(BodyFile::Stl));
        check("a.stl", b"x,y\n0,0\n1,0\n0,1\n", Ok(BodyFile::Csv));
        check("a.txt", b"# outline\n0 0\n1 0\n", Ok(BodyFile::Csv));
        check("empty.stl", b"", Ok(BodyFile::Stl));
        check(
            "a.stl",
            b"v 0 0 0\nv 1 0 0\n",
            Err("OBJ files are not read yet"),
        );
        check("a.obj", b"# made by hand\n", Err("OBJ"));
        check("a.stl", b"ply\nformat ascii 1.0\n", Err("PLY"));
        check(
            "slat.dat",
            b"0 0\n1 0\n",
            Err(".dat files are not read yet"),
        );
        check(
            "a.step",
            b"ISO-10303-21;",
            Err("export the body as .stl or .csv"),
        );
    }
}
