//! Dummy walls: what their particles take from the fluid beside them (Adami, Hu & Adams 2012, section 2.5).

use fearless_simd::{Simd, f64x8, prelude::*};
use sphpack_neighbors::{Domain, GROUP, LANES, point};
use sphpack_pairs::{Group, Scale, Targets, Term};

use crate::medium::Medium;
use crate::neighborhood::{Neighborhood, compiled};
use crate::parallel::each;
use crate::particles::Particles;

/// The walls' particles as targets, and what they carry.
#[derive(Debug)]
pub(crate) struct Walls<const D: usize> {
    near: Neighborhood<D>,
    sums: Vec<WallSum>,
    /// Of every wall particle the velocity that viscosity sees.
    pub(crate) dummy_velocity: Vec<[f64; D]>,
    pressure: Vec<f64>,
}

impl<const D: usize> Walls<D> {
    pub(crate) fn new(domain: &Domain<D>, smoothing_length: f64) -> Self {
        Self {
            near: Neighborhood::new(domain, smoothing_length),
            sums: Vec::new(),
            dummy_velocity: Vec::new(),
            pressure: Vec::new(),
        }
    }

    pub(crate) fn invalidate(&mut self) {
        self.near.invalidate();
    }

    /// With S = Σ_f W_wf over the fluid f and û = Σ_f u_f W/S:
    ///
    /// - p_w = [Σ_f p_f W + (g − a_w)·Σ_f ρ_f r_wf W]/S, no less than `least`,
    /// - the velocity that viscosity sees is 2u_w − û (no slip), or û − 2((û − u_w)·n) n (slip),
    ///
    /// and where no fluid is near p_w = 0 and u_w itself.
    pub(crate) fn extrapolate(
        &mut self,
        particles: &mut Particles<D>,
        medium: &Medium<D>,
        least: f64,
    ) {
        let fluid = particles.fluid;
        let walls = particles.len() - fluid;
        if walls == 0 {
            return;
        }
        let of = &*particles;
        (self.near).update(&of.position, &of.mass, |i| i >= fluid);
        self.near.fill(D + 2, |i, row| {
            row[..D].copy_from_slice(&of.velocity[i]);
            row[D..].copy_from_slice(&[of.pressure[i], of.density[i]]);
        });
        self.near.sum(&Beside { unit: 1.0 }, &mut self.sums);
        let sum = |w: usize| self.near.of(&self.sums, fluid + w);
        self.pressure.resize(walls, 0.0);
        each(&mut self.pressure, |w| {
            let sum = sum(w);
            if sum.shepard == 0.0 {
                return 0.0;
            }
            let inertia = point::sub(medium.force, of.wall_acceleration[w]);
            let weight = point::dot(inertia, point::of_slice(&sum.moment));
            ((sum.pressure + weight) / sum.shepard).max(least)
        });
        self.dummy_velocity.resize(walls, [0.0; D]);
        each(&mut self.dummy_velocity, |w| {
            let (sum, own, normal) = (sum(w), of.velocity[fluid + w], of.slip_normal[w]);
            if sum.shepard == 0.0 {
                return own;
            }
            let theirs: [f64; D] = point::of_slice(&sum.velocity);
            let theirs = point::scale(theirs, 1.0 / sum.shepard);
            if normal == [0.0; D] {
                point::sub(point::scale(own, 2.0), theirs)
            } else {
                let into = point::dot(point::sub(theirs, own), normal);
                point::add_scaled(theirs, -2.0 * into, normal)
            }
        });
        particles.pressure[fluid..].copy_from_slice(&self.pressure);
    }

    /// σ of a wall particle, by its number among all.
    pub(crate) fn number_density(&self, particle: usize) -> f64 {
        self.near.of(&self.sums, particle).number_density
    }
}

/// What a wall particle finds beside it. Fields 0 … D − 1 are the velocity, then pressure and density; weights are not used.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beside {
    unit: f64,
}

/// Sums over W; all but the first over the fluid alone.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct WallSum {
    /// Σ W over all, itself included.
    number_density: f64,
    /// Σ W.
    shepard: f64,
    /// Σ p W.
    pressure: f64,
    /// Σ ρ (r_w − r_f) W.
    moment: [f64; 3],
    /// Σ u W.
    velocity: [f64; 3],
}

/// The same on the way.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WallLanes<S: Simd> {
    number_density: f64x8<S>,
    shepard: f64x8<S>,
    pressure: f64x8<S>,
    moment: [f64x8<S>; 3],
    velocity: [f64x8<S>; 3],
}

impl Term for Beside {
    type Sum = WallSum;
    type Lanes<S: Simd> = WallLanes<S>;

    fn in_unit(&self, unit: f64) -> Self {
        Self { unit }
    }

    #[inline(always)]
    fn start<S: Simd>(&self, targets: &Targets<'_, S>) -> WallLanes<S> {
        let zero = f64x8::splat(targets.simd, 0.0);
        WallLanes {
            number_density: zero,
            shepard: zero,
            pressure: zero,
            moment: [zero; 3],
            velocity: [zero; 3],
        }
    }

    #[inline(always)]
    fn add<S: Simd, const D: usize>(&self, sums: &mut WallLanes<S>, group: &Group<'_, S, D>) {
        let value = group.own.value;
        for j in 0..GROUP {
            sums.number_density += value.0[j];
        }
        // Targets are the walls.
        if group.are_targets {
            return;
        }
        let pressure = group.field(D);
        let density = group.field(D + 1);
        for j in 0..GROUP {
            sums.shepard += value.0[j];
            sums.pressure = value.0[j].mul_add(pressure[j], sums.pressure);
            let heavy = value.0[j] * density[j];
            for k in 0..D {
                sums.moment[k] = heavy.mul_add(group.apart[j][k], sums.moment[k]);
            }
        }
        for k in 0..D {
            let velocity = group.field(k);
            for j in 0..GROUP {
                sums.velocity[k] = value.0[j].mul_add(velocity[j], sums.velocity[k]);
            }
        }
    }

    #[inline(always)]
    fn finish<S: Simd>(&self, sums: WallLanes<S>, scale: &Scale<S>) -> [WallSum; LANES] {
        let length = f64x8::splat(scale.value.simd, 1.0 / self.unit);
        let number_density: [f64; LANES] = (scale.value * sums.number_density).into();
        let shepard: [f64; LANES] = (scale.value * sums.shepard).into();
        let pressure: [f64; LANES] = (scale.value * sums.pressure).into();
        let mut all = [WallSum::default(); LANES];
        for k in 0..3 {
            let moment: [f64; LANES] = (scale.value * length * sums.moment[k]).into();
            let velocity: [f64; LANES] = (scale.value * sums.velocity[k]).into();
            for lane in 0..LANES {
                all[lane].moment[k] = moment[lane];
                all[lane].velocity[k] = velocity[lane];
            }
        }
        for lane in 0..LANES {
            all[lane].number_density = number_density[lane];
            all[lane].shepard = shepard[lane];
            all[lane].pressure = pressure[lane];
        }
        all
    }
}

compiled!(Beside);
