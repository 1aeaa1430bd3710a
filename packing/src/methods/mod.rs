//! What every method can do, and the methods.

use std::fmt::Debug;

use crate::observer::Silent;
use crate::packed::Packed;
use crate::problem::{PackingError, Problem};
use crate::run_log::RunLog;

pub mod balanced;
mod info;
#[cfg(feature = "published")]
mod published;

pub use balanced::{Balanced, Band};
pub use info::{MethodInfo, Moves};
#[cfg(feature = "published")]
pub use published::{
    Agitated, Agitators, Clipped, Complex, Coupled, Hybrid, Ppa, Relaxation, Standard, Triangulated,
};

/// Turns a problem into particles at rest, in the plane or in space.
///
/// Methods are long code. They are compiled with this crate, for both dimensions, and not once more with every crate that
/// packs.
pub trait Method<const D: usize>: Debug {
    /// What it costs, moves and promises.
    fn info(&self) -> &'static MethodInfo;

    /// Whether it will take the problem, as far as that is known before particles are placed.
    ///
    /// # Errors
    /// Those of [`Method::pack`].
    fn check(&self, problem: &Problem<D>) -> Result<(), PackingError>;

    /// Packs the problem. The log tells an observer how far it is, and brings back what an earlier run had come to.
    ///
    /// # Errors
    /// Those of [`Problem::check`]; [`PackingError::Surface`] where a body's particle surface cannot be built;
    /// [`PackingError::OnlyPlane`] from methods for the plane, in space.
    fn pack(&self, problem: &Problem<D>, log: &mut RunLog<'_>) -> Result<Packed<D>, PackingError>;
}

impl<const D: usize> Problem<D> {
    /// Packs it, watched by nobody.
    ///
    /// # Errors
    /// Those of [`Method::pack`].
    pub fn pack(&self, method: &impl Method<D>) -> Result<Packed<D>, PackingError> {
        method.pack(self, &mut RunLog::new(&mut Silent))
    }
}

/// Compiles methods for the plane and for space. Each has `INFO` and `pack_in`, and says which function checks a problem.
macro_rules! in_plane_and_space {
    ($($method:ident: $check:expr;)*) => {
        $(in_plane_and_space!($method, $check, 2);
        in_plane_and_space!($method, $check, 3);)*
    };
    ($method:ident, $check:expr, $dimension:literal) => {
        impl Method<$dimension> for $method {
            fn info(&self) -> &'static MethodInfo {
                &Self::INFO
            }

            fn check(&self, problem: &Problem<$dimension>) -> Result<(), PackingError> {
                $check(&Self::INFO, self, problem)
            }

            fn pack(
                &self,
                problem: &Problem<$dimension>,
                log: &mut RunLog<'_>,
            ) -> Result<Packed<$dimension>, PackingError> {
                self.pack_in(problem, log)
            }
        }
    };
}

/// The check of methods with nothing of their own to ask.
#[cfg(feature = "published")]
fn usual<M, const D: usize>(
    info: &MethodInfo,
    _: &M,
    problem: &Problem<D>,
) -> Result<(), PackingError> {
    info.check(problem)
}

in_plane_and_space! {
    Balanced: |_, method: &Balanced, problem| method.check_in(problem);
}

#[cfg(feature = "published")]
in_plane_and_space! {
    Agitated: usual;
    Clipped: usual;
    Complex: usual;
    Coupled: usual;
    Hybrid: usual;
    // Fluid goes to the true surfaces: none is moved inward.
    Ppa: |_, _, problem: &Problem<_>| problem.check_uniform();
    Relaxation: usual;
    Standard: usual;
    Triangulated: usual;
}
