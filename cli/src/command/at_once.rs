//! The end of the process from any thread.

use crate::files::forget_unfinished;

/// Ends the process; files that are not finished go first.
pub(super) fn end(status: u8) -> ! {
    forget_unfinished();
    std::process::exit(i32::from(status));
}
