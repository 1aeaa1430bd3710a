//! Zip archives whose files are stored as they are.

use std::io::{self, Write};

use flate2::Crc;

/// Sizes from here on do not fit where the first version of the format has room for them.
const LIMIT: u64 = 0xffff_ffff;

/// What the directory says about one file.
struct Member {
    name: String,
    sum: u32,
    size: u64,
    offset: u64,
}

/// An archive being written, front to back.
pub(super) struct Zip<'a> {
    to: &'a mut dyn Write,
    written: u64,
    /// From which size on 64 bits are used.
    limit: u64,
    members: Vec<Member>,
}

/// Counts and sums up what is written to it.
#[derive(Default)]
struct Sum(Crc, u64);

impl Write for Sum {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        self.1 += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A record: its signature and its numbers, each in as many bytes as it has.
macro_rules! record {
    ($signature:expr $(, $number:expr)*) => {{
        let mut bytes = u32::to_le_bytes($signature).to_vec();
        $(bytes.extend($number.to_le_bytes());)*
        bytes
    }};
}

impl<'a> Zip<'a> {
    pub(super) fn new(to: &'a mut dyn Write) -> Self {
        Self::with_limit(to, LIMIT)
    }

    /// An archive that uses 64 bits from the size `limit` on.
    pub(super) fn with_limit(to: &'a mut dyn Write, limit: u64) -> Self {
        Self {
            to,
            written: 0,
            limit,
            members: Vec::new(),
        }
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.written += bytes.len() as u64;
        self.to.write_all(bytes)
    }

    /// A number in 32 bits, or the sign that it is found elsewhere.
    fn short(&self, number: u64) -> u32 {
        if number < self.limit {
            number as u32
        } else {
            u32::MAX
        }
    }

    /// The numbers that [`Zip::short`] has no room for, as a record of their own.
    fn long(&self, numbers: &[u64]) -> Vec<u8> {
        let large: Vec<u8> = (numbers.iter())
            .filter(|&&number| number >= self.limit)
            .flat_map(|number| number.to_le_bytes())
            .collect();
        if large.is_empty() {
            return large;
        }
        let mut field = 1_u16.to_le_bytes().to_vec();
        field.extend((large.len() as u16).to_le_bytes());
        field.extend(large);
        field
    }

    /// Adds a file. `content` is called twice, once for its size and checksum, and must write the same both times.
    pub(super) fn add(
        &mut self,
        name: &str,
        content: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut sum = Sum::default();
        content(&mut sum)?;
        let Sum(sum, size) = sum;
        let member = Member {
            name: name.to_owned(),
            sum: sum.sum(),
            size,
            offset: self.written,
        };
        // Both sizes are there, or none.
        let extra = self.long(&[size, size]);
        let mut head = self.head(0x0403_4b50, &[], &member, extra.len());
        head.extend(name.bytes());
        head.extend(&extra);
        self.put(&head)?;
        content(self.to)?;
        self.written += size;
        self.members.push(member);
        Ok(())
    }

    /// What begins a file and its entry in the directory alike.
    fn head(&self, signature: u32, made_by: &[u8], member: &Member, extra: usize) -> Vec<u8> {
        let version: u16 = if extra > 0 { 45 } else { 20 };
        let size = self.short(member.size);
        // No flags; stored; midnight, 1980-01-01.
        let (flags, method, time, date) = (0_u16, 0_u16, 0_u16, 0x21_u16);
        let name = member.name.len() as u16;
        let mut bytes = signature.to_le_bytes().to_vec();
        bytes.extend(made_by);
        bytes.extend(version.to_le_bytes());
        for number in [flags, method, time, date] {
            bytes.extend(number.to_le_bytes());
        }
        for number in [member.sum, size, size] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(name.to_le_bytes());
        bytes.extend((extra as u16).to_le_bytes());
        bytes
    }

    /// Writes the directory, and with it a remark on the whole.
    pub(super) fn finish(mut self, remark: &str) -> io::Result<()> {
        let start = self.written;
        for member in std::mem::take(&mut self.members) {
            let extra = self.long(&[member.size, member.size, member.offset]);
            let mut entry = self.head(0x0201_4b50, &45_u16.to_le_bytes(), &member, extra.len());
            // No remark, first disk, no attributes.
            let (remark, disk, inner, outer) = (0_u16, 0_u16, 0_u16, 0_u32);
            for number in [remark, disk, inner] {
                entry.extend(number.to_le_bytes());
            }
            entry.extend(outer.to_le_bytes());
            entry.extend(self.short(member.offset).to_le_bytes());
            entry.extend(member.name.bytes());
            entry.extend(&extra);
            self.put(&entry)?;
            self.members.push(member);
        }
        let (count, size) = (self.members.len() as u64, self.written - start);
        if start >= self.limit || size >= self.limit {
            let end = self.written;
            let (version, disk) = (45_u16, 0_u32);
            let mut tail = record!(
                0x0606_4b50,
                44_u64,
                version,
                version,
                disk,
                disk,
                count,
                count,
                size,
                start
            );
            tail.extend(record!(0x0706_4b50, disk, end, 1_u32));
            self.put(&tail)?;
        }
        let (disk, count) = (0_u16, count as u16);
        let mut tail = record!(
            0x0605_4b50,
            disk,
            disk,
            count,
            count,
            self.short(size),
            self.short(start),
            (remark.len() as u16)
        );
        tail.extend(remark.bytes());
        self.put(&tail)
    }
}
