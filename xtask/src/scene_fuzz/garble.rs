//! Damage to the text of scenes: what people mistype, and what nobody would write.

use super::random::Random;

/// Numbers that a parser or a plan trips over.
const NUMBERS: [&str; 28] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "0.5",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e999",
    "nan",
    "-inf",
    "inf",
    "1e6",
    "1e-6",
    "1000000000",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "18446744073709551616",
    "0x7fffffff",
    "1_000_000",
    "0.30000000000000004",
    "3.",
    ".5",
    "true",
    "\"0.1\"",
];

/// Pieces of the language, and of scenes.
const WORDS: [&str; 40] = [
    "[",
    "]",
    "{",
    "}",
    "[[",
    "]]",
    "=",
    ",",
    ".",
    "\"",
    "\"\"\"",
    "'",
    "#",
    "\n",
    "\r",
    "\t",
    "\0",
    "\u{feff}",
    "\u{202e}",
    "\\u0000",
    "\\",
    "[[body]]\n",
    "[domain]\n",
    "[packing]\n",
    "[fluid]\n",
    "[output]\n",
    "spacing = 0.1\n",
    "margin = 1\n",
    "periodic = [true, true, true]\n",
    "role = \"container\"\n",
    "role = \"void\"\n",
    "precedence = 1\n",
    "surface = \"exact\"\n",
    "method = \"clipped\"\n",
    "rotate_degrees = 30\n",
    "translate = [1, 2, 3]\n",
    "scale = 1e-9\n",
    "shape = { file = \"spot.stl\" }\n",
    "shape = { zigzag = { width = 2, height = 1, amplitude = 0.25, teeth = 1000000 } }\n",
    "shape = { starfish = { center = [0, 0], radius = 0.5, amplitude = 0.25, arms = 100000 } }\n",
];

/// One of the scenes, with one to eight faults.
pub(super) fn garbled(scenes: &[String], random: &mut Random) -> Vec<u8> {
    let mut bytes = pick(scenes, random).clone().into_bytes();
    for _ in 0..1 << random.below(4) {
        match random.below(10) {
            // Half of all faults leave a scene that can be read.
            0..=4 => put_number(&mut bytes, random),
            5 => swap_words(&mut bytes, scenes, random),
            6 => on_lines(&mut bytes, random),
            7 => {
                let at = random.below(bytes.len() + 1);
                let word = WORDS[random.below(WORDS.len())].bytes();
                bytes.splice(at..at, word);
            }
            8 => on_bytes(&mut bytes, random),
            _ => {
                let other = pick(scenes, random).as_bytes();
                bytes.truncate(random.below(bytes.len() + 1));
                bytes.extend(&other[random.below(other.len())..]);
            }
        }
    }
    bytes
}

fn pick<'a>(scenes: &'a [String], random: &mut Random) -> &'a String {
    &scenes[random.below(scenes.len())]
}

/// Where runs of bytes of a kind begin and end.
fn runs(bytes: &[u8], is_of: impl Fn(u8) -> bool) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut begin = None;
    for (at, &byte) in bytes.iter().chain(b"\n").enumerate() {
        match (is_of(byte), begin) {
            (true, None) => begin = Some(at),
            (false, Some(from)) => {
                found.push((from, at));
                begin = None;
            }
            _ => {}
        }
    }
    found
}

fn put_number(bytes: &mut Vec<u8>, random: &mut Random) {
    let mut numbers = runs(bytes, |b| b.is_ascii_digit() || b"+-._e".contains(&b));
    numbers.retain(|&(from, to)| bytes[from..to].iter().any(u8::is_ascii_digit));
    if numbers.is_empty() {
        return;
    }
    let (from, to) = numbers[random.below(numbers.len())];
    let new = match random.below(8) {
        0 => "9".repeat(random.whole(1, 400)),
        1 => format!("0.{}1", "0".repeat(random.whole(1, 400))),
        2 => format!("{}", random.magnitude(1e-9, 1e9)),
        3 => format!("-{}", random.magnitude(1e-9, 1e9)),
        _ => NUMBERS[random.below(NUMBERS.len())].to_owned(),
    };
    bytes.splice(from..to, new.into_bytes());
}

/// A key or a name of one scene in place of one of another.
fn swap_words(bytes: &mut Vec<u8>, scenes: &[String], random: &mut Random) {
    let is_of = |b: u8| b.is_ascii_alphabetic() || b"_-".contains(&b);
    let other = pick(scenes, random).as_bytes();
    let (from_own, from_other) = (runs(bytes, is_of), runs(other, is_of));
    if from_own.is_empty() || from_other.is_empty() {
        return;
    }
    let (from, to) = from_own[random.below(from_own.len())];
    let (begin, end) = from_other[random.below(from_other.len())];
    bytes.splice(from..to, other[begin..end].iter().copied());
}

fn on_lines(bytes: &mut Vec<u8>, random: &mut Random) {
    let mut lines: Vec<Vec<u8>> = bytes.split(|&b| b == b'\n').map(<[u8]>::to_vec).collect();
    let [one, other] = [0; 2].map(|_| random.below(lines.len()));
    match random.below(4) {
        0 => drop(lines.remove(one)),
        1 => lines.insert(other, lines[one].clone()),
        2 => lines.swap(one, other),
        _ => {
            // So many of the same.
            let line = lines[one].clone();
            let count = random.whole(1, 200);
            lines.splice(one..one, std::iter::repeat_n(line, count));
        }
    }
    *bytes = lines.join(&b'\n');
}

fn on_bytes(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len());
    let end = (at + random.below(40)).min(bytes.len());
    match random.below(4) {
        0 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
        1 if !bytes.is_empty() => bytes[at] = random.below(256) as u8,
        2 => drop(bytes.drain(at..end)),
        _ => bytes.truncate(at),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damage_is_the_same_for_the_same_seed() {
        let scenes = ["spacing = 0.1\n[domain]\nmin = [0, 0]\n".to_owned()];
        let all = |seed| -> Vec<Vec<u8>> {
            let random = &mut Random::new(seed, 0);
            (0..200).map(|_| garbled(&scenes, random)).collect()
        };
        assert_eq!(all(1), all(1));
        assert_ne!(all(1), all(2));
        assert!(
            all(1)
                .iter()
                .any(|bytes| std::str::from_utf8(bytes).is_err())
        );
    }
}
