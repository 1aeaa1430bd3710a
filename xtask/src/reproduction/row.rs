//! One number of a paper, and what stands beside it.

use sphpack::scene::{Finish, Method};
use sphpack_kernels::KernelKind;

use super::subject::Subject;

/// How a scene is packed and judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Setup {
    /// The scene's file in `scenes`, without extension.
    pub(crate) scene: &'static str,
    /// ∆s.
    pub(crate) spacing: f64,
    /// Factor on all lengths but ∆s: densities have no unit, so a body enlarged is the body at a smaller ∆s.
    pub(crate) enlarged: f64,
    pub(crate) method: Method,
    /// The kernel that packs and judges; the method's own, and the quintic one, where there is none.
    pub(crate) kernel: Option<KernelKind>,
    /// Of the method balanced.
    pub(crate) finish: Finish,
    /// h/∆s that packs; the method's own where there is none.
    pub(crate) h_over_spacing: Option<f64>,
    /// h/∆s of the quintic kernel that judges; as packed where there is none.
    pub(crate) judged_at: Option<f64>,
    /// ε of damped dynamics.
    pub(crate) tolerance: f64,
    /// Iterations at most.
    pub(crate) patience: usize,
}

impl Setup {
    /// The hybrid method on a scene, with its defaults.
    pub(crate) const fn of(scene: &'static str, spacing: f64, method: Method) -> Self {
        Self {
            scene,
            spacing,
            enlarged: 1.0,
            method,
            kernel: None,
            finish: Finish::Even,
            h_over_spacing: None,
            judged_at: None,
            tolerance: 1e-4,
            patience: 100_000,
        }
    }

    pub(crate) const fn at(self, h_over_spacing: f64) -> Self {
        Self {
            h_over_spacing: Some(h_over_spacing),
            ..self
        }
    }

    pub(crate) const fn by(self, kernel: KernelKind) -> Self {
        Self {
            kernel: Some(kernel),
            ..self
        }
    }

    pub(crate) const fn judged(self, h_over_spacing: f64) -> Self {
        Self {
            judged_at: Some(h_over_spacing),
            ..self
        }
    }

    pub(crate) const fn until(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    pub(crate) const fn times(self, enlarged: f64) -> Self {
        Self { enlarged, ..self }
    }

    pub(crate) const fn within(self, patience: usize) -> Self {
        Self { patience, ..self }
    }

    pub(crate) const fn consistent(self) -> Self {
        Self {
            finish: Finish::Consistent,
            ..self
        }
    }

    /// The method, and the finish where it has several.
    pub(crate) fn method_name(&self) -> String {
        match (self.method, self.finish) {
            (Method::Balanced, Finish::Even) => "balanced even".to_owned(),
            (Method::Balanced, Finish::Consistent) => "balanced consistent".to_owned(),
            (Method::Balanced, Finish::Calm) => "balanced calm".to_owned(),
            (Method::Balanced, Finish::Both) => "balanced both".to_owned(),
            (method, _) if self.patience == 0 => format!("{} before it moves", method.name()),
            (method, _) => method.name().to_owned(),
        }
    }

    /// Scene, ∆s and method in a line.
    pub(crate) fn words(&self) -> String {
        let size = if self.enlarged == 1.0 {
            String::new()
        } else {
            format!(" × {}", self.enlarged)
        };
        let h = (self.h_over_spacing).map_or_else(String::new, |h| format!(", h/∆s = {h}"));
        let kernel = (self.kernel).map_or_else(String::new, |kernel| format!(", {kernel}"));
        format!(
            "{}{size}, ∆s = {}{h}{kernel}, {}",
            self.scene,
            self.spacing,
            self.method_name()
        )
    }
}

/// A figure of a packing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Measure {
    /// max Γ − min Γ.
    Variation,
    /// The same over the particles outside the bodies or within ∆s of their surfaces.
    VariationNear,
    /// max |Γ − 1|.
    Linf,
    /// Largest h |∇Γ| of a free particle.
    Residual,
    /// Largest distance of a surface particle from the surface, in ∆s.
    OffSurface,
    /// Smallest distance of two particles, in ∆s.
    ClosestPair,
    /// Particles on the surface over N_s.
    OnSurface,
    /// Iterations until rest.
    Iterations,
    /// Seconds, from scene to figures.
    Seconds,
    /// The farthest that a particle ends from the nearest site of its lattice, in ∆s.
    FromSite,
    /// max |Γ − Γ of the perfect lattice| at the end.
    DensityLeft,
    /// The same over what it was at the start.
    DensityLeftOverStart,
    /// Root mean square of h |∇Γ| over the free particles.
    ResidualRms,
    /// Surface particles that ∇·r < d − 0.625 does not find, over all of them.
    SurfaceMissed,
    /// Other particles that it finds, over the surface particles.
    SurfaceFalse,
    /// Points that the library's inside test puts on the wrong side.
    WrongByTest,
    /// The same by the flood.
    WrongByFlood,
    /// The same by the sum of signed angles.
    WrongByAngles,
    /// The same by the number of triangles that a ray passes.
    WrongByRays,
    /// Points of which tree and cells count other neighbours.
    NeighboursDiffer,
    /// Seconds of all inside tests.
    SecondsByTest,
    /// Seconds of the flood.
    SecondsByFlood,
    /// Seconds of all signed angles.
    SecondsByAngles,
    /// Seconds of all rays.
    SecondsByRays,
    /// Seconds to build a kd-tree and find everybody's neighbours in it.
    SecondsByTree,
    /// The same with a cell list.
    SecondsByCells,
    /// The distance at which a repulsion begins, in ∆s.
    Begins,
    /// The largest repulsion, for p_b = 1 and ∆s = 1.
    LargestForce,
    /// The repulsion of two particles at one place over the largest.
    ForceTogether,
    /// How far it is off the printed formula, over the largest.
    OffPrinted,
    /// The largest attraction.
    Pulls,
    /// The force of Lennard-Jones's kind at ∆s/2 over the largest repulsion.
    LennardJonesOverOurs,
    /// Error of an interpolated function, as Negi & Ramachandran (2021) judge: eq. 33, beside a regular mesh's sum at its own
    /// sites.
    FunctionAsPrinted,
    /// The same of its derivative.
    DerivativeAsPrinted,
    /// Error of the interpolated function off the sites, against the function itself, over that of the moved lattice.
    FunctionOffSites,
    /// The same of its derivative.
    DerivativeOffSites,
    /// Error of the interpolated function at the particles, against the function itself.
    FunctionAtParticles,
    /// The same of its derivative.
    DerivativeAtParticles,
}

impl Measure {
    pub(crate) const ALL: [Self; 38] = [
        Self::Variation,
        Self::VariationNear,
        Self::Linf,
        Self::Residual,
        Self::OffSurface,
        Self::ClosestPair,
        Self::OnSurface,
        Self::Iterations,
        Self::Seconds,
        Self::FromSite,
        Self::DensityLeft,
        Self::DensityLeftOverStart,
        Self::ResidualRms,
        Self::SurfaceMissed,
        Self::SurfaceFalse,
        Self::WrongByTest,
        Self::WrongByFlood,
        Self::WrongByAngles,
        Self::WrongByRays,
        Self::NeighboursDiffer,
        Self::SecondsByTest,
        Self::SecondsByFlood,
        Self::SecondsByAngles,
        Self::SecondsByRays,
        Self::SecondsByTree,
        Self::SecondsByCells,
        Self::Begins,
        Self::LargestForce,
        Self::ForceTogether,
        Self::OffPrinted,
        Self::Pulls,
        Self::LennardJonesOverOurs,
        Self::FunctionAsPrinted,
        Self::DerivativeAsPrinted,
        Self::FunctionOffSites,
        Self::DerivativeOffSites,
        Self::FunctionAtParticles,
        Self::DerivativeAtParticles,
    ];

    /// As tables and files call it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Variation => "total variation of Γ",
            Self::VariationNear => "total variation of Γ, outside and to ∆s inside",
            Self::Linf => "L∞(Γ − 1)",
            Self::Residual => "largest h|∇Γ|",
            Self::OffSurface => "distance from the surface / ∆s",
            Self::ClosestPair => "closest pair / ∆s",
            Self::OnSurface => "particles on the surface / N_s",
            Self::Iterations => "iterations",
            Self::Seconds => "seconds",
            Self::FromSite => "farthest from a site at the end / ∆s",
            Self::DensityLeft => "L∞(Γ − the lattice's) at the end",
            Self::DensityLeftOverStart => "L∞(Γ − the lattice's), end / start",
            Self::ResidualRms => "rms of h|∇Γ|",
            Self::SurfaceMissed => "surface particles not found by ∇·r < d − 0.625, part",
            Self::SurfaceFalse => "others found by ∇·r < d − 0.625, per surface particle",
            Self::WrongByTest => "points on the wrong side: inside test",
            Self::WrongByFlood => "points on the wrong side: flood",
            Self::WrongByAngles => "points on the wrong side: signed angles",
            Self::WrongByRays => "points on the wrong side: rays",
            Self::NeighboursDiffer => "points with other neighbours by kd-tree than by cells",
            Self::SecondsByTest => "seconds: inside test",
            Self::SecondsByFlood => "seconds: flood",
            Self::SecondsByAngles => "seconds: signed angles",
            Self::SecondsByRays => "seconds: rays",
            Self::SecondsByTree => "seconds: kd-tree, all neighbours",
            Self::SecondsByCells => "seconds: cell list, all neighbours",
            Self::Begins => "where the repulsion begins / ∆s",
            Self::LargestForce => "largest repulsion (p_b = ∆s = 1)",
            Self::ForceTogether => "repulsion at r = 0 / largest",
            Self::OffPrinted => "off the printed formula / largest",
            Self::Pulls => "largest attraction",
            Self::LennardJonesOverOurs => "Lennard-Jones's kind at ∆s/2 / our largest",
            Self::FunctionAsPrinted => "L2 of the function, as printed",
            Self::DerivativeAsPrinted => "L2 of the derivative, as printed",
            Self::FunctionOffSites => "L2 of the function off the sites / lattice's",
            Self::DerivativeOffSites => "L2 of the derivative off the sites / lattice's",
            Self::FunctionAtParticles => "L2 of the function at the particles",
            Self::DerivativeAtParticles => "L2 of the derivative at the particles",
        }
    }

    /// Whether it needs the interpolation of a function, which takes some seconds.
    pub(crate) fn interpolates(self) -> bool {
        self >= Self::FunctionAsPrinted
    }
}

/// What a paper says.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Published {
    /// A number in its text or tables.
    Text(f64),
    /// A claim in words, and no number.
    Words(&'static str),
}

/// When a row holds.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Bar {
    /// No more than this.
    AtMost(f64),
    /// No less than this.
    AtLeast(f64),
    /// Printed beside, not judged: a paper's figure of a method that it advises against, or a figure of ours.
    Beside,
}

/// How a row's number comes of figures.
#[derive(Debug, Clone)]
pub(crate) enum Taken {
    /// It is the subject's.
    Alone,
    /// This one's over the subject's.
    Over(Subject),
    /// The power of ∆s that the figure grows with, from the subject and these packings.
    Slope(Vec<Setup>),
    /// The standard error of that power.
    SlopeError(Vec<Setup>),
    /// The greatest of the subject's and those of these packings, which differ in h/∆s.
    Greatest(Vec<Setup>),
}

impl Taken {
    /// What is measured besides the subject.
    pub(crate) fn others(&self) -> Vec<Subject> {
        match self {
            Self::Alone => Vec::new(),
            Self::Over(over) => vec![*over],
            Self::Slope(others) | Self::SlopeError(others) | Self::Greatest(others) => {
                others.iter().map(|&setup| setup.into()).collect()
            }
        }
    }

    /// What follows the subject's words.
    pub(crate) fn words(&self) -> String {
        let spacings = |others: &[Setup]| {
            let all: Vec<String> = (others.iter())
                .map(|setup| (setup.spacing / setup.enlarged).to_string())
                .collect();
            all.join(", ")
        };
        match self {
            Self::Alone => String::new(),
            Self::Over(over) => format!("; {} over it", over.short()),
            Self::Slope(others) => format!("; slope over ∆s, with {}", spacings(others)),
            Self::SlopeError(others) => {
                format!(
                    "; standard error of the slope over ∆s, with {}",
                    spacings(others)
                )
            }
            Self::Greatest(others) => {
                let last = others.last().and_then(|setup| setup.h_over_spacing);
                format!("; greatest up to h/∆s = {}", last.unwrap_or(f64::NAN))
            }
        }
    }
}

/// A number of a paper beside ours.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    /// The paper's number in docs/papers.md.
    pub(crate) paper: &'static str,
    /// "fig12", "table1".
    pub(crate) figure: &'static str,
    pub(crate) subject: Subject,
    pub(crate) taken: Taken,
    pub(crate) measure: Measure,
    pub(crate) published: Published,
    pub(crate) bar: Bar,
    /// Whether it runs with `--quick`.
    pub(crate) quick: bool,
}

impl Row {
    /// What tells it from all others.
    pub(crate) fn id(&self) -> String {
        // A ratio has had this name from the first.
        let taken = match &self.taken {
            Taken::Over(over) => format!(" under {}", over.short()),
            other => other.words(),
        };
        format!(
            "{} {}: {}{}{taken}: {}",
            self.paper,
            self.figure,
            self.subject.words(),
            self.subject.remark(),
            self.measure.name()
        )
    }

    /// Whether a figure holds; `None` where the row is not judged.
    pub(crate) fn holds(&self, ours: f64) -> Option<bool> {
        match self.bar {
            Bar::AtMost(most) => Some(ours <= most),
            Bar::AtLeast(least) => Some(ours >= least),
            Bar::Beside => None,
        }
    }
}

/// A figure of a paper: what it shows, in our words.
pub(crate) struct Figure {
    pub(crate) paper: &'static str,
    pub(crate) figure: &'static str,
    pub(crate) claim: &'static str,
    /// Why it has no rows yet.
    pub(crate) missing: Option<&'static str>,
}
