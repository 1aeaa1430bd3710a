//! What can be wrong with a body.

use crate::soup::seven_digits;

/// Why a body cannot be built or used. Every message says what is wrong, where, and what to do about it.
///
/// Errors from files are wrapped in [`GeometryError::InFile`], which names the file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// Nothing of the body is left when its surface is moved inward.
    #[error(
        "nothing of the body is left {depth} inside its surface; use a smaller spacing, or surface = \"exact\""
    )]
    Vanished {
        /// How far the surface was moved, scene units.
        depth: f64,
    },
    /// What a cut leaves or takes is thinner in places than the finest grid's cells.
    #[error(
        "a volume of {volume} gets lost on a grid with cells of {cell}: what is cut off or left is thinner than that in places; move the bodies so that one passes the other's surface or stays well within it, use a smaller spacing, or give both as meshes, which are cut exactly"
    )]
    LostOnGrid {
        /// Edge of the cells, scene units.
        cell: f64,
        /// The volume, scene units to the power 3.
        volume: f64,
    },
    /// The strips that an outline's sides sweep cross each other too often to be joined.
    #[error(
        "the outline is too ragged to be moved by {distance}: what its sides sweep crosses itself too often; leave out detail that is finer than this, or use a smaller spacing, or surface = \"exact\""
    )]
    TooTangled {
        /// How far it was to be moved, scene units.
        distance: f64,
    },
    /// A parameter of a shape or of an operation is out of range.
    #[error("{shape}: {name} = {value} does not work; it must be {needs}")]
    BadParameter {
        /// The shape or operation.
        shape: &'static str,
        /// The parameter's name.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// What it must be.
        needs: &'static str,
    },
    /// An airfoil's name is not one of the NACA series of four and five digits.
    #[error(
        "\"{digits}\" is no NACA airfoil of four or five digits; write four such as \"0015\" or \"2412\", the last two (thickness) above 00, \
         the second above 0 where the first is, or five such as \"23012\" or \"23112\" (the second 1 to 5, the third 0 or 1); \
         \"0012-64\" has a modified thickness (nose 0 to 9, place 2 to 6)"
    )]
    BadNaca {
        /// What was given.
        digits: String,
    },
    /// A loop of an outline has fewer than three different points.
    #[error("loop {loop_index} has {count} different points; a closed outline needs at least 3")]
    TooFewPoints {
        /// Which loop, counted from 0.
        loop_index: usize,
        /// How many points are left without repeats.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("{what} {index} has a coordinate that is not a finite number; correct or remove it")]
    NotFinite {
        /// What kind of thing it is: `"point"`, `"vertex"`, `"triangle"`.
        what: &'static str,
        /// Which one, counted from 0.
        index: usize,
    },
    /// A loop of an outline encloses no area.
    #[error("loop {loop_index} encloses no area; its points lie on one line, check their order")]
    NoArea {
        /// Which loop, counted from 0.
        loop_index: usize,
    },
    /// An outline crosses or touches itself, or two of its loops do.
    #[error(
        "the outline meets itself at ({}, {}): side {} of loop {} and side {} of loop {}; move or remove a point there \
         (side k runs from point k to the next, counted from 0)",
        seven_digits(place[0]), seven_digits(place[1]), first.1, first.0, second.1, second.0
    )]
    SelfIntersecting {
        /// Loop and side within the loop, counted from 0.
        first: (usize, usize),
        /// The other loop and side.
        second: (usize, usize),
        /// Where they meet, scene units.
        place: [f64; 2],
    },
    /// Something is wrong in a file; `source` says what.
    #[error("{path}: {source}")]
    InFile {
        /// The file.
        path: String,
        /// What is wrong.
        source: Box<Self>,
    },
    /// A file cannot be opened or read.
    #[error("cannot be read ({reason}); check the path and the permissions")]
    Unreadable {
        /// The operating system's reason.
        reason: String,
    },
    /// A line of a text file is not what it should be.
    #[error("line {line}: {reason}")]
    BadRow {
        /// Counted from 1.
        line: usize,
        /// What is wrong, and the cure.
        reason: String,
    },
    /// Something in a binary file is not what it should be.
    #[error("byte {offset}: {reason}")]
    BadByte {
        /// Counted from 0.
        offset: usize,
        /// What is wrong, and the cure.
        reason: String,
    },
    /// A file as a whole is damaged, empty, or of no format that is read.
    #[error("{reason}")]
    BadFile {
        /// What is wrong, and the cure.
        reason: String,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error(
        "triangle {triangle} refers to vertex {vertex}, but there are only {vertices}; indices count from 0"
    )]
    BadIndex {
        /// Which triangle, counted from 0.
        triangle: usize,
        /// The index it holds.
        vertex: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A mesh is not closed.
    #[error(
        "the mesh is not closed: {open_edges} edges with one triangle (holes), {non_manifold} shared by more than two, the first near \
         ({}, {}, {}); close the holes and merge doubled vertices in a mesh editor",
        seven_digits(place[0]), seven_digits(place[1]), seven_digits(place[2])
    )]
    OpenMesh {
        /// Edges that belong to one triangle only.
        open_edges: usize,
        /// Edges that belong to more than two triangles.
        non_manifold: usize,
        /// The middle of the first such edge, scene units.
        place: [f64; 3],
    },
    /// Neighbouring triangles of a mesh face opposite ways.
    #[error(
        "neighbouring triangles face opposite ways at {edges} edges, the first near ({}, {}, {}); make the normals consistent in a mesh editor",
        seven_digits(place[0]), seven_digits(place[1]), seven_digits(place[2])
    )]
    InconsistentFacing {
        /// How many edges have two triangles that run along them the same way.
        edges: usize,
        /// The middle of the first such edge, scene units.
        place: [f64; 3],
    },
    /// A mesh has defects that cannot be mended unasked.
    #[error("{defects}")]
    Defective {
        /// Every kind of defect with its count, a place and the cure.
        defects: String,
    },
    /// A mesh cannot be cut by another.
    #[error(
        "the lines where the two meshes cross do not come out as closed curves; move or turn one of them a little, or cut the body in a mesh editor"
    )]
    NotCut,
    /// Triangles that were to be wrapped wind around nothing.
    #[error(
        "the triangles wind around no place of a grid with cells of {cell}; take smaller cells, or make the normals consistent in a mesh editor"
    )]
    NothingInside {
        /// The size of the cells, scene units.
        cell: f64,
    },
    /// A mesh has no triangles, or encloses no volume.
    #[error(
        "the mesh encloses no volume ({triangles} triangles left after removing degenerate ones); export a closed surface"
    )]
    NoVolume {
        /// How many triangles it has.
        triangles: usize,
    },
}

impl GeometryError {
    /// The same error with the file's name in front.
    #[must_use]
    pub fn in_file(self, path: impl AsRef<std::path::Path>) -> Self {
        Self::InFile {
            path: path.as_ref().display().to_string(),
            source: Box::new(self),
        }
    }

    /// `Ok(value)` where `value` is finite and above zero.
    pub(crate) fn check_positive(
        shape: &'static str,
        name: &'static str,
        value: f64,
    ) -> Result<f64, Self> {
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(Self::BadParameter {
            shape,
            name,
            value,
            needs: "positive and finite",
        })
    }

    /// `Ok(values)` where every one is finite.
    pub(crate) fn check_finite<const D: usize>(
        shape: &'static str,
        name: &'static str,
        values: [f64; D],
    ) -> Result<[f64; D], Self> {
        match values.iter().find(|x| !x.is_finite()) {
            None => Ok(values),
            Some(&value) => Err(Self::BadParameter {
                shape,
                name,
                value,
                needs: "finite",
            }),
        }
    }

    /// `Ok(depth)` where `depth` is finite and not negative.
    pub(crate) fn check_depth(depth: f64) -> Result<f64, Self> {
        if depth >= 0.0 && depth.is_finite() {
            return Ok(depth);
        }
        Err(Self::BadParameter {
            shape: "inset",
            name: "depth",
            value: depth,
            needs: "finite and not negative",
        })
    }
}
