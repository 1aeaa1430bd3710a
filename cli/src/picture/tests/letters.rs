//! Letters are there, smooth, and told apart.

use super::super::canvas::Canvas;
use super::super::colour::{INK, WHITE};
use super::super::font;

/// A text alone, black on white.
fn written(text: &str) -> Canvas {
    let mut canvas = Canvas::new(400, 60);
    font::write(&mut canvas, text, [5.0, 40.0], 30.0, INK);
    canvas
}

/// Pixels that are not paper.
fn inked(canvas: &Canvas) -> usize {
    canvas.pixels.iter().filter(|&&p| p != WHITE).count()
}

#[test]
fn letters_differ_and_have_smooth_rims() {
    let all: Vec<Canvas> = ["a", "b", "Γ", "Δ", "1", "7", "−", "·"].map(written).into();
    for (i, one) in all.iter().enumerate() {
        assert!(inked(one) > 5, "letter {i} is empty");
        for other in &all[..i] {
            assert_ne!(one.pixels, other.pixels);
        }
    }
    let grey = |p: &&[u8; 3]| **p != WHITE && **p != INK;
    assert!(all[0].pixels.iter().filter(grey).count() > 20);
    // The ring of an o is ink, its middle is paper.
    let ring = written("o");
    let row = &ring.pixels[(40 - 8) * ring.width..][..ring.width];
    let first = row.iter().position(|&p| p != WHITE).unwrap();
    let last = row.iter().rposition(|&p| p != WHITE).unwrap();
    assert_eq!(row[usize::midpoint(first, last)], WHITE);
    assert!(row.contains(&INK), "{row:?}");
}

/// What is written ends where the width says, to the letters' side bearings.
#[test]
fn texts_are_as_wide_as_measured() {
    let mut before = 0.0;
    for text in ["H", "HH", "HHiH", "HHiH Γ H"] {
        let width = font::width(text, 30.0);
        assert!(width > before, "{text}");
        before = width;
        let canvas = written(text);
        let end = (0..canvas.pixels.len())
            .filter(|&i| canvas.pixels[i] != WHITE)
            .map(|i| i % canvas.width)
            .max();
        let off = 5.0 + width - end.unwrap() as f64;
        assert!((0.0..6.0).contains(&off), "{text}: {off}");
    }
    assert!((font::width("mm", 60.0) - 4.0 * font::width("m", 30.0)).abs() < 1e-9);
    assert_eq!(font::width("", 30.0), 0.0);
}

#[test]
fn capitals_stand_about_the_middle() {
    let mut canvas = Canvas::new(60, 60);
    let baseline = font::baseline(30.0, 40.0);
    font::write(&mut canvas, "H", [5.0, baseline], 40.0, INK);
    let rows = (0..60).filter(|y| canvas.pixels[y * 60..][..60].contains(&INK));
    let rows: Vec<usize> = rows.collect();
    let middle = 0.5 * (rows[0] + rows[rows.len() - 1] + 1) as f64;
    assert!((middle - 30.0).abs() <= 1.0, "{middle}");
    // 0.729 of the size.
    assert!((28..=30).contains(&rows.len()), "{}", rows.len());
}

/// Every letter of the files that make pictures is in the font, and of what scenes may say of themselves.
#[test]
fn what_pictures_say_is_in_the_font() {
    let sources = [
        include_str!("../colour.rs"),
        include_str!("../marks.rs"),
        include_str!("../mod.rs"),
        include_str!("../plane.rs"),
        include_str!("../slice.rs"),
        include_str!("../spheres.rs"),
        // What the pictures of papers, pages and charts say beside.
        "∆−·×≤≥√∇Γ∞±…–° ⁰¹²³⁴⁵⁶⁷⁸⁹⁻₀₁₂₃ ←↑→↓ αβγδεζηθκλμπρσφω ΓΔΣΠΩ ½¼¾ ′″ ∂∫ℓ∝≈≠≪≫ „“”‘’ äöüßéñçøåÆłšžő",
    ];
    for letter in sources.iter().flat_map(|text| text.chars()) {
        assert!(letter.is_control() || font::has(letter), "{letter:?}");
    }
}

#[test]
fn unknown_letters_are_boxes() {
    assert!(!font::has('翼') && !font::has('\u{7}'));
    let one = written("翼");
    assert!(inked(&one) > 20);
    assert_eq!(one.pixels, written("\u{1f427}").pixels);
    assert_ne!(one.pixels, written("a").pixels);
}
