//! The threads that compute: started at the beginning, where it can still be said that the system gives none.

use std::io::Write;

use sphpack_packing::problem::size;

use crate::Error;
use crate::memory::{address_space_left, address_space_of};

/// The most threads that make sense.
const MAX_THREADS: usize = 1024;

/// Starts so many threads, or one for each core; once in a process, before anything computes. Under a limit of address space
/// fewer than one for each core, where it has no room for as many, with a word.
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
    let fitting = fitting(number, address_space_left())?;
    if let (None, Some(fitting)) = (number, fitting) {
        let _ = writeln!(
            std::io::stderr(),
            "sphpack: warning: {}, not one for each core: the limit of address space (ulimit -v) has no room for more",
            threads(fitting)
        );
    }
    // 0 is one for each core, or what RAYON_NUM_THREADS says.
    rayon::ThreadPoolBuilder::new()
        .num_threads(fitting.or(number).unwrap_or(0))
        .build_global()
        .map_err(|e| {
            let how_many = number.map_or("a thread for each core".to_owned(), threads);
            cannot(&how_many, &e.to_string())
        })
}

/// How many fit into so much address space, where that is fewer than wanted.
fn fitting(number: Option<usize>, left: Option<u64>) -> Result<Option<usize>, Error> {
    let Some(left) = left else {
        return Ok(None);
    };
    let fits = |number: usize| address_space_of(number as u64) <= left;
    match number {
        Some(number) if fits(number) => Ok(None),
        None => {
            let wanted = usual();
            // As much again for what they compute; one does with less.
            let fewer = (1..=wanted).rev().find(|&number| fits(2 * number));
            match fewer.or(Some(1).filter(|&one| fits(one))) {
                Some(fewer) if fewer == wanted => Ok(None),
                Some(fewer) => Ok(Some(fewer)),
                None => Err(no_room(1, left)),
            }
        }
        Some(number) => Err(no_room(number, left)),
    }
}

fn no_room(number: usize, left: u64) -> Error {
    let reason = format!(
        "the limit of address space leaves {}, and they may take {}",
        size(left as f64),
        size(address_space_of(number as u64) as f64)
    );
    cannot(&threads(number), &reason)
}

/// How many there are where nobody says.
fn usual() -> usize {
    let said = std::env::var("RAYON_NUM_THREADS").ok();
    let said = said.and_then(|number| number.parse().ok());
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    said.filter(|&number| number > 0).unwrap_or_else(cores)
}

fn threads(number: usize) -> String {
    if number == 1 {
        "one thread".to_owned()
    } else {
        format!("{number} threads")
    }
}

fn cannot(how_many: &str, reason: &str) -> Error {
    Error::System(format!(
        "{how_many} cannot be started ({reason}); use fewer (`sphpack pack` with --threads 1, others with RAYON_NUM_THREADS=1 in the environment), or raise the limits on processes and memory (ulimit -u, ulimit -v)"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_fit_into_the_address_space_that_is_left() {
        let room = |number: u64| Some(address_space_of(number));
        assert_eq!(fitting(Some(4), None).unwrap(), None);
        assert_eq!(fitting(Some(4), room(4)).unwrap(), None);
        // Who asks for a number gets it, or a word.
        let error = fitting(Some(4), room(3)).unwrap_err().to_string();
        assert!(error.starts_with("4 threads cannot"), "{error}");
        assert!(error.contains("ulimit -v"), "{error}");
        assert!(fitting(Some(1), room(0)).is_err());
        // Who does not gets fewer, which have room to work in.
        let usual = usual();
        assert_eq!(fitting(None, room(2 * usual as u64)).unwrap(), None);
        assert!(fitting(None, room(0)).is_err());
        if usual > 1 {
            let fewer = fitting(None, room(2 * usual as u64 - 1)).unwrap();
            assert_eq!(fewer, Some(usual - 1));
            assert_eq!(fitting(None, room(1)).unwrap(), Some(1));
        }
    }
}
