//! Markdown tables that are seen while they grow.

/// A table; every line is printed when it comes.
pub(crate) struct ShownTable(String);

impl ShownTable {
    /// A table with its heading and the rule below.
    pub(crate) fn new(heading: &str) -> Self {
        print!("\n{heading}");
        Self(heading.to_owned())
    }

    /// A line, its end included.
    pub(crate) fn push(&mut self, line: &str) {
        print!("{line}");
        self.0.push_str(line);
    }

    /// All lines.
    pub(crate) fn into_text(self) -> String {
        self.0
    }
}
