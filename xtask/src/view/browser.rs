//! A browser without a window, and what pages say in it.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde::Deserialize;

/// Names under which a Chromium is found.
const NAMES: [&str; 5] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
];

/// No page takes longer, even in software on a busy machine.
const LONGEST: Duration = Duration::from_secs(400);

/// What is before the words of a page on the console.
const MARK: &str = "sphpack-view ";

/// Waits for the page, does what it is told, and says what there is then.
const PROBE: &str = r##"<script>
(() => {
  const page = document.documentElement;
  const by = (id) => document.getElementById(id);
  const frame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const set = (id, value, kind = "change") => {
    by(id).value = value;
    by(id).dispatchEvent(new Event(kind));
  };
  const say = (row = "") => console.log("sphpack-view " + JSON.stringify({
    ready: Number(page.dataset.ready ?? 0),
    seconds: Number(page.dataset.seconds ?? 0),
    trouble: page.dataset.trouble ?? "",
    count: by("count").textContent,
    row,
  }));
  const watch = new MutationObserver(async () => {
    if (!page.dataset.ready && !page.dataset.trouble) return;
    watch.disconnect();
    let row = "";
    if (page.dataset.ready) {
/* steps */
    }
    say(row);
  });
  watch.observe(page, { attributes: true });
})();
</script>"##;

/// Puts the pointer on the middle of the drawing.
pub(super) const POINT_AT_MIDDLE: &str = r##"
const box = by("stage").getBoundingClientRect();
by("stage").dispatchEvent(new PointerEvent("pointermove", {
  clientX: box.left + 0.5 * box.width, clientY: box.top + 0.5 * box.height, pointerType: "mouse",
}));
await frame();
row = [...document.querySelectorAll("#particle tr")].map((line) => [...line.children].map((cell) => cell.textContent).join(" ")).join(" ");
by("stage").dispatchEvent(new PointerEvent("pointerleave"));
await frame();
"##;

pub(super) const BY_BODY: &str = r##"
set("column", "body");
"##;

pub(super) const FROM_FRONT: &str = r##"
document.querySelector('#along button[data-axis="1"]').click();
await frame();
"##;

pub(super) const WITHOUT_SECOND: &str = r##"
[...document.querySelectorAll("#lists label")].find((line) => line.textContent.includes("second")).click();
await frame();
"##;

pub(super) const UPPER_HALF: &str = r##"
set("axis", "z");
set("how", "above");
await frame();
"##;

pub(super) const SLICE: &str = r##"
for (const line of document.querySelectorAll("#lists label")) if (line.textContent.startsWith("fluid")) line.click();
set("column", "kind");
set("axis", "x");
set("how", "slice");
document.querySelector('#along button[data-axis="0"]').click();
await frame();
"##;

/// Slides a cut and notes how long each frame takes, milliseconds.
pub(super) const MOVE: &str = r##"
set("how", "below");
const times = [];
for (let k = 0; k < 8; k += 1) {
  const begin = performance.now();
  set("slide", String(0.3 + 0.05 * k), "input");
  await frame();
  times.push(Math.round(performance.now() - begin));
}
row = times.join(" ");
"##;

/// A page with a script that waits for it.
pub(super) fn with_steps(html: &str, steps: &str) -> String {
    let probe = PROBE.replace("/* steps */", steps);
    html.replace("</body>", &format!("{probe}</body>"))
}

/// What a page says.
#[derive(Debug, Deserialize)]
pub(super) struct Shown {
    /// Particles that are there; 0 where they are not.
    pub(super) ready: usize,
    /// Until the first frame was drawn.
    pub(super) seconds: f64,
    /// What is wrong.
    pub(super) trouble: String,
    /// Its words on how many are shown.
    pub(super) count: String,
    /// What the steps have found.
    pub(super) row: String,
}

/// A Chromium.
pub(super) struct Browser(PathBuf);

impl Browser {
    /// The one that is named, or one of the usual names; `None` where there is none.
    pub(super) fn find(named: Option<&Path>) -> Result<Option<Self>, String> {
        if let Some(program) = named {
            return match starts(program) {
                true => Ok(Some(Self(program.to_owned()))),
                false => Err(format!("{} is no browser that starts", program.display())),
            };
        }
        let found = NAMES.iter().map(PathBuf::from).find(|name| starts(name));
        Ok(found.map(Self))
    }

    /// A picture of a page, and what it says. The browser's clock stands still while it waits for the page, so its seconds are none.
    pub(super) fn picture(&self, page: &Path, picture: &Path) -> Result<Shown, String> {
        let _ = fs::remove_file(picture);
        let screenshot = format!("--screenshot={}", picture.display());
        let log = page.with_extension("log");
        let mut child = self.start(page, &log, &[&screenshot, "--virtual-time-budget=60000"])?;
        let begin = Instant::now();
        let ended = loop {
            match child.try_wait() {
                Ok(Some(_)) => break true,
                Ok(None) if begin.elapsed() < LONGEST => {
                    std::thread::sleep(Duration::from_millis(50));
                }
                _ => break false,
            }
        };
        if !ended {
            end(&mut child);
            return Err(format!("{}: the browser does not end", page.display()));
        }
        said(&log)?.ok_or_else(|| {
            format!(
                "{}: the page says nothing; see {}",
                page.display(),
                log.display()
            )
        })
    }

    /// What a page says, by a clock that goes on.
    pub(super) fn timed(&self, page: &Path) -> Result<Shown, String> {
        let log = page.with_extension("log");
        let mut child = self.start(page, &log, &[])?;
        let begin = Instant::now();
        let shown = loop {
            match said(&log) {
                Ok(None) if begin.elapsed() < LONGEST => {
                    std::thread::sleep(Duration::from_millis(100));
                }
                Ok(None) => break Err(format!("{}: it takes too long", page.display())),
                Ok(Some(shown)) => break Ok(shown),
                Err(error) => break Err(error),
            }
        };
        end(&mut child);
        shown
    }

    /// Opens a page from the disk, drawn in software, in a profile of its own. What it says goes to `log`.
    fn start(&self, page: &Path, log: &Path, more: &[&str]) -> Result<Child, String> {
        let profile = page.with_extension("profile");
        let _ = fs::remove_dir_all(&profile);
        let to = File::create(log).map_err(|error| format!("{}: {error}", log.display()))?;
        Command::new(&self.0)
            .args([
                "--headless=new",
                "--no-sandbox",
                "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader",
                "--hide-scrollbars",
                "--force-device-scale-factor=1",
                "--window-size=1280,800",
                "--enable-logging=stderr",
            ])
            .arg(format!("--user-data-dir={}", profile.display()))
            .args(more)
            .arg(format!("file://{}", page.display()))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(to)
            .spawn()
            .map_err(|error| format!("{} cannot be started: {error}", self.0.display()))
    }
}

/// Whether a program starts.
fn starts(program: &Path) -> bool {
    let answer = Command::new(program).arg("--version").output();
    answer.is_ok_and(|answer| answer.status.success())
}

/// Ends a browser that was started here.
fn end(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}

/// A page's words among those of the browser.
fn said(log: &Path) -> Result<Option<Shown>, String> {
    let bytes = fs::read(log).map_err(|error| format!("{}: {error}", log.display()))?;
    let text = String::from_utf8_lossy(&bytes);
    let words = text.lines().find_map(|line| {
        let (_, rest) = line.split_once(MARK)?;
        let (words, _) = rest.rsplit_once("\", source:")?;
        Some(words)
    });
    words
        .map(|words| serde_json::from_str(words).map_err(|error| format!("{words}: {error}")))
        .transpose()
}
