//! Pictures of made-up particles.

use sphpack_packing::Kind;
use sphpack_separation::Side;

use super::*;
use crate::table::Shared;

mod letters;
mod pixels;

/// A square or cubic lattice with a body in its middle.
fn table(dimension: usize) -> Table {
    lattice(dimension, 12)
}

/// The same of so many sites a side, 12 or 13; those on its rim are frozen.
fn lattice(dimension: usize, across: usize) -> Table {
    let mut table = Table {
        dimension,
        bodies: vec!["body".into()],
        shared: Shared {
            spacing: 0.1,
            ..Shared::default()
        },
        ..Table::default()
    };
    let depth = if dimension == 2 { 1 } else { across };
    for number in 0..across * across * depth {
        let cell = [
            number % across,
            number / across % across,
            number / (across * across),
        ];
        let position = cell.map(|k| 0.1 * (k as f64 - 0.5 * (across - 1) as f64));
        let position = [
            position[0],
            position[1],
            if dimension == 2 { 0.0 } else { position[2] },
        ];
        let distance = sphpack_neighbors::point::norm(position);
        let rim = position.iter().any(|x| x.abs() > 0.5);
        table.id.push(number as u32);
        table.position.push(position);
        table.kind.push(match distance {
            _ if rim => Kind::Frozen,
            d if d < 0.25 => Kind::Free,
            d if d < 0.35 => Kind::Boundary,
            _ => Kind::Free,
        });
        let is_solid = distance < 0.35;
        table
            .side
            .push(if is_solid { Side::Solid } else { Side::Fluid });
        table.body.push(is_solid.then_some(0));
        table.volume.push(0.1_f64.powi(dimension as i32));
        table.mass.push(0.01);
        table.gamma.push(1.0 + 0.004 * position[0]);
        table.residual.push(0.0);
    }
    table
}

/// Does something with the subject that tests draw.
fn with_subject<T>(table: &Table, act: impl FnOnce(&Subject<'_>) -> T) -> T {
    // Frozen particles are outside of the domain.
    let end = |most: f64, p: &[f64; 3]| most.max(p[0]);
    let half = table.position.iter().fold(0.55, end) - 0.05;
    act(&Subject {
        name: "a <b> & \"c\"\n",
        table,
        loops: &[vec![[-0.35, -0.05], [0.35, -0.05], [0.0, 0.38]]],
        domain: [[-half; 3], [half; 3]],
        spacing: 0.1,
        is_unfinished: true,
    })
}

fn drawn(table: &Table, format: PictureFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    with_subject(table, |subject| draw(subject, format, &mut bytes)).unwrap();
    bytes
}

/// The picture before it is a file.
fn in_pixels(table: &Table) -> canvas::Canvas {
    with_subject(table, painted)
}

/// Width, height and pixels of a PNG.
fn decoded(bytes: &[u8]) -> (usize, usize, Vec<[u8; 3]>) {
    let mut decoder = ::png::Decoder::new(io::Cursor::new(bytes));
    decoder.set_transformations(::png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    let (pixels, rest) = pixels.as_chunks();
    assert!(rest.is_empty() && info.color_type == ::png::ColorType::Rgb);
    (info.width as usize, info.height as usize, pixels.to_vec())
}

/// The file has what was painted: letters and lines to the bit, colours of densities to a few levels.
#[test]
fn pngs_show_what_was_painted() {
    for dimension in [2, 3] {
        let painted = in_pixels(&table(dimension));
        let (width, height, pixels) = decoded(&drawn(&table(dimension), PictureFormat::Png));
        assert_eq!((width, height), (painted.width, painted.height));
        assert!(width >= 1600 && height >= 900, "{width} x {height}");
        for (seen, meant) in pixels.iter().zip(&painted.pixels) {
            let off = (0..3).map(|k| seen[k].abs_diff(meant[k])).max();
            assert!(off <= Some(12), "{seen:?} {meant:?}");
            assert!(![colour::WHITE, colour::INK].contains(meant) || seen == meant);
        }
    }
}

#[test]
fn svg_is_well_formed() {
    let text = String::from_utf8(drawn(&table(2), PictureFormat::Svg)).unwrap();
    assert!(
        text.contains("a &lt;b&gt; &amp; &quot;c&quot;: ∆s = 0.1, 100 particles"),
        "{}",
        &text[..600]
    );
    assert!(text.contains("unfinished"));
    assert_eq!(text.matches("<circle").count(), 144 + 2);
    // Every tag is closed, nothing is not a number, and all text is escaped.
    let mut open = Vec::new();
    for part in text.split('<').skip(1) {
        let (tag, rest) = part.split_once('>').unwrap();
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        assert!(!rest.contains('>'), "{rest}");
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name.to_owned())),
            None if tag.ends_with('/') => {}
            None => open.push(tag.split_whitespace().next().unwrap().to_owned()),
        }
    }
    assert!(open.is_empty());
    assert!(!text.contains("NaN") && !text.contains("inf"));
}

#[test]
fn scenes_without_bodies_are_drawn_too() {
    for dimension in [2, 3] {
        let empty = table(dimension).filtered(|i| i % 7 == 0 && i > 1_000_000);
        decoded(&drawn(&empty, PictureFormat::Png));
        let mut fluid = table(dimension);
        fluid.kind.iter_mut().for_each(|kind| *kind = Kind::Free);
        fluid.side.iter_mut().for_each(|side| *side = Side::Fluid);
        fluid.body.iter_mut().for_each(|body| *body = None);
        decoded(&drawn(&fluid, PictureFormat::Png));
    }
}

#[test]
fn thousands_are_set_apart() {
    assert_eq!(
        [0, 999, 1000, 1_234_567].map(grouped),
        ["0", "999", "1,000", "1,234,567"]
    );
}

/// Titles, and the numbers beside the colours: with many letters, wide ones, or many digits.
#[test]
fn texts_end_on_the_sheet() {
    for (name, off) in [("a", 1e-2), ("bends", 1e-11), (&"W".repeat(40), 1e-3)] {
        let mut table = table(2);
        for (gamma, [x, ..]) in table.gamma.iter_mut().zip(&table.position) {
            *gamma = 1.0 + off * x;
        }
        let subject = Subject {
            name,
            table: &table,
            loops: &[],
            domain: [[-0.5; 3], [0.5; 3]],
            spacing: 0.012_345,
            is_unfinished: true,
        };
        let sheet = plane::sheet(&subject);
        let mut count = 0;
        for mark in &sheet.marks {
            if let marks::Mark::Text { at, size, text, .. } = mark {
                let end = at[0] + font::width(text, *size);
                assert!(end <= sheet.width as f64, "{text} ends at {end}");
                count += 1;
            }
        }
        // The title, the bar's name and numbers, two kinds, a length.
        assert_eq!(count, 1 + 6 + 2 + 1);
    }
}
