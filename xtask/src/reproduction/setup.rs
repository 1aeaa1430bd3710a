//! How a scene is packed and judged.

use std::fmt::Write as _;

use sphpack::Scene;
use sphpack::scene::{Finish, Method};
use sphpack_kernels::KernelKind;

use crate::selection::Selection;
use crate::shipped::load;

/// How a scene is packed and judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Setup {
    /// The scene's file in `scenes`, without extension.
    pub(crate) scene: &'static str,
    /// ∆s.
    pub(crate) spacing: f64,
    /// Factor on all lengths but ∆s: densities have no unit, so a body enlarged is the body at a smaller ∆s.
    pub(crate) enlarged: f64,
    pub(crate) method: Method,
    /// The kernel that packs and judges; the method's own, and the quintic one, where there is none.
    pub(crate) kernel: Option<KernelKind>,
    /// Of the method balanced.
    pub(crate) finish: Finish,
    /// h/∆s that packs; the method's own where there is none.
    pub(crate) h_over_spacing: Option<f64>,
    /// h/∆s of the quintic kernel that judges; as packed where there is none.
    pub(crate) judged_at: Option<f64>,
    /// ε of damped dynamics.
    pub(crate) tolerance: f64,
    /// Iterations at most.
    pub(crate) patience: usize,
}

impl Setup {
    /// The hybrid method on a scene, with its defaults.
    pub(crate) const fn of(scene: &'static str, spacing: f64, method: Method) -> Self {
        Self {
            scene,
            spacing,
            enlarged: 1.0,
            method,
            kernel: None,
            finish: Finish::Even,
            h_over_spacing: None,
            judged_at: None,
            tolerance: 1e-4,
            patience: 100_000,
        }
    }

    pub(crate) const fn at(self, h_over_spacing: f64) -> Self {
        Self {
            h_over_spacing: Some(h_over_spacing),
            ..self
        }
    }

    pub(crate) const fn by(self, kernel: KernelKind) -> Self {
        Self {
            kernel: Some(kernel),
            ..self
        }
    }

    pub(crate) const fn judged(self, h_over_spacing: f64) -> Self {
        Self {
            judged_at: Some(h_over_spacing),
            ..self
        }
    }

    pub(crate) const fn until(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    pub(crate) const fn times(self, enlarged: f64) -> Self {
        Self { enlarged, ..self }
    }

    pub(crate) const fn within(self, patience: usize) -> Self {
        Self { patience, ..self }
    }

    pub(crate) const fn consistent(self) -> Self {
        Self {
            finish: Finish::Consistent,
            ..self
        }
    }

    /// The method, and the finish where it has several.
    pub(crate) fn method_name(&self) -> String {
        match (self.method, self.finish) {
            (Method::Balanced, Finish::Even) => "balanced even".to_owned(),
            (Method::Balanced, Finish::Consistent) => "balanced consistent".to_owned(),
            (Method::Balanced, Finish::Calm) => "balanced calm".to_owned(),
            (Method::Balanced, Finish::Both) => "balanced both".to_owned(),
            (method, _) if self.patience == 0 => format!("{} before it moves", method.name()),
            (method, _) => method.name().to_owned(),
        }
    }

    /// Scene, ∆s and method in a line.
    pub(crate) fn words(&self) -> String {
        let size = if self.enlarged == 1.0 {
            String::new()
        } else {
            format!(" × {}", self.enlarged)
        };
        let h = (self.h_over_spacing).map_or_else(String::new, |h| format!(", h/∆s = {h}"));
        let kernel = (self.kernel).map_or_else(String::new, |kernel| format!(", {kernel}"));
        format!(
            "{}{size}, ∆s = {}{h}{kernel}, {}",
            self.scene,
            self.spacing,
            self.method_name()
        )
    }

    /// The scene that is packed; `None` where its body's file is not there.
    pub(crate) fn scene(&self, selection: &Selection) -> Result<Option<Scene>, String> {
        let Some(mut scene) = load(self.scene, selection)? else {
            return Ok(None);
        };
        scene.spacing = self.spacing / self.enlarged;
        scene.packing.method = self.method;
        scene.packing.kernel = self.kernel.or(scene.packing.kernel);
        scene.packing.finish = self.finish;
        scene.packing.h_over_spacing = self.h_over_spacing.or(scene.packing.h_over_spacing);
        scene.packing.velocity_tolerance = self.tolerance;
        scene.packing.max_iterations = self.patience;
        if let Some(h) = self.judged_at {
            scene.quality.kernel = Some(self.kernel.unwrap_or(KernelKind::Quintic));
            scene.quality.h_over_spacing = Some(h);
        }
        Ok(Some(scene))
    }

    /// A name for the scene's file that tells it from those of all other setups.
    pub(crate) fn file_name(&self) -> String {
        let usual = Self::of(self.scene, self.spacing, self.method);
        let mut name = format!("{}-{}", self.scene, self.spacing / self.enlarged);
        // Writing to a string cannot fail.
        let _ = write!(name, "-{}", self.method.name());
        if self.finish != usual.finish {
            let _ = write!(name, "-{}", self.method_name().replace("balanced ", ""));
        }
        if let Some(kernel) = self.kernel {
            let _ = write!(name, "-{kernel}");
        }
        if let Some(h) = self.h_over_spacing {
            let _ = write!(name, "-h{h}");
        }
        if let Some(h) = self.judged_at {
            let _ = write!(name, "-judged{h}");
        }
        if self.tolerance != usual.tolerance {
            let _ = write!(name, "-to{:e}", self.tolerance);
        }
        if self.patience != usual.patience {
            let _ = write!(name, "-within{}", self.patience);
        }
        name + ".toml"
    }
}
