//! How large a drawing becomes when everything that it refers to is put in its place: a few lines can ask for more than
//! any machine has.

use std::collections::HashMap;

use roxmltree::{Document, Node, NodeId};

use crate::GeometryError;
use crate::read::lines::whole;

/// Bytes that any drawing may come to, and those for each of its own.
const MOST: (f64, f64) = (4e6, 8.0);

/// Comparisons of elements with the rules of style sheets, at most.
const MOST_MATCHES: usize = 200_000_000;

/// References that lead on to others, at most.
const MOST_STEPS: usize = 256;

/// What an element takes without its attributes, bytes.
const ELEMENT: f64 = 32.0;

/// Refuses what is too large, for a drawing of `size` bytes.
pub(super) fn check(document: &Document<'_>, size: usize) -> Result<(), GeometryError> {
    let mut sheets = String::new();
    let mut elements = 0;
    let mut costs = Costs::default();
    for node in document.descendants().filter(Node::is_element) {
        elements += 1;
        if let Some(id) = node.attribute("id") {
            costs.named.entry(id).or_insert(node);
        }
        if node.tag_name().name() == "style" {
            sheets.extend(node.children().filter_map(|child| child.text()));
        }
    }
    let rules = sheets.matches('{').count() + sheets.matches(',').count();
    let too_large = || {
        whole(
            "the drawing refers to parts of itself so often that it becomes too large; unlink its clones, and save it again",
        )
    };
    if rules.saturating_mul(elements) > MOST_MATCHES {
        return Err(whole(
            "the drawing has too many style rules for its elements; save it again, as plain SVG",
        ));
    }
    let root = document.root_element();
    let mut cost = costs.of(root, 0).ok_or_else(too_large)?;
    // A rule may hold for every element.
    cost += costs
        .references(&sheets, true, cost, 0)
        .ok_or_else(too_large)?;
    if cost <= MOST.0 + MOST.1 * size as f64 {
        Ok(())
    } else {
        Err(too_large())
    }
}

#[derive(Default)]
struct Costs<'a, 'input> {
    named: HashMap<&'a str, Node<'a, 'input>>,
    /// 0 while it is worked out: what refers to itself is left out by those who resolve it.
    known: HashMap<NodeId, f64>,
}

impl<'a, 'input> Costs<'a, 'input> {
    /// Bytes of an element with all that is within it, put in its place; `None` where references go on and on.
    fn of(&mut self, node: Node<'a, 'input>, step: usize) -> Option<f64> {
        if let Some(&known) = self.known.get(&node.id()) {
            return Some(known);
        }
        if step > MOST_STEPS {
            return None;
        }
        self.known.insert(node.id(), 0.0);
        let mut cost = ELEMENT;
        for child in node.children().filter(Node::is_element) {
            cost += self.of(child, step + 1)?;
        }
        for attribute in node.attributes() {
            cost += attribute.value().len() as f64;
        }
        let below = cost;
        for attribute in node.attributes() {
            let value = attribute.value();
            if attribute.name() == "href"
                && let Some(id) = value.trim().strip_prefix('#')
            {
                cost += self.target(id, step)?;
            } else if value.contains("url(") {
                let is_passed_on = !matches!(attribute.name(), "clip-path" | "mask" | "filter");
                cost += self.references(value, is_passed_on, below, step)?;
            }
        }
        self.known.insert(node.id(), cost);
        Some(cost)
    }

    /// What a text with `url(#…)` in it adds to an element of `below` bytes: what is passed on may be put at every
    /// point within it.
    fn references(
        &mut self,
        text: &str,
        is_passed_on: bool,
        below: f64,
        step: usize,
    ) -> Option<f64> {
        let mut sum = 0.0;
        for part in text.split("url(").skip(1) {
            let id = part.split(')').next().unwrap_or_default();
            let id = id.trim_matches(|c: char| c.is_whitespace() || matches!(c, '"' | '\'' | '#'));
            let times = if is_passed_on {
                1.0 + 0.25 * below
            } else {
                1.0
            };
            sum += times * self.target(id, step)?;
        }
        Some(sum)
    }

    fn target(&mut self, id: &str, step: usize) -> Option<f64> {
        match self.named.get(id).copied() {
            // These hold nothing that is painted.
            Some(node) if node.tag_name().name().ends_with("Gradient") => Some(0.0),
            Some(node) => self.of(node, step + 1),
            None => Some(0.0),
        }
    }
}
