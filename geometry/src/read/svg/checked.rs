//! A drawing's text before it is resolved: faults that a viewer passes over in silence are errors with their line, and
//! what will not be painted is counted.

use std::str::FromStr;

use roxmltree::{Document, Node, ParsingOptions};

use super::arcs::{self, Edit};
use super::cost;
use crate::read::lines::{row, shown, whole};
use crate::{GeometryError, OutlineRepair};

/// The name space of drawings.
const SVG: &str = "http://www.w3.org/2000/svg";

/// Elements within each other, at most: those who resolve them call themselves.
const MOST_DEPTH: usize = 128;

/// Attributes of one element, at most: that none is there twice is told by comparing all.
const MOST_ATTRIBUTES: usize = 2000;

/// Bytes of a document type, at most: its entities are put in up to 255 at a time.
const MOST_DOCTYPE: usize = 1 << 14;

/// Elements whose content is not painted where it stands.
const ELSEWHERE: [&str; 7] = [
    "defs", "symbol", "clipPath", "mask", "pattern", "marker", "switch",
];

/// A drawing that can be resolved.
pub(super) struct Checked<'a> {
    text: &'a str,
    document: Document<'a>,
}

/// Reads the elements, and looks for what is wrong with them.
pub(super) fn document(text: &str) -> Result<Checked<'_>, GeometryError> {
    if let Some(line) = crowded(text) {
        return Err(row(
            line,
            format!(
                "an element has more than {MOST_ATTRIBUTES} attributes; save the drawing again"
            ),
        ));
    }
    if doctype(text) > MOST_DOCTYPE {
        return Err(whole(
            "the drawing's document type is too long; save it again, as plain SVG",
        ));
    }
    let allowing = ParsingOptions {
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, allowing).map_err(|e| {
        row(
            e.pos().row as usize,
            format!("the drawing is damaged ({e}); save it again"),
        )
    })?;
    let checked = Checked { text, document };
    let root = checked.document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(whole(format!(
            "this is XML, but no SVG drawing: its first element is \"{}\"; save the drawing as SVG",
            shown(root.tag_name().name().as_bytes())
        )));
    }
    checked.check_elements()?;
    cost::check(&checked.document, text.len())?;
    Ok(checked)
}

impl Checked<'_> {
    fn check_elements(&self) -> Result<(), GeometryError> {
        let mut depth: Vec<Node<'_, '_>> = Vec::new();
        for node in self.document.descendants().filter(Node::is_element) {
            let parent = node.parent();
            while depth.last().is_some_and(|last| Some(*last) != parent) {
                depth.pop();
            }
            depth.push(node);
            let at_fault = |reason: String| {
                let place = self.document.text_pos_at(node.range().start);
                row(place.row as usize, reason)
            };
            if depth.len() > MOST_DEPTH {
                return Err(at_fault(format!(
                    "more than {MOST_DEPTH} elements are within each other; ungroup the drawing"
                )));
            }
            check_attributes(node).map_err(at_fault)?;
        }
        Ok(())
    }

    /// The text as it is to be resolved: with its units those of its view box, as what size it is shown at does not
    /// matter, and without arcs.
    pub(super) fn prepared(&self) -> String {
        let root = self.document.root_element();
        let mut edits: Vec<Edit> = Vec::new();
        if root.has_attribute("viewBox") {
            let sizes = root
                .attributes()
                .filter(|a| a.namespace().is_none() && matches!(a.name(), "width" | "height"));
            edits.extend(sizes.map(|a| (a.range(), String::new())));
        }
        let styles: String = self
            .document
            .descendants()
            .filter(|node| node.has_tag_name((SVG, "style")) || node.has_tag_name("style"))
            .flat_map(|node| node.children().filter_map(|child| child.text()))
            .collect();
        // Only paths have markers.
        let has_markers = self.text.contains("marker");
        for node in self.document.descendants().filter(Node::is_element) {
            if !has_markers || node.tag_name().name() == "path" {
                arcs::without_arcs(node, self.text, &styles, &mut edits);
            }
        }
        edits.sort_by_key(|edit| edit.0.start);
        let mut text = String::with_capacity(self.text.len());
        let mut done = 0;
        for (range, new) in edits {
            // What comes from an entity has no place of its own.
            let Some(before) = self.text.get(done..range.start) else {
                continue;
            };
            if range.end <= self.text.len() && self.text.is_char_boundary(range.end) {
                text += before;
                text += &new;
                done = range.end;
            }
        }
        text += self.text.get(done..).unwrap_or_default();
        text
    }

    /// The corner of the view box, which resolving moves to the origin.
    pub(super) fn origin(&self) -> [f64; 2] {
        let root = self.document.root_element();
        let view_box = root.attribute("viewBox");
        match view_box.and_then(|text| svgtypes::ViewBox::from_str(text).ok()) {
            Some(view_box) => [view_box.x, view_box.y],
            None => [0.0; 2],
        }
    }

    /// What would be painted and cannot be.
    pub(super) fn left_out(&self) -> LeftOut {
        let mut left_out = LeftOut::default();
        for node in self.document.descendants() {
            let of_kind = match node.tag_name().name() {
                "text" if says_something(node) => &mut left_out.texts,
                "image" | "foreignObject" => &mut left_out.images,
                _ => continue,
            };
            let is_elsewhere = node.ancestors().any(|above| {
                ELSEWHERE.contains(&above.tag_name().name())
                    || above.attribute("display") == Some("none")
                    || above
                        .attribute("style")
                        .is_some_and(|style| style.replace(' ', "").contains("display:none"))
            });
            *of_kind += usize::from(!is_elsewhere);
        }
        left_out
    }
}

/// What of a drawing is not read.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LeftOut {
    texts: usize,
    images: usize,
}

impl LeftOut {
    pub(super) fn remarks(self) -> impl Iterator<Item = OutlineRepair> {
        [
            (self.texts > 0).then_some(OutlineRepair::LeftOutTexts(self.texts)),
            (self.images > 0).then_some(OutlineRepair::LeftOutImages(self.images)),
        ]
        .into_iter()
        .flatten()
    }

    pub(super) fn words(self) -> String {
        let mut words = String::new();
        for (count, one, several) in [
            (self.texts, "text", "texts"),
            (self.images, "image", "images"),
        ] {
            if count > 0 {
                let join = if words.is_empty() { ", only" } else { " and" };
                let name = if count == 1 { one } else { several };
                words += &format!("{join} {count} {name}");
            }
        }
        words
    }
}

fn says_something(node: Node<'_, '_>) -> bool {
    node.descendants()
        .filter(Node::is_text)
        .any(|text| text.text().is_some_and(|t| !t.trim().is_empty()))
}

/// The line of an element with very many attributes.
fn crowded(text: &str) -> Option<usize> {
    let mut offset = 0;
    for tag in text.split('<') {
        let head = tag.split('>').next().unwrap_or_default();
        if head.bytes().filter(|&b| b == b'=').count() > MOST_ATTRIBUTES {
            return Some(super::line_of(text.as_bytes(), offset));
        }
        offset += tag.len() + 1;
    }
    None
}

/// The length of the document type.
fn doctype(text: &str) -> usize {
    let Some(start) = text.find("<!DOCTYPE") else {
        return 0;
    };
    let rest = &text[start..];
    let head = rest.find(['[', '>']).unwrap_or(rest.len());
    match rest.as_bytes().get(head) {
        Some(b'[') => rest.find("]>").or(rest.rfind(']')).unwrap_or(rest.len()),
        _ => head,
    }
}

/// What a viewer would pass over: half a path, a size that is no number.
fn check_attributes(node: Node<'_, '_>) -> Result<(), String> {
    let tag = node.tag_name().name();
    let lengths: &[&str] = match tag {
        "rect" => &["x", "y", "width", "height", "rx", "ry"],
        "circle" => &["cx", "cy", "r"],
        "ellipse" => &["cx", "cy", "rx", "ry"],
        "line" => &["x1", "y1", "x2", "y2"],
        _ => &[],
    };
    for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
        let (name, value) = (attribute.name(), attribute.value());
        let fault = match name {
            "d" if tag == "path" => path_fault(value),
            "points" if matches!(tag, "polygon" | "polyline") => points_fault(value),
            "transform" => svgtypes::Transform::from_str(value)
                .err()
                .map(|e| e.to_string()),
            _ if lengths.contains(&name) && value != "auto" => {
                svgtypes::Length::from_str(value.trim())
                    .err()
                    .map(|_| "a length such as 12.5 or 12.5mm is needed".into())
            }
            _ => None,
        };
        if let Some(fault) = fault {
            return Err(format!(
                "{name}=\"{}\" of a {tag} is not right: {fault}; save the drawing again",
                shown(value.as_bytes())
            ));
        }
    }
    Ok(())
}

fn path_fault(data: &str) -> Option<String> {
    // "none" is how an empty path may be written.
    if data.trim() == "none" {
        return None;
    }
    svgtypes::PathParser::from(data)
        .find_map(Result::err)
        .map(|e| e.to_string())
}

fn points_fault(points: &str) -> Option<String> {
    let mut count = 0;
    for number in svgtypes::NumberListParser::from(points) {
        match number {
            Ok(_) => count += 1,
            Err(e) => return Some(e.to_string()),
        }
    }
    (count % 2 == 1).then(|| "pairs of numbers are needed".into())
}
