//! Triangles as particles: the baseline of Negi & Ramachandran (preprint), §3 in the plane.

use std::time::Instant;

use spade::{
    AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation,
};
use sphpack_geometry::{Surface, polygons};
use sphpack_neighbors::point;

use crate::estimate::Work;
use crate::methods::info::{MethodInfo, Moves};
use crate::observer::Stage;
use crate::packed::Packed;
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::run_log::RunLog;
use crate::seeding::{particle_surfaces, seed};

/// Each body is cut into triangles of about ∆s², no angle below 25° but where the body itself is sharper, and each
/// triangle becomes a particle at its centroid that carries its area (Negi & Ramachandran preprint, §3). The fluid is
/// the lattice's sites outside the bodies. Nothing moves: the surface is met, the density is as uneven as the
/// triangles.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Triangulated;

/// A side of an equilateral triangle of area 1.
const SIDE: f64 = 1.519_671_371_303_185;

/// No angle is below this many degrees.
const LEAST_ANGLE: f64 = 25.0;

/// Rounds in which the greatest allowed area is fitted to the mean that is wanted.
const ROUNDS: usize = 8;

/// Triangles per area that is wanted at most: what a body's own sharp corners may ask for.
const MOST: f64 = 20.0;

impl Triangulated {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "triangulated",
        summary: "bodies cut into triangles that carry their area, not moved; 2-D: what to compare with",
        dimensions: &[2],
        fills_box: false,
        moves: Moves::Nothing,
        work: Work::PLAIN,
        ..MethodInfo::USUAL
    };

    /// Fills the box. One evaluation, to measure.
    ///
    /// # Errors
    /// Those of [`Problem::check`], [`PackingError::Surface`] and [`PackingError::OnlyPlane`].
    pub(crate) fn pack_in<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
    ) -> Result<Packed<D>, PackingError> {
        Self::INFO.check_dimension(D)?;
        log.begin(&Self::INFO, 0.0, 1);
        problem.check_uniform()?;
        log.enter(Stage::Geometry);
        let geometry = Instant::now();
        let surfaces = particle_surfaces(problem)?;
        let mut particles = Particles::new(problem.sizes());
        for (body, number) in problem.bodies.iter().zip(0_u16..) {
            let earlier = &problem.bodies[..usize::from(number)];
            for (p, area) in triangles(body.surface.as_ref(), problem.spacing()) {
                if !earlier.iter().any(|other| other.surface.inside(p)) {
                    particles.push(p, Kind::Free, area, Some(number));
                }
            }
        }
        log.seconds.geometry = geometry.elapsed().as_secs_f64();
        log.enter(Stage::Seeding);
        let seeding = Instant::now();
        let seeds = seed(problem)?;
        seeds.surround(problem, &mut particles);
        log.seconds.seeding = seeding.elapsed().as_secs_f64();
        Ok(log.end_unmoved(problem, particles, seeds.frozen_lattice, surfaces))
    }
}

/// Centroids and areas of the triangles of a body, `spacing`² in the mean.
fn triangles<const D: usize>(body: &dyn Surface<D>, spacing: f64) -> Vec<([f64; D], f64)> {
    let wanted = spacing * spacing;
    let loops = polygons(body, SIDE * spacing);
    let mut greatest = 1.5 * wanted;
    let mut best: (f64, Vec<([f64; D], f64)>) = (f64::INFINITY, Vec::new());
    for _ in 0..ROUNDS {
        let found = cut(body, &loops, greatest);
        let mean = body.volume() / found.len().max(1) as f64;
        let off = (mean / wanted).ln();
        if off.abs() < best.0 {
            best = (off.abs(), found);
        }
        greatest /= (mean / wanted).clamp(0.5, 2.0);
    }
    best.1
}

/// The triangles of no more than the `greatest` area that fill the body within its polygons.
fn cut<const D: usize>(
    body: &dyn Surface<D>,
    loops: &[Vec<[f64; D]>],
    greatest: f64,
) -> Vec<([f64; D], f64)> {
    let mut triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    for polygon in loops {
        // What cannot be inserted, a point that is not finite, is left out; so is a side that crosses one that is there.
        let corners: Vec<_> = (polygon.iter())
            .filter_map(|p| triangulation.insert(Point2::new(p[0], p[1])).ok())
            .collect();
        for (i, &corner) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            if corner != next && triangulation.can_add_constraint(corner, next) {
                triangulation.add_constraint(corner, next);
            }
        }
    }
    let most = MOST * body.volume() / greatest;
    triangulation.refine(
        RefinementParameters::new()
            .exclude_outer_faces(true)
            .with_max_allowed_area(greatest)
            .with_angle_limit(AngleLimit::from_deg(LEAST_ANGLE))
            .with_max_additional_vertices(most as usize),
    );
    (triangulation.inner_faces())
        .map(|face| {
            let center = face.center();
            (point::of_slice(&[center.x, center.y]), face.area())
        })
        .filter(|&(p, _)| body.inside(p))
        .collect()
}
