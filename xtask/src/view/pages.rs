//! Particles whose picture is known.

use std::collections::BTreeMap;
use std::path::Path;

use sphpack::files::{Columns, write_csv};
use sphpack::{Options, Scene, run as pack};
use sphpack_packing::Silent;

use crate::workspace::root;

/// A file's columns, and its name.
pub(super) struct Page {
    pub(super) name: &'static str,
    pub(super) columns: Columns,
}

/// Columns and rows of the plane's lattice; odd, so that one is in the middle.
const PLANE: [usize; 2] = [61, 41];

/// The ends of the colour scale, its middle, and what is no number: red, green, blue.
pub(super) const PLANE_COLOURS: [[u8; 3]; 4] = [
    [0, 65, 154],
    [235, 235, 235],
    [151, 13, 20],
    [186, 190, 196],
];

pub(super) const BODIES: [&str; 3] = ["first", "second </script>", "third"];

/// Those of bodies.
pub(super) const BODY_COLOURS: [[u8; 3]; 3] = [[0, 114, 178], [213, 94, 0], [0, 158, 115]];

fn numbers<const N: usize>(columns: [(&str, Vec<f64>); N]) -> BTreeMap<String, Vec<f64>> {
    (columns.into_iter())
        .map(|(name, numbers)| (name.to_owned(), numbers))
        .collect()
}

/// Γ of a place in the plane: low on the left, even in the middle, high on the right; none in the upper right corner.
fn gamma([column, row]: [usize; 2]) -> f64 {
    match column {
        45.. if row >= 30 => f64::NAN,
        0..20 => 0.99,
        20..40 => 1.0,
        _ => 1.01,
    }
}

/// A lattice a million spacings from the origin.
pub(super) fn plane() -> Page {
    let places: Vec<[usize; 2]> = (0..PLANE[0] * PLANE[1])
        .map(|i| [i % PLANE[0], i / PLANE[0]])
        .collect();
    let along = |k: usize, from: f64| places.iter().map(|place| from + place[k] as f64).collect();
    Page {
        name: "plane.csv",
        columns: Columns {
            numbers: numbers([
                ("id", (0..places.len()).map(|i| i as f64).collect()),
                ("x", along(0, 1e6)),
                ("y", along(1, -3e6)),
                ("spacing", vec![1.0; places.len()]),
                ("gamma", places.iter().copied().map(gamma).collect()),
            ]),
            words: BTreeMap::new(),
        },
    }
}

/// For each of [`PLANE_COLOURS`], the share of particles that have it, and the middle of them within the drawing, to the right and up,
/// from 0 to 1.
pub(super) fn plane_shares(page: &Page) -> [(f64, [f64; 2]); 4] {
    let is_of = |colour: usize, gamma: f64| match colour {
        3 => gamma.is_nan(),
        _ => gamma == [0.99, 1.0, 1.01][colour],
    };
    let all = &page.columns.numbers["gamma"];
    std::array::from_fn(|colour| {
        let rows: Vec<usize> = (0..all.len()).filter(|&i| is_of(colour, all[i])).collect();
        let count = rows.len() as f64;
        let mean =
            |of: &dyn Fn(usize) -> usize| rows.iter().map(|&i| of(i) as f64).sum::<f64>() / count;
        let across = mean(&|i| i % PLANE[0]) / (PLANE[0] - 1) as f64;
        let up = mean(&|i| i / PLANE[0]) / (PLANE[1] - 1) as f64;
        (count / all.len() as f64, [across, up])
    })
}

/// Three blocks side by side, parted by a gap.
pub(super) fn space() -> Page {
    const SIDE: usize = 12;
    let mut columns = Columns::default();
    for (number, body) in BODIES.iter().enumerate() {
        for i in 0..SIDE.pow(3) {
            let place = [
                i % SIDE + number * (SIDE + 3),
                i / SIDE % SIDE,
                i / SIDE / SIDE,
            ];
            for (name, along) in ["x", "y", "z"].into_iter().zip(place) {
                let column = columns.numbers.entry(name.to_owned()).or_default();
                column.push(0.1 * along as f64);
            }
            let column = columns.words.entry("body".to_owned()).or_default();
            column.push((*body).to_owned());
        }
    }
    let rows = BODIES.len() * SIDE.pow(3);
    columns
        .numbers
        .insert("volume".to_owned(), vec![1e-3; rows]);
    Page {
        name: "space.csv",
        columns,
    }
}

/// A block of a million, with all columns that a packing has differing from row to row.
pub(super) fn million() -> Page {
    const SIDE: usize = 100;
    let rows = SIDE.pow(3);
    let along = |step: usize| (0..rows).map(|i| 0.01 * (i / step % SIDE) as f64).collect();
    let wave = |step: f64, size: f64, middle: f64| -> Vec<f64> {
        (0..rows)
            .map(|i| middle + size * (step * i as f64).sin())
            .collect()
    };
    let body = (0..rows).map(|i| if i % 3 == 0 { "wing" } else { "" }.to_owned());
    Page {
        name: "million.vtu",
        columns: Columns {
            numbers: numbers([
                ("id", (0..rows).map(|i| i as f64).collect()),
                ("x", along(1)),
                ("y", along(SIDE)),
                ("z", along(SIDE * SIDE)),
                ("volume", wave(0.1, 1e-8, 1e-6)),
                ("mass", wave(0.1, 1e-8, 1e-6)),
                ("density", vec![1.0; rows]),
                ("h", vec![0.012; rows]),
                ("spacing", vec![0.01; rows]),
                ("gamma", wave(0.37, 1e-2, 1.0)),
                ("residual", wave(0.11, 1e-3, 1e-3)),
                ("nx", wave(0.2, 1.0, 0.0)),
                ("ny", wave(0.3, 1.0, 0.0)),
                ("nz", wave(0.5, 1.0, 0.0)),
            ]),
            words: [("body".to_owned(), body.collect())].into(),
        },
    }
}

/// The shipped body, packed.
pub(super) fn spot() -> Result<Page, String> {
    let path = root().join("scenes/spot.toml");
    let scene = Scene::read(&path).map_err(|error| error.to_string())?;
    let outcome =
        pack(&scene, &Options::default(), &mut Silent).map_err(|error| error.to_string())?;
    let rows = (outcome.table).filtered(|i| scene.includes(outcome.table.kind[i]));
    let mut text = Vec::new();
    write_csv(&rows, &mut text).map_err(|error| error.to_string())?;
    let columns = sphpack::files::read_csv(&text, Path::new("spot.csv"));
    Ok(Page {
        name: "spot.csv",
        columns: columns.map_err(|error| error.to_string())?,
    })
}
