//! What can be wrong with a body.

/// Why a body cannot be built or used. Every message says what is wrong and what to do about it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// Nothing of the body is left when its surface is moved inward.
    #[error(
        "nothing of the body is left {depth} inside its surface; use a smaller spacing, or surface = \"exact\""
    )]
    Vanished {
        /// How far the surface was moved, scene units.
        depth: f64,
    },
}
