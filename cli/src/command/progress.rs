//! What a person sees while a packing runs: one line that is redrawn on a terminal, now and then a line elsewhere.

use std::io::{IsTerminal, Write};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use sphpack_packing::{Keeper, Observer, Progress, Stage};

use super::duration::duration;
use super::interrupt;
use super::keeping::Keeping;
use crate::picture::grouped;

/// The pace of the last so many evaluations, or twice as many, is taken for that of those to come.
const ANCHOR_EVALUATIONS: usize = 200;

/// How progress is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Style {
    Silent,
    /// One line, drawn anew.
    Redrawn,
    /// A line at every phase and then every few seconds.
    Plain,
}

/// Watches a packing for a person, and for Ctrl-C; keeps its checkpoints.
#[derive(Debug)]
pub(super) struct Watcher {
    style: Style,
    shown: Option<(Stage, Instant)>,
    /// Stage, evaluation and criterion some time ago and more lately, for a guess of the end.
    anchors: [Option<(Stage, usize, f64)>; 2],
    keeping: Keeping,
}

impl Watcher {
    /// Nothing is shown where `is_quiet`.
    pub(super) fn new(is_quiet: bool, keeping: Keeping) -> Self {
        let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let watcher = Self {
            style: match (is_quiet, std::io::stderr().is_terminal() && !is_dumb) {
                (true, _) => Style::Silent,
                (false, true) => Style::Redrawn,
                (false, false) => Style::Plain,
            },
            shown: None,
            anchors: [None; 2],
            keeping,
        };
        // Before anything is packed bodies are read, mended and cut.
        watcher.write("bodies     …");
        watcher
    }

    /// Clears the redrawn line, and gives back who keeps the checkpoints.
    pub(super) fn end(self) -> Keeping {
        if self.style == Style::Redrawn {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
        self.keeping
    }

    fn show(&mut self, progress: &Progress) {
        let wait = match self.style {
            Style::Silent => return,
            Style::Redrawn => Duration::from_millis(100),
            Style::Plain => Duration::from_secs(2),
        };
        let is_due = self
            .shown
            .is_none_or(|(phase, when)| phase != progress.stage || when.elapsed() >= wait);
        if !is_due {
            return;
        }
        self.shown = Some((progress.stage, Instant::now()));
        self.write(&self.line(progress));
    }

    fn write(&self, line: &str) {
        let mut to = std::io::stderr();
        let _ = match self.style {
            Style::Silent => Ok(()),
            Style::Redrawn => write!(to, "\r  {line}\x1b[K").and_then(|()| to.flush()),
            Style::Plain => writeln!(to, "  {line}"),
        };
    }

    fn line(&self, progress: &Progress) -> String {
        let name = progress.stage.name();
        if progress.evaluation == 0 {
            return format!("{name:10} …");
        }
        let rate = progress.evaluation as f64 / progress.seconds.max(1e-9);
        let left = self
            .evaluations_left(progress)
            .map_or_else(String::new, |n| {
                format!(", about {} left", duration(n / rate))
            });
        format!(
            "{name:10} evaluation {}, {} (until {:.0e}), {} of {} on the surface, {:.0}/s{left}",
            grouped(progress.evaluation),
            if progress.criterion.is_finite() {
                format!("{:.1e}", progress.criterion)
            } else {
                "–".to_owned()
            },
            progress.tolerance,
            grouped(progress.on_surface),
            grouped(progress.target),
            rate,
        )
    }

    /// How many evaluations there are to come if the criterion goes on falling as it did lately.
    fn evaluations_left(&self, progress: &Progress) -> Option<f64> {
        let limit = progress.max_evaluations.saturating_sub(progress.evaluation) as f64;
        let (_, evaluation, criterion) =
            self.anchors[0].filter(|start| start.0 == progress.stage)?;
        let fall = (criterion / progress.criterion).ln();
        let to_go = (progress.criterion / progress.tolerance).ln();
        let done = progress.evaluation.saturating_sub(evaluation) as f64;
        (progress.stage == Stage::Settling && fall > 0.1 && to_go.is_finite())
            .then(|| (done * to_go.max(0.0) / fall).min(limit))
    }
}

impl Observer for Watcher {
    fn progress(&mut self, progress: &Progress) -> ControlFlow<()> {
        let here = (progress.stage, progress.evaluation, progress.criterion);
        if progress.criterion.is_finite() {
            match self.anchors {
                [_, Some((phase, evaluation, _))] if phase == progress.stage => {
                    if progress.evaluation >= evaluation + ANCHOR_EVALUATIONS {
                        self.anchors = [self.anchors[1], Some(here)];
                    }
                }
                _ => self.anchors = [Some(here); 2],
            }
        }
        if matches!(progress.stage, Stage::Capture | Stage::Settling) {
            interrupt::has_begun();
        }
        self.show(progress);
        let is_stopped = interrupt::is_asked();
        self.keeping.note(progress, is_stopped);
        if is_stopped {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    fn keeper(&mut self) -> Option<&mut dyn Keeper> {
        Some(&mut self.keeping)
    }
}
