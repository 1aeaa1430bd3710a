//! Scenes: what a person writes down to be packed.

mod accuracy;
mod check;
mod check_body;
mod check_layers;
mod document;
mod explain;
mod fault;
mod fluid;
mod given;
mod json;
mod length_unit;
mod method;
mod named;
mod nearest;
mod options;
mod output;
mod parse;
mod parser_words;
mod quality;
#[cfg(test)]
mod reading_tests;
mod refinement;
#[cfg(feature = "schema")]
mod schema;
#[cfg(all(test, feature = "schema"))]
mod schema_tests;
mod shape;
mod slips;
mod solver_words;
mod tables;
mod template;
#[cfg(test)]
mod tests;
mod wrong;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sphpack_geometry::Thin;
use sphpack_kernels::KernelKind;
use sphpack_packing::{Band, Complex, Hybrid, Kind, Lattice, MinimiserKind, Settling};

pub use accuracy::{Accuracy, AccuracyMeasure};
pub use fault::Fault;
pub use fluid::{FluidSpec, Hydrostatic};
pub use given::Given;
pub(crate) use length_unit::LengthUnit;
pub use method::{Method, UnknownMethod};
pub use named::Inset;
pub(crate) use named::kernel_by_name;
pub(crate) use nearest::advice;
pub use options::{AgitatedOptions, AgitatorsAre, HybridOptions};
pub use output::{OutputSpec, Surroundings};
pub use quality::QualitySpec;
pub use refinement::{RefinementSpec, RegionSpec};
#[cfg(feature = "schema")]
pub use schema::json_schema;
pub use shape::{SHAPES, Shape, ShapeInfo};
pub use template::TEMPLATE;

/// Bodies in a box, and how to pack them. Written as TOML; every field has the meaning of its key there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The name in titles and of files: the scene file's, without its ending.
    #[serde(skip)]
    pub name: String,
    /// The scene's file; other paths are relative to its folder.
    #[serde(skip)]
    pub path: PathBuf,
    /// What its text was read as, where that is in other words than a scene's own; a sentence each.
    #[serde(skip)]
    pub notes: Vec<String>,
    /// ∆s, scene units; with `refinement`, on the bodies' surfaces.
    pub spacing: f64,
    /// How particles grow away from there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refinement: Option<RefinementSpec>,
    /// The box.
    pub domain: DomainSpec,
    /// The bodies.
    #[serde(default)]
    pub body: Vec<BodySpec>,
    /// What is between them.
    #[serde(default)]
    pub fluid: FluidSpec,
    /// How to pack.
    #[serde(default)]
    pub packing: PackingSpec,
    /// How the result is judged.
    #[serde(default)]
    pub quality: QualitySpec,
    /// What is written.
    #[serde(default)]
    pub output: OutputSpec,
}

/// The box: either `min` and `max`, or a `margin` around the bodies.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct DomainSpec {
    /// Lower corner, scene units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<Vec<f64>>,
    /// Upper corner, scene units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<Vec<f64>>,
    /// From the box around the bodies to the sides, scene units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Which axes wrap around; none where left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub periodic: Option<Vec<bool>>,
}

/// What a body is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Its inside is filled with solid particles.
    #[default]
    Solid,
    /// Its inside is the domain, as in a tank: what is outside is left out of the output, boundary particles are its
    /// wall.
    Container,
    /// Its inside is left out of the output.
    Void,
}

/// A body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct BodySpec {
    /// The name in files and reports; "body", "body 2", … where left out.
    #[serde(default)]
    pub name: String,
    /// The true body.
    pub shape: Shape,
    /// Factor on all lengths, first.
    #[serde(default = "one")]
    pub scale: f64,
    /// 2-D: counter-clockwise rotation about the origin, second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotate_degrees: Option<f64>,
    /// 3-D: rotation about an axis through the origin, second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotate: Option<Rotation>,
    /// Shift, last, scene units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translate: Option<Vec<f64>>,
    /// What it is for.
    #[serde(default)]
    pub role: Role,
    /// Where solid bodies overlap, the one with the higher number keeps the room, and the other is what is left of it.
    #[serde(default)]
    pub precedence: i32,
    /// Physical density; mass = density × volume.
    #[serde(default = "one")]
    pub density: f64,
    /// Where its boundary particles sit.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(schema_with = "schema::inset"))]
    pub surface: Inset,
    /// How many particles parts get that are thinner than ∆s.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(schema_with = "schema::thin"))]
    pub thin: Thin,
    /// With `refinement`, the spacing at its surface, scene units; the scene's where left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<f64>,
    /// With `refinement`, how many particles there are per radius of curvature, down to its `finest`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curvature: Option<f64>,
    /// Wall particles in so many layers: of a solid instead of filling it, of a container outside of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layers: Option<usize>,
}

/// A rotation in space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Rotation {
    /// Direction of the axis, of any length.
    pub axis: Vec<f64>,
    /// Angle, right-hand rule.
    pub degrees: f64,
}

/// How the free particles are left at the end, by methods that minimise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Finish {
    /// A weak repulsion keeps pairs apart, and the density is level.
    #[default]
    Even,
    /// No repulsion at the end: zero-order consistent.
    Consistent,
    /// Zero-order consistent to 10⁻⁶ with pairs apart; of the method balanced, for some thousand particles.
    Calm,
    /// Even and consistent at once, as `balance` weighs them; of the method balanced.
    Both,
}

/// Which particles of a balanced packing settle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum BandWidth {
    /// Those near a surface; the others stay on their lattice.
    #[default]
    Auto,
    /// All.
    Full,
}

/// What particles weigh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Masses {
    /// All particles of a body, and of the fluid, alike; surface particles may differ a little from the others.
    #[default]
    Equal,
    /// Each a little more or less, so that the density is even; every body's total stays.
    Corrected,
}

/// How frozen particles are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Frozen {
    /// The lattice of the inside, continued.
    #[default]
    Lattice,
    /// A square or simple cubic ring, as Negi & Ramachandran (2021) draw it.
    Square,
}

/// How to pack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct PackingSpec {
    /// The method.
    pub method: Method,
    /// What the method "auto" is to reach.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Accuracy>,
    /// The kernel that packs; `None` is the method's own ([`Method::info`]).
    #[serde(
        with = "named::optional_kernel",
        skip_serializing_if = "Option::is_none"
    )]
    #[cfg_attr(feature = "schema", schemars(schema_with = "schema::kernel"))]
    pub kernel: Option<KernelKind>,
    /// Its smoothing length over ∆s; `None` is the method's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub h_over_spacing: Option<f64>,
    /// Smoothing length over √D ∆s, where a text says that and the dimension D is not known before its bodies' files are opened.
    #[serde(skip)]
    pub(crate) h_over_diagonal: Option<f64>,
    /// The starting lattice; `None` is "auto".
    #[serde(with = "named::lattice")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "schema::lattice"))]
    pub lattice: Option<Lattice>,
    /// The arrangement of frozen particles.
    pub frozen: Frozen,
    /// Methods that damp stop where u_max ∆t/h falls below this.
    pub velocity_tolerance: f64,
    /// The minimiser; `None` is the method's own: "lbfgs" for balanced, none for hybrid, which damps.
    #[serde(with = "named::minimiser", skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "schema::minimiser"))]
    pub minimiser: Option<MinimiserKind>,
    /// Methods that minimise stop where the largest force times h falls below this; `None` is 10⁻³ for an even finish,
    /// 10⁻⁵ for a consistent one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_tolerance: Option<f64>,
    /// The finish of methods that minimise.
    pub finish: Finish,
    /// Of the finish "both": 0 is consistency alone, 1 evenness alone.
    pub balance: f64,
    /// How strongly an even finish levels the density, κ of p = p_b (1 + κ (Γ − Γ₀)); `None` is 10, less where
    /// h/∆s is below 1.2, in space 60 to 200 with Wendland's kernels ([`Settling::levelling_at`]); with corrected masses 200. For complex relaxation 1000. A consistent finish does not level.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub levelling: Option<f64>,
    /// Which particles settle, with the method balanced.
    pub band: BandWidth,
    /// What particles weigh.
    pub masses: Masses,
    /// With corrected masses, the largest change of one, as a part of it.
    pub mass_spread: f64,
    /// Give up after this many.
    pub max_iterations: usize,
    /// For methods that draw random numbers.
    pub seed: u64,
    /// Of the method hybrid.
    pub hybrid: HybridOptions,
    /// Of the method agitated.
    pub agitated: AgitatedOptions,
    /// Which of these keys a scene's file has.
    #[serde(skip)]
    pub given: Given,
}

/// The levelling of an even finish whose masses are corrected, unless the scene says otherwise: where masses are to
/// even out what is left, less should be left.
const CORRECTED_LEVELLING: f64 = 200.0;

impl PackingSpec {
    /// The kernel that packs.
    pub fn kernel(&self) -> KernelKind {
        self.kernel.unwrap_or(self.method.info().kernel)
    }

    /// The lattice to start from, in so many dimensions; `None` is the one of least Γ.
    pub fn lattice_in(&self, dimension: usize) -> Option<Lattice> {
        let own = || {
            let lattices = self.method.info().lattices?;
            lattices.into_iter().find(|l| l.dimension() == dimension)
        };
        self.lattice.or_else(own)
    }

    /// Its smoothing length over ∆s.
    pub fn h_over_spacing(&self) -> f64 {
        (self.h_over_spacing).unwrap_or(self.method.info().h_over_spacing)
    }

    /// Evaluations until particles are at rest, or until no more are allowed, in the middle of what scenes take, in so many
    /// dimensions.
    pub fn typical_evaluations(&self, dimension: usize) -> f64 {
        let work = self.method.info().work;
        match (self.method, self.finish) {
            // What a body does to its surroundings falls off so slowly that some hundred more are needed for 10⁻⁵; "both" takes 390 …
            // 1,400.
            (Method::Balanced, Finish::Consistent | Finish::Both) => {
                (500_f64).min(self.max_iterations as f64)
            }
            // Most of it is for factors of matrices: by 1,600 and 6,400 particles in the plane, whose seconds are those of
            // 1,500 and 12,000 evaluations.
            (Method::Balanced, Finish::Calm) => 5000.0,
            // By what docs/steady.md compares: 1.2 … 7 times as many where levelling is 6 … 20 times as strong.
            (Method::Balanced, Finish::Even) if dimension == 3 => {
                let stronger = 0.1 * self.settling_in(dimension).levelling;
                let evaluations = work.evaluations * stronger.max(1.0).powf(0.4);
                evaluations.min(self.max_iterations as f64)
            }
            _ => work.evaluations_within(self.max_iterations),
        }
    }

    /// Which particles a method moves that leaves some on their lattice.
    pub fn band(&self) -> Band {
        match self.band {
            BandWidth::Auto => Band::Auto,
            BandWidth::Full => Band::Full,
        }
    }

    /// How methods that minimise bring particles to rest, in so many dimensions.
    pub fn settling_in(&self, dimension: usize) -> Settling {
        let defaults = Settling::default();
        let levelling = match self.masses {
            _ if self.method == Method::Complex => Complex::default().levelling,
            Masses::Equal => {
                Settling::levelling_at(dimension, self.kernel(), self.h_over_spacing())
            }
            Masses::Corrected => CORRECTED_LEVELLING,
        };
        Settling {
            minimiser: self.minimiser.unwrap_or_default(),
            finish: match self.finish {
                Finish::Even => sphpack_packing::Finish::Even,
                Finish::Consistent => sphpack_packing::Finish::Consistent,
                Finish::Calm => sphpack_packing::Finish::Calm,
                Finish::Both => sphpack_packing::Finish::Both,
            },
            residual_tolerance: self.residual_tolerance,
            levelling: self.levelling.unwrap_or(levelling),
            balance: self.balance,
            max_evaluations: self.max_iterations,
            ..defaults
        }
    }
}

impl Default for PackingSpec {
    fn default() -> Self {
        let hybrid = Hybrid::default();
        Self {
            method: Method::default(),
            accuracy: None,
            kernel: None,
            h_over_spacing: None,
            h_over_diagonal: None,
            lattice: None,
            frozen: Frozen::default(),
            velocity_tolerance: hybrid.velocity_tolerance,
            minimiser: None,
            residual_tolerance: None,
            finish: Finish::default(),
            balance: Settling::default().balance,
            levelling: None,
            band: BandWidth::default(),
            masses: Masses::default(),
            mass_spread: 0.02,
            max_iterations: hybrid.max_iterations,
            seed: 0,
            hybrid: HybridOptions::default(),
            agitated: AgitatedOptions::default(),
            given: Given::default(),
        }
    }
}

impl Scene {
    /// A scene of one body from a file, in a box with a margin around it (scene units).
    pub fn of_body(file: &Path, spacing: f64, margin: f64) -> Self {
        let name = file.file_stem().map_or_else(
            || "body".to_owned(),
            |stem| stem.to_string_lossy().into_owned(),
        );
        Self {
            path: file.to_owned(),
            notes: Vec::new(),
            spacing,
            domain: DomainSpec {
                margin: Some(margin),
                ..DomainSpec::default()
            },
            body: vec![BodySpec {
                name: name.chars().filter(|c| !c.is_control()).collect(),
                shape: Shape::File(
                    file.file_name()
                        .map_or_else(|| file.to_owned(), PathBuf::from),
                ),
                scale: 1.0,
                rotate_degrees: None,
                rotate: None,
                translate: None,
                role: Role::Solid,
                precedence: 0,
                density: 1.0,
                surface: Inset::default(),
                thin: Thin::default(),
                spacing: None,
                curvature: None,
                layers: None,
            }],
            name,
            refinement: None,
            fluid: FluidSpec::default(),
            packing: PackingSpec::default(),
            quality: QualitySpec::default(),
            output: OutputSpec::default(),
        }
    }

    /// A path of the scene, as seen from the working directory.
    pub fn resolve(&self, path: &Path) -> PathBuf {
        match self.path.parent() {
            Some(folder) => folder.join(path),
            None => path.to_owned(),
        }
    }

    /// The kernel and h/∆s that judge the result.
    pub fn judge(&self) -> (KernelKind, f64) {
        (
            self.quality.kernel.unwrap_or(self.packing.kernel()),
            self.quality
                .h_over_spacing
                .unwrap_or(self.packing.h_over_spacing()),
        )
    }

    /// Whether the files hold particles of a kind.
    pub fn includes(&self, kind: Kind) -> bool {
        self.output.include.iter().any(|name| name == kind.name())
    }
}

fn one() -> f64 {
    1.0
}
