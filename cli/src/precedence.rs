//! Which of two bodies that overlap keeps the common part: what is left of the other.

use std::sync::Arc;

use sphpack_geometry::{
    Continued, Cylinder, GeometryError, LevelSet, Mesh, Outline, Surface, cut_on_grid,
};
use sphpack_neighbors::{Domain, point};

use crate::Error;
use crate::dimension::{Built, Cuttable, Dimension, Left, Space};
use crate::error::cured;
use crate::overlap;
use crate::room::Room;
use crate::scene::{BodySpec, Role, Scene, Shape};

/// Cells per ∆s of the grid on which bodies are cut that are not meshes.
const CELLS_PER_SPACING: f64 = 4.0;

/// Pieces that a cut leaves with less room than this, in ∆s², are dropped: a particle's volume is ∆s².
const CRUMB: f64 = 1e-3;

/// Meshes that are nowhere deeper in each other than this, in ∆s, touch.
const TOUCHING_MESHES: f64 = 1e-6;

/// Where a mesh that touches is cut, faces in one plane are moved by some of this, in parts of its size.
const MOVED: f64 = 1e-5;

/// Bodies by formula that are nowhere deeper in each other than this, in ∆s, stay as they are: of a ball of R = 5 ∆s the
/// grid's own error is 0.05 %, a cap of that depth 2 × 10⁻⁶.
const TOUCHING_ON_GRID: f64 = 1e-2;

/// Room that a cut on a grid may lose, in ∆s³: a fifth of what a body may be off by.
const LOST_ON_GRID: f64 = 0.1;

/// What is left and what cut it may be so deep in each other, in ∆s: half of what is refused. Around a rod of
/// R = 0.57 ∆s cells of ∆s/4 leave 0.12.
const IN_EACH_OTHER: f64 = 0.5 * overlap::TOUCHING_OVER_SPACING;

/// How often cells are halved for that.
const HALVINGS: usize = 2;

/// How far the sides of a prism that stands for a cylinder are from it, in ∆s.
const ROUND_WITHIN: f64 = 1e-4;

/// The largest cylinder that a prism stands for, in ∆s: its 720 sides are then within 10⁻³ ∆s. A level set of what the
/// box holds of a larger one is nearer.
const PRISM_RADIUS: f64 = 100.0;

impl Cuttable<2> for Space<2> {
    type Cut = Outline;
    type Operand = Outline;

    fn operand(body: &BodySpec, built: &Built<2>) -> Result<Outline, GeometryError> {
        let ellipse = match &body.shape {
            // What others have left of it.
            _ if built.is_cut => return Outline::new(built.loops.clone()),
            Shape::Circle { center, radius } => (point::of_slice(center), [*radius; 2]),
            Shape::Ellipse { center, semi_axes } => {
                (point::of_slice(center), point::of_slice(semi_axes))
            }
            // Their loops are all there is of them.
            _ => return Outline::new(built.loops.clone()),
        };
        let place = Self::place(body)?;
        Ok(Outline::ellipse(ellipse.0, ellipse.1)?.transformed(&place))
    }

    fn again(cut: Outline) -> Outline {
        cut
    }

    fn minus(
        lower: &Outline,
        higher: &Outline,
        spacing: f64,
        _: &Room<2>,
    ) -> Result<Left<Outline>, GeometryError> {
        if lower.intersection(higher).is_none() {
            return Ok(Left::All);
        }
        let left = lower.minus(higher);
        let crumb = CRUMB * spacing * spacing;
        Ok(left.and_then(|left| left.without_crumbs(crumb)).into())
    }

    fn rebuilt(cut: Outline) -> Built<2> {
        Built::of_outline(cut)
    }

    fn continued(
        body: &BodySpec,
        built: &Built<2>,
        domain: &Domain<2>,
        _: f64,
    ) -> Result<Option<Continued<2>>, GeometryError> {
        Ok(Self::operand(body, built)?.continued(domain))
    }
}

/// A body in space that takes part in a cut.
#[derive(Debug)]
pub(crate) enum Solid {
    /// A mesh or a box.
    Mesh(Arc<Mesh>),
    /// A body by formula.
    Smooth(Arc<dyn Surface<3>>),
}

/// The box whose corner at the upper end along axis k, where bit k is set, is `corner(bits)`.
fn hexahedron(corner: impl Fn(usize) -> [f64; 3]) -> Result<Mesh, GeometryError> {
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = sides
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh::new((0..8).map(corner).collect(), triangles.collect())
}

impl Solid {
    fn surface(&self) -> &dyn Surface<3> {
        match self {
            Self::Mesh(mesh) => mesh.as_ref(),
            Self::Smooth(surface) => surface.as_ref(),
        }
    }

    fn shared(&self) -> Arc<dyn Surface<3>> {
        match self {
            Self::Mesh(mesh) => Arc::clone(mesh) as Arc<dyn Surface<3>>,
            Self::Smooth(surface) => Arc::clone(surface),
        }
    }
}

impl Cuttable<3> for Space<3> {
    type Cut = Mesh;
    type Operand = Solid;

    fn operand(body: &BodySpec, built: &Built<3>) -> Result<Solid, GeometryError> {
        if let Some(mesh) = &built.mesh {
            return Ok(Solid::Mesh(Arc::clone(mesh)));
        }
        let Shape::Box { min, max } = &body.shape else {
            return Ok(Solid::Smooth(Arc::clone(&built.surface)));
        };
        let place = Self::place(body)?;
        let ends: [[f64; 3]; 2] = [min, max].map(|end| point::of_slice(end));
        let corner = |bits: usize| place.point(std::array::from_fn(|k| ends[bits >> k & 1][k]));
        let mesh = hexahedron(corner)?;
        Ok(Solid::Mesh(Arc::new(mesh)))
    }

    fn again(cut: Mesh) -> Solid {
        Solid::Mesh(Arc::new(cut))
    }

    fn minus(
        lower: &Solid,
        higher: &Solid,
        spacing: f64,
        room: &Room<3>,
    ) -> Result<Left<Mesh>, GeometryError> {
        let overlaps = |depth: f64| {
            overlap::deeper_than(depth, lower.surface(), higher.surface(), spacing).is_some()
        };
        if let (Solid::Mesh(lower), Solid::Mesh(higher)) = (lower, higher) {
            let left = lower.minus(higher);
            if overlaps(TOUCHING_MESHES) {
                return Ok(left?.into());
            }
            // A corner may be deeper than any place that was looked at.
            let least = MOVED * lower.bounds().diagonal() * lower.measure().min(higher.measure());
            return Ok(match left {
                Ok(Some(left)) if lower.volume() - left.volume() > least => Left::Part(left),
                _ => Left::All,
            });
        }
        let [from, by] = [lower, higher].map(|body| body.surface().bounds());
        if from.intersection(by).intersection(room.bounds).is_empty() || !overlaps(TOUCHING_ON_GRID)
        {
            return Ok(Left::All);
        }
        let mut cell = spacing / CELLS_PER_SPACING;
        let lost = LOST_ON_GRID * spacing.powi(3);
        let window = from.grown(spacing).intersection(room.bounds);
        let at = |cell: f64| cut_on_grid(lower.shared(), higher.shared(), cell, lost, &window);
        let mut left = at(cell)?;
        for _ in 0..HALVINGS {
            let overlaps = |left: &Mesh| {
                overlap::deeper_than(IN_EACH_OTHER, left, higher.surface(), spacing).is_some()
            };
            if !left.as_ref().is_some_and(overlaps) {
                break;
            }
            cell *= 0.5;
            match at(cell) {
                Ok(finer) => left = finer,
                // Finer cells may be too many.
                Err(_) => break,
            }
        }
        let left = left.map(|left| room.carry_on(left));
        Ok(left.transpose()?.into())
    }

    fn rebuilt(cut: Mesh) -> Built<3> {
        Built::of_mesh(cut)
    }

    fn continued(
        body: &BodySpec,
        built: &Built<3>,
        domain: &Domain<3>,
        spacing: f64,
    ) -> Result<Option<Continued<3>>, GeometryError> {
        if let (Shape::Cylinder { start, end, radius }, None) = (&body.shape, &built.mesh) {
            let place = Self::place(body)?;
            let radius = radius * place.scale();
            if radius <= PRISM_RADIUS * spacing {
                let [start, end] = [start, end].map(|p| place.point(point::of_slice(p)));
                let rod = Cylinder::new(start, end, radius)?;
                return rod.mesh(ROUND_WITHIN * spacing)?.continued(domain);
            }
        }
        match Self::operand(body, built)? {
            Solid::Mesh(mesh) => mesh.continued(domain),
            Solid::Smooth(surface) => {
                let cell = spacing / CELLS_PER_SPACING;
                let around = surface.bounds().grown(spacing);
                let room = Room::around(domain, spacing);
                let window = around.intersection(room.bounds);
                if window.is_empty() {
                    return Ok(None);
                }
                match LevelSet::within(surface, cell, &window)?.mesh()? {
                    Some(mesh) => room.carry_on(mesh)?.continued(domain),
                    None => Ok(None),
                }
            }
        }
    }
}

/// Cuts from every solid body what overlaps it, solid or void, and has a higher precedence. A body from which nothing is taken
/// stays as it is.
pub(crate) fn settle<const D: usize>(scene: &Scene, all: &mut [Built<D>]) -> Result<(), Error>
where
    Space<D>: Dimension<D>,
{
    let solid = |i: usize| scene.body[i].role == Role::Solid;
    let room = Room::of(scene);
    let mut cuts = Vec::new();
    for i in (0..all.len()).filter(|&i| solid(i)) {
        let mut left = None;
        for j in (0..all.len()).filter(|&j| scene.body[j].role != Role::Container) {
            if scene.body[j].precedence > scene.body[i].precedence {
                left = cut(scene, all, left, [i, j], &room)?;
            }
        }
        cuts.extend(left.map(|left| (i, Space::<D>::rebuilt(left))));
    }
    // Every body is cut by the others as they were: who cuts the one that cuts cuts the lower one too.
    for (i, left) in cuts {
        let built = &mut all[i];
        *built = Built {
            read: built.read,
            repairs: std::mem::take(&mut built.repairs),
            is_cut: true,
            ..left
        };
    }
    Ok(())
}

type Cut<const D: usize> = <Space<D> as Cuttable<D>>::Cut;

/// Body `lower`, or what is `left` of it, without the room of body `higher`; `None` where nothing has been taken yet.
fn cut<const D: usize>(
    scene: &Scene,
    all: &[Built<D>],
    left: Option<Cut<D>>,
    [lower, higher]: [usize; 2],
    room: &Room<D>,
) -> Result<Option<Cut<D>>, Error>
where
    Space<D>: Dimension<D>,
{
    let surface = |k: usize| all[k].surface.as_ref();
    let may_overlap = match &left {
        Some(left) => overlap::may_overlap(left, surface(higher)),
        None => overlap::may_overlap(surface(lower), surface(higher)),
    };
    if !may_overlap {
        return Ok(left);
    }
    let [a, b] = [lower, higher].map(|k| &scene.body[k].name);
    let fail = |message: String| Error::Scene {
        path: scene.path.clone(),
        at: None,
        message,
    };
    let operand = |k: usize| Space::<D>::operand(&scene.body[k], &all[k]);
    let done = || {
        let body = match &left {
            Some(left) => Space::<D>::again(left.clone()),
            None => operand(lower)?,
        };
        Space::<D>::minus(&body, &operand(higher)?, scene.spacing, room)
    };
    match done() {
        Ok(Left::All) => Ok(left),
        Ok(Left::Part(part)) => Ok(Some(part)),
        Ok(Left::Nothing) => Err(fail(format!(
            "nothing is left of body \"{a}\": \"{b}\", whose precedence is higher, has all its room; leave it out, or raise its precedence"
        ))),
        Err(error) => Err(fail(format!(
            "body \"{b}\" cannot be cut from \"{a}\": {}",
            cured(&error)
        ))),
    }
}

#[cfg(test)]
mod tests;
