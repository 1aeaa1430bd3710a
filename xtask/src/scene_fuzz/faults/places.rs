//! Outputs whose places are wrong from the beginning.

use std::ffi::OsString;
use std::fs::{self, Permissions};
use std::os::unix::ffi::OsStringExt;
use std::os::unix::fs::PermissionsExt;

use super::super::random::Random;
use super::Outcome;
use super::desk::{Desk, Run, To};

pub(super) fn no_folder(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let (folder, words) = match random.below(4) {
        0 => ("none", "does not exist"),
        1 => ("scene.toml", "is a file, not a folder"),
        // Nobody can write there, whoever it is.
        2 => ("/proc", "nothing can be written"),
        _ => ("none/../none", "does not exist"),
    };
    let mut outputs = desk.outputs("", random)?;
    let place = random.below(outputs.len());
    outputs[place].name = format!("{folder}/{}", outputs[place].name);
    outputs[place].had_old = false;
    let ended = desk.run(Run::pack(&outputs))?;
    desk.set(&outputs, &ended)?;
    ended.refused(&[words])?;
    Ok(Outcome::Refused)
}

pub(super) fn read_only(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    if !desk.has_nobody() {
        return Ok(Outcome::Skipped("no other user can be had"));
    }
    let sub = desk.folder.join("sub");
    fs::create_dir(&sub).map_err(|error| error.to_string())?;
    let outputs = desk.outputs("sub/", random)?;
    let mode = [0o555, 0o000][random.below(2)];
    let set = |mode| fs::set_permissions(&sub, Permissions::from_mode(mode));
    set(mode).map_err(|error| error.to_string())?;
    let ended = desk.run(Run {
        as_nobody: true,
        ..Run::pack(&outputs)
    })?;
    set(0o755).map_err(|error| error.to_string())?;
    desk.set(&outputs, &ended)?;
    ended.refused(&["sub"])?;
    Ok(Outcome::Refused)
}

pub(super) fn folder_in_place(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let mut outputs = desk.outputs("", random)?;
    let place = random.below(outputs.len());
    let taken = outputs.remove(place);
    let path = desk.folder.join(&taken.name);
    if taken.had_old {
        fs::remove_file(&path).map_err(|error| error.to_string())?;
    }
    let inside = path.join("inside");
    fs::create_dir_all(&inside).map_err(|error| error.to_string())?;
    let mut all = outputs.clone();
    all.insert(place, taken);
    let ended = desk.run(Run::pack(&all))?;
    desk.set(&outputs, &ended)?;
    ended.refused(&["this is a folder"])?;
    if inside.is_dir() {
        Ok(Outcome::Refused)
    } else {
        Err("the folder has gone".into())
    }
}

pub(super) fn names(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let stem = match random.below(5) {
        0 => b"a\x1b[31m\nb\x07".to_vec(),
        1 => b"a\xff\xfe\x80b".to_vec(),
        2 => vec![b'x'; random.whole(200, 300)],
        3 => "\u{202e}\u{e4}\u{1f600}"
            .repeat(random.whole(1, 30))
            .into_bytes(),
        _ => b" -a, b; kept as ".to_vec(),
    };
    let named = |ending: &str| OsString::from_vec([&stem, ending.as_bytes()].concat());
    let is_scene = random.chance(0.5);
    let (scene, out) = if is_scene {
        (named(".toml"), OsString::from("out.csv"))
    } else {
        (OsString::from("scene.toml"), named(".csv"))
    };
    let is_possible = stem.len() + if is_scene { 5 } else { 4 } <= 255;
    if is_scene && is_possible {
        fs::write(desk.folder.join(&scene), desk.reference.scene).map_err(|e| e.to_string())?;
    }
    let mut run = Run::new(&["pack", "--threads", "1"]);
    // A leading dash or space is a part of the name.
    let scene = [OsString::from("./"), scene].concat_os();
    run.arguments.extend([scene, "-o".into(), out.clone()]);
    let ended = desk.run(run)?;
    ended.is_decent()?;
    let said = ended.errors.clone() + &ended.output;
    if said.chars().any(|c| c.is_control() && c != '\n') {
        return Err(format!("control characters reach the terminal: {said:?}"));
    }
    let is_there = fs::read(desk.folder.join(&out)).is_ok_and(|bytes| !bytes.is_empty());
    match (ended.code, is_there) {
        (Some(0), true) if is_possible => Ok(Outcome::Done),
        (Some(2), false) if !is_possible => Ok(Outcome::Refused),
        other => Err(format!(
            "{other:?}, possible {is_possible}: {}",
            ended.errors
        )),
    }
}

/// Words put together that need not be text.
trait Together {
    fn concat_os(self) -> OsString;
}

impl Together for [OsString; 2] {
    fn concat_os(self) -> OsString {
        let [mut first, second] = self;
        first.push(second);
        first
    }
}

pub(super) fn standard_output(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let to = [To::Full, To::Nobody][random.below(2)];
    let outputs = desk.outputs("", random)?;
    let is_pack = random.chance(0.5);
    let run = if is_pack {
        Run::pack(&outputs)
    } else {
        let others: [&[&str]; 5] = [
            &["--help"],
            &["list", "shapes"],
            &["pack", "scene.toml", "--dry-run"],
            &["init"],
            &["--version"],
        ];
        Run::new(others[random.below(others.len())])
    };
    let ended = desk.run(Run { to, ..run })?;
    // Whoever has stopped reading has had enough; a full disk is a loss.
    let expected = if to == To::Full { 1 } else { 0 };
    ended.is_decent()?;
    if ended.code != Some(expected) {
        return Err(format!("status {:?}: {}", ended.code, ended.errors));
    }
    if is_pack {
        // The files are written in any case.
        let done = super::desk::Ended {
            code: Some(0),
            ..ended
        };
        desk.set(&outputs, &done)?;
    }
    Ok(if expected == 0 {
        Outcome::Done
    } else {
        Outcome::Failed
    })
}
