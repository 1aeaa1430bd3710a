//! Where scenes are packed and measured, each once: what came of it is kept until the code changes that packs or measures.

use std::any::type_name;

use serde::Serialize;
use serde::de::DeserializeOwned;
use sphpack::{Options, Outcome, Scene, run as pack};
use sphpack_packing::Silent;

use crate::kept::Kept;
use crate::workspace::root;

/// A place to pack and measure.
pub(crate) struct Bench {
    kept: Kept,
}

impl Bench {
    /// `own` are the sources that measure, beside those that pack.
    pub(crate) fn open(own: &[&str]) -> Result<Self, String> {
        let kept = Kept::open(&root().join("target/measured"), own)?;
        Ok(Self { kept })
    }

    /// What is measured of a scene when it is packed.
    pub(crate) fn packed<T: Serialize + DeserializeOwned>(
        &self,
        scene: &Scene,
        measure: impl FnOnce(&Outcome) -> T,
    ) -> Result<T, String> {
        let text = toml::to_string(scene).map_err(|error| error.to_string())?;
        self.once(&text, || {
            let outcome = pack(scene, &Options::default(), &mut Silent);
            outcome
                .map(|outcome| measure(&outcome))
                .map_err(|error| error.to_string())
        })
    }

    /// What is measured of something else, of which `of` says all.
    pub(crate) fn once<T: Serialize + DeserializeOwned>(
        &self,
        of: &str,
        make: impl FnOnce() -> Result<T, String>,
    ) -> Result<T, String> {
        // One thing may be measured in several ways.
        let of = format!("{}\n{of}", type_name::<T>());
        self.kept.once(&of, make)
    }
}
