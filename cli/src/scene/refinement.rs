//! How fine the particles are where: the scene's table `refinement`.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sphpack_geometry::Thin;

use super::check_body::check_shape;
use super::fault::{Checked, Key, fault, positive};
use super::{BodySpec, Finish, Frozen, Masses, Scene, Shape};

/// Particles that grow with the distance from surfaces and regions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RefinementSpec {
    /// The coarsest spacing, scene units.
    pub coarsest: f64,
    /// The finest spacing: no body and no region gets a finer one; scene units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub finest: Option<f64>,
    /// The ratio of neighbouring particles' spacings, at most.
    #[serde(default = "usual_growth")]
    pub growth: f64,
    /// A file with spacings at the nodes of a grid: columns x, y, in space z, and spacing (scene units).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<PathBuf>,
    /// Regions with a spacing of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub region: Vec<RegionSpec>,
}

/// A region with a spacing of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RegionSpec {
    /// Where.
    pub shape: Shape,
    /// How fine, scene units.
    pub spacing: f64,
}

/// By 8 % from one particle to the next.
fn usual_growth() -> f64 {
    1.08
}

/// Evaluations that particles of many sizes take: each stage ends after so many.
const EVALUATIONS: f64 = 110.0;

/// What `curvature` may be.
const PER_RADIUS: [f64; 2] = [1.0, 1000.0];

/// What `growth` may be.
const GROWTHS: [f64; 2] = [1.02, 1.3];

impl Scene {
    /// The files that it names, as it names them: of bodies, regions and spacings.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        let bodies = self.body.iter().filter_map(|body| body.shape.file());
        let refinement = self.refinement.iter();
        let more = refinement.flat_map(|refinement| {
            let regions = refinement.region.iter();
            let regions = regions.filter_map(|region| region.shape.file());
            regions.chain(refinement.field.as_deref())
        });
        bodies.chain(more)
    }

    /// The spacing at the surface of a body, scene units.
    pub(crate) fn spacing_of(&self, body: usize) -> f64 {
        self.no_finer(self.body[body].spacing.unwrap_or(self.spacing))
    }

    /// A spacing, unless the scene's finest is coarser.
    pub(crate) fn no_finer(&self, spacing: f64) -> f64 {
        let finest = self
            .refinement
            .as_ref()
            .and_then(|refinement| refinement.finest);
        finest.map_or(spacing, |finest| spacing.max(finest))
    }

    /// Evaluations until particles are at rest, or until no more are allowed, in the middle of what scenes take.
    pub fn typical_evaluations(&self, dimension: usize) -> f64 {
        match self.refinement {
            Some(_) => EVALUATIONS.min(self.packing.max_iterations as f64),
            None => self.packing.typical_evaluations(dimension),
        }
    }

    pub(super) fn check_refinement(&self) -> Checked {
        let Some(refinement) = &self.refinement else {
            let own = |body: &BodySpec| match (body.spacing, body.curvature) {
                (Some(_), _) => Some("spacing"),
                (None, Some(_)) => Some("curvature"),
                (None, None) => None,
            };
            let found = (self.body.iter().enumerate()).find_map(|(k, body)| Some((k, own(body)?)));
            return match found {
                Some((index, key)) => fault(
                    &[Key::Name("body"), Key::Index(index), Key::Name(key)],
                    format!(
                        "body \"{}\" has a {key} of its own, which needs a table [refinement] with the coarsest, such as coarsest = {}",
                        self.body[index].name, self.spacing
                    ),
                ),
                None => Ok(()),
            };
        };
        let at = |name| [Key::Name("refinement"), Key::Name(name)];
        let coarsest = refinement.coarsest;
        positive(&at("coarsest"), "refinement.coarsest", coarsest)?;
        let finer = |keys: &[Key], name: &str, spacing: f64| {
            positive(keys, name, spacing)?;
            if spacing <= coarsest {
                return Ok(());
            }
            fault(
                keys,
                format!(
                    "{name} is {spacing}, coarser than refinement.coarsest, which is {coarsest}; make it finer, or that coarser"
                ),
            )
        };
        finer(&[Key::Name("spacing")], "spacing", self.spacing)?;
        if let Some(finest) = refinement.finest {
            finer(&at("finest"), "refinement.finest", finest)?;
        }
        let [least, greatest] = GROWTHS;
        if !(least..=greatest).contains(&refinement.growth) {
            return fault(
                &at("growth"),
                format!(
                    "refinement.growth is {}; it must be between {least} and {greatest}: 1.08 is 8 % from one particle to the next",
                    refinement.growth
                ),
            );
        }
        for (index, region) in refinement.region.iter().enumerate() {
            let at = |name| {
                [
                    Key::Name("refinement"),
                    Key::Name("region"),
                    Key::Index(index),
                    Key::Name(name),
                ]
            };
            let called = format!("refinement.region {}", index + 1);
            check_shape(&region.shape, &called, &at("shape"))?;
            finer(
                &at("spacing"),
                &format!("{called}: spacing"),
                region.spacing,
            )?;
            let dimension = self.domain.min.as_ref().map(Vec::len);
            if let (Some(own), Some(dimension)) = (region.shape.dimension(), dimension)
                && own != dimension
            {
                return fault(
                    &at("shape"),
                    format!(
                        "{called} is {own}-dimensional ({}), the domain is {dimension}-dimensional",
                        region.shape.name()
                    ),
                );
            }
        }
        for (index, body) in self.body.iter().enumerate() {
            if let Some(spacing) = body.spacing {
                let keys = [Key::Name("body"), Key::Index(index), Key::Name("spacing")];
                finer(&keys, &format!("body \"{}\": spacing", body.name), spacing)?;
            }
            if let Some(curvature) = body.curvature {
                self.check_curvature(index, curvature)?;
            }
            if body.thin == Thin::Watertight {
                return fault(
                    &[Key::Name("body"), Key::Index(index), Key::Name("thin")],
                    format!(
                        "body \"{}\": thin = \"watertight\" is for particles of one size; leave it out, or [refinement]",
                        body.name
                    ),
                );
            }
        }
        self.check_graded_packing()
    }

    /// What a surface's curvature asks for must be a number of particles, and there must be something finer to come to.
    fn check_curvature(&self, index: usize, curvature: f64) -> Checked {
        let keys = [Key::Name("body"), Key::Index(index), Key::Name("curvature")];
        let name = &self.body[index].name;
        let [least, greatest] = PER_RADIUS;
        if !(least..=greatest).contains(&curvature) {
            return fault(
                &keys,
                format!(
                    "body \"{name}\": curvature is {curvature}; it must be between {least} and {greatest} particles per radius of curvature"
                ),
            );
        }
        let usual = self.spacing_of(index);
        if self.finest() < usual {
            return Ok(());
        }
        fault(
            &keys,
            format!(
                "body \"{name}\": curvature asks for particles finer than its spacing of {usual}, and nothing says how fine; give refinement.finest, such as finest = {}",
                0.25 * usual
            ),
        )
    }

    /// The finest spacing that is allowed: the scene's own word, or the least that is named.
    pub(crate) fn finest(&self) -> f64 {
        let Some(refinement) = &self.refinement else {
            return self.spacing;
        };
        let bodies = self.body.iter().filter_map(|body| body.spacing);
        let regions = refinement.region.iter().map(|region| region.spacing);
        let least = bodies.chain(regions).fold(self.spacing, f64::min);
        refinement.finest.unwrap_or(least)
    }

    /// What particles of many sizes do not have.
    fn check_graded_packing(&self) -> Checked {
        let packing = &self.packing;
        let at = |name| [Key::Name("packing"), Key::Name(name)];
        if !packing.method.may_be_balanced() {
            return fault(
                &at("method"),
                format!(
                    "the method \"{}\" packs particles of one size; with [refinement] use method = \"balanced\"",
                    packing.method.name()
                ),
            );
        }
        let only = |name, value: &str, usual: &str| {
            fault(
                &at(name),
                format!(
                    "packing.{name} = \"{value}\" is for particles of one size; with [refinement] use \"{usual}\""
                ),
            )
        };
        match packing.finish {
            Finish::Even => {}
            Finish::Consistent => return only("finish", "consistent", "even"),
            Finish::Calm => return only("finish", "calm", "even"),
            Finish::Both => return only("finish", "both", "even"),
        }
        if packing.masses == Masses::Corrected {
            return only("masses", "corrected", "equal");
        }
        if packing.frozen == Frozen::Square {
            return only("frozen", "square", "lattice");
        }
        if self.output.surroundings.is_some() {
            return fault(
                &[Key::Name("output"), Key::Name("surroundings")],
                "output.surroundings continues a lattice, which particles of many sizes are not on; make the domain as large as the surroundings, which costs little with [refinement]",
            );
        }
        Ok(())
    }
}
