//! What every method can do.

use std::fmt::Debug;

use crate::observer::Observer;
use crate::packed::Packed;
use crate::problem::{PackingError, Problem};
use crate::{
    Agitated, Balanced, Clipped, Complex, Coupled, Hybrid, Ppa, Relaxation, Standard, Triangulated,
};

/// Turns a problem into particles at rest, in the plane or in space.
///
/// Methods are long code. They are compiled with this crate, for both dimensions, and not once more with every crate that
/// packs.
pub trait Method<const D: usize>: Debug {
    /// Packs the problem.
    ///
    /// # Errors
    /// Those of [`Problem::check`]; [`PackingError::Surface`] where a body's particle surface cannot be built;
    /// [`PackingError::OnlyPlane`] from methods for the plane, in space.
    fn pack(
        &self,
        problem: &Problem<D>,
        observer: &mut dyn Observer,
    ) -> Result<Packed<D>, PackingError>;
}

macro_rules! in_plane_and_space {
    ($($method:ident)*) => {
        $(in_plane_and_space!($method, 2);
        in_plane_and_space!($method, 3);)*
    };
    ($method:ident, $dimension:literal) => {
        impl Method<$dimension> for $method {
            fn pack(
                &self,
                problem: &Problem<$dimension>,
                observer: &mut dyn Observer,
            ) -> Result<Packed<$dimension>, PackingError> {
                self.pack_in(problem, observer)
            }
        }
    };
}

in_plane_and_space! {
    Agitated Balanced Clipped Complex Coupled Hybrid Ppa Relaxation Standard Triangulated
}
