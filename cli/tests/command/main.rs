//! The command as a person runs it: what it writes, what it refuses, and how it ends.

mod accuracy;
mod bad_bodies;
mod bad_outputs;
mod bad_scenes;
mod body_formats;
mod checking;
mod checkpoints;
mod dirty_formats;
mod dirty_meshes;
mod file_sets;
mod good_runs;
mod graded;
mod hydrostatics;
mod interrupts;
mod limits;
mod measuring;
mod other_words;
mod particle_files;
mod precedence;
mod rigid;
mod sides;
mod solver_files;
mod sound;
mod surroundings;
mod touching_shells;
mod viewing;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// A folder of its own for a test, with the command run in it.
struct Desk {
    folder: TempDir,
}

/// How a run ended.
#[derive(Debug)]
struct Ending {
    status: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Desk {
    fn new() -> Self {
        Self {
            folder: tempfile::tempdir().expect("a folder for the test"),
        }
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Puts a file on the desk.
    fn with(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        fs::write(self.path().join(name), content).expect("a file of the test");
        self
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Names of the files on the desk, hidden ones too, sorted.
    fn files(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.path())
            .expect("the test's folder")
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sphpack"));
        command
            .args(arguments)
            .current_dir(self.path())
            .stdin(Stdio::null());
        command
    }

    fn run(&self, arguments: &[&str]) -> Ending {
        let output = self
            .command(arguments)
            .output()
            .expect("the command starts");
        Ending {
            status: output.status.code(),
            stdout: String::from_utf8(output.stdout).expect("text"),
            stderr: String::from_utf8(output.stderr).expect("text"),
        }
    }

    /// Runs what must succeed.
    #[track_caller]
    fn succeed(&self, arguments: &[&str]) -> Ending {
        let ending = self.run(arguments);
        assert_eq!(ending.status, Some(0), "{arguments:?}: {}", ending.stderr);
        ending
    }

    /// Runs what must be refused: status 2, one message with every part, nothing written.
    #[track_caller]
    fn refuse(&self, arguments: &[&str], parts: &[&str]) {
        let before = self.files();
        let ending = self.run(arguments);
        assert_eq!(ending.status, Some(2), "{arguments:?}: {ending:?}");
        assert_eq!(ending.stdout, "", "{arguments:?}");
        assert!(
            ending
                .stderr
                .lines()
                .any(|line| line.starts_with("sphpack: ")),
            "{}",
            ending.stderr
        );
        assert!(!ending.stderr.contains("panicked"), "{}", ending.stderr);
        for part in parts {
            assert!(
                ending.stderr.contains(part),
                "{arguments:?}: {} lacks \"{part}\"",
                ending.stderr
            );
        }
        assert_eq!(self.files(), before, "{arguments:?} left something behind");
    }
}

/// A small cylinder that is packed in a moment.
const CYLINDER: &str = "\
spacing = 0.2
[domain]
min = [-2.0, -2.0]
max = [2.0, 2.0]
[[body]]
name = \"cylinder\"
shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
[packing]
velocity_tolerance = 1e-3
";

/// The corners of the unit cube's triangles, facing out.
fn cube() -> Vec<[[f32; 3]; 3]> {
    let corner = |k: usize| [(k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2 & 1) as f32];
    [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ]
    .iter()
    .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
    .map(|triangle| triangle.map(corner))
    .collect()
}

/// A binary STL file.
fn stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        for x in triangle.as_flattened() {
            bytes.extend(x.to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// A text STL file.
fn text_stl(triangles: &[[[f32; 3]; 3]]) -> String {
    let mut text = "solid cube\n".to_owned();
    for triangle in triangles {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in triangle {
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid cube\n"
}
