//! Bytes as letters, which a page can hold.

use std::io::{self, Write};

const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Bytes that are turned at a time; whole groups of three.
const PIECE: usize = 3 << 14;

/// Turns bytes into base64 (RFC 4648) as they come.
pub(super) struct Base64<'a> {
    to: &'a mut dyn Write,
    waiting: Vec<u8>,
}

impl<'a> Base64<'a> {
    pub(super) fn new(to: &'a mut dyn Write) -> Self {
        Self {
            to,
            waiting: Vec::with_capacity(PIECE),
        }
    }

    /// More bytes, eight at most.
    pub(super) fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.waiting.extend_from_slice(bytes);
        if self.waiting.len() < PIECE {
            return Ok(());
        }
        self.to.write_all(&letters(&self.waiting[..PIECE]))?;
        self.waiting.drain(..PIECE);
        Ok(())
    }

    /// What is left.
    pub(super) fn end(self) -> io::Result<()> {
        self.to.write_all(&letters(&self.waiting))
    }
}

fn letters(bytes: &[u8]) -> Vec<u8> {
    let mut text = Vec::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |k: usize| u32::from(group.get(k).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k) & 63) as usize];
            text.push(if k <= group.len() { letter } else { b'=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_the_standard() {
        for (plain, coded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(letters(plain.as_bytes()), coded.as_bytes());
        }
        assert_eq!(letters(&[255, 239, 190]), b"/+++");
    }

    #[test]
    fn pieces_leave_no_seam() {
        let bytes: Vec<u8> = (0..PIECE * 2 + 5).map(|k| (k * k % 251) as u8).collect();
        let mut out = Vec::new();
        let mut base64 = Base64::new(&mut out);
        for piece in bytes.chunks(7) {
            base64.put(piece).unwrap();
        }
        base64.end().unwrap();
        assert!(out == letters(&bytes));
    }
}
