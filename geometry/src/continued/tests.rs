//! Continued bodies against images, rasters and exact caps.

use std::f64::consts::{PI, TAU};

use proptest::prelude::*;

use super::*;
use crate::mesh::tests::icosphere;
use crate::{Cylinder, Mesh, Outline, Similarity, sample_particles};

fn plane(min: [f64; 2], max: [f64; 2], periodic: [bool; 2]) -> Domain<2> {
    Domain::new(min, max).with_periodic(periodic)
}

fn rectangle(min: [f64; 2], max: [f64; 2]) -> Outline {
    Outline::polygon(&[min, [max[0], min[1]], max, [min[0], max[1]]]).unwrap()
}

fn brick(min: [f64; 3], max: [f64; 3]) -> Mesh {
    let corner =
        |bits: usize| std::array::from_fn(|k| if bits >> k & 1 == 1 { max[k] } else { min[k] });
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = sides
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh::new((0..8).map(corner).collect(), triangles.collect()).unwrap()
}

/// Whether an image of the body holds a place of the box.
fn is_held<const D: usize>(body: &dyn Surface<D>, domain: &Domain<D>, p: [f64; D]) -> bool {
    let size = domain.bounds.size();
    (0..9_usize.pow(D as u32)).any(|number| {
        let step: [f64; D] =
            std::array::from_fn(|k| (number / 9_usize.pow(k as u32) % 9) as f64 - 4.0);
        (0..D).all(|k| domain.periodic[k] || step[k] == 0.0)
            && body.inside(std::array::from_fn(|k| p[k] + step[k] * size[k]))
    })
}

/// Places of the box, evenly scattered.
fn places<const D: usize>(domain: &Domain<D>, count: usize) -> impl Iterator<Item = [f64; D]> {
    let (min, size) = (domain.bounds.min, domain.bounds.size());
    let steps = [
        0.754_877_666_246_693,
        0.569_840_290_998_053,
        0.438_579_021_203,
    ];
    (0..count).map(move |i| {
        std::array::from_fn(|k| min[k] + size[k] * (0.5 + steps[k] * i as f64).fract())
    })
}

fn is_like_images<const D: usize>(
    continued: &Continued<D>,
    body: &dyn Surface<D>,
    domain: &Domain<D>,
    count: usize,
) {
    let mut held = 0;
    let (size, corners) = (domain.bounds.size(), body.features().corners);
    for p in places(domain, count) {
        let is_in = is_held(body, domain, p);
        held += usize::from(is_in);
        assert_eq!(continued.inside(p), is_in, "{p:?}");
        let hit = continued.closest(p);
        if hit.distance.abs() > 1e-9 {
            assert_eq!(hit.distance < 0.0, is_in, "{p:?}: {hit:?}");
        }
        // What is nearest is where inside and outside meet.
        if hit.feature == crate::Feature::Smooth && domain.bounds.contains(hit.point) {
            // Along the normal; or, where another side crosses this one just there, somewhere around it.
            let beside = |way: f64| {
                let q = point::add_scaled(hit.point, way, hit.normal);
                is_held(body, domain, q)
            };
            let is_crossed = |far: f64| {
                let around = (0..64).map(|turn| {
                    let (sin, cos) = (TAU * f64::from(turn) / 64.0).sin_cos();
                    let way = std::array::from_fn(|k| [cos, sin, 0.0][k]);
                    is_held(body, domain, point::add_scaled(hit.point, far, way))
                });
                let held: Vec<bool> = around.collect();
                // Of a straight side half of the ring is inside.
                let part = held.iter().filter(|held| **held).count();
                part > 33 && part < 64
            };
            // Corners that lie on a side but for single precision are moved onto it, and what leads to them with them.
            let far = 2.0 * FLUSH * domain.bounds.diagonal();
            let is_off_sides = (0..D).all(|k| {
                hit.point[k] - domain.bounds.min[k] > far
                    && domain.bounds.max[k] - hit.point[k] > far
            });
            // A body is thinner than that beside a sharp corner.
            let is_off_corners = corners.iter().all(|&corner| {
                let mut to = point::sub(hit.point, corner);
                for k in (0..D).filter(|&k| domain.periodic[k]) {
                    to[k] -= size[k] * (to[k] / size[k]).round();
                }
                point::norm(to) > 20.0 * far
            });
            if is_off_sides && is_off_corners {
                let meets = beside(-far) && !beside(far);
                assert!(meets || (D == 2 && is_crossed(far)), "{p:?}: {hit:?}");
            }
        }
    }
    let part = held as f64 / count as f64;
    let off = part - continued.volume() / domain.bounds.volume();
    assert!(
        off.abs() < 3.0 / (count as f64).sqrt() / 2.0,
        "{part}: off by {off}"
    );
}

fn star(center: [f64; 2], radii: &[f64], turn: f64) -> Outline {
    let count = radii.len() as f64;
    let place = |(i, r): (usize, &f64)| {
        let (sin, cos) = (turn + TAU * i as f64 / count).sin_cos();
        [center[0] + r * cos, center[1] + r * sin]
    };
    Outline::polygon(&radii.iter().enumerate().map(place).collect::<Vec<_>>()).unwrap()
}

/// The side of an image passes the nearest point of another to within a ten-millionth: inside and outside meet around it, not
/// along the normal. The nearest point is three millionths from a corner of 27°, where the body is about a millionth thick.
#[test]
fn places_nearest_to_where_two_sides_meet() {
    // Centre, turn and radii of stars.
    let crossing = "0.3598797583413721 -0.22808293411499847 3.601110879973654 1.0207966573685168 0.3 0.3 1.2307157820907204 0.9264695536071336 0.3 1.2906177601485935";
    let sharp = "2.4682379025905745 -0.41096213541078985 4.687277715556838 0.3 1.3517954365700184 0.6065663989073452";
    for drawn in [crossing, sharp] {
        let drawn: Vec<f64> = drawn.split(' ').map(|x| x.parse().unwrap()).collect();
        let body = star([drawn[0], drawn[1]], &drawn[3..], drawn[2]);
        let domain = plane([0.0; 2], [2.0, 1.7], [true, false]);
        let continued = body.continued(&domain).expect("it passes a side");
        is_like_images(&continued, &body, &domain, 400);
    }
}

proptest! {
    #[test]
    fn any_outline_in_any_box(
        center in prop::array::uniform2(-0.5..2.5_f64), turn in 0.0..6.0_f64,
        radii in prop::collection::vec(0.3..1.4_f64, 3..9),
        periodic in prop::array::uniform2(any::<bool>()),
    ) {
        let domain = plane([0.0; 2], [2.0, 1.7], periodic);
        let body = star(center, &radii, turn);
        if let Some(continued) = body.continued(&domain) {
            is_like_images(&continued, &body, &domain, 400);
            // The length, from short pieces of the outline and its images.
            let mut length = 0.0;
            for i in 0..body.points().len() {
                let [a, b] = body.side(i);
                let way = point::sub(b, a);
                for n in 0..2000 {
                    let p = point::add_scaled(a, (n as f64 + 0.5) / 2000.0, way);
                    let p = domain.wrap(p);
                    let out = point::unit([way[1], -way[0]]).unwrap();
                    let beyond = point::add_scaled(p, 1e-9, out);
                    if domain.bounds.contains(p) && !is_held(&body, &domain, beyond) {
                        length += point::norm(way) / 2000.0;
                    }
                }
            }
            prop_assert!((length - continued.measure()).abs() < 2e-2, "{length} {}", continued.measure());
            let count = (continued.measure() / 0.05).round() as usize;
            let samples = continued.sample(count).unwrap();
            prop_assert_eq!(samples.len(), count);
            for site in &samples {
                prop_assert!(domain.bounds.grown(1e-9).contains(site.point));
                prop_assert!(continued.closest(site.point).distance.abs() < 1e-9);
            }
        } else {
            let bounds = body.bounds();
            let is_free = (0..2).all(|k| if periodic[k] {
                bounds.size()[k] < domain.bounds.size()[k]
            } else {
                bounds.min[k] > domain.bounds.min[k] && bounds.max[k] < domain.bounds.max[k]
            });
            prop_assert!(is_free);
        }
    }

    /// Moved by a period and turned by right angles a channel's wavy floor stays the same, in single precision too.
    #[test]
    fn floors_are_endless(
        amplitude in 0.0..0.3_f64, phase in 0.0..6.0_f64, shift in -3..4_i32, is_upright in any::<bool>(),
        is_single in any::<bool>(), origin in -50.0..50.0_f64,
    ) {
        let wave = |x: f64| 0.6 + amplitude * (TAU * x / 4.0 + phase).cos();
        let mut points: Vec<[f64; 2]> = vec![[0.0, 0.0], [4.0, 0.0]];
        points.extend((0..=200).map(|i| {
            let x = 4.0 - 4.0 * f64::from(i) / 200.0;
            [x, wave(x)]
        }));
        for p in &mut points {
            p[0] += 4.0 * f64::from(shift) + origin;
            if is_single {
                *p = p.map(|x| f64::from(x as f32));
            }
            if is_upright {
                p.swap(0, 1);
            }
        }
        let axis = usize::from(is_upright);
        let [mut low, mut high] = [[0.0; 2], [2.0; 2]];
        (low[axis], high[axis]) = (origin, origin + 4.0);
        let domain = plane(low, high, [!is_upright, is_upright]);
        let body = Outline::polygon(&points).unwrap();
        let continued = body.continued(&domain).unwrap();
        prop_assert!((continued.volume() - 2.4).abs() < 1e-4, "{}", continued.volume());
        prop_assert!(continued.features().corners.is_empty(), "{:?}", continued.features());
        let inset = continued.inset(0.05).unwrap();
        prop_assert!(inset.features().corners.is_empty());
        let count = (inset.measure() / 0.1).round() as usize;
        let samples = inset.sample(count).unwrap();
        // Even, across the seam too.
        let mut along: Vec<[f64; 2]> = samples.iter().map(|site| site.point).collect();
        along.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
        let mean = inset.measure() / count as f64;
        for i in 0..count {
            let way = domain.difference(along[(i + 1) % count], along[i]);
            prop_assert!((point::norm(way) / mean - 1.0).abs() < 0.02, "{i}: {way:?} {mean}");
        }
    }
}

#[test]
fn what_lies_free_or_touches_in_a_point_stays() {
    for periodic in [[false; 2], [true; 2], [true, false]] {
        let domain = plane([0.0; 2], [4.0, 2.0], periodic);
        assert!(
            rectangle([1.0, 0.5], [2.0, 1.5])
                .continued(&domain)
                .is_none()
        );
    }
    let closed = plane([0.0; 2], [4.0, 2.0], [false; 2]);
    let diamond = Outline::polygon(&[[1.0, 0.0], [2.0, 1.0], [1.0, 2.0], [0.0, 1.0]]).unwrap();
    assert!(diamond.continued(&closed).is_none());
    // One face on a seam, and nothing on the other side.
    let seam = plane([0.0; 2], [4.0, 2.0], [true, false]);
    assert!(rectangle([0.0, 0.5], [2.0, 1.5]).continued(&seam).is_none());
}

#[test]
fn the_whole_box_has_no_surface() {
    for periodic in [[false; 2], [true; 2], [true, false]] {
        let domain = plane([-1.0, 0.0], [3.0, 2.0], periodic);
        let body = rectangle([-1.0, 0.0], [3.0, 2.0])
            .continued(&domain)
            .unwrap();
        assert_eq!(body.measure(), 0.0);
        assert!((body.volume() - 8.0).abs() < 1e-12);
        assert!(body.closest([1.0, 1.0]).distance < -1.0);
        let inset = body.inset(0.1).unwrap();
        assert_eq!(inset.measure(), 0.0);
        assert!((inset.volume() - 8.0).abs() < 1e-12);
        assert!(inset.sample(0).unwrap().is_empty());
    }
    let domain = Domain::new([0.0; 3], [1.0, 2.0, 3.0]);
    for periodic in [[false; 3], [true; 3], [false, true, false]] {
        let domain = domain.with_periodic(periodic);
        let body = brick([0.0; 3], [1.0, 2.0, 3.0])
            .continued(&domain)
            .unwrap()
            .unwrap();
        assert!(body.measure() < 1e-12 && (body.volume() - 6.0).abs() < 1e-12);
        let inset = body.inset(0.1).unwrap();
        assert!(inset.measure() < 1e-12 && (inset.volume() - 6.0).abs() < 1e-12);
    }
}

#[test]
fn pieces_that_meet_across_the_seam_are_one_part() {
    let domain = plane([0.0; 2], [4.0, 2.0], [true, false]);
    let half = |x: f64, way: f64| -> Vec<[f64; 2]> {
        (0..=40)
            .map(|i| {
                let (sin, cos) = (PI * (f64::from(i) / 40.0 - 0.5)).sin_cos();
                [x + way * 0.5 * cos, 1.0 + 0.5 * sin]
            })
            .collect()
    };
    let body = Outline::new(vec![half(0.0, 1.0), half(4.0, -1.0)]).unwrap();
    let continued = body.continued(&domain).unwrap();
    assert!(continued.parts().is_empty() && continued.features().corners.is_empty());
    assert!((continued.volume() - body.volume()).abs() < 1e-12);
    assert!((continued.measure() - (body.measure() - 2.0)).abs() < 1e-12);
    // Another one apart.
    let disc = star([2.0, 1.0], &[0.3; 30], 0.0);
    let loops = body
        .loops()
        .chain(disc.loops())
        .map(<[_]>::to_vec)
        .collect();
    let both = Outline::new(loops).unwrap().continued(&domain).unwrap();
    let mut volumes: Vec<f64> = both.parts().iter().map(|part| part.volume()).collect();
    volumes.sort_by(f64::total_cmp);
    assert_eq!(volumes.len(), 2);
    assert!((volumes[0] - disc.volume()).abs() < 1e-12);
    assert!((volumes[1] - body.volume()).abs() < 1e-12);
}

#[test]
fn thin_floors_get_one_layer() {
    let domain = plane([0.0; 2], [4.0, 2.0], [true, false]);
    let plate = rectangle([0.0, 1.0], [4.0, 1.05])
        .continued(&domain)
        .unwrap();
    let found = sample_particles(&plate, plate.inset(0.05).ok().as_deref(), 0.1, 0.05).unwrap();
    assert_eq!(found.on_surface.len() + found.medial.len(), 20);
    let mut along: Vec<f64> = found.medial.iter().map(|p| p[0]).collect();
    along.sort_by(f64::total_cmp);
    for i in 0..20 {
        let step = (along[(i + 1) % 20] - along[i]).rem_euclid(4.0);
        assert!((step - 0.2).abs() < 0.03, "{along:?}");
    }
}

/// Volume and area of the part of a ball above height `h`.
fn cap(radius: f64, h: f64) -> (f64, f64) {
    let high = radius - h;
    (
        PI * high * high * (3.0 * radius - high) / 3.0,
        TAU * radius * high,
    )
}

#[test]
fn a_ball_through_the_floor() {
    let ball = icosphere(6);
    for height in [-0.6, -0.2, 0.0, 0.3, 0.7] {
        let domain = Domain::new([-2.0, -2.0, height], [2.0, 2.0, 2.0]);
        let body = ball.continued(&domain).unwrap().unwrap();
        for depth in [0.0, 0.05, 0.1] {
            let moved = body.inset(depth).unwrap();
            let (volume, area) = cap(1.0 - depth, height);
            // Where the side is aslant the expansion is of first order.
            let within = 1e-3 + TAU * height.abs() * depth * depth / area;
            assert!(
                (moved.volume() / volume - 1.0).abs() < within,
                "{height} {depth}: {} {volume}",
                moved.volume()
            );
            assert!(
                (moved.measure() / area - 1.0).abs() < within,
                "{height} {depth}: {} {area}",
                moved.measure()
            );
        }
        is_like_images(&body, &ball, &domain, 2000);
        let moved = body.inset(0.05).unwrap();
        let count = (moved.measure() / 0.01).round() as usize;
        let samples = moved.sample(count).unwrap();
        assert_eq!(samples.len(), count);
        for site in &samples {
            assert!(site.point[2] > height - 1e-6);
            assert!((point::norm(site.point) - 0.95).abs() < 2e-3);
        }
    }
}

/// Nearest distances of points, images counted, over the mean one: the least and the greatest.
fn evenness(points: &[Closest<3>], domain: &Domain<3>) -> [f64; 2] {
    let nearest: Vec<f64> = (0..points.len())
        .map(|i| {
            (0..points.len())
                .filter(|&j| j != i)
                .map(|j| point::norm(domain.difference(points[i].point, points[j].point)))
                .fold(f64::INFINITY, f64::min)
        })
        .collect();
    let mean = nearest.iter().sum::<f64>() / nearest.len() as f64;
    [
        nearest.iter().copied().fold(f64::INFINITY, f64::min) / mean,
        nearest.iter().copied().fold(0.0, f64::max) / mean,
    ]
}

#[test]
fn pipes_are_endless() {
    for (axis, is_mesh_of_two) in [(2, false), (0, false), (1, true)] {
        let mut along = [0.0; 3];
        along[axis] = 2.0;
        let ends = [[0.5; 3], point::add([0.5; 3], along)];
        let pipe = Cylinder::new(ends[0], ends[1], 0.4)
            .unwrap()
            .mesh(1e-4)
            .unwrap();
        // Cut ends that single precision has moved.
        let moved: Vec<[f64; 3]> = (pipe.vertices().iter())
            .map(|v| {
                v.map(|x| {
                    if is_mesh_of_two {
                        f64::from(x as f32)
                    } else {
                        x
                    }
                })
            })
            .collect();
        let pipe = Mesh::new(moved, pipe.triangles().to_vec()).unwrap();
        let (mut low, mut high) = ([0.0; 3], [1.0; 3]);
        (low[axis], high[axis]) = (0.5, 2.5);
        let domain = Domain::new(low, high).with_periodic(std::array::from_fn(|k| k == axis));
        let body = pipe.continued(&domain).unwrap().unwrap();
        assert!(body.features().corners.is_empty() && body.features().edges.is_empty());
        for depth in [0.0, 0.05, 0.2] {
            let moved = body.inset(depth).unwrap();
            let r = 0.4 - depth;
            assert!(
                (moved.volume() / (TAU * r * r) - 1.0).abs() < 2e-3,
                "{depth}: {}",
                moved.volume()
            );
            assert!(
                (moved.measure() / (2.0 * TAU * r) - 1.0).abs() < 2e-3,
                "{depth}: {}",
                moved.measure()
            );
        }
        let moved = body.inset(0.05).unwrap();
        let count = (moved.measure() / 0.01).round() as usize;
        let samples = moved.sample(count).unwrap();
        assert_eq!(samples.len(), count);
        let [least, most] = evenness(&samples, &domain);
        assert!(least > 0.75 && most < 1.25, "{least} {most}");
        is_like_images(&body, &pipe, &domain, 1000);
    }
}

#[test]
fn edges_go_on_without_corners() {
    // A bar along x, with its edges, in an endless duct; and the same ending on two open sides.
    let bar = brick([0.0, 0.3, 0.3], [2.0, 0.8, 0.8]);
    for is_periodic in [true, false] {
        let domain =
            Domain::new([0.0; 3], [2.0, 1.0, 1.0]).with_periodic([is_periodic, false, false]);
        let body = bar.continued(&domain).unwrap().unwrap();
        for depth in [0.0, 0.05] {
            let moved = body.inset(depth).unwrap();
            let wide = 0.5 - 2.0 * depth;
            assert!(
                (moved.volume() - 2.0 * wide * wide).abs() < 1e-9,
                "{}",
                moved.volume()
            );
            assert!(
                (moved.measure() - 8.0 * wide).abs() < 1e-9,
                "{}",
                moved.measure()
            );
            let features = moved.features();
            assert!(features.corners.is_empty(), "{features:?}");
            let length = |edge: &Vec<[f64; 3]>| {
                edge.windows(2)
                    .map(|pair| point::distance(pair[0], pair[1]))
                    .sum::<f64>()
            };
            let total: f64 = features.edges.iter().map(length).sum();
            assert!((total - 8.0).abs() < 1e-6, "{total} {features:?}");
        }
        let moved = body.inset(0.05).unwrap();
        let samples = moved.sample(320).unwrap();
        let on_edge = samples
            .iter()
            .filter(|site| site.feature == crate::Feature::Edge)
            .count();
        assert_eq!(on_edge, 4 * 20);
        let [least, most] = evenness(&samples, &domain);
        assert!(least > 0.7 && most < 1.3, "{least} {most}");
    }
}

#[test]
fn turned_shells_meet_their_images_or_pass_open_sides() {
    let turn = Similarity::<3>::new(1.0, [0.3, 1.0, 0.2], 33.0, [0.4, 0.2, 0.6]).unwrap();
    let body = brick([-0.4, -0.3, -0.5], [0.5, 0.4, 0.6])
        .transformed(&turn)
        .unwrap();
    for periodic in [
        [false; 3],
        [true, false, false],
        [true, true, false],
        [true; 3],
    ] {
        let domain = Domain::new([0.0; 3], [1.0, 0.9, 1.1]).with_periodic(periodic);
        let continued = body.continued(&domain).unwrap().unwrap();
        is_like_images(&continued, &body, &domain, 1000);
    }
}
