//! What a packing must be before anyone is told that it is done.

mod anew;
mod anyone;
mod packed;
mod walls;

use std::time::Instant;

use rayon::prelude::*;
use serde::Serialize;
use sphpack_neighbors::{point, words};
use sphpack_packing::closest_pair::CROWDED;
use sphpack_packing::{Depths, Kind, MethodInfo};
use sphpack_separation::Side;

use crate::asked::Asked;
use crate::scene::Role;
use crate::solution::Solution;

pub use packed::{Audited, Unsound};

/// A particle is on the wrong side of a true surface that is deeper behind it than this, in ∆s.
const WRONG_SIDE_OVER_SPACING: f64 = 0.1;

/// A particle on a surface is within this of it, in ∆s.
const ON_SURFACE_OVER_SPACING: f64 = 1e-6;

/// A body's volume is right to this part of it, or to half a particle, whichever is larger.
const VOLUME_WITHIN: f64 = 0.01;

/// All volumes together are the box's, to this part of it.
const WHOLE_WITHIN: f64 = 1e-9;

/// The content of report.json's `audit`: a packing, looked at by what it promises, after it was separated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Audit {
    /// Whether nothing was found.
    pub passed: bool,
    /// Particles outside the box; on periodic axes, not between its sides.
    pub outside: usize,
    /// Smallest distance of two particles, images counted, in ∆s.
    pub closest_pair_over_spacing: f64,
    /// Largest part by which the volume of a body, or of all particles, is off what was asked for.
    pub volume_error: f64,
    /// Particles that an exact closest point says are on the other side of a surface, or off theirs.
    pub wrong_side: usize,
    /// Smallest Γ.
    pub gamma_min: f64,
    /// Largest Γ.
    pub gamma_max: f64,
    /// Where the first of `messages` is seen worst; empty where it has no place.
    pub worst_at: Vec<f64>,
    /// What is wrong, the likely cause and the cure; a sentence each.
    pub messages: Vec<String>,
    /// What it took, of the packing's `seconds.measuring`.
    pub seconds: f64,
    /// ∆s: places are told apart by parts of it.
    #[serde(skip)]
    spacing: f64,
}

impl Audit {
    /// Nothing found yet.
    fn clean(
        spacing: f64,
        closest_pair_over_spacing: f64,
        [gamma_min, gamma_max]: [f64; 2],
    ) -> Self {
        Self {
            passed: true,
            outside: 0,
            closest_pair_over_spacing,
            volume_error: 0.0,
            wrong_side: 0,
            gamma_min,
            gamma_max,
            worst_at: Vec::new(),
            messages: Vec::new(),
            seconds: 0.0,
            spacing,
        }
    }

    fn found<const D: usize>(&mut self, message: String, at: Option<[f64; D]>) {
        if self.messages.is_empty() {
            self.worst_at = at.map_or_else(Vec::new, |p| p.to_vec());
        }
        let place = at.map_or_else(String::new, |p| {
            format!(", worst at {}", words::place(&p, self.spacing))
        });
        self.messages.push(format!("{message}{place}"));
        self.passed = false;
    }

    /// Audits a separated packing. `volumes` are those of every body's particles, and of the fluid's last.
    pub(crate) fn of<const D: usize>(
        asked: &Asked,
        solution: &Solution<D>,
        volumes: &[f64],
    ) -> Self {
        let begin = Instant::now();
        let quality = &solution.quality;
        let density = &quality.density;
        let mut audit = Self::clean(
            solution.problem.spacing(),
            quality.closest_pair_over_spacing,
            [density.min, density.max],
        );
        audit.numbers(solution);
        if audit.passed {
            audit.places(solution);
            audit.pairs(solution);
            audit.volumes(asked, solution, volumes);
            audit.sides(asked, solution);
            audit.density(asked, solution);
            audit.sums(solution);
        }
        if !audit.passed {
            audit.messages.push(cure(asked.method));
        }
        audit.seconds = begin.elapsed().as_secs_f64();
        audit
    }

    /// Numbers are finite, ids unique.
    fn numbers<const D: usize>(&mut self, solution: &Solution<D>) {
        let particles = &solution.packed.particles;
        let bad = (0..particles.len()).find(|&i| {
            !(point::is_finite(particles.position[i])
                && particles.volume[i].is_finite()
                && particles.volume[i] > 0.0
                && solution.fields.gamma[i].is_finite()
                && point::is_finite(solution.fields.gradient[i]))
        });
        if let Some(i) = bad {
            let message = format!(
                "particle {} has a place, volume or density that is no finite, positive number",
                particles.id[i]
            );
            self.found::<D>(message, None);
        }
        let mut ids = particles.id.clone();
        ids.sort_unstable();
        if let Some(pair) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
            self.found::<D>(format!("two particles have the number {}", pair[0]), None);
        }
    }

    /// Nothing is outside the box.
    fn places<const D: usize>(&mut self, solution: &Solution<D>) {
        let particles = &solution.packed.particles;
        let domain = &solution.packed.domain;
        let slack = 1e-9 * solution.packed.spacing;
        let mut worst = (0.0, [0.0; D]);
        for i in (0..particles.len()).filter(|&i| particles.kind[i] != Kind::Frozen) {
            let p = particles.position[i];
            let beyond = (0..D).fold(0.0, |most: f64, k| {
                most.max(domain.bounds.min[k] - p[k])
                    .max(p[k] - domain.bounds.max[k])
            });
            if beyond > slack {
                self.outside += 1;
                if beyond > worst.0 {
                    worst = (beyond, p);
                }
            }
        }
        if self.outside > 0 {
            let message = format!(
                "{} outside the box, by up to {:.2} spacings",
                particles_are(self.outside),
                worst.0 / solution.packed.spacing
            );
            self.found(message, Some(worst.1));
        }
    }

    /// Γ and the residual are what the particles give, frozen ones included.
    fn sums<const D: usize>(&mut self, solution: &Solution<D>) {
        if let Some((i, message)) = anew::differs(solution) {
            let message = format!("{message}; this is a fault of sphpack");
            self.found(message, Some(solution.packed.particles.position[i]));
        }
    }

    /// No two particles are in the room of one.
    fn pairs<const D: usize>(&mut self, solution: &Solution<D>) {
        let quality = &solution.quality;
        if quality.crowded < CROWDED || quality.closest_pair_over_spacing.is_nan() {
            let at = point::of_slice(&quality.crowded_at);
            let message = format!(
                "two particles are only {:.3} of their size apart",
                quality.crowded
            );
            self.found::<D>(message, Some(at));
        }
    }

    /// Every body has the volume that was asked for, and all together the box's.
    fn volumes<const D: usize>(&mut self, asked: &Asked, solution: &Solution<D>, volumes: &[f64]) {
        let problem = &solution.problem;
        let particles = &solution.packed.particles;
        let mut rooms = problem.rooms();
        let sites = largest_sites(solution);
        // Parts too small for a particle leave their volume to what is around them, and a warning says so.
        for omitted in &solution.packed.omitted {
            rooms[omitted.body] -= omitted.volume;
        }
        // What a scene asks for is asked for.
        for (room, excess) in rooms.iter_mut().zip(&solution.packed.excess) {
            *room += excess;
        }
        for (number, body) in problem.bodies.iter().enumerate() {
            if asked.role(number) != Role::Solid {
                continue;
            }
            let (asked, has, site) = (rooms[number], volumes[number], sites[number]);
            let off = (has - asked).abs();
            self.volume_error = self.volume_error.max(off / asked.max(site));
            if off > (VOLUME_WITHIN * asked).max(0.5 * site) * (1.0 + 1e-9) {
                let message = format!(
                    "the particles of body \"{}\" have a volume of {has:.4e}, {:.2} % {} than its {asked:.4e}",
                    body.name,
                    100.0 * off / asked.abs(),
                    if has > asked { "more" } else { "less" }
                );
                self.found(message, Some(body.surface.bounds().center()));
            }
        }
        if asked.method.fills_box {
            let whole = problem.domain.bounds.volume();
            let sum: f64 = (0..particles.len())
                .filter(|&i| particles.kind[i] != Kind::Frozen)
                .map(|i| particles.volume[i])
                .sum();
            // Where the fluid has no particle, it may lack half of one.
            let has_fluid = volumes[problem.bodies.len()] > 0.0;
            let slack = WHOLE_WITHIN * whole
                + if has_fluid {
                    0.0
                } else {
                    0.5 * sites[problem.bodies.len()]
                };
            let off = sum - whole;
            self.volume_error = self.volume_error.max(off.abs() / whole);
            if off.abs() > slack {
                let message = format!(
                    "all particles together have a volume that is {:.1e} of the box's too {}",
                    off.abs() / whole,
                    if off > 0.0 { "large" } else { "small" }
                );
                self.found::<D>(message, None);
            }
        }
    }

    /// Every particle is where its label says, by the exact closest point.
    fn sides<const D: usize>(&mut self, asked: &Asked, solution: &Solution<D>) {
        let Solution {
            problem,
            packed,
            labels,
            ..
        } = solution;
        let particles = &packed.particles;
        let spacing = packed.spacing;
        // Asked anew: what the packing has noted is what it believes.
        let off = |i: usize| match particles.on_surface(i).map(usize::from) {
            Some(body) if particles.kind[i] == Kind::Boundary => {
                let surface = &packed.surfaces[body].surface;
                surface.closest(particles.position[i]).distance.abs() / spacing
            }
            _ => 0.0,
        };
        let far = (0..particles.len()).into_par_iter().with_min_len(256);
        let far = far.map(off).reduce(|| 0.0, f64::max);
        if far > ON_SURFACE_OVER_SPACING {
            self.wrong_side += 1;
            let message = format!("a boundary particle is {far:.1e} spacings off its surface");
            self.found::<D>(message, None);
        }
        // Where sizes differ, particle surfaces are no insets that geometry made: they are asked whether they are within.
        let is_graded = particles.sizes.relative().is_some();
        let outside = (0..particles.len()).into_par_iter().with_min_len(256);
        let outside = outside.filter(|&i| {
            let body = particles.on_surface(i).map(usize::from);
            is_graded
                && body.is_some_and(|body| {
                    let phi = problem.bodies[body].surface.closest(particles.position[i]);
                    asked.role(body) == Role::Solid
                        && phi.distance > WRONG_SIDE_OVER_SPACING * spacing
                })
        });
        let outside = outside.count();
        if outside > 0 {
            self.wrong_side += outside;
            let message = format!("{} outside of the body", particles_are(outside));
            self.found::<D>(message, None);
        }
        let free: Vec<usize> = (0..particles.len())
            .filter(|&i| particles.kind[i] == Kind::Free)
            .collect();
        let places: Vec<[f64; D]> = free.iter().map(|&i| particles.position[i]).collect();
        let slack = WRONG_SIDE_OVER_SPACING * spacing;
        let bounds = problem.domain.bounds;
        // It looks cube by cube, some for every particle: where sizes differ, by the mean one. At the finest a wing of 95,000
        // particles of 50 : 1 took 6 million.
        let mean = if is_graded {
            (bounds.volume() / places.len().max(1) as f64).powf(1.0 / D as f64)
        } else {
            spacing
        };
        let depths = Depths::of(&problem.bodies, bounds, mean, slack, &places);
        let role = |b: usize| asked.role(b);
        let mut count = 0;
        let mut worst = (0.0, [0.0; D], String::new());
        for (place, &i) in free.iter().enumerate() {
            if !solution.keep[i] {
                continue;
            }
            let held = labels.body[i].map(usize::from);
            for (b, body) in problem.bodies.iter().enumerate() {
                let phi = Some(depths.to_body(b, place))
                    .filter(|phi| phi.is_finite())
                    .unwrap_or_else(|| body.surface.closest(places[place]).distance);
                let (beyond, how) = match (held, role(b)) {
                    (Some(own), Role::Solid) if own == b => (phi, "out of"),
                    (_, Role::Container) => (phi, "out of"),
                    (None, _) => (-phi, "in"),
                    _ => continue,
                };
                if beyond <= slack {
                    continue;
                }
                // Containers beside each other: within one is enough.
                let is_elsewhere = role(b) == Role::Container
                    && (0..problem.bodies.len())
                        .any(|c| role(c) == Role::Container && depths.to_body(c, place) <= slack);
                if is_elsewhere {
                    continue;
                }
                count += 1;
                if beyond > worst.0 {
                    let what = match labels.side[i] {
                        Side::Solid => "solid",
                        Side::Fluid => "fluid",
                    };
                    let words = format!(
                        "{what}, {:.2} spacings {how} \"{}\"",
                        beyond / spacing,
                        body.name
                    );
                    worst = (beyond, places[place], words);
                }
                break;
            }
        }
        if count > 0 {
            self.wrong_side += count;
            let message = format!(
                "{} on the wrong side of a surface: the worst is {}",
                particles_are(count),
                worst.2
            );
            self.found(message, Some(worst.1));
        }
    }

    /// Γ is what the method can do.
    fn density<const D: usize>(&mut self, asked: &Asked, solution: &Solution<D>) {
        let within = asked.method.gamma_within;
        let (fields, particles) = (&solution.fields, &solution.packed.particles);
        let lattice = solution.quality.density.lattice;
        let mut worst = (0.0, [0.0; D], 0.0);
        for i in (0..particles.len()).filter(|&i| particles.kind[i] != Kind::Frozen) {
            let off = (fields.gamma[i] - lattice).abs();
            if solution.keep[i] && off > worst.0 {
                worst = (off, particles.position[i], fields.gamma[i]);
            }
        }
        if worst.0 > within {
            let message = format!(
                "the density is off by {:.1} % (Γ = {:.4}), more than the {:.0} % that method \"{}\" stays within",
                100.0 * worst.0,
                worst.2,
                100.0 * within,
                asked.method.name
            );
            self.found(message, Some(worst.1));
        }
    }
}

/// What a particle of every body, and of the fluid last, has for its volume; the largest where they differ.
fn largest_sites<const D: usize>(solution: &Solution<D>) -> Vec<f64> {
    let Solution {
        problem,
        packed,
        labels,
        ..
    } = solution;
    let count = problem.bodies.len() + 1;
    let particles = &packed.particles;
    if particles.sizes.relative().is_none() {
        return vec![problem.filling().volume_per_site(); count];
    }
    let mut sites = vec![problem.spacing().powi(D as i32); count];
    for i in (0..particles.len()).filter(|&i| particles.kind[i] != Kind::Frozen) {
        let of = labels.body[i].map_or(count - 1, usize::from);
        sites[of] = f64::max(sites[of], particles.sizes.spacing(i).powi(D as i32));
    }
    sites
}

fn particles_are(count: usize) -> String {
    match count {
        1 => "1 particle is".to_owned(),
        n => format!("{n} particles are"),
    }
}

/// What most likely helps.
fn cure(info: &MethodInfo) -> String {
    if info.is_published {
        format!(
            "method \"{}\" does as its paper says, which does not keep this from happening; method = \"balanced\" does better, or a smaller spacing",
            info.name
        )
    } else {
        "places thinner or narrower than two spacings are the likely cause; a smaller spacing there, more room around the bodies, or a plainer body will do".to_owned()
    }
}

#[cfg(test)]
mod tests;
