//! What is too much: for the machine, for the process's limits, for a scene.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use crate::{CYLINDER, Desk};

/// Runs what must be refused at once.
#[track_caller]
fn refuse_soon(desk: &Desk, arguments: &[&str], parts: &[&str]) {
    let begin = Instant::now();
    desk.refuse(arguments, parts);
    // A second where it is built to be fast.
    assert!(begin.elapsed() < Duration::from_secs(20), "{arguments:?}");
}

#[cfg(unix)]
#[test]
fn scenes_must_be_files() {
    let desk = Desk::new();
    let made = std::process::Command::new("mkfifo")
        .arg(desk.path().join("pipe.toml"))
        .status();
    assert!(made.expect("mkfifo is there").success());
    std::fs::create_dir(desk.path().join("folder.toml")).expect("a folder");
    std::os::unix::fs::symlink("/dev/zero", desk.path().join("zero.toml")).expect("a link");
    for name in ["pipe.toml", "zero.toml"] {
        refuse_soon(
            &desk,
            &["pack", name],
            &[name, "a pipe or a device", "save"],
        );
    }
    refuse_soon(&desk, &["pack", "folder.toml"], &["a folder"]);
    std::fs::rename(desk.path().join("pipe.toml"), desk.path().join("pipe.csv")).expect("a name");
    for name in ["pipe.csv", "/dev/zero"] {
        refuse_soon(
            &desk,
            &["quality", "pipe.csv", "--spacing", "1"],
            &["a pipe or a device"],
        );
        let spacing = ["--spacing", "1"];
        refuse_soon(&desk, &["check", name], &["a pipe or a device"]);
        refuse_soon(
            &desk,
            &[&["pack", name], &spacing[..]].concat(),
            &["a pipe or a device"],
        );
    }
}

#[test]
fn scenes_have_an_end() {
    let bodies = "[[body]]\nshape = { circle = { center = [0, 0], radius = 1 } }\n";
    let desk = Desk::new()
        .with("many.toml", CYLINDER.to_owned() + &bodies.repeat(100_000))
        .with(
            "long.toml",
            CYLINDER.to_owned() + &"# a remark\n".repeat(1_000_000),
        )
        .with(
            "deep.toml",
            format!("spacing = {}{}", "[".repeat(10_000), "]".repeat(10_000)),
        );
    refuse_soon(
        &desk,
        &["pack", "many.toml"],
        &["100001 bodies; 1000 are the most"],
    );
    refuse_soon(
        &desk,
        &["pack", "long.toml"],
        &["long.toml", "bytes, too many for a scene"],
    );
    refuse_soon(
        &desk,
        &["pack", "deep.toml"],
        &["deep.toml:1", "remove brackets"],
    );
}

#[test]
fn domains_beyond_counting() {
    for (spacing, max) in [("1e-300", "1e300"), ("1e-10", "1e10"), ("0.2", "1e160")] {
        let mut scene = format!("spacing = {spacing}\n");
        let _ = write!(
            scene,
            "[domain]\nmin = [-{max}, -{max}]\nmax = [{max}, {max}]\n"
        );
        scene += "[[body]]\nshape = { circle = { center = [0, 0], radius = 1 } }\n";
        let desk = Desk::new().with("scene.toml", scene);
        let ending = desk.run(&["pack", "scene.toml"]);
        assert_eq!(ending.status, Some(2), "{ending:?}");
        assert!(
            !ending.stderr.contains("NaN") && !ending.stderr.contains("inf "),
            "{ending:?}"
        );
        assert!(ending.stderr.contains("larger spacing"), "{ending:?}");
    }
}

/// Runs the command with limits that a shell sets.
#[cfg(target_os = "linux")]
fn limited(desk: &Desk, limits: &str, arguments: &[&str]) -> (Option<i32>, String) {
    let output = std::process::Command::new("bash")
        .args(["-c", &format!("{limits}; exec \"$0\" \"$@\"")])
        .arg(env!("CARGO_BIN_EXE_sphpack"))
        .args(arguments)
        .current_dir(desk.path())
        .output()
        .expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), said)
}

#[cfg(target_os = "linux")]
#[test]
fn limits_of_memory_are_kept() {
    let large = CYLINDER.replace("spacing = 0.2", "spacing = 0.002");
    let desk = Desk::new().with("scene.toml", large);
    let arguments = ["pack", "scene.toml", "--dry-run", "--threads", "1"];
    let (status, said) = limited(&desk, ":", &arguments);
    assert_eq!(status, Some(0), "{said}");
    let (status, said) = limited(&desk, "ulimit -v 400000", &arguments);
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("of memory, more than the"), "{said}");
    assert!(said.contains("MiB allowed"), "{said}");
}

/// Threads' heaps take address space that the estimate knows nothing of; what is refused or packed never dies of it.
#[cfg(target_os = "linux")]
#[test]
fn little_address_space_is_no_abort() {
    let large = CYLINDER.replace("spacing = 0.2", "spacing = 0.02");
    let desk = Desk::new().with("scene.toml", large);
    let arguments = ["pack", "scene.toml", "-q", "--force", "--threads", "2"];
    for limit in [70_000, 100_000, 150_000, 250_000, 350_000] {
        let (status, said) = limited(&desk, &format!("ulimit -v {limit}"), &arguments);
        assert!(matches!(status, Some(0..=2)), "{limit}: {status:?}, {said}");
        assert!(status == Some(0) || said.contains("memory"), "{said}");
    }
}

/// The least limit of address space, KiB, under which the command speaks at all: below, the system does not load it, or its runtime
/// does not begin.
#[cfg(target_os = "linux")]
fn least_address_space(desk: &Desk) -> usize {
    let speaks = |limit: usize| {
        let (status, _) = limited(desk, &format!("ulimit -v {limit}"), &["--version"]);
        matches!(status, Some(0 | 1))
    };
    let (mut low, mut high) = (8_000, 400_000);
    while high - low > 20 {
        let middle = usize::midpoint(low, high);
        if speaks(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// Threads start where there is room for them, or not at all: one that finds none for its stack, for its heap, or for what it
/// keeps for itself ends the process.
#[cfg(target_os = "linux")]
#[test]
fn threads_without_address_space_are_no_abort() {
    let desk = Desk::new().with("scene.toml", CYLINDER);
    let least = least_address_space(&desk);
    // By stacks, 2 MiB each, and by heaps, 64 MiB.
    let stacks = (0..120).map(|k| least + 75 * k);
    let heaps = (1..5).flat_map(|k| (0..10).map(move |j| 65_536 * k + 700 * j));
    for limit in stacks.chain(heaps.map(|more| least + more)) {
        for threads in ["1", "4"] {
            let arguments = ["pack", "scene.toml", "--dry-run", "--threads", threads];
            let (status, said) = limited(&desk, &format!("ulimit -v {limit}"), &arguments);
            assert!(matches!(status, Some(0..=2)), "{limit}: {status:?}, {said}");
            assert!(status == Some(0) || said.contains("memory"), "{said}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn fewer_threads_are_said() {
    let desk = Desk::new().with("scene.toml", CYLINDER);
    let command = "ulimit -v 400000; export RAYON_NUM_THREADS=64";
    let (status, said) = limited(&desk, command, &["pack", "scene.toml", "--dry-run"]);
    assert_eq!(status, Some(0), "{said}");
    assert!(said.contains("not one for each core"), "{said}");
}

/// What is read to be measured takes several times its own size.
#[cfg(target_os = "linux")]
#[test]
fn little_memory_for_measuring_is_no_abort() {
    let rows: String = (0..40_000)
        .map(|i| format!("{},{}\n", i % 200, i / 200))
        .collect();
    let desk = Desk::new().with("p.csv", format!("x,y\n{rows}"));
    for limit in [8_000, 12_000, 16_000, 24_000, 60_000] {
        let (status, said) = limited(
            &desk,
            &format!("ulimit -d {limit}"),
            &["quality", "p.csv", "--spacing", "1"],
        );
        assert!(matches!(status, Some(0..=3)), "{limit}: {status:?}, {said}");
        assert!(
            matches!(status, Some(0 | 3)) || said.contains("memory"),
            "{said}"
        );
    }
}

/// The system ends who writes more than it may with a signal, unless it is seen before.
#[cfg(target_os = "linux")]
#[test]
fn limits_of_files_are_kept() {
    let finer = CYLINDER.replace("spacing = 0.2", "spacing = 0.1");
    let free = Desk::new().with("scene.toml", &*finer);
    free.succeed(&["pack", "scene.toml", "-q", "-o", "a.ply", "-o", "b.csv"]);
    let [binary, text] = ["a.ply", "b.csv"].map(|name| free.read(name).len());
    let desk = Desk::new().with("scene.toml", finer).with("b.csv", "old");
    let outputs = ["-o", "a.ply", "-o", "b.csv"];
    let arguments = [&["pack", "scene.toml", "-q", "--force"], &outputs[..]].concat();
    let (status, said) = limited(&desk, "ulimit -f 1", &arguments);
    assert_eq!(status, Some(1), "{said}");
    for part in ["cannot write a.ply", "ulimit -f"] {
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(desk.files(), ["b.csv", "scene.toml"]);
    // Longer than the binary file, shorter than the text.
    let kibibytes = (binary + text) / 2 / 1024;
    assert!(binary < 1024 * kibibytes && 1024 * kibibytes < text);
    let (status, said) = limited(&desk, &format!("ulimit -f {kibibytes}"), &arguments);
    assert_eq!(status, Some(1), "{said}");
    for part in ["cannot write b.csv", "kept as a.rescued.ply"] {
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(desk.read("b.csv"), b"old");
    assert_eq!(desk.files(), ["a.rescued.ply", "b.csv", "scene.toml"]);
}

#[cfg(target_os = "linux")]
#[test]
fn threads_that_are_refused_are_an_error() {
    let desk = Desk::new().with("scene.toml", CYLINDER);
    // So many stacks do not fit.
    let arguments = ["pack", "scene.toml", "--threads", "1024"];
    let (status, said) = limited(&desk, "ulimit -v 600000", &arguments);
    assert_eq!(status, Some(1), "{said}");
    assert!(
        said.contains("1024 threads cannot be started") && said.contains("--threads 1"),
        "{said}"
    );
    assert_eq!(desk.files(), ["scene.toml"]);
}
