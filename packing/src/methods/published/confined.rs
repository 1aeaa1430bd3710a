//! Particles within a surface that bounds them, relaxed step by step (Zhao et al. 2025, §2.1).

use std::io::{self, Write};
use std::time::Instant;

use rayon::prelude::*;
use sphpack_geometry::Closest;
use sphpack_neighbors::point;

use super::put_back::put_back;
use super::watch::Watch;
use crate::confinement::Confinement;
use crate::forces::{Forces, blocked_sum, largest};
use crate::particles::{Kind, Particles};
use crate::state::{Damaged, State, load_as_many};

/// The surface that bounds: its nearest place, and how far a place is beyond it (negative within).
pub(crate) type Bound<'a, const D: usize> = Box<dyn Fn([f64; D], u16) -> Closest<D> + Sync + 'a>;

/// Particles that see each other, the frozen ones among them, and what confines them.
pub(crate) struct Confined<'a, const D: usize> {
    /// With the part of their volume that others see.
    pub(crate) particles: Particles<D>,
    /// The whole volume of each.
    pub(crate) volume: Vec<f64>,
    pub(crate) forces: Forces<D>,
    confinement: Option<Confinement<D>>,
    bound: Bound<'a, D>,
    watch: Watch<D>,
    /// Whether the surface put a particle back in the last step.
    pub(crate) is_bounded: Vec<bool>,
    /// ∇Γ with what confinement adds.
    gradient: Vec<[f64; D]>,
    before: Vec<[f64; D]>,
    /// λ_max.
    stiffest: f64,
    /// Spent on confinement, and on putting particles back.
    pub(crate) seconds: [f64; 2],
}

/// Rounds of the power iteration for λ_max, which it approaches from below; the step keeps clear of the limit 2/λ_max.
const POWER_ROUNDS: usize = 12;
const STEP: f64 = 1.4;

/// How far the power iteration moves particles, in h.
const NUDGE: f64 = 1e-4;

/// How often a particle in a corner is put back from one side and the other.
const CORNER_ROUNDS: usize = 8;

impl<'a, const D: usize> Confined<'a, D> {
    /// Takes the particles as they are, but for those beyond the surface, which are put back onto it. Free particles may
    /// leave the surface again, boundary particles stay on it. Of these others see a part of the volume, `inner_share`:
    /// what is beyond the surface confinement has already.
    pub(crate) fn new(
        mut particles: Particles<D>,
        inner_share: f64,
        forces: Forces<D>,
        confinement: Option<Confinement<D>>,
        bound: Bound<'a, D>,
    ) -> Self {
        let count = particles.len();
        let volume = particles.volume.clone();
        for (seen, kind) in particles.volume.iter_mut().zip(&particles.kind) {
            if *kind == Kind::Boundary {
                *seen *= inner_share;
            }
        }
        let mut confined = Self {
            particles,
            volume,
            forces,
            confinement,
            bound,
            watch: Watch::new(count),
            is_bounded: vec![false; count],
            gradient: vec![[0.0; D]; count],
            before: Vec::new(),
            stiffest: 0.0,
            seconds: [0.0; 2],
        };
        confined.put_back();
        confined.stiffest = confined.stiffest_mode();
        confined
    }

    /// Eq. 8 without its factor: Σ_j V_j ∇W_ij over the particles, and over what lies beyond the surface.
    fn evaluate(&mut self) {
        let kind = &self.particles.kind;
        self.forces.evaluate(&self.particles);
        for i in 0..kind.len() {
            self.gradient[i] = self.forces.gradient(i);
        }
        if let Some(confinement) = &self.confinement {
            let begin = Instant::now();
            let is_asked = |i: usize| kind[i] != Kind::Frozen;
            confinement.add_gradients(&self.particles.position, is_asked, &mut self.gradient);
            self.seconds[0] += begin.elapsed().as_secs_f64();
        }
    }

    /// Eq. 7, at the particle surface itself: what is beyond it comes to its nearest place, and boundary particles do from
    /// either side.
    fn put_back(&mut self) {
        let begin = Instant::now();
        for (bounded, kind) in self.is_bounded.iter_mut().zip(&self.particles.kind) {
            *bounded = *kind == Kind::Boundary;
        }
        let back = self.watch.near(&self.particles, 0.0, &self.bound);
        let (bound, body) = (&self.bound, &self.particles.body);
        let close = 1e-9 * self.forces.smoothing_length();
        let onto = |i: usize, hit: Closest<D>| {
            put_back(hit.point, CORNER_ROUNDS, |place| {
                let hit = bound(place, body[i].unwrap_or(0));
                if hit.distance < close {
                    None
                } else {
                    Some(hit.point)
                }
            })
        };
        for (i, hit) in back {
            self.particles.position[i] = onto(i, hit);
            self.is_bounded[i] = true;
        }
        (self.particles.position.par_iter_mut().enumerate())
            .with_min_len(64)
            .filter(|(i, _)| self.particles.kind[*i] == Kind::Boundary)
            .for_each(|(i, place)| *place = onto(i, bound(*place, body[i].unwrap_or(0))));
        // Nor does anyone leave the box, beside whose sides a bound may put them.
        let domain = self.forces.list().domain();
        for (place, kind) in self.particles.position.iter_mut().zip(&self.particles.kind) {
            if *kind == Kind::Free {
                *place = domain.clamp(*place);
            }
        }
        self.seconds[1] += begin.elapsed().as_secs_f64();
    }

    /// One step from rest (eqs. 4 to 8); returns how far from rest it was: the largest h |∆r|/∆t², for particles that
    /// are not put back that is h |Σ V ∇W|.
    ///
    /// With p₀ = 1 and m = V, ½ a ∆t² = −∆t² Σ V ∇W. Eq. 5 alone would have the worst particle move h/32 in every step
    /// for ever; steps also keep below what the stiffest mode can take, ∆t² < 2/λ_max.
    pub(crate) fn step(&mut self) -> f64 {
        self.evaluate();
        let (h, kind) = (self.forces.smoothing_length(), &self.particles.kind);
        let steepest = largest(kind.len(), |i| {
            if kind[i] != Kind::Frozen {
                point::norm(self.gradient[i])
            } else {
                0.0
            }
        });
        // Eq. 5: |a| = 2 |Σ V ∇W|.
        let dt_squared = (h / 32.0 / steepest).min(STEP / self.stiffest);
        self.before.clone_from(&self.particles.position);
        for i in 0..self.particles.len() {
            if self.particles.kind[i] != Kind::Frozen {
                let x = &mut self.particles.position[i];
                *x = point::add_scaled(*x, -dt_squared, self.gradient[i]);
            }
        }
        self.put_back();
        let position = &self.particles.position;
        largest(position.len(), |i| {
            h * point::distance(position[i], self.before[i]) / dt_squared
        })
    }

    /// λ_max of −∂(Σ V ∇W)/∂r, by power iteration on differences of forces.
    fn stiffest_mode(&mut self) -> f64 {
        let (h, count) = (self.forces.smoothing_length(), self.particles.len());
        let rest = self.particles.position.clone();
        self.evaluate();
        let at_rest = self.gradient.clone();
        // Any direction that no symmetry shares.
        let mut mode: Vec<[f64; D]> = (0..count)
            .map(|i| std::array::from_fn(|k| (12.9898 * (i * D + k + 1) as f64).sin()))
            .collect();
        let mut stiffness = 0.0;
        for _ in 0..POWER_ROUNDS {
            for i in 0..count {
                if self.particles.kind[i] == Kind::Frozen {
                    mode[i] = [0.0; D];
                }
            }
            let top = largest(count, |i| point::norm(mode[i]));
            if top <= 0.0 {
                break;
            }
            let nudge = NUDGE * h / top;
            for i in 0..count {
                self.particles.position[i] = point::add_scaled(rest[i], nudge, mode[i]);
            }
            self.evaluate();
            let length = blocked_sum(&mode, |v| point::dot(*v, *v)).sqrt();
            for i in 0..count {
                let change = point::sub(self.gradient[i], at_rest[i]);
                mode[i] = if self.particles.kind[i] != Kind::Frozen {
                    point::scale(change, 1.0 / nudge)
                } else {
                    [0.0; D]
                };
            }
            stiffness = blocked_sum(&mode, |v| point::dot(*v, *v)).sqrt() / length;
        }
        self.particles.position = rest;
        if stiffness > 0.0 {
            stiffness
        } else {
            1.0 / (h * h)
        }
    }
}

impl<const D: usize> State for Confined<'_, D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.particles.save(out)?;
        self.forces.save(out)?;
        self.watch.save(out)?;
        self.is_bounded.save(out)?;
        self.seconds.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.particles.load(from)?;
        self.forces.load(from)?;
        self.watch.load(from)?;
        load_as_many(&mut self.is_bounded, from)?;
        self.seconds.load(from)
    }
}

/// Each for itself; how many there are is known.
impl<const D: usize> State for Vec<Confined<'_, D>> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.iter().try_for_each(|one| one.save(out))
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.iter_mut().try_for_each(|one| one.load(from))
    }
}

/// Moves the fluid's ghosts, the last of its particles, to where the solids' particles are now.
pub(crate) fn update_ghosts<const D: usize>(
    fluid: &mut Confined<'_, D>,
    solids: &[Confined<'_, D>],
) {
    let count: usize = solids.iter().map(|solid| solid.particles.len()).sum();
    let begin = fluid.particles.len() - count;
    let now = solids.iter().flat_map(|solid| &solid.particles.position);
    for (ghost, now) in fluid.particles.position[begin..].iter_mut().zip(now) {
        *ghost = *now;
    }
}
