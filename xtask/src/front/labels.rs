//! Names beside points, where there is room.

use sphpack::picture::text_width;

/// Letter size of names, and the height of a line of them.
pub(super) const NAME: f64 = 12.0;
const LINE: f64 = 13.0;

/// A name and where it goes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Label {
    /// Left end of its base line.
    pub(super) at: [f64; 2],
    /// Where a line to its point ends, if it is far from it.
    pub(super) leader: Option<[f64; 2]>,
}

/// An upright rectangle: left, top, right, bottom.
type Room = [f64; 4];

/// Distances from the point at which room is looked for.
const FAR: [f64; 5] = [8.0, 20.0, 34.0, 50.0, 70.0];

/// Directions: right and left first, where a name reads best.
const WAYS: [[f64; 2]; 8] = [
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.7, -0.7],
    [0.7, 0.7],
    [-0.7, -0.7],
    [-0.7, 0.7],
    [0.0, -1.0],
    [0.0, 1.0],
];

/// Places for names of points, within `within`: each where it covers least of the names before it and of the marks.
pub(super) fn placed(names: &[(&str, [f64; 2])], marks: &[[f64; 2]], within: Room) -> Vec<Label> {
    let mut taken: Vec<Room> = Vec::new();
    let mut labels = Vec::new();
    for (name, point) in names {
        let width = text_width(name, NAME);
        let mut best: Option<(f64, Room, f64)> = None;
        for far in FAR {
            for way in WAYS {
                let room = room(*point, way, far, width);
                let cost = cost(room, &taken, marks, within) + 0.02 * far;
                if best.is_none_or(|(least, ..)| cost < least) {
                    best = Some((cost, room, far));
                }
            }
        }
        let Some((_, room, far)) = best else {
            continue;
        };
        taken.push(room);
        let middle = 0.5 * (room[1] + room[3]);
        labels.push(Label {
            at: [room[0], room[3] - 3.0],
            leader: (far > FAR[0]).then(|| [point[0].clamp(room[0], room[2]), middle]),
        });
    }
    labels
}

/// The rectangle of a name so far from a point on one side of it.
fn room(point: [f64; 2], way: [f64; 2], far: f64, width: f64) -> Room {
    let [x, y] = [point[0] + far * way[0], point[1] + far * way[1]];
    let left = if way[0] > 0.1 {
        x
    } else if way[0] < -0.1 {
        x - width
    } else {
        x - 0.5 * width
    };
    [left, y - 0.5 * LINE, left + width, y + 0.5 * LINE]
}

/// What is wrong with a place: names covered weigh most, then the edge, then marks.
fn cost(room: Room, taken: &[Room], marks: &[[f64; 2]], within: Room) -> f64 {
    let overlaps = |other: &&Room| {
        room[0] < other[2] && other[0] < room[2] && room[1] < other[3] && other[1] < room[3]
    };
    let covers = |mark: &&[f64; 2]| {
        let [x, y] = **mark;
        room[0] - 4.0 < x && x < room[2] + 4.0 && room[1] - 3.0 < y && y < room[3] + 3.0
    };
    let is_out =
        room[0] < within[0] || room[1] < within[1] || room[2] > within[2] || room[3] > within[3];
    20.0 * taken.iter().filter(overlaps).count() as f64
        + if is_out { 40.0 } else { 0.0 }
        + marks.iter().filter(covers).count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_points_that_nearly_coincide_do_not_cover_each_other() {
        let points = [[100.0, 100.0], [102.0, 101.0], [99.0, 103.0]];
        let names: Vec<(&str, [f64; 2])> = points.iter().map(|&p| ("some name", p)).collect();
        let labels = placed(&names, &points, [0.0, 0.0, 300.0, 200.0]);
        assert_eq!(labels.len(), 3);
        let width = text_width("some name", NAME);
        for (i, a) in labels.iter().enumerate() {
            for b in &labels[..i] {
                let apart = [0, 1].map(|k| (a.at[k] - b.at[k]).abs());
                assert!(apart[0] >= width || apart[1] >= LINE, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn names_stay_inside() {
        let labels = placed(
            &[("at the edge", [295.0, 5.0])],
            &[],
            [0.0, 0.0, 300.0, 200.0],
        );
        let at = labels[0].at;
        assert!(
            at[0] + text_width("at the edge", NAME) <= 300.0 && at[1] >= 6.0,
            "{at:?}"
        );
    }
}
