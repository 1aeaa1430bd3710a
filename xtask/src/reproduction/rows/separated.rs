//! 000 §2.7 and 001 §3.1.7: which points are in a body.

use super::row;
use crate::reproduction::measure::Measure;
use crate::reproduction::row::Row;
use crate::reproduction::trials::Separated;

/// How a body is given, which tells what the papers' ways to its inside are.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Given {
    Outline,
    Mesh,
    /// In space, where neither way has anything to go by.
    Formula,
}

/// Bodies, points, how they are given, and whether they are quick.
const BODIES: [(&str, usize, Given, bool); 12] = [
    ("cylinder", 2000, Given::Outline, true),
    ("square", 4000, Given::Outline, true),
    ("starfish", 2000, Given::Outline, true),
    ("zigzag", 4000, Given::Outline, true),
    ("naca0015", 4000, Given::Outline, true),
    ("naca5515", 4000, Given::Outline, true),
    ("s_shape", 4000, Given::Outline, true),
    ("sphere", 4000, Given::Formula, true),
    ("ellipsoid", 4000, Given::Formula, true),
    ("cube", 4000, Given::Formula, true),
    ("spot", 1000, Given::Mesh, true),
    ("bunny", 4000, Given::Mesh, false),
];

/// What is ours, or of the machine.
const NO_NUMBER: &str = "no number";

pub(super) fn separated(all: &mut Vec<Row>) {
    for (scene, points, given, quick) in BODIES {
        let trial = Separated { scene, points };
        let way = match given {
            Given::Outline => Some((
                "signed angles tell inside from outside",
                [Measure::WrongByAngles, Measure::SecondsByAngles],
            )),
            Given::Mesh => Some((
                "rays tell inside from outside",
                [Measure::WrongByRays, Measure::SecondsByRays],
            )),
            Given::Formula => None,
        };
        let mut rows = Vec::new();
        if let Some((claim, [wrong, seconds])) = way {
            let of = |measure| row("sec2.7", trial, measure).of("000");
            rows.push(of(wrong).claims(claim).at_most(0.0));
            rows.push(of(seconds).claims(NO_NUMBER));
        }
        let of = |measure| row("sec3.1.7", trial, measure).claims(NO_NUMBER);
        rows.extend([
            of(Measure::WrongByFlood)
                .claims("a flood from the surface tells inside from outside")
                .at_most(0.0),
            of(Measure::SecondsByFlood),
            of(Measure::WrongByTest).at_most(0.0),
            of(Measure::SecondsByTest),
            of(Measure::NeighboursDiffer).at_most(0.0),
            of(Measure::SecondsByTree),
            of(Measure::SecondsByCells),
        ]);
        if quick {
            rows = rows.into_iter().map(Row::quick).collect();
        }
        all.append(&mut rows);
    }
}
