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
    contents_of(mesh, depth, &|_| true, mesh.volume)
}

/// [`contents`] of the part of the surface that `counts`, of a body that has `volume` beneath that.
pub(crate) fn contents_of(
    mesh: &Mesh,
    depth: f64,
    counts: &(dyn Fn([f64; 3]) -> bool + Sync),
    volume: f64,
) -> Option<(f64, f64)> {
    let looks = (LOOKS * mesh.area / (depth * depth)).clamp(FEWEST, MOST_LOOKS);
    let (looks, _) = balls(mesh, looks as usize, depth, counts);
    let thin = looks.iter().filter(|ball| ball.is_thin).count();
    if (thin as f64) < SMALL * looks.len() as f64 || looks.is_empty() {
        return None;
    }
    let (balls, each) = balls(mesh, COUNTED, depth, counts);
    let fit = balls.iter().filter(|ball| ball.radius >= FITS * depth);
    let mut area = each * fit.count() as f64;
    let mut shell: f64 = each * balls.iter().map(|ball| ball.radius).sum::<f64>();
    let around: Vec<[f64; 2]> = (0..mesh.corners.len())
        .into_par_iter()
        .with_min_len(64)
        .map(|t| around_edges(mesh, t, depth, counts))
        .collect();
    for [strip, sector] in around {
        area += strip;
        shell += sector;
    }
    Some((area, (volume - shell).max(0.0)))
}

struct Beneath {
    /// Of the largest ball up to the depth that touches there.
    radius: f64,
    /// Whether the ball is stopped by a side that faces away.
    is_thin: bool,
}

/// Of so many places on all of the mesh those that count, and the area that each stands for.
fn balls(
    mesh: &Mesh,
    count: usize,
    depth: f64,
    counts: &(dyn Fn([f64; 3]) -> bool + Sync),
) -> (Vec<Beneath>, f64) {
    let feet = mesh.scatter(count);
    let each = mesh.area / feet.len().max(1) as f64;
    let balls = (feet.par_iter().with_min_len(64))
        .filter(|foot| counts(foot.point))
        .map(|foot| {
            let inward = point::scale(foot.normal, -1.0);
            let ball = Touching::at(mesh, foot.point, inward, depth);
            Beneath {
                radius: ball.radius,
                is_thin: ball.radius < FITS * depth && ball.is_between_sides(inward),
            }
        })
        .collect();
    (balls, each)
}

/// Area and volume around the reflex sides of a triangle, half of each: its neighbour has the other.
fn around_edges(
    mesh: &Mesh,
    t: usize,
    depth: f64,
    counts: &(dyn Fn([f64; 3]) -> bool + Sync),
) -> [f64; 2] {
    let corners = &mesh.corners[t];
    let mut sums = [0.0; 2];
    for k in 0..3 {
        let turn = mesh.normals.turn[t][k];
        if turn >= 0.0 {
            continue;
        }
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let middle = point::scale(point::add(a, b), 0.5);
        if !counts(middle) {
            continue;
        }
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

    use sphpack_neighbors::Domain;

    use super::*;
    use crate::mesh::tests::flanged;

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

    /// Cut by a side through the flange: of the inset the flange's upper half is left, of the pipe's wall nothing.
    #[test]
    fn a_wall_that_vanishes_within_a_box_is_not_counted() {
        let depth = 0.05;
        let domain = Domain::new([-2.0, -2.0, 0.1], [2.0, 2.0, 2.0]);
        let body = flanged(0.07).continued(&domain).unwrap().unwrap();
        let inset = body.inset(depth).unwrap();
        let (bore, rim, high) = (0.4 + depth, 0.9 - depth, 0.2 - depth - 0.1);
        let ring = PI * (rim * rim - bore * bore);
        let area = ring + 2.0 * PI * (rim + bore) * high;
        let (found, volume) = (inset.measure(), inset.volume());
        assert!((found / area - 1.0).abs() < 0.04, "{found} {area}");
        assert!(
            (volume / (ring * high) - 1.0).abs() < 0.06,
            "{volume} {}",
            ring * high
        );
        // From the wall the flange is what is near.
        let hit = inset.closest([0.435, 0.0, 0.8]);
        assert!((hit.distance - 0.65).abs() < 0.03, "{hit:?}");
    }
}
