//! A picture in as many colours as a byte tells apart, which makes its file a third as large.

use std::cmp::Reverse;
use std::collections::HashMap;

use super::colour::Colour;

/// How many colours there are at most.
const MOST: usize = 256;

/// Colours, and which of them every pixel has.
#[derive(Debug)]
pub(super) struct Indexed {
    pub(super) colours: Vec<Colour>,
    pub(super) pixels: Vec<u8>,
}

impl Indexed {
    /// The pixels in the colours that are most frequent among them and no nearer to each other than it takes: all of them where there
    /// are few, so that nothing changes; else no pixel is off by more than that distance, mostly 6 to 10 of 255 levels.
    pub(super) fn of(pixels: &[Colour]) -> Self {
        let mut counts: HashMap<Colour, u32> = HashMap::new();
        for &colour in pixels {
            *counts.entry(colour).or_default() += 1;
        }
        let mut sorted: Vec<(Reverse<u32>, Colour)> =
            counts.iter().map(|(&c, &n)| (Reverse(n), c)).collect();
        sorted.sort_unstable();
        let wanted: Vec<Colour> = sorted.into_iter().map(|(_, colour)| colour).collect();
        let mut apart = 0;
        let colours = loop {
            match spread(&wanted, apart) {
                Some(colours) => break colours,
                None => apart = (apart + apart / 2).max(6),
            }
        };
        let place_of: HashMap<Colour, u8> = (wanted.iter())
            .map(|&colour| (colour, nearest(&colours, colour)))
            .collect();
        Self {
            pixels: pixels.iter().map(|colour| place_of[colour]).collect(),
            colours,
        }
    }
}

/// The first of the wanted colours, each farther from all before it than the root of `apart`; `None` where these are too many.
fn spread(wanted: &[Colour], apart: i32) -> Option<Vec<Colour>> {
    let mut kept: Vec<Colour> = Vec::with_capacity(MOST);
    for &colour in wanted {
        if kept.iter().any(|&k| distance_squared(k, colour) <= apart) {
            continue;
        }
        if kept.len() == MOST {
            return None;
        }
        kept.push(colour);
    }
    Some(kept)
}

/// The place of the colour nearest to another.
fn nearest(colours: &[Colour], to: Colour) -> u8 {
    let found = (0..colours.len()).min_by_key(|&place| distance_squared(colours[place], to));
    found.unwrap_or(0) as u8
}

fn distance_squared(a: Colour, b: Colour) -> i32 {
    let step = |k: usize| i32::from(a[k]) - i32::from(b[k]);
    (0..3).map(|k| step(k) * step(k)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_stay() {
        let pixels: Vec<Colour> = (0..256).map(|k| [k as u8, 255 - k as u8, 7]).collect();
        let indexed = Indexed::of(&pixels);
        let back: Vec<Colour> = (indexed.pixels.iter())
            .map(|&place| indexed.colours[usize::from(place)])
            .collect();
        assert_eq!((back, indexed.colours.len()), (pixels, 256));
    }

    #[test]
    fn of_many_the_frequent_stay_and_none_is_far_off() {
        // 4,096 colours, two of them far more often than the others.
        let often = [[3, 3, 3], [9, 9, 9]];
        let mut pixels: Vec<Colour> = (0..4096_u16)
            .map(|k| [k % 16, k / 16 % 16, k / 256].map(|c| 3 * c as u8))
            .collect();
        pixels.extend(often.iter().cycle().take(1000));
        let indexed = Indexed::of(&pixels);
        assert!(indexed.colours.len() <= MOST);
        for (colour, &place) in pixels.iter().zip(&indexed.pixels) {
            let shown = indexed.colours[usize::from(place)];
            assert!(distance_squared(*colour, shown) <= 12 * 12, "{colour:?}");
            assert!(!often.contains(colour) || shown == *colour);
        }
    }
}
