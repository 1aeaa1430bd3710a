//! Ctrl-C: the first asks to stop, the second ends at once.

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::Error;
use crate::error::INTERRUPTED;
use crate::files::forget_unfinished;

static ASKED: AtomicBool = AtomicBool::new(false);

/// Whether Ctrl-C was pressed.
pub(super) fn is_asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// From now on Ctrl-C (and a request to terminate) stops the packing instead of the process.
pub(super) fn watch(is_quiet: bool) -> Result<(), Error> {
    ctrlc::set_handler(move || {
        if ASKED.swap(true, Ordering::Relaxed) {
            forget_unfinished();
            std::process::exit(i32::from(INTERRUPTED));
        }
        if !is_quiet {
            let _ = writeln!(
                std::io::stderr(),
                "\nstopping; what there is will be written (Ctrl-C again ends at once)"
            );
        }
    })
    .map_err(|e| Error::System(format!("cannot watch for Ctrl-C ({e}), which takes a thread of its own; raise the limits on processes and memory (ulimit -u, ulimit -v)")))
}
