//! What is found wrong with triangles.

use std::fmt;

use sphpack_neighbors::Bounds;

/// A kind of defect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum DefectKind {
    /// Edges with one triangle only: the mesh has holes.
    OpenEdge,
    /// Edges with more than two triangles.
    NonManifold,
    /// Edges whose two triangles face opposite ways.
    Inconsistent,
    /// Closed shells that face the wrong way: bodies inward, or what is in them likewise.
    Inverted,
    /// Pairs of shells that pass through each other.
    Overlap,
    /// Shells inside a solid that face outward: they add nothing to it, and a cavity would face inward.
    Redundant,
    /// Pairs of triangles of one shell that pass through each other.
    SelfIntersection,
    /// Pairs of shells that touch.
    Contact,
    /// Triangles that are there more than once, in either direction.
    Duplicate,
    /// Triangles that use a vertex twice.
    Degenerate,
    /// Triangles of three vertices on one line. They do no harm.
    Sliver,
}

impl DefectKind {
    /// All of them, the worst first.
    pub const ALL: [Self; 11] = [
        Self::OpenEdge,
        Self::NonManifold,
        Self::Inconsistent,
        Self::Inverted,
        Self::Overlap,
        Self::Redundant,
        Self::SelfIntersection,
        Self::Contact,
        Self::Duplicate,
        Self::Degenerate,
        Self::Sliver,
    ];

    /// A short name, for machines.
    pub fn name(self) -> &'static str {
        match self {
            Self::OpenEdge => "open-edge",
            Self::NonManifold => "non-manifold",
            Self::Inconsistent => "inconsistent",
            Self::Inverted => "inverted",
            Self::Overlap => "overlap",
            Self::Redundant => "redundant",
            Self::SelfIntersection => "self-intersection",
            Self::Contact => "contact",
            Self::Duplicate => "duplicate",
            Self::Degenerate => "degenerate",
            Self::Sliver => "sliver",
        }
    }

    /// Whether a mesh with this is as good as one without.
    pub fn is_harmless(self) -> bool {
        matches!(self, Self::Sliver | Self::Degenerate)
    }

    /// What is wrong, after a count.
    fn words(self) -> &'static str {
        match self {
            Self::OpenEdge => "edges with one triangle (holes)",
            Self::NonManifold => "edges shared by more than two triangles",
            Self::Inconsistent => "edges at which neighbouring triangles face opposite ways",
            Self::Inverted => "shells that face the wrong way",
            Self::Overlap => "pairs of shells that overlap",
            Self::Redundant => "shells inside a solid that face outward",
            Self::SelfIntersection => "pairs of triangles of one shell that cross",
            Self::Contact => "pairs of shells that touch",
            Self::Duplicate => "triangles that are there more than once",
            Self::Degenerate => "triangles that use a vertex twice",
            Self::Sliver => "triangles without area (harmless)",
        }
    }

    /// What to do about it in a mesh editor.
    pub fn cure(self) -> &'static str {
        match self {
            Self::OpenEdge => "close the holes in a mesh editor",
            Self::NonManifold => "merge doubled vertices and remove inner walls in a mesh editor",
            Self::Inconsistent | Self::Inverted => {
                "make the normals consistent in a mesh editor, facing outward"
            }
            Self::Overlap | Self::Contact => "join the shells by a Boolean union in a mesh editor",
            Self::Redundant => {
                "remove the inner shell, or turn its normals inward if it is a cavity"
            }
            Self::SelfIntersection => "remove the crossings in a mesh editor",
            Self::Duplicate | Self::Degenerate | Self::Sliver => {
                "merge doubled vertices in a mesh editor"
            }
        }
    }
}

/// How often a defect is there, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Defect {
    /// What it is.
    pub kind: DefectKind,
    /// How often.
    pub count: usize,
    /// The first of them, scene units.
    pub place: [f64; 3],
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} {}, the first near {}",
            self.count,
            self.kind.words(),
            Place(self.place)
        )
    }
}

/// A hole: open edges that hang together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Hole {
    /// How many open edges it has.
    pub edges: usize,
    /// How large it is across, scene units: twice the distance of its furthest vertex from the middle of its box.
    pub size: f64,
    /// The middle of its box.
    pub place: [f64; 3],
}

/// What a shell is to the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum ShellRole {
    /// Its inside is solid.
    Body,
    /// Its inside is hollow, within a solid shell.
    Cavity,
    /// Within a solid shell and solid itself: it adds nothing.
    Redundant,
    /// It is open, or its triangles disagree: it has no inside yet.
    Undecided,
}

impl ShellRole {
    /// A short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Body => "body",
            Self::Cavity => "cavity",
            Self::Redundant => "redundant",
            Self::Undecided => "undecided",
        }
    }
}

/// Triangles that hang together over their edges.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Shell {
    /// How many triangles it has.
    pub triangles: usize,
    /// What it is to the body.
    pub role: ShellRole,
    /// Whether it faces the wrong way for that.
    pub is_inverted: bool,
    /// The smallest shell that is around it.
    pub inside: Option<usize>,
    /// Its box.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub bounds: Bounds<3>,
    /// Its area.
    pub area: f64,
    /// The volume it encloses, negative where it faces inward; means little where it is open.
    pub volume: f64,
}

/// What [`Soup::check`](super::Soup::check) finds.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct MeshReport {
    /// Triangles.
    pub triangles: usize,
    /// Different vertices.
    pub vertices: usize,
    /// Vertices that were taken together although they are not quite equal.
    pub welded: usize,
    /// The box around all vertices.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub bounds: Bounds<3>,
    /// Area of all triangles.
    pub area: f64,
    /// Sum of the shells' volumes, those of cavities negative. The volume of the body where nothing is wrong.
    pub volume: f64,
    /// What is wrong, the worst first.
    pub defects: Vec<Defect>,
    /// Holes, the largest first.
    pub holes: Vec<Hole>,
    /// Shells, in the order of their first triangles.
    pub shells: Vec<Shell>,
}

impl MeshReport {
    /// Whether the triangles are a body as they are.
    pub fn is_clean(&self) -> bool {
        self.volume != 0.0 && self.defects.iter().all(|d| d.kind.is_harmless())
    }

    /// What is known of one kind of defect; `None` where there is none.
    pub fn defect(&self, kind: DefectKind) -> Option<&Defect> {
        self.defects.iter().find(|d| d.kind == kind)
    }
}

/// A place in a sentence.
pub(super) struct Place(pub(super) [f64; 3]);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.map(seven_digits);
        write!(f, "({x}, {y}, {z})")
    }
}

/// Four digits are enough for a size.
pub(crate) fn four_digits(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// As many digits as an STL file has tell places apart that are far from the origin.
pub(crate) fn seven_digits(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    format!("{x:.6e}").parse().unwrap_or(x)
}
