//! Every task: its name, what it knows, what it does.

use crate::arguments::Arguments;
use crate::scene_fuzz::{self, estimates, faults, files, kills, maps};
use crate::selection::Selection;
use crate::workspace::root;
use crate::{
    balanced, bodies, ci, compare, corpora, draw, flow, front, fuzz, guide, lattices, python,
    reliability, reproduction, round_trip, speed, stability, steady, tidy, variable, view,
};

/// What is left to do once the arguments are read.
type Job = Box<dyn FnOnce() -> Result<(), String>>;

/// One task, or one form of a task.
pub(crate) struct Task {
    /// As it is called; of a form that has a flag of its own, `fuzz --scenes`, with the flag.
    name: &'static str,
    /// Its flags, as [`Arguments`] reads them.
    known: &'static [&'static str],
    /// What it does, line by line.
    about: &'static [&'static str],
    read: fn(&Arguments) -> Result<Job, String>,
}

/// In the order of the usage; of one name the forms with flags come first.
pub(crate) const TASKS: [Task; 27] = [
    Task {
        name: "ci",
        known: &[],
        about: &["everything that a change must pass"],
        read: |_| Ok(Box::new(ci::run)),
    },
    Task {
        name: "tidy",
        known: &[],
        about: &["house rules: crate graph, file sizes, names, lints"],
        read: |_| Ok(Box::new(|| tidy::run(&root()))),
    },
    Task {
        name: "python",
        known: python::Settings::KNOWN,
        about: &[
            "builds the Python package and runs its tests, where there is a Python;",
            "--wheel as users get it: a wheel in target/python/wheels, tried in an environment of its own",
        ],
        read: |given| {
            let settings = python::Settings::of(given);
            Ok(Box::new(move || python::run(settings)))
        },
    },
    Task {
        name: "draw",
        known: draw::Settings::KNOWN,
        about: &["property tests on new cases, a hundred times as many as cargo test"],
        read: |given| {
            let settings = draw::Settings::of(given)?;
            Ok(Box::new(move || draw::run(settings)))
        },
    },
    Task {
        name: "fuzz --scenes",
        known: scene_fuzz::Settings::KNOWN,
        about: &[
            "random scenes, packed by the command and judged by brute force;",
            "--number runs and shows one of them alone,",
            "--program names the command, where it is not to be built,",
            "--write also writes docs/reliability.md",
        ],
        read: |given| {
            let settings = scene_fuzz::Settings::of(given)?;
            Ok(Box::new(move || scene_fuzz::run(&settings)))
        },
    },
    Task {
        name: "fuzz --scene-files",
        known: files::Settings::KNOWN,
        about: &[
            "damaged scene files for the parser and the plan, in process; 100000 is the long form,",
            "--write also writes docs/reliability.md",
        ],
        read: |given| {
            let settings = files::Settings::of(given)?;
            Ok(Box::new(move || files::run(&settings)))
        },
    },
    Task {
        name: "fuzz",
        known: fuzz::Settings::KNOWN,
        about: &[
            "damaged files (a million) for every reader of bodies: stl, obj, ply, csv, dat, svg",
        ],
        read: |given| {
            let settings = fuzz::Settings::of(given)?;
            Ok(Box::new(move || fuzz::run(&settings)))
        },
    },
    Task {
        name: "kills",
        known: kills::Settings::KNOWN,
        about: &[
            "runs of random scenes, killed N times (200) and resumed: they must come to the same bytes;",
            "--write also writes docs/reliability.md",
        ],
        read: |given| {
            let settings = kills::Settings::of(given)?;
            Ok(Box::new(move || kills::run(&settings)))
        },
    },
    Task {
        name: "faults",
        known: faults::Settings::KNOWN,
        about: &[
            "the command where folders, disks, memory, threads, inputs fail it (500 runs): no panic, outputs",
            "whole or as they were, nothing left behind; --write also writes docs/reliability.md",
        ],
        read: |given| {
            let settings = faults::Settings::of(given)?;
            Ok(Box::new(move || faults::run(&settings)))
        },
    },
    Task {
        name: "estimates",
        known: estimates::Settings::KNOWN,
        about: &[
            "what a dry run says of memory and time, beside what packings of every method take;",
            "--quick packs the small ones, --write also writes docs/reliability.md",
        ],
        read: |given| {
            let settings = estimates::Settings::of(given)?;
            Ok(Box::new(move || estimates::run(&settings)))
        },
    },
    Task {
        name: "reliability",
        known: &[],
        about: &[
            "the long forms of random scenes, kills, faults, scene files, estimates; writes docs/reliability.md",
            "(some hours)",
        ],
        read: |_| Ok(Box::new(reliability::run)),
    },
    Task {
        name: "reproduce-paper",
        known: reproduction::Settings::KNOWN,
        about: &[
            "the papers' figures of packings, published beside ours, into target/reproduction (index.html, summary.json,",
            "rows.csv); goes on where it was stopped;",
            "a number (docs/papers.md) and --only name one paper and one figure (fig13),",
            "--quick leaves out the long runs, --fine adds the longest (rabbits at the papers' ∆s),",
            "--data names the folder with bunny.stl (default: data),",
            "--write also writes docs/reproduction.md",
        ],
        read: |given| {
            let settings = reproduction::Settings::of(given)?;
            Ok(Box::new(move || reproduction::run(&settings)))
        },
    },
    Task {
        name: "balanced",
        known: Selection::KNOWN,
        about: &["the balanced method against its bars; --write also writes docs/balanced.md"],
        read: |given| {
            let selection = Selection::of(given)?;
            Ok(Box::new(move || balanced::run(&selection)))
        },
    },
    Task {
        name: "variable",
        known: Selection::KNOWN,
        about: &["variable spacing, row by row, against its bars (docs/variable.md with --write)"],
        read: |given| {
            let selection = Selection::of(given)?;
            Ok(Box::new(move || variable::run(&selection)))
        },
    },
    Task {
        name: "compare",
        known: compare::Settings::KNOWN,
        about: &[
            "every method on every scene; one method's rows, printed; or one section alone: 001's",
            "accelerations, 000's agitators, 004's interface, 004's gaps;",
            "--data names the folder with 30p30n (default: data),",
            "--write also writes docs/methods.md, or that section of it",
        ],
        read: |given| {
            let settings = compare::Settings::of(given)?;
            Ok(Box::new(move || compare::run(&settings)))
        },
    },
    Task {
        name: "chart",
        known: front::Settings::KNOWN,
        about: &[
            "speed against accuracy: every method, and one setting of the default at a time, into target/chart (index.html,",
            "points.csv, pictures); goes on where it was stopped; --quick packs a few points of one scene,",
            "--data names the folder with bunny.stl, which is left out without,",
            "--one packs the scene in a file, as the chart has it done in a process of its own,",
            "--advice packs only what may be advised, and writes no page, --known packs nothing and takes what there is,",
            "--write also writes docs/chart.md and the table that method = \"auto\" picks from, cli/accuracy.toml",
        ],
        read: |given| {
            let settings = front::Settings::of(given)?;
            Ok(Box::new(move || front::run(&settings)))
        },
    },
    Task {
        name: "corpora",
        known: corpora::Settings::KNOWN,
        about: &[
            "public collections of body files, read and judged: DIR/airfoils/*.dat, DIR/icons/**/*.svg;",
            "it needs --data; --write also writes docs/corpora.md",
        ],
        read: |given| {
            let settings = corpora::Settings::of(given)?;
            Ok(Box::new(move || corpora::run(&settings)))
        },
    },
    Task {
        name: "lattices",
        known: lattices::KNOWN,
        about: &[
            "stability of every lattice, and packings from it; --write also writes docs/lattices.md",
        ],
        read: |given| {
            let selection = lattices::selection(given);
            Ok(Box::new(move || lattices::run(&selection)))
        },
    },
    Task {
        name: "stability lattice",
        known: stability::Settings::KNOWN,
        about: &[
            "which lattices stay with which kernel and h/∆s, confirmed by time evolution; pairs; time steps;",
            "--quick runs a few cases, --write also writes docs/stability.md",
        ],
        read: |given| {
            let settings = stability::Settings::of(given)?;
            Ok(Box::new(move || stability::run(&settings)))
        },
    },
    Task {
        name: "stability map",
        known: maps::Settings::KNOWN,
        about: &[
            "where methods fail: grids of scenes, packed by the command and judged by brute force, one map or all;",
            "goes on where it was stopped; --method makes those of one method, --quick the pinned cells only,",
            "--program names the command, where it is not to be built, --write also writes docs/failure-maps.md",
        ],
        read: |given| {
            let settings = maps::Settings::of(given)?;
            Ok(Box::new(move || maps::run(&settings)))
        },
    },
    Task {
        name: "stability steady",
        known: steady::Settings::KNOWN,
        about: &[
            "what should not matter: the lattice's offset and turn, seed, units; every kernel beside what it leaves",
            "without a body; --quick packs a few, --write also writes docs/steady.md",
        ],
        read: |given| {
            let settings = steady::Settings::of(given)?;
            Ok(Box::new(move || steady::run(&settings)))
        },
    },
    Task {
        name: "speed",
        known: Selection::KNOWN,
        about: &[
            "the whole job, how it grows, the pair loop against the machine; --write also writes",
            "docs/speed.md",
        ],
        read: |given| {
            let selection = Selection::of(given)?;
            Ok(Box::new(move || speed::run(&selection)))
        },
    },
    Task {
        name: "flow",
        known: flow::Settings::KNOWN,
        about: &[
            "flows from packings: vortices, a shaft, a cylinder, an airfoil, a drop, a tank, each against its bars, and what the packing changes; one",
            "case or all; runs are kept; --quick has the small ones, --write also writes docs/flow.md",
        ],
        read: |given| {
            let settings = flow::Settings::of(given)?;
            Ok(Box::new(move || flow::run(&settings)))
        },
    },
    Task {
        name: "bodies",
        known: bodies::Settings::KNOWN,
        about: &[
            "bodies in parts at 40 spacings each, judged part by part; --write also writes",
            "docs/bodies.md",
        ],
        read: |given| {
            let settings = bodies::Settings::of(given)?;
            Ok(Box::new(move || bodies::run(&settings)))
        },
    },
    Task {
        name: "guide",
        known: guide::Settings::KNOWN,
        about: &[
            "runs every command of docs/guide, looks that every key and column is told, and makes a site of it in",
            "target/guide where mdBook is; --program names the command, where it is not to be built",
        ],
        read: |given| {
            let settings = guide::Settings::of(given);
            Ok(Box::new(move || guide::run(&settings)))
        },
    },
    Task {
        name: "round-trip",
        known: round_trip::Settings::KNOWN,
        about: &[
            "particle files of every format, read by numpy, pyvista, meshio, ovito and splashsurf;",
            "--install puts these into target/round-trip/venv first",
        ],
        read: |given| {
            let settings = round_trip::Settings::of(given)?;
            Ok(Box::new(move || round_trip::run(&settings)))
        },
    },
    Task {
        name: "view",
        known: view::Settings::KNOWN,
        about: &[
            "pages of sphpack view in a Chromium, where there is one: what they say and what is seen, judged by pixels, into",
            "target/view; a real body and a million particles, timed, too, which --quick leaves out",
        ],
        read: |given| {
            let settings = view::Settings::of(given);
            Ok(Box::new(move || view::run(&settings)))
        },
    },
];

impl Task {
    /// The name, and the flag of its form where it has one.
    fn called(&self) -> (&'static str, Option<&'static str>) {
        match self.name.split_once(' ') {
            Some((name, form)) => (name, Some(form)),
            None => (self.name, None),
        }
    }

    /// Its lines of the usage.
    fn usage(&self) -> String {
        let (name, form) = self.called();
        let mut head = format!("  {name}");
        for flag in self.known {
            let is_form = form.is_some_and(|form| flag.split(' ').next() == Some(form));
            head += &if is_form {
                format!(" {flag}")
            } else {
                format!(" [{flag}]")
            };
        }
        let about = self.about.iter().map(|line| format!("      {line}\n"));
        format!("{head}\n{}", about.collect::<String>())
    }
}

/// What can be typed.
pub(crate) fn usage() -> String {
    let tasks: Vec<String> = TASKS.iter().map(Task::usage).collect();
    format!("cargo xtask TASK\n\n{}", tasks.concat())
}

/// What the words ask for, not yet begun.
pub(crate) fn job(words: &[String]) -> Result<Job, String> {
    let name = words.first().map_or("", String::as_str);
    let rest = words.get(1..).unwrap_or_default();
    let is_asked = |task: &&Task| {
        let (called, form) = task.called();
        called == name && form.is_none_or(|form| rest.iter().any(|word| word == form))
    };
    let task = (TASKS.iter().find(is_asked))
        .ok_or_else(|| format!("no task is called {name:?}\n\n{}", usage()))?;
    (task.read)(&Arguments::read(task.name, task.known, rest)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split_whitespace().map(str::to_owned).collect()
    }

    /// What a task says to a line; nothing where it would run.
    fn said(line: &str) -> Option<String> {
        job(&words(line)).err()
    }

    /// The least that a task, or a form of one, runs with.
    fn least(task: &Task) -> String {
        let takes_a_value = |form| {
            task.known
                .iter()
                .any(|flag| flag.starts_with(&format!("{form} ")))
        };
        let of_form = match task.called() {
            (_, Some(form)) if takes_a_value(form) => " 7",
            _ => "",
        };
        let needed = if task.name == "corpora" {
            " --data here"
        } else {
            ""
        };
        format!("{}{of_form}{needed}", task.name)
    }

    #[test]
    fn an_unknown_word_is_answered_by_the_task_that_was_called() {
        for task in &TASKS {
            let knows = match task.known.join(", ") {
                all if all.is_empty() => "it takes no arguments".to_owned(),
                all => format!("it knows {all}"),
            };
            for word in ["--foo", "starfish"] {
                assert_eq!(
                    said(&format!("{} {word}", least(task))),
                    Some(format!(
                        "cargo xtask {} does not know {word}; {knows}",
                        task.name
                    ))
                );
            }
        }
        let balanced = said("balanced --foo").expect("an answer");
        assert!(
            balanced.starts_with("cargo xtask balanced does not know --foo"),
            "{balanced}"
        );
        let none = said("pakc").expect("an answer");
        assert!(none.starts_with("no task is called \"pakc\""), "{none}");
    }

    #[test]
    fn every_task_takes_what_it_knows_and_asks_for_nothing_else() {
        for task in &TASKS {
            assert_eq!(said(&least(task)), None, "{}", task.name);
            for flag in task.known {
                let given = match flag.split_once(' ') {
                    None if flag.contains('|') => flag.split('|').next().unwrap().to_owned(),
                    Some((flag, "N")) => format!("{flag} 7"),
                    Some((flag, _)) => format!("{flag} here"),
                    None => (*flag).to_owned(),
                };
                assert_eq!(said(&format!("{} {given}", least(task))), None, "{flag}");
                if let Some((flag, what)) = flag.split_once(' ') {
                    let missing = said(&format!("{} {flag}", least(task)));
                    let expected =
                        format!("cargo xtask {}: {flag} needs a value, {what}", task.name);
                    assert_eq!(missing, Some(expected));
                    if what == "N" {
                        let wrong = said(&format!("{} {flag} x", least(task)));
                        let expected = format!("{flag} is x; it must be a whole number");
                        assert_eq!(wrong, Some(expected));
                    }
                }
            }
        }
    }

    #[test]
    fn what_does_not_go_together_is_refused() {
        for line in [
            "balanced --write --only starfish",
            "compare --write --method hybrid",
            "round-trip --install --python python3",
            "corpora --write",
        ] {
            assert!(said(line).is_some(), "{line}");
        }
    }

    #[test]
    fn the_usage_names_every_task_with_all_that_it_knows() {
        let usage = usage();
        for task in &TASKS {
            let (name, form) = task.called();
            let head = format!("\n  {name}");
            let mut lines = usage
                .split(&head)
                .skip(1)
                .filter_map(|rest| rest.lines().next());
            let all = |line: &str| task.known.iter().all(|flag| line.contains(flag));
            assert!(lines.any(all), "{name} {form:?}");
        }
    }
}
