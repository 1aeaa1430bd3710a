//! The threads that compute: started at the beginning, where it can still be said that the system gives none.

use crate::Error;

/// The most threads that make sense.
const MAX_THREADS: usize = 1024;

/// Starts so many threads, or one for each core; once in a process, before anything computes.
///
/// # Errors
/// [`Error::Usage`] for a number out of range, [`Error::System`] where they cannot be started.
pub(super) fn start(number: Option<usize>) -> Result<(), Error> {
    if let Some(number) = number
        && !(1..=MAX_THREADS).contains(&number)
    {
        return Err(Error::Usage(format!(
            "--threads is {number}; it must be from 1 to {MAX_THREADS}"
        )));
    }
    // 0 is one for each core, or what RAYON_NUM_THREADS says.
    rayon::ThreadPoolBuilder::new()
        .num_threads(number.unwrap_or(0))
        .build_global()
        .map_err(|e| {
            let how_many = match number {
                Some(1) => "no thread".to_owned(),
                Some(number) => format!("{number} threads"),
                None => "a thread for each core".to_owned(),
            };
            let verb = if number == Some(1) { "can" } else { "cannot" };
            Error::System(format!(
                "{how_many} {verb} be started ({e}); use fewer (`sphpack pack` with --threads 1, others with RAYON_NUM_THREADS=1 in the environment), or raise the limits on processes and memory (ulimit -u, ulimit -v)"
            ))
        })
}
