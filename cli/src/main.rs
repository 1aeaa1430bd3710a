//! The command `sphpack`; everything is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    sphpack::command::main()
}
