//! Which of two solid bodies that overlap keeps the common part: what is left of the other.

use sphpack_geometry::{GeometryError, Mesh, Outline, Surface};

use crate::Error;
use crate::dimension::{Built, Dimension, Space, array};
use crate::overlap;
use crate::scene::{BodySpec, Role, Scene, Shape};

/// How bodies are cut, in the plane and in space.
pub(crate) trait Cuttable<const D: usize> {
    /// A body that can be cut, and can cut.
    type Cut: Surface<D> + 'static;

    /// The body as such; `None` where it is of a shape that cannot be cut. Circles and ellipses become outlines within
    /// 10⁻⁷ of their size.
    fn cuttable(body: &BodySpec, built: &Built<D>) -> Result<Option<Self::Cut>, GeometryError>;

    /// What is left of `lower`, if anything.
    fn minus(lower: &Self::Cut, higher: &Self::Cut) -> Result<Option<Self::Cut>, GeometryError>;

    /// The body again.
    fn rebuilt(cut: Self::Cut) -> Built<D>;
}

impl Cuttable<2> for Space<2> {
    type Cut = Outline;

    fn cuttable(body: &BodySpec, built: &Built<2>) -> Result<Option<Outline>, GeometryError> {
        let ellipse = match &body.shape {
            Shape::Circle { center, radius } => (array(center), [*radius; 2]),
            Shape::Ellipse { center, semi_axes } => (array(center), array(semi_axes)),
            // Their loops are all there is of them.
            _ => return Outline::new(built.loops.clone()).map(Some),
        };
        let place = Self::place(body)?;
        Ok(Some(
            Outline::ellipse(ellipse.0, ellipse.1)?.transformed(&place),
        ))
    }

    fn minus(lower: &Outline, higher: &Outline) -> Result<Option<Outline>, GeometryError> {
        Ok(lower.minus(higher))
    }

    fn rebuilt(cut: Outline) -> Built<2> {
        Built::of_outline(cut)
    }
}

impl Cuttable<3> for Space<3> {
    type Cut = Mesh;

    fn cuttable(body: &BodySpec, built: &Built<3>) -> Result<Option<Mesh>, GeometryError> {
        if let Some(mesh) = &built.mesh {
            return Ok(Some(Mesh::clone(mesh)));
        }
        let Shape::Box { min, max } = &body.shape else {
            return Ok(None);
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
        Mesh::new((0..8).map(corner).collect(), triangles.collect()).map(Some)
    }

    fn minus(lower: &Mesh, higher: &Mesh) -> Result<Option<Mesh>, GeometryError> {
        lower.minus(higher)
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
    let failed = |e: GeometryError| fail(format!("body \"{b}\" cannot be cut from \"{a}\": {e}"));
    let cuttable = |k: usize| {
        let body = &scene.body[k];
        Space::<D>::cuttable(body, &all[k]).map_err(failed)?.ok_or_else(|| {
            let shape = body.shape.name();
            fail(format!(
                "bodies \"{a}\" and \"{b}\" overlap, and precedence needs meshes (or boxes) in 3-D; \"{}\" is a {shape}: export it as STL, or move one",
                body.name
            ))
        })
    };
    let body = match left {
        Some(left) => left,
        None => cuttable(lower)?,
    };
    Space::<D>::minus(&body, &cuttable(higher)?)
        .map_err(failed)?
        .ok_or_else(|| {
            fail(format!(
                "nothing is left of body \"{a}\": \"{b}\", whose precedence is higher, has all its room; leave it out, or raise its precedence"
            ))
        })
}
