//! Packings that are measured once: their figures and pictures, kept until the code that packs and measures changes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::{Deserialize, Serialize};
use sphpack::picture::{self, PictureFormat, draw};
use sphpack::{Options, Outcome, Packing, Solution, run as pack};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::point;
use sphpack_packing::{Kind, Silent};

use super::divergence::found;
use super::interpolation::{Study, study};
use super::measure::Measure;
use super::setup::Setup;
use super::subject::Subject;
use super::trials::Trial;
use crate::figures::variation_near;
use crate::kept::Kept;
use crate::selection::Selection;

/// What a packing came to.
#[derive(Debug, Clone)]
pub(crate) struct Measured {
    pub(crate) figures: BTreeMap<Measure, f64>,
    /// Whether it came to rest; a trial goes on for as long as it is told, and is over then.
    pub(crate) is_at_rest: bool,
    /// A packing's picture, PNG.
    pub(crate) picture: Option<PathBuf>,
}

/// What a measured packing depends on, beside what packs.
const OWN: [&str; 7] = [
    "xtask/src/figures.rs",
    "xtask/src/shipped.rs",
    "xtask/src/reproduction/divergence.rs",
    "xtask/src/reproduction/interpolation.rs",
    "xtask/src/reproduction/measure.rs",
    "xtask/src/reproduction/measured.rs",
    "xtask/src/reproduction/setup.rs",
];

/// Measured packings in a folder.
pub(crate) struct Store {
    kept: Kept,
    /// Where trials are kept.
    trials: Kept,
}

impl Store {
    /// The store in `folder`, which is made where it is not there.
    pub(crate) fn open(folder: &Path) -> Result<Self, String> {
        let trials = [&OWN[..], &TRIALS].concat();
        Ok(Self {
            kept: Kept::open(folder, &OWN)?,
            trials: Kept::open(folder, &trials)?,
        })
    }

    /// The figures of a subject, from the store or measured; `None` where its body's file is not there. A packing that
    /// was measured without the interpolation is packed again where that is asked for.
    pub(crate) fn measured(
        &self,
        subject: &Subject,
        interpolates: bool,
        selection: &Selection,
    ) -> Result<Option<Measured>, String> {
        match subject {
            Subject::Packing(setup) => self.packed(setup, interpolates, selection),
            Subject::Trial(trial) => self.tried(trial, selection),
        }
    }

    fn tried(&self, trial: &Trial, selection: &Selection) -> Result<Option<Measured>, String> {
        let of = format!("{trial:?}");
        if let Some(kept) = known(&self.trials, &of, None) {
            return Ok(Some(kept));
        }
        eprintln!("   trying {}", trial.words());
        let start = Instant::now();
        let Some(mut figures) = trial.figures(selection)? else {
            return Ok(None);
        };
        figures.insert(Measure::Seconds, start.elapsed().as_secs_f64());
        let measured = Measured {
            figures,
            is_at_rest: true,
            picture: None,
        };
        self.trials.keep(&of, &Stored::of(&measured))?;
        Ok(Some(measured))
    }

    fn packed(
        &self,
        setup: &Setup,
        interpolates: bool,
        selection: &Selection,
    ) -> Result<Option<Measured>, String> {
        let of = format!("{setup:?}");
        let picture = self.kept.path(&of, "png");
        if let Some(kept) = known(&self.kept, &of, Some(&picture))
            && (!interpolates || kept.figures.keys().any(|measure| measure.interpolates()))
        {
            return Ok(Some(kept));
        }
        let Some(scene) = setup.scene(selection)? else {
            return Ok(None);
        };
        eprintln!("   packing {}", setup.words());
        let start = Instant::now();
        let outcome = pack(&scene, &Options::default(), &mut Silent);
        let outcome = outcome.map_err(|error| error.to_string())?;
        let seconds = start.elapsed().as_secs_f64();
        let mut figures = of_report(&outcome, seconds);
        if interpolates {
            let h = setup.judged_at.unwrap_or(scene.packing.h_over_spacing());
            let kernel = setup.kernel.unwrap_or(KernelKind::Quintic);
            figures.extend(interpolated(&outcome, kernel, h));
        }
        let measured = Measured {
            figures,
            is_at_rest: outcome.report.converged,
            picture: Some(picture.clone()),
        };
        paint(&outcome, &picture)?;
        self.kept.keep(&of, &Stored::of(&measured))?;
        Ok(Some(measured))
    }
}

/// A result as it is kept.
#[derive(Debug, Serialize, Deserialize)]
struct Stored {
    at_rest: bool,
    /// By the measures' names; no number where there is none.
    figures: BTreeMap<String, Option<f64>>,
}

impl Stored {
    fn of(measured: &Measured) -> Self {
        Self {
            at_rest: measured.is_at_rest,
            figures: (measured.figures.iter())
                .map(|(measure, &value)| (measure.name().to_owned(), Some(value)))
                .collect(),
        }
    }
}

/// What is known of a subject, its picture among it where it has one.
fn known(kept: &Kept, of: &str, picture: Option<&Path>) -> Option<Measured> {
    picture.is_none_or(Path::is_file).then_some(())?;
    let Stored { at_rest, figures } = kept.known(of)?;
    Some(Measured {
        figures: (Measure::ALL.into_iter())
            .filter_map(|measure| Some((measure, (*figures.get(measure.name())?)?)))
            .collect(),
        is_at_rest: at_rest,
        picture: picture.map(Path::to_owned),
    })
}

fn of_report(outcome: &Outcome, seconds: f64) -> BTreeMap<Measure, f64> {
    let report = &outcome.report;
    let (count, target) = (report.surface.iter()).fold((0, 0), |(count, target), surface| {
        (count + surface.count, target + surface.target_count)
    });
    let off = (report.surface.iter())
        .map(|surface| surface.max_distance_over_spacing)
        .fold(0.0, f64::max);
    let [near, of_fluid] = match &outcome.packing {
        Packing::Plane(solution) => near_and_fluid(solution),
        Packing::Space(solution) => near_and_fluid(solution),
    };
    let mut figures = BTreeMap::from([
        (Measure::Variation, report.density.total_variation),
        (Measure::VariationNear, near),
        (Measure::Linf, report.density.linf),
        (Measure::Residual, report.residual.max),
        (Measure::ResidualRms, report.residual.rms),
        (Measure::FluidResidual, of_fluid),
        (Measure::OffSurface, off),
        (Measure::ClosestPair, report.closest_pair_over_spacing),
        (
            Measure::OnSurface,
            f64::from(count as u32) / f64::from(target.max(1) as u32),
        ),
        (Measure::Iterations, report.iterations as f64),
        (Measure::Seconds, seconds),
    ]);
    if let Packing::Plane(solution) = &outcome.packing
        && let Some(found) = found(solution)
    {
        figures.insert(Measure::SurfaceMissed, found.missed);
        figures.insert(Measure::SurfaceFalse, found.false_ones);
    }
    figures
}

/// The variation near the bodies, and the largest residual of the fluid.
fn near_and_fluid<const D: usize>(solution: &Solution<D>) -> [f64; 2] {
    let particles = &solution.packed.particles;
    let of_fluid = (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen && particles.body[i].is_none())
        .map(|i| solution.fields.residual(i))
        .fold(0.0, f64::max);
    [
        variation_near(&solution.packed, &solution.fields.gamma),
        of_fluid,
    ]
}

fn interpolated(outcome: &Outcome, kernel: KernelKind, h_over_spacing: f64) -> Vec<(Measure, f64)> {
    let Study {
        printed,
        off_sites,
        at_particles,
    } = match &outcome.packing {
        Packing::Plane(solution) => study(&solution.packed, kernel, h_over_spacing),
        Packing::Space(solution) => study(&solution.packed, kernel, h_over_spacing),
    };
    vec![
        (Measure::FunctionAsPrinted, printed.function),
        (Measure::DerivativeAsPrinted, printed.derivative),
        (Measure::FunctionOffSites, off_sites.function),
        (Measure::DerivativeOffSites, off_sites.derivative),
        (Measure::FunctionAtParticles, at_particles.function),
        (Measure::DerivativeAtParticles, at_particles.derivative),
    ]
}

/// Draws a packing into a file.
pub(crate) fn paint(outcome: &Outcome, path: &Path) -> Result<(), String> {
    let bounds = match &outcome.packing {
        Packing::Plane(solution) => {
            let bounds = solution.packed.domain.bounds;
            [point::of_slice(&bounds.min), point::of_slice(&bounds.max)]
        }
        Packing::Space(solution) => {
            let bounds = solution.packed.domain.bounds;
            [bounds.min, bounds.max]
        }
    };
    let subject = picture::Subject {
        name: &outcome.report.scene.name,
        table: &outcome.table,
        loops: &outcome.loops,
        domain: bounds,
        spacing: outcome.report.spacing,
        is_unfinished: !outcome.report.converged,
    };
    let mut bytes = Vec::new();
    draw(&subject, PictureFormat::Png, &mut bytes)
        .and_then(|()| fs::write(path, bytes))
        .map_err(|error| format!("{}: {error}", path.display()))
}

/// What trials depend on besides.
const TRIALS: [&str; 3] = [
    "xtask/src/reproduction/trials",
    "xtask/src/relaxed_airfoils.rs",
    "xtask/src/parsed.rs",
];
