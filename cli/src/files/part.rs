//! Files that hold a part of the particles: those of one body, of the fluid, or of one side.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use sphpack_separation::Side;

use super::format::body_of;
use super::reload::FLUID;
use crate::Error;
use crate::scene::{Role, Scene, advice};
use crate::table::Table;

/// What of a file's name stands for the name of a body, or of the fluid.
const BODY: &str = "{body}";

/// What stands for a side.
const SIDE: &str = "{side}";

/// Longer names are none on most systems, with what is put before and behind them.
const LONGEST_NAME: usize = 200;

/// What no name of a file may have, on one system or another.
const NOT_IN_NAMES: [char; 9] = ['/', '\\', ':', '*', '?', '"', '<', '>', '|'];

/// Which particles a file holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Part {
    /// All of them.
    All,
    /// Those of the body of this name, or of the fluid.
    Of(String),
    /// Those of one side.
    On(Side),
}

/// Whose particles there may be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Owners {
    /// Bodies, and whether they have particles.
    bodies: Vec<(String, bool)>,
    has_fluid: bool,
}

impl Owners {
    /// Of a scene: nothing is in a void.
    pub(crate) fn of_scene(scene: &Scene) -> Self {
        let bodies = scene.body.iter();
        Self {
            bodies: bodies
                .map(|body| (body.name.clone(), body.role != Role::Void))
                .collect(),
            has_fluid: scene.fluid.fill,
        }
    }

    /// Of a table.
    pub(super) fn of_table(table: &Table) -> Self {
        let has = |body: usize| table.body.contains(&Some(body as u16));
        let bodies = table.bodies.iter().enumerate();
        Self {
            bodies: bodies.map(|(n, name)| (name.clone(), has(n))).collect(),
            has_fluid: table.side.contains(&Side::Fluid),
        }
    }

    /// The files that a name stands for, and what each of them holds: one of each body and of the fluid where it has `{body}`, one of
    /// each side where it has `{side}`, else one.
    ///
    /// # Errors
    /// [`Error::Input`] where a body's name cannot be part of a file's, is that of the fluid, or where no body has the
    /// name that `NAME_rld.xml` asks for.
    pub(crate) fn files(&self, path: &Path) -> Result<Vec<(PathBuf, Part)>, Error> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let named = |what: &str, by: &str| path.with_file_name(name.replace(what, by));
        let all: Vec<(PathBuf, Part)> = match (name.contains(BODY), name.contains(SIDE)) {
            (true, true) => {
                let message = "a file is of one body or of one side; leave {body} or {side} out";
                return Err(Error::input(path, message));
            }
            (true, false) => {
                self.refuse_names(path)?;
                let fluid = self.has_fluid.then_some(FLUID);
                (self.with_particles().chain(fluid))
                    .map(|owner| (named(BODY, owner), Part::Of(owner.to_owned())))
                    .collect()
            }
            (false, true) => {
                let solid = self.with_particles().next().map(|_| Side::Solid);
                (solid
                    .into_iter()
                    .chain(self.has_fluid.then_some(Side::Fluid)))
                .map(|side| (named(SIDE, side.name()), Part::On(side)))
                .collect()
            }
            (false, false) => match body_of(path) {
                Some(owner) => {
                    self.refuse_unknown(path, &owner)?;
                    vec![(path.to_owned(), Part::Of(owner))]
                }
                None => vec![(path.to_owned(), Part::All)],
            },
        };
        if all.is_empty() {
            return Err(Error::input(
                path,
                "there are no particles that such a file would hold; leave it out",
            ));
        }
        Ok(all)
    }

    fn with_particles(&self) -> impl Iterator<Item = &str> {
        (self.bodies.iter())
            .filter(|(_, has)| *has)
            .map(|(name, _)| name.as_str())
    }

    fn refuse_names(&self, path: &Path) -> Result<(), Error> {
        let is_none = |name: &&str| {
            name.trim().is_empty()
                || name.len() > LONGEST_NAME
                || name.contains(NOT_IN_NAMES)
                || name.contains(char::is_control)
        };
        if let Some(name) = self.with_particles().find(is_none) {
            return Err(Error::input(
                path,
                format!(
                    "a file is to be called after the body \"{name}\", which no file can be; give the body another name, or leave {{body}} out"
                ),
            ));
        }
        if self.with_particles().any(|name| name == FLUID) {
            return Err(Error::input(
                path,
                format!(
                    "a body is called \"{FLUID}\", as the fluid's file is; give the body another name, or leave {{body}} out"
                ),
            ));
        }
        Ok(())
    }

    /// Refuses the name of a body in the name of a file where there is none.
    fn refuse_unknown(&self, path: &Path, name: &str) -> Result<(), Error> {
        let bodies = self.bodies.iter().map(|(name, _)| name.as_str());
        let known: Vec<&str> = bodies.chain([FLUID]).collect();
        if known.contains(&name) {
            return Ok(());
        }
        Err(Error::input(
            path,
            format!(
                "NAME_rld.xml holds the particles of the body NAME, and none is called \"{name}\"; {}",
                advice(name, &known)
            ),
        ))
    }
}

impl Part {
    /// The rows that are in it.
    pub(super) fn rows<'a>(&self, table: &'a Table) -> Cow<'a, Table> {
        match self {
            Self::All => Cow::Borrowed(table),
            Self::Of(owner) => {
                Cow::Owned(table.filtered(|i| table.body_name(i).unwrap_or(FLUID) == owner))
            }
            Self::On(side) => Cow::Owned(table.filtered(|i| table.side[i] == *side)),
        }
    }
}
