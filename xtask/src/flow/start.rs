//! Particles to start from: a scene, packed by one method or another.

use std::path::Path;

use sphpack::Packing;
use sphpack::scene::{Method, Role};
use sphpack::{Options, Scene, run as pack};
use sphpack_packing::{Kind, Lattice, Silent};
use sphpack_separation::Side;

/// How the particles are packed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    /// The square lattice, clipped by the body.
    Clipped,
    Balanced,
    Ppa,
    Hybrid,
}

impl Start {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Clipped => "clipped",
            Self::Balanced => "balanced",
            Self::Ppa => "ppa",
            Self::Hybrid => "hybrid",
        }
    }

    fn method(self) -> Method {
        match self {
            Self::Clipped => Method::Clipped,
            Self::Balanced => Method::Balanced,
            Self::Ppa => Method::Ppa,
            Self::Hybrid => Method::Hybrid,
        }
    }
}

/// Positions and volumes.
#[derive(Debug, Clone, Default)]
pub(super) struct Packed {
    /// Of every body, by its number in the scene.
    pub(super) bodies: Vec<Vec<([f64; 2], f64)>>,
    /// What is in the box beside them.
    pub(super) around: Vec<([f64; 2], f64)>,
}

/// Packs the scene of a text, without a method in it, bodies that the fluid fills.
pub(super) fn packed(text: &str, start: Start) -> Result<Packed, String> {
    let said = |error: sphpack::Error| error.to_string();
    let mut scene = Scene::parse(text, Path::new("flow.toml")).map_err(said)?;
    scene.packing.method = start.method();
    if start == Start::Clipped {
        scene.packing.lattice = Some(Lattice::Square);
    }
    if start == Start::Ppa {
        // This method packs a fluid, to the walls of what holds it.
        for body in &mut scene.body {
            body.role = Role::Container;
        }
    }
    let outcome = pack(&scene, &Options::default(), &mut Silent).map_err(said)?;
    let Packing::Plane(solution) = outcome.packing else {
        return Err("a flow in the plane needs a scene in the plane".to_owned());
    };
    let particles = &solution.packed.particles;
    let mut found = Packed {
        bodies: vec![Vec::new(); scene.body.len()],
        ..Packed::default()
    };
    for i in 0..particles.len() {
        let of = (particles.position[i], particles.volume[i]);
        let body = match (particles.kind[i], solution.labels.body[i]) {
            (Kind::Frozen, _) => continue,
            (_, Some(body)) if solution.labels.side[i] == Side::Solid => Some(usize::from(body)),
            // The fluid of a container is in no body.
            _ if start == Start::Ppa && solution.keep[i] => Some(0),
            _ => None,
        };
        match body {
            Some(body) => found.bodies[body].push(of),
            None => found.around.push(of),
        }
    }
    Ok(found)
}
