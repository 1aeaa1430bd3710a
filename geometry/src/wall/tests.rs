//! Walls, judged by distances and counts that share nothing with what made them.

use sphpack_neighbors::random::SplitMix64 as Random;

use super::*;
use crate::{Ball, Cuboid, Mesh, Outline, Similarity, Torus};

/// Signed distance, negative in the body.
type Distance<'a, const D: usize> = &'a dyn Fn([f64; D]) -> f64;

/// Distance from a straight side.
fn to_side<const D: usize>(p: [f64; D], a: [f64; D], b: [f64; D]) -> f64 {
    let (along, away) = (point::sub(b, a), point::sub(p, a));
    let way = (point::dot(away, along) / point::norm_squared(along)).clamp(0.0, 1.0);
    point::distance(p, point::add_scaled(a, way, along))
}

/// By all sides, and by how often a ray crosses them.
fn of_loops(loops: &[Vec<[f64; 2]>], p: [f64; 2]) -> f64 {
    let (mut least, mut is_in) = (f64::INFINITY, false);
    for points in loops {
        for (i, &a) in points.iter().enumerate() {
            let b = points[(i + 1) % points.len()];
            least = least.min(to_side(p, a, b));
            if (a[1] > p[1]) != (b[1] > p[1]) {
                let x = a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
                is_in ^= x > p[0];
            }
        }
    }
    if is_in { -least } else { least }
}

/// What was found wrong with a wall; empty where nothing was.
struct Judge<'a, const D: usize> {
    distance: Distance<'a, D>,
    side: WallSide,
    spacing: f64,
    layers: usize,
}

impl<const D: usize> Judge<'_, D> {
    fn depth(&self, p: [f64; D]) -> f64 {
        match self.side {
            WallSide::Inside => -(self.distance)(p),
            WallSide::Outside => (self.distance)(p),
        }
    }

    /// Depths, normals, pairs and holes.
    fn look(&self, wall: &[WallLayer<D>], random: &mut Random) {
        let all: Vec<WallPoint<D>> = wall.iter().flat_map(|layer| layer.points.clone()).collect();
        assert!(!all.is_empty(), "no points");
        for (number, layer) in wall.iter().enumerate() {
            let on_level = layer.points.len() - layer.between;
            for (i, at) in layer.points.iter().enumerate() {
                let depth = self.depth(at.point);
                let wanted = (number as f64 + 0.5) * self.spacing;
                assert!((at.depth - depth).abs() < 1e-3 * self.spacing, "{at:?}");
                if i < on_level {
                    assert!((depth - wanted).abs() < 1.1e-3 * self.spacing, "{at:?}");
                }
                assert!((point::norm(at.normal) - 1.0).abs() < 1e-9, "{at:?}");
                // Where it leads there is the surface.
                let foot = point::add_scaled(at.point, at.depth, at.normal);
                assert!(self.depth(foot).abs() < 1e-3 * self.spacing, "{at:?}");
            }
        }
        for (i, a) in all.iter().enumerate() {
            for b in &all[..i] {
                let apart = point::distance(a.point, b.point) / self.spacing;
                assert!(apart > 0.6 - 1e-9, "{apart}: {a:?}, {b:?}");
            }
        }
        let hole = if D == 2 { 0.9 } else { 1.0 };
        let bounds = all
            .iter()
            .fold(sphpack_neighbors::Bounds::EMPTY, |mut b, at| {
                b.include(at.point);
                b
            });
        let bounds = bounds.grown(self.spacing);
        let size = bounds.size();
        for _ in 0..1500 {
            let p = std::array::from_fn(|k| bounds.min[k] + size[k] * random.unit());
            let depth = self.depth(p) / self.spacing;
            if depth <= 0.0 || depth >= self.layers as f64 {
                continue;
            }
            let far = (all.iter())
                .map(|at| point::distance(at.point, p))
                .fold(f64::INFINITY, f64::min);
            assert!(far < (hole + 0.01) * self.spacing, "hole of {far} at {p:?}");
        }
    }

    /// The volume of the layers by random places, and its standard error.
    fn volume(&self, bounds: sphpack_neighbors::Bounds<D>, random: &mut Random) -> [f64; 2] {
        let size = bounds.size();
        let places = 6000;
        let within = (0..places)
            .filter(|_| {
                let p = std::array::from_fn(|k| bounds.min[k] + size[k] * random.unit());
                let depth = self.depth(p);
                depth > 0.0 && depth < self.layers as f64 * self.spacing
            })
            .count();
        let part = within as f64 / f64::from(places);
        let error = (part * (1.0 - part) / f64::from(places)).sqrt();
        [part * bounds.volume(), error * bounds.volume()]
    }
}

fn total<const D: usize>(wall: &[WallLayer<D>]) -> f64 {
    wall.iter()
        .map(|layer| layer.volume_each * layer.points.len() as f64)
        .sum()
}

/// Makes a wall and has it judged.
fn check<const D: usize>(
    surface: Arc<dyn Surface<D>>,
    distance: Distance<'_, D>,
    spec: WallSpec,
    seed: u64,
) -> Vec<WallLayer<D>> {
    let mut random = Random::new(seed);
    let wall = wall_layers(&surface, &spec, None, &[]).expect("a wall");
    let judge = Judge {
        distance,
        side: spec.side,
        spacing: spec.spacing,
        layers: spec.layers,
    };
    judge.look(&wall, &mut random);
    let around = surface
        .bounds()
        .grown(spec.layers as f64 * spec.spacing * 1.01);
    let [volume, error] = judge.volume(around, &mut random);
    let off = (total(&wall) - volume).abs();
    assert!(
        off < 4.5 * error + 2e-3 * volume,
        "{} instead of {volume} ± {error}",
        total(&wall)
    );
    wall
}

fn spec(side: WallSide, spacing: f64, layers: usize) -> WallSpec {
    WallSpec {
        side,
        spacing,
        layers,
    }
}

const SIDES: [WallSide; 2] = [WallSide::Inside, WallSide::Outside];

/// Outlines with corners of all kinds, about 1 large.
fn outlines() -> Vec<(&'static str, Outline)> {
    let wedge = 6.0_f64.to_radians().tan();
    let square = |half: f64| vec![[-half, -half], [half, -half], [half, half], [-half, half]];
    let fine = Outline::naca("0015", 1.0).expect("an airfoil");
    let fine: Vec<[f64; 2]> = fine.points().to_vec();
    let tail = (0..fine.len())
        .max_by(|&i, &j| fine[i][0].total_cmp(&fine[j][0]))
        .expect("points");
    let airfoil: Vec<[f64; 2]> = (0..60)
        .map(|k| fine[(tail + k * fine.len() / 60) % fine.len()])
        .collect();
    let mut hole = square(0.2);
    hole.reverse();
    vec![
        ("square", Outline::polygon(&square(0.5)).expect("a square")),
        (
            "wedge",
            Outline::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, wedge]]).expect("a wedge"),
        ),
        // Of few sides, for the judge looks at all.
        ("airfoil", Outline::polygon(&airfoil).expect("an airfoil")),
        (
            "cavity",
            Outline::new(vec![square(0.5), hole]).expect("a square with a hole"),
        ),
        (
            "step",
            Outline::polygon(&[
                [0.0, 0.0],
                [1.0, 0.0],
                [1.0, 0.4],
                [0.5, 0.4],
                [0.45, 1.0],
                [0.0, 1.0],
            ])
            .expect("an L"),
        ),
        (
            "plate",
            Outline::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.04], [0.0, 0.04]]).expect("a plate"),
        ),
    ]
}

#[test]
fn walls_of_outlines_are_sound_at_all_spacings_turned_and_moved() {
    let mut random = Random::new(7);
    let all = outlines();
    // Each outline at every third spacing, on either side: all of them at all take half a minute.
    for n in 0..40 {
        let spacing = 0.03 * 8.0_f64.powf(f64::from(n) / 39.0);
        for (name, outline) in all.iter().skip(n as usize % 3).step_by(3) {
            let shift = [random.unit(), random.unit()];
            let place = Similarity::<2>::new(1.0, 360.0 * random.unit(), shift).expect("a place");
            let outline = outline.transformed(&place);
            let loops: Vec<Vec<[f64; 2]>> = outline.loops().map(<[_]>::to_vec).collect();
            let distance = |p: [f64; 2]| of_loops(&loops, p);
            let side = SIDES[usize::from(random.unit() < 0.5)];
            println!("{name} {side:?} {spacing}");
            check(Arc::new(outline), &distance, spec(side, spacing, 3), 11);
        }
    }
}

#[test]
fn walls_of_curves_and_bodies_by_formula_are_sound() {
    let circle: Arc<dyn Surface<2>> = Arc::new(Ball::new([0.3, 0.2], 0.5).expect("a circle"));
    let from_circle = |p: [f64; 2]| (p[0] - 0.3).hypot(p[1] - 0.2) - 0.5;
    let torus: Arc<dyn Surface<3>> =
        Arc::new(Torus::new([0.0; 3], [0.0, 0.0, 1.0], 1.0, 0.4).expect("a torus"));
    let from_torus = |p: [f64; 3]| (p[0].hypot(p[1]) - 1.0).hypot(p[2]) - 0.4;
    let cube: Arc<dyn Surface<3>> = Arc::new(Cuboid::new([-0.5; 3], [0.5; 3]).expect("a cube"));
    let from_box = |half: [f64; 3], p: [f64; 3]| {
        let q: [f64; 3] = std::array::from_fn(|k| p[k].abs() - half[k]);
        let out = point::norm(q.map(|x| x.max(0.0)));
        out + q.iter().copied().fold(f64::NEG_INFINITY, f64::max).min(0.0)
    };
    let from_cube = |p: [f64; 3]| from_box([0.5; 3], p);
    let plate: Arc<dyn Surface<3>> =
        Arc::new(Cuboid::new([-0.5, -0.5, -0.03], [0.5, 0.5, 0.03]).expect("a plate"));
    let from_plate = |p: [f64; 3]| from_box([0.5, 0.5, 0.03], p);
    for n in 0..6 {
        let spacing = 0.03 * 4.0_f64.powf(f64::from(n) / 5.0);
        for side in SIDES {
            check(circle.clone(), &from_circle, spec(side, spacing, 4), 3);
        }
    }
    for (n, spacing) in [0.09, 0.13, 0.19].into_iter().enumerate() {
        let side = SIDES[n % 2];
        println!("{spacing}");
        check(torus.clone(), &from_torus, spec(side, spacing, 2), 5);
        check(cube.clone(), &from_cube, spec(side, spacing, 3), 5);
        check(plate.clone(), &from_plate, spec(side, spacing, 2), 5);
    }
}

/// A cube of twelve triangles with its corners at ±`half`, turned inside out or not.
fn cube_of_triangles(half: f64, is_inverted: bool) -> Vec<[[f64; 3]; 3]> {
    let mut all = Vec::new();
    for axis in 0..3 {
        for end in [-1.0, 1.0] {
            let corner = |u: f64, v: f64| {
                let mut p = [0.0; 3];
                p[axis] = end * half;
                p[(axis + 1) % 3] = u * half;
                p[(axis + 2) % 3] = v * half;
                p
            };
            let ring = [
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ];
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                let faces_out = (end > 0.0) != is_inverted;
                let [b, c] = if faces_out { [b, c] } else { [c, b] };
                all.push([ring[a], ring[b], ring[c]]);
            }
        }
    }
    all
}

/// Distance from a triangle: from its sides, or from its plane where that is beneath it.
fn to_triangle(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> f64 {
    let normal = point::cross(point::sub(b, a), point::sub(c, a));
    let is_beneath = [[a, b], [b, c], [c, a]].iter().all(|&[from, to]| {
        let across = point::cross(normal, point::sub(to, from));
        point::dot(across, point::sub(p, from)) >= 0.0
    });
    if is_beneath {
        return (point::dot(point::sub(p, a), normal) / point::norm(normal)).abs();
    }
    [[a, b], [b, c], [c, a]]
        .map(|[from, to]| to_side(p, from, to))
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn a_mesh_with_a_cavity_has_walls_along_both_surfaces() {
    let mut triangles = cube_of_triangles(0.5, false);
    triangles.extend(cube_of_triangles(0.2, true));
    let turned =
        Similarity::<3>::new(1.0, [1.0, 2.0, 3.0], 31.0, [0.1, 0.0, 0.0]).expect("a place");
    let triangles: Vec<[[f64; 3]; 3]> = (triangles.iter())
        .map(|corners| corners.map(|p| turned.point(p)))
        .collect();
    let mesh = Mesh::from_loose(&triangles).expect("a mesh");
    let origin = turned.point([0.0; 3]);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(|axis| point::sub(turned.point(axis), origin));
    let distance = |p: [f64; 3]| {
        let largest = axes
            .map(|axis| point::dot(axis, point::sub(p, origin)).abs())
            .into_iter()
            .fold(0.0, f64::max);
        let away = (triangles.iter())
            .map(|&corners| to_triangle(p, corners))
            .fold(f64::INFINITY, f64::min);
        if (0.2..0.5).contains(&largest) {
            -away
        } else {
            away
        }
    };
    check(
        Arc::new(mesh.clone()),
        &distance,
        spec(WallSide::Inside, 0.11, 2),
        9,
    );
    // Both surfaces have their own: the shells are as large as they are.
    let wall = check(
        Arc::new(mesh),
        &distance,
        spec(WallSide::Inside, 0.06, 2),
        9,
    );
    assert!(
        wall.iter()
            .all(|layer| layer.between * 20 < layer.points.len())
    );
}

#[test]
fn given_points_are_the_first_layer_and_others_are_kept_clear_of() {
    let square: Arc<dyn Surface<2>> = Arc::new(
        Outline::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).expect("a square"),
    );
    let wall = spec(WallSide::Inside, 0.1, 2);
    let even = wall_layers(&square, &wall, None, &[]).expect("a wall");
    // Half of the first layer, and a strange particle where there would be one of the second.
    let first: Vec<[f64; 2]> = (even[0].points.iter().step_by(2))
        .map(|at| at.point)
        .collect();
    let other = even[1].points[3].point;
    let found = wall_layers(&square, &wall, Some(&first), &[other]).expect("a wall");
    let places: Vec<[f64; 2]> = found[0].points.iter().map(|at| at.point).collect();
    assert_eq!(places[..first.len()], first);
    assert!(found[0].between > 0, "the gaps stay open");
    for at in found.iter().flat_map(|layer| &layer.points) {
        assert!(point::distance(at.point, other) > 0.06 - 1e-12);
    }
    let volume = total(&found);
    assert!((volume - total(&even)).abs() < 1e-12, "{volume}");
}
