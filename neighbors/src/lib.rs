//! Who is near whom (work in progress).
pub mod bounds;
pub mod domain;
pub mod point;
pub use bounds::Bounds;
pub use domain::Domain;
