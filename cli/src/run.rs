//! The way of the data: scene, problem, particles, labels, figures.

use sphpack_neighbors::{point, words};
use sphpack_packing::{Kind, Observer, StopReason};
use sphpack_separation::Side;

use std::time::Instant;

use crate::Error;
use crate::asked::Asked;
use crate::audit::Audit;
use crate::auto::AutoReport;
use crate::body_file::ReadBody;
use crate::content::Content;
use crate::corrected;
use crate::dimension::{Dimension, Space, in_dimension};
use crate::hydrostatic::AtRest;
use crate::labels::{Sorted, sort};
use crate::methods::pack;
use crate::opened::{Opened, opened};
use crate::plan::{Prepared, available_bytes, judged, prepare};
use crate::report::{
    BodyReport, Counts, MassReport, Report, ResolutionReport, RigidReport, SCHEMA, SecondsReport,
    finite, finite_surface, peak_memory_bytes,
};
use crate::scene::{Masses, Role, Scene};
use crate::solution::{Packing, Solution};
use crate::table::{Shared, Table};
use crate::walls::{self, WallReport};

/// What particle files say in place of the reason why settling stopped, where the audit has found something.
const UNSOUND: &str = "unsound";

/// And where the scene's accuracy is not reached.
const INACCURATE: &str = "inaccurate";

/// What a run may use.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Options {
    /// The most memory that a packing may be estimated to need, bytes; `None` is what the machine has free.
    pub memory_bytes: Option<f64>,
}

/// Everything that a run gives.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// Particles and figures in their own dimension.
    pub packing: Packing,
    /// The particles that roles and `fluid.fill` keep, by id; `output.include` is left to whoever writes.
    pub table: Table,
    /// In 2-D, the true bodies as closed loops.
    pub loops: Vec<Vec<[f64; 2]>>,
    /// What the bodies' files hold.
    pub read: Vec<ReadBody>,
    /// The figures, dimension forgotten.
    pub report: Report,
}

/// Packs a scene. Reads the bodies' files, writes nothing.
///
/// # Errors
/// [`Error`] where the scene makes no sense, a body's file cannot be used, or memory would not do.
pub fn run(
    scene: &Scene,
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<Outcome, Error> {
    run_opened(opened(scene)?, options, observer)
}

/// [`run`] of a scene whose bodies' files are read.
pub(crate) fn run_opened(
    opened: Opened,
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<Outcome, Error> {
    let allowed = options.memory_bytes.unwrap_or_else(available_bytes);
    in_dimension!(opened.dimension, D => run_in::<D>(opened, allowed, observer))
}

fn run_in<const D: usize>(
    opened: Opened,
    allowed_bytes: f64,
    observer: &mut dyn Observer,
) -> Result<Outcome, Error>
where
    Space<D>: Dimension<D>,
    Packing: From<Solution<D>>,
{
    let picked = opened.picked.clone();
    let (prepared, _) = prepare::<D>(opened, allowed_bytes)?;
    let Prepared {
        problem,
        resolved,
        loops,
        read,
        repairs,
        cut,
        layered,
        written: _,
        seconds: built,
    } = prepared;
    let scene = &resolved;
    let mut packed = pack(&problem, scene, observer)?;
    let measuring = Instant::now();
    let asked = Asked::by(scene);
    let mut sorted = sort(&packed, &asked)
        .map_err(|e| Error::System(format!("particles cannot be separated: {e}")))?;
    walls::leave_to_fluid(&layered, &packed, asked.has_fluid, &mut sorted);
    let judge = judged(&problem, scene);
    let masses = (scene.packing.masses == Masses::Corrected)
        .then(|| corrected::correct(&judge, &mut packed, &sorted, scene.packing.mass_spread));
    let fields = packed.fields(judge.kernel, judge.h_over_spacing);
    let Sorted { labels, keep } = sorted;
    let quality = packed.quality_by(&fields);
    let solution = Solution {
        problem,
        packed,
        labels,
        keep,
        fields,
        quality,
    };
    let content = Content::of(&solution.problem, &solution);
    let mut audit = Audit::of(&asked, &solution, &content.volumes);
    let mut table = table(scene, &solution).kept_by_id(&solution.keep);
    let next = (solution.packed.particles.id.iter())
        .max()
        .map_or(0, |last| last + 1);
    let walls =
        walls::build(layered, scene, next, &mut table).map_err(|(body, error)| Error::Body {
            path: scene.path.clone(),
            body: scene.body[body].name.clone(),
            error,
        })?;
    let walled: Vec<(usize, f64, WallReport)> = (walls.iter())
        .map(|wall| {
            let body = wall.of.body;
            let report = audit.wall(wall, &scene.body[body].name, &table);
            (body, wall.volume(), report)
        })
        .collect();
    if !audit.passed && solution.packed.stop_reason == StopReason::Converged {
        table.stop_reason = UNSOUND.to_owned();
    }
    let auto = picked.map(|picked| AutoReport::of(picked, scene, &solution));
    if table.stop_reason == StopReason::Converged.name()
        && auto
            .as_ref()
            .is_some_and(|auto| auto.reached == Some(false))
    {
        table.stop_reason = INACCURATE.to_owned();
    }
    let mut report = report(scene, &solution, &content, audit, &table, built);
    report.seconds.measuring = measuring.elapsed().as_secs_f64();
    report.seconds.total += report.seconds.measuring;
    report.auto = auto;
    report.mass_correction = masses.map(MassReport::from);
    report.warnings.splice(0..0, cut);
    for (body, repairs) in report.bodies.iter_mut().zip(repairs) {
        body.repairs = repairs;
    }
    for (number, volume, wall) in walled {
        report.bodies[number].be_wall(volume, scene.body[number].density, wall);
    }
    Ok(Outcome {
        packing: solution.into(),
        table,
        loops,
        read,
        report,
    })
}

fn table<const D: usize>(scene: &Scene, solution: &Solution<D>) -> Table {
    let Solution {
        packed,
        labels,
        fields,
        ..
    } = solution;
    let particles = &packed.particles;
    let all = 0..particles.len();
    let solids = scene.body.iter().map(|body| body.density);
    let shared = Shared {
        spacing: packed.spacing,
        smoothing_length: scene.judge().1 * packed.spacing,
        density: solids.chain([scene.fluid.density]).collect(),
        inset: (scene.body.iter())
            .map(|body| match body.role {
                Role::Container => 0.0,
                _ => body.surface.0 * packed.spacing,
            })
            .collect(),
        domain: Some([
            point::of_slice(&packed.domain.bounds.min),
            point::of_slice(&packed.domain.bounds.max),
        ]),
        periodic: std::array::from_fn(|axis| {
            packed.domain.periodic.get(axis).copied().unwrap_or(false)
        }),
    };
    let rest_density = |i: usize| shared.density_of(labels.body[i]);
    let at_rest: Vec<AtRest> = (scene.fluid.hydrostatic.iter())
        .flat_map(|hydrostatic| {
            all.clone().map(|i| match labels.side[i] {
                Side::Fluid => {
                    hydrostatic.at(point::of_slice(&particles.position[i]), rest_density(i))
                }
                Side::Solid => AtRest {
                    pressure: 0.0,
                    density: rest_density(i),
                },
            })
        })
        .collect();
    let density = |i: usize| {
        at_rest
            .get(i)
            .map_or_else(|| rest_density(i), |rest| rest.density)
    };
    let is_graded = particles.sizes.relative().is_some();
    let sizes = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let some = if is_graded { all.clone() } else { 0..0 };
        some.map(of).collect()
    };
    let judged = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (all.clone())
            .map(|i| match particles.kind[i] {
                Kind::Frozen => f64::NAN,
                _ => of(i),
            })
            .collect()
    };
    Table {
        dimension: D,
        stop_reason: packed.stop_reason.name().to_owned(),
        bodies: packed.bodies.clone(),
        id: particles.id.clone(),
        position: all
            .clone()
            .map(|i| point::of_slice(&particles.position[i]))
            .collect(),
        kind: particles.kind.clone(),
        side: labels.side.clone(),
        body: labels.body.clone(),
        volume: particles.volume.clone(),
        mass: all
            .clone()
            .map(|i| density(i) * particles.volume[i])
            .collect(),
        gamma: judged(&|i| fields.gamma[i]),
        residual: judged(&|i| fields.residual(i)),
        normals: (packed.on_surface.iter())
            .map(|seat| {
                (
                    particles.id[seat.particle],
                    point::of_slice(&seat.hit.normal),
                )
            })
            .collect(),
        pressure: at_rest.iter().map(|rest| rest.pressure).collect(),
        density: at_rest.iter().map(|rest| rest.density).collect(),
        distance: Vec::new(),
        spacing: sizes(&|i| particles.sizes.spacing(i)),
        smoothing_length: sizes(&|i| fields.sizes.smoothing_length(i)),
        shared,
    }
}

/// Parts that are named one by one where they get no particles.
const MOST_NAMED: usize = 5;

/// Solid bodies, and parts of them, that get no particles because they hold less than half of one.
fn too_small<const D: usize>(scene: &Scene, solution: &Solution<D>) -> Vec<String> {
    let Solution {
        problem, labels, ..
    } = solution;
    let mut has_some = vec![false; problem.bodies.len()];
    for body in labels.body.iter().flatten() {
        has_some[usize::from(*body)] = true;
    }
    let site = problem.filling().volume_per_site();
    let is_solid = |body: usize| scene.body[body].role == Role::Solid;
    let words = |body: usize, what: &str, at: [f64; D], volume: f64| {
        format!(
            "{what}body \"{}\" at {} gets no particles: its volume {volume:.3e} is {:.2} of a particle's; its room is left to what is around it; a smaller spacing would show it",
            scene.body[body].name,
            words::place(&at, scene.spacing),
            volume / site
        )
    };
    let omitted: Vec<_> = (solution.packed.omitted.iter())
        .filter(|omitted| is_solid(omitted.body))
        .collect();
    let mut warnings: Vec<String> = (omitted.iter().take(MOST_NAMED))
        .map(|omitted| {
            let what = if has_some[omitted.body] {
                "a part of "
            } else {
                ""
            };
            words(omitted.body, what, omitted.at, omitted.volume)
        })
        .collect();
    if let Some(more) = omitted.get(MOST_NAMED..).filter(|more| !more.is_empty()) {
        let volume: f64 = more.iter().map(|omitted| omitted.volume).sum();
        warnings.push(format!(
            "{} more parts get no particles; the volume of all of them is {:.2} of a particle's",
            more.len(),
            volume / site
        ));
    }
    for (number, excess) in solution.packed.excess.iter().enumerate() {
        if *excess > 0.0 {
            let volume = problem.bodies[number].surface.volume();
            warnings.push(format!(
                "body \"{}\" weighs {:.3} times its mass: its thin parts are watertight, and {excess:.3e} of volume is taken from what is around it",
                scene.body[number].name,
                (volume + excess) / volume
            ));
        }
    }
    for (number, body) in problem.bodies.iter().enumerate() {
        let is_named = omitted.iter().any(|omitted| omitted.body == number);
        if is_solid(number) && !has_some[number] && !is_named {
            let center = body.surface.bounds().center();
            warnings.push(words(number, "", center, body.surface.volume()));
        }
    }
    warnings
}

/// How spacings differ, where they do.
fn resolution<const D: usize>(solution: &Solution<D>) -> Option<ResolutionReport> {
    let Solution {
        problem, packed, ..
    } = solution;
    let particles = &packed.particles;
    particles.sizes.relative()?;
    let inner: Vec<usize> = (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen)
        .collect();
    let spacing = |i: &usize| particles.sizes.spacing(*i);
    let finest = inner.iter().map(spacing).fold(f64::INFINITY, f64::min);
    let coarsest = inner.iter().map(spacing).fold(0.0, f64::max);
    let growth: Vec<f64> = (inner.iter())
        .filter(|&&i| particles.kind[i] == Kind::Free)
        .map(|&i| point::norm(problem.resolution.at(particles.position[i]).gradient))
        .collect();
    let uniform = problem.domain.bounds.volume() / finest.powi(D as i32);
    Some(ResolutionReport {
        finest,
        coarsest,
        ratio: coarsest / finest,
        growth_mean: 1.0 + growth.iter().sum::<f64>() / growth.len().max(1) as f64,
        growth_max: 1.0 + growth.iter().copied().fold(0.0, f64::max),
        times_fewer: uniform / inner.len() as f64,
        gamma: "gather",
        symmetric: packed.symmetric_density(),
    })
}

fn report<const D: usize>(
    scene: &Scene,
    solution: &Solution<D>,
    content: &Content<D>,
    audit: Audit,
    table: &Table,
    built: f64,
) -> Report {
    let Solution {
        problem,
        packed,
        quality,
        ..
    } = solution;
    let count = |kind: Kind| table.kind.iter().filter(|&&k| k == kind).count();
    let inner = |side: Side| {
        (0..table.len())
            .filter(|&i| table.kind[i] != Kind::Frozen && table.side[i] == side)
            .count()
    };
    let held = content.volumes.iter().zip(&content.spread);
    let bodies = (problem.bodies.iter().zip(&scene.body).zip(held))
        .map(|((body, spec), (&volume, spread))| BodyReport {
            name: body.name.clone(),
            volume_true: body.surface.volume(),
            volume,
            mass: spec.density * volume,
            wall: None,
            rigid: (spread.as_ref())
                .filter(|_| spec.role == Role::Solid)
                .map(|spread| RigidReport::new(spread, spec.density)),
            repairs: Vec::new(),
        })
        .collect();
    let seconds = &packed.seconds;
    Report {
        schema: SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        scene: scene.clone(),
        dimension: D,
        spacing: problem.spacing(),
        resolution: resolution(solution),
        method: scene.packing.method.name(),
        kernel: problem.kernel.name(),
        h_over_spacing: problem.h_over_spacing,
        seed: scene.packing.seed,
        threads: rayon::current_num_threads(),
        converged: packed.stop_reason == StopReason::Converged,
        stop_reason: packed.stop_reason.name(),
        iterations: packed.iterations,
        force_evaluations: packed.force_evaluations,
        particles: Counts {
            total: table.len(),
            free: count(Kind::Free),
            boundary: count(Kind::Boundary),
            fixed: count(Kind::Fixed),
            frozen: count(Kind::Frozen),
            solid: inner(Side::Solid),
            fluid: inner(Side::Fluid),
        },
        density: quality.density,
        residual: quality.residual,
        closest_pair_over_spacing: finite(quality.closest_pair_over_spacing),
        surface: quality.surface.iter().map(finite_surface).collect(),
        bodies,
        warnings: too_small(scene, solution),
        audit,
        seconds: SecondsReport {
            total: built + seconds.total,
            geometry: built + seconds.geometry,
            seeding: seconds.seeding,
            neighbors: seconds.neighbors,
            forces: seconds.forces,
            projection: seconds.projection,
            minimiser: seconds.minimiser,
            measuring: 0.0,
            output: 0.0,
        },
        auto: None,
        mass_correction: None,
        peak_memory_bytes: peak_memory_bytes(),
        history: packed.history.clone(),
    }
}
