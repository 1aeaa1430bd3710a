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

/// Loops, one for each element. A name may stand in the first line. Then points follow once round each element, either
/// way, elements parted by blank lines or by a row of two equal numbers of 999 or more; or the numbers of points of the
/// upper and the lower surface, and these, which are joined where their ends are nearest.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Run>, GeometryError> {
    check_text(bytes)?;
    let mut rows: Vec<Row> = Vec::new();
    let mut announced: Option<(usize, usize)> = None;
    let mut is_first = true;
    let mut has_name = false;
    let mut follows_blank = false;
    for (at, line) in Lines::of(bytes) {
        let content = content(line);
        if content.is_empty() {
            follows_blank |= line.trim_ascii().is_empty();
            continue;
        }
        match pair(content) {
            Ok(point) => rows.push(Row {
                at,
                point,
                follows_blank,
            }),
            // Some writers put the number of points below the name.
            Err(_) if rows.is_empty() && announced.is_none() && count(content).is_some() => {
                announced = count(content).map(|count| (count, at));
            }
            Err(_) if is_first => has_name = true,
            Err(reason) => return Err(row(at, reason)),
        }
        is_first = false;
        follows_blank = false;
    }
    if let Some((count, at)) = announced
        && count != rows.len()
    {
        return Err(row(
            at,
            format!(
                "{count} points are announced, but {} follow; the file is cut off or damaged, fetch it again",
                rows.len()
            ),
        ));
    }
    if let Some((upper, lower)) = surfaces(&rows, has_name)? {
        return Ok(vec![joined(upper, lower)]);
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
    if !fits {
        return Err(row(
            first.at,
            format!(
                "{upper} and {lower} points are announced, but {} follow; the file is cut off or damaged, fetch it again",
                points.len()
            ),
        ));
    }
    let (upper, lower) = points.split_at(upper as usize);
    let run = |rows: &[Row]| rows.iter().map(|row| row.point).collect();
    Ok(Some((run(upper), run(lower))))
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
