//! Corners and edges within a box.

use sphpack_neighbors::{Domain, point};

use super::slack;
use super::window::{holds, part_of_way};
use crate::surface::Features;

/// Features within the box: corners, and edges cut where they pass a side.
pub(super) fn features_in(all: Features<3>, domain: &Domain<3>) -> Features<3> {
    let slack = slack(domain);
    let mut corners = all.corners;
    corners.retain(|&c| holds(c, domain, slack));
    let mut edges = Vec::new();
    for edge in all.edges {
        let mut run: Vec<[f64; 3]> = Vec::new();
        for pair in edge.windows(2) {
            let way = point::sub(pair[1], pair[0]);
            let Some([from, to]) = part_of_way(pair[0], pair[1], domain) else {
                edges.push(std::mem::take(&mut run));
                continue;
            };
            let place = |t: f64| {
                if t == 1.0 {
                    pair[1]
                } else {
                    point::add_scaled(pair[0], t, way)
                }
            };
            if from > 0.0 {
                edges.push(std::mem::take(&mut run));
            }
            if run.is_empty() {
                run.push(place(from));
            }
            run.push(place(to));
            if to < 1.0 {
                edges.push(std::mem::take(&mut run));
            }
        }
        edges.push(run);
    }
    edges.retain(|run| run.len() > 1);
    Features { corners, edges }
}
