//! The command `sphpack`.
//!
//! Progress and errors go to standard error, results (the closing summary, lists, measures) to standard output.
//! Nothing is coloured. Exit statuses: see [`crate::DONE`] and its neighbours.

mod arguments;
mod check;
mod init;
mod interrupt;
mod list;
mod outputs;
mod pack;
mod progress;
mod quality;
mod summary;

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;

use crate::error::{BAD_INPUT, DONE};
use arguments::{Arguments, Command};

/// Runs the command with the process's arguments.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(answer) => {
            // Help and version are answers too, and no errors.
            let status = if answer.use_stderr() { BAD_INPUT } else { DONE };
            let _ = answer.print();
            return ExitCode::from(status);
        }
    };
    let result = match arguments.command {
        Command::Pack(pack) => pack::run(&pack),
        Command::Check(check) => check::run(&check),
        Command::Quality(quality) => quality::run(&quality),
        Command::Init(init) => init::run(&init),
        Command::List { what } => list::run(what),
    };
    match result {
        Ok(status) => ExitCode::from(status),
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "sphpack: {error}");
            ExitCode::from(error.status())
        }
    }
}

/// Writes to standard output; whoever has stopped reading misses the rest.
fn say(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}
