//! `sphpack view`.

use std::path::{Path, PathBuf};

use super::arguments::ViewArguments;
use super::plain_text::visible;
use super::{outputs, say};
use crate::Error;
use crate::error::DONE;
use crate::files::{AtomicFiles, Columns};
use crate::picture::grouped;
use crate::places::check_memory;
use crate::view::View;

pub(super) fn run(arguments: &ViewArguments) -> Result<u8, Error> {
    let ViewArguments {
        particles, output, ..
    } = arguments;
    let page = output.clone().unwrap_or_else(|| beside(particles));
    outputs::check_name(&page)?;
    let ending = page.extension().map(|e| e.to_string_lossy().to_lowercase());
    if !matches!(ending.as_deref(), Some("html" | "htm")) {
        return Err(Error::input(&page, "the page is HTML; name it .html"));
    }
    let inputs = std::slice::from_ref(particles);
    outputs::check(&[&page], inputs, arguments.force)?;
    check_memory(particles, "showing")?;
    let view = View::of(Columns::read(particles)?, particles)?;
    let mut files = AtomicFiles::new(arguments.force);
    files.write(&page, |to| view.write(to))?;
    files.finish()?;
    let bytes = std::fs::metadata(&page).map_or(0, |meta| meta.len());
    say(&format!(
        "  particles  {} in {}-D, coloured by {}\n  wrote      {} ({:.1} MB); open it in a browser\n",
        grouped(view.len()),
        view.dimension(),
        visible(view.colour()),
        visible(&page.display().to_string()),
        bytes as f64 / 1e6,
    ))?;
    Ok(DONE)
}

/// NAME.html in the working directory.
fn beside(particles: &Path) -> PathBuf {
    let stem = particles.file_stem().unwrap_or_default();
    let mut name = stem.to_owned();
    name.push(".html");
    PathBuf::from(name)
}
