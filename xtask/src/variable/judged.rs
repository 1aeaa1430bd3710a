//! Figures of a packing by plain loops over its columns.

use std::collections::HashMap;
use std::f64::consts::PI;

use sphpack::Outcome;
use sphpack_packing::Kind;

/// All pairs of more particles than this take too long.
const FEW: usize = 16_000;

/// What is found.
#[derive(Debug)]
pub(super) struct Judged {
    /// The largest ∣Γ − 1∣ by all pairs, where there are few enough.
    pub(super) linf: Option<f64>,
    /// The nearest pair of which one is free, in the mean of both sizes.
    pub(super) closest_free: f64,
    /// The least and the greatest V^(1/D) of free particles over the spacing that is written for them.
    pub(super) size_over_asked: [f64; 2],
}

impl Judged {
    pub(super) fn of(outcome: &Outcome) -> Self {
        let table = &outcome.table;
        let dimension = table.dimension as i32;
        let size: Vec<f64> = (table.volume.iter())
            .map(|volume| volume.powf(1.0 / f64::from(dimension)))
            .collect();
        let free = |i: usize| table.kind[i] == Kind::Free;
        let mut size_over_asked = [f64::INFINITY, 0.0_f64];
        for i in (0..table.len()).filter(|&i| free(i)) {
            let ratio = size[i] / table.spacing_of(i);
            size_over_asked = [size_over_asked[0].min(ratio), size_over_asked[1].max(ratio)];
        }
        Self {
            linf: (is_open(outcome) && table.len() <= FEW).then(|| linf(outcome)),
            closest_free: closest(&table.position, &size, |i, j| free(i) || free(j)),
            size_over_asked,
        }
    }
}

/// Whether all that a particle sees is in the table.
fn is_open(outcome: &Outcome) -> bool {
    let periodic = &outcome.report.scene.domain.periodic;
    !periodic.iter().flatten().any(|&axis| axis)
}

/// The quintic by its definition (Morris, Fox, Zhu 1997), over all pairs.
fn linf(outcome: &Outcome) -> f64 {
    let table = &outcome.table;
    let scale = if table.dimension == 2 {
        7.0 / (478.0 * PI)
    } else {
        1.0 / (120.0 * PI)
    };
    let mut worst: f64 = 0.0;
    for i in (0..table.len()).filter(|&i| table.kind[i] != Kind::Frozen) {
        let h = table
            .smoothing_length
            .get(i)
            .copied()
            .unwrap_or(1.2 * outcome.report.spacing);
        let [x, y, z] = table.position[i];
        let mut gamma = 0.0;
        for (&[u, v, w], volume) in table.position.iter().zip(&table.volume) {
            let square = (x - u).powi(2) + (y - v).powi(2) + (z - w).powi(2);
            if square < 9.0 * h * h {
                let q = square.sqrt() / h;
                let power = |edge: f64| (edge - q).max(0.0).powi(5);
                gamma += volume * (power(3.0) - 6.0 * power(2.0) + 15.0 * power(1.0));
            }
        }
        let unit = h.powi(table.dimension as i32);
        worst = worst.max((gamma * scale / unit - 1.0).abs());
    }
    worst
}

/// The least distance over the mean size of the pairs that count, by one grid for each octave of size.
fn closest(places: &[[f64; 3]], size: &[f64], counts: impl Fn(usize, usize) -> bool) -> f64 {
    let finest = size.iter().copied().fold(f64::INFINITY, f64::min);
    let octave = |s: f64| (s / finest).log2() as i32;
    let most = size.iter().map(|&s| octave(s)).max().unwrap_or(0);
    let mut least = f64::INFINITY;
    for own in 0..=most {
        // Twice as wide as any of them: neighbours in size are in this octave or the ones beside it.
        let edge = finest * 2.0_f64.powi(own + 1);
        let cell = |p: [f64; 3]| p.map(|x| (x / edge).floor() as i64);
        let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
        for i in (0..places.len()).filter(|&i| (octave(size[i]) - own).abs() <= 1) {
            cells.entry(cell(places[i])).or_default().push(i);
        }
        for i in (0..places.len()).filter(|&i| octave(size[i]) == own) {
            let [a, b, c] = cell(places[i]);
            for step in 0..27 {
                let key = [a + step % 3 - 1, b + step / 3 % 3 - 1, c + step / 9 - 1];
                for &j in cells.get(&key).into_iter().flatten() {
                    if j != i && counts(i, j) {
                        let [x, y, z] = std::array::from_fn(|k| places[i][k] - places[j][k]);
                        let distance = (x * x + y * y + z * z).sqrt();
                        least = least.min(2.0 * distance / (size[i] + size[j]));
                    }
                }
            }
        }
    }
    least
}
