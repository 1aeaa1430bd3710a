//! Writes particles in every format and has them read by others: NumPy, pyvista, meshio, OVITO, splashsurf.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

use sphpack::files::{PARTICLE_FORMATS, SOLVER_FORMATS, save};
use sphpack::{Options, Scene, run as pack};
use sphpack_packing::Silent;

use crate::arguments::Arguments;
use crate::environment::{environment, said};
use crate::workspace::root;

/// What the script needs besides Python.
const PACKAGES: [&str; 5] = ["numpy", "pyvista", "meshio", "ovito", "pysplashsurf"];

/// Bodies of several densities and awkward names, one with a wall alone.
const SCENES: [(&str, &str); 2] = [
    (
        "plane",
        "\
spacing = 0.1
[domain]
min = [-2, -1]
max = [2, 1]
periodic = [true, false]
[[body]]
name = \"left; 'wing', \\\"öl\\\" & <Ω> 翼, which is more than sixty-four bytes long\"
density = 2.5
shape = { circle = { center = [-1, 0], radius = 0.5 } }
[[body]]
name = \"second\"
density = 0.125
shape = { box = { min = [0.5, -0.5], max = [1.5, 0.5] } }
[output]
include = [\"free\", \"boundary\", \"fixed\"]
",
    ),
    (
        "space",
        "\
spacing = 0.15
[domain]
min = [-0.75, -0.75, -0.75]
max = [0.75, 0.75, 0.75]
[[body]]
name = \" kugel #1 \"
density = 7.8
shape = { sphere = { center = [0, 0, 0], radius = 0.45 } }
",
    ),
];

/// What to run.
#[derive(Debug, Default)]
pub(crate) struct Settings {
    /// The interpreter.
    python: Option<PathBuf>,
    /// Make an environment with the packages first.
    install: bool,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--python PROGRAM", "--install"];

    pub(crate) fn of(arguments: &Arguments) -> Result<Self, String> {
        let settings = Self {
            python: arguments.path("--python"),
            install: arguments.has("--install"),
        };
        if settings.install && settings.python.is_some() {
            return Err("--install makes an environment of its own: leave --python out".to_owned());
        }
        Ok(settings)
    }
}

/// Packs, writes, and compares what others read with the CSV files, bit for bit.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let folder = root().join("target/round-trip");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let python = python(settings, &folder)?;
    for (name, text) in SCENES {
        write(name, text, &folder)?;
    }
    let script = root().join("xtask/round_trip.py");
    let mut command = Command::new(&python);
    command.arg(script).arg(&folder);
    said(&mut command)
}

/// An interpreter that has the packages.
fn python(settings: &Settings, folder: &Path) -> Result<PathBuf, String> {
    let home = folder.join("venv");
    let own = ["bin/python", "Scripts/python.exe"].map(|program| home.join(program));
    let there = || own.iter().find(|program| program.is_file()).cloned();
    if settings.install {
        let made = environment(Path::new("python3"), &home, &PACKAGES)?;
        return made.ok_or_else(|| "the packages cannot be had".to_owned());
    }
    let python = (settings.python.clone())
        .or_else(there)
        .unwrap_or_else(|| "python3".into());
    let lacks = |package: &&str| {
        Command::new(&python)
            .args(["-c", &format!("import {package}")])
            .output()
            .map(|output| !output.status.success())
    };
    let mut missing = Vec::new();
    for package in &PACKAGES {
        match lacks(package) {
            Ok(true) => missing.push(*package),
            Ok(false) => {}
            Err(error) => {
                return Err(format!(
                    "{} cannot be run ({error}); name a Python with --python PROGRAM",
                    python.display()
                ));
            }
        }
    }
    if missing.is_empty() {
        return Ok(python);
    }
    Err(format!(
        "{} lacks {}; name another with --python PROGRAM, or let --install put them into {}",
        python.display(),
        missing.join(", "),
        home.display()
    ))
}

fn write(name: &str, text: &str, folder: &Path) -> Result<(), String> {
    let scene = Scene::parse(text, Path::new(name)).map_err(|error| error.to_string())?;
    let outcome =
        pack(&scene, &Options::default(), &mut Silent).map_err(|error| error.to_string())?;
    let rows = (outcome.table).filtered(|i| scene.includes(outcome.table.kind[i]));
    for (format, ending) in PARTICLE_FORMATS {
        let path = folder.join(format!("{name}.{ending}"));
        let attempt = || {
            let mut to = BufWriter::new(File::create(&path)?);
            format.write(&rows, &mut to)?;
            to.flush()
        };
        attempt().map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let mut rows = rows;
    // DualSPHysics knows no such box, and the others do not say it.
    rows.shared.periodic = [false; 3];
    let all = SOLVER_FORMATS.map(|(_, ending)| match ending {
        // Not the file beside DualSPHysics's.
        "xml" => format!("{name}-reload.xml"),
        ending => format!("{name}.{ending}"),
    });
    // Its name is the fluid's in every scene.
    let of_fluid = folder.join(name);
    fs::create_dir_all(&of_fluid).map_err(|error| error.to_string())?;
    let all = all.into_iter().map(|file| folder.join(file));
    for path in all.chain([of_fluid.join("fluid_rld.xml")]) {
        save(&rows, &path, true).map_err(|error| error.to_string())?;
    }
    println!("{name}: {} particles", rows.len());
    Ok(())
}
