//! Tables, as the page in docs and the one in target want them.

/// Cells of text.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    pub(super) head: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(head: &[&str]) -> Self {
        Self {
            head: head.iter().map(|&cell| cell.to_owned()).collect(),
            rows: Vec::new(),
        }
    }

    /// With a line break at its end.
    pub(super) fn markdown(&self) -> String {
        // A bar would end the cell.
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = format!("|{}\n", "---|".repeat(self.head.len()));
        let rows = self.rows.iter().map(|row| line(row));
        line(&self.head) + &rule + &rows.collect::<String>()
    }

    pub(super) fn html(&self) -> String {
        let line = |tag: &str, cells: &[String]| {
            let cells = (cells.iter()).map(|cell| {
                let cell = cell.replace('&', "&amp;").replace('<', "&lt;");
                format!("<{tag}>{cell}</{tag}>")
            });
            format!("<tr>{}</tr>\n", cells.collect::<String>())
        };
        let rows = self.rows.iter().map(|row| line("td", row));
        format!(
            "<table>\n{}{}</table>\n",
            line("th", &self.head),
            rows.collect::<String>()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cells_hold_stays_in_them() {
        let mut table = Table::new(&["|Γ|", "b"]);
        table
            .rows
            .push(vec!["1 < 2 & 3".to_owned(), "x|y".to_owned()]);
        assert_eq!(
            table.markdown(),
            "| \\|Γ\\| | b |\n|---|---|\n| 1 < 2 & 3 | x\\|y |\n"
        );
        let html = table.html();
        assert!(html.contains("<td>1 &lt; 2 &amp; 3</td>"), "{html}");
    }
}
