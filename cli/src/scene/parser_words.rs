//! What a parser says of a scene, with the nearest known name.

use super::nearest::advice;
use super::shape::SHAPES;

/// Said of values that no scene has.
pub(super) const TOO_DEEP: &str =
    "values lie within one another deeper than any scene needs; remove brackets";

/// A parser's message with the nearest known name in place of a bare list.
pub(super) fn parser_words(message: &str) -> String {
    let message = message.trim().replace('\n', "; ");
    if let Some((unknown, known)) = message
        .strip_prefix("unexpected keys in table: ")
        .and_then(|rest| rest.split_once(", available keys: "))
    {
        let known: Vec<&str> = known.split(", ").collect();
        let first = unknown.split(", ").next().unwrap_or(unknown);
        return unknown_key(first, &known);
    }
    if ["recursion limit", "recursion depth"]
        .iter()
        .any(|words| message.contains(words))
    {
        return TOO_DEEP.into();
    }
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    if let [unknown, known @ ..] = quoted.as_slice() {
        if message.starts_with("unknown field") {
            return unknown_key(unknown, known);
        }
        if message.starts_with("unknown variant") {
            return unknown_name(unknown, known);
        }
        if message.starts_with("missing field") {
            return format!(
                "the key \"{unknown}\" is missing; add it (`sphpack init` shows a whole scene)"
            );
        }
    }
    message
}

fn unknown_key(unknown: &str, known: &[&str]) -> String {
    // A body's shape, written beside it instead of in it.
    let shape = SHAPES.iter().find(|shape| shape.name == unknown);
    match shape {
        Some(shape) if known.contains(&"shape") => format!(
            "unknown key \"{unknown}\"; it is a shape: write shape = {}",
            shape.example
        ),
        _ if known.is_empty() => format!("unknown key \"{unknown}\"; remove it"),
        _ => format!("unknown key \"{unknown}\"; {}", advice(unknown, known)),
    }
}

fn unknown_name(unknown: &str, known: &[&str]) -> String {
    if known.is_empty() {
        return format!("unknown name \"{unknown}\"; remove it");
    }
    let is_shape = known.contains(&"torus");
    if is_shape && unknown.contains('.') {
        return format!("\"{unknown}\" is a file; write shape = {{ file = \"{unknown}\" }}");
    }
    if unknown == "fluid" && known.contains(&"container") {
        return "no body has the role \"fluid\": fluid is what is between the bodies, and its density stands in [fluid]; for a tank that holds it write role = \"container\", and for a box of fluid alone leave the body out".into();
    }
    format!("unknown name \"{unknown}\"; {}", advice(unknown, known))
}
