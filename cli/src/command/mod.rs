//! The command `sphpack`.
//!
//! Progress and errors go to standard error, results (the closing summary, lists, measures) to standard output.
//! Nothing is coloured. Exit statuses: see [`crate::DONE`] and its neighbours.

mod arguments;
mod at_once;
mod check;
mod duration;
mod init;
mod interrupt;
mod keeping;
mod list;
mod memory_guard;
mod number;
mod outputs;
mod pack;
mod plain_text;
mod progress;
mod quality;
mod results;
mod summary;
mod threads;
mod view;

use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;

use crate::Error;
use crate::error::{BAD_INPUT, DONE, FAILED};
use crate::memory::address_space_left;
use arguments::{Arguments, Command};

/// Address space without which not even a message can be made.
const LEAST_BYTES: u64 = 1 << 20;

/// Runs the command with the process's arguments.
pub fn main() -> ExitCode {
    ExitCode::from(run(std::env::args_os()))
}

/// Runs the command with these arguments, the program's name first, and gives its exit status. Ctrl-C is the command's from then on, and
/// may end the process: this is for a process that does nothing else.
pub fn run<A: Into<OsString> + Clone>(arguments: impl IntoIterator<Item = A>) -> u8 {
    if let Some(left) = address_space_left().filter(|&left| left < LEAST_BYTES) {
        let _ = writeln!(
            std::io::stderr(),
            "sphpack: the limit of address space (ulimit -v) leaves {} KiB of memory, too little for anything; raise it",
            left >> 10
        );
        return FAILED;
    }
    let result = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => match arguments.command {
            Command::Pack(pack) => pack::run(&pack),
            Command::Check(check) => check::run(&check),
            Command::Quality(quality) => quality::run(&quality),
            Command::View(view) => view::run(&view),
            Command::Init(init) => init::run(&init),
            Command::List { what } => list::run(what),
        },
        Err(answer) if answer.use_stderr() => {
            let words = answer.render().to_string();
            let lines: Vec<String> = words.lines().map(plain_text::message).collect();
            let _ = writeln!(std::io::stderr(), "{}", lines.join("\n"));
            return BAD_INPUT;
        }
        // Help and version are answers too, and no errors.
        Err(answer) => say(&answer.render().to_string()).map(|()| DONE),
    };
    match result {
        Ok(status) => status,
        Err(error) => {
            let words = plain_text::message(&error.to_string());
            let _ = writeln!(std::io::stderr(), "sphpack: {words}");
            error.status()
        }
    }
}

/// Writes to standard output. Whoever has stopped reading, as `head` does, has had enough: that is no error.
///
/// # Errors
/// [`Error::System`] where it takes no more for another reason, a full disk for example.
fn say(text: &str) -> Result<(), Error> {
    let mut to = std::io::stdout().lock();
    (to.write_all(text.as_bytes()).and_then(|()| to.flush())).or_else(unless_closed)
}

/// Says it on standard error, where standard output is for something else.
fn say_aside(text: &str) {
    // Nobody can be told that it fails.
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// A fault of standard output; none where who reads it has gone.
fn unless_closed(e: std::io::Error) -> Result<(), Error> {
    match e.kind() {
        ErrorKind::BrokenPipe => Ok(()),
        _ => Err(Error::System(format!(
            "standard output cannot be written ({e}), so what was to be said is lost; files that were asked for are written"
        ))),
    }
}
