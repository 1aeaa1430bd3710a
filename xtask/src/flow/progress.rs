//! How far a run is, on standard error.

use std::time::{Duration, Instant};

/// Says now and then how much is left.
pub(super) struct Progress {
    name: String,
    begun: Instant,
    said: Instant,
}

/// Between two lines.
const PAUSE: Duration = Duration::from_secs(10);

impl Progress {
    pub(super) fn new(name: String) -> Self {
        let now = Instant::now();
        Self {
            name,
            begun: now,
            said: now,
        }
    }

    /// `done` of 0 … 1 is done.
    pub(super) fn at(&mut self, done: f64) {
        if self.said.elapsed() < PAUSE || done <= 0.0 {
            return;
        }
        self.said = Instant::now();
        let left = self.begun.elapsed().as_secs_f64() * (1.0 - done) / done;
        eprintln!("{}: {:.0} %, {left:.0} s left", self.name, 100.0 * done);
    }
}
