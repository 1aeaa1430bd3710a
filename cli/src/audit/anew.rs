//! Γ and the residual of some particles, summed anew by code that shares nothing with what computed them but the kernel.

use std::collections::{BTreeMap, HashMap};

use sphpack_kernels::{Kernel, WithKernel};
use sphpack_neighbors::{Domain, point};
use sphpack_packing::Kind;

use crate::solution::Solution;

/// Particles that are summed anew, about. A pair list that drops neighbours drops those of many.
const SOME: usize = 500;

/// Two sums of the same terms in another order agree to within this; far from the origin, where places have fewer digits,
/// to within a thousandth of it for each ∆s.
const SAME: f64 = 1e-9;

/// The first particle whose sums over what is near are not those that it has: its place in the list, and what differs.
/// O(n) for n particles and every octave of their sizes, and the neighbours of some [`SOME`].
pub(super) fn differs<const D: usize>(solution: &Solution<D>) -> Option<(usize, String)> {
    let fields = &solution.fields;
    let particles = &solution.packed.particles;
    let judged: Vec<usize> = (0..particles.len())
        .filter(|&i| particles.kind[i] != Kind::Frozen)
        .collect();
    let every = judged.len().div_ceil(SOME).max(1);
    let mut octaves: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for i in judged.into_iter().step_by(every) {
        let octave = fields.sizes.over_finest(i).log2().ceil() as u32;
        octaves.entry(octave).or_default().push(i);
    }
    octaves.into_values().find_map(|some| {
        let largest = some
            .iter()
            .fold(0.0, |h: f64, &i| h.max(fields.sizes.smoothing_length(i)));
        let reach = fields.kernel.support_over_h() * largest;
        let bins = Bins::new(&solution.packed.domain, reach, &particles.position);
        some.into_iter().find_map(|i| {
            let one = One {
                solution,
                bins: &bins,
                i,
            };
            fields.kernel.with(fields.sizes.smoothing_length(i), one)
        })
    })
}

/// The sums of one particle.
struct One<'a, const D: usize> {
    solution: &'a Solution<D>,
    bins: &'a Bins<'a, D>,
    i: usize,
}

impl<const D: usize> WithKernel<D> for One<'_, D> {
    type Output = Option<(usize, String)>;

    fn call<K: Kernel<D>>(self, kernel: K) -> Self::Output {
        let Self { solution, bins, i } = self;
        let (packed, fields) = (&solution.packed, &solution.fields);
        let particles = &packed.particles;
        let place = particles.position[i];
        let (mut gamma, mut gradient) = (0.0, [0.0; D]);
        for j in bins.near(place) {
            let apart = bins.apart(place, particles.position[j]);
            let r_squared = point::dot(apart, apart);
            if r_squared < kernel.support() * kernel.support() {
                let (value, slope_over_r) = kernel.value_and_slope_over_r(r_squared);
                gamma += particles.volume[j] * value;
                gradient = point::add_scaled(gradient, particles.volume[j] * slope_over_r, apart);
            }
        }
        let far = place.iter().fold(0.0_f64, |far, x| far.max(x.abs()));
        let slack = SAME * (1.0 + 1e-3 * far / packed.spacing);
        let h = kernel.smoothing_length();
        let [own, anew] = [fields.gradient[i], gradient].map(|g| h * point::norm(g));
        let words = |what: &str, own: f64, anew: f64| {
            let id = particles.id[i];
            format!(
                "{what} of particle {id} is {own:.9}, but the sum over its neighbours gives {anew:.9}"
            )
        };
        if (fields.gamma[i] - gamma).abs() > slack * gamma {
            Some((i, words("gamma", fields.gamma[i], gamma)))
        } else if (own - anew).abs() > slack * (1.0 + anew) {
            Some((i, words("residual", own, anew)))
        } else {
            None
        }
    }
}

/// Particles by cubes at least as large as the kernel reaches.
struct Bins<'a, const D: usize> {
    domain: &'a Domain<D>,
    /// Edges of a cube, and on periodic axes how many of them there are.
    edge: [f64; D],
    count: [i64; D],
    cubes: HashMap<[i64; D], Vec<u32>>,
}

impl<'a, const D: usize> Bins<'a, D> {
    fn new(domain: &'a Domain<D>, reach: f64, positions: &[[f64; D]]) -> Self {
        let size = domain.bounds.size();
        let count: [i64; D] = std::array::from_fn(|k| (size[k] / reach).floor().max(1.0) as i64);
        let edge = std::array::from_fn(|k| {
            if domain.periodic[k] {
                size[k] / count[k] as f64
            } else {
                reach
            }
        });
        let mut bins = Self {
            domain,
            edge,
            count,
            cubes: HashMap::new(),
        };
        for (j, &p) in positions.iter().enumerate() {
            let cube = bins.cube(p);
            bins.cubes.entry(cube).or_default().push(j as u32);
        }
        bins
    }

    fn cube(&self, p: [f64; D]) -> [i64; D] {
        std::array::from_fn(|k| {
            let along = ((p[k] - self.domain.bounds.min[k]) / self.edge[k]).floor() as i64;
            self.wrapped(k, along)
        })
    }

    fn wrapped(&self, k: usize, along: i64) -> i64 {
        if self.domain.periodic[k] {
            along.rem_euclid(self.count[k])
        } else {
            along
        }
    }

    /// All that may be within reach, each once.
    fn near(&self, p: [f64; D]) -> impl Iterator<Item = usize> {
        let middle = self.cube(p);
        let mut cubes: Vec<[i64; D]> = (0..3_i64.pow(D as u32))
            .map(|n| {
                std::array::from_fn(|k| {
                    self.wrapped(k, middle[k] + n / 3_i64.pow(k as u32) % 3 - 1)
                })
            })
            .collect();
        cubes.sort_unstable();
        cubes.dedup();
        cubes
            .into_iter()
            .filter_map(|cube| self.cubes.get(&cube))
            .flatten()
            .map(|&j| j as usize)
    }

    /// From the nearest image of `q` to `p`; the box is longer than twice the reach where it is periodic.
    fn apart(&self, p: [f64; D], q: [f64; D]) -> [f64; D] {
        let size = self.domain.bounds.size();
        std::array::from_fn(|k| {
            let d = p[k] - q[k];
            if self.domain.periodic[k] {
                d - size[k] * (d / size[k]).round()
            } else {
                d
            }
        })
    }
}
