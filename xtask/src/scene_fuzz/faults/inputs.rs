//! Scenes and particle files that are none, have no end, or grow.

use std::fs::{self, File, Permissions};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::Command;
use std::time::Duration;

use super::super::random::Random;
use super::Outcome;
use super::desk::{Desk, Run};

fn words(error: std::io::Error) -> String {
    error.to_string()
}

/// Memory that is enough to refuse what is short, and what is as long as a scene may be.
const LITTLE: &str = "ulimit -v 700000";

/// Room for a file of two gibibytes, once.
const AS_LARGE: &str = "ulimit -v 3000000";
const MORE: &str = "ulimit -v 1500000";

/// The commands that read a file of this ending.
fn readers(name: &str) -> Vec<Vec<&str>> {
    match name.rsplit('.').next() {
        Some("toml") => vec![vec!["pack", name, "--threads", "1"]],
        Some("stl" | "svg") => vec![vec!["check", name], vec!["pack", name, "--spacing", "0.1"]],
        _ => vec![vec!["quality", name, "--spacing", "0.1"]],
    }
}

/// Has every command that reads it refuse a file, soon and with little memory.
fn refused(desk: &Desk<'_>, name: &str, parts: &[&str], limit: &str) -> Result<Outcome, String> {
    for reader in readers(name) {
        let ended = desk.run(Run::new(&reader).limited(limit.into()))?;
        ended.is_decent()?;
        ended.refused(parts)?;
        if let Some(left) = desk.hidden("").first() {
            return Err(format!("left behind: {}", left.display()));
        }
    }
    Ok(Outcome::Refused)
}

const NAMES: [&str; 6] = ["a.toml", "a.stl", "a.svg", "a.csv", "a.npz", "a.vtk"];

pub(super) fn no_file(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let name = NAMES[random.below(NAMES.len())];
    let path = desk.folder.join(name);
    let parts: &[&str] = match random.below(5) {
        0 => {
            let made = Command::new("mkfifo").arg(&path).status().map_err(words)?;
            if !made.success() {
                return Ok(Outcome::Skipped("no pipe can be made"));
            }
            &["a pipe or a device"]
        }
        1 => {
            fs::create_dir(&path).map_err(words)?;
            &["a folder"]
        }
        2 => {
            symlink(["/dev/zero", "/dev/urandom"][random.below(2)], &path).map_err(words)?;
            &["a pipe or a device"]
        }
        3 => {
            // A link to itself.
            symlink(&path, &path).map_err(words)?;
            &[]
        }
        _ => &["no such file"],
    };
    refused(desk, name, &[parts, &[name]].concat(), LITTLE)
}

pub(super) fn no_end(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let name = NAMES[random.below(NAMES.len())];
    let path = desk.folder.join(name);
    let file = File::create(&path).map_err(words)?;
    let mut limit = LITTLE;
    match random.below(3) {
        // Nothing but zeros, which take no room on the disk.
        0 => {
            let power = random.whole(20, 40);
            file.set_len(1 << power).map_err(words)?;
            // What is there may be held in memory before it is refused; what only says that it is there may not.
            if (28..=31).contains(&power) {
                limit = AS_LARGE;
            }
        }
        1 => fs::write(&path, vec![b'['; random.whole(1, 9_000_000)]).map_err(words)?,
        _ => {
            if !desk.has_nobody() {
                return Ok(Outcome::Skipped("no other user can be had"));
            }
            fs::set_permissions(&path, Permissions::from_mode(0o000)).map_err(words)?;
            for reader in readers(name) {
                let mut run = Run::new(&reader);
                run.as_nobody = true;
                let ended = desk.run(run)?;
                ended.is_decent()?;
                ended.refused(&[name, "cannot be opened", "permissions"])?;
            }
            return Ok(Outcome::Refused);
        }
    }
    refused(desk, name, &[name], limit)
}

/// As long as scenes may be, and longer.
pub(super) fn million(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let head = "spacing = 0.1\n";
    let tail = "\n[domain]\nmin = [-1, -1]\nmax = [1, 1]\n";
    let body = "[[body]]\nshape = { circle = { center = [0, 0], radius = 1 } }\n";
    let count = random.whole(100_000, 1_000_000);
    let scene = match random.below(6) {
        0 => format!("{head}{tail}{}", body.repeat(count)),
        1 => format!("{head}body = [{}]{tail}", "{},".repeat(count)),
        2 => format!("{head}{tail}{}", "[[ body ]]\n".repeat(count.min(700_000))),
        3 => {
            let keys: String = (0..count.min(500_000))
                .map(|k| format!("k{k} = 1\n"))
                .collect();
            format!("{keys}{head}{tail}")
        }
        4 => format!("{head}{tail}[body{}]\n", ".a".repeat(count)),
        _ => format!("{head}name = \"{}\"{tail}", "\u{1f600}".repeat(count)),
    };
    desk.put("a.toml", scene)?;
    refused(desk, "a.toml", &["a.toml"], MORE)
}

/// An array of zeros by the code with the fewest bits: 258 of them in 13.
fn zeros(count: usize) -> Vec<u8> {
    // A block that is not compressed holds the array's head.
    let words = format!(
        "{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}",
        count / 8
    );
    let head = [
        b"\x93NUMPY\x01\x00\x76\x00",
        format!("{words:117}\n").as_bytes(),
    ]
    .concat();
    let length = (head.len() as u16).to_le_bytes();
    let mut bytes = [&[0], &length[..], &length.map(|byte| !byte), &head].concat();
    let (mut buffer, mut filled) = (0u64, 0);
    let mut put = |value: u64, bits: u32| {
        buffer |= value << filled;
        filled += bits;
        while filled >= 8 {
            bytes.push(buffer as u8);
            buffer >>= 8;
            filled -= 8;
        }
    };
    // One last block with fixed codes: a zero, then repetitions of the byte before.
    put(0b011, 3);
    put(0b0000_1100, 8);
    for _ in 0..count / 258 {
        put(0b1010_0011, 8);
        put(0, 5);
    }
    put(0, 7);
    put(0, 8);
    bytes
}

/// A ZIP file of one deflated array, with what it claims about its size.
fn zip(data: &[u8], claimed: u32) -> Vec<u8> {
    let name = b"x.npy";
    let common = |bytes: &mut Vec<u8>| {
        bytes.extend([20, 0, 0, 0, 8, 0, 0, 0, 0, 0]);
        for number in [0, data.len() as u32, claimed] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend((name.len() as u16).to_le_bytes());
        bytes.extend([0, 0]);
    };
    let mut bytes = b"PK\x03\x04".to_vec();
    common(&mut bytes);
    bytes.extend(name);
    bytes.extend(data);
    let at = bytes.len() as u32;
    bytes.extend(b"PK\x01\x02\x14\x00");
    common(&mut bytes);
    bytes.extend([0; 14]);
    bytes.extend(name);
    let size = bytes.len() as u32 - at;
    bytes.extend(b"PK\x05\x06\0\0\0\0\x01\0\x01\0");
    bytes.extend(size.to_le_bytes());
    bytes.extend(at.to_le_bytes());
    bytes.extend([0, 0]);
    bytes
}

pub(super) fn bomb(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let count = random.magnitude(1e3, 3e9) as usize;
    let claimed = match random.below(3) {
        0 => count as u32,
        1 => u32::MAX,
        _ => 100,
    };
    desk.put("a.npz", zip(&zeros(count), claimed))?;
    let run = Run::new(&["quality", "a.npz", "--spacing", "0.1"]).limited(MORE.into());
    let ended = desk.run(run)?;
    ended.is_decent()?;
    ended.refused(&["a.npz"])?;
    if ended.seconds > 30.0 {
        return Err(format!("{count} zeros take {:.1} s", ended.seconds));
    }
    Ok(Outcome::Refused)
}

pub(super) fn changes(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let outputs = desk.outputs("", random)?;
    let child = desk.start(&Run::pack(&outputs))?;
    std::thread::sleep(Duration::from_secs_f64(
        random.between(0.0, desk.reference.seconds),
    ));
    let scene = desk.folder.join("scene.toml");
    match random.below(3) {
        0 => fs::remove_file(&scene).map_err(words)?,
        1 => fs::write(&scene, "no scene any more").map_err(words)?,
        _ => File::create(&scene).map(drop).map_err(words)?,
    }
    let ended = desk.wait(child)?;
    desk.set(&outputs, &ended)?;
    match ended.code {
        Some(0) => Ok(Outcome::Done),
        // It had not been read yet.
        Some(2) if ended.errors.contains("scene.toml") => Ok(Outcome::Refused),
        other => Err(format!("status {other:?}: {}", ended.errors)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bombs_are_small() {
        let bytes = zip(&zeros(258_000), 258_001);
        assert!(bytes.len() < 2000, "{}", bytes.len());
        assert!(bytes.starts_with(b"PK\x03\x04\x14\0\0\0\x08\0"));
    }
}
