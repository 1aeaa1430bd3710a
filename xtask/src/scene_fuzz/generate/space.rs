//! Bodies in space.

use super::super::case::{Body, Role};
use super::super::meshes;
use super::super::random::Random;
use super::super::shape::{MeshFormat, Shape};
use super::solids::solid;
use super::{Arrangement, Room};

pub(super) fn bodies(random: &mut Random, room: &Room, arrangement: Arrangement) -> Vec<Body> {
    match arrangement {
        Arrangement::Nothing => Vec::new(),
        Arrangement::Alone => alone(random, room),
        Arrangement::AtWall => at_wall(random, room),
        Arrangement::Apart => apart(random, room),
        Arrangement::Touching => touching(random, room),
        Arrangement::Overlapping => overlapping(random, room),
        Arrangement::Nested => nested(random, room),
        Arrangement::Thin => thin(random, room),
    }
}

fn short(room: &Room) -> f64 {
    room.size.iter().copied().fold(f64::INFINITY, f64::min)
}

fn middle(room: &Room) -> [f64; 3] {
    std::array::from_fn(|k| room.digits.of(0.5 * room.size[k]))
}

fn cuboid(min: [f64; 3], max: [f64; 3]) -> Body {
    Body::new(
        "",
        Shape::Box {
            min: min.to_vec(),
            max: max.to_vec(),
        },
    )
}

fn alone(random: &mut Random, room: &Room) -> Vec<Body> {
    let radius = (0.5 * short(room) * random.between(0.3, 0.95)).max(0.8);
    let center = if random.chance(0.6) {
        middle(room)
    } else {
        std::array::from_fn(|k| {
            let slack = (room.size[k] - 2.002 * radius).max(0.0);
            1.001 * radius + slack * random.unit()
        })
    };
    vec![solid(random, room.digits, center, radius)]
}

fn at_wall(random: &mut Random, room: &Room) -> Vec<Body> {
    let size: [f64; 3] = std::array::from_fn(|k| room.size[k]);
    let part =
        |random: &mut Random, k: usize| room.digits.of(size[k] * random.between(0.1, 0.6)).max(0.3);
    match random.below(6) {
        0 => vec![cuboid([0.0; 3], size)],
        1 => vec![cuboid([0.0; 3], [size[0], size[1], part(random, 2)])],
        2 => {
            let z = 0.6 * part(random, 2);
            let floor = cuboid([0.0; 3], [size[0], size[1], z]);
            vec![floor, cuboid([0.0, 0.0, size[2] - z], size)]
        }
        3 => vec![cuboid(
            [0.0; 3],
            [part(random, 0), part(random, 1), part(random, 2)],
        )],
        4 => {
            let radius = room.digits.of(0.5 * short(room) * random.between(0.3, 0.9));
            let center = [0.5 * size[0], 0.5 * size[1], radius];
            vec![Body::new("", Shape::Sphere { center, radius })]
        }
        _ => {
            // A column from wall to wall.
            let radius = 0.5 * size[0].min(size[1]) * random.between(0.3, 0.8);
            let end = |z: f64| [0.5 * size[0], 0.5 * size[1], z];
            vec![Body::new(
                "",
                Shape::Cylinder {
                    start: end(0.0),
                    end: end(size[2]),
                    radius,
                },
            )]
        }
    }
}

fn apart(random: &mut Random, room: &Room) -> Vec<Body> {
    let long = (0..3)
        .max_by(|&i, &j| room.size[i].total_cmp(&room.size[j]))
        .unwrap_or(0);
    let count = random.whole(2, 3);
    let cell = room.size[long] / count as f64;
    (0..count)
        .map(|k| {
            let mut center = middle(room);
            center[long] = (k as f64 + 0.5) * cell;
            let most = 0.5 * cell.min(short(room)) - random.between(0.0, 0.8);
            let radius = (most * random.between(0.6, 1.0)).max(0.6);
            solid(random, room.digits, center, radius)
        })
        .collect()
}

fn touching(random: &mut Random, room: &Room) -> Vec<Body> {
    let size: [f64; 3] = std::array::from_fn(|k| room.size[k]);
    let x = room.digits.of(size[0] * random.between(0.35, 0.65));
    let low = size.map(|s| room.digits.of(0.15 * s));
    let high = size.map(|s| room.digits.of(0.85 * s));
    match random.below(3) {
        0 => {
            let shorter = if random.chance(0.5) { 1.0 } else { 0.8 };
            vec![
                cuboid(low, [x, high[1], high[2]]),
                cuboid([x, low[1], low[2]], [high[0], high[1], shorter * high[2]]),
            ]
        }
        1 => {
            let radius = 0.2 * short(room);
            let ball = |side: f64| {
                let center = [x + side * radius, 0.5 * size[1], 0.5 * size[2]];
                Body::new("", Shape::Sphere { center, radius })
            };
            vec![ball(-1.0), ball(1.0)]
        }
        _ => {
            let z = room.digits.of(0.3 * size[2]);
            let radius = 0.3 * short(room).min(size[2] - z);
            let center = [0.5 * size[0], 0.5 * size[1], z + radius];
            vec![
                cuboid([0.0; 3], [size[0], size[1], z]),
                Body::new("", Shape::Sphere { center, radius }),
            ]
        }
    }
}

fn overlapping(random: &mut Random, room: &Room) -> Vec<Body> {
    let center = middle(room);
    let radius = 0.5 * short(room) * random.between(0.45, 0.75);
    let lower = match random.below(3) {
        0 => Body::new("", Shape::Sphere { center, radius }),
        1 => cuboid(
            center.map(|x| x - 0.6 * radius),
            center.map(|x| x + 0.6 * radius),
        ),
        _ => solid(random, room.digits, center, radius),
    };
    let thickness = random.magnitude(1e-3, 1.0);
    let mut higher = match random.below(4) {
        // All but a sliver of the upper half.
        0 => cuboid(
            [
                center[0] - 1.1 * radius,
                center[1] - 1.1 * radius,
                center[2],
            ],
            [
                center[0] + 1.1 * radius,
                center[1] + 1.1 * radius,
                center[2] + 0.6 * radius - thickness,
            ],
        ),
        // A plate.
        1 => cuboid(
            [
                center[0] - 1.1 * radius,
                center[1] - 1.1 * radius,
                center[2] - 0.5,
            ],
            [
                center[0] + 1.1 * radius,
                center[1] + 1.1 * radius,
                center[2] + 0.5 + thickness,
            ],
        ),
        _ => {
            let mut beside = center;
            beside[random.below(3)] += radius * random.between(0.2, 0.6);
            let smaller = radius * random.between(0.4, 0.7);
            solid(random, room.digits, beside, smaller)
        }
    };
    higher.precedence = if random.chance(0.85) { 1 } else { 0 };
    let mut bodies = vec![lower, higher];
    if random.chance(0.3) {
        bodies.reverse();
    }
    bodies
}

fn nested(random: &mut Random, room: &Room) -> Vec<Body> {
    let center = middle(room);
    let radius = 0.5 * short(room) * random.between(0.7, 0.95);
    let mut outer = if random.chance(0.5) {
        Body::new("", Shape::Sphere { center, radius })
    } else {
        cuboid(
            std::array::from_fn(|k| room.digits.of(0.1 * room.size[k])),
            std::array::from_fn(|k| room.digits.of(0.9 * room.size[k])),
        )
    };
    outer.role = random.pick(&[Role::Container, Role::Container, Role::Void]);
    let mut bodies = vec![outer];
    match random.below(4) {
        0 => {}
        1 => {
            bodies[0].role = Role::Solid;
            let mut hole = solid(random, room.digits, center, 0.4 * radius);
            hole.role = Role::Void;
            bodies.push(hole);
        }
        _ => {
            let smaller = radius * random.between(0.3, 0.5);
            bodies.push(solid(random, room.digits, center, smaller));
        }
    }
    bodies
}

fn thin(random: &mut Random, room: &Room) -> Vec<Body> {
    let thickness = random.magnitude(0.01, 1.3);
    let center = middle(room);
    let half = 0.5 * short(room) * random.between(0.4, 0.8);
    let plate = |center: [f64; 3]| {
        let half = [half, half, 0.5 * thickness];
        [-1.0, 1.0].map(|s| std::array::from_fn(|k| center[k] + s * half[k]))
    };
    let mut body = match random.below(4) {
        0 => {
            let [min, max] = plate(center);
            cuboid(min, max)
        }
        1 => {
            let [min, max] = plate(center);
            let (points, triangles) = meshes::cuboid(min, max);
            let format = random.pick(&[MeshFormat::StlText, MeshFormat::Obj]);
            Body::new(
                "",
                Shape::Mesh {
                    points,
                    triangles,
                    format,
                },
            )
        }
        2 => Body::new(
            "",
            Shape::Cylinder {
                start: center,
                end: [center[0], center[1], center[2] + thickness],
                radius: half,
            },
        ),
        _ => {
            let [min, max] = plate([0.0; 3]);
            let mut body = cuboid(min, max);
            body.rotate = Some(([1.0, 1.0, 0.0], random.between(0.0, 90.0)));
            body.translate = Some(center.to_vec());
            body
        }
    };
    if random.chance(0.15) {
        // A rod.
        body = cuboid(
            [center[0] - half, center[1], center[2]],
            [
                center[0] + half,
                center[1] + thickness,
                center[2] + thickness,
            ],
        );
    }
    vec![body]
}
