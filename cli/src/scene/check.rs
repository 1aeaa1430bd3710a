//! Whether a scene makes sense, as far as that can be said without building its bodies.

use sphpack_geometry::Thin;
use sphpack_packing::Kind;

use super::check_body::check_body;
use super::fault::{Checked, Fault, Key, fault, finite, positive, vector};
use super::nearest::advice;
use super::{Finish, Method, Role, Scene, Surroundings};

/// The largest number of bodies.
pub(super) const MAX_BODIES: usize = 1000;

pub(super) fn too_many_bodies(number: usize) -> String {
    format!("there are {number} bodies; {MAX_BODIES} are the most")
}

impl Scene {
    /// Whether every number is in its range and the dimensions agree; files are not looked into.
    ///
    /// # Errors
    /// The first [`Fault`] found.
    pub fn check(&self) -> Result<(), Fault> {
        positive(&[Key::Name("spacing")], "spacing", self.spacing)?;
        self.check_domain()?;
        if self.body.len() > MAX_BODIES {
            return fault(&[Key::Name("body")], too_many_bodies(self.body.len()));
        }
        for (index, body) in self.body.iter().enumerate() {
            check_body(body, index)?;
            if body.thin == Thin::Watertight
                && (!self.packing.method.may_be_balanced() || body.role != Role::Solid)
            {
                return fault(
                    &[Key::Name("body"), Key::Index(index), Key::Name("thin")],
                    format!(
                        "body \"{}\": thin = \"watertight\" is for solid bodies and the method \"balanced\"; leave it out",
                        body.name
                    ),
                );
            }
            if let Some(twin) = self.body[..index].iter().position(|b| b.name == body.name) {
                return fault(
                    &[Key::Name("body"), Key::Index(index), Key::Name("name")],
                    format!(
                        "bodies {} and {} are both called \"{}\"; give each its own name",
                        twin + 1,
                        index + 1,
                        body.name
                    ),
                );
            }
        }
        self.check_dimensions()?;
        self.check_layers()?;
        self.check_refinement()?;
        positive(
            &[Key::Name("fluid"), Key::Name("density")],
            "fluid.density",
            self.fluid.density,
        )?;
        self.check_hydrostatic()?;
        self.check_packing()?;
        if let Some(value) = self.quality.h_over_spacing {
            ratio(
                &[Key::Name("quality"), Key::Name("h_over_spacing")],
                "quality.h_over_spacing",
                value,
            )?;
        }
        let known = Kind::ALL.map(Kind::name);
        for (index, name) in self.output.include.iter().enumerate() {
            if !known.contains(&name.as_str()) {
                return fault(
                    &[Key::Name("output"), Key::Name("include"), Key::Index(index)],
                    format!(
                        "no kind of particles is called \"{name}\"; {}",
                        advice(name, &known)
                    ),
                );
            }
        }
        self.check_surroundings()
    }

    fn check_hydrostatic(&self) -> Checked {
        let Some(hydrostatic) = &self.fluid.hydrostatic else {
            return Ok(());
        };
        let at = |name| {
            [
                Key::Name("fluid"),
                Key::Name("hydrostatic"),
                Key::Name(name),
            ]
        };
        let gravity = &hydrostatic.gravity;
        let dimension = self.domain.min.as_ref().map_or(gravity.len(), Vec::len);
        vector(
            &at("gravity"),
            "fluid.hydrostatic.gravity",
            gravity,
            dimension,
        )?;
        if gravity.iter().all(|&g| g == 0.0) {
            return fault(
                &at("gravity"),
                "fluid.hydrostatic.gravity is zero; give it a direction, such as [0.0, -9.81], or leave hydrostatic out",
            );
        }
        finite(
            &at("level"),
            "fluid.hydrostatic.level",
            &[hydrostatic.level],
        )?;
        positive(
            &at("sound_speed"),
            "fluid.hydrostatic.sound_speed",
            hydrostatic.sound_speed,
        )?;
        positive(
            &at("exponent"),
            "fluid.hydrostatic.exponent",
            hydrostatic.exponent,
        )
    }

    fn check_surroundings(&self) -> Checked {
        let Some(Surroundings { min, max }) = &self.output.surroundings else {
            return Ok(());
        };
        let at = |name| {
            [
                Key::Name("output"),
                Key::Name("surroundings"),
                Key::Name(name),
            ]
        };
        if !self.fluid.fill || self.body.iter().any(|body| body.role == Role::Container) {
            return fault(
                &[Key::Name("output"), Key::Name("surroundings")],
                "output.surroundings is fluid around the domain, where this scene has none; leave it out",
            );
        }
        let dimension = self.domain.min.as_ref().map_or(min.len(), Vec::len);
        vector(&at("min"), "output.surroundings.min", min, dimension)?;
        vector(&at("max"), "output.surroundings.max", max, dimension)?;
        match (&self.domain.min, &self.domain.max) {
            (Some(low), Some(high)) => self.check_around([min, max], [low, high]),
            _ => Ok(()),
        }
    }

    /// Whether the surroundings are around the domain: no nearer, and along periodic axes the same.
    pub(crate) fn check_around(
        &self,
        [min, max]: [&[f64]; 2],
        [low, high]: [&[f64]; 2],
    ) -> Checked {
        let periodic = self.domain.periodic.as_deref().unwrap_or(&[]);
        let at = [Key::Name("output"), Key::Name("surroundings")];
        for axis in 0..low.len().min(min.len()) {
            let box_of = |from: f64, to: f64| format!("from {from} to {to}");
            let domain = box_of(low[axis], high[axis]);
            let around = box_of(min[axis], max[axis]);
            let is_periodic = periodic.get(axis).copied().unwrap_or(false);
            if is_periodic && (min[axis] != low[axis] || max[axis] != high[axis]) {
                return fault(
                    &at,
                    format!(
                        "axis {axis} is periodic: there output.surroundings, {around}, must be the domain, {domain}"
                    ),
                );
            }
            if min[axis] > low[axis] || max[axis] < high[axis] {
                return fault(
                    &at,
                    format!(
                        "output.surroundings goes {around} along axis {axis}, the domain {domain}; it must be around the domain"
                    ),
                );
            }
        }
        Ok(())
    }

    fn check_domain(&self) -> Checked {
        let at = |name| [Key::Name("domain"), Key::Name(name)];
        let domain = &self.domain;
        let dimension = match (&domain.min, &domain.max, domain.margin) {
            (Some(min), Some(max), None) => {
                if min.len() != 2 && min.len() != 3 {
                    return fault(
                        &at("min"),
                        format!(
                            "domain.min has {} entries; write two (2-D) or three (3-D)",
                            min.len()
                        ),
                    );
                }
                finite(&at("min"), "domain.min", min)?;
                vector(&at("max"), "domain.max", max, min.len())?;
                for (axis, (low, high)) in min.iter().zip(max).enumerate() {
                    if low >= high {
                        return fault(
                            &at("max"),
                            format!(
                                "domain.max[{axis}] is {high}, not above domain.min[{axis}], which is {low}; make it larger"
                            ),
                        );
                    }
                }
                Some(min.len())
            }
            (None, None, Some(margin)) => {
                positive(&at("margin"), "domain.margin", margin)?;
                if self.body.is_empty() {
                    return fault(
                        &at("margin"),
                        "domain.margin needs a body to go around; add a [[body]], or write min and max",
                    );
                }
                None
            }
            (_, _, Some(_)) => {
                return fault(
                    &at("margin"),
                    "domain has margin besides min or max; write either margin, or both min and max",
                );
            }
            _ => {
                return fault(
                    &[Key::Name("domain")],
                    "domain needs min and max, such as min = [-2, -2] and max = [2, 2], or a margin around the bodies",
                );
            }
        };
        match (&domain.periodic, dimension) {
            (Some(periodic), Some(dimension)) if periodic.len() != dimension => fault(
                &at("periodic"),
                format!(
                    "domain.periodic has {} entries; it needs {dimension}, one for each axis",
                    periodic.len()
                ),
            ),
            _ => Ok(()),
        }
    }

    /// Bodies whose shapes say their dimension must agree with the domain and with each other.
    fn check_dimensions(&self) -> Checked {
        let mut known = self
            .domain
            .min
            .as_ref()
            .map(|min| (min.len(), "the domain".to_owned()));
        for (index, body) in self.body.iter().enumerate() {
            let Some(dimension) = body.shape.dimension() else {
                continue;
            };
            match &known {
                Some((other, of)) if *other != dimension => {
                    return fault(
                        &[Key::Name("body"), Key::Index(index), Key::Name("shape")],
                        format!(
                            "body \"{}\" is {dimension}-dimensional ({}), {of} is {other}-dimensional; all must agree",
                            body.name,
                            body.shape.name()
                        ),
                    );
                }
                Some(_) => {}
                None => known = Some((dimension, format!("body \"{}\"", body.name))),
            }
        }
        Ok(())
    }

    fn check_packing(&self) -> Checked {
        let packing = &self.packing;
        let at = |name| [Key::Name("packing"), Key::Name(name)];
        let info = packing.method.info();
        let solid = (self.body.iter()).find(|body| body.role == Role::Solid);
        if let (false, Some(body)) = (info.fills_bodies, solid) {
            return fault(
                &at("method"),
                format!(
                    "the method \"{}\" packs fluid between walls and would leave body \"{}\" empty, which is solid; give that the role \"void\" to keep the fluid out or \"container\" to hold it, or use method = \"balanced\"",
                    info.name, body.name
                ),
            );
        }
        match &packing.accuracy {
            Some(accuracy) if packing.method == Method::Auto => {
                accuracy.check(self.refinement.is_some())?;
            }
            Some(_) => {
                return fault(
                    &at("accuracy"),
                    format!(
                        "packing.accuracy is what method = \"auto\" picks settings by, and the method is \"{}\": use method = \"auto\", or leave accuracy out",
                        packing.method.name()
                    ),
                );
            }
            None => {}
        }
        let is_hybrid = packing.method == Method::Hybrid;
        let minimises = info.minimises || (is_hybrid && packing.minimiser.is_some());
        let of_balanced = match packing.finish {
            Finish::Even | Finish::Consistent => None,
            Finish::Calm => Some("calm"),
            Finish::Both => Some("both"),
        };
        if let (Some(finish), false) = (of_balanced, packing.method.may_be_balanced()) {
            return fault(
                &at("finish"),
                format!(
                    "finish = \"{finish}\" is for the method \"balanced\", not for \"{}\": use finish = \"even\", or method = \"balanced\"",
                    packing.method.name()
                ),
            );
        }
        if !(0.0..=1.0).contains(&packing.balance) {
            return fault(
                &at("balance"),
                format!(
                    "packing.balance is {}; it must be between 0, for consistency alone, and 1, for evenness alone",
                    packing.balance
                ),
            );
        }
        if !minimises && packing.finish == Finish::Consistent {
            return fault(
                &at("finish"),
                format!(
                    "finish = \"consistent\" is for methods that minimise; the method \"{}\" does not: use finish = \"even\"{}",
                    packing.method.name(),
                    if is_hybrid {
                        ", or add minimiser = \"lbfgs\""
                    } else {
                        ", or method = \"balanced\""
                    }
                ),
            );
        }
        ratio(
            &at("h_over_spacing"),
            "packing.h_over_spacing",
            packing.h_over_spacing(),
        )?;
        positive(
            &at("velocity_tolerance"),
            "packing.velocity_tolerance",
            packing.velocity_tolerance,
        )?;
        if !(packing.mass_spread > 0.0 && packing.mass_spread < 1.0) {
            return fault(
                &at("mass_spread"),
                format!(
                    "packing.mass_spread is {}; it must be between 0 and 1, such as 0.02 for ±2 %",
                    packing.mass_spread
                ),
            );
        }
        packing.hybrid.check()?;
        packing.agitated.check()?;
        if let Some(levelling) = packing.levelling
            && !(levelling >= 0.0 && levelling.is_finite())
        {
            return fault(
                &at("levelling"),
                format!(
                    "packing.levelling is {levelling}; it must be 0 (none) or positive, such as 10"
                ),
            );
        }
        packing.residual_tolerance.map_or(Ok(()), |tolerance| {
            positive(
                &at("residual_tolerance"),
                "packing.residual_tolerance",
                tolerance,
            )
        })
    }
}

/// h/∆s within what a smoothing length can sensibly be.
fn ratio(keys: &[Key], name: &str, value: f64) -> Checked {
    positive(keys, name, value)?;
    if (0.5..=5.0).contains(&value) {
        return Ok(());
    }
    fault(
        keys,
        format!("{name} is {value}; it must be between 0.5 and 5 (usual are 1.0 to 2.0)"),
    )
}
