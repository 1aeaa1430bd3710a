//! What of a mesh is too thin to have a level set, and what the level set of the rest comes to.

use rayon::prelude::*;
use sphpack_neighbors::point;

use super::Mesh;
use crate::surface::Surface;
use crate::thickness::Touching;

/// Places per depth² of the surface at which one looks for thin parts, within these bounds.
const LOOKS: f64 = 0.5;
const FEWEST: f64 = 1000.0;
const MOST_LOOKS: f64 = 10_000.0;

/// Places by which area and volume are counted where there are some: of 0.5 % each.
const COUNTED: usize = 40_000;

/// Thin parts of less than this part of the surface are left to the expansion: what it makes of a wing's tail is as good.
const SMALL: f64 = 0.05;

/// A ball fits where it has this part of its radius.
const FITS: f64 = 0.999;

/// Area and volume of the level set φ = −`depth`, where sides that face away from each other lie nearer than that on a part of the
/// surface that counts; `None` elsewhere. There an expansion by edges and vertices goes on with sides that have passed through
/// each other.
///
/// Every point of the body lies beneath a place of a face as deep as the ball that touches there goes, or around a reflex
/// edge; what lies around reflex vertices alone is left out.
pub(super) fn contents(mesh: &Mesh, depth: f64) -> Option<(f64, f64)> {
    let looks = (LOOKS * mesh.area / (depth * depth)).clamp(FEWEST, MOST_LOOKS);
    let balls = balls(mesh, looks as usize, depth);
    let thin = balls.iter().filter(|ball| ball.is_thin).count();
    if (thin as f64) < SMALL * balls.len() as f64 {
        return None;
    }
    let balls = self::balls(mesh, COUNTED, depth);
    let each = mesh.area / balls.len() as f64;
    let fit = balls.iter().filter(|ball| ball.radius >= FITS * depth);
    let mut area = each * fit.count() as f64;
    let mut shell: f64 = each * balls.iter().map(|ball| ball.radius).sum::<f64>();
    let around: Vec<[f64; 2]> = (0..mesh.corners.len())
        .into_par_iter()
        .with_min_len(64)
        .map(|t| around_edges(mesh, t, depth))
        .collect();
    for [strip, sector] in around {
        area += strip;
        shell += sector;
    }
    Some((area, (mesh.volume - shell).max(0.0)))
}

struct Beneath {
    /// Of the largest ball up to the depth that touches there.
    radius: f64,
    /// Whether the ball is stopped by a side that faces away.
    is_thin: bool,
}

fn balls(mesh: &Mesh, count: usize, depth: f64) -> Vec<Beneath> {
    (mesh.scatter(count).par_iter().with_min_len(64))
        .map(|foot| {
            let inward = point::scale(foot.normal, -1.0);
            let ball = Touching::at(mesh, foot.point, inward, depth);
            Beneath {
                radius: ball.radius,
                is_thin: ball.radius < FITS * depth && ball.is_between_sides(inward),
            }
        })
        .collect()
}

/// Area and volume around the reflex sides of a triangle, half of each: its neighbour has the other.
fn around_edges(mesh: &Mesh, t: usize, depth: f64) -> [f64; 2] {
    let corners = &mesh.corners[t];
    let mut sums = [0.0; 2];
    for k in 0..3 {
        let turn = mesh.normals.turn[t][k];
        if turn >= 0.0 {
            continue;
        }
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let middle = point::scale(point::add(a, b), 0.5);
        let ball = Touching::at(
            mesh,
            middle,
            point::scale(mesh.normals.face[t], -1.0),
            depth,
        );
        let round = 0.5 * -turn * point::distance(a, b);
        if ball.radius >= FITS * depth {
            sums[0] += round * depth;
        }
        sums[1] += 0.5 * round * ball.radius * ball.radius;
    }
    sums
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const FACETS: usize = 64;

    /// A profile of radius and height, turned about z.
    fn turned(profile: &[[f64; 2]]) -> Mesh {
        let count = profile.len() as u32;
        let mut vertices = Vec::new();
        let mut triangles = Vec::new();
        for n in 0..FACETS as u32 {
            let (sin, cos) = (2.0 * PI * f64::from(n) / FACETS as f64).sin_cos();
            for (k, &[radius, high]) in (0..).zip(profile) {
                vertices.push([radius * cos, radius * sin, high]);
                let at = |n: u32, k: u32| n % FACETS as u32 * count + k % count;
                let [a, b, c, d] = [at(n, k), at(n + 1, k), at(n + 1, k + 1), at(n, k + 1)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        Mesh::new(vertices, triangles).unwrap()
    }

    /// A pipe of inner radius 0.4 and this wall, with a flange at its foot.
    fn flanged(wall: f64) -> Mesh {
        let (bore, rim, thick, high) = (0.4, 0.9, 0.2, 1.0);
        let outer = bore + wall;
        turned(&[
            [bore, 0.0],
            [rim, 0.0],
            [rim, thick],
            [outer, thick],
            [outer, high],
            [bore, high],
        ])
    }

    #[test]
    fn a_wall_that_vanishes_is_not_counted() {
        let depth = 0.05;
        let mesh = flanged(0.07);
        let (area, volume) = contents(&mesh, depth).unwrap();
        let (bore, rim, thick) = (0.4 + depth, 0.9 - depth, 0.2 - 2.0 * depth);
        let ring = PI * (rim * rim - bore * bore);
        // Beneath the wall's foot the level set bulges by a hundredth.
        let exact = 2.0 * ring + 2.0 * PI * (rim + bore) * thick;
        assert!((area / exact - 1.0).abs() < 0.02, "{area} {exact}");
        assert!(
            (volume / (ring * thick) - 1.0).abs() < 0.04,
            "{volume} {}",
            ring * thick
        );
        let inset = mesh.inset(depth).unwrap();
        assert_eq!([inset.measure(), inset.volume()], [area, volume]);
    }

    #[test]
    fn a_wall_that_stays_is_left_to_the_expansion() {
        assert!(contents(&flanged(0.15), 0.05).is_none());
    }

    #[test]
    fn counted_and_expanded_agree_where_all_stays() {
        // Asked for in spite of that, by a depth at which a wall just vanishes.
        let mesh = flanged(0.1);
        let (area, volume) = contents(&mesh, 0.0501).unwrap();
        let expanded = mesh.inset(0.0499).unwrap();
        // The wall's two sides, in one place.
        let sheet = 2.0 * PI * 0.45 * (1.0 - 0.2) * 2.0;
        assert!((expanded.measure() / (area + sheet) - 1.0).abs() < 0.02);
        assert!((expanded.volume() / volume - 1.0).abs() < 0.03);
    }

    #[test]
    fn from_a_wall_without_level_set_the_nearest_point_is_in_the_flange() {
        let depth = 0.05;
        let inset = flanged(0.07).inset(depth).unwrap();
        for n in 0..20 {
            let (high, angle) = (0.3 + 0.035 * f64::from(n), 0.3 * f64::from(n));
            let p = [0.435 * angle.cos(), 0.435 * angle.sin(), high];
            let hit = inset.closest(p);
            let exact = high - 0.15;
            // The bulge beneath the wall's foot is nearer by a little.
            assert!(
                hit.distance < exact + 0.005 && hit.distance > exact - 0.03,
                "{high} {hit:?}"
            );
            assert!(inset.closest_within(p, exact - 0.03).is_none());
            assert!(inset.closest_within(p, exact + 0.005).is_some());
        }
    }
}
