//! Where the bodies of a scene truly are: brute force and textbook formulas, nothing of the product's own.

mod loops;
mod place;
mod solids;
mod triangles;
mod volumes;

use super::airfoil;
use super::case::{Body, Case, Role, Sides};
use super::shape::{MeshFormat, Shape};
use loops::Loops;
use place::Place;
use solids::Smooth;
use triangles::Triangles;

/// A point; z is 0 in the plane.
pub(super) type Point = [f64; 3];

/// A body's extent.
#[derive(Debug, Clone)]
enum Form {
    Plane(Loops),
    Smooth(Smooth, Place),
    Mesh(Triangles),
}

/// A body.
#[derive(Debug, Clone)]
pub(super) struct True {
    pub(super) name: String,
    pub(super) role: Role,
    pub(super) precedence: i32,
    /// In ∆s.
    pub(super) inset: f64,
    form: Form,
}

impl True {
    fn new(body: &Body, spacing: f64) -> Self {
        let place = Place::of(body);
        let plane = |loops: Vec<Vec<[f64; 2]>>| {
            let turned = loops.into_iter().map(|points| {
                points
                    .into_iter()
                    .map(|[x, y]| {
                        let [x, y, _] = place.out([x, y, 0.0]);
                        [x, y]
                    })
                    .collect()
            });
            Form::Plane(Loops::new(turned.collect()))
        };
        // Curves are followed to 10⁻⁴ ∆s.
        let fine = 1e-4 * spacing / body.scale;
        let ring = |center: [f64; 2], a: [f64; 2]| {
            loops::curve(fine, a[0].max(a[1]), |t| {
                [center[0] + a[0] * t.cos(), center[1] + a[1] * t.sin()]
            })
        };
        let smooth = |form: Smooth| Form::Smooth(form, place.clone());
        let form = match body.meant.as_ref().unwrap_or(&body.shape) {
            Shape::Circle { center, radius } => plane(vec![ring(*center, [*radius; 2])]),
            Shape::Ellipse { center, semi_axes } => plane(vec![ring(*center, *semi_axes)]),
            Shape::Box { min, max } if min.len() == 2 => plane(vec![vec![
                [min[0], min[1]],
                [max[0], min[1]],
                [max[0], max[1]],
                [min[0], max[1]],
            ]]),
            Shape::Box { min, max } => smooth(Smooth::Cuboid {
                min: std::array::from_fn(|k| min[k]),
                max: std::array::from_fn(|k| max[k]),
            }),
            Shape::Polygon { points } => plane(vec![points.clone()]),
            Shape::Starfish {
                center,
                radius,
                amplitude,
                arms,
            } => {
                let n = f64::from(*arms);
                let most = radius * (1.0 + amplitude * (1.0 + n) * (1.0 + n));
                plane(vec![loops::curve(fine, most, |t| {
                    let r = radius * (1.0 + amplitude * (n * t).cos());
                    [center[0] + r * t.cos(), center[1] + r * t.sin()]
                })])
            }
            Shape::Zigzag {
                width,
                height,
                amplitude,
                teeth,
            } => {
                let right = 0.5 * width;
                let mut points = vec![[-right, -height], [right, -height], [right, 0.0]];
                for k in 0..*teeth {
                    for (part, y) in [(0.25, *amplitude), (0.75, -*amplitude)] {
                        points.push([right - width * (f64::from(k) + part) / f64::from(*teeth), y]);
                    }
                }
                points.push([-right, 0.0]);
                plane(vec![points])
            }
            Shape::Naca { digits, chord } => {
                let points = airfoil::section(digits, 600);
                plane(vec![
                    points.into_iter().map(|p| p.map(|x| x * chord)).collect(),
                ])
            }
            Shape::Outline { loops, .. } => plane(loops.clone()),
            Shape::Airfoil { points } => plane(vec![points.clone()]),
            Shape::Sphere { center, radius } => smooth(Smooth::Ellipsoid {
                center: *center,
                semi_axes: [*radius; 3],
            }),
            Shape::Ellipsoid { center, semi_axes } => smooth(Smooth::Ellipsoid {
                center: *center,
                semi_axes: *semi_axes,
            }),
            Shape::Cylinder { start, end, radius } => smooth(Smooth::Cylinder {
                start: *start,
                end: *end,
                radius: *radius,
            }),
            Shape::Torus {
                center,
                axis,
                major,
                minor,
            } => smooth(Smooth::Torus {
                center: *center,
                axis: *axis,
                major: *major,
                minor: *minor,
            }),
            Shape::Mesh {
                points,
                triangles,
                format,
            } => {
                let kept = |x: f64| match format {
                    // What such a file can hold.
                    MeshFormat::StlBinary => f64::from(x as f32),
                    _ => x,
                };
                let points = points.iter().map(|p| place.out(p.map(kept))).collect();
                Form::Mesh(Triangles::new(points, triangles.clone()))
            }
        };
        Self {
            name: body.name.clone(),
            role: body.role,
            precedence: body.precedence,
            inset: body.inset(),
            form,
        }
    }

    /// Distance from the surface, negative inside.
    pub(super) fn distance(&self, p: Point) -> f64 {
        match &self.form {
            Form::Plane(loops) => loops.distance([p[0], p[1]]),
            Form::Smooth(smooth, place) => place.scale() * smooth.distance(place.back(p)),
            Form::Mesh(mesh) => mesh.distance(p),
        }
    }

    /// Area or volume, without cuts.
    fn volume(&self) -> f64 {
        match &self.form {
            Form::Plane(loops) => loops.area(),
            Form::Smooth(smooth, place) => place.scale().powi(3) * smooth.volume(),
            Form::Mesh(mesh) => mesh.volume(),
        }
    }

    /// A box around it.
    pub(super) fn bounds(&self) -> [Point; 2] {
        match &self.form {
            Form::Plane(loops) => loops.bounds(),
            Form::Smooth(smooth, place) => place.bounds(smooth.bounds()),
            Form::Mesh(mesh) => mesh.bounds(),
        }
    }
}

/// All bodies of a scene.
#[derive(Debug, Clone)]
pub(super) struct Truth {
    dimension: usize,
    pub(super) bodies: Vec<True>,
    /// The corners of the box, where the scene names them, and its periodic axes.
    sides: Option<([Point; 2], [bool; 3])>,
}

impl Truth {
    /// Of a scene that is placed.
    pub(super) fn new(case: &Case) -> Self {
        Self {
            dimension: case.dimension,
            bodies: case
                .bodies
                .iter()
                .map(|body| True::new(body, case.spacing))
                .collect(),
            sides: match &case.sides {
                Sides::Margin(_) => None,
                Sides::Corners(low, high) => {
                    let periodic = |k: usize| case.periodic.get(k).copied().unwrap_or(false);
                    let corner = |values: &[f64]| -> Point {
                        std::array::from_fn(|k| values.get(k).copied().unwrap_or(0.0))
                    };
                    Some(([corner(low), corner(high)], std::array::from_fn(periodic)))
                }
            },
        }
    }

    /// Where a body passes sides of the box, these and from it to its images across periodic ones, itself first.
    fn passes(&self, body: usize) -> Option<([Point; 2], Vec<Point>)> {
        let ([low, high], periodic) = self.sides?;
        let [min, max] = self.bodies[body].bounds();
        let mut axes = 0..self.dimension;
        let size: Point = std::array::from_fn(|k| high[k] - low[k]);
        let passes = axes.any(|k| {
            let slack = 1e-6 * size[k];
            min[k] < low[k] - slack || max[k] > high[k] + slack
        });
        if !passes {
            return None;
        }
        let mut shifts = vec![[0.0; 3]];
        for k in (0..self.dimension).filter(|&k| periodic[k]) {
            let more = shifts.clone().into_iter().flat_map(|shift: Point| {
                [-size[k], size[k]].map(|step| {
                    let mut shift = shift;
                    shift[k] += step;
                    shift
                })
            });
            shifts.extend(more.collect::<Vec<Point>>());
        }
        Some(([low, high], shifts))
    }

    /// Those that cut a solid body.
    fn cutters(&self, body: usize) -> impl Iterator<Item = &True> {
        let own = &self.bodies[body];
        self.bodies.iter().filter(move |other| {
            own.role == Role::Solid
                && other.role != Role::Container
                && other.precedence > own.precedence
        })
    }

    /// Distance from the surface of what is left of a body or of its images, negative inside. Inside it is exact, outside a
    /// lower bound.
    pub(super) fn distance(&self, body: usize, p: Point) -> f64 {
        match self.passes(body) {
            None => self.alone(body, p),
            Some((_, shifts)) => (shifts.iter())
                .map(|shift| self.alone(body, std::array::from_fn(|k| p[k] + shift[k])))
                .fold(f64::INFINITY, f64::min),
        }
    }

    fn alone(&self, body: usize, p: Point) -> f64 {
        self.cutters(body)
            .fold(self.bodies[body].distance(p), |d, other| {
                d.max(-other.distance(p))
            })
    }

    /// Area or volume of what is left of a body, in the box.
    pub(super) fn volume(&self, body: usize) -> f64 {
        let own = self.bodies[body].bounds();
        let is_cut = self.cutters(body).any(|other| {
            let theirs = other.bounds();
            (0..self.dimension).all(|k| own[0][k].max(theirs[0][k]) < own[1][k].min(theirs[1][k]))
        });
        if let Some(([low, high], _)) = self.passes(body) {
            volumes::in_box(self, body, [low, high])
        } else if is_cut {
            volumes::of_what_is_left(self, body)
        } else {
            self.bodies[body].volume()
        }
    }
}

#[cfg(test)]
mod tests;
