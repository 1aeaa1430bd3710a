//! The shapes of random scenes: as scenes write them, and as files hold them.

use std::fmt::Write;

/// How an outline is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OutlineFormat {
    Csv,
    Svg,
}

/// How a mesh is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MeshFormat {
    StlText,
    StlBinary,
    Obj,
    Ply,
}

/// A shape, before the body's scale, rotation and translation.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Shape {
    Circle {
        center: [f64; 2],
        radius: f64,
    },
    Ellipse {
        center: [f64; 2],
        semi_axes: [f64; 2],
    },
    /// In the plane or in space.
    Box {
        min: Vec<f64>,
        max: Vec<f64>,
    },
    Polygon {
        points: Vec<[f64; 2]>,
    },
    Starfish {
        center: [f64; 2],
        radius: f64,
        amplitude: f64,
        arms: u32,
    },
    Zigzag {
        width: f64,
        height: f64,
        amplitude: f64,
        teeth: u32,
    },
    Naca {
        digits: &'static str,
        chord: f64,
    },
    Sphere {
        center: [f64; 3],
        radius: f64,
    },
    Ellipsoid {
        center: [f64; 3],
        semi_axes: [f64; 3],
    },
    Cylinder {
        start: [f64; 3],
        end: [f64; 3],
        radius: f64,
    },
    Torus {
        center: [f64; 3],
        axis: [f64; 3],
        major: f64,
        minor: f64,
    },
    /// Rows of x and y, or a drawing; the second loop and those after it are holes.
    Outline {
        loops: Vec<Vec<[f64; 2]>>,
        format: OutlineFormat,
    },
    /// A file of an airfoil's coordinates, of chord 1; larger by the body's scale.
    Airfoil {
        points: Vec<[f64; 2]>,
    },
    Mesh {
        points: Vec<[f64; 3]>,
        triangles: Vec<[usize; 3]>,
        format: MeshFormat,
    },
}

/// x·u + o: the one formula by which all numbers are placed, so that what touches still touches.
fn placed<const D: usize>(p: [f64; D], unit: f64, origin: &[f64]) -> [f64; D] {
    std::array::from_fn(|k| p[k] * unit + origin[k])
}

impl Shape {
    #[cfg(test)]
    pub(super) fn dimension(&self) -> usize {
        match self {
            Self::Box { min, .. } => min.len(),
            Self::Sphere { .. }
            | Self::Ellipsoid { .. }
            | Self::Cylinder { .. }
            | Self::Torus { .. }
            | Self::Mesh { .. } => 3,
            _ => 2,
        }
    }

    /// Whether it has coordinates that can be shifted; the others need the body's translation.
    pub(super) fn can_shift(&self) -> bool {
        !matches!(
            self,
            Self::Zigzag { .. } | Self::Naca { .. } | Self::Airfoil { .. }
        )
    }

    /// Its lengths times `unit`, its places shifted too. An airfoil's file stays as it is.
    pub(super) fn placed(&self, unit: f64, origin: &[f64]) -> Self {
        let mut new = self.clone();
        match &mut new {
            Self::Circle { center, radius } => {
                *center = placed(*center, unit, origin);
                *radius *= unit;
            }
            Self::Ellipse { center, semi_axes } => {
                *center = placed(*center, unit, origin);
                *semi_axes = semi_axes.map(|x| x * unit);
            }
            Self::Box { min, max } => {
                for corner in [min, max] {
                    for (x, o) in corner.iter_mut().zip(origin) {
                        *x = *x * unit + o;
                    }
                }
            }
            Self::Polygon { points } => {
                for p in points {
                    *p = placed(*p, unit, origin);
                }
            }
            Self::Starfish { center, radius, .. } => {
                *center = placed(*center, unit, origin);
                *radius *= unit;
            }
            Self::Zigzag {
                width,
                height,
                amplitude,
                ..
            } => {
                for x in [width, height, amplitude] {
                    *x *= unit;
                }
            }
            Self::Naca { chord, .. } => *chord *= unit,
            Self::Sphere { center, radius } => {
                *center = placed(*center, unit, origin);
                *radius *= unit;
            }
            Self::Ellipsoid { center, semi_axes } => {
                *center = placed(*center, unit, origin);
                *semi_axes = semi_axes.map(|x| x * unit);
            }
            Self::Cylinder { start, end, radius } => {
                *start = placed(*start, unit, origin);
                *end = placed(*end, unit, origin);
                *radius *= unit;
            }
            Self::Torus {
                center,
                major,
                minor,
                ..
            } => {
                *center = placed(*center, unit, origin);
                *major *= unit;
                *minor *= unit;
            }
            Self::Outline { loops, .. } => {
                for p in loops.iter_mut().flatten() {
                    *p = placed(*p, unit, origin);
                }
            }
            Self::Airfoil { .. } => {}
            Self::Mesh { points, .. } => {
                for p in points {
                    *p = placed(*p, unit, origin);
                }
            }
        }
        new
    }

    /// As a scene writes it; `name` is that of its file, without the ending.
    pub(super) fn toml(&self, name: &str) -> String {
        match self {
            Self::Circle { center, radius } => {
                format!("{{ circle = {{ center = {center:?}, radius = {radius:?} }} }}")
            }
            Self::Ellipse { center, semi_axes } => {
                format!("{{ ellipse = {{ center = {center:?}, semi_axes = {semi_axes:?} }} }}")
            }
            Self::Box { min, max } => format!("{{ box = {{ min = {min:?}, max = {max:?} }} }}"),
            Self::Polygon { points } => format!("{{ polygon = {{ points = {points:?} }} }}"),
            Self::Starfish {
                center,
                radius,
                amplitude,
                arms,
            } => format!(
                "{{ starfish = {{ center = {center:?}, radius = {radius:?}, amplitude = {amplitude:?}, arms = {arms} }} }}"
            ),
            Self::Zigzag {
                width,
                height,
                amplitude,
                teeth,
            } => format!(
                "{{ zigzag = {{ width = {width:?}, height = {height:?}, amplitude = {amplitude:?}, teeth = {teeth} }} }}"
            ),
            Self::Naca { digits, chord } => {
                format!("{{ naca = {{ digits = {digits:?}, chord = {chord:?} }} }}")
            }
            Self::Sphere { center, radius } => {
                format!("{{ sphere = {{ center = {center:?}, radius = {radius:?} }} }}")
            }
            Self::Ellipsoid { center, semi_axes } => {
                format!("{{ ellipsoid = {{ center = {center:?}, semi_axes = {semi_axes:?} }} }}")
            }
            Self::Cylinder { start, end, radius } => format!(
                "{{ cylinder = {{ start = {start:?}, end = {end:?}, radius = {radius:?} }} }}"
            ),
            Self::Torus {
                center,
                axis,
                major,
                minor,
            } => format!(
                "{{ torus = {{ center = {center:?}, axis = {axis:?}, major = {major:?}, minor = {minor:?} }} }}"
            ),
            Self::Outline { .. } | Self::Airfoil { .. } | Self::Mesh { .. } => format!(
                "{{ file = \"{name}.{}\" }}",
                self.ending().unwrap_or_default()
            ),
        }
    }

    /// The ending of its file, where it has one.
    pub(super) fn ending(&self) -> Option<&'static str> {
        match self {
            Self::Outline {
                format: OutlineFormat::Csv,
                ..
            } => Some("csv"),
            Self::Outline { .. } => Some("svg"),
            Self::Airfoil { .. } => Some("dat"),
            Self::Mesh { format, .. } => Some(match format {
                MeshFormat::StlText | MeshFormat::StlBinary => "stl",
                MeshFormat::Obj => "obj",
                MeshFormat::Ply => "ply",
            }),
            _ => None,
        }
    }

    /// The content of its file, where it has one.
    pub(super) fn file(&self) -> Option<Vec<u8>> {
        match self {
            Self::Outline { loops, format } => Some(outline_file(loops, *format).into_bytes()),
            Self::Airfoil { points } => {
                let mut text = "an airfoil\n".to_owned();
                for [x, y] in points {
                    let _ = writeln!(text, " {x:.6}  {y:.6}");
                }
                Some(text.into_bytes())
            }
            Self::Mesh {
                points,
                triangles,
                format,
            } => Some(mesh_file(points, triangles, *format)),
            _ => None,
        }
    }
}

fn outline_file(loops: &[Vec<[f64; 2]>], format: OutlineFormat) -> String {
    let mut text = String::new();
    match format {
        OutlineFormat::Csv => {
            for points in loops {
                for [x, y] in points {
                    let _ = writeln!(text, "{x:?},{y:?}");
                }
                text.push('\n');
            }
        }
        OutlineFormat::Svg => {
            text.push_str("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 100\">\n<path fill-rule=\"evenodd\" d=\"");
            for points in loops {
                for (k, [x, y]) in points.iter().enumerate() {
                    // Drawings have y downward.
                    let _ = write!(text, "{} {x:?} {:?} ", if k == 0 { 'M' } else { 'L' }, -y);
                }
                text.push_str("Z ");
            }
            text.push_str("\"/>\n</svg>\n");
        }
    }
    text
}

fn mesh_file(points: &[[f64; 3]], triangles: &[[usize; 3]], format: MeshFormat) -> Vec<u8> {
    let mut text = String::new();
    match format {
        MeshFormat::StlText => {
            text.push_str("solid body\n");
            for t in triangles {
                text.push_str("facet normal 0 0 0\nouter loop\n");
                for &k in t {
                    let [x, y, z] = points[k];
                    let _ = writeln!(text, "vertex {x:?} {y:?} {z:?}");
                }
                text.push_str("endloop\nendfacet\n");
            }
            text.push_str("endsolid body\n");
        }
        MeshFormat::StlBinary => {
            let mut bytes = vec![0u8; 80];
            bytes.extend((triangles.len() as u32).to_le_bytes());
            for t in triangles {
                bytes.extend([0u8; 12]);
                for &k in t {
                    for x in points[k] {
                        bytes.extend((x as f32).to_le_bytes());
                    }
                }
                bytes.extend([0u8; 2]);
            }
            return bytes;
        }
        MeshFormat::Obj => {
            for [x, y, z] in points {
                let _ = writeln!(text, "v {x:?} {y:?} {z:?}");
            }
            for [a, b, c] in triangles {
                let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
            }
        }
        MeshFormat::Ply => {
            let _ = write!(
                text,
                "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
                points.len(),
                triangles.len()
            );
            for [x, y, z] in points {
                let _ = writeln!(text, "{x:?} {y:?} {z:?}");
            }
            for [a, b, c] in triangles {
                let _ = writeln!(text, "3 {a} {b} {c}");
            }
        }
    }
    text.into_bytes()
}
