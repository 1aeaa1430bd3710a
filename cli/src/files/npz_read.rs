//! Reading NumPy's archives, as far as particles need it: arrays of numbers and words with one axis.

use std::io::Read;
use std::path::Path;

use flate2::Crc;
use flate2::read::DeflateDecoder;

use super::columns::NUMBERS;
use super::npy_read::{Array, Values, number};
use super::{Columns, MAX_INPUT};
use crate::Error;

/// Reads particles: every array of numbers or words with one axis and as many entries as x has; others are left out.
/// Files may be stored or deflated. Holds one array beside the columns and the bytes.
///
/// # Errors
/// [`Error::Input`] where the file is damaged, or an array that particles need cannot be read.
pub fn read_npz(bytes: &[u8], path: &Path) -> Result<Columns, Error> {
    read(bytes).map_err(|message| Error::input(path, message))
}

/// Sizes up to here are inflated whatever they were before, bytes.
const HARMLESS: u64 = 256 << 20;

/// How many times larger than the file more than that may become; columns of a lattice come to about a hundred.
const MOST_GROWTH: u64 = 200;

/// A few bytes that would fill the memory are refused before they do.
fn refuse_bomb(members: &[Member], size: usize) -> Result<(), String> {
    let grown = members
        .iter()
        .fold(0_u64, |sum, member| sum.saturating_add(member.size));
    if grown <= HARMLESS || grown / MOST_GROWTH <= size as u64 {
        return Ok(());
    }
    Err(format!(
        "its {size} bytes would grow to {grown}, more than {MOST_GROWTH} times as many, as no particles do; if they are particles, save them uncompressed (numpy.savez)"
    ))
}

fn damaged(what: &str) -> String {
    format!("the NPZ file is damaged: {what}; write it again")
}

fn read(bytes: &[u8]) -> Result<Columns, String> {
    let mut columns = Columns::default();
    let mut budget = MAX_INPUT;
    let mut has_objects = false;
    let members = directory(bytes)?;
    refuse_bomb(&members, bytes.len())?;
    for member in members {
        let Some(name) = member.name.strip_suffix(".npy") else {
            continue;
        };
        let content = member.content(bytes, budget)?;
        budget -= content.len() as u64;
        let complain = |what: &str| damaged(&format!("array {name} {what}"));
        let array = Array::of(&content).ok_or_else(|| complain("has no readable head"))?;
        has_objects |= array.is_of_objects();
        let [count] = array.shape[..] else {
            continue;
        };
        match array.values(count) {
            Some(Values::Numbers(numbers)) => {
                columns.numbers.insert(name.to_owned(), numbers);
            }
            Some(Values::Words(words)) => {
                columns.words.insert(name.to_owned(), words);
            }
            None if array.is_known() => return Err(complain("is cut off")),
            None => {}
        }
    }
    columns.lower_case();
    let Some(count) = columns.numbers.get("x").map(Vec::len) else {
        if has_objects {
            return Err(
                "its arrays are objects of Python, which only Python can read; save the numbers themselves: numpy.savez(FILE, x=…, y=…, m=…, rho=…, h=…)"
                    .into(),
            );
        }
        let names: Vec<&str> = columns
            .numbers
            .keys()
            .map(String::as_str)
            .take(20)
            .collect();
        return Err(format!(
            "there is no array \"x\" of numbers with one axis (there are: {}); save x, y, z each as an array of its own",
            names.join(", ")
        ));
    };
    let lengths = (columns.numbers.iter().map(|(name, all)| (name, all.len())))
        .chain(columns.words.iter().map(|(name, all)| (name, all.len())));
    for (name, length) in lengths {
        let is_needed = NUMBERS.contains(&name.as_str())
            || matches!(name.as_str(), "kind" | "nx" | "ny" | "nz");
        if is_needed && length != count {
            return Err(format!(
                "array {name} has {length} entries, array x has {count}; all must have as many"
            ));
        }
    }
    columns.numbers.retain(|_, all| all.len() == count);
    columns.words.retain(|_, all| all.len() == count);
    Ok(columns)
}

/// A file in the archive.
struct Member {
    name: String,
    method: u64,
    sum: u32,
    packed: u64,
    size: u64,
    offset: u64,
}

/// What the archive holds, from the directory at its end.
fn directory(bytes: &[u8]) -> Result<Vec<Member>, String> {
    const END: &[u8] = b"PK\x05\x06";
    let begin = bytes.len().saturating_sub(22 + 0xffff);
    let end = bytes[begin..]
        .windows(END.len())
        .rposition(|window| window == END)
        .map(|at| begin + at)
        .ok_or("this is no NPZ file, or its end is missing; numpy.savez writes one")?;
    let members = (|| {
        let mut start = number(bytes, end + 16, 4)?;
        let mut count = number(bytes, end + 10, 2)?;
        if let Some(locator) = end.checked_sub(20)
            && bytes.get(locator..locator + 4)? == b"PK\x06\x07"
        {
            let far = usize::try_from(number(bytes, locator + 8, 8)?).ok()?;
            count = number(bytes, far.checked_add(32)?, 8)?;
            start = number(bytes, far.checked_add(48)?, 8)?;
        }
        let mut at = usize::try_from(start).ok()?;
        let mut members = Vec::new();
        for _ in 0..count {
            let (member, next) = Member::at(bytes, at)?;
            members.push(member);
            at = next;
        }
        Some(members)
    })();
    members.ok_or_else(|| damaged("its directory makes no sense"))
}

impl Member {
    /// The entry of the directory at `at`, and where the next one is.
    fn at(bytes: &[u8], at: usize) -> Option<(Self, usize)> {
        let entry = bytes.get(at..)?;
        let field = |place: usize, size: usize| number(entry, place, size);
        if entry.get(..4)? != b"PK\x01\x02" {
            return None;
        }
        let [name, extra, remark] =
            [field(28, 2)?, field(30, 2)?, field(32, 2)?].map(|n| n as usize);
        let mut member = Self {
            name: String::from_utf8_lossy(entry.get(46..46 + name)?).into_owned(),
            method: field(10, 2)?,
            sum: field(16, 4)? as u32,
            packed: field(20, 4)?,
            size: field(24, 4)?,
            offset: field(42, 4)?,
        };
        let mut more = entry.get(46 + name..46 + name + extra)?;
        while more.len() >= 4 {
            let (id, length) = (number(more, 0, 2)?, number(more, 2, 2)? as usize);
            let content = more.get(4..4 + length)?;
            if id == 1 {
                // Only those that had no room above are here, in this order.
                let large = [&mut member.size, &mut member.packed, &mut member.offset];
                for (place, value) in large.into_iter().filter(|n| **n == 0xffff_ffff).enumerate() {
                    *value = number(content, 8 * place, 8)?;
                }
            }
            more = &more[4 + length..];
        }
        Some((member, at + 46 + name + extra + remark))
    }

    /// The file's bytes; refuses more than `most`.
    fn content(&self, bytes: &[u8], most: u64) -> Result<Vec<u8>, String> {
        let complain = |what: &str| damaged(&format!("{} {what}", self.name));
        if self.size > most {
            return Err(format!(
                "the arrays have more than the {MAX_INPUT} bytes that are read; use fewer"
            ));
        }
        let packed = (|| {
            let at = usize::try_from(self.offset).ok()?;
            let head = bytes.get(at..)?;
            let skip = 30 + number(head, 26, 2)? as usize + number(head, 28, 2)? as usize;
            head.get(skip..)?.get(..usize::try_from(self.packed).ok()?)
        })()
        .ok_or_else(|| complain("is cut off"))?;
        let mut content = Vec::new();
        let done = match self.method {
            0 => packed.take(self.size).read_to_end(&mut content),
            8 => (DeflateDecoder::new(packed).take(self.size)).read_to_end(&mut content),
            _ => return Err(complain("is compressed in a way that is not read")),
        };
        let mut sum = Crc::new();
        sum.update(&content);
        if done.is_err() || content.len() as u64 != self.size || sum.sum() != self.sum {
            return Err(complain("is not what its checksum says"));
        }
        Ok(content)
    }
}
