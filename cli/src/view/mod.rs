//! Particles to look at: a page of HTML that holds all of them and whatever shows them, and asks for nothing else.
//!
//! ```no_run
//! use std::path::Path;
//! use sphpack::files::Columns;
//! use sphpack::view::View;
//!
//! let path = Path::new("wing.vtu");
//! let view = View::of(Columns::read(path)?, path)?;
//! view.write(&mut std::fs::File::create("wing.html")?)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod base64;
mod column;
mod page;
mod size;

use std::path::Path;

use sphpack_neighbors::Bounds;
use sphpack_packing::Kind;

use crate::Error;
use crate::files::Columns;
use crate::places::places;
use column::Stored;
use size::Size;

/// Columns in the order in which a row is shown; others follow by name.
const ORDER: [&str; 16] = [
    "id", "kind", "side", "body", "volume", "mass", "density", "h", "spacing", "gamma", "residual",
    "nx", "ny", "nz", "distance", "pressure",
];

/// What is coloured at first: the first of these that is there and differs from row to row.
const FIRST: [&str; 6] = ["gamma", "density", "pressure", "body", "kind", "spacing"];

/// Particles as a page holds them.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The file's name.
    name: String,
    dimension: usize,
    /// The box around them.
    bounds: Bounds<3>,
    position: Vec<[f64; 3]>,
    /// Without the coordinates.
    columns: Vec<Stored>,
    size: Size,
    /// The column that is coloured at first; a coordinate where there is nothing else.
    colour: String,
}

impl View {
    /// Of a file's columns; `path` is for messages and the page's title.
    ///
    /// # Errors
    /// [`Error::Input`] where there are no coordinates, no particles, or a coordinate is not a finite number of usual size.
    pub fn of(mut columns: Columns, path: &Path) -> Result<Self, Error> {
        let (dimension, position) = places(&columns, path)?;
        let size = Size::of(&columns, dimension, &position);
        for name in ["x", "y", "z"] {
            columns.numbers.remove(name);
        }
        // VTK's formats have it in the plane, too.
        if dimension == 2 {
            let is_flat = |nz: &Vec<f64>| nz.iter().all(|&nz| nz == 0.0);
            if columns.numbers.get("nz").is_some_and(is_flat) {
                columns.numbers.remove("nz");
            }
        }
        let numbers =
            (columns.numbers.into_iter()).map(|(name, numbers)| Stored::numbers(name, numbers));
        let words = (columns.words.into_iter()).map(|(name, words)| {
            let first = first_words(&name, &words);
            Stored::words(name, &words, &first)
        });
        let mut columns: Vec<Stored> = numbers.chain(words).collect();
        let place = |column: &Stored| {
            (ORDER.iter().position(|&name| name == column.name)).unwrap_or(ORDER.len())
        };
        columns.sort_by(|a, b| (place(a), &a.name).cmp(&(place(b), &b.name)));
        let differs = |name: &&str| {
            let mut all = columns.iter();
            all.any(|column| column.name == **name && !column.is_one_value())
        };
        let colour = FIRST.iter().find(|name| differs(name)).unwrap_or(&"x");
        let name = path.file_name().unwrap_or_default();
        Ok(Self {
            name: name.to_string_lossy().into_owned(),
            dimension,
            bounds: Bounds::of(&position),
            colour: (*colour).to_owned(),
            position,
            columns,
            size,
        })
    }

    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are none, which cannot be.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The column that is coloured at first.
    pub fn colour(&self) -> &str {
        &self.colour
    }

    /// The middle of the box: places are stored relative to it, so that 32 bits are enough wherever it is.
    fn middle(&self) -> [f64; 3] {
        std::array::from_fn(|k| 0.5 * self.bounds.min[k] + 0.5 * self.bounds.max[k])
    }
}

/// The words of a column that has an order of its own, as far as they are there: their colours are the same in every file then.
fn first_words(name: &str, words: &[String]) -> Vec<&'static str> {
    let known: Vec<&'static str> = match name {
        "kind" => Kind::ALL.map(Kind::name).to_vec(),
        "side" => vec!["solid", "fluid"],
        _ => return Vec::new(),
    };
    if words.iter().all(|word| known.contains(&word.as_str())) {
        known
    } else {
        Vec::new()
    }
}
