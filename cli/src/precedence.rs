//! Which of two solid bodies that overlap keeps the common part: what is left of the other.

use std::sync::Arc;

use sphpack_geometry::{GeometryError, LevelSet, Mesh, Outline, Surface};

use crate::Error;
use crate::dimension::{Built, Dimension, Space, array};
use crate::overlap;
use crate::scene::{BodySpec, Role, Scene, Shape};

/// Cells per ∆s of the grid on which bodies are cut that are not meshes.
const CELLS_PER_SPACING: f64 = 4.0;

/// How bodies are cut, in the plane and in space.
pub(crate) trait Cuttable<const D: usize> {
    /// What is left of a body that was cut.
    type Cut: Surface<D> + 'static;
    /// A body that can be cut, and can cut.
    type Operand;

    /// The body as such. Circles and ellipses become outlines within 10⁻⁷ of their size, boxes meshes.
    fn operand(body: &BodySpec, built: &Built<D>) -> Result<Self::Operand, GeometryError>;

    /// What was cut before, to be cut again.
    fn again(cut: Self::Cut) -> Self::Operand;

    /// What is left of `lower`, if anything.
    ///
    /// Exact in the plane, and in space where both are meshes or boxes. Other bodies in space are cut on a grid with
    /// cells of ∆s/4 and come out as meshes: within some ∆s²/128R of a surface that bends by radius R, with sharp edges
    /// where the two meet. Of a ball of R = 5 ∆s cut by another of 4 ∆s the volume is then off by less than 0.05 %.
    fn minus(
        lower: &Self::Operand,
        higher: &Self::Operand,
        spacing: f64,
    ) -> Result<Option<Self::Cut>, GeometryError>;

    /// The body again.
    fn rebuilt(cut: Self::Cut) -> Built<D>;
}

impl Cuttable<2> for Space<2> {
    type Cut = Outline;
    type Operand = Outline;

    fn operand(body: &BodySpec, built: &Built<2>) -> Result<Outline, GeometryError> {
        let ellipse = match &body.shape {
            Shape::Circle { center, radius } => (array(center), [*radius; 2]),
            Shape::Ellipse { center, semi_axes } => (array(center), array(semi_axes)),
            // Their loops are all there is of them.
            _ => return Outline::new(built.loops.clone()),
        };
        let place = Self::place(body)?;
        Ok(Outline::ellipse(ellipse.0, ellipse.1)?.transformed(&place))
    }

    fn again(cut: Outline) -> Outline {
        cut
    }

    fn minus(lower: &Outline, higher: &Outline, _: f64) -> Result<Option<Outline>, GeometryError> {
        Ok(lower.minus(higher))
    }

    fn rebuilt(cut: Outline) -> Built<2> {
        Built::of_outline(cut)
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
        let (place, ends) = (Self::place(body)?, [min, max]);
        let corner = |bits: usize| {
            place.point(std::array::from_fn(|k| {
                ends[bits >> k & 1].get(k).copied().unwrap_or(0.0)
            }))
        };
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
        let mesh = Mesh::new((0..8).map(corner).collect(), triangles.collect())?;
        Ok(Solid::Mesh(Arc::new(mesh)))
    }

    fn again(cut: Mesh) -> Solid {
        Solid::Mesh(Arc::new(cut))
    }

    fn minus(lower: &Solid, higher: &Solid, spacing: f64) -> Result<Option<Mesh>, GeometryError> {
        if let (Solid::Mesh(lower), Solid::Mesh(higher)) = (lower, higher) {
            return lower.minus(higher);
        }
        let set = |body: &Solid| {
            let surface = match body {
                Solid::Mesh(mesh) => Arc::clone(mesh) as Arc<dyn Surface<3>>,
                Solid::Smooth(surface) => Arc::clone(surface),
            };
            LevelSet::of(surface, spacing / CELLS_PER_SPACING)
        };
        set(lower)?.minus(&set(higher)?)?.mesh()
    }

    fn rebuilt(cut: Mesh) -> Built<3> {
        Built::of_mesh(cut)
    }
}

/// Cuts from every solid body what overlaps it and has a higher precedence. Bodies that touch, by the measure of
/// [`overlap::between`], stay as they are.
pub(crate) fn settle<const D: usize>(scene: &Scene, all: &mut [Built<D>]) -> Result<(), Error>
where
    Space<D>: Dimension<D>,
{
    let solid = |i: usize| scene.body[i].role == Role::Solid;
    let mut cuts = Vec::new();
    for i in (0..all.len()).filter(|&i| solid(i)) {
        let mut left = None;
        for j in (0..all.len()).filter(|&j| solid(j)) {
            if scene.body[j].precedence <= scene.body[i].precedence {
                continue;
            }
            let higher = all[j].surface.as_ref();
            let overlap = match &left {
                None => overlap::between(all[i].surface.as_ref(), higher, scene.spacing),
                Some(left) => overlap::between(left, higher, scene.spacing),
            };
            if overlap.is_some() {
                left = Some(cut(scene, all, left, [i, j])?);
            }
        }
        cuts.extend(left.map(|left| (i, left)));
    }
    // Every body is cut by the others as they were: who cuts the one that cuts cuts the lower one too.
    for (i, left) in cuts {
        let built = &mut all[i];
        *built = Built {
            read: built.read,
            repairs: std::mem::take(&mut built.repairs),
            ..Space::<D>::rebuilt(left)
        };
    }
    Ok(())
}

type Cut<const D: usize> = <Space<D> as Cuttable<D>>::Cut;

/// Body `lower`, or what is `left` of it, without the room of body `higher`.
fn cut<const D: usize>(
    scene: &Scene,
    all: &[Built<D>],
    left: Option<Cut<D>>,
    [lower, higher]: [usize; 2],
) -> Result<Cut<D>, Error>
where
    Space<D>: Dimension<D>,
{
    let [a, b] = [lower, higher].map(|k| &scene.body[k].name);
    let fail = |message: String| Error::Scene {
        path: scene.path.clone(),
        at: None,
        message,
    };
    let operand = |k: usize| Space::<D>::operand(&scene.body[k], &all[k]);
    let done = || {
        let body = match left {
            Some(left) => Space::<D>::again(left),
            None => operand(lower)?,
        };
        Space::<D>::minus(&body, &operand(higher)?, scene.spacing)
    };
    done()
        .map_err(|e: GeometryError| fail(format!("body \"{b}\" cannot be cut from \"{a}\": {e}")))?
        .ok_or_else(|| {
            fail(format!(
                "nothing is left of body \"{a}\": \"{b}\", whose precedence is higher, has all its room; leave it out, or raise its precedence"
            ))
        })
}
