//! `sphpack init`.

use super::arguments::InitArguments;
use super::plain_text::visible;
use super::{outputs, say};
use crate::Error;
use crate::error::DONE;
use crate::files::AtomicFiles;
use crate::scene::TEMPLATE;

pub(super) fn run(arguments: &InitArguments) -> Result<u8, Error> {
    let Some(path) = &arguments.file else {
        say(TEMPLATE)?;
        return Ok(DONE);
    };
    outputs::check(&[path], &[], arguments.force)?;
    let mut files = AtomicFiles::new(arguments.force);
    files.write(path, |to| to.write_all(TEMPLATE.as_bytes()))?;
    files.finish()?;
    say(&format!(
        "wrote {0}; pack it with: sphpack pack {0}\n",
        visible(&path.display().to_string())
    ))?;
    Ok(DONE)
}
