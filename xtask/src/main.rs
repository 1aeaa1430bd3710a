//! The project's own tasks; `cargo xtask help` lists them.

mod accelerations;
mod agitators;
mod arguments;
mod axes;
mod balanced;
mod balanced_rows;
mod bench;
mod bodies;
mod chart;
mod ci;
mod compare;
mod corpora;
mod crystal;
mod dial;
mod draw;
mod drawing;
mod environment;
mod figures;
mod flow;
mod front;
mod fuzz;
mod gaps;
mod guide;
mod interface;
mod kept;
mod lattices;
#[path = "../../geometry/src/read/mangle.rs"]
mod mangle;
mod marks;
mod parsed;
mod power_law;
mod python;
mod random_start;
mod relaxed_airfoils;
mod reliability;
mod reproduction;
mod rest;
mod round_trip;
mod scene_fuzz;
mod sections;
mod selection;
mod shipped;
mod shown_table;
mod speed;
mod stability;
mod steady;
mod tasks;
mod tidy;
mod variable;
mod view;
mod workspace;

use std::process::ExitCode;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let Some("help" | "--help" | "-h") = words.first().map(String::as_str) {
        print!("{}", tasks::usage());
        return ExitCode::SUCCESS;
    }
    match tasks::job(&words).and_then(|job| job()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}
