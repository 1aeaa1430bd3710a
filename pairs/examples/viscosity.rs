//! A pair term of one's own: the Laplacian of a field, as viscosity takes it (Brookshaw 1985), for particles of any size.
//!
//! `cargo run -p sphpack-pairs --example viscosity` prints how near the sum comes to −k² sin kx on ever finer lattices.

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_kernels::{Kernel, Quintic};
use sphpack_neighbors::{CellList, Domain, GROUP, LANES};
use sphpack_pairs::{Fields, Group, Pairs, Scale, Several, Targets, Term};

/// 2 Σ_j V_j (f_i − f_j) W′(r_ij)/r_ij.
#[derive(Clone, Copy)]
struct Laplacian;

/// The targets' own f, and their sums.
#[derive(Clone, Copy)]
struct Lanes<S: Simd> {
    own: f64x8<S>,
    sum: f64x8<S>,
}

impl Term for Laplacian {
    type Sum = f64;
    type Lanes<S: Simd> = Lanes<S>;

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> Lanes<S> {
        Lanes {
            own: targets.field(0),
            sum: f64x8::splat(targets.simd, 0.0),
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, lanes: &mut Lanes<S>, group: &Group<'_, S, D>) {
        let theirs = group.field(0);
        // ∇W has a length of 1 over the unit more than r: `slope` · r · 1/r², in the loop's unit of length.
        let over_r = group.own.slope * group.inverse * Several(group.weight);
        for j in 0..GROUP {
            lanes.sum = over_r.0[j].mul_add(lanes.own - theirs[j], lanes.sum);
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, lanes: Lanes<S>, scale: &Scale<S>) -> [f64; LANES] {
        (scale.over_r * lanes.sum * f64x8::splat(scale.over_r.simd, 2.0)).into()
    }
}

fn main() {
    let wave = std::f64::consts::TAU;
    for count in [20_usize, 40, 80] {
        let spacing = 1.0 / count as f64;
        let positions: Vec<[f64; 2]> = (0..count * count)
            .map(|i| [i % count, i / count].map(|n| (n as f64 + 0.5) * spacing))
            .collect();
        let volumes = vec![spacing * spacing; positions.len()];
        let field: Vec<f64> = positions.iter().map(|x| (wave * x[0]).sin()).collect();
        let domain = Domain::new([0.0; 2], [1.0; 2]).with_periodic([true; 2]);
        let w = Quintic::<2>::new(1.3 * spacing);
        let mut list = CellList::new(&domain, w.support());
        list.update(&positions);
        let more: [&[f64]; 1] = [&field];
        let fields = Fields::new(w, &positions, &volumes).with_more(&more);
        let sums = Pairs::new(&list).sum(&Laplacian, &fields);
        let off = (sums.iter().zip(&field))
            .map(|(sum, f)| (sum + wave * wave * f).abs() / (wave * wave))
            .fold(0.0, f64::max);
        println!("{count:>3} particles per wave: {:.2} % off", 100.0 * off);
    }
}
