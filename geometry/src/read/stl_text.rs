//! Text STL files: solids, facets, loops, vertices.

use super::Solid;
use super::lines::{Lines, number, row, shown, whole, words};
use crate::GeometryError;

/// The facet that is being read: its corners, and how many are there.
#[derive(Default)]
struct Facet {
    corners: [[f64; 3]; 3],
    count: usize,
}

/// Every solid, in the order of the file. Keywords may be in upper case, lines end and indent as they like; normals are
/// passed over.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Solid>, GeometryError> {
    let mut solids: Vec<Solid> = Vec::new();
    let mut is_open = false;
    let mut facet: Option<Facet> = None;
    for (at, line) in Lines::of(bytes) {
        let solid = solids.len();
        let unexpected = |wanted: &str| {
            row(
                at,
                format!(
                    "\"{}\" in solid {solid} of the text STL file; {wanted} is needed here, export the body again",
                    shown(line)
                ),
            )
        };
        let mut words = words(line);
        let mut has_ended = false;
        while let Some(word) = words.next() {
            let is = |keyword: &[u8]| word.eq_ignore_ascii_case(keyword);
            let Some(open) = solids.last_mut().filter(|_| is_open) else {
                if !is(b"solid") {
                    return Err(row(
                        at,
                        format!(
                            "\"{}\" stands outside any solid; export the body again",
                            shown(line)
                        ),
                    ));
                }
                solids.push(Solid {
                    name: rest_of(line, word),
                    triangles: Vec::new(),
                });
                is_open = true;
                break;
            };
            match &mut facet {
                None if is(b"facet") => {
                    if !words
                        .next()
                        .is_some_and(|w| w.eq_ignore_ascii_case(b"normal"))
                    {
                        return Err(unexpected("\"facet normal …\""));
                    }
                    // Not every exporter writes numbers here.
                    words.by_ref().take(3).for_each(drop);
                    facet = Some(Facet::default());
                }
                None if is(b"endsolid") => {
                    is_open = false;
                    break;
                }
                // Some exporters give facets names.
                None if has_ended => break,
                None => return Err(unexpected("a facet or \"endsolid\"")),
                Some(facet) if is(b"vertex") => {
                    let mut corner = [0.0; 3];
                    for x in &mut corner {
                        *x = words
                            .next()
                            .and_then(number)
                            .ok_or_else(|| unexpected("\"vertex\" and three finite numbers"))?;
                    }
                    if facet.count == 3 {
                        return Err(unexpected("a facet of three vertices, a triangle"));
                    }
                    facet.corners[facet.count] = corner;
                    facet.count += 1;
                }
                Some(facet) if is(b"outer") && facet.count == 0 => {
                    if !words
                        .next()
                        .is_some_and(|w| w.eq_ignore_ascii_case(b"loop"))
                    {
                        return Err(unexpected("\"outer loop\""));
                    }
                }
                Some(facet) if is(b"endloop") && facet.count == 3 => {}
                Some(done) if is(b"endfacet") && done.count == 3 => {
                    open.triangles.push(done.corners);
                    facet = None;
                    has_ended = true;
                }
                Some(_) => return Err(unexpected("a facet of three vertices, a triangle,")),
            }
        }
    }
    if is_open {
        return Err(whole(format!(
            "solid {} of the text STL file has no \"endsolid\": the file is cut off, or no STL file; export the body again",
            solids.len()
        )));
    }
    Ok(solids)
}

/// What follows the first word of a line.
fn rest_of(line: &[u8], word: &[u8]) -> String {
    let line = line.trim_ascii();
    String::from_utf8_lossy(line.get(word.len()..).unwrap_or_default())
        .trim()
        .to_owned()
}
