//! Airfoil coordinate files: Selig's (once round, from the trailing edge) and Lednicer's (upper and lower surface).

use sphpack_neighbors::{Bounds, point};

use super::lines::{Lines, row};
use super::rows::{check_text, content, fields, pair};
use crate::GeometryError;

type Run = Vec<[f64; 2]>;

/// A row of the file.
struct Row {
    at: usize,
    point: [f64; 2],
    follows_blank: bool,
}

/// Loops, one for each element. Names, remarks and MSES's domain may stand before the points. Then points follow once
/// round each element, either way, elements parted by blank lines or by a row of two equal numbers of 999 or more; or
/// the numbers of points of the upper and the lower surface, and these, which are joined where their ends are nearest.
/// What follows a line of text after a closed run is no part of the airfoil.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Run>, GeometryError> {
    check_text(bytes)?;
    let mut rows: Vec<Row> = Vec::new();
    let mut announced: Option<Announced> = None;
    let mut has_name = false;
    let mut follows_blank = false;
    let mut follows_heading = false;
    for (at, line) in Lines::of(bytes) {
        let content = content(line);
        if content.is_empty() {
            follows_blank |= line.trim_ascii().is_empty();
            continue;
        }
        match in_plane(content) {
            Ok(point) => {
                rows.push(Row {
                    at,
                    point,
                    follows_blank,
                });
                follows_heading = false;
            }
            Err(reason) if is_spoilt(content) => return Err(row(at, reason)),
            Err(_) if rows.is_empty() => {
                // Some writers put the number of points below the name.
                match count(content).filter(|_| announced.is_none()) {
                    Some(count) => {
                        announced = Some(Announced {
                            count,
                            at,
                            is_below_name: has_name,
                        });
                    }
                    None => has_name = true,
                }
            }
            // The heading of the other surface may have several lines.
            Err(_) if follows_heading => {}
            Err(_) if is_open(&places(last_run(&rows))) => follows_heading = true,
            Err(_) => break,
        }
        follows_blank = follows_heading;
    }
    if let Some(Announced {
        count,
        at,
        is_below_name,
    }) = announced
        && count != rows.len()
    {
        // A number in the first line may be the airfoil's name.
        if is_below_name || rows.is_empty() {
            return Err(wrong_count(at, &format!("{count} points"), rows.len()));
        }
        has_name = true;
    }
    if let Some((upper, lower)) = surfaces(&rows, has_name)? {
        return Ok(vec![joined(upper, lower)]);
    }
    if is_title(&rows, has_name) {
        rows.remove(0);
    }
    let mut runs: Vec<Run> = vec![Vec::new()];
    for row in &rows {
        let [x, y] = row.point;
        let is_mark = x == y && x >= 999.0;
        if (row.follows_blank || is_mark) && runs.last().is_some_and(|run| !run.is_empty()) {
            runs.push(Vec::new());
        }
        if let Some(run) = runs.last_mut()
            && !is_mark
        {
            run.push(row.point);
        }
    }
    runs.retain(|run| !run.is_empty());
    Ok(match <[Run; 2]>::try_from(runs) {
        Ok([upper, lower]) if is_open(&upper) && is_open(&lower) => vec![joined(upper, lower)],
        Ok(two) => two.into(),
        Err(runs) => runs,
    })
}

/// The number of points that a line promises.
struct Announced {
    count: usize,
    at: usize,
    is_below_name: bool,
}

fn wrong_count(at: usize, announced: &str, found: usize) -> GeometryError {
    row(
        at,
        format!(
            "{announced} are announced, but {found} follow; the file is cut off or damaged, fetch it again"
        ),
    )
}

/// A point from two numbers, or three of which the last is 0.
pub(super) fn in_plane(content: &[u8]) -> Result<[f64; 2], String> {
    pair(content).or_else(|reason| {
        let mut numbers = fields(content).map(super::lines::number);
        match [(); 4].map(|()| numbers.next()) {
            [Some(Some(x)), Some(Some(y)), Some(Some(0.0)), None] => Ok([x, y]),
            _ => Err(reason),
        }
    })
}

/// Whether this is a point with a fault rather than text: two fields, or three, the first a number with a point.
fn is_spoilt(content: &[u8]) -> bool {
    let mut fields = fields(content);
    let is_decimal = |field: &[u8]| field.contains(&b'.') && super::lines::number(field).is_some();
    fields.next().is_some_and(is_decimal) && (1..3).contains(&fields.count())
}

/// Whether the first row is a name such as "63 215": two whole numbers, far beyond all that follows.
fn is_title(rows: &[Row], has_name: bool) -> bool {
    let Some((first, others)) = rows.split_first() else {
        return false;
    };
    let is_whole = first.point.iter().all(|x| x.fract() == 0.0);
    let reach = |row: &Row| row.point.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let beyond = 10.0 * others.iter().map(reach).fold(0.0, f64::max);
    !has_name && is_whole && others.len() > 2 && reach(first) > beyond
}

/// The rows since the last blank line.
fn last_run(rows: &[Row]) -> &[Row] {
    let start = rows.iter().rposition(|row| row.follows_blank).unwrap_or(0);
    &rows[start..]
}

fn places(rows: &[Row]) -> Run {
    rows.iter().map(|row| row.point).collect()
}

/// One whole number, alone in its row.
fn count(content: &[u8]) -> Option<usize> {
    let mut fields = fields(content);
    let number = super::lines::number(fields.next()?)?;
    (fields.next().is_none() && (3.0..1e9).contains(&number) && number.fract() == 0.0)
        .then_some(number as usize)
}

/// The two surfaces, where the first row announces how many points each has: it stands below a name or alone, as other
/// points might add up too.
fn surfaces(rows: &[Row], has_name: bool) -> Result<Option<(Run, Run)>, GeometryError> {
    let Some((first, points)) = rows.split_first() else {
        return Ok(None);
    };
    let [upper, lower] = first.point;
    let is_count = |x: f64| x >= 2.0 && x.fract() == 0.0;
    let fits = upper + lower == points.len() as f64;
    let stands_alone = points.first().is_some_and(|row| row.follows_blank);
    if !(is_count(upper) && is_count(lower) && (fits && has_name || stands_alone)) {
        return Ok(None);
    }
    if !fits && is_title(rows, has_name) {
        return Ok(None);
    }
    if !fits {
        let announced = format!("{upper} and {lower} points");
        return Err(wrong_count(first.at, &announced, points.len()));
    }
    let (upper, lower) = points.split_at(upper as usize);
    Ok(Some((places(upper), places(lower))))
}

/// Whether a run goes from one end of an airfoil to the other, not round it.
fn is_open(run: &[[f64; 2]]) -> bool {
    match run {
        [first, .., last] => point::distance(*first, *last) > 0.5 * Bounds::of(run).diagonal(),
        _ => false,
    }
}

/// One loop from two surfaces, whichever end each of them begins at.
fn joined(mut first: Run, mut second: Run) -> Run {
    if let ([a, .., b], [c, .., d]) = (first.as_slice(), second.as_slice()) {
        let in_line = point::distance(*b, *c) + point::distance(*d, *a);
        let turned = point::distance(*b, *d) + point::distance(*c, *a);
        if turned < in_line {
            second.reverse();
        }
    }
    first.append(&mut second);
    first
}
