//! How evenly a kernel's own particles come to rest, with no body in the way.

use sphpack_kernels::KernelKind;
use sphpack_neighbors::random::Congruential;
use sphpack_neighbors::{Domain, point};
use sphpack_packing::forces::Forces;
use sphpack_packing::{Kind, Lattice, Particles, Sizes};
use sphpack_pairs::Repulsion;

use crate::bench::Bench;
use crate::shown_table::ShownTable;

const HEAD: &str = "\
| kernel | h/∆s | lattice, shaken by | Γ/Γ₀ − 1 at rest | rms | h KGS max |
|---|---|---|---|---|---|
";

const ROWS: [(KernelKind, f64, Lattice, f64); 8] = [
    (KernelKind::WendlandC2, 1.05, Lattice::Hexagonal, 0.01),
    (KernelKind::WendlandC2, 1.05, Lattice::Square, 0.01),
    (KernelKind::WendlandC2, 1.05, Lattice::Square, 0.5),
    (KernelKind::WendlandC2, 1.3, Lattice::Hexagonal, 0.01),
    (KernelKind::WendlandC2, 1.3, Lattice::Square, 0.01),
    (KernelKind::WendlandC2, 1.3, Lattice::Square, 0.5),
    (KernelKind::Quintic, 1.2, Lattice::Square, 0.01),
    (KernelKind::Quintic, 1.2, Lattice::Square, 0.5),
];

/// Edge of the periodic box in ∆s, steps, and ∆t² in h².
const EDGE: f64 = 40.0;
const STEPS: usize = 8000;
const STEP: f64 = 0.4;

/// Shaken lattices in a periodic box under the background pressure alone.
pub(crate) fn at_rest() -> Result<String, String> {
    let bench = Bench::open(&[file!()])?;
    let mut table = ShownTable::new(HEAD);
    for (kernel, h, lattice, shake) in ROWS {
        let of = format!("{kernel} {h} {lattice} {shake}");
        let [low, high, rms, residual] =
            bench.once(&of, || Ok(relaxed(kernel, h, lattice, shake)))?;
        table.push(&format!(
            "| {kernel} | {h} | {lattice}, {shake} ∆s | {:+.2} … {:+.2} % | {:.2} % | {residual:.0e} |\n",
            100.0 * low,
            100.0 * high,
            100.0 * rms,
        ));
    }
    Ok(table.into_text())
}

/// Least, largest and root mean square Γ/Γ₀ − 1, and the largest residual, after [`STEPS`] steps.
fn relaxed(kernel: KernelKind, h: f64, lattice: Lattice, shake: f64) -> [f64; 4] {
    let domain = Domain::new([0.0; 2], [EDGE; 2]).with_periodic([true, true]);
    let filling = lattice.fill(domain.bounds, 1.0);
    let gamma = Lattice::auto(2, kernel, h).gamma(kernel, h);
    let mut random = Congruential::new(12_345);
    let mut shaken = |x: f64| x + shake * (2.0 * random.unit() - 1.0);
    let mut particles = Particles::new(Sizes::uniform(1.0, h));
    for site in filling.sites() {
        let place = domain.wrap(site.map(&mut shaken));
        particles.push(place, Kind::Free, filling.volume_per_site(), None);
    }
    let mut forces = Forces::new(&domain, kernel, h, 0.3, Repulsion::none());
    let count = particles.len();
    for _ in 0..STEPS {
        forces.evaluate(&particles);
        for i in 0..count {
            let moved = point::add_scaled(particles.position[i], -STEP * h * h, forces.gradient(i));
            particles.position[i] = domain.wrap(moved);
        }
    }
    forces.evaluate(&particles);
    let off: Vec<f64> = (0..count).map(|i| forces.gamma(i) / gamma - 1.0).collect();
    let residual = (0..count)
        .map(|i| h * point::norm(forces.gradient(i)))
        .fold(0.0, f64::max);
    [
        off.iter().copied().fold(f64::INFINITY, f64::min),
        off.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        (off.iter().map(|x| x * x).sum::<f64>() / count as f64).sqrt(),
        residual,
    ]
}
