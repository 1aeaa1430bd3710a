//! The one place where two and three dimensions are told apart, and what both can do.

use std::sync::Arc;

use sphpack_geometry::{BodyFormat, Continued, GeometryError, Mesh, Outline, Similarity, Surface};
use sphpack_neighbors::Domain;
use sphpack_packing::Method;

use crate::body_file::BodyFile;
use crate::room::Room;
use crate::scene::{BodySpec, Scene, Shape};

/// Work whose dimension, 2 or 3, is known only when it runs: the one place where the two ways part.
macro_rules! in_dimension {
    ($dimension:expr, $D:ident => $work:expr) => {
        if $dimension == 2 {
            const $D: usize = 2;
            $work
        } else {
            const $D: usize = 3;
            $work
        }
    };
}
pub(crate) use in_dimension;

/// A body's surface, and its outline for pictures.
pub(crate) struct Built<const D: usize> {
    /// The true surface, placed.
    pub(crate) surface: Arc<dyn Surface<D>>,
    /// In 2-D, the closed loops to draw.
    pub(crate) loops: Vec<Vec<[f64; 2]>>,
    /// Where it is a mesh, the same one.
    pub(crate) mesh: Option<Arc<Mesh>>,
    /// Where it comes from a file, the format and the number of triangles or points in it.
    pub(crate) read: Option<(BodyFormat, usize)>,
    /// What was mended, a sentence each.
    pub(crate) repairs: Vec<String>,
    /// Whether it is what bodies of higher precedence have left of it, perhaps only in and near the box.
    pub(crate) is_cut: bool,
}

impl<const D: usize> Built<D> {
    /// A body by formula.
    pub(crate) fn new(surface: Arc<dyn Surface<D>>, loops: Vec<Vec<[f64; 2]>>) -> Self {
        Self {
            surface,
            loops,
            mesh: None,
            read: None,
            repairs: Vec::new(),
            is_cut: false,
        }
    }
}

impl Built<2> {
    /// A body by its outline.
    pub(crate) fn of_outline(outline: Outline) -> Self {
        let loops = outline.loops().map(<[_]>::to_vec).collect();
        Self::new(Arc::new(outline), loops)
    }
}

impl Built<3> {
    /// A body by its mesh.
    pub(crate) fn of_mesh(mesh: Mesh) -> Self {
        let mesh = Arc::new(mesh);
        Self {
            mesh: Some(Arc::clone(&mesh)),
            ..Self::new(mesh, Vec::new())
        }
    }
}

/// The plane or space.
pub(crate) struct Space<const D: usize>;

/// What differs between the plane and space; [`Space<2>`] and [`Space<3>`] only.
pub(crate) trait Dimension<const D: usize>: Cuttable<D> {
    /// The body's scale, rotation and translation.
    fn place(body: &BodySpec) -> Result<Similarity<D>, GeometryError>;

    /// The body's shape, placed. `file` is the shape's file as seen from the working directory.
    fn build(
        shape: &Shape,
        file: Option<&BodyFile>,
        place: &Similarity<D>,
    ) -> Result<Built<D>, GeometryError>;

    /// The scene's method.
    fn method(scene: &Scene) -> Box<dyn Method<D>>;
}

/// What a cut leaves of a body.
pub(crate) enum Left<C> {
    /// All of it: the other body has no room in it.
    All,
    /// This.
    Part(C),
    /// Nothing.
    Nothing,
}

impl<C> From<Option<C>> for Left<C> {
    fn from(cut: Option<C>) -> Self {
        cut.map_or(Self::Nothing, Self::Part)
    }
}

/// How bodies are cut, in the plane and in space.
pub(crate) trait Cuttable<const D: usize> {
    /// What is left of a body that was cut.
    type Cut: Surface<D> + Clone + 'static;
    /// A body that can be cut, and can cut.
    type Operand;

    /// The body as such. Circles and ellipses become outlines within 10⁻⁷ of their size, boxes meshes.
    fn operand(body: &BodySpec, built: &Built<D>) -> Result<Self::Operand, GeometryError>;

    /// What was cut before, to be cut again.
    fn again(cut: Self::Cut) -> Self::Operand;

    /// What is left of `lower`; of bodies cut on a grid, only what is in the `room`.
    ///
    /// Exact in the plane, and in space where both are meshes or boxes; what is thinner than 10⁻⁶ of the body does not count
    /// there, neither as an overlap nor as a piece, nor what is deeper nowhere than 10⁻⁶ ∆s in space. Other bodies in space are cut on a grid with
    /// cells of ∆s/4, finer where slices would be lost, and come out as meshes: within some ∆s²/128R of a surface that bends by radius R, with sharp edges
    /// where the two meet. Of a ball of R = 5 ∆s cut by another of 4 ∆s the volume is then off by less than 0.05 %.
    fn minus(
        lower: &Self::Operand,
        higher: &Self::Operand,
        spacing: f64,
        room: &Room<D>,
    ) -> Result<Left<Self::Cut>, GeometryError>;

    /// The body again.
    fn rebuilt(cut: Self::Cut) -> Built<D>;

    /// The body as it goes on beyond the sides of a box; `None` where it does not. Bodies by formula become outlines and meshes
    /// first, as for a cut; cylinders, prisms of the same volume within 10⁻⁴ ∆s.
    fn continued(
        body: &BodySpec,
        built: &Built<D>,
        domain: &Domain<D>,
        spacing: f64,
    ) -> Result<Option<Continued<D>>, GeometryError>;
}
