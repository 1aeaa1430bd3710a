//! What Python calls: the module `sphpack._native`. Users see the package around it, in `python/sphpack`.
//!
//! Arrays go over without copies: what was computed is handed to NumPy, which frees it. Lists of points are flat here,
//! `dimension` numbers each; the package gives them their shape.

mod bodies;
mod columns;
mod errors;
mod kernels;
mod measured;
mod neighbors;
mod packed;

use pyo3::prelude::*;

/// The part of the package that is written in Rust.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::bodies::Body;
    #[pymodule_export]
    use super::bodies::check;
    #[pymodule_export]
    use super::command;
    #[pymodule_export]
    use super::kernels::{kernel_support, kernel_values};
    #[pymodule_export]
    use super::measured::quality;
    #[pymodule_export]
    use super::neighbors::neighbors;
    #[pymodule_export]
    use super::packed::{pack, plan, save};
}

/// Runs the command `sphpack` with these arguments, the program's name first, and gives its exit status.
#[pyfunction]
fn command(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> u8 {
    py.detach(|| sphpack::command::run(arguments))
}
