//! Bodies in the plane.

use super::super::case::{Body, Role};
use super::super::random::Random;
use super::super::shape::Shape;
use super::blobs::{blob, polygon};
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

/// A place for a circle, and the circle's radius.
fn spot(random: &mut Random, room: &Room, low: f64, high: f64) -> ([f64; 2], f64) {
    let radius = (0.5 * short(room) * random.between(low, high)).max(0.6);
    let center = [0, 1].map(|k| {
        let (from, to) = (radius * 1.001, room.size[k] - radius * 1.001);
        if from < to {
            random.between(from, to)
        } else {
            0.5 * room.size[k]
        }
    });
    (
        center.map(|x| room.digits.of(x)),
        room.digits.of(radius * 0.98).max(0.5),
    )
}

fn alone(random: &mut Random, room: &Room) -> Vec<Body> {
    let (center, radius) = if random.chance(0.5) {
        // In the middle, with room around.
        let radius = 0.5 * short(room) * random.between(0.4, 0.7);
        ([0, 1].map(|k| room.digits.of(0.5 * room.size[k])), radius)
    } else {
        spot(random, room, 0.1, 0.95)
    };
    vec![blob(random, room.digits, center, radius)]
}

fn rectangle(min: [f64; 2], max: [f64; 2]) -> Shape {
    Shape::Box {
        min: min.to_vec(),
        max: max.to_vec(),
    }
}

/// A floor with a jagged upper side, from wall to wall.
fn jagged_floor(random: &mut Random, [w, h]: [f64; 2]) -> Shape {
    let teeth = random.whole(1, 8);
    let (low, high) = (h * random.between(0.1, 0.4), h * random.between(0.4, 1.0));
    let high = if random.chance(0.2) { h } else { high };
    let mut points = vec![[0.0, 0.0], [w, 0.0]];
    for k in 0..=2 * teeth {
        let y = if k % 2 == 0 { high } else { low };
        points.push([w - w * k as f64 / (2 * teeth) as f64, y]);
    }
    Shape::Polygon { points }
}

fn at_wall(random: &mut Random, room: &Room) -> Vec<Body> {
    let [w, h] = [room.size[0], room.size[1]];
    let part =
        |random: &mut Random, whole: f64| room.digits.of(whole * random.between(0.1, 0.6)).max(0.3);
    let mut shapes = Vec::new();
    match random.below(8) {
        0 => shapes.push(rectangle([0.0; 2], [w, h])),
        1 => shapes.push(rectangle([0.0; 2], [w, part(random, h)])),
        2 => {
            // A channel.
            let (a, b) = (part(random, 0.6 * h), part(random, 0.6 * h));
            shapes.push(rectangle([0.0; 2], [w, a]));
            shapes.push(rectangle([0.0, h - b], [w, h]));
        }
        3 => shapes.push(rectangle([0.0; 2], [part(random, w), part(random, h)])),
        4 => {
            let (x, width) = (part(random, w), part(random, 0.5 * w));
            shapes.push(rectangle([x, 0.0], [(x + width).min(w), part(random, h)]));
        }
        5 => shapes.push(jagged_floor(random, [w, h])),
        6 => {
            let radius = room.digits.of(0.5 * short(room) * random.between(0.3, 0.9));
            shapes.push(Shape::Circle {
                center: [radius, 0.5 * h],
                radius,
            });
        }
        _ => {
            let (a, b) = (part(random, w), part(random, h));
            shapes.push(Shape::Polygon {
                points: vec![[0.0, 0.0], [a, 0.0], [0.0, b]],
            });
        }
    }
    shapes
        .into_iter()
        .map(|shape| Body::new("", shape))
        .collect()
}

fn apart(random: &mut Random, room: &Room) -> Vec<Body> {
    let columns = if room.size[0] > room.size[1] {
        [random.whole(2, 4), 1]
    } else {
        [1, random.whole(2, 4)]
    };
    let mut bodies = Vec::new();
    let cell = [0, 1].map(|k| room.size[k] / columns[k] as f64);
    for i in 0..columns[0] {
        for j in 0..columns[1] {
            let gap = random.between(0.0, 1.5);
            let radius = (0.5 * cell[0].min(cell[1]) - gap).max(0.5) * random.between(0.4, 1.0);
            let center = [(i as f64 + 0.5) * cell[0], (j as f64 + 0.5) * cell[1]];
            let mut body = blob(random, room.digits, center, radius);
            if random.chance(0.08) {
                body.role = Role::Void;
            }
            bodies.push(body);
        }
    }
    bodies
}

fn touching(random: &mut Random, room: &Room) -> Vec<Body> {
    let [w, h] = [room.size[0], room.size[1]];
    let at = |x: f64| room.digits.of(x);
    let x = at(w * random.between(0.35, 0.65));
    let y = at(h * random.between(0.25, 0.45));
    let shapes = match random.below(4) {
        // A side in common, of the same length or not.
        0 => {
            let (top, other) = (at(h * 0.7), at(h * random.between(0.5, 0.9)));
            let other = if random.chance(0.5) { top } else { other };
            vec![
                rectangle([at(0.15 * w), y], [x, top]),
                rectangle([x, y], [at(0.85 * w), other.max(y + 0.5)]),
            ]
        }
        1 => {
            let radius = at(0.2 * short(room));
            vec![
                Shape::Circle {
                    center: [x - radius, 0.5 * h],
                    radius,
                },
                Shape::Circle {
                    center: [x + radius, 0.5 * h],
                    radius,
                },
            ]
        }
        // A ball on a floor.
        2 => {
            let radius = 0.5 * (h - y) * random.between(0.3, 0.9);
            vec![
                rectangle([0.0, 0.0], [w, y]),
                Shape::Circle {
                    center: [0.5 * w, y + radius],
                    radius,
                },
            ]
        }
        // Two triangles of one square.
        _ => {
            let [a, b] = [[0.2 * w, 0.2 * h], [0.8 * w, 0.8 * h]];
            vec![
                Shape::Polygon {
                    points: vec![a, [b[0], a[1]], b],
                },
                Shape::Polygon {
                    points: vec![a, b, [a[0], b[1]]],
                },
            ]
        }
    };
    shapes
        .into_iter()
        .map(|shape| Body::new("", shape))
        .collect()
}

fn overlapping(random: &mut Random, room: &Room) -> Vec<Body> {
    let digits = room.digits;
    let center = [0, 1].map(|k| digits.of(0.5 * room.size[k]));
    let radius = 0.5 * short(room) * random.between(0.4, 0.75);
    let lower = match random.below(3) {
        0 => Body::new("", Shape::Circle { center, radius }),
        1 => Body::new(
            "",
            rectangle(
                [0, 1].map(|k| center[k] - 0.8 * radius),
                [0, 1].map(|k| center[k] + 0.8 * radius),
            ),
        ),
        _ => blob(random, digits, center, radius),
    };
    let thickness = random.magnitude(1e-3, 1.0);
    let mut higher = match random.below(5) {
        // A needle.
        0 => Body::new(
            "",
            Shape::Polygon {
                points: vec![
                    [center[0] - 1.2 * radius, center[1]],
                    [center[0] + 1.2 * radius, center[1] - thickness],
                    [center[0] + 1.2 * radius, center[1] + thickness],
                ],
            },
        ),
        // All but a sliver of the upper half.
        1 => Body::new(
            "",
            rectangle(
                [center[0] - 1.1 * radius, center[1]],
                [
                    center[0] + 1.1 * radius,
                    center[1] + 0.8 * radius - thickness,
                ],
            ),
        ),
        // A strip.
        2 => Body::new(
            "",
            rectangle(
                [center[0] - 1.1 * radius, center[1] - 0.5],
                [center[0] + 1.1 * radius, center[1] + 0.5 + thickness],
            ),
        ),
        _ => {
            let shift = radius * random.between(0.2, 0.9);
            let beside = [center[0] + shift, center[1]];
            let smaller = radius * random.between(0.3, 0.8);
            blob(random, digits, beside, smaller)
        }
    };
    higher.precedence = if random.chance(0.85) { 1 } else { 0 };
    let mut bodies = vec![lower, higher];
    if random.chance(0.2) {
        let mut third = blob(
            random,
            digits,
            [center[0], center[1] - 0.5 * radius],
            0.5 * radius,
        );
        third.precedence = random.pick(&[2, 3, -1]);
        bodies.push(third);
    }
    if random.chance(0.3) {
        bodies.reverse();
    }
    bodies
}

fn nested(random: &mut Random, room: &Room) -> Vec<Body> {
    let digits = room.digits;
    let center = [0, 1].map(|k| digits.of(0.5 * room.size[k]));
    let radius = digits.of(0.5 * short(room) * random.between(0.6, 0.95));
    let mut outer = if random.chance(0.5) {
        Body::new("", Shape::Circle { center, radius })
    } else if random.chance(0.5) {
        Body::new(
            "",
            rectangle(
                [0, 1].map(|k| digits.of(0.1 * room.size[k])),
                [0, 1].map(|k| digits.of(0.9 * room.size[k])),
            ),
        )
    } else {
        blob(random, digits, center, radius)
    };
    outer.role = random.pick(&[Role::Container, Role::Container, Role::Void]);
    let mut bodies = vec![outer];
    match random.below(4) {
        0 => {}
        // A void within a solid.
        1 => {
            bodies[0].role = Role::Solid;
            let mut hole = blob(random, digits, center, 0.4 * radius);
            hole.role = Role::Void;
            bodies.push(hole);
        }
        _ => {
            let smaller = radius * random.between(0.2, 0.6);
            bodies.push(blob(random, digits, center, smaller));
        }
    }
    bodies
}

fn thin(random: &mut Random, room: &Room) -> Vec<Body> {
    let thickness = random.magnitude(0.01, 1.3);
    let center = [0, 1].map(|k| room.digits.of(0.5 * room.size[k]));
    let half = 0.5 * short(room) * random.between(0.3, 0.8);
    let mut body = match random.below(4) {
        0 => Body::new(
            "",
            rectangle(
                [center[0] - half, center[1]],
                [center[0] + half, center[1] + thickness],
            ),
        ),
        1 => {
            let mut plate = Body::new("", rectangle([-half, 0.0], [half, thickness]));
            plate.rotate = Some(([0.0, 0.0, 1.0], random.between(0.0, 180.0)));
            plate.translate = Some(center.to_vec());
            plate
        }
        2 => Body::new(
            "",
            Shape::Ellipse {
                center,
                semi_axes: [half, thickness],
            },
        ),
        // A body with a thin tail.
        _ => Body::new(
            "",
            Shape::Polygon {
                points: vec![
                    [center[0] - half, center[1] - 0.5 * half],
                    [center[0], center[1] - 0.5 * half],
                    [center[0], center[1] - 0.5 * thickness],
                    [center[0] + half, center[1] - 0.5 * thickness],
                    [center[0] + half, center[1] + 0.5 * thickness],
                    [center[0], center[1] + 0.5 * thickness],
                    [center[0], center[1] + 0.5 * half],
                    [center[0] - half, center[1] + 0.5 * half],
                ],
            },
        ),
    };
    if random.chance(0.1) {
        body.shape = Shape::Polygon {
            points: polygon(random, room.digits, center, 0.7),
        };
        body.rotate = None;
        body.translate = None;
    }
    vec![body]
}
