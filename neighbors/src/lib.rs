//! Who is near whom (work in progress).
pub mod bounds;
pub mod point;
pub use bounds::Bounds;
