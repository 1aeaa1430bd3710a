//! Choosing a kernel by name at run time, once, outside the loop.

use std::fmt;
use std::str::FromStr;

use crate::{Cubic, Kernel, Quintic, WendlandC2, WendlandC4, WendlandC6};

/// A smoothing kernel by name, as users write it.
///
/// ```
/// use sphpack_kernels::KernelKind;
///
/// let kind: KernelKind = "wendland-c2".parse()?;
/// assert_eq!(kind, KernelKind::WendlandC2);
/// assert_eq!((kind.to_string(), kind.support_over_h()), ("wendland-c2".to_owned(), 2.0));
/// assert!("gauss".parse::<KernelKind>().is_err());
/// # Ok::<(), sphpack_kernels::UnknownKernel>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum KernelKind {
    /// [`Quintic`], `"quintic"`.
    #[default]
    Quintic,
    /// [`Cubic`], `"cubic"`.
    Cubic,
    /// [`WendlandC2`], `"wendland-c2"`.
    WendlandC2,
    /// [`WendlandC4`], `"wendland-c4"`.
    WendlandC4,
    /// [`WendlandC6`], `"wendland-c6"`.
    WendlandC6,
}

/// Work that is generic over the kernel; [`KernelKind::with`] compiles one copy for each.
pub trait WithKernel<const D: usize> {
    /// What the work returns.
    type Output;
    /// Does the work with a concrete kernel.
    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output;
}

impl KernelKind {
    /// Every kernel, in the order of the documentation.
    pub const ALL: [Self; 5] = [
        Self::Quintic,
        Self::Cubic,
        Self::WendlandC2,
        Self::WendlandC4,
        Self::WendlandC6,
    ];

    /// The name that [`FromStr`] takes and `Display` gives.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quintic => "quintic",
            Self::Cubic => "cubic",
            Self::WendlandC2 => "wendland-c2",
            Self::WendlandC4 => "wendland-c4",
            Self::WendlandC6 => "wendland-c6",
        }
    }

    /// Support radius in units of the smoothing length.
    pub fn support_over_h(self) -> f64 {
        match self {
            Self::Quintic => 3.0,
            _ => 2.0,
        }
    }

    /// Runs `work` with this kernel at smoothing length `h`: one `match`, then code without dispatch.
    pub fn with<const D: usize, W: WithKernel<D>>(self, h: f64, work: W) -> W::Output {
        match self {
            Self::Quintic => work.call(Quintic::<D>::new(h)),
            Self::Cubic => work.call(Cubic::<D>::new(h)),
            Self::WendlandC2 => work.call(WendlandC2::<D>::new(h)),
            Self::WendlandC4 => work.call(WendlandC4::<D>::new(h)),
            Self::WendlandC6 => work.call(WendlandC6::<D>::new(h)),
        }
    }
}

impl fmt::Display for KernelKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A kernel name that is none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownKernel(
    /// The name that was asked for.
    pub String,
);

impl fmt::Display for UnknownKernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = KernelKind::ALL.map(KernelKind::name).join(", ");
        write!(f, "no kernel is called \"{}\"; there are {names}", self.0)
    }
}

impl std::error::Error for UnknownKernel {}

impl FromStr for KernelKind {
    type Err = UnknownKernel;

    fn from_str(name: &str) -> Result<Self, UnknownKernel> {
        Self::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
            .ok_or_else(|| UnknownKernel(name.to_owned()))
    }
}
