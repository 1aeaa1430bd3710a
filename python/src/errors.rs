//! Errors as Python's exceptions, in the same words.

use pyo3::prelude::*;

/// The exception for what went wrong: `sphpack.InputError` where the input is wrong, `sphpack.Error` for all else.
pub(crate) fn raised(py: Python<'_>, error: &sphpack::Error) -> PyErr {
    exception(py, &error.to_string(), error.status())
}

/// An exception with the command's exit status for it.
fn exception(py: Python<'_>, message: &str, status: u8) -> PyErr {
    let class = if status == sphpack::BAD_INPUT {
        "InputError"
    } else {
        "Error"
    };
    let made = py
        .import("sphpack._errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call1((message, status)));
    match made {
        Ok(made) => PyErr::from_value(made),
        Err(error) => error,
    }
}

/// Of input that only Python can give: an array of a wrong length, for example.
pub(crate) fn wrong(py: Python<'_>, message: &str) -> PyErr {
    exception(py, message, sphpack::BAD_INPUT)
}
