//! Runs that may have little: disk, memory, threads, files, time.

use std::fs;
use std::process::Command;

use super::super::random::Random;
use super::Outcome;
use super::desk::{Desk, Ended, Output, Run};

/// What a run came to that may be done or end with an error.
fn judged(desk: &Desk<'_>, outputs: &[Output], ended: &Ended) -> Result<Outcome, String> {
    desk.set(outputs, ended)?;
    match ended.code {
        Some(0) => Ok(Outcome::Done),
        Some(2) => Ok(Outcome::Refused),
        Some(1) => Ok(Outcome::Failed),
        other => Err(format!("status {other:?}: {}", ended.errors)),
    }
}

/// The same, where an error must speak of what was limited.
fn judged_of(
    desk: &Desk<'_>,
    outputs: &[Output],
    ended: &Ended,
    words: &[&str],
) -> Result<Outcome, String> {
    let outcome = judged(desk, outputs, ended)?;
    if outcome == Outcome::Done || words.iter().any(|word| ended.errors.contains(word)) {
        Ok(outcome)
    } else {
        Err(format!("none of {words:?} is named: {}", ended.errors))
    }
}

pub(super) fn disk_full(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let sub = desk.folder.join("sub");
    fs::create_dir(&sub).map_err(|error| error.to_string())?;
    let size = format!("size={}k", 4 * random.whole(6, 300));
    let mount = Command::new("mount")
        .args(["-t", "tmpfs", "-o", &size, "tmpfs"])
        .arg(&sub)
        .output();
    if !mount.is_ok_and(|output| output.status.success()) {
        return Ok(Outcome::Skipped("no file system can be mounted"));
    }
    let result = (|| {
        let outputs = desk.outputs("sub/", random)?;
        let ended = desk.run(Run::pack(&outputs))?;
        let outcome = judged_of(
            desk,
            &outputs,
            &ended,
            &["No space left", "nothing can be written"],
        )?;
        desk.is_kept(&ended)?;
        match desk.hidden("sub").first() {
            Some(left)
                if !ended
                    .kept()
                    .iter()
                    .any(|kept| desk.folder.join(kept) == *left) =>
            {
                Err(format!("left behind: {}", left.display()))
            }
            _ => Ok(outcome),
        }
    })();
    let unmount = Command::new("umount").arg(&sub).status();
    if unmount.is_ok_and(|status| status.success()) {
        result
    } else {
        Err("the file system cannot be unmounted".into())
    }
}

pub(super) fn file_size(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let outputs = desk.outputs("", random)?;
    // Blocks of 512 bytes: up to some 600 KiB.
    let limit = format!("ulimit -f {}", random.magnitude(1.0, 1200.0) as usize);
    let ended = desk.run(Run::pack(&outputs).limited(limit))?;
    judged_of(desk, &outputs, &ended, &["ulimit -f"])
}

/// Of a thread, with what guards it.
const STACK_KIBIBYTES: usize = 2056;

/// KiB from what the command needs to speak at all to what is enough for anything, half the times hardly more than some stacks of
/// threads take. Below that the system does not load it, or its runtime does not begin.
fn kibibytes(desk: &Desk<'_>, random: &mut Random) -> Result<usize, String> {
    let (mut low, mut high) = (4_000, 500_000);
    while high - low > 20 {
        let middle = usize::midpoint(low, high);
        let run = Run::new(&["--version"]).limited(format!("ulimit -v {middle}"));
        if matches!(desk.run(run)?.code, Some(0 | 1)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    let more = if random.chance(0.5) {
        STACK_KIBIBYTES * random.whole(0, 7) + random.whole(10, 200)
    } else {
        random.whole(10, 500_000)
    };
    Ok(high + more)
}

const MEMORY: [&str; 2] = ["memory", "ulimit"];

pub(super) fn address_space(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let outputs = desk.outputs("", random)?;
    let limit = format!("ulimit -v {}", kibibytes(desk, random)?);
    let mut run = Run::pack(&outputs).limited(limit);
    let threads = random.whole(1, 4).to_string();
    run.arguments
        .retain(|word| word != "--threads" && word != "1");
    let ended = desk.run(run.with(&["--threads", &threads]))?;
    judged_of(desk, &outputs, &ended, &MEMORY)
}

/// The commands that read what was packed.
pub(super) fn address_space_of_others(
    desk: &Desk<'_>,
    random: &mut Random,
) -> Result<Outcome, String> {
    let outputs = [Output {
        name: "p.csv".into(),
        had_old: false,
    }];
    let packed = desk.run(Run::pack(&outputs))?;
    if packed.code != Some(0) {
        return Err(format!("without any fault: {}", packed.errors));
    }
    let limit = format!("ulimit -v {}", kibibytes(desk, random)?);
    let words: [&[&str]; 3] = [
        &["quality", "p.csv", "--spacing", "0.1"],
        &["list", "methods"],
        &["pack", "scene.toml", "--dry-run", "--threads", "1"],
    ];
    let run = Run::new(words[random.below(words.len())]).limited(limit);
    let ended = desk.run(run)?;
    ended.is_decent()?;
    match ended.code {
        // A wrong spacing is a fault of the packing.
        Some(0 | 3) => Ok(Outcome::Done),
        Some(code) if MEMORY.iter().any(|word| ended.errors.contains(word)) => {
            Ok([Outcome::Failed, Outcome::Refused][usize::from(code == 2)])
        }
        other => Err(format!("status {other:?}: {}", ended.errors)),
    }
}

pub(super) fn data(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let outputs = desk.outputs("", random)?;
    let limit = format!("ulimit -d {}", random.whole(12_000, 200_000));
    let ended = desk.run(Run::pack(&outputs).limited(limit))?;
    judged_of(desk, &outputs, &ended, &MEMORY)
}

/// Root may have as many as it likes, so that it takes another user.
pub(super) fn threads(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    if !desk.has_nobody() {
        return Ok(Outcome::Skipped("no other user can be had"));
    }
    let outputs: [Output; 0] = [];
    let most = random.whole(1, 6);
    let count = random.whole(1, 8).to_string();
    let mut run = Run::new(&["pack", "scene.toml", "--dry-run", "--threads", &count]);
    run.as_nobody = true;
    // Both limits: a shell of another kind knows only one of the letters.
    run.before = format!("ulimit -u {most} 2>/dev/null || ulimit -p {most}");
    let ended = desk.run(run)?;
    judged_of(desk, &outputs, &ended, &["ulimit -u"])
}

pub(super) fn open_files(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let outputs = desk.outputs("", random)?;
    let limit = format!("ulimit -n {}", random.whole(4, 20));
    let ended = desk.run(Run::pack(&outputs).limited(limit))?;
    // Without any, not even its libraries can be loaded.
    if ended.errors.contains("shared libraries") {
        return Ok(Outcome::Refused);
    }
    judged_of(desk, &outputs, &ended, &["open files", "ulimit", "Ctrl-C"])
}

/// The system asks once a second to stop, and kills at last: the set is whole, or as it was.
pub(super) fn processor_time(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let outputs = desk.outputs("", random)?;
    let endless = format!(
        "{}[packing]\nmethod = \"hybrid\"\nvelocity_tolerance = 1e-300\nmax_iterations = 100000000\n",
        desk.reference.scene
    );
    desk.put("scene.toml", endless)?;
    let child = desk.start(&Run::pack(&outputs).limited("ulimit -t 1".into()))?;
    let mut ended = desk.wait(child)?;
    if ended.code.is_some() {
        return Err(format!("status {:?}: {}", ended.code, ended.errors));
    }
    desk.put("scene.toml", desk.reference.scene)?;
    desk.age("")?;
    ended = desk.run(Run::pack(&outputs))?;
    desk.set(&outputs, &ended)?;
    if ended.code == Some(0) {
        Ok(Outcome::Killed)
    } else {
        Err(format!("status {:?}: {}", ended.code, ended.errors))
    }
}

pub(super) fn many_threads(desk: &Desk<'_>, random: &mut Random) -> Result<Outcome, String> {
    let number = ["0", "1025", "100000", "-1", "1e3", "99999999999999999999"][random.below(6)];
    let ended =
        desk.run(Run::new(&["pack", "scene.toml", "--dry-run"]).with(&["--threads", number]))?;
    ended.is_decent()?;
    if ended.code == Some(2) {
        Ok(Outcome::Refused)
    } else {
        Err(format!("status {:?}: {}", ended.code, ended.errors))
    }
}
