//! Values of the wrong type, in words that name the key and the cure.

use super::document::Document;
use super::parser_words::parser_words;
use super::shape::SHAPES;
use super::slips::{all_numbers, is_list};

/// A value of the wrong type, by the key that it is written for; other messages as [`parser_words`] has them.
pub(super) fn typed(
    message: &str,
    text: &str,
    document: &Document<'_>,
    byte: Option<usize>,
) -> String {
    // As it is written, which may be a solver's word.
    let key = (byte.and_then(|byte| document.key_at(byte)))
        .and_then(|place| text.get(place))
        .map(|key| key.trim_matches(['"', '\'']));
    let wrong = (message.strip_prefix("invalid type: "))
        .or_else(|| message.strip_prefix("invalid value: "))
        .and_then(|rest| rest.rsplit_once(", expected "));
    (key.zip(wrong))
        .and_then(|(key, (found, wanted))| cure(key, found, wanted.trim()))
        .unwrap_or_else(|| parser_words(message))
}

fn cure(key: &str, found: &str, wanted: &str) -> Option<String> {
    let text = (found.strip_prefix("string \"")).and_then(|rest| rest.strip_suffix('"'));
    let number = (found
        .split_once(" `")
        .filter(|(kind, _)| kind.ends_with("integer") || kind.ends_with("point")))
    .map(|(_, rest)| rest.trim_end_matches('`'));
    let is_number = matches!(wanted.as_bytes(), [b'f' | b'i' | b'u', b'0'..=b'9', ..])
        || matches!(wanted, "usize" | "isize");
    let is_whole = is_number && !wanted.starts_with('f');
    if found == "unit variant" && key == "shape" {
        return Some("a shape needs its measures: see `sphpack list shapes`, such as shape = { circle = { center = [0, 0], radius = 1 } }".into());
    }
    if wanted.starts_with("struct ") && !found.starts_with("map") {
        let shape = SHAPES.iter().find(|shape| shape.name == key);
        let example = match (shape, key) {
            (Some(shape), _) => format!("shape = {}", shape.example),
            (None, "rotate") => "rotate = { axis = [0, 0, 1], degrees = 30 }".into(),
            (None, _) => format!("{key} = {{ … }}"),
        };
        return Some(format!(
            "{key} has keys of its own; write them in braces: {example}"
        ));
    }
    if let Some(text) = text {
        let as_number = text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        let of_inset = wanted.contains("a number") && as_number.is_some();
        return match (wanted, as_number) {
            (_, Some(_)) if is_number || of_inset => {
                let value = text.trim();
                Some(if is_list(key) {
                    format!(
                        "{key} holds the text \"{text}\"; write the number without quotes: {value}"
                    )
                } else {
                    format!(
                        "{key} is the text \"{text}\"; write the number without quotes: {key} = {value}"
                    )
                })
            }
            (_, None) if is_number => Some(format!(
                "{key} is the text \"{text}\"; it must be a number, without quotes"
            )),
            ("a boolean", _) => Some(format!(
                "{key} is the text \"{text}\"; write {key} = true or {key} = false, without quotes"
            )),
            ("a sequence", _) => Some(match all_numbers(text) {
                Some(numbers) => format!(
                    "{key} is the text \"{text}\"; write the list in brackets, without quotes: {key} = [{numbers}]"
                ),
                None => format!("{key} is a list; write it in brackets: {key} = [\"{text}\"]"),
            }),
            _ => None,
        };
    }
    if let Some(number) = number {
        return match wanted {
            "a sequence" => Some(format!(
                "{key} is the number {number}; it is a list in brackets, one number for each axis, such as {key} = [{number}, {number}]"
            )),
            "a boolean" => Some(format!(
                "{key} is the number {number}; write {key} = true or {key} = false"
            )),
            "a string" | "string or table" | "path string" => Some(format!(
                "{key} is the number {number}; it is text, in quotes, such as {key} = \"{number}\""
            )),
            _ if is_whole => Some(format!(
                "{key} is {number}; it must be a whole number, such as 1"
            )),
            _ => None,
        };
    }
    if found == "sequence" && is_number {
        return Some(format!(
            "{key} is a list; it must be one number, without brackets"
        ));
    }
    if found.starts_with("boolean") && wanted == "a sequence" {
        let value = found.trim_start_matches("boolean `").trim_end_matches('`');
        return Some(format!(
            "{key} is a list in brackets, one for each axis, such as {key} = [{value}, {value}]"
        ));
    }
    None
}
