//! The shapes of a scene as surfaces, in the plane and in space.

use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

use sphpack_geometry::{
    Ball, Cuboid, Cylinder, Ellipsoid, GeometryError, Outline, ParameterError, Placed, ReadError,
    Similarity, Sketch, Soup, Surface, Torus,
};
use sphpack_neighbors::point;
use sphpack_packing::Method;

use crate::body_file::BodyFile;
use crate::dimension::{Built, Dimension, Space};
use crate::methods;
use crate::scene::{BodySpec, Scene, Shape};

fn shift<const D: usize>(body: &BodySpec) -> [f64; D] {
    point::of_slice(body.translate.as_deref().unwrap_or(&[]))
}

fn wrong_dimension(shape: &Shape, dimension: usize) -> GeometryError {
    ParameterError::OutOfRange {
        of: shape.name(),
        name: "dimension",
        value: shape.dimension().unwrap_or(5 - dimension) as f64,
        needs: "the same as that of the domain and of every other body",
    }
    .into()
}

impl Dimension<2> for Space<2> {
    fn method(scene: &Scene) -> Box<dyn Method<2>> {
        methods::method(scene)
    }

    fn place(body: &BodySpec) -> Result<Similarity<2>, GeometryError> {
        Similarity::<2>::new(body.scale, body.rotate_degrees.unwrap_or(0.0), shift(body))
    }

    fn build(
        shape: &Shape,
        file: Option<&BodyFile>,
        place: &Similarity<2>,
    ) -> Result<Built<2>, GeometryError> {
        let mut read = None;
        let mut repairs = Vec::new();
        let outline = match shape {
            Shape::Circle { center, radius } => {
                let ball = Ball::new(place.point(point::of_slice(center)), radius * place.scale())?;
                let (middle, radius) = (ball.center(), ball.radius());
                return Ok(Built::new(
                    Arc::new(ball),
                    vec![ring(|angle| {
                        [
                            middle[0] + radius * angle.cos(),
                            middle[1] + radius * angle.sin(),
                        ]
                    })],
                ));
            }
            Shape::Ellipse { center, semi_axes } => {
                let (c, a): ([f64; 2], [f64; 2]) =
                    (point::of_slice(center), point::of_slice(semi_axes));
                return Ok(Built::new(
                    Arc::new(Placed::new(Arc::new(Ellipsoid::new(c, a)?), *place)),
                    vec![ring(|angle| {
                        place.point([c[0] + a[0] * angle.cos(), c[1] + a[1] * angle.sin()])
                    })],
                ));
            }
            Shape::Box { min, max } => {
                let (a, b): ([f64; 2], [f64; 2]) = (point::of_slice(min), point::of_slice(max));
                return Ok(Built::new(
                    Arc::new(Placed::new(Arc::new(Cuboid::new(a, b)?), *place)),
                    vec![
                        [a, [b[0], a[1]], b, [a[0], b[1]]]
                            .map(|corner| place.point(corner))
                            .to_vec(),
                    ],
                ));
            }
            Shape::Polygon { points } => Outline::polygon(
                &points
                    .iter()
                    .map(|p| point::of_slice(p))
                    .collect::<Vec<_>>(),
            )?,
            Shape::Starfish {
                center,
                radius,
                amplitude,
                arms,
            } => Outline::starfish(point::of_slice(center), *radius, *amplitude, *arms)?,
            Shape::Zigzag {
                width,
                height,
                amplitude,
                teeth,
            } => Outline::zigzag(*width, *height, *amplitude, *teeth)?,
            Shape::Naca { digits, chord } => Outline::naca(digits, *chord)?,
            Shape::File(path) => {
                let (format, mended) = opened(file, path)?
                    .body(|format, bytes| Sketch::from_bytes(format, bytes)?.body())?;
                read = Some((format, mended.outline.points().len()));
                repairs = mended.done.iter().map(ToString::to_string).collect();
                mended.outline
            }
            _ => return Err(wrong_dimension(shape, 2)),
        };
        let outline = outline.transformed(place);
        Ok(Built {
            read,
            repairs,
            ..Built::of_outline(outline)
        })
    }
}

impl Dimension<3> for Space<3> {
    fn method(scene: &Scene) -> Box<dyn Method<3>> {
        methods::method(scene)
    }

    fn place(body: &BodySpec) -> Result<Similarity<3>, GeometryError> {
        let (axis, degrees) = match &body.rotate {
            Some(rotation) => (point::of_slice(&rotation.axis), rotation.degrees),
            None => ([0.0, 0.0, 1.0], 0.0),
        };
        Similarity::<3>::new(body.scale, axis, degrees, shift(body))
    }

    fn build(
        shape: &Shape,
        file: Option<&BodyFile>,
        place: &Similarity<3>,
    ) -> Result<Built<3>, GeometryError> {
        let surface: Arc<dyn Surface<3>> = match shape {
            Shape::Sphere { center, radius } => Arc::new(Ball::new(
                place.point(point::of_slice(center)),
                radius * place.scale(),
            )?),
            Shape::Ellipsoid { center, semi_axes } => Arc::new(Placed::new(
                Arc::new(Ellipsoid::<3>::new(
                    point::of_slice(center),
                    point::of_slice(semi_axes),
                )?),
                *place,
            )),
            Shape::Box { min, max } => Arc::new(Placed::new(
                Arc::new(Cuboid::<3>::new(
                    point::of_slice(min),
                    point::of_slice(max),
                )?),
                *place,
            )),
            Shape::Cylinder { start, end, radius } => Arc::new(Cylinder::new(
                place.point(point::of_slice(start)),
                place.point(point::of_slice(end)),
                radius * place.scale(),
            )?),
            Shape::Torus {
                center,
                axis,
                major,
                minor,
            } => Arc::new(Torus::new(
                place.point(point::of_slice(center)),
                place.direction(point::of_slice(axis)),
                major * place.scale(),
                minor * place.scale(),
            )?),
            Shape::File(path) => {
                let (format, (triangles, mended)) = opened(file, path)?.body(|format, bytes| {
                    let soup = Soup::from_bytes(format, bytes)?;
                    Ok((soup.triangles().len(), soup.transformed(place)?.body()?))
                })?;
                return Ok(Built {
                    read: Some((format, triangles)),
                    repairs: mended.done.iter().map(ToString::to_string).collect(),
                    ..Built::of_mesh(mended.mesh)
                });
            }
            _ => return Err(wrong_dimension(shape, 3)),
        };
        Ok(Built::new(surface, Vec::new()))
    }
}

/// The shape's file, which whoever builds has read.
fn opened<'a>(file: Option<&'a BodyFile>, path: &Path) -> Result<&'a BodyFile, GeometryError> {
    file.ok_or_else(|| {
        let reason = "nobody has read it".to_owned();
        GeometryError::from(ReadError::Unreadable { reason }).in_file(path)
    })
}

/// A closed curve as a polygon for pictures.
fn ring(at: impl Fn(f64) -> [f64; 2]) -> Vec<[f64; 2]> {
    (0..360).map(|k| at(TAU * f64::from(k) / 360.0)).collect()
}
