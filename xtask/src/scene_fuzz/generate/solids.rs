//! Shapes of space that fit into a ball.

use super::super::case::Body;
use super::super::meshes;
use super::super::random::Random;
use super::super::shape::{MeshFormat, Shape};
use super::Digits;

/// A direction of any length.
fn axis(random: &mut Random) -> [f64; 3] {
    match random.below(4) {
        0 => [0.0, 0.0, 1.0],
        1 => [1.0, 0.0, 0.0],
        _ => {
            let v: [f64; 3] =
                std::array::from_fn(|_| (random.between(-1.0, 1.0) * 100.0).round() / 100.0);
            if v.iter().map(|x| x * x).sum::<f64>() > 0.01 {
                v
            } else {
                [0.0, 1.0, 0.0]
            }
        }
    }
}

pub(super) fn mesh(random: &mut Random, center: [f64; 3], radius: f64) -> Shape {
    let half: [f64; 3] = std::array::from_fn(|_| radius * random.between(0.3, 0.57));
    let [min, max] = [-1.0, 1.0].map(|s| std::array::from_fn(|k| center[k] + s * half[k]));
    let (points, triangles) = match random.below(5) {
        0 => meshes::cuboid(min, max),
        1 => meshes::octahedron(center, radius),
        2 => meshes::angle_iron(min, max, random.between(0.3, 0.6)),
        times => meshes::ball(center, radius, times - 2),
    };
    let format = random.pick(&[
        MeshFormat::StlText,
        MeshFormat::StlBinary,
        MeshFormat::Obj,
        MeshFormat::Ply,
    ]);
    Shape::Mesh {
        points,
        triangles,
        format,
    }
}

/// A body within a ball.
pub(super) fn solid(random: &mut Random, digits: Digits, center: [f64; 3], radius: f64) -> Body {
    let is_turned = random.chance(0.25);
    let scale = if is_turned && random.chance(0.5) {
        random.pick(&[2.0, 0.1, 3.7])
    } else {
        1.0
    };
    let place = center;
    let (center, radius) = if is_turned {
        ([0.0; 3], radius / scale)
    } else {
        (center, radius)
    };
    let shape = match random.weighted(&[22.0, 13.0, 20.0, 14.0, 9.0, 22.0]) {
        0 => Shape::Sphere { center, radius },
        1 => Shape::Ellipsoid {
            center,
            semi_axes: std::array::from_fn(|_| radius * random.between(0.35, 1.0)),
        },
        2 => {
            let half: [f64; 3] = std::array::from_fn(|_| radius * random.between(0.2, 0.57));
            Shape::Box {
                min: (0..3).map(|k| digits.of(center[k] - half[k])).collect(),
                max: (0..3).map(|k| center[k] + half[k]).collect(),
            }
        }
        3 => {
            let across = radius * random.between(0.25, 0.7);
            let along = radius * random.between(0.2, 0.7);
            let direction = axis(random);
            let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
            let end =
                |s: f64| std::array::from_fn(|k| center[k] + s * along * direction[k] / length);
            Shape::Cylinder {
                start: end(-1.0),
                end: end(1.0),
                radius: across,
            }
        }
        4 => {
            let minor = radius * random.between(0.15, 0.45);
            Shape::Torus {
                center,
                axis: axis(random),
                major: radius - minor,
                minor,
            }
        }
        _ => mesh(random, center, radius),
    };
    let mut body = Body::new("", shape);
    body.scale = scale;
    if is_turned {
        body.rotate = Some((axis(random), digits.of(random.between(-180.0, 180.0))));
        body.translate = Some(place.to_vec());
    }
    body
}
