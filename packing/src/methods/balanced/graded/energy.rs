//! The energies that particles of graded spacing go down: one that orders them, sizes frozen, and one that levels their
//! density while sizes follow the field.

use std::time::Instant;

use fearless_simd::Level;
use rayon::prelude::*;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::{CellList, point};
use sphpack_pairs::{
    DensityBySum, Gathered, PackingSums, Repulsion, Shape, SizedRepulsion, SizedSum,
};

use super::anchor::{Anchor, STRAIGHT};
use super::columns::{Columns, reach_over_h};
use super::mirror::Mirror;
use crate::forces::{blocked_sum, largest};
use crate::minimise::{Movable, Potential};
use crate::particles::Kind;
use crate::problem::Problem;
use crate::resolution::Resolution;
use crate::sizes::Sizes;

/// In no region: surface particles, whose volume stays.
pub(super) const NONE: u32 = u32::MAX;

/// Which energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Aim {
    /// ½ Σ V_i V_j W(r_ij, h̄) with h̄² = (h_i² + h_j²)/2, and the repulsion in proportion to volumes: spreads particles in order.
    /// Sizes stay with the particles. By either h, or by (h_i + h_j)/2 where spacings grow fast, particles of different
    /// sizes mix.
    Order,
    /// ½ κ Σ (Γ_i − Γ₀)² towards the [`target`] Γ₀ and the repulsion, the same for all sizes: levels the density. Every size is that of the field
    /// where the particle is, every region keeps its volume.
    Level {
        /// κ.
        stiffness: f64,
    },
}

/// The energy over the places of the mobile particles, with its exact gradient: what a move does to a particle's own h and
/// volume, and to the common factor of its region's volumes, is in it.
#[derive(Debug)]
pub(super) struct GradedEnergy<'a, const D: usize> {
    pub(super) movable: Movable<'a, D>,
    resolution: Resolution<D>,
    kernel: KernelKind,
    pub(super) h_over_spacing: f64,
    /// The finest spacing, scene units.
    finest: f64,
    /// [`target`].
    target: f64,
    /// The region of every particle, and the volume of the free particles of each.
    regions: Regions,
    pub(super) mirror: Mirror<D>,
    pub(super) list: CellList<D>,
    /// Supports when the list was built.
    pub(super) built_with: Vec<f64>,
    gathered: Gathered,
    simd: Level,
    aim: Aim,
    repulsion: Repulsion,
    /// Of particles and of their images behind.
    set: Columns<D>,
    /// What the field said of every particle, and where, when it was last asked.
    pub(super) anchors: Vec<Anchor<D>>,
    /// ∇s where sizes follow.
    size_gradient: Vec<[f64; D]>,
    /// Of every target slot: by the energy's own h, and, of pressures, by the sources'.
    sums: Vec<SizedSum>,
    scattered: Vec<DensityBySum>,
    pub(super) is_stale: bool,
    pub(super) is_changed: bool,
    value: f64,
    pub(super) force: Vec<[f64; D]>,
    pub(super) evaluations: usize,
    pub(super) neighbor_seconds: f64,
    pub(super) force_seconds: f64,
}

/// Who shares which volume.
#[derive(Debug, Clone)]
pub(super) struct Regions {
    /// Of every particle; [`NONE`] for those whose volume stays.
    pub(super) of: Vec<u32>,
    /// Of each region's free particles together, scene units to the power D.
    pub(super) volume: Vec<f64>,
}

/// Skins of the neighbour list, in parts of every support: while particles are ordered, when some move by 0.2 of their spacing
/// in every step, and while they are levelled, when a list lasts for tens of evaluations. A list takes as long as four sums; a
/// wider skin makes all sums longer, in space by its third power.
fn skins<const D: usize>() -> [f64; 2] {
    if D == 2 { [0.3, 0.03] } else { [0.15, 0.04] }
}

/// A lattice's Γ₀ this near to 1 is 1: particles of many sizes are on none.
const BIAS: f64 = 5e-4;

/// What Γ is levelled towards: 1, or what a kernel too short for that makes of an even filling.
pub(super) fn target<const D: usize>(problem: &Problem<D>) -> f64 {
    let lattice = (problem.chosen_lattice()).gamma(problem.kernel, problem.h_over_spacing);
    if (lattice - 1.0).abs() < BIAS {
        1.0
    } else {
        lattice
    }
}

/// The largest pressure that levelling makes: where density cannot be level, more would only tear particles apart.
const MOST_PRESSURE: f64 = 1.0;

impl<'a, const D: usize> GradedEnergy<'a, D> {
    /// The energy around where the particles are, at first for [`Aim::Order`].
    pub(super) fn new(
        problem: &Problem<D>,
        movable: Movable<'a, D>,
        regions: Regions,
        repulsion: f64,
    ) -> Self {
        let finest = problem.spacing();
        let support = problem.support();
        let sight = support / finest;
        let mut energy = Self {
            resolution: problem.resolution.clone(),
            kernel: problem.kernel,
            h_over_spacing: problem.h_over_spacing,
            finest,
            target: target(problem),
            regions,
            mirror: Mirror::new(problem.domain, problem.resolution.clone(), sight),
            list: CellList::new(&problem.domain, support),
            built_with: Vec::new(),
            gathered: Gathered::default(),
            simd: Level::new(),
            aim: Aim::Order,
            repulsion: Repulsion::none(),
            set: Columns::default(),
            anchors: Vec::new(),
            size_gradient: vec![[0.0; D]; movable.particles.len()],
            sums: Vec::new(),
            scattered: Vec::new(),
            is_stale: true,
            is_changed: true,
            value: 0.0,
            force: vec![[0.0; D]; movable.mobile.len()],
            movable,
            evaluations: 0,
            neighbor_seconds: 0.0,
            force_seconds: 0.0,
        };
        energy.pursue(Aim::Order, repulsion);
        energy
    }

    /// Becomes another energy, with so strong a repulsion.
    pub(super) fn pursue(&mut self, aim: Aim, repulsion: f64) {
        self.aim = aim;
        self.repulsion =
            Repulsion::new(self.finest, repulsion).at_size(self.h_over_spacing * self.finest);
        let shape = Shape::Smoothing(self.kernel);
        let h = self.h_over_spacing * self.finest;
        let support = reach_over_h(self.kernel, self.h_over_spacing) * h;
        let shells = shape.shells::<D>(h, self.repulsion.reach());
        self.list.set_shells(shells.map(|radius| radius / support));
        let sizes = &self.movable.particles.sizes;
        // Its blocks as compact as where particles are now.
        self.list.invalidate();
        self.list.set_skin(match aim {
            Aim::Order => skins::<D>()[0],
            Aim::Level { .. } => skins::<D>()[1],
        });
        let power = match aim {
            // A step down the energy is as long as s²/V asks, down that of levelling as s².
            Aim::Order => 1.0 - 0.5 * D as f64,
            Aim::Level { .. } => 1.0,
        };
        let scale = (0..self.movable.particles.len())
            .map(|i| (sizes.spacing(i) / self.finest).powf(power))
            .collect();
        self.movable.rescale(scale);
        self.is_stale = true;
        self.is_changed = true;
    }

    /// Holds boundary particles where they are from now on.
    pub(super) fn hold_surface(&mut self) {
        self.movable.hold_surface();
        self.force.resize(self.movable.mobile.len(), [0.0; D]);
        self.is_stale = true;
        self.is_changed = true;
    }

    /// Whether it has become another energy since this was asked before.
    pub(super) fn take_changed(&mut self) -> bool {
        std::mem::take(&mut self.is_changed)
    }

    /// The largest force on a particle times its h over its weight in the energy: dimensionless; over κ while density is
    /// levelled.
    pub(super) fn residual(&mut self) -> f64 {
        self.evaluate();
        let unit = self.finest.powi(D as i32);
        let mobile = &self.movable.mobile;
        largest(mobile.len(), |place| {
            let i = mobile[place] as usize;
            let weight = match self.aim {
                Aim::Order => self.set.volume[i] / unit,
                Aim::Level { stiffness } => stiffness,
            };
            let force = point::norm(self.force[place]) / self.movable.scale(i);
            self.set.smoothing_length[i] * force / weight
        })
    }

    /// The largest |Γ − Γ₀|, by whichever h the energy takes, its root mean square, and the largest h|∇Γ| of free particles.
    pub(super) fn figures(&mut self) -> [f64; 3] {
        self.evaluate();
        let particles = &*self.movable.particles;
        let targets = self.list.target_particles();
        let of = |slot: usize| &self.sums[slot].0;
        let level = largest(targets.len(), |slot| (of(slot).value - self.target).abs());
        let calm = largest(targets.len(), |slot| {
            let i = targets[slot] as usize;
            if particles.kind[i] == Kind::Free {
                self.set.smoothing_length[i] * point::norm(of(slot).gradient)
            } else {
                0.0
            }
        });
        let count = self.sums.len().max(1) as f64;
        let squares = blocked_sum(&self.sums, |sum| (sum.0.value - self.target).powi(2));
        [level, (squares / count).sqrt(), calm]
    }

    /// Adds what is beyond open sides to the particles, frozen, as far as a kernel sees whose support is so many spacings.
    pub(super) fn freeze(mut self, sight: f64) {
        self.follow(0.0);
        let Self {
            movable, mirror, ..
        } = self;
        mirror.freeze(movable.particles, sight);
    }

    /// Sizes and volumes where the particles are, the field taken as straight within so many spacings of where it was asked.
    fn follow(&mut self, within: f64) {
        let particles = &mut *self.movable.particles;
        let (resolution, position) = (&self.resolution, &particles.position);
        let regions = &self.regions.of;
        self.anchors.resize(particles.len(), Anchor::NONE);
        let followed: Vec<Option<(f64, [f64; D])>> = (self.anchors.par_iter_mut().enumerate())
            .with_min_len(64)
            .map(|(i, anchor)| {
                (regions[i] != NONE).then(|| anchor.at(resolution, position[i], within))
            })
            .collect();
        let mut spacing: Vec<f64> = (0..particles.len())
            .map(|i| particles.sizes.spacing(i))
            .collect();
        let mut sum = vec![0.0; self.regions.volume.len()];
        for (i, followed) in followed.iter().enumerate() {
            if let Some((value, gradient)) = *followed {
                spacing[i] = value;
                self.size_gradient[i] = gradient;
                sum[self.regions.of[i] as usize] += value.powi(D as i32);
            }
        }
        for (i, followed) in followed.iter().enumerate() {
            if followed.is_some() {
                let region = self.regions.of[i] as usize;
                let share = self.regions.volume[region] / sum[region];
                particles.volume[i] = share * spacing[i].powi(D as i32);
            }
        }
        particles.sizes = Sizes::each(&spacing, self.h_over_spacing);
    }

    pub(super) fn evaluate(&mut self) {
        if !self.is_stale {
            return;
        }
        self.is_stale = false;
        self.evaluations += 1;
        let start = Instant::now();
        if matches!(self.aim, Aim::Level { .. }) {
            self.follow(STRAIGHT);
        }
        let followed = start.elapsed().as_secs_f64();
        if self.mirror.follow(self.movable.particles) {
            self.list.invalidate();
        }
        self.set
            .fill(self.movable.particles, &self.mirror, self.kernel);
        self.update_list();
        self.neighbor_seconds += start.elapsed().as_secs_f64() - followed;
        self.force_seconds += followed;
        let summing = Instant::now();
        self.sum();
        self.movable.constrain(&mut self.force);
        self.force_seconds += summing.elapsed().as_secs_f64();
    }

    fn update_list(&mut self) {
        let count = self.movable.particles.len();
        let set = &self.set;
        if (self.list).update_each(&set.place, &set.support, |i| i < count) {
            self.built_with.clone_from(&set.support);
        }
    }

    fn sum(&mut self) {
        let set = &mut self.set;
        let h = self.h_over_spacing * self.finest;
        self.gathered
            .gather_each(&self.list, &set.place, &set.volume, &set.smoothing_length);
        let targets = self.list.targets();
        let (kernel, list, simd) = (self.kernel, &self.list, self.simd);
        let repulsion = SizedRepulsion {
            repulsion: self.repulsion,
            by_volume: self.aim == Aim::Order,
        };
        let unit = self.finest.powi(D as i32);
        self.sums.resize(targets, SizedSum::default());
        let of = self.list.target_particles();
        let movable = &self.movable;
        match self.aim {
            Aim::Order => {
                sums(kernel, h, list, &self.gathered, simd).average::<D>(repulsion, &mut self.sums);
                let slots: Vec<usize> = (0..targets).collect();
                self.value = blocked_sum(&slots, |&slot| {
                    let (density, repulsion) = &self.sums[slot];
                    let weight = set.volume[of[slot] as usize] / unit;
                    0.5 * weight * density.value + repulsion.energy
                });
                let found = &self.sums;
                (self.force.par_iter_mut().zip(&movable.mobile))
                    .with_min_len(4096)
                    .for_each(|(force, &i)| {
                        let i = i as usize;
                        let Some(slot) = list.slot_of(i) else { return };
                        let (density, repulsion) = &found[slot];
                        let weight = set.volume[i] / unit;
                        let own = std::array::from_fn(|k| {
                            repulsion.force[k] - weight * density.gradient[k]
                        });
                        *force = movable.tangential(i, own);
                    });
            }
            Aim::Level { stiffness } => {
                sums(kernel, h, list, &self.gathered, simd).gather::<D>(repulsion, &mut self.sums);
                let most = MOST_PRESSURE / stiffness;
                let excess = |slot: usize| {
                    let off = self.sums[slot].0.value - self.target;
                    (off, off.clamp(-most, most))
                };
                for slot in 0..targets {
                    set.pressure[of[slot] as usize] = stiffness * excess(slot).1;
                }
                let count = movable.particles.len();
                for (image, particle) in self.mirror.particles().enumerate() {
                    set.pressure[count + image] = set.pressure[particle];
                }
                self.gathered.weigh(list, &set.pressure);
                self.scattered.resize(targets, DensityBySum::default());
                sums(kernel, h, list, &self.gathered, simd).scatter::<D>(&mut self.scattered);
                let slots: Vec<usize> = (0..targets).collect();
                self.value = blocked_sum(&slots, |&slot| {
                    let (off, held) = excess(slot);
                    0.5 * stiffness * held * (2.0 * off - held) + self.sums[slot].1.energy
                });
                // The pressure that a region's common factor is under.
                let mut mean = vec![0.0; self.regions.volume.len()];
                for i in 0..count {
                    if self.regions.of[i] != NONE
                        && let Some(slot) = list.slot_of(i)
                    {
                        mean[self.regions.of[i] as usize] +=
                            set.volume[i] * self.scattered[slot].value;
                    }
                }
                for (mean, volume) in mean.iter_mut().zip(&self.regions.volume) {
                    *mean /= volume;
                }
                let (regions, size_gradient) = (&self.regions, &self.size_gradient);
                let (found, scattered) = (&self.sums, &self.scattered);
                let finest = self.finest;
                (self.force.par_iter_mut().zip(&movable.mobile))
                    .with_min_len(4096)
                    .for_each(|(force, &i)| {
                        let i = i as usize;
                        let Some(slot) = list.slot_of(i) else { return };
                        let (density, repulsion) = &found[slot];
                        let DensityBySum {
                            value, gradient, ..
                        } = &scattered[slot];
                        let (pressure, volume) = (set.pressure[i], set.volume[i]);
                        let own = std::array::from_fn(|k| {
                            repulsion.force[k]
                                - pressure * density.gradient[k]
                                - volume * gradient[k]
                        });
                        let region = regions.of[i];
                        let own = if region == NONE {
                            own
                        } else {
                            let dimension = D as f64;
                            let spacing = set.spacing[i];
                            let more = value - mean[region as usize];
                            let by_size = pressure * (dimension * density.value + density.stretch)
                                - dimension * volume * more
                                - repulsion.by_size * spacing / finest;
                            point::add_scaled(own, by_size / spacing, size_gradient[i])
                        };
                        *force = movable.tangential(i, own);
                    });
            }
        }
    }
}

fn sums<'a, const D: usize>(
    kernel: KernelKind,
    length: f64,
    list: &'a CellList<D>,
    gathered: &'a Gathered,
    level: Level,
) -> PackingSums<'a> {
    PackingSums {
        shape: Shape::Smoothing(kernel),
        length,
        blocks: list.blocks(),
        gathered,
        level,
    }
}

impl<const D: usize> Potential<D> for GradedEnergy<'_, D> {
    fn len(&self) -> usize {
        self.movable.mobile.len()
    }

    fn spacing(&self) -> f64 {
        self.finest
    }

    fn smoothing_length(&self) -> f64 {
        self.h_over_spacing * self.finest
    }

    fn value(&mut self) -> f64 {
        self.evaluate();
        self.value
    }

    fn force(&mut self) -> &[[f64; D]] {
        self.evaluate();
        &self.force
    }

    fn places(&self, out: &mut Vec<[f64; D]>) {
        self.movable.places(out);
    }

    fn move_to(&mut self, from: &[[f64; D]], step: f64, direction: &[[f64; D]]) {
        self.movable.move_to(from, step, direction);
        self.is_stale = true;
    }

    fn make_tangential(&self, v: &mut [[f64; D]]) {
        self.movable.make_tangential(v);
    }

    fn longest(&self, direction: &[[f64; D]]) -> f64 {
        let sizes = &self.movable.particles.sizes;
        largest(direction.len(), |place| {
            let i = self.movable.mobile[place] as usize;
            let spacing = sizes.spacing(i) / self.finest;
            point::norm(direction[place]) * self.movable.scale(i) / spacing
        })
    }
}
