//! Counts that are tried out: how many particles on its surface and inside leave a small part even.
//!
//! What length and volume ask for is right to half a particle. For a large part that is little; in a square of 2.2 … 2.8 or
//! 3.2 … 3.4 ∆s it is the difference between five particles of which one has to go between two corners, 0.6 ∆s from
//! either, and four larger ones in the corners alone. No rule for the counts was found that holds for all sizes, but
//! for nearly all there are some that settle evenly. So a small part that does not is packed alone with
//! others, in a box of its own, until some do. Parts that are even with the usual counts keep them, and every bit.
//! The idea is this project's own; `cargo xtask bodies` (docs/bodies.md) and `cargo xtask stability map parts` show what comes of it.

use std::sync::Arc;

use rayon::prelude::*;
use sphpack_geometry::{Closest, Surface};
use sphpack_neighbors::{Domain, point};

use super::Balanced;
use super::remembered::Remembered;
use super::sampled::Sampled;
use super::shares::directly_inside;
use crate::minimise::Settling;
use crate::observer::Silent;
use crate::packed::StopReason;
use crate::problem::{Body, DEFAULT_INSET_OVER_SPACING, PackingError, Problem};
use crate::run_log::RunLog;

/// How many particles a part gets. They share its volume evenly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) on_surface: usize,
    pub(super) inside: usize,
}

/// Knows better counts than areas and volumes tell, for every part or for some.
pub(super) type Choose<'a, const D: usize> =
    dyn Fn(&Problem<D>, &Sampled<D>, &mut RunLog<'_>) -> Vec<Option<Counts>> + 'a;

/// Parts wider than this on the whole, in ∆s, have the room to even out: the volume over half the particle surface's length.
const WIDEST: f64 = 3.6;

/// Parts of more than this, in ∆s^D, are too dear to try; in the plane and in space.
const MOST_VOLUME: [f64; 2] = [300.0, 100.0];

/// Parts of less than this, in ∆s^D, are tried though they are thin: two particles in a square of 1.3 ∆s are 0.4 ∆s apart.
const TINY: f64 = 4.0;

/// The room around a part that is packed alone, in ∆s, in the plane and in space.
const AROUND: [f64; 2] = [4.0, 3.0];

/// The particles of all tries together, but for those that are tried again, beside as many as the whole problem has: so many settle in
/// two to five seconds, in the plane and in space.
const PARTICLES: [f64; 2] = [100_000.0, 15_000.0];

/// Lengths of parts of one shape differ by less than this, in ∆s.
const SAME: f64 = 1e-6;

/// Parts between which an end is looked for.
const AT_ONCE: usize = 16;

/// What the usual counts have to reach to be kept, and others to be taken at once; the best of those tried must otherwise be
/// better than the usual ones by a little where it reaches 1, or by much. Neighbours cost some of it: 1 is L∞ = 0.5 % or a pair
/// 0.8 ∆s apart.
const EVEN: [f64; 2] = [0.92, 0.97];
const VERY_EVEN: [f64; 2] = [0.88, 0.92];
const WORTH: f64 = 0.98;
const MUCH: f64 = 0.8;
const LINF: f64 = 0.005;
const APART: f64 = 0.8;

/// Other phases of the lattice with which what seems best is tried again.
const AGAIN: u64 = 2;

/// Evaluations after which a try is none.
const EVALUATIONS: usize = 200;

/// How many points more and fewer on a surface are tried, in steps of one or of this part of all.
const MORE: usize = 2;
const FEWER: usize = 4;
const STEP: f64 = 0.05;

/// Particles of a part from one try to the next: one, or this part of all.
const VOLUME_STEP: f64 = 0.03;

/// The volumes of a particle that are tried, in ∆s^D: in a part of volume V from the first to the second and the third over V. Larger
/// ones can be evener still, but who asks for a spacing wants it.
const VOLUMES: [f64; 3] = [0.8, 1.2, 2.5];

/// The counts of every part, `None` where the usual ones are best or nothing was tried: of large and thin parts, of those that hold
/// others, and where sides are periodic.
pub(super) fn counts<const D: usize>(
    method: &Balanced,
    problem: &Problem<D>,
    sampled: &Sampled<D>,
    log: &mut RunLog<'_>,
) -> Vec<Option<Counts>> {
    let mut counts = vec![None; problem.bodies.len()];
    if problem.domain.is_periodic() {
        return counts;
    }
    // Whatever else is asked for: counts are good or bad by where particles find room, and this settles fastest.
    let method = Balanced {
        settling: Settling {
            max_evaluations: EVALUATIONS,
            ..Settling::default()
        },
        band: method.band,
    };
    let inside = directly_inside(&problem.bodies, problem.spacing());
    let small: Vec<usize> = (0..problem.bodies.len())
        .filter(|&part| inside[part].is_empty() && is_small(problem, sampled, part))
        .collect();
    let size =
        |bounds: sphpack_neighbors::Bounds<D>| bounds.volume() / problem.spacing().powi(D as i32);
    let like = first_of_its_shape(problem, sampled, &small);
    let firsts: Vec<usize> = (small.iter().zip(&like))
        .filter(|(part, like)| part == like)
        .map(|(&part, _)| part)
        .collect();
    // The same for every part, so that the result does not depend on who is first.
    let each =
        (PARTICLES[usize::from(D == 3)] + size(problem.domain.bounds)) / firsts.len().max(1) as f64;
    for parts in firsts.chunks(AT_ONCE) {
        log.tell();
        if log.interrupted {
            break;
        }
        let found: Vec<Option<Counts>> = (parts.par_iter())
            .map(|&part| {
                let alone = alone(problem, part);
                let tries = each / size(alone.domain.bounds);
                best(&method, &alone, &sampled.samples[part], tries as usize)
            })
            .collect();
        for (&part, found) in parts.iter().zip(found) {
            counts[part] = found;
        }
    }
    for (&part, &like) in small.iter().zip(&like) {
        counts[part] = counts[like];
    }
    counts
}

/// For every one of some parts the first that is as large and as long to every side, and has a surface as large: a grid of equal
/// parts is tried once.
fn first_of_its_shape<const D: usize>(
    problem: &Problem<D>,
    sampled: &Sampled<D>,
    parts: &[usize],
) -> Vec<usize> {
    let figures = |part: usize| -> Vec<f64> {
        let surface = problem.bodies[part].surface.as_ref();
        let mut figures = surface.bounds().size().to_vec();
        figures.push(surface.volume().powf(1.0 / D as f64));
        figures.push(surface.measure().powf(1.0 / (D as f64 - 1.0)));
        figures.push(sampled.samples[part].len() as f64 * problem.spacing());
        figures
    };
    let figures: Vec<Vec<f64>> = parts.iter().map(|&part| figures(part)).collect();
    let is_like = |a: &[f64], b: &[f64]| {
        (a.iter().zip(b)).all(|(a, b)| (a - b).abs() <= SAME * problem.spacing())
    };
    (0..parts.len())
        .map(|i| {
            parts[(0..=i)
                .find(|&j| is_like(&figures[j], &figures[i]))
                .unwrap_or(i)]
        })
        .collect()
}

/// Spreads the points of parts with counts of their own.
pub(super) fn sample_anew<const D: usize>(
    bodies: &[Body<D>],
    sampled: &mut Sampled<D>,
    counts: &[Option<Counts>],
) -> Result<(), PackingError> {
    for (part, counts) in counts.iter().enumerate() {
        let Some(counts) = counts else { continue };
        let surface = &sampled.surfaces[part].surface;
        sampled.samples[part] =
            (surface.sample(counts.on_surface)).map_err(|error| PackingError::Surface {
                body: bodies[part].name.clone(),
                error,
            })?;
    }
    Ok(())
}

/// Whether other counts may be tried for a part: it is small, nowhere thin unless it is tiny, and all of it is in the box.
fn is_small<const D: usize>(problem: &Problem<D>, sampled: &Sampled<D>, part: usize) -> bool {
    let body = &problem.bodies[part];
    let bounds = body.surface.bounds();
    let spacing = problem.spacing();
    let length = sampled.surfaces[part].surface.measure() / spacing.powi(D as i32 - 1);
    let volume = body.surface.volume() / spacing.powi(D as i32);
    body.inset_over_spacing == DEFAULT_INSET_OVER_SPACING
        && body.surface.window().is_none()
        && problem.domain.bounds.contains_box(&bounds)
        && volume <= MOST_VOLUME[usize::from(D == 3)].min(0.5 * WIDEST * length)
        && sampled.excess[part] == 0.0
        // Thin parts get other counts than their length asks for.
        && (sampled.samples[part].len() == length.round() as usize || volume <= TINY)
}

/// A part in a box of its own: of whole cells of the problem's lattice, so that the same sites are in it. With others a part that was
/// even alone was not among its neighbours.
fn alone<const D: usize>(problem: &Problem<D>, part: usize) -> Problem<D> {
    let mut body = problem.bodies[part].clone();
    body.surface = Arc::new(Remembered::new(body.surface));
    let mut bounds = body
        .surface
        .bounds()
        .grown(AROUND[usize::from(D == 3)] * problem.spacing());
    let (cell, origin) = (problem.filling().cell(), problem.domain.bounds.min);
    for k in 0..D {
        let cells = |place: f64| (place - origin[k]) / cell[k];
        bounds.min[k] = origin[k] + cells(bounds.min[k]).floor() * cell[k];
        bounds.max[k] = origin[k] + cells(bounds.max[k]).ceil() * cell[k];
    }
    Problem {
        domain: Domain {
            bounds,
            periodic: [false; D],
        },
        bodies: vec![body],
        judging_reach: 0.0,
        ..problem.clone()
    }
}

/// The first counts that leave the only part of `alone` even, at most so many being tried; `None` where its usual ones do, or
/// none are much better.
fn best<const D: usize>(
    method: &Balanced,
    alone: &Problem<D>,
    usual: &[Closest<D>],
    tries: usize,
) -> Option<Counts> {
    if tries < 2 {
        return None;
    }
    let with_usual = unevenness(method, alone, None);
    if with_usual <= EVEN[usize::from(D == 3)] {
        return None;
    }
    let mut best = ((WORTH * with_usual).min((MUCH * with_usual).max(1.0)), None);
    for counts in candidates(alone, usual.len()).into_iter().take(tries - 1) {
        let mut found = unevenness(method, alone, Some(counts));
        // Seven particles in a square of 2.6 ∆s were even in a try, and 0.65 ∆s apart among neighbours: luck of the sites.
        for seed in 1..=AGAIN {
            if found < best.0 {
                let again = Problem {
                    seed: alone.seed.wrapping_add(seed),
                    ..alone.clone()
                };
                found = found.max(unevenness(method, &again, Some(counts)));
            }
        }
        if found < best.0 {
            best = (found, Some(counts));
        }
        if found <= VERY_EVEN[usize::from(D == 3)] {
            break;
        }
    }
    best.1
}

/// How much worse than even a part settles with the counts given: the larger of L∞ and closeness, over what is asked of both.
fn unevenness<const D: usize>(
    method: &Balanced,
    alone: &Problem<D>,
    counts: Option<Counts>,
) -> f64 {
    let mut nobody = Silent;
    let mut log = RunLog::new(&mut nobody);
    match method.pack_counted(alone, &mut log, &[], &|_, _, _| vec![counts]) {
        Ok(packed) if packed.stop_reason == StopReason::Converged => {
            let quality = packed.quality();
            (quality.density.linf / LINF).max(APART / quality.closest_pair_over_spacing)
        }
        _ => f64::INFINITY,
    }
}

/// Counts to try for the only part, those first whose particles are nearest to ∆s^D in size. Points on the surface are far enough
/// apart from the beginning.
fn candidates<const D: usize>(alone: &Problem<D>, usual: usize) -> Vec<Counts> {
    let body = &alone.bodies[0];
    let spacing = alone.spacing();
    let volume = body.surface.volume() / spacing.powi(D as i32);
    let Ok(Some(surface)) = super::inset(body, spacing) else {
        return Vec::new();
    };
    let corners = surface.features().corners.len();
    let step = ((STEP * usual as f64).round() as usize).max(1);
    let fewest = usual.saturating_sub(FEWER * step);
    let volume_step = ((VOLUME_STEP * volume).round() as usize).max(1);
    let mut candidates = Vec::new();
    for on_surface in (fewest..=usual + MORE * step).step_by(step) {
        // Where every corner has a point it keeps it.
        if on_surface == 0 || (corners <= usual && on_surface < corners) {
            continue;
        }
        let is_apart = |points: Vec<Closest<D>>| {
            (points.iter().enumerate()).all(|(i, a)| {
                (points[..i].iter()).all(|b| point::distance(a.point, b.point) >= APART * spacing)
            })
        };
        if !surface.sample(on_surface).is_ok_and(is_apart) {
            continue;
        }
        let largest = VOLUMES[1] + VOLUMES[2] / volume;
        let all = (volume / largest).ceil() as usize..=(volume / VOLUMES[0]).floor() as usize;
        // One inside among two on the surface was even in all phases, and not among neighbours.
        let most_inside = if volume <= TINY { 0 } else { usize::MAX };
        let is_possible = |&all: &usize| all >= on_surface && all - on_surface <= most_inside;
        for all in all.step_by(volume_step).filter(is_possible) {
            candidates.push(Counts {
                on_surface,
                inside: all - on_surface,
            });
        }
    }
    let off = |counts: &Counts| {
        let all = (counts.on_surface + counts.inside) as f64;
        ((volume / all).ln().abs(), counts.on_surface.abs_diff(usual))
    };
    candidates.sort_by(|a, b| {
        off(a)
            .partial_cmp(&off(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    candidates
}
