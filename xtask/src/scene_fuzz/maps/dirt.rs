//! Meshes as they come from the world: torn, turned, doubled, split, shaken.

use super::super::case::{Body, Case};
use super::super::meshes::{ball, cuboid, prism};
use super::super::random::Random;
use super::super::shape::{MeshFormat, Shape};
use super::panel::{Axis, Panel};
use super::scenes::{OFF, scene};

/// How far the corners of neighbours may be from each other, in ∆s, where all triangles are damaged.
const APART: f64 = 1e-3;

/// A triangle by its own corners, as STL files have them.
type Facet = [[f64; 3]; 3];

const SHARES: &[f64] = &[0.0, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0];

const KINDS: &[&str] = &[
    "holes",
    "one hole",
    "turned round",
    "doubled",
    "slivers",
    "noise",
    "corners apart",
    "overlapping shells",
];

/// The last kind, of the cube only.
const SHELLS: usize = 7;

pub(super) const BALL: Panel = Panel {
    title: "A ball of 8 ∆s, 512 triangles",
    x: Axis::numbers(LABEL, SHARES),
    y: Axis::words("damage", KINDS.split_at(SHELLS).0),
    home: 0.0,
    only: None,
    case: |share, kind| {
        let (points, triangles) = ball([OFF[0], OFF[1], 0.2], 4.0, 3);
        dirty(facets(&points, &triangles), 0.01 * share, kind as usize)
    },
};

pub(super) const CUBE: Panel = Panel {
    title: "A cube of 7 ∆s, 768 triangles",
    x: Axis::numbers(LABEL, SHARES),
    y: Axis::words("damage", KINDS),
    home: 0.0,
    only: None,
    case: cube,
};

const LABEL: &str =
    "damaged triangles, %; noise, % of ∆s; corners apart by 10⁻⁵ ∆s; second shell beyond by 0.1 ∆s";

/// Where the cube begins and ends.
const LOW: [f64; 3] = [OFF[0], OFF[1], 0.2];
const HIGH: [f64; 3] = [LOW[0] + 7.0, LOW[1] + 7.0, LOW[2] + 7.0];

fn cube(share: f64, kind: f64) -> Case {
    let (points, triangles) = cuboid(LOW, HIGH);
    let mut all = facets(&points, &triangles);
    for _ in 0..3 {
        all = all.into_iter().flat_map(quartered).collect();
    }
    match kind as usize {
        SHELLS => shells(all, 0.1 * share),
        kind => dirty(all, 0.01 * share, kind),
    }
}

/// A bar in the cube, as high as the cube is, that ends `beyond` it; both are one body.
fn shells(mut facets: Vec<Facet>, beyond: f64) -> Case {
    let end = HIGH[0] + beyond;
    let [low, high] = [LOW[1] + 1.5, HIGH[1] - 1.5];
    let (points, triangles) = cuboid([LOW[0] + 1.0, low, LOW[2]], [end, high, HIGH[2]]);
    let meant = if beyond > 0.0 {
        let outline = [
            [LOW[0], LOW[1]],
            [HIGH[0], LOW[1]],
            [HIGH[0], low],
            [end, low],
            [end, high],
            [HIGH[0], high],
            [HIGH[0], HIGH[1]],
            [LOW[0], HIGH[1]],
        ];
        let ears = [
            [0, 1, 2],
            [0, 2, 5],
            [0, 5, 6],
            [0, 6, 7],
            [2, 3, 4],
            [2, 4, 5],
        ];
        let (points, triangles) = prism(&outline, &ears, [LOW[2], HIGH[2]]);
        self::facets(&points, &triangles)
    } else {
        facets.clone()
    };
    facets.extend(self::facets(&points, &triangles));
    judged(&facets, &meant)
}

fn facets(points: &[[f64; 3]], triangles: &[[usize; 3]]) -> Vec<Facet> {
    triangles.iter().map(|t| t.map(|k| points[k])).collect()
}

fn middle(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
}

fn quartered([a, b, c]: Facet) -> [Facet; 4] {
    let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

fn shape(facets: &[Facet]) -> Shape {
    Shape::Mesh {
        points: facets.iter().flatten().copied().collect(),
        triangles: (0..facets.len())
            .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
            .collect(),
        format: MeshFormat::StlText,
    }
}

/// A scene of a mesh with a part of its triangles damaged; it is judged by the sound one, or by the shaken one where that is a
/// body of its own.
fn dirty(sound: Vec<Facet>, share: f64, kind: usize) -> Case {
    let random = &mut Random::new(20, kind as u64);
    let mut facets = sound.clone();
    let mut meant = sound;
    let count = (share * facets.len() as f64).round() as usize;
    match kind {
        0 => {
            for _ in 0..count {
                facets.swap_remove(random.below(facets.len()));
            }
        }
        1 => tear(&mut facets, count),
        2 => {
            for k in picked(random, facets.len(), count) {
                facets[k].swap(1, 2);
            }
        }
        3 => {
            for k in picked(random, facets.len(), count) {
                facets.push(facets[k]);
            }
        }
        4 => {
            for k in picked(random, facets.len(), count) {
                split(&mut facets, k);
            }
        }
        5 => {
            shake(&mut facets, share);
            meant.clone_from(&facets);
        }
        _ => {
            let far = APART * share;
            for x in facets.iter_mut().flatten().flatten() {
                *x += random.between(-far, far);
            }
        }
    }
    judged(&facets, &meant)
}

/// A scene of a mesh that stands for another.
fn judged(facets: &[Facet], meant: &[Facet]) -> Case {
    let mut body = Body::new("body", shape(facets));
    body.meant = Some(shape(meant));
    scene(3, vec![body])
}

/// Different numbers below `most`.
fn picked(random: &mut Random, most: usize, count: usize) -> Vec<usize> {
    let mut all: Vec<usize> = (0..most).collect();
    (0..count.min(most))
        .map(|_| all.swap_remove(random.below(all.len())))
        .collect()
}

/// Takes the triangles that are nearest to the corner of the first one.
fn tear(facets: &mut Vec<Facet>, count: usize) {
    let Some(from) = facets.first().map(|facet| facet[0]) else {
        return;
    };
    let far = |facet: &Facet| -> f64 {
        let corners = facet
            .iter()
            .flat_map(|p| (0..3).map(|k| (p[k] - from[k]).powi(2)));
        corners.sum()
    };
    facets.sort_by(|a, b| far(a).total_cmp(&far(b)));
    facets.drain(..count.min(facets.len()));
}

/// Cuts a hair off a triangle: a sliver along one of its sides, with a corner in the middle of it that its neighbour lacks.
fn split(facets: &mut Vec<Facet>, k: usize) {
    const HAIR: f64 = 1e-5;
    let [a, b, c] = facets[k];
    let near: [f64; 3] = std::array::from_fn(|i| {
        let side = 0.5 * (a[i] + b[i]);
        side + HAIR * (c[i] - side)
    });
    facets[k] = [a, near, c];
    facets.push([near, b, c]);
    facets.push([a, b, near]);
}

/// Moves corners, the same corner in all its triangles by the same.
fn shake(facets: &mut [Facet], far: f64) {
    for p in facets.iter_mut().flatten() {
        let place = p.iter().fold(0_u64, |all, x| {
            all.wrapping_mul(1_000_003).wrapping_add(x.to_bits())
        });
        let random = &mut Random::new(21, place);
        *p = p.map(|x| x + random.between(-far, far));
    }
}
