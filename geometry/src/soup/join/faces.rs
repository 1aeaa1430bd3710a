//! One triangle, cut along lines into parts, and these into triangles.

use std::collections::{BTreeMap, BTreeSet};

use robust::Coord;
use sphpack_neighbors::point;

use super::cuts::{Cuts, Segment};
use super::sheet::Sheet;
use super::tiles;
use crate::mesh::triangle;
use crate::soup::Soup;

/// The triangles that triangle `t` of `soup` falls into; `None` where its lines are not closed.
pub(super) fn parts(soup: &Soup, cuts: &mut Cuts, t: usize) -> Option<Vec<[u32; 3]>> {
    let ids = soup.triangles[t];
    let corners = soup.corners(t);
    let normal = triangle::area_vector(&corners);
    let axis = (0..3).fold(0, |a, k| {
        if normal[k].abs() > normal[a].abs() {
            k
        } else {
            a
        }
    });
    let flat = |p: [f64; 3]| {
        let (x, y) = (p[(axis + 1) % 3], p[(axis + 2) % 3]);
        if normal[axis] > 0.0 {
            Coord { x, y }
        } else {
            Coord { x: y, y: x }
        }
    };
    let mut rim = Vec::new();
    for k in 0..3 {
        rim.push(ids[k]);
        rim.extend(cuts.between(ids[k], ids[(k + 1) % 3]));
    }
    let segments = cuts.segments(t);
    let mut sheet = Sheet {
        place: BTreeMap::new(),
        space: BTreeMap::new(),
        on: BTreeMap::new(),
    };
    for k in 0..3 {
        for v in [ids[k], ids[(k + 1) % 3]]
            .into_iter()
            .chain(cuts.between(ids[k], ids[(k + 1) % 3]))
        {
            sheet.on.entry(v).or_default().push(k as u32);
        }
    }
    for segment in &segments {
        for v in segment.ends {
            sheet.on.entry(v).or_default().push(3 + segment.other);
        }
    }
    let ends = segments.iter().flat_map(|s| s.ends);
    for v in rim.iter().copied().chain(ends) {
        let p = cuts.place(soup, v);
        sheet.place.insert(v, flat(p));
        sheet.space.insert(v, p);
    }
    let lines = split(soup, &mut sheet, cuts, t as u32, &segments, flat);
    let mut after: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let mut add = |a: u32, b: u32| {
        let list = after.entry(a).or_default();
        if !list.contains(&b) {
            list.push(b);
        }
    };
    for (i, &a) in rim.iter().enumerate() {
        let b = rim[(i + 1) % rim.len()];
        add(a, b);
        add(b, a);
    }
    for &[a, b] in &lines {
        cuts.note(a, b);
        add(a, b);
        add(b, a);
    }
    if after.values().any(|list| list.len() < 2) {
        return None;
    }
    let cycles = cycles(&sheet, &mut after);
    fill(&sheet, cycles)
}

/// The segments, cut where they cross each other: there three triangles meet.
fn split(
    soup: &Soup,
    sheet: &mut Sheet,
    cuts: &mut Cuts,
    t: u32,
    segments: &[Segment],
    flat: impl Fn([f64; 3]) -> Coord<f64>,
) -> Vec<[u32; 2]> {
    let mut on: Vec<Vec<(f64, u32)>> = vec![Vec::new(); segments.len()];
    for i in 0..segments.len() {
        for j in i + 1..segments.len() {
            let (a, b) = (segments[i].ends, segments[j].ends);
            if !sheet.cross(a, b) {
                continue;
            }
            let (h, g) = (sheet.turn(b[0], b[1], a[0]), sheet.turn(b[0], b[1], a[1]));
            let (p, q) = (sheet.space[&a[0]], sheet.space[&a[1]]);
            let place = point::add_scaled(p, h / (h - g), point::sub(q, p));
            let v = cuts.triple([t, segments[i].other, segments[j].other], place);
            // The same place for all three triangles, whoever found it first.
            let place = cuts.place(soup, v);
            sheet.place.insert(v, flat(place));
            sheet.space.insert(v, place);
            let lines = [segments[i].other, segments[j].other].map(|other| 3 + other);
            sheet.on.entry(v).or_default().extend(lines);
            for (k, ends) in [(i, a), (j, b)] {
                on[k].push((point::distance(sheet.space[&ends[0]], place), v));
            }
        }
    }
    let mut lines = Vec::new();
    for (segment, mut on) in segments.iter().zip(on) {
        on.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut from = segment.ends[0];
        for v in on.into_iter().map(|(_, v)| v).chain([segment.ends[1]]) {
            if v != from {
                lines.push([from, v]);
            }
            from = v;
        }
    }
    lines
}

/// The cycles of points around every part, each with the part on its left.
fn cycles(sheet: &Sheet, after: &mut BTreeMap<u32, Vec<u32>>) -> Vec<Vec<u32>> {
    for (&v, list) in after.iter_mut() {
        list.sort_by(|&a, &b| {
            let (x, y) = (sheet.direction(v, a), sheet.direction(v, b));
            x.total_cmp(&y).then(a.cmp(&b))
        });
    }
    let mut seen: BTreeSet<(u32, u32)> = BTreeSet::new();
    let mut cycles = Vec::new();
    for (&a, list) in after.iter() {
        for &b in list {
            let mut cycle = Vec::new();
            let (mut from, mut to) = (a, b);
            while seen.insert((from, to)) {
                cycle.push(from);
                // On along the next line clockwise from the one that came.
                let around = &after[&to];
                let back = around.iter().position(|&v| v == from).unwrap_or(0);
                let next = around[(back + around.len() - 1) % around.len()];
                (from, to) = (to, next);
            }
            if !cycle.is_empty() {
                cycles.push(cycle);
            }
        }
    }
    cycles
}

/// Triangles over the parts: counter-clockwise cycles, less the clockwise ones within them.
fn fill(sheet: &Sheet, cycles: Vec<Vec<u32>>) -> Option<Vec<[u32; 3]>> {
    let (mut parts, mut holes): (Vec<_>, Vec<_>) = cycles
        .into_iter()
        .partition(|cycle| sheet.area(cycle) > 0.0);
    // The largest clockwise one is the rim seen from beyond.
    let beyond = (0..holes.len())
        .min_by(|&i, &j| sheet.area(&holes[i]).total_cmp(&sheet.area(&holes[j])))?;
    holes.swap_remove(beyond);
    for hole in holes {
        let home = (0..parts.len())
            .filter(|&p| !parts[p].contains(&hole[0]) && sheet.holds(&parts[p], hole[0]))
            .min_by(|&p, &q| sheet.area(&parts[p]).total_cmp(&sheet.area(&parts[q])))?;
        parts[home] = bridged(sheet, &parts[home], &hole)?;
    }
    let mut triangles = Vec::new();
    for part in parts {
        triangles.extend(tiles::over(sheet, &part));
    }
    Some(triangles)
}

/// One cycle of a part and a hole in it, joined by a line there and back.
fn bridged(sheet: &Sheet, part: &[u32], hole: &[u32]) -> Option<Vec<u32>> {
    let mut ways: Vec<(f64, usize, usize)> = Vec::new();
    for (i, p) in part.iter().enumerate() {
        for (j, h) in hole.iter().enumerate() {
            let d = point::distance_squared(sheet.space[p], sheet.space[h]);
            ways.push((d, i, j));
        }
    }
    ways.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let sides = |cycle: &[u32]| -> Vec<[u32; 2]> {
        (0..cycle.len())
            .map(|k| [cycle[k], cycle[(k + 1) % cycle.len()]])
            .collect()
    };
    let walls: Vec<[u32; 2]> = [sides(part), sides(hole)].concat();
    let (_, i, j) = ways.into_iter().find(|&(_, i, j)| {
        walls
            .iter()
            .all(|&wall| !sheet.cross(wall, [part[i], hole[j]]))
    })?;
    let mut cycle = part[..=i].to_vec();
    cycle.extend(hole[j..].iter().chain(&hole[..=j]));
    cycle.extend(&part[i..]);
    Some(cycle)
}
