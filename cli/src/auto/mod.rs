//! `method = "auto"`: settings by what somebody wants to reach, from the chart of speed against accuracy.

mod pick;
mod reached;
mod table;
#[cfg(test)]
mod tests;

pub use pick::Picked;
pub(crate) use pick::settled;
pub use reached::AutoReport;
pub use table::{Choice, choices};
