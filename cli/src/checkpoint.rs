//! Checkpoint files: the state of a packing, and what it is a state of.

use std::fmt;
use std::io::{self, BufWriter, Read, Write};
use std::path::Path;

use flate2::Crc;
use serde_json::Value;

use crate::Error;
use crate::files::{open, read_whole};
use crate::scene::Scene;

/// How every checkpoint begins, and the number of the format.
const MAGIC: &[u8; 20] = b"sphpack checkpoint\n\0";
const FORMAT: u32 = 1;

/// The program that goes on must be the one that began: another one may sum in another order.
const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// All that decides what particles a scene ends with.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fingerprint {
    /// The scene as JSON, defaults filled in, without what is only written.
    scene: String,
    /// Name, size and checksum of every file that it names.
    files: Vec<(String, u64, u32)>,
}

impl Fingerprint {
    /// Of a scene and its files as they are now, which are read once.
    ///
    /// # Errors
    /// [`Error::Input`] where one cannot be read.
    pub(crate) fn of(scene: &Scene) -> Result<Self, Error> {
        let mut plain = scene.clone();
        plain.output = Default::default();
        let text = serde_json::to_string(&plain)
            .map_err(|e| Error::System(format!("the scene cannot be put into words: {e}")))?;
        let files = scene.files().map(|file| {
            let (size, sum) = checksum(&scene.resolve(file))?;
            Ok((file.to_string_lossy().into_owned(), size, sum))
        });
        Ok(Self {
            scene: text,
            files: files.collect::<Result<_, Error>>()?,
        })
    }

    /// What of it is different in `other`, and how.
    fn difference(&self, other: &Self) -> Option<String> {
        let parsed = |text: &str| serde_json::from_str(text).unwrap_or(Value::Null);
        if self.scene != other.scene {
            let found = difference("", &parsed(&self.scene), &parsed(&other.scene));
            return Some(found.unwrap_or_else(|| "the scene is another one".into()));
        }
        (self.files.iter().zip(&other.files))
            .find(|(own, other)| own != other)
            .map(|((name, ..), _)| format!("the file {name} has other content now"))
    }
}

fn checksum(path: &Path) -> Result<(u64, u32), Error> {
    let mut file = open(path)?;
    let mut sum = Crc::new();
    let mut size = 0;
    let mut buffer = vec![0; 1 << 18];
    loop {
        match file.read(&mut buffer) {
            Ok(0) => return Ok((size, sum.sum())),
            Ok(count) => {
                sum.update(&buffer[..count]);
                size += count as u64;
            }
            Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
            Err(e) => return Err(Error::input(path, format!("cannot be read ({e})"))),
        }
    }
}

/// The first key whose value differs: of the scene in the file, and of that to be packed.
fn difference(key: &str, then: &Value, now: &Value) -> Option<String> {
    let join = |name: &dyn fmt::Display| match key {
        "" => name.to_string(),
        _ => format!("{key}.{name}"),
    };
    match (then, now) {
        (Value::Object(then), Value::Object(now)) => {
            let mut names: Vec<&String> = then.keys().chain(now.keys()).collect();
            names.sort_unstable();
            names.into_iter().find_map(|name| {
                let of = |object: &serde_json::Map<String, Value>| {
                    object.get(name).cloned().unwrap_or(Value::Null)
                };
                difference(&join(name), &of(then), &of(now))
            })
        }
        (Value::Array(then), Value::Array(now)) if then.len() == now.len() => (then.iter())
            .zip(now)
            .enumerate()
            .find_map(|(k, (then, now))| difference(&join(&k), then, now)),
        _ if then == now => None,
        _ => Some(format!(
            "{key} was {} and is {} now",
            short(then),
            short(now)
        )),
    }
}

/// A value in a few words.
fn short(value: &Value) -> String {
    let text = match value {
        Value::Null => return "not set".into(),
        Value::Array(list) => return format!("a list of {}", list.len()),
        other => other.to_string(),
    };
    if text.chars().count() > 40 {
        format!("{}…", text.chars().take(40).collect::<String>())
    } else {
        text
    }
}

/// How far a packing had come.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Reached {
    /// What it was busy with.
    pub(crate) phase: String,
    /// Its evaluation.
    pub(crate) evaluation: u64,
    /// Seconds that it had taken.
    pub(crate) seconds: f64,
}

/// Writes a checkpoint.
pub(crate) fn write(
    to: &mut dyn Write,
    fingerprint: &Fingerprint,
    reached: &Reached,
    state: &dyn Fn(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut head = MAGIC.to_vec();
    head.extend_from_slice(&FORMAT.to_le_bytes());
    put_text(&mut head, PROGRAM);
    put_text(&mut head, &fingerprint.scene);
    head.extend_from_slice(&(fingerprint.files.len() as u64).to_le_bytes());
    for (name, size, sum) in &fingerprint.files {
        put_text(&mut head, name);
        head.extend_from_slice(&size.to_le_bytes());
        head.extend_from_slice(&sum.to_le_bytes());
    }
    put_text(&mut head, &reached.phase);
    head.extend_from_slice(&reached.evaluation.to_le_bytes());
    head.extend_from_slice(&reached.seconds.to_le_bytes());
    let summed = Summed {
        to,
        sum: Crc::new(),
    };
    // The state comes number by number.
    let mut buffered = BufWriter::with_capacity(1 << 18, summed);
    buffered.write_all(&head)?;
    state(&mut buffered)?;
    let Summed { to, sum } = buffered.into_inner().map_err(|e| e.into_error())?;
    to.write_all(&sum.sum().to_le_bytes())
}

/// Sums up what it passes on.
struct Summed<'a> {
    to: &'a mut dyn Write,
    sum: Crc,
}

impl Write for Summed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.to.write(bytes)?;
        self.sum.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

fn put_text(out: &mut Vec<u8>, text: &str) {
    out.extend_from_slice(&(text.len() as u64).to_le_bytes());
    out.extend_from_slice(text.as_bytes());
}

/// Whether a file begins as checkpoints do.
pub(crate) fn is_one(path: &Path) -> bool {
    let mut head = [0; MAGIC.len()];
    open(path).is_ok_and(|mut file| file.read_exact(&mut head).is_ok() && head == *MAGIC)
}

/// The state in a file, and how far it had come.
///
/// # Errors
/// [`Error::Input`] where there is none, or none of this scene by this version of the program.
pub(crate) fn read(path: &Path, now: &Fingerprint) -> Result<(Reached, Vec<u8>), Error> {
    let anew = "pack without --resume to begin anew";
    let refuse = |what: String| Error::input(path, format!("{what}; {anew}"));
    if !path.exists() {
        return Err(refuse("there is no checkpoint to go on from".into()));
    }
    let mut bytes = read_whole(path)?;
    let (then, reached, state) = match parse(&bytes) {
        Ok(found) => found,
        Err(Fault::NoCheckpoint) => return Err(refuse("this is no checkpoint".into())),
        Err(Fault::Damaged) => {
            let what = "the checkpoint is damaged, its checksum does not match";
            return Err(refuse(what.into()));
        }
        Err(Fault::Version(version)) => {
            return Err(refuse(format!(
                "the checkpoint is by another version of sphpack, {version}, and this is {PROGRAM}; go on with that one"
            )));
        }
    };
    if let Some(difference) = then.difference(now) {
        return Err(refuse(format!(
            "the checkpoint is of another scene: {difference}; undo that to go on"
        )));
    }
    let begin = bytes.len() - SUM - state;
    bytes.truncate(begin + state);
    bytes.drain(..begin);
    Ok((reached, bytes))
}

/// Bytes of the checksum at the end.
const SUM: usize = 4;

/// Why bytes are of no use.
#[derive(Debug, PartialEq)]
enum Fault {
    NoCheckpoint,
    Damaged,
    Version(String),
}

/// Everything but the state, and how many bytes that is.
fn parse(bytes: &[u8]) -> Result<(Fingerprint, Reached, usize), Fault> {
    let mut from = bytes.strip_prefix(MAGIC).ok_or(Fault::NoCheckpoint)?;
    let format = u32::from_le_bytes(*take(&mut from)?);
    if format != FORMAT {
        return Err(Fault::Version(format!("of format {format}")));
    }
    let Some((covered, found)) = bytes.split_last_chunk::<SUM>() else {
        return Err(Fault::Damaged);
    };
    let mut sum = Crc::new();
    sum.update(covered);
    if sum.sum() != u32::from_le_bytes(*found) {
        return Err(Fault::Damaged);
    }
    let program = take_text(&mut from)?;
    if program != PROGRAM {
        return Err(Fault::Version(program));
    }
    let scene = take_text(&mut from)?;
    let mut files = Vec::new();
    for _ in 0..u64::from_le_bytes(*take(&mut from)?) {
        let name = take_text(&mut from)?;
        let size = u64::from_le_bytes(*take(&mut from)?);
        files.push((name, size, u32::from_le_bytes(*take(&mut from)?)));
    }
    let reached = Reached {
        phase: take_text(&mut from)?,
        evaluation: u64::from_le_bytes(*take(&mut from)?),
        seconds: f64::from_le_bytes(*take(&mut from)?),
    };
    let state = from.len().checked_sub(SUM).ok_or(Fault::Damaged)?;
    Ok((Fingerprint { scene, files }, reached, state))
}

fn take<'a, const N: usize>(from: &mut &'a [u8]) -> Result<&'a [u8; N], Fault> {
    let (bytes, rest) = from.split_first_chunk().ok_or(Fault::Damaged)?;
    *from = rest;
    Ok(bytes)
}

fn take_text(from: &mut &[u8]) -> Result<String, Fault> {
    let length = u64::from_le_bytes(*take(from)?);
    let length = usize::try_from(length).map_err(|_| Fault::Damaged)?;
    let (bytes, rest) = from.split_at_checked(length).ok_or(Fault::Damaged)?;
    *from = rest;
    String::from_utf8(bytes.to_vec()).map_err(|_| Fault::Damaged)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "spacing = 0.2\n[domain]\nmin = [-2.0, -2.0]\nmax = [2.0, 2.0]\n[[body]]\nname = \"rod\"\nshape = { circle = { center = [0.0, 0.0], radius = 1.0 } }\n";

    fn fingerprint(scene: &str) -> Fingerprint {
        Fingerprint::of(&Scene::parse(scene, "rod.toml").unwrap()).unwrap()
    }

    fn written() -> Vec<u8> {
        let mut bytes = Vec::new();
        let reached = Reached {
            phase: "settling".into(),
            evaluation: 12,
            seconds: 3.5,
        };
        let state = |to: &mut dyn Write| to.write_all(b"a state");
        write(&mut bytes, &fingerprint(SCENE), &reached, &state).unwrap();
        bytes
    }

    #[test]
    fn what_was_written_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rod.checkpoint");
        std::fs::write(&path, written()).unwrap();
        let (reached, state) = read(&path, &fingerprint(SCENE)).unwrap();
        assert_eq!((reached.evaluation, &state[..]), (12, &b"a state"[..]));
        assert!(is_one(&path));
        let other = SCENE.replace("radius = 1.0", "radius = 1.5");
        let message = read(&path, &fingerprint(&other)).unwrap_err().to_string();
        assert!(
            message.contains("body.0.shape.circle.radius was 1.0 and is 1.5 now"),
            "{message}"
        );
        let written_otherwise = format!("{SCENE}[output]\ninclude = [\"free\"]\n");
        assert!(read(&path, &fingerprint(&written_otherwise)).is_ok());
    }

    #[test]
    fn whatever_was_changed_is_refused() {
        let bytes = written();
        for k in 0..bytes.len() {
            assert!(parse(&bytes[..k]).is_err(), "{k}");
            let mut changed = bytes.clone();
            changed[k] ^= 0x10;
            assert!(parse(&changed).is_err(), "{k}");
        }
        assert!(parse(&[&bytes[..], b"x"].concat()).is_err());
    }
}
