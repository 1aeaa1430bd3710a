//! From a scene to a problem, before any particle is placed.

use std::time::Instant;

use sphpack_geometry::{GeometryError, MeshError, OutlineError};
use sphpack_neighbors::{Bounds, Domain, point, words};
use sphpack_packing::{Body, Estimate, FrozenLayout, Kind, Moves, PackingError, Problem};

use crate::Error;
use crate::auto::Picked;
use crate::body_file::ReadBody;
use crate::dimension::{Built, Dimension, Space, in_dimension};
use crate::error::cured;
use crate::opened::{Opened, opened};
use crate::scene::{Fault, Frozen, Role, Scene, Shape, Surroundings};
use crate::spacings;
use crate::walls::{self, Layered};
use crate::{beyond, methods, overlap, precedence, roles, units};

pub(crate) use crate::memory::available_bytes;

/// What a scene will need.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// 2 or 3.
    pub dimension: usize,
    /// What the bodies' files hold.
    pub read: Vec<ReadBody>,
    /// Particles, memory and time.
    pub estimate: Estimate,
    /// Particles that files are to have.
    pub written: f64,
    /// Evaluations until particles are at rest, in the middle of what scenes take.
    pub evaluations: f64,
    /// What was picked for the method "auto".
    pub picked: Option<Picked>,
    /// Where spacings differ, how many times as many particles the finest alone would take.
    pub times_fewer: Option<f64>,
    /// Seconds that the bodies took to be built.
    pub building_seconds: f64,
    /// The memory that may be used, bytes.
    pub allowed_bytes: f64,
    /// What was mended of each body, by its name; a sentence each.
    pub repairs: Vec<(String, Vec<String>)>,
    /// Which bodies the sides of the box cut, a sentence each.
    pub cut: Vec<String>,
}

/// A scene's problem.
pub(crate) struct Prepared<const D: usize> {
    pub(crate) problem: Problem<D>,
    /// The scene with its defaults filled in, its bodies in the problem's order: each after those that lie in it.
    pub(crate) resolved: Scene,
    /// In 2-D, the bodies' closed loops.
    pub(crate) loops: Vec<Vec<[f64; 2]>>,
    /// What was mended of each body, a sentence each.
    pub(crate) repairs: Vec<Vec<String>>,
    /// Which bodies the sides of the box cut, a sentence each.
    pub(crate) cut: Vec<String>,
    /// What the bodies' files hold.
    pub(crate) read: Vec<ReadBody>,
    /// The bodies that are walls in layers.
    pub(crate) layered: Vec<Layered<D>>,
    /// Particles that files are to have.
    pub(crate) written: f64,
    /// Seconds spent on building the bodies.
    pub(crate) seconds: f64,
}

/// Particles are numbered with 32 bits.
const MAX_PARTICLES: f64 = 4e9;

/// Bytes of a particle whose row is written, and compared piece by piece: its place in the table, and the numbers of its words; and
/// what the allocator keeps of earlier arrays, of as many particles as in the last line. Peaks of 160,000 that never moved took
/// 70 and 110 more than what is kept until then.
const ROW_BYTES: f64 = 28.0;
const HELD_BYTES: f64 = 60.0;
const MOST_HELD: f64 = 1.4e6;

/// And in a table of its own beside that of all, where there is a picture; and where a file is read again as a whole: its text or
/// bytes and its columns, three words among them. Peaks of files of all formats, with frozen particles and without, took 315.
const TABLE_BYTES: f64 = 66.0;
const READ_BYTES: f64 = 315.0;

/// Bytes of so many rows while they are written.
fn row_bytes(written: f64) -> f64 {
    ROW_BYTES * written + HELD_BYTES * written.min(MOST_HELD)
}

impl Plan {
    /// The plan where a picture is drawn or files hold parts, so that rows are copied, or files are held when they are read again.
    /// Without the memory for that they are not read.
    #[must_use]
    pub(crate) fn with_files(mut self, has_copy: bool, are_held: bool) -> Self {
        let table = if has_copy { TABLE_BYTES } else { 0.0 };
        let last = self.estimate.kept_bytes + row_bytes(self.written) + table * self.written;
        let held = last + READ_BYTES * self.written;
        let most = if are_held && held <= self.allowed_bytes {
            held
        } else {
            last
        };
        self.estimate.memory_bytes = self.estimate.memory_bytes.max(most);
        self
    }
}

/// What a scene will need; builds its bodies, places no particles.
///
/// # Errors
/// Those of [`crate::run`].
pub fn plan(scene: &Scene, memory_bytes: Option<f64>) -> Result<Plan, Error> {
    let allowed_bytes = memory_bytes.unwrap_or_else(available_bytes);
    planned_of(opened(scene)?, allowed_bytes)
}

/// [`plan`] of a scene whose bodies' files are read.
pub(crate) fn planned_of(opened: Opened, allowed_bytes: f64) -> Result<Plan, Error> {
    in_dimension!(opened.dimension, D => planned::<D>(opened, allowed_bytes))
}

fn planned<const D: usize>(opened: Opened, allowed_bytes: f64) -> Result<Plan, Error>
where
    Space<D>: Dimension<D>,
{
    let picked = opened.picked.clone();
    let evaluations = opened.scene.typical_evaluations(D);
    let (prepared, estimate) = prepare::<D>(opened, allowed_bytes)?;
    methods::check(&prepared.problem, &prepared.resolved)?;
    let names = prepared.resolved.body.into_iter().map(|body| body.name);
    let problem = &prepared.problem;
    let times_fewer = problem.resolution.uniform().is_none().then(|| {
        let finest = problem.domain.bounds.volume() / problem.spacing().powi(D as i32);
        finest / estimate.particles
    });
    Ok(Plan {
        dimension: D,
        read: prepared.read,
        times_fewer,
        estimate,
        written: prepared.written,
        evaluations,
        picked,
        building_seconds: prepared.seconds,
        allowed_bytes,
        repairs: names.zip(prepared.repairs).collect(),
        cut: prepared.cut,
    })
}

fn four_digits(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// Builds the bodies and the problem, and sees whether it makes sense and fits into memory.
pub(crate) fn prepare<const D: usize>(
    opened: Opened,
    allowed_bytes: f64,
) -> Result<(Prepared<D>, Estimate), Error>
where
    Space<D>: Dimension<D>,
{
    let begin = Instant::now();
    let Opened { scene, files, .. } = opened;
    let scene = &scene;
    let mut all = Vec::new();
    for (body, file) in scene.body.iter().zip(files) {
        let built = Space::<D>::place(body)
            .and_then(|place| Space::<D>::build(&body.shape, file.as_ref(), &place))
            .map_err(|source| match source {
                // The message names the file already.
                GeometryError::InFile { path, error } => Error::Input {
                    message: match *error {
                        GeometryError::Outline(OutlineError::Defective { .. }) => {
                            format!("{error}. `sphpack check {}` says more", path.display())
                        }
                        GeometryError::Mesh(MeshError::Defective { .. }) => {
                            // Four cells to a spacing, in the units of the file.
                            let cell = four_digits(0.25 * scene.spacing / body.scale);
                            let path = path.display();
                            format!("{error}. `sphpack check {path}` says more, and mends what can be mended; `sphpack check {path} --repair OUT.stl --wrap {cell}` makes a new, closed mesh of whatever there is")
                        }
                        _ => cured(&error),
                    },
                    path,
                    at: None,
                },
                source => Error::Body {
                    path: scene.path.clone(),
                    body: body.name.clone(),
                    error: source,
                },
            })?;
        all.push(built);
    }
    let mut read = Vec::new();
    for (body, built) in scene.body.iter().zip(&all) {
        read.extend(built.read.map(|(format, count)| ReadBody {
            name: body.name.clone(),
            format,
            count,
            size: built.surface.bounds().size().to_vec(),
        }));
    }
    refuse_giants(scene, &all)?;
    precedence::settle(scene, &mut all)?;
    let order = roles::order(scene, &all)?;
    let mut all: Vec<Option<Built<D>>> = all.into_iter().map(Some).collect();
    let mut all: Vec<Built<D>> = order.iter().filter_map(|&i| all[i].take()).collect();
    let scene = &Scene {
        body: order.iter().map(|&i| scene.body[i].clone()).collect(),
        ..scene.clone()
    };
    let domain = domain(scene, &all);
    // A body is carried on as far as the box goes: not through one that no memory can fill.
    let hopeless = hopeless_bytes(scene, &domain).filter(|&bytes| bytes > allowed_bytes);
    let cut = match hopeless {
        Some(_) => Vec::new(),
        None => beyond::go_on(scene, &mut all, &domain)?,
    };
    let mut bodies = Vec::new();
    let mut loops = Vec::new();
    let mut repairs = Vec::new();
    for (body, built) in scene.body.iter().zip(all) {
        loops.extend(built.loops);
        repairs.push(built.repairs);
        bodies.push(Body {
            name: body.name.clone(),
            surface: built.surface,
            inset_over_spacing: body.surface.0,
            thin: body.thin,
        });
    }
    let surfaces: Vec<_> = bodies.iter().map(|body| body.surface.clone()).collect();
    let layered = walls::asked(scene, &domain, &surfaces)?;
    if let Some(Surroundings { min, max }) = &scene.output.surroundings {
        let Bounds {
            min: low,
            max: high,
        } = &domain.bounds;
        (scene.check_around([min, max], [low, high])).map_err(|Fault { message, .. }| {
            Error::Scene {
                path: scene.path.clone(),
                at: None,
                message,
            }
        })?;
    }
    let empty = Problem {
        domain,
        resolution: scene.spacing.into(),
        bodies: Vec::new(),
        kernel: scene.packing.kernel(),
        h_over_spacing: scene.packing.h_over_spacing(),
        judging_reach: {
            let (kernel, h_over_spacing) = scene.judge();
            kernel.support_over_h() * h_over_spacing * scene.spacing
        },
        seed: scene.packing.seed,
        lattice: scene.packing.lattice_in(D),
        frozen: match scene.packing.frozen {
            Frozen::Lattice => FrozenLayout::Lattice,
            Frozen::Square => FrozenLayout::Square,
        },
    };
    let mut problem = bodies.into_iter().fold(empty, Problem::placed_body);
    if let Some(refinement) = &scene.refinement {
        problem.resolution = spacings::field::<D>(scene, refinement, &problem)?;
        problem.judging_reach *= problem.spacing() / scene.spacing;
    }
    let problem = problem;
    refuse_overlaps(scene, &problem.bodies)?;
    let fail = |source: PackingError| Error::Packing {
        path: scene.path.clone(),
        advice: units::advice(scene, &problem, &source),
        error: Box::new(source),
    };
    let moves = match scene.packing.method.info().moves {
        Moves::Nothing => 0.0,
        Moves::Band => {
            (scene.packing.band()).first_width(&problem, scene.packing.settling_in(D).finish)
        }
        Moves::All => f64::INFINITY,
    };
    let work = &scene.packing.method.info().work;
    let mut estimate = problem.estimate(moves, work).map_err(fail)?;
    judged(&problem, scene).check().map_err(fail)?;
    let mut written = estimate.particles;
    if let Some(Surroundings { min, max }) = &scene.output.surroundings {
        let sides = min.iter().zip(max).map(|(low, high)| high - low);
        let more =
            sides.product::<f64>() / problem.filling().volume_per_site() - estimate.particles;
        estimate.frozen = more.max(0.0);
        written += more.max(0.0);
    } else if scene.includes(Kind::Frozen) {
        written += estimate.frozen;
    }
    written += layered.iter().map(Layered::count).sum::<f64>();
    let last = estimate.kept_bytes + row_bytes(written);
    estimate.memory_bytes = (estimate.memory_bytes.max(last)).max(hopeless.unwrap_or(0.0));
    let particles = estimate.particles + estimate.frozen;
    if !particles.is_finite() || !estimate.memory_bytes.is_finite() {
        return Err(Error::Scene {
            path: scene.path.clone(),
            at: None,
            message: format!(
                "the domain is so many times larger than the spacing {} that its particles cannot be counted; use a larger spacing or a smaller domain",
                scene.spacing
            ),
        });
    }
    if estimate.memory_bytes > allowed_bytes || particles >= MAX_PARTICLES {
        return Err(fail(PackingError::TooLarge {
            particles,
            needed_bytes: estimate.memory_bytes,
            allowed_bytes,
        }));
    }
    let mut resolved = scene.clone();
    resolved.domain.min = Some(domain.bounds.min.to_vec());
    resolved.domain.max = Some(domain.bounds.max.to_vec());
    resolved.domain.periodic = Some(domain.periodic.to_vec());
    resolved.packing.lattice = Some(problem.chosen_lattice());
    let settling = scene.packing.settling_in(D);
    resolved.packing.kernel = Some(problem.kernel);
    resolved.packing.h_over_spacing = Some(problem.h_over_spacing);
    resolved.packing.residual_tolerance = Some(settling.tolerance());
    resolved.packing.levelling = Some(settling.levelling);
    let (kernel, h_over_spacing) = scene.judge();
    resolved.quality.kernel = Some(kernel);
    resolved.quality.h_over_spacing = Some(h_over_spacing);
    Ok((
        Prepared {
            problem,
            resolved,
            loops,
            repairs,
            cut,
            read,
            layered,
            written,
            seconds: begin.elapsed().as_secs_f64(),
        },
        estimate,
    ))
}

/// A body so many times larger than the box is a slip: what looks along its surface would never come to an end.
const GIANT: f64 = 1e5;

/// A circle or an ellipse that is larger than this, in ∆s, and than the box is not right to ∆s/100 any more: what is cut
/// of them is polygons within 10⁻⁷ of their size.
const COARSE_CURVE: f64 = 1e5;

/// Bodies beside which the box is nothing.
fn refuse_giants<const D: usize>(scene: &Scene, all: &[Built<D>]) -> Result<(), Error> {
    let (Some(min), Some(max)) = (&scene.domain.min, &scene.domain.max) else {
        return Ok(());
    };
    let domain = Bounds::new(point::of_slice(min), point::of_slice::<D>(max)).diagonal();
    for (body, built) in scene.body.iter().zip(all) {
        let size = built.surface.bounds().diagonal();
        let (times, spacings) = (size / domain, size / scene.spacing);
        let is_curve = matches!(body.shape, Shape::Circle { .. } | Shape::Ellipse { .. });
        let than = match () {
            () if times > GIANT => format!("is {times:.1e} times as large as the domain"),
            () if is_curve && times > 1.0 && spacings > COARSE_CURVE => {
                format!(
                    "is {spacings:.1e} spacings large, too much for its curve to be right to a hundredth of a spacing"
                )
            }
            () => continue,
        };
        return Err(Error::Scene {
            path: scene.path.clone(),
            at: None,
            message: format!(
                "body \"{}\" {than}; correct its size, its scale or the domain",
                body.name
            ),
        });
    }
    Ok(())
}

/// What the positions alone take of particles of one size all over the box; `None` where they may be only in a part of
/// it, or larger.
fn hopeless_bytes<const D: usize>(scene: &Scene, domain: &Domain<D>) -> Option<f64> {
    let is_all_over =
        scene.refinement.is_none() && scene.body.iter().all(|body| body.role == Role::Solid);
    let particles = domain.bounds.volume() / scene.spacing.powi(D as i32);
    is_all_over.then_some(particles * (D * size_of::<f64>()) as f64)
}

/// Solid bodies may touch, but not claim the same room. What is in a void or a container is another matter.
fn refuse_overlaps<const D: usize>(scene: &Scene, bodies: &[Body<D>]) -> Result<(), Error> {
    let is_solid = |i: usize| scene.body[i].role == Role::Solid;
    let Some(found) = overlap::first(bodies, scene.spacing, is_solid) else {
        return Ok(());
    };
    let [a, b] = found.bodies.map(|i| &bodies[i].name);
    Err(Error::Scene {
        path: scene.path.clone(),
        at: None,
        message: format!(
            "bodies \"{a}\" and \"{b}\" overlap: {} is in both, {:.2} spacings deep; give the one that is to keep the common part a higher precedence (precedence = 1), or move one (bodies may touch)",
            words::place(&found.place, scene.spacing),
            found.depth / scene.spacing
        ),
    })
}

/// The same problem with the kernel that judges.
pub(crate) fn judged<const D: usize>(problem: &Problem<D>, scene: &Scene) -> Problem<D> {
    let (kernel, h_over_spacing) = scene.judge();
    Problem {
        kernel,
        h_over_spacing,
        ..problem.clone()
    }
}

fn domain<const D: usize>(scene: &Scene, bodies: &[Built<D>]) -> Domain<D> {
    let spec = &scene.domain;
    let bounds = match (&spec.min, &spec.max) {
        (Some(min), Some(max)) => Bounds::new(point::of_slice(min), point::of_slice(max)),
        _ => bodies
            .iter()
            .fold(Bounds::EMPTY, |all, body| all.union(body.surface.bounds()))
            .grown(spec.margin.unwrap_or(0.0)),
    };
    let periodic = spec.periodic.as_deref().unwrap_or(&[]);
    let domain = Domain {
        bounds,
        periodic: std::array::from_fn(|k| periodic.get(k).copied().unwrap_or(false)),
    };
    with_room(domain, scene, bodies)
}

/// The least room around a container, in ∆s. Its particles settle against others beyond its wall, though those are not kept:
/// a tank in a box that left it 0, 0.4, 1, 2 and 4 ∆s had its density within 6.6, 2.4, 0.35, 0.14 and 0.10 %.
const CONTAINER_ROOM: f64 = 4.0;

/// A domain that leaves every container in it some room within its open sides. What is there is nobody's: the fluid is in containers.
fn with_room<const D: usize>(
    mut domain: Domain<D>,
    scene: &Scene,
    bodies: &[Built<D>],
) -> Domain<D> {
    let held = domain
        .bounds
        .grown(beyond::TOLD_OVER_SPACING * scene.spacing);
    for (body, built) in scene.body.iter().zip(bodies) {
        let wall = built.surface.bounds();
        if body.role != Role::Container || !held.contains_box(&wall) {
            continue;
        }
        let room = domain
            .bounds
            .union(wall.grown(CONTAINER_ROOM * scene.spacing));
        for k in (0..D).filter(|&k| !domain.periodic[k]) {
            (domain.bounds.min[k], domain.bounds.max[k]) = (room.min[k], room.max[k]);
        }
    }
    domain
}
