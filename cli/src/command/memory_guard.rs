//! The end of a run whose bodies take more memory than there is.

use std::io::Write;
use std::time::Duration;

use sphpack_packing::problem::size;

use super::{at_once, interrupt};
use crate::error::BAD_INPUT;
use crate::report::kibibytes;

/// Between two looks. A thread fills memory by some 100 MB in this time.
const EVERY: Duration = Duration::from_millis(50);

/// From now on, until particles settle, the process ends with a reason where it takes more than `allowed` bytes. The
/// estimate before the work knows particles; what bodies take while they are read, moved and cut is known when it happens.
/// Without a thread to spare, or a system that says what is taken, nobody looks.
pub(super) fn watch(allowed: f64) {
    let look = move || {
        while !interrupt::is_at_work() {
            let Some(taken) = kibibytes("/proc/self/status", "VmRSS:") else {
                return;
            };
            if taken as f64 > allowed {
                let _ = writeln!(
                    std::io::stderr(),
                    "sphpack: stopped: {} of memory are in use, more than the {} that were free; use a larger spacing, a smaller domain or plainer bodies, or raise the limit",
                    size(taken as f64),
                    size(allowed)
                );
                at_once::end(BAD_INPUT);
            }
            std::thread::sleep(EVERY);
        }
    };
    let thread = std::thread::Builder::new().name("memory".to_owned());
    drop(thread.spawn(look));
}
