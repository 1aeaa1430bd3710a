//! Pages of `sphpack view` in a real browser: what they say, and what is seen in a picture of them.

mod browser;
mod judge;
mod pages;

use std::fs;
use std::path::{Path, PathBuf};

use sphpack::view::View;

use crate::arguments::Arguments;
use crate::workspace::root;
use browser::{Browser, Shown};
use judge::Picture;
use pages::Page;

/// What to run.
#[derive(Debug, Default)]
pub(crate) struct Settings {
    /// The browser, where it is none of the usual names.
    browser: Option<PathBuf>,
    /// Small pages only.
    quick: bool,
}

impl Settings {
    /// The arguments that say it.
    pub(crate) const KNOWN: &[&str] = &["--browser PROGRAM", "--quick"];

    pub(crate) fn of(arguments: &Arguments) -> Self {
        Self {
            browser: arguments.path("--browser"),
            quick: arguments.has("--quick"),
        }
    }

    /// What a change must pass.
    pub(crate) fn quick() -> Self {
        Self {
            browser: None,
            quick: true,
        }
    }
}

/// Shows pages, and judges what is seen. Pictures stay in target/view.
pub(crate) fn run(settings: &Settings) -> Result<(), String> {
    let Some(browser) = Browser::find(settings.browser.as_deref())? else {
        eprintln!("── there is no Chromium: pages are not looked at");
        return Ok(());
    };
    let desk = Desk {
        browser,
        folder: root().join("target/view"),
    };
    fs::create_dir_all(&desk.folder)
        .map_err(|error| format!("{}: {error}", desk.folder.display()))?;
    looked_at(|| plane(&desk))?;
    looked_at(|| space(&desk))?;
    if !settings.quick {
        body(&desk)?;
        million(&desk)?;
    }
    Ok(())
}

/// Pictures of a page that are taken before what is seen is wrong: at times the browser has not shown the last frame.
const PICTURES: usize = 3;

/// Looks at a page until what is seen is right.
fn looked_at(look: impl Fn() -> Result<(), String>) -> Result<(), String> {
    let mut last = Ok(());
    for _ in 0..PICTURES {
        last = look();
        if last.is_ok() {
            break;
        }
    }
    last
}

/// A browser, and where pages and pictures go.
struct Desk {
    browser: Browser,
    folder: PathBuf,
}

impl Desk {
    /// Shows a page once `steps`, a script, are done, and gives what the script says, with a picture.
    fn show(&self, page: &Page, name: &str, steps: &str) -> Result<(Shown, Picture), String> {
        let html = self.written(page, name, steps)?;
        let picture = self.folder.join(format!("{name}.png"));
        let shown = self.browser.picture(&html, &picture)?;
        check_ready(page, &shown)?;
        println!("{name}: {}, seen in {}", shown.count, picture.display());
        Ok((shown, Picture::read(&picture)?))
    }

    fn written(&self, page: &Page, name: &str, steps: &str) -> Result<PathBuf, String> {
        let view = View::of(page.columns.clone(), Path::new(page.name))
            .map_err(|error| error.to_string())?;
        let mut html = Vec::new();
        view.write(&mut html).map_err(|error| error.to_string())?;
        let html = String::from_utf8(html).map_err(|error| error.to_string())?;
        let path = self.folder.join(format!("{name}.html"));
        fs::write(&path, browser::with_steps(&html, steps))
            .map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(path)
    }
}

fn check_ready(page: &Page, shown: &Shown) -> Result<(), String> {
    let rows = page.columns.numbers["x"].len();
    if shown.ready == rows {
        return Ok(());
    }
    Err(format!(
        "{}: the page shows {} of {rows} particles; it says: {}",
        page.name, shown.ready, shown.trouble
    ))
}

fn expect(is_so: bool, words: &str) -> Result<(), String> {
    if is_so { Ok(()) } else { Err(words.to_owned()) }
}

/// A plane far from the origin: colours in their places, in as many pixels as there are particles, and the row under the pointer.
fn plane(desk: &Desk) -> Result<(), String> {
    let page = pages::plane();
    let (shown, picture) = desk.show(&page, "plane", browser::POINT_AT_MIDDLE)?;
    let seen = pages::PLANE_COLOURS.map(|colour| picture.of_colour(colour));
    let rows = page.columns.numbers["gamma"].len() as f64;
    let pixels: usize = seen.iter().map(|spot| spot.pixels).sum();
    println!("plane: {seen:?}");
    for (spot, (expected, [across, up])) in seen.iter().zip(pages::plane_shares(&page)) {
        let share = spot.pixels as f64 / pixels as f64;
        expect(
            (share - expected).abs() < 0.03,
            &format!("plane: {share:.3} of the colours are one that {expected:.3} should be"),
        )?;
        let [is_across, is_up] = spot.middle_within([&seen[0], &seen[2]]);
        expect(
            (is_across - across).abs() < 0.03 && (is_up - up).abs() < 0.03,
            &format!(
                "plane: a colour is at {is_across:.3}, {is_up:.3} of the drawing; it should be at {across:.3}, {up:.3}"
            ),
        )?;
    }
    expect(
        pixels as f64 > 10.0 * rows,
        "plane: particles are too small to see",
    )?;
    let row = (rows as usize / 2).to_string();
    expect(
        shown
            .row
            .split_whitespace()
            .collect::<Vec<_>>()
            .windows(2)
            .any(|w| w == ["id", &row]),
        &format!(
            "plane: the row under the pointer is {:?}; it should be {row}",
            shown.row
        ),
    )
}

/// Three bodies along x: all of them from the front; then without the second, and the upper half alone.
fn space(desk: &Desk) -> Result<(), String> {
    let page = pages::space();
    let (_, picture) = desk.show(
        &page,
        "space",
        &format!("{}{}", browser::BY_BODY, browser::FROM_FRONT),
    )?;
    let all = pages::BODY_COLOURS.map(|colour| picture.of_hue(colour));
    println!("space: {all:?}");
    let is_seen = |spot: &judge::Spot| spot.pixels > 2000;
    expect(all.iter().all(is_seen), "space: a body is not seen")?;
    expect(
        all[0].middle[0] < all[1].middle[0] && all[1].middle[0] < all[2].middle[0],
        "space: bodies are not from left to right along x",
    )?;
    let steps = [
        browser::BY_BODY,
        browser::FROM_FRONT,
        browser::WITHOUT_SECOND,
        browser::UPPER_HALF,
    ]
    .concat();
    let (shown, picture) = desk.show(&page, "space-cut", &steps)?;
    let left = pages::BODY_COLOURS.map(|colour| picture.of_hue(colour));
    println!("space-cut: {left:?}");
    expect(left[1].pixels == 0, "space-cut: a body that is off is seen")?;
    for k in [0, 2] {
        let [before, now] = [&all[k], &left[k]];
        expect(
            now.bottom < (before.top + before.bottom) / 2 + 8,
            "space-cut: something below the cut is seen",
        )?;
        let part = now.pixels as f64 / before.pixels as f64;
        expect(
            (0.4..0.62).contains(&part),
            &format!("space-cut: {part:.2} of a body is left, not half"),
        )?;
    }
    let expected = page.columns.words["body"]
        .iter()
        .filter(|body| *body != pages::BODIES[1])
        .count();
    // Its thousands are set apart.
    let count = shown.count.replace(',', "");
    expect(
        count.starts_with(&format!("{expected} of ")),
        &format!(
            "space-cut: the page says {:?}; {expected} should be shown",
            shown.count
        ),
    )
}

/// A real body, packed: for people to look at.
fn body(desk: &Desk) -> Result<(), String> {
    let page = pages::spot()?;
    let (shown, _) = desk.show(&page, "spot", "")?;
    expect(
        shown.count.contains(" of "),
        "spot: the fluid hides the body",
    )?;
    desk.show(&page, "spot-slice", browser::SLICE).map(drop)
}

/// A million particles: how long it takes until they are seen, and from then on while they move.
fn million(desk: &Desk) -> Result<(), String> {
    let page = pages::million();
    let html = desk.written(&page, "million", browser::MOVE)?;
    let bytes = fs::metadata(&html).map_or(0, |meta| meta.len());
    let shown = desk.browser.timed(&html)?;
    check_ready(&page, &shown)?;
    println!(
        "million: {} MB; first frame after {} s; frames while moving {} ms",
        bytes / 1_000_000,
        shown.seconds,
        shown.row,
    );
    expect(shown.seconds < 300.0, "million: it takes too long")
}
