//! Whether bodies may have layers of wall particles.

use sphpack_geometry::Thin;

use super::fault::{Checked, Key, fault};
use super::{Masses, Role, Scene};

/// More would be no layers beside a body any more.
const MOST_LAYERS: usize = 20;

/// Where particles of a body with layers sit, in ∆s: the first layer is these.
const HALF: f64 = 0.5;

impl Scene {
    /// What layers do not go together with is refused.
    pub(super) fn check_layers(&self) -> Checked {
        for (index, body) in self.body.iter().enumerate() {
            let Some(layers) = body.layers else {
                continue;
            };
            let refuse = |name: &'static str, message: String| {
                let at = [Key::Name("body"), Key::Index(index), Key::Name(name)];
                fault(&at, format!("body \"{}\": {message}", body.name))
            };
            if layers == 0 || layers > MOST_LAYERS {
                return refuse(
                    "layers",
                    format!(
                        "layers is {layers}; write how many layers of wall particles there are, 1 to {MOST_LAYERS}, or leave it out to fill the body"
                    ),
                );
            }
            if body.role == Role::Void {
                return refuse(
                    "layers",
                    "a void holds no particles, and has no layers of them; leave layers out, or make the role \"solid\""
                        .to_owned(),
                );
            }
            if body.surface.0 != HALF {
                return refuse(
                    "surface",
                    "layers are half a spacing, one and a half … deep in the wall; leave surface out, or layers"
                        .to_owned(),
                );
            }
            if body.thin == Thin::Watertight {
                return refuse(
                    "thin",
                    "thin = \"watertight\" gives thin parts more than their volume, of which layers know nothing; leave it out, or layers (holes in layers are filled anyway)"
                        .to_owned(),
                );
            }
            let not_with = |what: &str, instead: &str| {
                refuse(
                    "layers",
                    format!(
                        "layers do not go together with {what}; {instead}, or leave layers out"
                    ),
                )
            };
            if self.refinement.is_some() {
                return not_with("[refinement]", "give all particles one spacing");
            }
            if !self.packing.method.may_be_balanced() {
                return not_with(
                    &format!("the method \"{}\"", self.packing.method.name()),
                    "use method = \"balanced\"",
                );
            }
            if self.packing.masses == Masses::Corrected {
                return not_with(
                    "corrected masses, which are for bodies that are full",
                    "write packing.masses = \"equal\"",
                );
            }
            if let Some(void) = self.body.iter().find(|other| other.role == Role::Void) {
                return not_with(
                    &format!("voids, and \"{}\" is one", void.name),
                    "leave it out",
                );
            }
            let other = (self.body.iter().enumerate())
                .find(|(other, spec)| *other != index && spec.role == Role::Container);
            if let Some((_, other)) = other.filter(|_| body.role == Role::Container) {
                return not_with(
                    &format!("several containers, and \"{}\" is another", other.name),
                    "draw them as one outline or mesh",
                );
            }
        }
        Ok(())
    }
}
