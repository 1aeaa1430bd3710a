//! How the result is judged.

use serde::{Deserialize, Serialize};
use sphpack_kernels::KernelKind;

/// How the result is judged; as packed where left out.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct QualitySpec {
    /// The kernel that measures.
    #[serde(with = "super::named::optional_kernel")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "super::schema::kernel"))]
    pub kernel: Option<KernelKind>,
    /// Its smoothing length over ∆s.
    pub h_over_spacing: Option<f64>,
    /// The same over √D ∆s, as in [`PackingSpec`](super::PackingSpec).
    #[serde(skip)]
    pub(crate) h_over_diagonal: Option<f64>,
}
