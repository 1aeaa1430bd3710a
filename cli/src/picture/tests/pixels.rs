//! What is seen where: particles in the colour of their density, ink where surfaces are, paper elsewhere.

use sphpack_packing::Kind;

use super::super::canvas::Canvas;
use super::super::colour::{GREY, INK, Scale, WHITE};
use super::super::{PictureFormat, Table};
use super::{drawn, in_pixels, lattice};

/// How far the lattice of 13 sites a side goes to either side.
const HALF: f64 = 0.6;

/// Radii of the discs of its frozen particles in the plane and in a slice: 0.2 ∆s, and 0.85 times that.
const FROZEN: [f64; 2] = [0.02, 0.017];

/// A picture whose frozen particles, which are on the rim of the lattice, tell where places are.
struct Seen {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
    /// Left, top, right and bottom of the frozen particles, pixels.
    rim: [f64; 4],
    /// How far the frozen particles' discs go to either side.
    half: f64,
}

impl Seen {
    /// Frozen particles are looked for in the columns before `end`; right of it are legends.
    fn of(table: &Table, end: usize) -> Self {
        let Canvas {
            width,
            height,
            pixels,
        } = in_pixels(table);
        let grey = (0..pixels.len())
            .filter(|&i| i % width < end && pixels[i] == GREY)
            .map(|i| [i % width, i / width]);
        let far = [f64::INFINITY, f64::INFINITY, 0.0, 0.0];
        let rim = grey.fold(far, |[left, top, right, bottom], [x, y]| {
            let (x, y) = (x as f64, y as f64);
            [
                left.min(x),
                top.min(y),
                right.max(x + 1.0),
                bottom.max(y + 1.0),
            ]
        });
        let [left, top, right, bottom] = rim;
        assert!(left < right, "nothing is grey");
        // The lattice is as wide as it is high.
        let off = (right - left) - (bottom - top);
        assert!(off.abs() <= 2.0, "{rim:?}");
        Self {
            width,
            height,
            pixels,
            rim,
            half: HALF + FROZEN[table.dimension - 2],
        }
    }

    fn pixel(&self, x: usize, y: usize) -> [u8; 3] {
        self.pixels[y * self.width + x]
    }

    /// The colour at a place of the scene: x goes right, y up.
    fn at(&self, [x, y]: [f64; 2]) -> [u8; 3] {
        let part = |v: f64| 0.5 * (v / self.half + 1.0);
        let [left, top, right, bottom] = self.rim;
        let across = left + part(x) * (right - left);
        let down = bottom - part(y) * (bottom - top);
        self.pixel(across as usize, down as usize)
    }
}

/// Red less blue.
fn warmth([red, _, blue]: [u8; 3]) -> i32 {
    i32::from(red) - i32::from(blue)
}

/// Every particle of the layer z = 0 has the colour that the scale gives its density; who is above 1 is warm, who is
/// below is cold, and the more so the farther off; frozen ones are grey whatever their density.
fn check_particles(table: &Table, seen: &Seen) {
    let scale = Scale::holding(table.linf());
    let mut found: Vec<(f64, i32)> = Vec::new();
    for i in (0..table.len()).filter(|&i| table.position[i][2].abs() < 0.01) {
        let [x, y, _] = table.position[i];
        let (colour, gamma) = (seen.at([x, y]), table.gamma[i]);
        if table.kind[i] == Kind::Frozen {
            assert_eq!(colour, GREY, "at {x}, {y}");
            continue;
        }
        assert_eq!(colour, scale.colour(gamma), "at {x}, {y}");
        let off = gamma - 1.0;
        assert!(off.abs() < 1e-12 || f64::from(warmth(colour)) * off > 0.0);
        found.push((off, warmth(colour)));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    for pair in found.windows(2) {
        assert!(pair[1].1 >= pair[0].1 - 1, "{pair:?}");
    }
    let ends = [found[0].1, found[found.len() - 1].1];
    assert!(ends[1] - ends[0] > 200, "{ends:?}");
    assert!(found.len() == 121, "{}", found.len());
}

/// Γ grows to the right and, less, upwards.
fn tilted(mut table: Table) -> Table {
    for (gamma, [x, y, _]) in table.gamma.iter_mut().zip(&table.position) {
        *gamma = 1.0 + 0.0034 * x + 0.0006 * y;
    }
    table
}

/// Γ falls instead of growing.
fn turned(mut table: Table) -> Table {
    for gamma in &mut table.gamma {
        *gamma = 2.0 - *gamma;
    }
    table
}

#[test]
fn in_the_plane_colours_follow_density() {
    for table in [tilted(lattice(2, 13)), turned(tilted(lattice(2, 13)))] {
        let seen = Seen::of(&table, 1370);
        check_particles(&table, &seen);
        // Between four discs, below and left of the body, is paper; so are the corners of the sheet.
        for place in [[-0.35, -0.35], [0.45, -0.25], [-0.25, 0.35], [0.05, -0.45]] {
            assert_eq!(seen.at(place), WHITE, "{place:?}");
        }
        for (x, y) in [
            (3, 3),
            (3, seen.height - 4),
            (seen.width - 4, seen.height - 4),
        ] {
            assert_eq!(seen.pixel(x, y), WHITE);
        }
        // The body's outline, drawn over the discs, and its inside where no disc is.
        for place in [[-0.25, -0.05], [0.15, -0.05], [0.175, 0.165]] {
            assert_eq!(seen.at(place), INK, "{place:?}");
        }
        assert_eq!(seen.at([0.05, 0.05]), WHITE);
        // Boundary particles have a rim, free ones none.
        assert_eq!(seen.at([0.3 + 0.041, 0.0]), INK);
        assert_ne!(seen.at([0.4 + 0.041, 0.0]), INK);
    }
}

#[test]
fn slices_show_the_layer_through_the_body() {
    for mut table in [tilted(lattice(3, 13)), turned(tilted(lattice(3, 13)))] {
        // Other layers are of another density, and not seen.
        for i in 0..table.len() {
            if table.position[i][2].abs() > 0.05 {
                table.gamma[i] = 1.0;
            }
        }
        let seen = Seen::of(&table, 820);
        check_particles(&table, &seen);
        // Thick rings: on the surface; thin ones: solid; none: fluid.
        let at = |x: f64, off: f64| seen.at([x, off]);
        assert_eq!(at(0.3, 0.033), INK);
        assert_ne!(at(0.2, 0.027), INK);
        assert_ne!(at(0.4, 0.033), INK);
    }
}

/// The surface particles from outside: the warm half is where Γ is above 1, and around them is paper.
#[test]
fn spheres_have_the_colour_of_their_density() {
    for (table, sign) in [(lattice(3, 13), 1), (turned(lattice(3, 13)), -1)] {
        let Canvas { width, pixels, .. } = in_pixels(&table);
        // The panel is 780 pixels wide, from column 860 and row 70 on.
        let panel = |x: usize, y: usize| pixels[(70 + y) * width + 860 + x];
        for (x, y) in [(3, 3), (776, 3), (3, 776), (776, 776)] {
            assert_eq!(panel(x, y), WHITE);
        }
        let warmth_of = |columns: std::ops::Range<usize>| -> i32 {
            let middle = columns.flat_map(|x| (290..490).map(move |y| (x, y)));
            middle.map(|(x, y)| warmth(panel(x, y))).sum::<i32>() / (200 * 200)
        };
        // The eye is in front, to the right: x goes right.
        let (left, right) = (warmth_of(90..290), warmth_of(490..690));
        assert!(sign * left < -10 && sign * right > 10, "{left} {right}");
    }
}

#[test]
fn an_svg_has_the_colours_of_the_png() {
    let table = lattice(2, 13);
    let scale = Scale::holding(table.linf());
    let text = String::from_utf8(drawn(&table, PictureFormat::Svg)).unwrap();
    // Where the discs of a colour are, across.
    let places = |[red, green, blue]: [u8; 3]| -> Vec<f64> {
        let fill = format!("fill=\"#{red:02x}{green:02x}{blue:02x}\"");
        let discs = text.lines().filter(|line| line.starts_with("<circle"));
        let own = discs.filter(|line| line.contains(&fill));
        own.map(|line| line.split('"').nth(1).unwrap().parse().unwrap())
            .collect()
    };
    // One is the legend's.
    assert_eq!(places(GREY).len(), 48 + 1);
    let mut before = 0.0;
    for column in 1..12 {
        let gamma = 1.0 + 0.004 * 0.1 * (f64::from(column) - 6.0);
        let places = places(scale.colour(gamma));
        assert_eq!(places.len(), 11, "column {column}");
        assert!(places.iter().all(|x| *x == places[0] && *x > before));
        before = places[0];
    }
}
