//! The parts of docs/methods.md that are regenerated each by itself.

use std::fs;

use crate::selection::Selection;
use crate::workspace::root;
use crate::{accelerations, agitators, gaps, interface};

/// A part with its flag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Section {
    Accelerations,
    Agitators,
    Interface,
    Gaps,
}

impl Section {
    /// In the order of the document.
    pub(crate) const ALL: [Self; 4] = [
        Self::Accelerations,
        Self::Agitators,
        Self::Interface,
        Self::Gaps,
    ];

    /// The argument that asks for it.
    pub(crate) fn flag(self) -> &'static str {
        match self {
            Self::Accelerations => "--accelerations",
            Self::Agitators => "--agitators",
            Self::Interface => "--interface",
            Self::Gaps => "--gaps",
        }
    }

    fn heading(self) -> &'static str {
        match self {
            Self::Accelerations => "## Paper 001's accelerations",
            Self::Agitators => "## Paper 000's agitators",
            Self::Interface => "## Paper 004's interface",
            Self::Gaps => "## Paper 004's gaps",
        }
    }

    /// Its text, heading included.
    pub(crate) fn text(self, selection: &Selection) -> Result<String, String> {
        let (about, tables) = match self {
            Self::Accelerations => (accelerations::ABOUT, accelerations::tables(selection)?),
            Self::Agitators => (agitators::ABOUT, agitators::tables(selection)?),
            Self::Interface => (interface::ABOUT, interface::interface(selection)?),
            Self::Gaps => (gaps::ABOUT, gaps::tables(selection)?),
        };
        let data = match self {
            Self::Gaps => " --data DIR",
            _ => "",
        };
        Ok(format!(
            "{}\n\nRegenerate this section with `cargo xtask compare {}{data} --write`. {about}\n{tables}",
            self.heading(),
            self.flag()
        ))
    }

    /// Runs it alone, and puts it in its place in docs/methods.md where the page is written.
    pub(crate) fn run(self, selection: &Selection) -> Result<(), String> {
        let text = self.text(selection)?;
        if !selection.write {
            return Ok(());
        }
        let path = root().join("docs/methods.md");
        let fail = |error| format!("{}: {error}", path.display());
        let document = fs::read_to_string(&path).map_err(fail)?;
        fs::write(&path, self.placed(&document, &text)).map_err(fail)
    }

    /// The document with the section in its place.
    fn placed(self, document: &str, text: &str) -> String {
        let mut parts: Vec<String> = Vec::new();
        for line in document.lines() {
            if parts.is_empty() || line.starts_with("## ") {
                parts.push(String::new());
            }
            if let Some(part) = parts.last_mut() {
                part.push_str(line);
                part.push('\n');
            }
        }
        let find = |section: Self| {
            let heading = format!("{}\n", section.heading());
            (parts.iter()).position(|part| part.starts_with(&heading))
        };
        let later = Self::ALL.into_iter().skip_while(|other| *other != self);
        match find(self) {
            Some(place) => parts[place] = text.to_owned(),
            None => {
                let place = later.skip(1).find_map(find).unwrap_or(parts.len());
                parts.insert(place, text.to_owned());
            }
        }
        let parts: Vec<&str> = parts.iter().map(|part| part.trim_end()).collect();
        parts.join("\n\n") + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::Section;

    #[test]
    fn sections_take_their_places() {
        let document = "# Title\n\ntable\n\n## Paper 004's interface\n\nold\n";
        let new = "## Paper 004's interface\n\nnew\n";
        let placed = Section::Interface.placed(document, new);
        assert_eq!(
            placed,
            "# Title\n\ntable\n\n## Paper 004's interface\n\nnew\n"
        );
        let before = "## Paper 000's agitators\n\nturn\n";
        let placed = Section::Agitators.placed(&placed, before);
        assert!(
            placed.starts_with(
                "# Title\n\ntable\n\n## Paper 000's agitators\n\nturn\n\n## Paper 004"
            )
        );
        let placed = Section::Gaps.placed(&placed, "## Paper 004's gaps\n\nlast\n");
        assert!(placed.ends_with("new\n\n## Paper 004's gaps\n\nlast\n"));
    }
}
