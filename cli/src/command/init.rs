//! `sphpack init`.

use super::arguments::InitArguments;
use super::plain_text::visible;
use super::{outputs, say};
use crate::Error;
use crate::error::DONE;
use crate::files::AtomicFiles;
use crate::scene::{TEMPLATE, json_schema};

pub(super) fn run(arguments: &InitArguments) -> Result<u8, Error> {
    let text = match arguments.schema {
        true => format!("{:#}\n", json_schema()),
        false => TEMPLATE.to_owned(),
    };
    let Some(path) = &arguments.file else {
        say(&text)?;
        return Ok(DONE);
    };
    outputs::check(&[path], &[], arguments.force)?;
    let mut files = AtomicFiles::new(arguments.force);
    files.write(path, |to| to.write_all(text.as_bytes()))?;
    files.finish()?;
    let name = visible(&path.display().to_string());
    say(&match arguments.schema {
        true => format!(
            "wrote {name}; a scene whose first line is #:schema {name} is checked by it in editors that know TOML\n"
        ),
        false => format!("wrote {name}; pack it with: sphpack pack {name}\n"),
    })?;
    Ok(DONE)
}
