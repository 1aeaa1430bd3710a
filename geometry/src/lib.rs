//! What a body is (work in progress).
pub mod error;
pub mod surface;
pub use error::GeometryError;
pub use surface::{Closest, Feature, Features, Surface};
