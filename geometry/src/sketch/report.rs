//! What is found wrong with loops.

use std::fmt;

use sphpack_neighbors::Bounds;

use crate::soup::seven_digits;

/// A kind of defect of an outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum OutlineDefectKind {
    /// Pairs of sides of one loop that cross.
    SelfIntersection,
    /// Pairs of loops that overlap: each has room that the other has too, and room of its own, in pieces that are thicker
    /// on average (twice the area over the length around) than 10⁻⁶ of the diagonal of the box around both. Loops that
    /// meet and have less in common touch.
    Overlap,
    /// Loops that are there more than once, whichever way round.
    Duplicate,
    /// Pairs of sides of one loop that touch.
    SelfContact,
    /// Pairs of loops that touch.
    Contact,
    /// Points at which the outline turns straight back.
    Spike,
    /// Loops whose points lie on one line.
    NoArea,
    /// Loops of fewer than three different points.
    TooFewPoints,
    /// Points that repeat the one before. They do no harm.
    Repeated,
}

impl OutlineDefectKind {
    /// All of them, the worst first.
    pub const ALL: [Self; 9] = [
        Self::SelfIntersection,
        Self::Overlap,
        Self::Duplicate,
        Self::SelfContact,
        Self::Contact,
        Self::Spike,
        Self::NoArea,
        Self::TooFewPoints,
        Self::Repeated,
    ];

    /// A short name, for machines.
    pub fn name(self) -> &'static str {
        match self {
            Self::SelfIntersection => "self-intersection",
            Self::Overlap => "overlap",
            Self::Duplicate => "duplicate",
            Self::SelfContact => "self-contact",
            Self::Contact => "contact",
            Self::Spike => "spike",
            Self::NoArea => "no-area",
            Self::TooFewPoints => "too-few-points",
            Self::Repeated => "repeated",
        }
    }

    /// Whether an outline with this is as good as one without.
    pub fn is_harmless(self) -> bool {
        self == Self::Repeated
    }

    /// What is wrong, after a count of one or of several.
    fn words(self, count: usize) -> &'static str {
        let (one, several) = match self {
            Self::SelfIntersection => (
                "pair of sides of one loop that cross",
                "pairs of sides of one loop that cross",
            ),
            Self::Overlap => ("pair of loops that overlap", "pairs of loops that overlap"),
            Self::Duplicate => ("loop that is there already", "loops that are there already"),
            Self::SelfContact => (
                "pair of sides of one loop that touch",
                "pairs of sides of one loop that touch",
            ),
            Self::Contact => ("pair of loops that touch", "pairs of loops that touch"),
            Self::Spike => (
                "spike, a point at which the outline turns straight back",
                "spikes, points at which the outline turns straight back",
            ),
            Self::NoArea => (
                "loop without area, its points on one line",
                "loops without area, their points on one line",
            ),
            Self::TooFewPoints => (
                "loop of fewer than three different points",
                "loops of fewer than three different points",
            ),
            Self::Repeated => (
                "point that repeats the one before (harmless)",
                "points that repeat the one before (harmless)",
            ),
        };
        if count == 1 { one } else { several }
    }

    /// What to do about it.
    pub fn cure(self) -> &'static str {
        match self {
            Self::SelfIntersection => {
                "put the points in the order in which they follow each other round the body: parts of it run the wrong way round"
            }
            Self::Overlap => {
                "loops are joined by themselves where they run the same way round and none is within another of them: turn one, or join or cut them in a drawing program"
            }
            Self::SelfContact | Self::Contact => {
                "move a point there, or join the loops in a drawing program"
            }
            Self::Duplicate => "remove the double",
            Self::Spike => "remove the point",
            Self::NoArea | Self::TooFewPoints => {
                "a loop needs three points or more that are not on one line: remove it, or check how its points are parted into loops"
            }
            Self::Repeated => "remove the point",
        }
    }
}

/// How often a defect is there, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct OutlineDefect {
    /// What it is.
    pub kind: OutlineDefectKind,
    /// How often.
    pub count: usize,
    /// The first of them, scene units.
    pub place: [f64; 2],
    /// The loop that has it, or the first of the two, counted from 0.
    pub loop_index: usize,
}

impl fmt::Display for OutlineDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.place.map(seven_digits);
        write!(
            f,
            "{} {}, {}near ({x}, {y}), in loop {}",
            self.count,
            self.kind.words(self.count),
            if self.count == 1 { "" } else { "the first " },
            self.loop_index + 1
        )
    }
}

/// What a loop is to the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum LoopRole {
    /// What is just inside it is solid.
    Body,
    /// What is just inside it is hollow: it is inside an odd number of others.
    Hole,
    /// It adds nothing: it has no area, or is there already.
    Nothing,
    /// It crosses itself or overlaps another: what it bounds is not said.
    Undecided,
}

impl LoopRole {
    /// A short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Body => "body",
            Self::Hole => "hole",
            Self::Nothing => "nothing",
            Self::Undecided => "undecided",
        }
    }
}

/// A loop as it is given.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SketchLoop {
    /// How many points it has, repeated ones left out.
    pub points: usize,
    /// Its box.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub bounds: Bounds<2>,
    /// Its length.
    pub length: f64,
    /// Its area, positive where it runs counter-clockwise. The direction does not matter to the body.
    pub area: f64,
    /// What it is to the body.
    pub role: LoopRole,
    /// The smallest loop that is around it.
    pub inside: Option<usize>,
}

/// What [`Sketch::check`](super::Sketch::check) finds.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct OutlineReport {
    /// The box around all points.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub bounds: Bounds<2>,
    /// What is wrong, the worst first.
    pub defects: Vec<OutlineDefect>,
    /// The loops, in the order in which they are given.
    pub loops: Vec<SketchLoop>,
}

impl OutlineReport {
    /// Whether the loops are an outline as they are.
    pub fn is_clean(&self) -> bool {
        self.defects.iter().all(|d| d.kind.is_harmless())
    }

    /// What is known of one kind of defect; `None` where there is none.
    pub fn defect(&self, kind: OutlineDefectKind) -> Option<&OutlineDefect> {
        self.defects.iter().find(|d| d.kind == kind)
    }

    /// The area of the loops, holes negative; those without a role left out.
    pub fn area(&self) -> f64 {
        let of = |one: &SketchLoop| match one.role {
            LoopRole::Body => one.area.abs(),
            LoopRole::Hole => -one.area.abs(),
            LoopRole::Nothing | LoopRole::Undecided => 0.0,
        };
        self.loops.iter().map(of).sum()
    }
}
