//! Damage to files, the same for the same seed: what the readers' tests and `cargo xtask fuzz` feed them with.

use sphpack_neighbors::random::SplitMix64;

/// Words that readers trip over.
const WORDS: [&[u8]; 36] = [
    b"\n",
    b"\r\n",
    b"\r",
    b" ",
    b"\t",
    b",",
    b"\"",
    b"<",
    b">",
    b"/>",
    b"\\\n",
    b"#",
    b"0",
    b"-1",
    b"1e999",
    b"-1e-999",
    b"nan",
    b"inf",
    b"4294967295",
    b"18446744073709551615",
    b"99999999999999999999",
    b"1.0D+03",
    b"61. 61.\n",
    b"999. 999.\n",
    b"solid x\n",
    b"endsolid\n",
    b"f 1 2 3 4\n",
    b"f -1 -2 -3\n",
    b"o x\n",
    b"end_header\n",
    b"element face 1000000000\n",
    b"property list uchar int vertex_index\n",
    b"a1e9 1 0 1 1 1 1",
    b"c1e300 0 0 9 1 1",
    b"<g transform='scale(1e200)'>",
    b"&lt;",
];

/// Numbers that readers trip over, as 32 bits.
const NUMBERS: [u32; 8] = [
    0,
    1,
    0x7f,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0x7fc0_0000,
    0xffff_ffff,
];

/// A generator of damage.
#[derive(Debug, Clone)]
pub(crate) struct Mangler {
    random: SplitMix64,
}

impl Mangler {
    /// The generator of a block of inputs; blocks of one seed have nothing to do with each other.
    pub(crate) fn new(seed: u64, block: u64) -> Self {
        let mut first = SplitMix64::new(seed ^ block.wrapping_mul(0xd1b5_4a32_d192_ed03));
        Self {
            random: SplitMix64::new(first.bits()),
        }
    }

    /// A number below `end`, 0 where that is 0.
    fn below(&mut self, end: usize) -> usize {
        (self.random.bits() % end.max(1) as u64) as usize
    }

    /// One of the files, with one to eight faults.
    pub(crate) fn mangled(&mut self, files: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = match files.get(self.below(files.len())) {
            Some(file) => file.clone(),
            None => Vec::new(),
        };
        for _ in 0..1 << self.below(4) {
            self.damage(&mut bytes, files);
        }
        bytes
    }

    fn damage(&mut self, bytes: &mut Vec<u8>, files: &[Vec<u8>]) {
        let at = self.below(bytes.len());
        let end = at + self.below((bytes.len() - at).min(64));
        match self.below(10) {
            0 if !bytes.is_empty() => bytes[at] ^= 1 << self.below(8),
            1 if !bytes.is_empty() => bytes[at] = self.random.bits() as u8,
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let again = bytes[at..end].to_vec();
                let to = self.below(bytes.len());
                bytes.splice(to..to, again);
            }
            5 | 6 => {
                let word = WORDS[self.below(WORDS.len())];
                bytes.splice(at..at, word.iter().copied());
            }
            7 => {
                let word = WORDS[self.below(WORDS.len())];
                bytes.splice(at..end, word.iter().copied());
            }
            8 => {
                let number = NUMBERS[self.below(NUMBERS.len())];
                let number = if self.below(2) == 0 {
                    number.to_le_bytes()
                } else {
                    number.to_be_bytes()
                };
                for (byte, new) in bytes[at..].iter_mut().zip(number) {
                    *byte = new;
                }
            }
            _ => {
                // The beginning of one and the end of another.
                if let Some(other) = files.get(self.below(files.len())) {
                    bytes.truncate(at);
                    bytes.extend_from_slice(&other[self.below(other.len())..]);
                }
            }
        }
    }
}
