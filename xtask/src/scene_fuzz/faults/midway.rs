//! What happens to a run while it is at work.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use super::super::random::Random;
use super::Outcome;
use super::desk::{Desk, Ended, Output, Run};

/// Lets a run go on for a while; some have ended then.
fn wait(desk: &Desk<'_>, random: &mut Random) {
    let most = 1.2 * desk.reference.seconds;
    std::thread::sleep(Duration::from_secs_f64(random.between(0.0, most)));
}

fn outcome(ended: &Ended) -> Result<Outcome, String> {
    match ended.code {
        Some(0) => Ok(Outcome::Done),
        Some(1) => Ok(Outcome::Failed),
        Some(2) => Ok(Outcome::Refused),
        other => Err(format!("status {other:?}: {}", ended.errors)),
    }
}

fn words(error: std::io::Error) -> String {
    error.to_string()
}

pub(super) fn folder_comes(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let mut outputs = desk.outputs("", random)?;
    let taken = outputs.remove(random.below(outputs.len()));
    let mut all = outputs.clone();
    all.push(taken.clone());
    let child = desk.start(&Run::pack(&all))?;
    wait(desk, random);
    let path = desk.folder.join(&taken.name);
    let gone = desk.folder.join(format!("gone-{}", taken.name));
    let was_moved = fs::rename(&path, &gone).is_ok();
    let has_come = fs::create_dir_all(path.join("inside")).is_ok();
    let ended = desk.wait(child)?;
    if !has_come {
        desk.set(&all, &ended)?;
        return outcome(&ended);
    }
    desk.set(&outputs, &ended)?;
    if !path.join("inside").is_dir() {
        return Err(format!("the folder has gone: {}", ended.errors));
    }
    let is_new = was_moved && desk.is_new(&gone);
    match ended.code {
        Some(0) if !is_new => Err(format!("done without {}", taken.name)),
        Some(0) => Ok(Outcome::Done),
        _ => {
            desk.is_kept(&ended)?;
            outcome(&ended)
        }
    }
}

pub(super) fn folder_goes(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let (sub, gone) = (desk.folder.join("sub"), desk.folder.join("gone"));
    fs::create_dir(&sub).map_err(words)?;
    let outputs = desk.outputs("sub/", random)?;
    let child = desk.start(&Run::pack(&outputs))?;
    wait(desk, random);
    fs::rename(&sub, &gone).map_err(words)?;
    let ended = desk.wait(child)?;
    let moved: Vec<Output> = outputs
        .into_iter()
        .map(|output| Output {
            name: output.name.replace("sub/", "gone/"),
            ..output
        })
        .collect();
    desk.set(&moved, &ended)?;
    desk.is_kept(&ended)?;
    outcome(&ended)
}

pub(super) fn becomes_read_only(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    if !desk.has_nobody() {
        return Ok(Outcome::Skipped("no other user can be had"));
    }
    let sub = desk.folder.join("sub");
    fs::create_dir(&sub).map_err(words)?;
    let outputs = desk.outputs("sub/", random)?;
    let set =
        |path: &Path, mode| fs::set_permissions(path, Permissions::from_mode(mode)).map_err(words);
    set(&sub, 0o777)?;
    set(&desk.aside.join("tmp"), 0o777)?;
    let run = || Run {
        as_nobody: true,
        ..Run::pack(&outputs)
    };
    let child = desk.start(&run())?;
    wait(desk, random);
    set(&sub, 0o555)?;
    let ended = desk.wait(child)?;
    set(&sub, 0o777)?;
    desk.set(&outputs, &ended)?;
    desk.is_kept(&ended)?;
    if desk.hidden("sub").is_empty() {
        return outcome(&ended);
    }
    // It could not be removed; the next run does.
    again(desk, run())?;
    outcome(&ended)
}

/// The next run cleans what was left, and does all.
fn again(desk: &Desk<'_>, run: Run) -> Result<(), String> {
    desk.age("sub")?;
    let ended = desk.run(run)?;
    ended.is_decent()?;
    // Under that name may be the only copy of what was there before, so that nothing takes it away.
    let is_leftover = |path: &&std::path::PathBuf| path.extension().is_none_or(|e| e != "replaced");
    match desk.hidden("sub").iter().find(is_leftover) {
        Some(left) => Err(format!("not cleaned: {}", left.display())),
        None if ended.code == Some(0) => Ok(()),
        None => Err(format!("then status {:?}: {}", ended.code, ended.errors)),
    }
}

pub(super) fn killed(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let outputs = desk.outputs("", random)?;
    let mut child = desk.start(&Run::pack(&outputs))?;
    wait(desk, random);
    child.kill().map_err(words)?;
    let ended = desk.wait(child)?;
    if ended.code.is_some() {
        desk.set(&outputs, &ended)?;
        return outcome(&ended);
    }
    for output in &outputs {
        // Between two names a set cannot be whole, but each file is.
        if !desk.is_old(output) && !desk.is_new(&desk.folder.join(&output.name)) {
            return Err(format!("{} is neither old nor new", output.name));
        }
    }
    again(desk, Run::pack(&outputs))?;
    match outputs
        .iter()
        .find(|output| !desk.is_new(&desk.folder.join(&output.name)))
    {
        None => Ok(Outcome::Killed),
        Some(output) => Err(format!("then {} is not what it should be", output.name)),
    }
}

pub(super) fn stopped(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let outputs = desk.outputs("", random)?;
    let child = desk.start(&Run::pack(&outputs))?;
    for _ in 0..random.whole(1, 2) {
        wait(desk, random);
        let sent = Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .output();
        sent.map_err(words)?;
    }
    let ended = desk.wait(child)?;
    let are_old = outputs.iter().filter(|output| desk.is_old(output)).count();
    match ended.code {
        // Nobody listened yet.
        None if are_old == outputs.len() => {
            again(desk, Run::pack(&outputs))?;
        }
        None => return Err(format!("ended by the signal: {}", ended.errors)),
        // What there was is written, all of it; or it was asked twice, and nothing is.
        Some(130) if are_old == 0 || are_old == outputs.len() => ended.is_decent()?,
        Some(130) => return Err(format!("{are_old} of {} are old", outputs.len())),
        // The last signal came too late.
        Some(_) => desk.set(&outputs, &ended)?,
    }
    match desk.hidden("").first() {
        Some(left) => Err(format!("left behind: {}", left.display())),
        None if ended.code == Some(0) => Ok(Outcome::Done),
        None => Ok(Outcome::Killed),
    }
}
