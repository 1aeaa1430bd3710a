//! Ctrl-C: the first asks to stop where there is something to write, the second ends at once.

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

use super::at_once;
use crate::Error;
use crate::error::INTERRUPTED;

static ASKED: AtomicBool = AtomicBool::new(false);

/// Whether there are particles that have begun to settle.
static AT_WORK: AtomicBool = AtomicBool::new(false);

/// Whether Ctrl-C was pressed.
pub(super) fn is_asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Whether there is something to write.
pub(super) fn is_at_work() -> bool {
    AT_WORK.load(Ordering::Relaxed)
}

/// From now on there is something to write.
pub(super) fn has_begun() {
    AT_WORK.store(true, Ordering::Relaxed);
}

/// From now on Ctrl-C (and a request to terminate) stops the packing instead of the process. Before particles settle, while
/// bodies are read and cut, it ends the process: there is nothing to lose, and nobody has to wait.
pub(super) fn watch(is_quiet: bool) -> Result<(), Error> {
    ctrlc::set_handler(move || {
        let again = ASKED.swap(true, Ordering::Relaxed);
        let at_work = is_at_work();
        if !is_quiet && !again {
            let _ = writeln!(
                std::io::stderr(),
                "\n{}",
                if at_work {
                    "stopping; what there is will be written (Ctrl-C again ends at once)"
                } else {
                    "stopped before the first particle moved; nothing was written"
                }
            );
        }
        if again || !at_work {
            at_once::end(INTERRUPTED);
        }
    })
    .map_err(|e| Error::System(format!("cannot watch for Ctrl-C ({e}), which takes a thread of its own; raise the limits on processes and memory (ulimit -u, ulimit -v)")))
}
