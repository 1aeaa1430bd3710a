//! What can be wrong with a body.
//!
//! A message says what is wrong, where, and what to do about the geometry; what else its caller may change, a spacing or
//! a line of a scene, is the caller's to add. Messages are whole: what is beneath an error is in its text, so
//! `source()` never says it again.

use std::path::{Path, PathBuf};

use crate::soup::seven_digits;

/// Why a body cannot be built or used.
///
/// Errors from files are wrapped in [`GeometryError::InFile`], which names the file.
///
/// ```
/// use sphpack_geometry::{Ball, GeometryError, InsetError, Surface};
///
/// let ball = Ball::new([0.0; 3], 1.0)?;
/// let too_deep = ball.inset(1.5).expect_err("nothing is left");
/// assert_eq!(too_deep, GeometryError::Inset(InsetError::Vanished { depth: 1.5 }));
/// # Ok::<(), GeometryError>(())
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// A shape or an operation was given a senseless number or name.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// Loops are no outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// Triangles are no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A surface cannot be moved.
    #[error(transparent)]
    Inset(#[from] InsetError),
    /// A body cannot be cut by another.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// What a file holds cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Something is wrong in a file.
    #[error("{}: {error}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: Box<Self>,
    },
}

impl GeometryError {
    /// The same error with the file's name in front.
    #[must_use]
    pub fn in_file(self, path: impl AsRef<Path>) -> Self {
        Self::InFile {
            path: path.as_ref().to_owned(),
            error: Box::new(self),
        }
    }
}

/// A senseless number or name for a shape or an operation.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterError {
    /// A number is out of range.
    #[error("{of}: {name} = {value} does not work; it must be {needs}")]
    OutOfRange {
        /// The shape or operation.
        of: &'static str,
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
}

impl ParameterError {
    /// `Ok(value)` where `value` is finite and above zero.
    pub(crate) fn check_positive(
        of: &'static str,
        name: &'static str,
        value: f64,
    ) -> Result<f64, Self> {
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(Self::OutOfRange {
            of,
            name,
            value,
            needs: "positive and finite",
        })
    }

    /// `Ok(values)` where every one is finite.
    pub(crate) fn check_finite<const D: usize>(
        of: &'static str,
        name: &'static str,
        values: [f64; D],
    ) -> Result<[f64; D], Self> {
        match values.iter().find(|x| !x.is_finite()) {
            None => Ok(values),
            Some(&value) => Err(Self::OutOfRange {
                of,
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
        Err(Self::OutOfRange {
            of: "inset",
            name: "depth",
            value: depth,
            needs: "finite and not negative",
        })
    }
}

/// A side of an outline: it runs from a point of a loop to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct LoopSide {
    /// Which loop, counted from 0.
    pub loop_index: usize,
    /// Which side within the loop, counted from 0.
    pub side: usize,
}

/// Why loops are no outline.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// A loop has fewer than three different points.
    #[error("loop {loop_index} has {count} different points; a closed outline needs at least 3")]
    TooFewPoints {
        /// Which loop, counted from 0.
        loop_index: usize,
        /// How many points are left without repeats.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is not a finite number; correct or remove it")]
    NotFinite {
        /// Which point, counted from 0 over all loops.
        index: usize,
    },
    /// A loop encloses no area.
    #[error("loop {loop_index} encloses no area; its points lie on one line, check their order")]
    NoArea {
        /// Which loop, counted from 0.
        loop_index: usize,
    },
    /// The outline crosses or touches itself, or two of its loops do.
    #[error(
        "the outline meets itself at ({}, {}): side {} of loop {} and side {} of loop {}; move or remove a point there \
         (side k runs from point k to the next, counted from 0)",
        seven_digits(place[0]), seven_digits(place[1]), first.side, first.loop_index, second.side, second.loop_index
    )]
    SelfIntersecting {
        /// A side.
        first: LoopSide,
        /// The other one.
        second: LoopSide,
        /// Where they meet, scene units.
        place: [f64; 2],
    },
    /// The loops have defects that cannot be mended unasked.
    #[error("{defects}")]
    Defective {
        /// Every kind of defect with its count, a place and the cure.
        defects: String,
    },
}

/// Why triangles are no mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A coordinate is infinite or not a number.
    #[error("{what} {index} has a coordinate that is not a finite number; correct or remove it")]
    NotFinite {
        /// What has it: `"vertex"` or `"triangle"`.
        what: &'static str,
        /// Which one, counted from 0.
        index: usize,
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
    /// The mesh is not closed.
    #[error(
        "the mesh is not closed: {open_edges} edges with one triangle (holes), {non_manifold} shared by more than two, the first near \
         ({}, {}, {}); close the holes and merge doubled vertices in a mesh editor",
        seven_digits(place[0]), seven_digits(place[1]), seven_digits(place[2])
    )]
    Open {
        /// Edges that belong to one triangle only.
        open_edges: usize,
        /// Edges that belong to more than two triangles.
        non_manifold: usize,
        /// The middle of the first such edge, scene units.
        place: [f64; 3],
    },
    /// Neighbouring triangles face opposite ways.
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
    /// There are no triangles, or they enclose no volume.
    #[error(
        "the mesh encloses no volume ({triangles} triangles left after removing degenerate ones); export a closed surface"
    )]
    NoVolume {
        /// How many triangles there are.
        triangles: usize,
    },
    /// The triangles have defects that cannot be mended unasked.
    #[error("{defects}")]
    Defective {
        /// Every kind of defect with its count, a place and the cure.
        defects: String,
    },
    /// Triangles that were to be wrapped wind around nothing.
    #[error(
        "the triangles wind around no place of a grid with cells of {cell}; take smaller cells, or make the normals consistent in a mesh editor"
    )]
    NothingInside {
        /// The size of the cells, scene units.
        cell: f64,
    },
}

/// Why a surface cannot be moved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InsetError {
    /// Nothing of the body is left when its surface is moved inward.
    #[error("nothing of the body is left {depth} inside its surface")]
    Vanished {
        /// How far the surface was moved, scene units.
        depth: f64,
    },
    /// The strips that an outline's sides sweep cross each other too often to be joined.
    #[error(
        "the outline is too ragged to be moved by {distance}: what its sides sweep crosses itself too often; leave out detail that is finer than this"
    )]
    TooTangled {
        /// How far it was to be moved, scene units.
        distance: f64,
    },
}

/// Why a body cannot be cut by another.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CutError {
    /// The lines where two meshes cross are not closed.
    #[error(
        "the lines where the two meshes cross do not come out as closed curves; move or turn one of them a little, or cut the body in a mesh editor"
    )]
    NotCut,
    /// What a cut leaves or takes is thinner in places than the finest grid's cells.
    #[error(
        "a volume of {volume} gets lost on a grid with cells of {cell}: what is cut off or left is thinner than that in places"
    )]
    LostOnGrid {
        /// Edge of the cells, scene units.
        cell: f64,
        /// The volume, scene units to the power 3.
        volume: f64,
    },
}

/// Why what a file holds cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// It cannot be opened or read.
    #[error("cannot be read ({reason})")]
    Unreadable {
        /// The operating system's reason.
        reason: String,
    },
    /// A line of a text file is not what it should be.
    #[error("line {line}: {reason}")]
    BadLine {
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
    /// The file as a whole is damaged, empty, or of no format that is read.
    #[error("{reason}")]
    BadFile {
        /// What is wrong, and the cure.
        reason: String,
    },
}

#[cfg(test)]
mod tests {
    use std::error::Error;

    use super::*;

    #[test]
    fn no_error_says_what_its_source_says_again() {
        let unreadable = ReadError::Unreadable {
            reason: "no such file".into(),
        };
        let errors: [GeometryError; 6] = [
            ParameterError::check_positive("ball", "radius", -1.0)
                .expect_err("refused")
                .into(),
            OutlineError::NoArea { loop_index: 2 }.into(),
            MeshError::NoVolume { triangles: 3 }.into(),
            InsetError::Vanished { depth: 0.5 }.into(),
            CutError::NotCut.into(),
            unreadable.into(),
        ];
        for error in errors {
            let words = error.to_string();
            let in_file = error.clone().in_file("a/b.stl");
            assert_eq!(in_file.to_string(), format!("a/b.stl: {words}"));
            for outermost in [&error, &in_file] {
                let mut said = vec![outermost.to_string()];
                let mut at = outermost.source();
                while let Some(source) = at {
                    let words = source.to_string();
                    assert!(said.iter().all(|all| !all.contains(&words)), "{words}");
                    said.push(words);
                    at = source.source();
                }
            }
        }
    }
}
