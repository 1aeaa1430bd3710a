//! The attribute `transform`.

use kurbo::{Affine, Point};

use super::scan::Scan;

/// Reads a list of transforms; the last one acts first.
pub(super) fn parse(text: &str) -> Result<Affine, String> {
    let mut scan = Scan::new(text);
    let mut whole = Affine::IDENTITY;
    loop {
        scan.skip_separator();
        if scan.peek().is_none() {
            return Ok(whole);
        }
        let Some(next) = one(&mut scan) else {
            return Err(format!(
                "character {} of a transform: it must be matrix(…), translate(…), scale(…), rotate(…), skewX(…) or skewY(…); save the drawing again",
                scan.place() + 1
            ));
        };
        whole *= next;
    }
}

fn one(scan: &mut Scan<'_>) -> Option<Affine> {
    let name = scan.letters();
    scan.skip_space();
    if !scan.take(b'(') {
        return None;
    }
    let mut values = [0.0; 6];
    let mut count = 0;
    scan.skip_space();
    while !scan.take(b')') {
        *values.get_mut(count)? = scan.number()?;
        count += 1;
        scan.skip_separator();
    }
    let [a, b, c, ..] = values;
    Some(match (name, count) {
        (b"matrix", 6) => Affine::new(values),
        (b"translate", 1 | 2) => Affine::translate((a, b)),
        (b"scale", 1) => Affine::scale(a),
        (b"scale", 2) => Affine::scale_non_uniform(a, b),
        (b"rotate", 1) => Affine::rotate(a.to_radians()),
        (b"rotate", 3) => Affine::rotate_about(a.to_radians(), Point::new(b, c)),
        (b"skewX", 1) => Affine::skew(a.to_radians().tan(), 0.0),
        (b"skewY", 1) => Affine::skew(0.0, a.to_radians().tan()),
        _ => return None,
    })
}
