//! The shapes that a scene can name.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// The shape of a body; all lengths in scene units, before the body's scale, rotation and translation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
#[non_exhaustive]
pub enum Shape {
    /// 2-D.
    Circle {
        /// Centre.
        center: Vec<f64>,
        /// Radius.
        radius: f64,
    },
    /// 2-D, axes along x and y.
    Ellipse {
        /// Centre.
        center: Vec<f64>,
        /// Half lengths.
        semi_axes: Vec<f64>,
    },
    /// 2-D or 3-D.
    Box {
        /// Lower corner.
        min: Vec<f64>,
        /// Upper corner.
        max: Vec<f64>,
    },
    /// 2-D, one closed loop in either order.
    Polygon {
        /// Corners.
        points: Vec<Vec<f64>>,
    },
    /// 2-D, r = radius (1 + amplitude cos(arms θ)).
    Starfish {
        /// Centre.
        center: Vec<f64>,
        /// Mean radius.
        radius: f64,
        /// How far the arms reach, over the radius.
        amplitude: f64,
        /// How many.
        arms: u32,
    },
    /// 2-D, a wall with a triangular wave on top.
    Zigzag {
        /// Length of the wall.
        width: f64,
        /// From its foot to the middle of the wave.
        height: f64,
        /// Half the height of the wave.
        amplitude: f64,
        /// Whole periods.
        teeth: u32,
    },
    /// 2-D, leading edge at the origin, chord along +x.
    Naca {
        /// Four digits.
        digits: String,
        /// Length.
        chord: f64,
    },
    /// 3-D.
    Sphere {
        /// Centre.
        center: Vec<f64>,
        /// Radius.
        radius: f64,
    },
    /// 3-D, axes along x, y and z.
    Ellipsoid {
        /// Centre.
        center: Vec<f64>,
        /// Half lengths.
        semi_axes: Vec<f64>,
    },
    /// 3-D, with flat ends.
    Cylinder {
        /// Middle of one end.
        start: Vec<f64>,
        /// Middle of the other end.
        end: Vec<f64>,
        /// Radius.
        radius: f64,
    },
    /// 3-D.
    Torus {
        /// Centre.
        center: Vec<f64>,
        /// Direction of the axis, of any length.
        axis: Vec<f64>,
        /// From the axis to the middle of the tube.
        major: f64,
        /// Radius of the tube.
        minor: f64,
    },
    /// A mesh (3-D: STL, OBJ, PLY) or an outline (2-D: rows of x,y, an airfoil, SVG), relative to the scene's file.
    File(PathBuf),
}

/// A line of the table of shapes.
#[derive(Debug, Clone, Copy)]
pub struct ShapeInfo {
    /// The name that scenes use.
    pub name: &'static str,
    /// "2-D", "3-D" or both.
    pub dimensions: &'static str,
    /// How to write it.
    pub example: &'static str,
}

/// Every shape.
pub const SHAPES: [ShapeInfo; 12] = {
    const fn shape(
        name: &'static str,
        dimensions: &'static str,
        example: &'static str,
    ) -> ShapeInfo {
        ShapeInfo {
            name,
            dimensions,
            example,
        }
    }
    [
        shape(
            "circle",
            "2-D",
            "{ circle = { center = [0, 0], radius = 1 } }",
        ),
        shape(
            "ellipse",
            "2-D",
            "{ ellipse = { center = [0, 0], semi_axes = [1, 0.5] } }",
        ),
        shape(
            "box",
            "2-D, 3-D",
            "{ box = { min = [-1, -1], max = [1, 1] } }",
        ),
        shape(
            "polygon",
            "2-D",
            "{ polygon = { points = [[0, 0], [1, 0], [0, 1]] } }",
        ),
        shape(
            "starfish",
            "2-D",
            "{ starfish = { center = [0, 0], radius = 0.5, amplitude = 0.25, arms = 5 } }",
        ),
        shape(
            "zigzag",
            "2-D",
            "{ zigzag = { width = 2, height = 1, amplitude = 0.25, teeth = 2 } }",
        ),
        shape("naca", "2-D", "{ naca = { digits = \"0015\", chord = 1 } }"),
        shape(
            "sphere",
            "3-D",
            "{ sphere = { center = [0, 0, 0], radius = 1 } }",
        ),
        shape(
            "ellipsoid",
            "3-D",
            "{ ellipsoid = { center = [0, 0, 0], semi_axes = [1, 0.5, 0.75] } }",
        ),
        shape(
            "cylinder",
            "3-D",
            "{ cylinder = { start = [0, 0, 0], end = [0, 0, 1], radius = 0.5 } }",
        ),
        shape(
            "torus",
            "3-D",
            "{ torus = { center = [0, 0, 0], axis = [0, 0, 1], major = 1, minor = 0.3 } }",
        ),
        shape(
            "file",
            "2-D, 3-D",
            "{ file = \"body.stl\" } (3-D: .stl, .obj, .ply) or { file = \"outline.csv\" } (2-D: .csv, .dat, .svg)",
        ),
    ]
};

impl Shape {
    /// The name that scenes use.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Circle { .. } => "circle",
            Self::Ellipse { .. } => "ellipse",
            Self::Box { .. } => "box",
            Self::Polygon { .. } => "polygon",
            Self::Starfish { .. } => "starfish",
            Self::Zigzag { .. } => "zigzag",
            Self::Naca { .. } => "naca",
            Self::Sphere { .. } => "sphere",
            Self::Ellipsoid { .. } => "ellipsoid",
            Self::Cylinder { .. } => "cylinder",
            Self::Torus { .. } => "torus",
            Self::File(_) => "file",
        }
    }

    /// 2 or 3, or `None` for a file, which must be looked into first.
    pub fn dimension(&self) -> Option<usize> {
        match self {
            Self::Circle { .. }
            | Self::Ellipse { .. }
            | Self::Polygon { .. }
            | Self::Starfish { .. }
            | Self::Zigzag { .. }
            | Self::Naca { .. } => Some(2),
            Self::Sphere { .. }
            | Self::Ellipsoid { .. }
            | Self::Cylinder { .. }
            | Self::Torus { .. } => Some(3),
            Self::Box { min, .. } => Some(if min.len() == 2 { 2 } else { 3 }),
            Self::File(_) => None,
        }
    }

    /// The file, where the shape is one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            _ => None,
        }
    }

    /// The vectors among the parameters, by name.
    pub(crate) fn vectors(&self) -> Vec<(&'static str, &Vec<f64>)> {
        match self {
            Self::Circle { center, .. }
            | Self::Starfish { center, .. }
            | Self::Sphere { center, .. } => vec![("center", center)],
            Self::Ellipse { center, semi_axes } | Self::Ellipsoid { center, semi_axes } => {
                vec![("center", center), ("semi_axes", semi_axes)]
            }
            Self::Box { min, max } => vec![("min", min), ("max", max)],
            Self::Cylinder { start, end, .. } => vec![("start", start), ("end", end)],
            Self::Torus { center, axis, .. } => vec![("center", center), ("axis", axis)],
            Self::Polygon { .. } | Self::Zigzag { .. } | Self::Naca { .. } | Self::File(_) => {
                Vec::new()
            }
        }
    }

    /// The lengths among the parameters, by name; all must be positive.
    pub(crate) fn lengths(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Circle { radius, .. }
            | Self::Sphere { radius, .. }
            | Self::Starfish { radius, .. }
            | Self::Cylinder { radius, .. } => vec![("radius", radius)],
            Self::Zigzag {
                width,
                height,
                amplitude,
                ..
            } => vec![
                ("width", width),
                ("height", height),
                ("amplitude", amplitude),
            ],
            Self::Naca { chord, .. } => vec![("chord", chord)],
            Self::Torus { major, minor, .. } => vec![("major", major), ("minor", minor)],
            Self::Ellipse { .. }
            | Self::Ellipsoid { .. }
            | Self::Box { .. }
            | Self::Polygon { .. }
            | Self::File(_) => Vec::new(),
        }
    }
}
