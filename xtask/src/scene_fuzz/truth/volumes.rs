//! Volumes of bodies that others have cut.

use super::{Form, Point, Truth};

/// Lines across a body of the plane.
const LINES: usize = 4000;

/// Cells across a body of space.
const CELLS: usize = 56;

/// Area or volume of what precedence leaves of a body.
pub(super) fn of_what_is_left(truth: &Truth, body: usize) -> f64 {
    if truth.dimension == 2 {
        area(truth, body)
    } else {
        volume(truth, body)
    }
}

/// Cells across the box by which what passes its sides is counted, in the plane and in space.
const BOX_CELLS: [usize; 2] = [400, 60];

/// Area or volume within a box: cells that the surface passes through count by how far their middle is from it.
pub(super) fn in_box(truth: &Truth, body: usize, [min, max]: [Point; 2]) -> f64 {
    let dimension = truth.dimension;
    let count = BOX_CELLS[dimension - 2];
    let step: Point = std::array::from_fn(|k| {
        if k < dimension {
            (max[k] - min[k]) / count as f64
        } else {
            0.0
        }
    });
    let cell: f64 = step[..dimension].iter().product();
    let width = cell.powf(1.0 / dimension as f64);
    let mut sum = 0.0;
    for i in 0..count.pow(dimension as u32) {
        let at = [i % count, i / count % count, i / count / count];
        let p = std::array::from_fn(|k| {
            min[k] * f64::from(u8::from(k < dimension)) + (at[k] as f64 + 0.5) * step[k]
        });
        sum += (0.5 - truth.distance(body, p) / width).clamp(0.0, 1.0);
    }
    sum * cell
}

/// Exact along each line.
fn area(truth: &Truth, body: usize) -> f64 {
    let [min, max] = truth.bodies[body].bounds();
    let step = (max[1] - min[1]) / LINES as f64;
    let crossings = |form: &Form, y: f64| match form {
        Form::Plane(loops) => loops.crossings(y),
        _ => Vec::new(),
    };
    let mut sum = 0.0;
    for line in 0..LINES {
        let y = min[1] + (line as f64 + 0.5) * step;
        // What happens at each crossing: in or out of the body, or of one that cuts it.
        let mut events: Vec<(f64, usize)> = crossings(&truth.bodies[body].form, y)
            .into_iter()
            .map(|x| (x, 0))
            .collect();
        for (k, other) in truth.cutters(body).enumerate() {
            events.extend(crossings(&other.form, y).into_iter().map(|x| (x, k + 1)));
        }
        events.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut inside = vec![false; 1 + events.iter().map(|e| e.1).max().unwrap_or(0)];
        for pair in events.windows(2) {
            inside[pair[0].1] ^= true;
            if inside[0] && !inside[1..].contains(&true) {
                sum += pair[1].0 - pair[0].0;
            }
        }
    }
    sum * step
}

/// Cells that the surface passes through count by how far their middle is from it.
fn volume(truth: &Truth, body: usize) -> f64 {
    let [min, max] = truth.bodies[body].bounds();
    let step: Point = std::array::from_fn(|k| (max[k] - min[k]) / CELLS as f64);
    let width = step.iter().product::<f64>().cbrt();
    let mut sum = 0.0;
    for i in 0..CELLS.pow(3) {
        let cell = [i % CELLS, i / CELLS % CELLS, i / CELLS / CELLS];
        let p = std::array::from_fn(|k| min[k] + (cell[k] as f64 + 0.5) * step[k]);
        sum += (0.5 - truth.distance(body, p) / width).clamp(0.0, 1.0);
    }
    sum * step.iter().product::<f64>()
}
