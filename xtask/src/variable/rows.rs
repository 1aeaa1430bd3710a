//! The scenes of variable spacing, with their bars.

use std::fmt::Write as _;

/// A scene and its bars; parts of one unless said otherwise.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// As `--only` names it.
    pub(super) scene: &'static str,
    /// What is special.
    pub(super) what: &'static str,
    /// The finest and the coarsest spacing, and growth.
    pub(super) spacings: [f64; 2],
    pub(super) growth: f64,
    /// Tables of the scene behind `refinement`.
    pub(super) text: &'static str,
    /// Of ∣Γ − 1∣: the largest, of 99 %, root mean square.
    pub(super) density: [f64; 3],
    /// Of h∣∇Γ∣ of free particles: the largest, root mean square; where it is judged.
    pub(super) residual: Option<[f64; 2]>,
    /// The nearest pair with a free particle, in sizes.
    pub(super) closest: f64,
    /// Evaluations.
    pub(super) evaluations: usize,
    /// Whether it runs with `--quick`.
    pub(super) quick: bool,
}

macro_rules! circle {
    ($x:literal, $y:literal) => {
        concat!(
            "
[domain]
min = [-4.0, -4.0]
max = [4.0, 4.0]
[[body]]
name = \"circle\"
shape = { circle = { center = [",
            $x,
            ", ",
            $y,
            "], radius = 1.0 } }
"
        )
    };
}

const CIRCLE: &str = circle!("0.0", "0.0");

const PERIODIC: &str = "
[domain]
min = [-4.0, -4.0]
max = [4.0, 4.0]
periodic = [true, true]
[[body]]
name = \"circle\"
shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
";

const USUAL: Row = Row {
    scene: "circle",
    what: "R = 1 in an open box of 8 × 8",
    spacings: [0.02, 0.2],
    growth: 1.08,
    text: CIRCLE,
    density: [2e-3, 8e-4, 3e-4],
    residual: Some([3e-2, 6e-3]),
    closest: 0.78,
    evaluations: 130,
    quick: false,
};

/// In the order of the table.
pub(super) const ROWS: [Row; 24] = [
    Row {
        growth: 1.02,
        ..USUAL
    },
    Row {
        growth: 1.05,
        ..USUAL
    },
    Row {
        quick: true,
        ..USUAL
    },
    Row {
        growth: 1.1,
        ..USUAL
    },
    Row {
        growth: 1.2,
        density: [3e-3, 1.2e-3, 4e-4],
        residual: None,
        evaluations: 140,
        closest: 0.7,
        ..USUAL
    },
    Row {
        growth: 1.3,
        density: [4e-3, 1.6e-3, 6e-4],
        residual: None,
        evaluations: 140,
        closest: 0.7,
        ..USUAL
    },
    Row {
        what: "the same, periodic",
        text: PERIODIC,
        ..USUAL
    },
    Row {
        scene: "shifted",
        what: "the circle at 0.0137, 0.0291",
        growth: 1.1,
        text: circle!("0.0137", "0.0291"),
        ..USUAL
    },
    Row {
        scene: "shifted",
        what: "the circle at -0.0424, 0.0113",
        growth: 1.1,
        text: circle!("-0.0424", "0.0113"),
        ..USUAL
    },
    Row {
        scene: "shifted",
        what: "the circle at 0.0618, -0.0382",
        growth: 1.1,
        text: circle!("0.0618", "-0.0382"),
        ..USUAL
    },
    Row {
        scene: "shifted",
        what: "the circle at -0.0271, -0.0577",
        growth: 1.1,
        text: circle!("-0.0271", "-0.0577"),
        ..USUAL
    },
    Row {
        what: "50 : 1",
        spacings: [0.004, 0.2],
        ..USUAL
    },
    Row {
        scene: "wing",
        what: "NACA0015 in 3 × 3",
        spacings: [0.005, 0.1],
        text: "
[domain]
min = [-1.0, -1.5]
max = [2.0, 1.5]
[[body]]
name = \"wing\"
shape = { naca = { digits = \"0015\", chord = 1.0 } }
",
        quick: true,
        ..USUAL
    },
    Row {
        scene: "far wing",
        what: "NACA0015, c/1000 … c/20, in 10 × 10",
        spacings: [0.001, 0.05],
        text: "
[domain]
min = [-4.5, -5.0]
max = [5.5, 5.0]
[[body]]
name = \"wing\"
shape = { naca = { digits = \"0015\", chord = 1.0 } }
",
        ..USUAL
    },
    Row {
        scene: "region",
        what: "a finer box, 4 : 1, no body",
        spacings: [0.2, 0.2],
        growth: 1.1,
        text: "region = [{ shape = { box = { min = [-0.5, -0.5], max = [0.5, 0.5] } }, spacing = 0.05 }]
[domain]
min = [-2.0, -2.0]
max = [2.0, 2.0]
",
        quick: true,
        ..USUAL
    },
    Row {
        scene: "hat",
        what: "a field from a file, 4 : 1, ln s a cosine of the distance from the middle; no body",
        spacings: [0.08, 0.08],
        growth: 1.15,
        text: "field = \"hat.csv\"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
",
        quick: true,
        ..USUAL
    },
    Row {
        scene: "bent",
        what: "an ellipse with ten particles per radius of curvature",
        spacings: [0.1, 0.2],
        text: "finest = 0.005
[domain]
min = [-2.0, -1.5]
max = [2.0, 1.5]
[[body]]
name = \"ellipse\"
curvature = 10
shape = { ellipse = { center = [0.0, 0.0], semi_axes = [1.0, 0.25] } }
",
        quick: true,
        ..USUAL
    },
    Row {
        scene: "edge",
        what: "an ellipse whose tip a region makes five times finer",
        spacings: [0.05, 0.2],
        text: "region = [{ shape = { circle = { center = [-1.0, 0.0], radius = 0.1 } }, spacing = 0.01 }]
[domain]
min = [-2.5, -2.0]
max = [2.5, 2.0]
[[body]]
name = \"ellipse\"
shape = { ellipse = { center = [0.0, 0.0], semi_axes = [1.0, 0.4] } }
",
        quick: true,
        ..USUAL
    },
    Row {
        scene: "two",
        what: "two discs, one four times finer, 0.1 apart",
        spacings: [0.04, 0.2],
        text: "
[domain]
min = [-2.0, -2.0]
max = [2.5, 2.0]
[[body]]
name = \"coarse\"
shape = { circle = { center = [-0.6, 0.0], radius = 0.6 } }
[[body]]
name = \"fine\"
spacing = 0.01
shape = { circle = { center = [0.4, 0.0], radius = 0.3 } }
",
        ..USUAL
    },
    Row {
        scene: "square",
        what: "corners; a side of 1 in 4 × 4",
        spacings: [0.02, 0.15],
        text: "
[domain]
min = [-2.0, -2.0]
max = [2.0, 2.0]
[[body]]
name = \"square\"
shape = { box = { min = [-0.5, -0.5], max = [0.5, 0.5] } }
",
        ..USUAL
    },
    Row {
        scene: "sphere",
        what: "R = 0.5 in 4³",
        spacings: [0.05, 0.2],
        text: "
[domain]
min = [-2.0, -2.0, -2.0]
max = [2.0, 2.0, 2.0]
[[body]]
name = \"ball\"
shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 0.5 } }
",
        ..USUAL
    },
    Row {
        scene: "small sphere",
        what: "R = 0.5 in 2³",
        spacings: [0.1, 0.2],
        text: "
[domain]
min = [-1.0, -1.0, -1.0]
max = [1.0, 1.0, 1.0]
[[body]]
name = \"ball\"
shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 0.5 } }
",
        quick: true,
        ..USUAL
    },
    Row {
        scene: "spot",
        what: "a mesh, 8 : 1",
        spacings: [0.04, 0.32],
        text: "
[domain]
margin = 1.0
[[body]]
name = \"spot\"
shape = { file = \"spot.stl\" }
",
        ..USUAL
    },
    Row {
        scene: "bunny",
        what: "a mesh, 8 : 1",
        spacings: [0.03, 0.24],
        text: "
[domain]
margin = 1.0
[[body]]
name = \"bunny\"
scale = 10.0
shape = { file = \"bunny.stl\" }
",
        ..USUAL
    },
];

impl Row {
    /// The scene as text.
    pub(super) fn toml(&self) -> String {
        let [finest, coarsest] = self.spacings;
        format!(
            "spacing = {finest:?}\n[refinement]\ncoarsest = {coarsest:?}\ngrowth = {:?}\n{}",
            self.growth, self.text
        )
    }
}

/// The file of the row whose field is a hat: the middle four times finer than the rim.
pub(super) fn hat() -> String {
    let mut text = "x,y,spacing\n".to_owned();
    let half = 24;
    for i in -half..=half {
        for j in -half..=half {
            let [x, y] = [i, j].map(|k| f64::from(k) / f64::from(half));
            let angle = std::f64::consts::PI * x.hypot(y).min(1.0);
            let spacing = 0.04 * (-(2.0_f64.ln()) * angle.cos()).exp();
            let _ = writeln!(text, "{x},{y},{spacing}");
        }
    }
    text
}
