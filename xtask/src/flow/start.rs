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
    Complex,
    Relaxation,
}

impl Start {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Clipped => "clipped",
            Self::Balanced => "balanced",
            Self::Ppa => "ppa",
            Self::Hybrid => "hybrid",
            Self::Complex => "complex",
            Self::Relaxation => "relaxation",
        }
    }

    fn method(self) -> Method {
        match self {
            Self::Clipped => Method::Clipped,
            Self::Balanced => Method::Balanced,
            Self::Ppa => Method::Ppa,
            Self::Hybrid => Method::Hybrid,
            Self::Complex => Method::Complex,
            Self::Relaxation => Method::Relaxation,
        }
    }
}

/// Positions and volumes.
#[derive(Debug, Clone, Default)]
pub(super) struct Packed {
    /// Of every body, by its number in the scene.
    pub(super) bodies: Vec<Vec<([f64; 2], f64)>>,
    /// The outward unit normals of the true surfaces next to them.
    pub(super) normals: Vec<Vec<[f64; 2]>>,
    /// What is in the box beside them.
    pub(super) around: Vec<([f64; 2], f64)>,
    /// How far that is from the nearest true surface.
    distance: Vec<f64>,
}

impl Packed {
    /// Particles beside the bodies that are next to one: nearer than so much.
    pub(super) fn near(&self, distance: f64) -> Vec<usize> {
        (0..self.around.len())
            .filter(|&i| self.distance[i] < distance)
            .collect()
    }
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
        normals: vec![Vec::new(); scene.body.len()],
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
            Some(body) => {
                let surface = &solution.problem.bodies[body].surface;
                found.bodies[body].push(of);
                found.normals[body].push(surface.closest(of.0).normal);
            }
            None => {
                let bodies = &solution.problem.bodies;
                let nearest = (bodies.iter())
                    .map(|body| body.surface.closest(of.0).distance)
                    .fold(f64::INFINITY, f64::min);
                found.around.push(of);
                found.distance.push(nearest);
            }
        }
    }
    Ok(found)
}
