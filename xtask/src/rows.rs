//! The rows of the reproduction: what paper 001 prints, and the bar for our hybrid method.

/// A figure that a row is judged by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Figure {
    /// max Γ − min Γ.
    TotalVariation,
    /// max |Γ − 1|.
    Linf,
    /// Largest distance of a surface particle from the surface, in ∆s.
    SurfaceDistance,
}

impl Figure {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::TotalVariation => "total variation of Γ",
            Self::Linf => "L∞(Γ − 1)",
            Self::SurfaceDistance => "distance from the surface / ∆s",
        }
    }
}

/// One run and its judgement.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row {
    /// The scene's file in `scenes`, without extension.
    pub(crate) scene: &'static str,
    /// ∆s.
    pub(crate) spacing: f64,
    /// Factor on all lengths but ∆s (the starfish at radius 1).
    pub(crate) enlarged: f64,
    /// h/∆s.
    pub(crate) h_over_spacing: f64,
    /// ε.
    pub(crate) tolerance: f64,
    /// What the paper says.
    pub(crate) published: &'static str,
    /// What is judged.
    pub(crate) figure: Figure,
    /// The most that passes.
    pub(crate) bar: f64,
    /// Whether it runs with `--quick`.
    pub(crate) quick: bool,
}

const BASE: Row = Row {
    scene: "",
    spacing: 0.1,
    enlarged: 1.0,
    h_over_spacing: 1.2,
    tolerance: 1e-4,
    published: "",
    figure: Figure::TotalVariation,
    bar: 0.0,
    quick: true,
};

/// Every row, in the paper's order.
pub(crate) const ROWS: [Row; 18] = [
    Row {
        scene: "cylinder",
        h_over_spacing: 1.0,
        published: "2 %",
        bar: 0.02,
        ..BASE
    },
    Row {
        scene: "cylinder",
        published: "2 %",
        bar: 0.02,
        ..BASE
    },
    Row {
        scene: "zigzag",
        spacing: 0.05,
        h_over_spacing: 1.0,
        published: "3 %",
        bar: 0.03,
        quick: false,
        ..BASE
    },
    Row {
        scene: "zigzag",
        spacing: 0.05,
        published: "3 %",
        bar: 0.03,
        ..BASE
    },
    Row {
        scene: "starfish",
        spacing: 0.1,
        published: "2.5 %",
        bar: 0.025,
        ..BASE
    },
    Row {
        scene: "starfish",
        spacing: 0.075,
        published: "2 %",
        bar: 0.02,
        ..BASE
    },
    Row {
        scene: "starfish",
        spacing: 0.05,
        published: "3 %",
        bar: 0.03,
        ..BASE
    },
    Row {
        scene: "starfish",
        spacing: 0.1,
        enlarged: 2.0,
        published: "2.5 %",
        bar: 0.025,
        ..BASE
    },
    Row {
        scene: "starfish",
        spacing: 0.075,
        enlarged: 2.0,
        published: "2 %",
        bar: 0.02,
        ..BASE
    },
    Row {
        scene: "starfish",
        spacing: 0.05,
        enlarged: 2.0,
        published: "3 %",
        bar: 0.03,
        quick: false,
        ..BASE
    },
    Row {
        scene: "starfish",
        spacing: 0.1,
        h_over_spacing: 1.0,
        published: "2.5 %",
        bar: 0.025,
        quick: false,
        ..BASE
    },
    Row {
        scene: "naca0015",
        spacing: 0.02,
        published: "0.028 in 1191",
        figure: Figure::Linf,
        bar: 0.028,
        ..BASE
    },
    Row {
        scene: "naca0015",
        spacing: 0.02,
        tolerance: 5e-5,
        published: "0.019 in 6291",
        figure: Figure::Linf,
        bar: 0.019,
        ..BASE
    },
    Row {
        scene: "naca0015",
        spacing: 0.02,
        tolerance: 2.5e-5,
        published: "0.011 in 19641",
        figure: Figure::Linf,
        bar: 0.011,
        quick: false,
        ..BASE
    },
    Row {
        scene: "ellipsoid",
        published: "very close to 1",
        figure: Figure::Linf,
        bar: 0.04,
        ..BASE
    },
    Row {
        scene: "sphere",
        published: "–",
        figure: Figure::Linf,
        bar: 0.04,
        quick: false,
        ..BASE
    },
    Row {
        scene: "bunny",
        spacing: 0.05,
        published: "–",
        figure: Figure::SurfaceDistance,
        bar: 0.05,
        quick: false,
        ..BASE
    },
    Row {
        scene: "bunny",
        spacing: 0.02,
        published: "a picture",
        figure: Figure::SurfaceDistance,
        bar: 0.05,
        quick: false,
        ..BASE
    },
];
