//! Mending what can safely be mended, and saying what was done.

use std::f64::consts::PI;
use std::fmt;

use sphpack_neighbors::point;

use super::check::{self, Survey};
use super::report::{MeshReport, Place, ShellRole, four_digits};
use super::{Soup, doubles, facing, holes, is_degenerate};
use crate::mesh::topology;

/// Which holes are closed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum HoleLimit {
    /// Those that cannot matter: half a ball over each of them, the smallest first, has less than 1 % of the body's
    /// volume in all.
    #[default]
    Small,
    /// Those up to so far across, scene units.
    Across(f64),
}

/// The part of the body's volume that half balls over the holes may have.
const SMALL_HOLES: f64 = 0.01;

/// Something that was done to a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Repair {
    /// Vertices were taken together with others within 10⁻⁶ of the mesh's size.
    Welded(usize),
    /// Triangles that used a vertex twice were left out.
    DroppedDegenerate(usize),
    /// Triangles that were there already were left out.
    DroppedDuplicates(usize),
    /// Walls between two bodies were left out: triangles that were there in both directions.
    DroppedWalls(usize),
    /// Triangles faced the other way than their neighbours and were turned.
    Turned {
        /// How many.
        triangles: usize,
        /// How many there are.
        of: usize,
    },
    /// Shells faced the wrong way and were turned inside out.
    TurnedShells {
        /// How many.
        shells: usize,
        /// How many closed ones there are.
        of: usize,
    },
    /// Edges that met corners of their neighbours in the middle were cut there: cracks of no width.
    ClosedCracks(usize),
    /// Faces that lay on each other and looked at each other were left out, as far as they did; so many walls.
    DroppedFlush(usize),
    /// Edges at which wedges of the body touch, of four triangles or more, were parted into edges of two.
    Parted(usize),
    /// Holes were closed.
    Filled {
        /// How many.
        holes: usize,
        /// With how many triangles.
        triangles: usize,
        /// How large the largest was across, scene units.
        largest: f64,
        /// Where that was.
        place: [f64; 3],
    },
    /// Shells that overlapped or touched were joined: what of them was inside is gone.
    Joined {
        /// How many shells there were.
        shells: usize,
        /// How much volume they had in common, that is, was there twice.
        shared_volume: f64,
    },
    /// Crossings of triangles within a shell were left; they are too small to matter.
    LeftCrossings {
        /// How many pairs.
        pairs: usize,
        /// The first.
        place: [f64; 3],
    },
    /// Shells that touch along edges or in points were left as they are.
    LeftContacts(usize),
    /// The triangles were wrapped by [`Soup::wrapped`].
    Wrapped {
        /// The size of the grid's cells, scene units.
        cell: f64,
        /// How many triangles there were.
        triangles: usize,
    },
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Welded(n) => write!(f, "{n} vertices were welded to others very near them"),
            Self::DroppedDegenerate(n) => {
                write!(f, "{n} triangles that used a vertex twice were left out")
            }
            Self::DroppedDuplicates(n) => {
                write!(f, "{n} triangles that were there already were left out")
            }
            Self::DroppedWalls(n) => write!(
                f,
                "{n} triangles of inner walls, there in both directions, were left out with their doubles"
            ),
            Self::Turned { triangles, of } => write!(
                f,
                "{triangles} of {of} triangles faced the other way than their neighbours and were turned"
            ),
            Self::TurnedShells { shells: 1, of: 1 } => {
                write!(f, "the body was inside out: all its triangles were turned")
            }
            Self::TurnedShells { shells, of } => write!(
                f,
                "{shells} of {of} shells were inside out: all their triangles were turned"
            ),
            Self::ClosedCracks(n) => write!(
                f,
                "{n} open {} of no width {} closed",
                if n == 1 { "crack" } else { "cracks" },
                if n == 1 { "was" } else { "were" }
            ),
            Self::DroppedFlush(n) => write!(
                f,
                "{n} {} of no thickness, where faces lay on each other, {} left out",
                if n == 1 { "wall" } else { "walls" },
                if n == 1 { "was" } else { "were" }
            ),
            Self::Parted(n) => write!(
                f,
                "{n} {} of four triangles or more, where the body touches itself, {} parted into edges of two",
                if n == 1 { "edge" } else { "edges" },
                if n == 1 { "was" } else { "were" }
            ),
            Self::Filled {
                holes,
                triangles,
                largest,
                place,
            } => write!(
                f,
                "{holes} {} closed with {triangles} triangles, the largest {} across near {}",
                if holes == 1 { "hole was" } else { "holes were" },
                four_digits(largest),
                Place(place)
            ),
            Self::Joined {
                shells,
                shared_volume,
            } => write!(
                f,
                "{shells} shells that overlapped or touched were joined into one body; the volume of {} that was there more than once counts once",
                four_digits(shared_volume)
            ),
            Self::LeftCrossings { pairs, place } => write!(
                f,
                "{pairs} pairs of triangles cross within a shell, the first near {}; they are few and were left",
                Place(place)
            ),
            Self::LeftContacts(n) => {
                write!(
                    f,
                    "{n} pairs of shells touch along edges or in points; they stay apart"
                )
            }
            Self::Wrapped { cell, triangles } => write!(
                f,
                "{triangles} triangles were wrapped in a new mesh on a grid with cells of {}; parts and gaps thinner than that may be lost",
                four_digits(cell)
            ),
        }
    }
}

/// A mesh after mending, and what was done to it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Repaired {
    /// The mended triangles.
    pub soup: Soup,
    /// What was done, in this order.
    pub done: Vec<Repair>,
    /// What is left to find wrong.
    pub report: MeshReport,
}

impl Soup {
    /// Mends what can safely be mended: vertices that are nearly equal are welded, degenerate and doubled triangles
    /// left out, triangles turned so that all agree, cracks of no width closed, walls between faces that lie on each other left out, edges at which wedges of the body touch parted, and shells so that bodies face outward and cavities inward,
    /// holes within `limit` closed by the triangles of least area over their rims. Shells that overlap stay as they
    /// are: [`Soup::body`] joins them.
    ///
    /// A shell within a solid one that faces inward is taken for a cavity, one that faces outward for redundant; an
    /// outermost shell that faces inward is turned together with everything in it.
    #[must_use]
    pub fn repaired(&self, limit: HoleLimit) -> Repaired {
        let mut soup = self.clone();
        let mut done = Vec::new();
        if self.welded > 0 {
            done.push(Repair::Welded(self.welded));
        }
        soup.drop_degenerate(&mut done);
        soup.drop_doubles(&mut done);
        soup.turn_triangles(&mut done);
        let cracks = soup.close_cracks();
        if cracks > 0 {
            done.push(Repair::ClosedCracks(cracks));
        }
        let walls = soup.drop_flush_walls();
        if walls > 0 {
            done.push(Repair::DroppedFlush(walls));
        }
        let parted = soup.part_pinches();
        if parted > 0 {
            done.push(Repair::Parted(parted));
        }
        soup.fill_holes(limit, &mut done);
        let mut survey = Survey::new(&soup);
        if soup.turn_shells(&survey, &mut done) {
            survey = Survey::new(&soup);
        }
        let report = soup.report(&survey);
        Repaired { soup, done, report }
    }

    fn drop_degenerate(&mut self, done: &mut Vec<Repair>) {
        let before = self.triangles.len();
        self.triangles.retain(|t| !is_degenerate(t));
        if self.triangles.len() < before {
            done.push(Repair::DroppedDegenerate(before - self.triangles.len()));
        }
    }

    fn drop_doubles(&mut self, done: &mut Vec<Repair>) {
        let (out, walls) = doubles::to_leave_out(self);
        let dropped = out.iter().filter(|&&o| o).count();
        if dropped == 0 {
            return;
        }
        let mut t = 0;
        self.triangles.retain(|_| {
            t += 1;
            !out[t - 1]
        });
        if dropped > 2 * walls {
            done.push(Repair::DroppedDuplicates(dropped - 2 * walls));
        }
        if walls > 0 {
            done.push(Repair::DroppedWalls(walls));
        }
    }

    fn turn_triangles(&mut self, done: &mut Vec<Repair>) {
        let turn = facing::to_turn(self, &check::sides(self));
        let count = turn.iter().filter(|&&t| t).count();
        if count == 0 {
            return;
        }
        for (t, turn) in self.triangles.iter_mut().zip(turn) {
            if turn {
                t.swap(1, 2);
            }
        }
        done.push(Repair::Turned {
            triangles: count,
            of: self.triangles.len(),
        });
    }

    fn fill_holes(&mut self, limit: HoleLimit, done: &mut Vec<Repair>) {
        let sides = check::sides(self);
        if topology::edges(&sides).all(|edge| edge.len() > 1) {
            return;
        }
        let fillings = holes::fillings(self, &sides);
        // The volume with all holes closed.
        let volume = {
            let middle = sphpack_neighbors::Bounds::of(&self.vertices).center();
            let of = |t: [[f64; 3]; 3]| {
                let [a, b, c] = t.map(|p| point::sub(p, middle));
                point::dot(a, point::cross(b, c)) / 6.0
            };
            let place = |v: u32, new: Option<[f64; 3]>| {
                let known = self.vertices.get(v as usize).copied();
                known.or(new).unwrap_or(middle)
            };
            let own: f64 = (0..self.triangles.len()).map(|t| of(self.corners(t))).sum();
            let new: f64 = fillings
                .iter()
                .flat_map(|f| f.triangles.iter().map(|t| t.map(|v| place(v, f.middle))))
                .map(of)
                .sum();
            (own + new).abs()
        };
        let (mut holes, mut triangles, mut hidden) = (0, 0, 0.0);
        let mut largest = None;
        for filling in fillings {
            let size = filling.size;
            hidden += PI / 12.0 * size.powi(3);
            let is_within = match limit {
                HoleLimit::Small => hidden <= SMALL_HOLES * volume,
                HoleLimit::Across(most) => size <= most,
            };
            if !is_within {
                break;
            }
            let new = self.vertices.len() as u32;
            let old = match filling.middle {
                Some(middle) => {
                    self.vertices.push(middle);
                    // What stands for it in the filling: one beyond the vertices there were then.
                    filling.triangles[0][2]
                }
                None => u32::MAX,
            };
            triangles += filling.triangles.len();
            let renamed = |v: u32| if v == old { new } else { v };
            self.triangles
                .extend(filling.triangles.iter().map(|t| t.map(renamed)));
            holes += 1;
            largest = Some((size, filling.place));
        }
        if let Some((largest, place)) = largest {
            done.push(Repair::Filled {
                holes,
                triangles,
                largest,
                place,
            });
        }
    }

    /// Whether any shell was turned.
    fn turn_shells(&mut self, survey: &Survey, done: &mut Vec<Repair>) -> bool {
        let mut count = 0;
        for (shell, piece) in survey.shells.iter().zip(&survey.pieces) {
            if shell.is_inverted {
                count += 1;
                for &t in &piece.triangles {
                    self.triangles[t as usize].swap(1, 2);
                }
            }
        }
        if count > 0 {
            let closed = survey
                .shells
                .iter()
                .filter(|shell| shell.role != ShellRole::Undecided)
                .count();
            done.push(Repair::TurnedShells {
                shells: count,
                of: closed,
            });
        }
        count > 0
    }
}
