//! What is asked of a packing, beside the problem that was packed.

use sphpack_packing::{MethodInfo, Packed};

use crate::scene::{Role, Scene};

/// Method, roles and fluid, of a scene or of none.
pub(crate) struct Asked {
    pub(crate) method: &'static MethodInfo,
    /// The bodies' roles.
    roles: Vec<Role>,
    /// Whether there is fluid around the bodies.
    pub(crate) has_fluid: bool,
}

impl Asked {
    /// What a scene asks for.
    pub(crate) fn by(scene: &Scene) -> Self {
        Self {
            method: scene.packing.method.info(),
            roles: scene.body.iter().map(|body| body.role).collect(),
            has_fluid: scene.fluid.fill,
        }
    }

    /// Solid bodies in fluid, by the method that packed them.
    pub(crate) fn of<const D: usize>(packed: &Packed<D>) -> Self {
        Self {
            method: packed.method,
            roles: Vec::new(),
            has_fluid: true,
        }
    }

    /// The role of body `number`.
    pub(crate) fn role(&self, number: usize) -> Role {
        self.roles.get(number).copied().unwrap_or(Role::Solid)
    }
}
