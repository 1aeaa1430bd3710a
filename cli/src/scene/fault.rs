//! What is wrong with a scene, and the checks that all its keys share.

/// A step on the way to a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Key {
    /// Of a table.
    Name(&'static str),
    /// Of an array.
    Index(usize),
}

/// What is wrong with a scene, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Fault {
    /// The way to the value.
    pub(crate) keys: Vec<Key>,
    /// What is wrong, and the cure.
    pub message: String,
}

pub(super) type Checked = Result<(), Fault>;

pub(super) fn fault(keys: &[Key], message: impl Into<String>) -> Checked {
    Err(Fault {
        keys: keys.to_vec(),
        message: message.into(),
    })
}

pub(super) fn positive(keys: &[Key], name: &str, value: f64) -> Checked {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    fault(
        keys,
        format!("{name} is {value}; it must be a positive, finite number"),
    )
}

pub(super) fn finite(keys: &[Key], name: &str, values: &[f64]) -> Checked {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => fault(
            keys,
            format!("{name} holds {value}; every entry must be a finite number"),
        ),
    }
}

pub(super) fn vector(keys: &[Key], name: &str, values: &[f64], dimension: usize) -> Checked {
    if values.len() != dimension {
        return fault(
            keys,
            format!(
                "{name} has {} entries; it needs {dimension}, one for each axis",
                values.len()
            ),
        );
    }
    finite(keys, name, values)
}
