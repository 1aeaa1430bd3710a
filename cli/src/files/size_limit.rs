//! The longest file that a process may write.

use std::io::{self, Write};

/// Writes no more than the process may (ulimit -f): the system would end it with a signal, and what was packed, and the
/// temporary file, would be lost.
#[derive(Debug)]
pub(super) struct Limited<W> {
    to: W,
    /// Bytes; `None` where there is no limit.
    left: Option<u64>,
}

impl<W: Write> Limited<W> {
    /// For a file that is empty.
    pub(super) fn new(to: W) -> Self {
        let left = crate::memory::longest_file();
        Self { to, left }
    }
}

impl<W: Write> Write for Limited<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.left.is_some_and(|left| left < bytes.len() as u64) {
            return Err(io::Error::new(
                io::ErrorKind::FileTooLarge,
                "it would be longer than files of this process may be (ulimit -f)",
            ));
        }
        let written = self.to.write(bytes)?;
        self.left = self.left.map(|left| left - written as u64);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_long_is_an_error() {
        let mut bytes = Vec::new();
        let mut limited = Limited {
            to: &mut bytes,
            left: Some(5),
        };
        assert!(limited.write_all(b"abc").is_ok());
        assert!(limited.write_all(b"def").is_err());
        assert!(limited.write_all(b"de").is_ok());
        assert_eq!(bytes, b"abcde");
    }
}
