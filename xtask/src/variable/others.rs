//! The other ways to particles of many sizes: lattices within lattices, and shifting from there.

use std::fmt::Write as _;
use std::sync::Arc;

use sphpack_geometry::Ball;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Bounds, Domain, point};
use sphpack_packing::closest_pair::NEIGHBORS_IN_SIZES;
use sphpack_packing::{ClosestPair, DensityQuality, Fields, Refinement, Resolution, Sizes};

/// h/s.
const H_OVER_SPACING: f64 = 1.2;

/// A step of shifting is this part of h² ∇Γ.
const SHIFT: f64 = 0.25;

/// A set in a periodic box.
struct Set {
    domain: Domain<2>,
    positions: Vec<[f64; 2]>,
    spacing: Vec<f64>,
    volume: Vec<f64>,
}

impl Set {
    fn fields(&self) -> Fields<2> {
        Fields::measure_each(
            &self.domain,
            &self.positions,
            &self.volume,
            Sizes::each(&self.spacing, H_OVER_SPACING),
            |_| true,
            KernelKind::Quintic,
        )
    }

    fn line(&self, what: &str) -> String {
        let fields = self.fields();
        let density = DensityQuality::of(&fields.gamma, 1.0);
        let residual: Vec<f64> = (0..self.positions.len())
            .map(|i| fields.residual(i))
            .collect();
        let count = residual.len() as f64;
        let rms = (residual.iter().map(|r| r * r).sum::<f64>() / count).sqrt();
        let pair = ClosestPair::by_size(
            &self.domain,
            &self.positions,
            &self.volume,
            |_| true,
            2.0 * self.spacing.iter().copied().fold(f64::INFINITY, f64::min),
            NEIGHBORS_IN_SIZES,
        );
        format!(
            "| {what} | {} | {:.2} % | {:.2} % | {:.1e}, {rms:.1e} | {:.2} |\n",
            residual.len(),
            100.0 * density.linf,
            100.0 * density.rms,
            residual.iter().copied().fold(0.0, f64::max),
            pair.crowded
        )
    }

    /// Volumes and sizes as the field says, all of them together the box's.
    fn follow(&mut self, field: &Resolution<2>) {
        self.spacing = self.positions.iter().map(|&p| field.at(p).value).collect();
        let all: f64 = self.spacing.iter().map(|s| s * s).sum();
        let share = self.domain.bounds.volume() / all;
        self.volume = self.spacing.iter().map(|s| share * s * s).collect();
    }

    fn shift(&mut self, field: &Resolution<2>) {
        self.follow(field);
        let fields = self.fields();
        for i in 0..self.positions.len() {
            let h = H_OVER_SPACING * self.spacing[i];
            let step = point::scale(fields.gradient[i], -SHIFT * h * h);
            let moved = point::add(self.positions[i], step);
            self.positions[i] = self.domain.wrap(moved);
        }
    }
}

/// Squares, halved where the field asks for less than 1/√2 of their edge.
fn nested(domain: Domain<2>, field: &Resolution<2>, coarsest: f64) -> Set {
    let mut set = Set {
        domain,
        positions: Vec::new(),
        spacing: Vec::new(),
        volume: Vec::new(),
    };
    let count = (domain.bounds.size()[0] / coarsest).round() as usize;
    let edge = domain.bounds.size()[0] / count as f64;
    let mut left: Vec<Bounds<2>> = Vec::new();
    for row in 0..count {
        for column in 0..count {
            let corner = [column, row].map(|n| n as f64 * edge);
            let min = point::add(domain.bounds.min, corner);
            left.push(Bounds::new(min, point::add(min, [edge; 2])));
        }
    }
    while let Some(cell) = left.pop() {
        let size = cell.size()[0];
        if field.at(cell.center()).value < size / 2.0_f64.sqrt() {
            left.extend(cell.halves(0).into_iter().flat_map(|half| half.halves(1)));
            continue;
        }
        set.positions.push(cell.center());
        set.spacing.push(size);
        set.volume.push(size * size);
    }
    set
}

/// The table of both around the circle of the rows, whose surface they do not know.
pub(super) fn table() -> Result<String, String> {
    let domain = Domain::new([-4.0; 2], [4.0; 2]).with_periodic([true; 2]);
    let circle = Ball::new([0.0; 2], 1.0).map_err(|error| error.to_string())?;
    let field: Resolution<2> = Refinement::new(0.2, 1.08)
        .around(Arc::new(circle), 0.02)
        .into();
    let mut text = "\
| circle, growth 1.08, periodic | particles | L∞ | rms | h∣∇Γ∣ max, rms | closest pair |
|---|---|---|---|---|---|
"
    .to_owned();
    let mut set = nested(domain, &field, 0.16);
    let _ = write!(text, "{}", set.line("lattices within lattices, 2 : 1"));
    let mut done = 0;
    for steps in [60, 250] {
        while done < steps {
            set.shift(&field);
            done += 1;
        }
        set.follow(&field);
        let _ = write!(
            text,
            "{}",
            set.line(&format!("{steps} steps of shifting from there"))
        );
    }
    Ok(text)
}
