//! Airfoils as 004 parses and relaxes them: solid and fluid on grids of their own or by one outline, apart or together.

use std::path::PathBuf;

use sphpack_geometry::{Outline, Surface};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Domain, KdTree, point};
use sphpack_packing::{
    Complex, Fields, Kind, Method, Packed, Particles, Problem, Relaxation, RunLog, Silent,
};

use crate::parsed::parsed;
use crate::selection::Selection;
use crate::workspace::root;

/// ∆s: the chord has 250.
pub(crate) const SPACING: f64 = 1.0 / 250.0;

/// The fluid's.
const H_OVER_SPACING: f64 = 1.3;

const TOLERANCE: f64 = 1e-4;
const MOST_ITERATIONS: usize = 1500;

/// How far from a trailing edge still is at it, in ∆s.
const AT_EDGE: f64 = 6.0;

/// Places per ∆s where holes are looked for.
const FINENESS: f64 = 8.0;

/// An airfoil: its elements, and the box around it.
pub(crate) struct Airfoil {
    pub(crate) name: &'static str,
    pub(crate) elements: Vec<Outline>,
    domain: Domain<2>,
}

/// NACA 5515, and 30P30N where its files are there.
pub(crate) fn airfoils(selection: &Selection) -> Result<Vec<Airfoil>, String> {
    let around = |elements: Vec<Outline>, name| {
        let bounds = (elements.iter().skip(1))
            .fold(elements[0].bounds(), |all, one| all.union(one.bounds()))
            // Half a cell off the grid of the first element.
            .grown(20.5 * SPACING);
        let domain = Domain::new(bounds.min, bounds.max);
        Airfoil {
            name,
            elements,
            domain,
        }
    };
    let naca = Outline::naca("5515", 1.0).map_err(|error| error.to_string())?;
    let mut all = vec![around(vec![naca], "NACA 5515")];
    let folder = (selection.data.clone())
        .unwrap_or_else(|| root().join("data"))
        .join("30p30n");
    let files = [
        "airfoil_flap_front.dat",
        "airfoil_wing.dat",
        "airfoil_flap_rear.dat",
    ];
    let paths: Vec<PathBuf> = files.iter().map(|file| folder.join(file)).collect();
    if paths.iter().all(|path| path.is_file()) {
        let elements: Result<Vec<Outline>, _> = paths.iter().map(Outline::read).collect();
        all.push(around(
            elements.map_err(|error| error.to_string())?,
            "30P30N",
        ));
    }
    Ok(all)
}

/// How an airfoil is parsed and relaxed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    /// Solid and fluid each by a grid of its own, without the Boolean; relaxed apart.
    OwnGrids,
    /// The fluid bounded by the solid's outline, relaxed apart.
    Separate,
    /// The same, relaxed together.
    Complex,
    /// By the exact outline, relaxed together, as scenes are packed.
    Exact,
}

impl Way {
    pub(crate) const ALL: [Self; 4] = [Self::OwnGrids, Self::Separate, Self::Complex, Self::Exact];

    /// What bounds the fluid.
    pub(crate) fn boundary(self) -> &'static str {
        match self {
            Self::OwnGrids => "its own grid",
            Self::Separate | Self::Complex => "the solid's outline",
            Self::Exact => "the exact outline",
        }
    }

    pub(crate) fn relaxation(self) -> &'static str {
        match self {
            Self::OwnGrids | Self::Separate => "separate",
            Self::Complex | Self::Exact => "complex",
        }
    }
}

impl Airfoil {
    /// Its particles, and those of the fluid around it.
    pub(crate) fn relaxed(&self, way: Way) -> Result<Particles<2>, String> {
        let error = |error: &dyn std::fmt::Display| format!("{}: {error}", self.name);
        let seen = |origin: &dyn Fn(&Outline) -> [f64; 2]| -> Result<Vec<Outline>, String> {
            (self.elements.iter())
                .map(|one| parsed(one, SPACING, origin(one)).map_err(|e| error(&e)))
                .collect()
        };
        let solid = || seen(&|one| one.bounds().min);
        let fluid = || seen(&|_| self.domain.bounds.min);
        let relaxation = Relaxation {
            residual_tolerance: TOLERANCE,
            max_iterations: MOST_ITERATIONS,
            ..Relaxation::default()
        };
        let complex = Complex {
            relaxation,
            ..Complex::default()
        };
        let pack = |method: &dyn Method<2>, bodies: &[Outline]| {
            let packed = method.pack(&self.problem(bodies), &mut RunLog::new(&mut Silent));
            packed.map_err(|e| error(&e))
        };
        Ok(match way {
            Way::OwnGrids => joined(
                &pack(&relaxation, &solid()?)?,
                &pack(&relaxation, &fluid()?)?,
            ),
            Way::Separate => pack(&relaxation, &solid()?)?.particles,
            Way::Complex => pack(&complex, &solid()?)?.particles,
            Way::Exact => pack(&complex, &self.elements)?.particles,
        })
    }

    fn problem(&self, bodies: &[Outline]) -> Problem<2> {
        let mut problem = Problem::new(self.domain, SPACING);
        for (number, body) in bodies.iter().enumerate() {
            problem = problem.body(&format!("element {number}"), body.clone());
        }
        (problem.kernel, problem.h_over_spacing) = (KernelKind::WendlandC2, H_OVER_SPACING);
        problem
    }

    /// Largest h |∇Γ| of the fluid's particles, the elements' among their neighbours: the paper's sum of kernel gradients.
    pub(crate) fn fluid_residual(&self, particles: &Particles<2>) -> f64 {
        let is_fluid = |i: usize| particles.body[i].is_none() && particles.kind[i] != Kind::Frozen;
        let h = H_OVER_SPACING * SPACING;
        let fields = Fields::measure(
            &self.domain,
            &particles.position,
            &particles.volume,
            is_fluid,
            KernelKind::WendlandC2,
            h,
        );
        (0..particles.len())
            .filter(|&i| is_fluid(i))
            .map(|i| h * point::norm(fields.gradient[i]))
            .fold(0.0, f64::max)
    }
}

/// The solids of one packing in the fluid of another.
fn joined(solids: &Packed<2>, fluid: &Packed<2>) -> Particles<2> {
    let mut all = Particles::new(fluid.particles.sizes.clone());
    for (of, wants_solids) in [(&solids.particles, true), (&fluid.particles, false)] {
        for i in (0..of.len()).filter(|&i| of.body[i].is_some() == wants_solids) {
            all.push(of.position[i], of.kind[i], of.volume[i], of.body[i]);
        }
    }
    all
}

/// Holes and sums within ∆s of the surface, and of these within [`AT_EDGE`] ∆s of a trailing edge.
pub(crate) struct Figures {
    pub(crate) hole: [f64; 2],
    pub(crate) least: [f64; 2],
    pub(crate) greatest: f64,
}

impl Figures {
    pub(crate) fn of(airfoil: &Airfoil, particles: &Particles<2>) -> Self {
        let step = SPACING / FINENESS;
        let mut places: Vec<([f64; 2], bool)> = Vec::new();
        let edges: Vec<[f64; 2]> = airfoil.elements.iter().map(trailing_edge).collect();
        for element in &airfoil.elements {
            let bounds = element.bounds().grown(SPACING);
            let count = bounds.size().map(|size| (size / step) as usize);
            for n in 0..count[0] * count[1] {
                let p = [
                    bounds.min[0] + step * (n % count[0]) as f64,
                    bounds.min[1] + step * (n / count[0]) as f64,
                ];
                if element.closest_within(p, SPACING).is_some() {
                    let is_near = |edge: &[f64; 2]| point::distance(p, *edge) < AT_EDGE * SPACING;
                    places.push((p, edges.iter().any(is_near)));
                }
            }
        }
        let mut positions = particles.position.clone();
        let mut volumes = particles.volume.clone();
        positions.extend(places.iter().map(|(p, _)| *p));
        volumes.resize(positions.len(), 0.0);
        let first = particles.len();
        let fields = Fields::measure(
            &airfoil.domain,
            &positions,
            &volumes,
            |i| i >= first,
            KernelKind::Quintic,
            1.2 * SPACING,
        );
        let tree = KdTree::new(&particles.position).ok();
        let mut figures = Self {
            hole: [0.0; 2],
            least: [f64::INFINITY; 2],
            greatest: 0.0,
        };
        for (k, (p, is_at_edge)) in places.iter().enumerate() {
            let hit = tree.as_ref().and_then(|tree| tree.nearest(*p));
            let hole = hit.map_or(f64::NAN, |hit| hit.distance / SPACING);
            let gamma = fields.gamma[first + k];
            for n in 0..=usize::from(*is_at_edge) {
                figures.hole[n] = figures.hole[n].max(hole);
                figures.least[n] = figures.least[n].min(gamma);
            }
            figures.greatest = figures.greatest.max(gamma);
        }
        figures
    }
}

/// The rearmost point of an element.
pub(crate) fn trailing_edge(element: &Outline) -> [f64; 2] {
    let rearmost = element.points().iter().max_by(|a, b| a[0].total_cmp(&b[0]));
    rearmost.copied().unwrap_or_default()
}
