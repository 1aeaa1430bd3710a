//! The rows of the balanced method: bars, and what a prototype reached.

use sphpack::scene::Finish;

/// One run and its bars; figures of L∞ and total variation are parts of one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row {
    /// The scene's file in `scenes`, without extension.
    pub(crate) scene: &'static str,
    /// ∆s.
    pub(crate) spacing: f64,
    /// The finish.
    pub(crate) finish: Finish,
    /// The most evaluations.
    pub(crate) evaluations: usize,
    /// Go on to that many, whatever the tolerance.
    pub(crate) patient: bool,
    /// With masses corrected by up to ±2 %.
    pub(crate) corrected: bool,
    /// Of all particles.
    pub(crate) linf_bar: f64,
    /// Of 99 % of the particles.
    pub(crate) most_bar: Option<f64>,
    /// max Γ − min Γ.
    pub(crate) variation_bar: Option<f64>,
    /// Largest residual of a free particle.
    pub(crate) residual_bar: Option<f64>,
    /// Root mean square of the free particles' residuals, where the largest is not judged.
    pub(crate) rms_bar: Option<f64>,
    /// What the prototype came to: evaluations and L∞.
    pub(crate) prototype: &'static str,
    /// Whether it runs with `--quick`.
    pub(crate) quick: bool,
}

impl Row {
    pub(crate) fn finish_name(&self) -> &'static str {
        match (self.finish, self.corrected) {
            (Finish::Even, false) => "even",
            (Finish::Even, true) => "even, masses corrected",
            (Finish::Consistent, _) => "consistent",
            (Finish::Calm, _) => "calm",
            (Finish::Both, _) => "both",
        }
    }

    /// How uneven the distances on the surface may be: "both" and "calm" have surface particles slide for what is beside
    /// them.
    pub(crate) fn cv_bar(&self) -> f64 {
        match self.finish {
            Finish::Even | Finish::Consistent => 0.04,
            Finish::Both => 0.05,
            Finish::Calm => 0.08,
        }
    }

    /// No pair may be nearer, in ∆s.
    pub(crate) fn closest_bar(&self) -> f64 {
        match self.finish {
            Finish::Even | Finish::Calm | Finish::Both => 0.85,
            Finish::Consistent => 0.6,
        }
    }
}

const EVEN: Row = Row {
    scene: "",
    spacing: 0.1,
    finish: Finish::Even,
    evaluations: 150,
    patient: false,
    corrected: false,
    linf_bar: 0.0,
    most_bar: None,
    variation_bar: None,
    residual_bar: None,
    rms_bar: None,
    prototype: "–",
    quick: true,
};

const CYLINDER: Row = Row {
    scene: "cylinder",
    linf_bar: 0.0035,
    variation_bar: Some(0.004),
    ..EVEN
};

const CONSISTENT: Row = Row {
    scene: "cylinder",
    finish: Finish::Consistent,
    evaluations: 600,
    linf_bar: 0.0015,
    residual_bar: Some(1e-5),
    ..EVEN
};

const SOLID: Row = Row {
    linf_bar: 0.005,
    ..EVEN
};

const BUNNY: Row = Row {
    scene: "bunny",
    linf_bar: 0.006,
    most_bar: Some(0.003),
    quick: false,
    ..EVEN
};

const BOTH: Row = Row {
    scene: "cylinder",
    finish: Finish::Both,
    evaluations: 1500,
    linf_bar: 0.0005,
    residual_bar: Some(6e-4),
    ..EVEN
};

const CALM: Row = Row {
    scene: "cylinder",
    finish: Finish::Calm,
    evaluations: 300,
    linf_bar: 0.002,
    residual_bar: Some(1e-6),
    quick: false,
    ..EVEN
};

const CORRECTED: Row = Row {
    corrected: true,
    evaluations: 600,
    linf_bar: 0.0005,
    ..EVEN
};

/// Every row.
pub(crate) const ROWS: [Row; 34] = [
    Row {
        prototype: "403: 0.20 %",
        ..CYLINDER
    },
    Row {
        spacing: 0.05,
        prototype: "138: 0.14 %",
        ..CYLINDER
    },
    Row {
        spacing: 0.025,
        prototype: "138: 0.19 %",
        ..CYLINDER
    },
    CONSISTENT,
    Row {
        spacing: 0.05,
        ..CONSISTENT
    },
    Row {
        spacing: 0.025,
        quick: false,
        ..CONSISTENT
    },
    Row {
        scene: "square",
        spacing: 0.05,
        linf_bar: 0.002,
        prototype: "112: 0.14 %",
        ..EVEN
    },
    Row {
        scene: "starfish",
        spacing: 0.05,
        linf_bar: 0.002,
        prototype: "112: 0.17 %",
        ..EVEN
    },
    Row {
        scene: "zigzag",
        spacing: 0.05,
        linf_bar: 0.0035,
        prototype: "112: 0.29 %",
        ..EVEN
    },
    Row {
        scene: "naca0015",
        spacing: 0.02,
        linf_bar: 0.004,
        prototype: "113: 0.29 % without its tail",
        ..EVEN
    },
    Row {
        scene: "sphere",
        prototype: "102: 0.32 %",
        ..SOLID
    },
    Row {
        scene: "ellipsoid",
        ..SOLID
    },
    Row {
        scene: "sphere",
        evaluations: 350,
        patient: true,
        linf_bar: 0.0015,
        prototype: "312: 0.10 %",
        quick: false,
        ..EVEN
    },
    Row {
        scene: "ellipsoid",
        evaluations: 350,
        patient: true,
        linf_bar: 0.0015,
        quick: false,
        ..EVEN
    },
    Row {
        scene: "sphere",
        finish: Finish::Consistent,
        evaluations: 600,
        linf_bar: 0.005,
        rms_bar: Some(1e-4),
        quick: false,
        ..EVEN
    },
    Row {
        scene: "ellipsoid",
        finish: Finish::Consistent,
        evaluations: 600,
        linf_bar: 0.005,
        rms_bar: Some(1e-4),
        quick: false,
        ..EVEN
    },
    Row {
        scene: "cube",
        linf_bar: 0.006,
        prototype: "103: 0.29 %",
        ..EVEN
    },
    Row {
        spacing: 0.05,
        prototype: "103: 0.37 %, 99 %: 0.23 %",
        ..BUNNY
    },
    Row {
        spacing: 0.02,
        ..BUNNY
    },
    Row {
        scene: "cylinder",
        spacing: 0.1,
        prototype: "–",
        quick: true,
        ..CORRECTED
    },
    Row {
        scene: "starfish",
        spacing: 0.05,
        prototype: "0.041 % at ±1.4 %",
        quick: true,
        ..CORRECTED
    },
    Row {
        scene: "zigzag",
        spacing: 0.05,
        prototype: "–",
        quick: false,
        ..CORRECTED
    },
    Row {
        scene: "sphere",
        spacing: 0.1,
        prototype: "–",
        quick: false,
        ..CORRECTED
    },
    Row {
        scene: "ellipsoid",
        spacing: 0.1,
        prototype: "–",
        quick: false,
        ..CORRECTED
    },
    BOTH,
    Row {
        spacing: 0.05,
        ..BOTH
    },
    Row {
        spacing: 0.025,
        quick: false,
        ..BOTH
    },
    Row {
        scene: "square",
        spacing: 0.05,
        ..BOTH
    },
    Row {
        scene: "starfish",
        spacing: 0.05,
        quick: false,
        ..BOTH
    },
    Row {
        scene: "zigzag",
        spacing: 0.05,
        quick: false,
        ..BOTH
    },
    Row {
        scene: "naca0015",
        spacing: 0.02,
        quick: false,
        ..BOTH
    },
    Row {
        scene: "sphere",
        quick: false,
        ..BOTH
    },
    CALM,
    Row {
        spacing: 0.05,
        ..CALM
    },
];
