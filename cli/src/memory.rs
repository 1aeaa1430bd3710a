//! How much memory this process may still use: what the machine has, and what limits leave of it.

use std::fs;
use std::path::Path;

/// Where the system does not say how much memory there is.
const FALLBACK_BYTES: f64 = 8.0 * 1024.0 * 1024.0 * 1024.0;

/// Address space that glibc keeps for each thread's own heap, bytes. A thread that gets none takes a page for every
/// little thing, and is soon out of memory where there is some.
const THREAD_HEAP_BYTES: u64 = 64 << 20;

/// Address space of a thread's stack, 2 MiB, with what guards it and what it keeps for itself.
const THREAD_STACK_BYTES: u64 = 3 << 20;

/// Threads beside those that compute, as far as address space goes: one waits for Ctrl-C; and a heap takes twice its size for a
/// moment.
const MORE_THREADS: u64 = 2;

/// Address space for all that comes before particles.
const LEAST_BYTES: u64 = 8 << 20;

/// Memory that can be had without swapping and within this process's limits, bytes. Reads a few small files.
pub(crate) fn available_bytes() -> f64 {
    available_in(Path::new("/"), || {
        (rayon::current_num_threads() as u64 + MORE_THREADS) * THREAD_HEAP_BYTES
    })
}

/// Address space that is left under a limit (ulimit -v), bytes.
pub(crate) fn address_space_left() -> Option<u64> {
    space_left(Path::new("/"))
}

fn space_left(root: &Path) -> Option<u64> {
    left(root, "Max address space", "VmSize:")
}

/// Address space that so many threads that compute want, with all that comes before particles, bytes. Where there is less, a
/// thread that starts finds no room for its heap, or for what it keeps for itself, and that ends the process.
pub(crate) fn address_space_of(threads: u64) -> u64 {
    (threads + MORE_THREADS) * (THREAD_HEAP_BYTES + THREAD_STACK_BYTES) + LEAST_BYTES
}

/// The same, of a system whose files are below `root`, where threads want so much address space.
fn available_in(root: &Path, of_threads: impl Fn() -> u64) -> f64 {
    let machine = kibibytes(root, "proc/meminfo", "MemAvailable:").map(|bytes| bytes as f64);
    let limited = limited(root, of_threads);
    [limited, unified_group(root), memory_group(root)]
        .into_iter()
        .flatten()
        .fold(machine.unwrap_or(FALLBACK_BYTES), f64::min)
}

/// What the limits of the process itself leave (ulimit -v, ulimit -d).
fn limited(root: &Path, of_threads: impl Fn() -> u64) -> Option<f64> {
    least([
        space_left(root).map(|bytes| bytes.saturating_sub(of_threads()) as f64),
        left(root, "Max data size", "VmData:").map(|bytes| bytes as f64),
    ])
}

/// What a limit leaves of what is used, by their names in the system's lists.
fn left(root: &Path, limit: &str, used: &str) -> Option<u64> {
    let most = soft_limit(root, limit)?;
    Some(most.saturating_sub(kibibytes(root, "proc/self/status", used).unwrap_or(0)))
}

/// The longest file that this process may write (ulimit -f), bytes; `None` where there is no limit, or nobody says.
pub(crate) fn longest_file() -> Option<u64> {
    soft_limit(Path::new("/"), "Max file size")
}

/// A limit of this process, by its name in the system's list.
fn soft_limit(root: &Path, name: &str) -> Option<u64> {
    let limits = fs::read_to_string(root.join("proc/self/limits")).ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix(name))?;
    // "unlimited" is no number.
    line.split_whitespace().next()?.parse().ok()
}

/// What control groups of version 2 leave: the process's own, and all that this one is in.
fn unified_group(root: &Path) -> Option<f64> {
    let group = group(root, |line| line.strip_prefix("0::"))?;
    // Where both versions are there, the second has a folder of its own.
    ["sys/fs/cgroup", "sys/fs/cgroup/unified"]
        .into_iter()
        .filter_map(|mount| {
            up_from(&root.join(mount), &group, |folder| {
                let most = least([
                    number(&folder.join("memory.max")),
                    number(&folder.join("memory.high")),
                ])?;
                let used = number(&folder.join("memory.current")).unwrap_or(0.0);
                Some(most - used + cached(folder, "inactive_file"))
            })
        })
        .reduce(f64::min)
}

/// What control groups of version 1 leave.
fn memory_group(root: &Path) -> Option<f64> {
    let group = group(root, |line| {
        let (_, rest) = line.split_once(':')?;
        let (controllers, path) = rest.split_once(':')?;
        controllers
            .split(',')
            .any(|one| one == "memory")
            .then_some(path)
    })?;
    up_from(&root.join("sys/fs/cgroup/memory"), &group, |folder| {
        let most = number(&folder.join("memory.limit_in_bytes"))?;
        let used = number(&folder.join("memory.usage_in_bytes")).unwrap_or(0.0);
        Some(most - used + cached(folder, "total_inactive_file"))
    })
}

/// The process's group, by the line of its list that `of` knows.
fn group(root: &Path, of: impl Fn(&str) -> Option<&str>) -> Option<String> {
    let groups = fs::read_to_string(root.join("proc/self/cgroup")).ok()?;
    groups.lines().find_map(of).map(str::to_owned)
}

/// The least that `left` finds in a group's folder and those around it, up to where groups are mounted. In a container the
/// list may name groups that cannot be seen from within; those around them can.
fn up_from(mount: &Path, group: &str, left: impl Fn(&Path) -> Option<f64>) -> Option<f64> {
    let inner = mount.join(group.trim_start_matches('/'));
    inner
        .ancestors()
        .take_while(|folder| folder.starts_with(mount))
        .filter_map(left)
        .map(|bytes| bytes.max(0.0))
        .reduce(f64::min)
}

/// What a group counts as used although the system gives it up at once: files that nobody has looked at for a while.
fn cached(folder: &Path, name: &str) -> f64 {
    let read = || {
        let text = fs::read_to_string(folder.join("memory.stat")).ok()?;
        let line = text
            .lines()
            .find_map(|line| line.strip_prefix(name)?.strip_prefix(' '))?;
        line.trim().parse().ok()
    };
    read().unwrap_or(0.0)
}

fn least(of: [Option<f64>; 2]) -> Option<f64> {
    of.into_iter().flatten().reduce(f64::min)
}

/// A file that holds one number; `None` for "max" as well.
fn number(path: &Path) -> Option<f64> {
    let number: u64 = fs::read_to_string(path).ok()?.trim().parse().ok()?;
    Some(number as f64)
}

/// A line "NAME  123 kB" of a file, in bytes.
fn kibibytes(root: &Path, file: &str, name: &str) -> Option<u64> {
    let path = root.join(file);
    crate::report::kibibytes(path.to_str()?, name)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A system with so many kilobytes free, and these files.
    #[track_caller]
    fn check(files: &[(&str, &str)], expected: f64) {
        let root = tempfile::tempdir().unwrap();
        for (name, content) in files {
            let path = root.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, content).unwrap();
        }
        assert_eq!(available_in(root.path(), || 24_000), expected);
    }

    const FREE: (&str, &str) = (
        "proc/meminfo",
        "MemTotal:  9000 kB\nMemAvailable:   8000 kB\n",
    );
    const FREE_BYTES: f64 = 8_192_000.0;

    #[test]
    fn what_the_machine_has() {
        check(&[], FALLBACK_BYTES);
        check(&[FREE], FREE_BYTES);
    }

    #[test]
    fn what_the_process_may() {
        let status = (
            "proc/self/status",
            "VmPeak:  9 kB\nVmSize:\t 1000 kB\nVmData:\t 500 kB\n",
        );
        let head = "Limit                     Soft Limit           Hard Limit           Units\n";
        let limits = |size: &str, data: &str| {
            format!(
                "{head}Max data size             {data}            unlimited            bytes     \nMax address space         {size}            unlimited            bytes     \n"
            )
        };
        for (size, data, expected) in [
            ("unlimited", "unlimited", FREE_BYTES),
            ("2048000", "unlimited", 1_000_000.0),
            ("2048000", "1024000", 512_000.0),
            // More is used already than may be.
            ("1000", "unlimited", 0.0),
        ] {
            check(
                &[FREE, status, ("proc/self/limits", &limits(size, data))],
                expected,
            );
        }
    }

    #[test]
    fn what_groups_leave() {
        let own = ("proc/self/cgroup", "0::/a/b\n");
        let at = "sys/fs/cgroup/";
        check(&[FREE, own], FREE_BYTES);
        check(
            &[
                FREE,
                own,
                (&format!("{at}a/b/memory.max"), "max\n"),
                (&format!("{at}a/b/memory.current"), "77\n"),
                (&format!("{at}a/memory.max"), "5000\n"),
                (&format!("{at}a/memory.current"), "3000\n"),
                (
                    &format!("{at}a/memory.stat"),
                    "inactive_file 500\nactive_file 9\n",
                ),
            ],
            2500.0,
        );
        // Within a container the own group is the mount.
        check(
            &[
                FREE,
                ("proc/self/cgroup", "0::/\n"),
                (&format!("{at}memory.high"), "4000\n"),
                (&format!("{at}memory.max"), "5000\n"),
                (&format!("{at}memory.current"), "9000\n"),
            ],
            0.0,
        );
    }

    #[test]
    fn what_groups_of_version_1_leave() {
        let own = ("proc/self/cgroup", "5:cpu,memory:/far/away\n0::/\n");
        let at = "sys/fs/cgroup/memory/";
        check(
            &[
                FREE,
                own,
                (&format!("{at}memory.limit_in_bytes"), "6000\n"),
                (&format!("{at}memory.usage_in_bytes"), "1000\n"),
                (&format!("{at}memory.stat"), "total_inactive_file 100\n"),
            ],
            5100.0,
        );
        check(
            &[
                FREE,
                own,
                (&format!("{at}far/away/memory.limit_in_bytes"), "3000\n"),
                (&format!("{at}far/away/memory.usage_in_bytes"), "1000\n"),
                (
                    &format!("{at}memory.limit_in_bytes"),
                    "9223372036854771712\n",
                ),
            ],
            2000.0,
        );
    }

    #[test]
    fn this_machine_has_some() {
        assert!(available_bytes() > 0.0);
    }
}
