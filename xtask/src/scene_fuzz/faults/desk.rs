//! A folder for one run under a fault, and what is true of every run whatever the fault.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

use super::super::random::Random;

/// No run of these scenes takes longer, on a slow machine that does other work too.
const LONGEST: Duration = Duration::from_secs(180);

/// What was there before, whatever the format.
const OLD: &[u8] = b"what was there before\n";

const ENDINGS: [&str; 5] = ["csv", "npz", "vtu", "vtk", "ply"];

const SCENES: [&str; 3] = [
    "spacing = 0.1\n[domain]\nmin = [-2.0, -2.0]\nmax = [2.0, 2.0]\n[[body]]\nname = \"cylinder\"\nshape = { circle = { center = [0.0, 0.0], radius = 1.0 } }\n",
    "spacing = 0.05\n[domain]\nmin = [-1.5, -1.5]\nmax = [1.5, 1.5]\n[[body]]\nname = \"square\"\nshape = { box = { min = [-0.7, -0.7], max = [0.7, 0.7] } }\n",
    "spacing = 0.25\n[domain]\nmin = [-1.8, -1.8, -1.8]\nmax = [1.8, 1.8, 1.8]\n[[body]]\nname = \"ball\"\nshape = { sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 } }\n",
];

/// A scene, and what it comes to where nothing is in the way.
#[derive(Debug)]
pub(super) struct Reference {
    pub(super) scene: &'static str,
    pub(super) seconds: f64,
    files: BTreeMap<&'static str, Vec<u8>>,
}

impl Reference {
    /// Packs all scenes once.
    pub(super) fn all(program: &Path, scratch: &Path) -> Result<Vec<Self>, String> {
        let pack = |scene: &'static str| {
            let empty = Self {
                scene,
                seconds: 0.0,
                files: BTreeMap::new(),
            };
            let desk = Desk::new(program, scratch, &empty)?;
            let mut run = Run::new(&["pack", "scene.toml", "--threads", "1"]);
            for ending in ENDINGS {
                run.arguments
                    .extend(["-o".into(), format!("out.{ending}").into()]);
            }
            let ended = desk.run(run)?;
            if ended.code != Some(0) {
                return Err(format!("without any fault: {}", ended.errors));
            }
            let read = |ending| {
                let bytes = fs::read(desk.folder.join(format!("out.{ending}")));
                bytes.map(|bytes| (ending, bytes))
            };
            let files = ENDINGS.into_iter().map(read).collect::<io::Result<_>>();
            let files = files.map_err(|error| error.to_string())?;
            let seconds = ended.seconds;
            desk.clear();
            Ok(Self {
                scene,
                seconds,
                files,
            })
        };
        SCENES.into_iter().map(pack).collect()
    }

    /// Whether a file is what it should be; reports tell times, and must only be whole.
    fn is_new(&self, path: &Path) -> bool {
        let Ok(bytes) = fs::read(path) else {
            return false;
        };
        let ending = path.extension().and_then(|ending| ending.to_str());
        match ending {
            Some("json") => serde_json::from_slice::<serde_json::Value>(&bytes).is_ok(),
            Some(ending) => self.files.get(ending).is_some_and(|new| *new == bytes),
            None => false,
        }
    }
}

/// Where the command's standard output goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum To {
    File,
    Full,
    Nobody,
}

/// A run to be made.
#[derive(Debug)]
pub(super) struct Run {
    pub(super) arguments: Vec<OsString>,
    /// Words of a shell that come before it, limits for example.
    pub(super) before: String,
    pub(super) to: To,
    /// As a user who may not write everywhere.
    pub(super) as_nobody: bool,
}

impl Run {
    pub(super) fn new(words: &[&str]) -> Self {
        Self {
            arguments: words.iter().map(OsString::from).collect(),
            before: String::new(),
            to: To::File,
            as_nobody: false,
        }
    }

    /// The desk's scene to these outputs, whatever is there before.
    pub(super) fn pack(outputs: &[Output]) -> Self {
        let mut run = Self::new(&["pack", "scene.toml", "--threads", "1", "--force"]);
        for output in outputs {
            let option = if output.is_report() { "--report" } else { "-o" };
            run.arguments
                .extend([option.into(), output.name.clone().into()]);
        }
        run
    }

    pub(super) fn with(mut self, words: &[&str]) -> Self {
        self.arguments.extend(words.iter().map(OsString::from));
        self
    }

    pub(super) fn limited(mut self, before: String) -> Self {
        self.before = before;
        self
    }
}

/// How a run ended.
#[derive(Debug)]
pub(super) struct Ended {
    /// `None`: by a signal.
    pub(super) code: Option<i32>,
    pub(super) seconds: f64,
    pub(super) output: String,
    pub(super) errors: String,
    /// It did not end, and was killed.
    pub(super) hangs: bool,
}

impl Ended {
    /// What no fault excuses.
    pub(super) fn is_decent(&self) -> Result<(), String> {
        let Self { code, errors, .. } = self;
        if self.hangs {
            return Err(format!("it hangs: {errors}"));
        }
        for words in [
            "panicked",
            "memory allocation of",
            "RUST_BACKTRACE",
            "overflowed its stack",
        ] {
            if errors.contains(words) {
                return Err(format!("status {code:?}: {errors}"));
            }
        }
        match code {
            None => Err(format!("ended by a signal: {errors}")),
            Some(0 | 3 | 130) => Ok(()),
            Some(1 | 2) => {
                let says_why = errors.lines().any(|line| {
                    (line.starts_with("sphpack: ") && !line.starts_with("sphpack: warning"))
                        || line.starts_with("error: ")
                });
                if says_why {
                    Ok(())
                } else {
                    Err(format!("status {code:?} without a word why: {errors}"))
                }
            }
            Some(_) => Err(format!("status {code:?}: {errors}")),
        }
    }

    /// Refused with these words.
    pub(super) fn refused(&self, words: &[&str]) -> Result<(), String> {
        if self.code != Some(2) {
            return Err(format!(
                "status {:?}, not refused: {}",
                self.code, self.errors
            ));
        }
        match words.iter().find(|part| !self.errors.contains(**part)) {
            None => Ok(()),
            Some(part) => Err(format!("no word of \"{part}\": {}", self.errors)),
        }
    }

    /// The names after "kept as".
    pub(super) fn kept(&self) -> Vec<PathBuf> {
        let line = self
            .errors
            .lines()
            .find_map(|line| line.split_once("kept as "));
        let names = line.and_then(|(_, rest)| rest.split(';').next());
        let names = names.unwrap_or_default().split(", ");
        names
            .filter(|name| !name.is_empty())
            .map(PathBuf::from)
            .collect()
    }
}

/// A file that is asked for.
#[derive(Debug, Clone)]
pub(super) struct Output {
    pub(super) name: String,
    /// Whether there is another of the name before.
    pub(super) had_old: bool,
}

impl Output {
    pub(super) fn is_report(&self) -> bool {
        self.name.ends_with(".json")
    }
}

/// Where a run is made: its folder, and one aside for temporary files and what is said.
#[derive(Debug)]
pub(super) struct Desk<'a> {
    program: &'a Path,
    pub(super) reference: &'a Reference,
    pub(super) folder: PathBuf,
    pub(super) aside: PathBuf,
}

impl<'a> Desk<'a> {
    pub(super) fn new(
        program: &'a Path,
        scratch: &Path,
        reference: &'a Reference,
    ) -> Result<Self, String> {
        let desk = Self {
            program,
            reference,
            folder: scratch.join("desk"),
            aside: scratch.join("aside"),
        };
        desk.clear();
        for folder in [&desk.folder, &desk.aside.join("tmp")] {
            fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        }
        desk.put("scene.toml", reference.scene)?;
        Ok(desk)
    }

    pub(super) fn clear(&self) {
        for folder in [&self.folder, &self.aside] {
            let _ = fs::remove_dir_all(folder);
        }
    }

    pub(super) fn put(&self, name: &str, bytes: impl AsRef<[u8]>) -> Result<(), String> {
        fs::write(self.folder.join(name), bytes).map_err(|error| format!("{name}: {error}"))
    }

    /// Up to three particle files and often a report, some of them there before.
    pub(super) fn outputs(&self, folder: &str, random: &mut Random) -> Result<Vec<Output>, String> {
        let mut outputs = Vec::new();
        for number in 0..random.whole(1, 3) {
            let ending = ENDINGS[random.below(ENDINGS.len())];
            outputs.push(format!("{folder}out{number}.{ending}"));
        }
        if random.chance(0.5) {
            outputs.push(format!("{folder}out.json"));
        }
        let make = |name: String| {
            let had_old = random.chance(0.5);
            if had_old {
                self.put(&name, OLD)?;
            }
            Ok(Output { name, had_old })
        };
        outputs.into_iter().map(make).collect()
    }

    /// Starts a run; standard error goes to a file.
    pub(super) fn start(&self, run: &Run) -> Result<Child, String> {
        let create = |name: &str| {
            let path = self.aside.join(name);
            File::create(&path).map_err(|error| format!("{}: {error}", path.display()))
        };
        let mut line: Vec<OsString> = Vec::new();
        if run.as_nobody {
            let words = [
                "setpriv",
                "--reuid",
                "65534",
                "--regid",
                "65534",
                "--clear-groups",
            ];
            line.extend(words.map(OsString::from));
        }
        line.push(self.program.into());
        line.extend(run.arguments.iter().cloned());
        let to = match run.to {
            To::File => Stdio::from(create("stdout.txt")?),
            To::Full => {
                let full = File::options().write(true).open("/dev/full");
                full.map_err(|error| format!("/dev/full: {error}"))?.into()
            }
            To::Nobody => {
                let (reader, writer) = io::pipe().map_err(|error| error.to_string())?;
                drop(reader);
                writer.into()
            }
        };
        let before = if run.before.is_empty() {
            ":"
        } else {
            &run.before
        };
        Command::new("sh")
            .arg("-c")
            .arg(format!("{before} && exec \"$0\" \"$@\""))
            .args(line)
            .current_dir(&self.folder)
            .env("TMPDIR", self.aside.join("tmp"))
            .env("RUST_BACKTRACE", "0")
            .stdin(Stdio::null())
            .stdout(to)
            .stderr(create("stderr.txt")?)
            .spawn()
            .map_err(|error| format!("sh cannot be started: {error}"))
    }

    /// Waits for the end of a run.
    pub(super) fn wait(&self, mut child: Child) -> Result<Ended, String> {
        let begin = Instant::now();
        let mut hangs = false;
        let status = loop {
            if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
                break status;
            }
            if begin.elapsed() > LONGEST {
                hangs = true;
                child.kill().map_err(|error| error.to_string())?;
                break child.wait().map_err(|error| error.to_string())?;
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        let text = |name: &str| {
            let bytes = fs::read(self.aside.join(name)).unwrap_or_default();
            String::from_utf8_lossy(&bytes).into_owned()
        };
        Ok(Ended {
            code: status.code(),
            seconds: begin.elapsed().as_secs_f64(),
            output: text("stdout.txt"),
            errors: text("stderr.txt"),
            hangs,
        })
    }

    /// Makes a run to its end.
    pub(super) fn run(&self, run: Run) -> Result<Ended, String> {
        self.wait(self.start(&run)?)
    }

    /// Hidden files, which no run may leave.
    pub(super) fn hidden(&self, folder: &str) -> Vec<PathBuf> {
        let places = [
            self.folder.join(folder),
            self.folder.clone(),
            self.aside.join("tmp"),
        ];
        let mut found: Vec<PathBuf> = places
            .iter()
            .flat_map(fs::read_dir)
            .flatten()
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                name.starts_with(".sphpack-")
            })
            .collect();
        found.sort();
        found.dedup();
        found
    }

    /// Makes what a killed run left, in a folder too, look so old that the next one cleans it.
    pub(super) fn age(&self, folder: &str) -> Result<(), String> {
        for path in self.hidden(folder) {
            let file = File::options().append(true).open(&path);
            file.and_then(|file| file.set_modified(SystemTime::now() - Duration::from_secs(120)))
                .map_err(|error| format!("{}: {error}", path.display()))?;
        }
        Ok(())
    }

    /// Whether a file is as it was, or not there as before.
    pub(super) fn is_old(&self, output: &Output) -> bool {
        let path = self.folder.join(&output.name);
        if output.had_old {
            fs::read(path).is_ok_and(|bytes| bytes == OLD)
        } else {
            fs::symlink_metadata(path).is_err()
        }
    }

    /// Whether a file is what the scene comes to.
    pub(super) fn is_new(&self, path: &Path) -> bool {
        self.reference.is_new(path)
    }

    /// Judges a set of outputs: all new where the run says so, else all as before; and what is kept is whole.
    pub(super) fn set(&self, outputs: &[Output], ended: &Ended) -> Result<(), String> {
        ended.is_decent()?;
        let is_done = matches!(ended.code, Some(0 | 3));
        for output in outputs {
            let path = self.folder.join(&output.name);
            let name = &output.name;
            if is_done {
                if !self.reference.is_new(&path) {
                    return Err(format!(
                        "status {:?}, but {name} is not what it should be",
                        ended.code
                    ));
                }
            } else if !self.is_old(output) {
                let before = if output.had_old {
                    "it was"
                } else {
                    "before, not there"
                };
                return Err(format!("{name} is not as {before}: {}", ended.errors));
            }
        }
        for name in ended.kept() {
            // Relative names are those of the desk.
            if !self.reference.is_new(&self.folder.join(&name)) {
                return Err(format!("{} is not whole: {}", name.display(), ended.errors));
            }
        }
        match self.hidden("").first() {
            Some(left)
                if !ended
                    .errors
                    .contains(&*left.file_name().unwrap_or_default().to_string_lossy()) =>
            {
                Err(format!("left behind: {}: {}", left.display(), ended.errors))
            }
            _ => Ok(()),
        }
    }

    /// Whether the run was after what was computed; then it must be kept.
    pub(super) fn is_kept(&self, ended: &Ended) -> Result<(), String> {
        if ended.code == Some(1) && ended.errors.contains("cannot write") && ended.kept().is_empty()
        {
            return Err(format!("nothing is kept: {}", ended.errors));
        }
        Ok(())
    }

    /// Whether runs can be made as another user, who may not write everywhere.
    pub(super) fn has_nobody(&self) -> bool {
        let run = Run {
            as_nobody: true,
            ..Run::new(&["--version"])
        };
        self.run(run).is_ok_and(|ended| ended.code == Some(0))
    }
}
