//! The pinned cells: on both sides of each map's edge what comes of a scene is written down.

use super::super::in_parallel;
use super::bench::{Bench, METHODS};
use super::panel::{Map, Pin};

/// Tries the pinned cells of maps by the default method; fails where one is not what is written.
pub(super) fn run(bench: &Bench, maps: impl Iterator<Item = &'static Map>) -> Result<(), String> {
    let pins: Vec<(&Map, &Pin)> = maps
        .flat_map(|map| map.pins.iter().map(move |pin| (map, pin)))
        .collect();
    let said = in_parallel(pins.len(), |job, worker| tried(bench, pins[job], worker))?;
    let mut moved = Vec::new();
    for (line, is_as_written) in said {
        println!("{line}");
        if !is_as_written {
            moved.push(line);
        }
    }
    if moved.is_empty() {
        Ok(())
    } else {
        Err(format!(
            "edges have moved; where that is better, write the new ones into maps/table.rs:\n{}",
            moved.join("\n")
        ))
    }
}

/// What came of a pinned cell, and whether it is what is written.
fn tried(bench: &Bench, (map, pin): (&Map, &Pin), worker: usize) -> Result<(String, bool), String> {
    let panel = &map.panels[pin.panel];
    let [x, y] = pin.at;
    let no_cell = || format!("{}: no cell is at {x}, {y}", map.name);
    let place = [panel.x.place(x), panel.y.place(y)];
    let place = [place[0].ok_or_else(no_cell)?, place[1].ok_or_else(no_cell)?];
    let cell = bench
        .cell(map, pin.panel, place, METHODS[0], worker)?
        .ok_or_else(no_cell)?;
    let mut line = format!(
        "{}: {}: {}, {}: {}: {}",
        map.name,
        panel.x.label,
        panel.x.word(place[0]),
        panel.y.label,
        panel.y.word(place[1]),
        cell.outcome.words()
    );
    let is_as_written = cell.outcome == pin.outcome;
    if !is_as_written {
        line += &format!(", was {}; {}", pin.outcome.words(), cell.why);
    }
    Ok((line, is_as_written))
}

#[cfg(test)]
mod tests {
    use super::super::outcome::Outcome;
    use super::super::table::MAPS;

    #[test]
    fn every_map_is_pinned_on_both_sides_at_cells_that_are_there() {
        for map in &MAPS {
            let inside = (map.pins.iter()).filter(|pin| pin.outcome == Outcome::Passes);
            let count = inside.count();
            assert!(count > 0, "{} has no cell within its edge", map.name);
            assert!(count < map.pins.len(), "{} has none beyond it", map.name);
            for pin in map.pins {
                let panel = &map.panels[pin.panel];
                let [x, y] = pin.at;
                let is_there = panel.x.place(x).is_some() && panel.y.place(y).is_some();
                assert!(is_there, "{} has no cell at {x}, {y}", map.name);
            }
        }
    }
}
