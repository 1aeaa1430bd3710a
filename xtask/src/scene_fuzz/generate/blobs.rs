//! Shapes of the plane that fit into a circle.

use std::f64::consts::TAU;

use super::super::airfoil;
use super::super::case::Body;
use super::super::random::Random;
use super::super::shape::{OutlineFormat, Shape};
use super::Digits;

/// A polygon about a centre: its corners' radii at random angles.
fn around(
    random: &mut Random,
    count: usize,
    center: [f64; 2],
    radius: impl Fn(&mut Random, usize) -> f64,
) -> Vec<[f64; 2]> {
    let start = random.between(0.0, TAU);
    (0..count)
        .map(|k| {
            let angle = start + TAU * (k as f64 + random.between(-0.3, 0.3)) / count as f64;
            let r = radius(random, k);
            [center[0] + r * angle.cos(), center[1] + r * angle.sin()]
        })
        .collect()
}

fn rounded(digits: Digits, points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = points
        .into_iter()
        .map(|p| p.map(|x| digits.of(x)))
        .collect();
    points.dedup();
    points
}

/// A convex or star-shaped polygon.
pub(super) fn polygon(
    random: &mut Random,
    digits: Digits,
    center: [f64; 2],
    radius: f64,
) -> Vec<[f64; 2]> {
    let count = random.whole(3, 9);
    let points = match random.below(3) {
        // On a circle: convex.
        0 => around(random, count, center, |_, _| radius),
        1 => around(random, count.max(5), center, |random, _| {
            radius * random.between(0.45, 1.0)
        }),
        // Spikes.
        _ => {
            let low = random.between(0.15, 0.8);
            let spikes = if random.chance(0.1) {
                60
            } else {
                random.whole(3, 12)
            };
            let start = random.between(0.0, TAU);
            (0..2 * spikes)
                .map(|k| {
                    let angle = start + TAU * k as f64 / (2 * spikes) as f64;
                    let r = if k % 2 == 0 { radius } else { low * radius };
                    [center[0] + r * angle.cos(), center[1] + r * angle.sin()]
                })
                .collect()
        }
    };
    // Rounding could make small ones cross themselves.
    if radius > 3.0 {
        rounded(digits, points)
    } else {
        points
    }
}

/// A body within a circle.
pub(super) fn blob(random: &mut Random, digits: Digits, center: [f64; 2], radius: f64) -> Body {
    let is_turned = random.chance(0.25);
    let scale = if is_turned && random.chance(0.5) {
        random.pick(&[2.0, 0.1, 3.7])
    } else {
        1.0
    };
    let place = center;
    // Turned bodies are about the origin.
    let (center, radius) = if is_turned {
        ([0.0; 2], radius / scale)
    } else {
        (center, radius)
    };
    let kind = random.weighted(&[18.0, 12.0, 16.0, 26.0, 7.0, 5.0, 5.0, 9.0, 4.0]);
    let shape = match kind {
        0 => Shape::Circle { center, radius },
        1 => {
            let other = radius * random.between(0.15, 1.0);
            Shape::Ellipse {
                center,
                semi_axes: if random.chance(0.5) {
                    [radius, other]
                } else {
                    [other, radius]
                },
            }
        }
        2 => {
            let half = [0, 1].map(|_| radius * random.between(0.2, 0.7));
            Shape::Box {
                min: [0, 1].map(|k| digits.of(center[k] - half[k])).to_vec(),
                max: [0, 1].map(|k| center[k] + half[k]).to_vec(),
            }
        }
        3 => Shape::Polygon {
            points: polygon(random, digits, center, radius),
        },
        4 => {
            let amplitude = digits.of(random.between(0.05, 0.6));
            Shape::Starfish {
                center,
                radius: radius / (1.0 + amplitude),
                amplitude,
                arms: random.whole(2, 9) as u32,
            }
        }
        5 => {
            let width = 1.4 * radius;
            let height = radius * random.between(0.3, 0.7);
            Shape::Zigzag {
                width,
                height,
                amplitude: height * random.between(0.05, 0.6),
                teeth: random.whole(1, 6) as u32,
            }
        }
        6 => Shape::Naca {
            digits: random.pick(&["0012", "0015", "2412", "4415", "0024"]),
            chord: 1.4 * radius,
        },
        7 => {
            let outer = polygon(random, digits, center, radius);
            let mut loops = vec![outer];
            if random.chance(0.35) {
                // Within all of them.
                let inner = radius * random.between(0.08, 0.14);
                let mut hole = around(random, 6, center, |_, _| inner);
                hole.reverse();
                loops.push(hole);
            }
            let format = random.pick(&[OutlineFormat::Csv, OutlineFormat::Svg]);
            Shape::Outline { loops, format }
        }
        _ => {
            let mut points = airfoil::section(random.pick(&["0012", "2415", "0021"]), 15);
            points.push(points[0]);
            let six = |x: f64| (x * 1e6).round() / 1e6;
            Shape::Airfoil {
                points: points.into_iter().map(|p| p.map(six)).collect(),
            }
        }
    };
    let needs_shift = !shape.can_shift();
    let mut body = Body::new("", shape);
    body.scale = scale;
    if kind == 8 {
        body.scale = 1.4 * radius * scale;
    }
    if is_turned {
        body.rotate = Some(([0.0, 0.0, 1.0], digits.of(random.between(-180.0, 180.0))));
    }
    if is_turned || needs_shift {
        let back = match kind {
            // From the leading edge to the middle.
            6 | 8 if !is_turned => 0.7 * radius,
            _ => 0.0,
        };
        body.translate = Some(vec![place[0] - back, place[1]]);
    }
    body
}
