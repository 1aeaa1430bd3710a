//! Checkpoints of a run: when they are written, what they go on from, and when they go.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use sphpack_packing::{Keeper, Progress};

use super::arguments::PackArguments;
use super::duration::duration;
use super::plain_text::visible;
use crate::Error;
use crate::checkpoint::{self, Fingerprint, Reached};
use crate::files::replace;
use crate::scene::Scene;

/// From one checkpoint to the next.
const EVERY: Duration = Duration::from_secs(30);

/// Runs that end within this leave none, unless they are stopped or asked to.
const UNASKED_AFTER: Duration = Duration::from_secs(60);

/// Writing takes no more than one part in so many of the time.
const SELDOM: u32 = 20;

/// Keeps the checkpoints of one run.
#[derive(Debug)]
pub(super) struct Keeping {
    path: PathBuf,
    fingerprint: Fingerprint,
    is_quiet: bool,
    earlier: Option<Vec<u8>>,
    reached: Reached,
    next: Instant,
    every: Duration,
    seldom: u32,
    /// Whether the file is this run's: it went on from it, or wrote it.
    is_own: bool,
    /// Whether another run's file is in the way.
    is_taken: bool,
    is_stopped: bool,
    has_failed: bool,
}

impl Keeping {
    /// What was asked for, for a run that writes `output` first.
    ///
    /// # Errors
    /// [`Error::Input`] where there is nothing to go on from, or a file in the way.
    pub(super) fn new(
        arguments: &PackArguments,
        scene: &Scene,
        output: &Path,
    ) -> Result<Self, Error> {
        let asked = arguments.checkpoint.clone();
        let is_asked = asked.is_some();
        let path = asked.unwrap_or_else(|| output.with_extension("checkpoint"));
        let every = arguments.checkpoint_every.map(Duration::from_secs_f64);
        let first = if is_asked { EVERY } else { UNASKED_AFTER };
        let mut keeping = Self {
            fingerprint: Fingerprint::of(scene)?,
            is_quiet: arguments.quiet,
            earlier: None,
            reached: Reached::default(),
            next: Instant::now() + every.unwrap_or(first),
            every: every.unwrap_or(EVERY),
            seldom: if every.is_some() { 0 } else { SELDOM },
            is_own: arguments.resume,
            is_taken: false,
            is_stopped: false,
            has_failed: false,
            path,
        };
        if arguments.resume {
            let (reached, state) = checkpoint::read(&keeping.path, &keeping.fingerprint)?;
            keeping.say(&format!(
                "going on from {}: {}, evaluation {}, after {}",
                keeping.name(),
                reached.phase,
                reached.evaluation,
                duration(reached.seconds)
            ));
            (keeping.reached, keeping.earlier) = (reached, Some(state));
        } else if fs::symlink_metadata(&keeping.path).is_ok() {
            keeping.is_taken = true;
            keeping.make_way(is_asked, arguments.force)?;
        }
        Ok(keeping)
    }

    /// A file of the name is there already. Whoever replaces outputs does not mean it: it may have taken hours.
    fn make_way(&mut self, is_asked: bool, may_replace: bool) -> Result<(), Error> {
        if may_replace && is_asked {
            self.is_taken = false;
        } else if is_asked {
            return Err(Error::input(
                &self.path,
                "the file exists; --resume goes on from it, --force replaces it",
            ));
        } else if checkpoint::is_one(&self.path) {
            self.say(&format!(
                "{} is left of a run that did not end: --resume goes on from it; this run begins anew, leaves it alone and keeps no checkpoint",
                self.name()
            ));
        } else {
            self.say(&format!(
                "{} is no checkpoint, so this run keeps none; --checkpoint FILE names another",
                self.name()
            ));
        }
        Ok(())
    }

    fn name(&self) -> String {
        visible(&self.path.display().to_string())
    }

    fn say(&self, words: &str) {
        if !self.is_quiet {
            let _ = writeln!(io::stderr(), "sphpack: {words}");
        }
    }

    /// Notes where the packing stands, and whether it is being stopped.
    pub(super) fn note(&mut self, progress: &Progress, is_stopped: bool) {
        progress.stage.name().clone_into(&mut self.reached.phase);
        self.reached.evaluation = progress.evaluation as u64;
        self.reached.seconds = progress.seconds;
        self.is_stopped = is_stopped;
    }

    /// After a run whose files are written: what is done needs no checkpoint, what was stopped can go on.
    pub(super) fn end(self, was_interrupted: bool) {
        if was_interrupted {
            if self.is_own && self.path.exists() {
                self.say(&format!(
                    "{} keeps the state: the same command with --resume --force goes on from it",
                    self.name()
                ));
            }
            return;
        }
        // Another run's is of no use any more where it would come to the same particles.
        let would_come_here =
            || self.is_taken && checkpoint::read(&self.path, &self.fingerprint).is_ok();
        if (self.is_own || would_come_here()) && checkpoint::is_one(&self.path) {
            let _ = fs::remove_file(&self.path);
        }
    }
}

impl Keeper for Keeping {
    fn is_due(&mut self) -> bool {
        !self.is_taken && (self.is_stopped || Instant::now() >= self.next)
    }

    fn keep(&mut self, write: &dyn Fn(&mut dyn Write) -> io::Result<()>) {
        let begin = Instant::now();
        let (fingerprint, reached) = (&self.fingerprint, &self.reached);
        let written = replace(&self.path, |to| {
            checkpoint::write(to, fingerprint, reached, write)
        });
        match written {
            Ok(()) => self.is_own = true,
            Err(e) if !self.has_failed => {
                self.has_failed = true;
                let name = self.name();
                self.say(&format!(
                    "warning: the checkpoint {name} cannot be written ({e}); packing goes on without"
                ));
            }
            Err(_) => {}
        }
        let now = Instant::now();
        self.next = now + self.every.max(self.seldom * (now - begin).min(10 * EVERY));
    }

    fn earlier(&mut self) -> Option<Vec<u8>> {
        self.earlier.take()
    }
}
