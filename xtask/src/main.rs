//! The project's own tasks: `cargo xtask ci | tidy | draw | fuzz | kills | faults | estimates | reliability |
//! reproduce-paper | balanced | compare | corpora | lattices | speed | bodies | round-trip`.

mod accelerations;
mod agitators;
mod balanced;
mod balanced_rows;
mod bodies;
mod chart;
mod ci;
mod compare;
mod corpora;
mod dial;
mod draw;
mod figures;
mod fuzz;
mod gaps;
mod interface;
mod lattices;
#[path = "../../geometry/src/read/mangle.rs"]
mod mangle;
mod marks;
mod parsed;
mod reliability;
mod reproduce;
mod rest;
mod round_trip;
mod rows;
mod scene_fuzz;
mod sections;
mod speed;
mod tidy;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask TASK

  ci                          everything that a change must pass
  tidy                        house rules: crate graph, file sizes, names, lints
  draw [--rounds N] [--seed N]
                              property tests on new cases, a hundred times as many as cargo test
  fuzz [--inputs N] [--seed N] [--only stl|obj|ply|csv|dat|svg]
                              damaged files (a million) for every reader of bodies
  fuzz --scenes N [--seed N] [--number N] [--write]
                              random scenes, packed by the command and judged by brute force;
                              --number runs and shows one of them alone,
                              --write also writes docs/reliability.md
  fuzz --scene-files N [--seed N] [--write]
                              damaged scene files for the parser and the plan, in process; 100000 is the long form,
                              --write also writes docs/reliability.md
  kills [--runs N] [--seed N] [--program FILE] [--write]
                              runs of random scenes, killed N times (200) and resumed: they must come to the same bytes;
                              --write also writes docs/reliability.md
  faults [--runs N] [--seed N] [--only FAULT] [--program FILE] [--write]
                              the command where folders, disks, memory, threads, inputs fail it (500 runs): no panic, outputs
                              whole or as they were, nothing left behind; --write also writes docs/reliability.md
  estimates [--quick] [--program FILE] [--write]
                              what a dry run says of memory and time, beside what packings of every method take;
                              --quick packs the small ones, --write also writes docs/reliability.md
  reliability                 the long forms of random scenes, kills, faults, scene files, estimates; writes docs/reliability.md
                              (some hours)
  reproduce-paper [--quick] [--only SCENE] [--data DIR] [--write]
                              the figures of paper 001, published beside ours;
                              --quick leaves out the long runs,
                              --data names the folder with bunny.stl (default: data),
                              --write also writes docs/reproduction.md
  balanced [--quick] [--only SCENE] [--data DIR] [--write]
                              the balanced method against its bars; --write also writes docs/balanced.md
  compare [--quick] [--only SCENE] [--method NAME] [--data DIR] [--write]
          [--accelerations | --agitators | --interface | --gaps]
                              every method on every scene; one method's rows, printed; or one section alone: 001's
                              accelerations, 000's agitators, 004's interface, 004's gaps;
                              --data names the folder with 30p30n (default: data),
                              --write also writes docs/methods.md, or that section of it
  corpora --data DIR [--write]
                              public collections of body files, read and judged: DIR/airfoils/*.dat, DIR/icons/**/*.svg;
                              --write also writes docs/corpora.md
  lattices [--quick] [--write]
                              stability of every lattice, and packings from it; --write also writes docs/lattices.md
  speed [--quick] [--only SCENE] [--data DIR] [--write]
                              the whole job, how it grows, the pair loop against the machine; --write also writes
                              docs/speed.md
  bodies [--quick] [--only NAME] [--write]
                              bodies in parts at 40 spacings each, judged part by part; --write also writes
                              docs/bodies.md
  round-trip [--python PROGRAM | --install]
                              particle files of every format, read by numpy, pyvista and meshio;
                              --install puts these into target/round-trip/venv first
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let rest = arguments.get(1..).unwrap_or_default();
    let result = match arguments.first().map(String::as_str) {
        Some("ci") => ci::run(),
        Some("tidy") => tidy::run(&root()),
        Some("draw") => draw::Settings::parse(rest).and_then(draw::run),
        Some("fuzz") if rest.iter().any(|word| word == "--scenes") => {
            scene_fuzz::Settings::parse(rest).and_then(|s| scene_fuzz::run(&s))
        }
        Some("fuzz") if rest.iter().any(|word| word == "--scene-files") => {
            let settings = scene_fuzz::files::Settings::parse(rest);
            settings.and_then(|s| scene_fuzz::files::run(&s))
        }
        Some("fuzz") => fuzz::Settings::parse(rest).and_then(|s| fuzz::run(&s)),
        Some("kills") => {
            let settings = scene_fuzz::kills::Settings::parse(rest);
            settings.and_then(|s| scene_fuzz::kills::run(&s))
        }
        Some("faults") => {
            let settings = scene_fuzz::faults::Settings::parse(rest);
            settings.and_then(|s| scene_fuzz::faults::run(&s))
        }
        Some("estimates") => {
            let settings = scene_fuzz::estimates::Settings::parse(rest);
            settings.and_then(|s| scene_fuzz::estimates::run(&s))
        }
        Some("reliability") => reliability::run(),
        Some("reproduce-paper") => {
            reproduce::Settings::parse(rest).and_then(|s| reproduce::run(&s))
        }
        Some("balanced") => reproduce::Settings::parse(rest).and_then(|s| balanced::run(&s)),
        Some("compare") => reproduce::Settings::parse(rest).and_then(|s| compare::run(&s)),
        Some("corpora") => corpora::Settings::parse(rest).and_then(|s| corpora::run(&s)),
        Some("lattices") => reproduce::Settings::parse(rest).and_then(|s| lattices::run(&s)),
        Some("speed") => reproduce::Settings::parse(rest).and_then(|s| speed::run(&s)),
        Some("bodies") => bodies::Settings::parse(rest).and_then(|s| bodies::run(&s)),
        Some("round-trip") => round_trip::Settings::parse(rest).and_then(|s| round_trip::run(&s)),
        Some("help" | "--help" | "-h") => {
            print!("{USAGE}");
            Ok(())
        }
        other => Err(format!(
            "no task is called {:?}\n\n{USAGE}",
            other.unwrap_or_default()
        )),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// The workspace's folder.
fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}
