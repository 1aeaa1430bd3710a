//! To a place of rest: Newton's way to ∇Γ = 0 on all free particles.

use faer::{Mat, MatRef};
use sphpack_neighbors::point;

use super::linearised::{Factor, Links, solve_definite};
use super::objective::Objective;
use crate::minimise::vectors::{self, add_scaled, longest};
use crate::particles::Kind;

/// Newton's steps to ∇Γ = 0 of all free particles that move, along a path on which ∇Γ shrinks evenly everywhere
/// (Davidenko 1953): a step p with J p = −τ ∇Γ, so short that no particle moves farther than a few hundredths of ∆s, and then
/// steps back onto the path with the same factors. A descent of Σ|∇Γ|² gets stuck here: the way lies along a narrow,
/// bent valley.
///
/// Surface particles slide, so there are more unknowns than equations. Of all steps that lead down the path the one is
/// taken that leaves the density most even and pairs apart: a small dense least squares over what the surface
/// particles do.
#[derive(Debug)]
pub(super) struct Resting {
    /// No particle moves farther in a step, in ∆s.
    pub(super) farthest: f64,
    /// The number of each particle in the equations.
    row: Vec<Option<u32>>,
    /// The free particles, by that number.
    free: Vec<u32>,
    /// Surface particles that slide.
    sliding: Vec<u32>,
}

/// [`Resting::farthest`] at first.
const FARTHEST: f64 = 0.04;

/// Steps back onto the path, at most.
const CORRECTIONS: usize = 3;

/// What evenness, pairs apart and short steps count: over Γ², (r/d)² and (p/∆s)².
const SHORT: f64 = 1e-3;
const APART: f64 = 1.0;

/// No step brings a pair nearer than this, in ∆s. Where the lattice rests nowhere (h/∆s = 1.5) pairs fall into one another
/// otherwise.
const CLOSEST: f64 = 0.78;

/// How often the pairs that come too close are looked for.
const ROUNDS: usize = 3;

/// What came of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rested {
    /// The residual is smaller.
    Nearer,
    /// No shorter step makes it so, or there is no memory for one.
    Stuck,
}

impl Resting {
    /// Of what an objective moves.
    pub(super) fn of<const D: usize>(objective: &Objective<'_, D>) -> Self {
        let particles = &*objective.movable.particles;
        let mobile = objective.movable.mobile.iter().copied();
        let (free, sliding): (Vec<u32>, Vec<u32>) =
            mobile.partition(|&i| particles.kind[i as usize] == Kind::Free);
        let mut row = vec![None; particles.len()];
        for (number, &i) in (0_u32..).zip(&free) {
            row[i as usize] = Some(number);
        }
        Self {
            farthest: FARTHEST,
            row,
            free,
            sliding,
        }
    }

    /// One step from where the particles are, which must be evaluated; and how many pair sums it took.
    pub(super) fn step<const D: usize>(
        &mut self,
        objective: &mut Objective<'_, D>,
        spacing: f64,
    ) -> (Rested, usize) {
        let before = objective.figures().calm;
        let nearest = objective.closest();
        let mut sums = 0;
        let start = {
            let mut places = Vec::new();
            objective.movable.places(&mut places);
            places
        };
        let Some(newton) = Newton::at(self, objective, spacing) else {
            return (Rested::Stuck, sums);
        };
        let gradient = newton.gradients(self, objective);
        let plain = newton.plain(&gradient);
        let (Some(onward), Some(mut aside)) = (
            newton.chosen_step(self, objective, &plain, spacing, false),
            newton.chosen_step(self, objective, &plain, spacing, true),
        ) else {
            return (Rested::Stuck, sums);
        };
        // What evens the density while ∇Γ stays.
        add_scaled(&mut aside, -1.0, &onward);
        let lengths = [&onward, &aside].map(|step| longest(step) / spacing);
        let mut step = Vec::new();
        loop {
            let [part, beside] = lengths.map(|length| (self.farthest / length).min(1.0));
            step.clone_from(&onward);
            vectors::scale(&mut step, part);
            add_scaled(&mut step, beside, &aside);
            objective.movable.move_to(&start, 1.0, &step);
            objective.evaluate();
            sums += 1;
            let mut last = f64::INFINITY;
            for _ in 0..CORRECTIONS {
                let mut off = newton.gradients(self, objective);
                for (off, first) in off.iter_mut().zip(&gradient) {
                    *off = point::add_scaled(*off, part - 1.0, *first);
                }
                let Some(back) = newton.shortest_step(self, objective, &off) else {
                    break;
                };
                let far = longest(&back) / spacing;
                if far.is_nan() || far > 0.5 * last.min(self.farthest) {
                    break;
                }
                last = far;
                let mut here = Vec::new();
                objective.movable.places(&mut here);
                objective.movable.move_to(&here, 1.0, &back);
                objective.evaluate();
                sums += 1;
                if far < 1e-9 {
                    break;
                }
            }
            let after = objective.figures().calm;
            let closest = objective.closest();
            let is_apart = closest >= nearest.min(CLOSEST * spacing);
            if after < (1.0 - 0.3 * part) * before && is_apart {
                self.farthest = (1.2 * self.farthest).min(FARTHEST);
                return (Rested::Nearer, sums);
            }
            self.farthest *= 0.5;
            if self.farthest < FARTHEST / 20.0 {
                objective.movable.move_to(&start, 0.0, &step);
                objective.evaluate();
                return (Rested::Stuck, sums + 1);
            }
        }
    }
}

/// The equations at one place.
struct Newton<const D: usize> {
    links: Links<D>,
    factor: Factor,
    /// What slides: the particle, its number among the mobile ones, and a direction along its surface.
    slides: Vec<(u32, usize, [f64; D])>,
    /// What free particles do where one of these goes on by one, ∇Γ held: a column each.
    follow: Mat<f64>,
    /// The same, row by row.
    rows: Vec<f64>,
    /// followᵀ follow + 1.
    square: Mat<f64>,
    unit: f64,
}

impl<const D: usize> Newton<D> {
    fn at(of: &Resting, objective: &Objective<'_, D>, spacing: f64) -> Option<Self> {
        let particles = &*objective.movable.particles;
        let links = Links::of(&objective.forces, &particles.position);
        let unit = spacing.powi(D as i32);
        let factor = Factor::of(&links, particles, &of.row, unit)?;
        let mut slides = Vec::new();
        for &i in &of.sliding {
            let place = objective.movable.mobile.binary_search(&i).ok()?;
            for k in 0..D {
                // The axes along the surface, made orthogonal.
                let mut axis = [0.0; D];
                axis[k] = 1.0;
                let mut along = objective.movable.tangential(i as usize, axis);
                for &(other, _, direction) in slides.iter().rev().take(D - 1) {
                    if other == i {
                        along = point::reject(along, direction);
                    }
                }
                let length = point::norm(along);
                if length > 0.5 {
                    slides.push((i, place, point::scale(along, 1.0 / length)));
                }
            }
        }
        let volume = &particles.volume;
        let mut follow = Mat::zeros(D * of.free.len(), slides.len());
        for (column, &(b, _, direction)) in slides.iter().enumerate() {
            for link in links.of_particle(b as usize) {
                let Some(row) = of.row[link.other as usize] else {
                    continue;
                };
                let weight = volume[link.other as usize] * volume[b as usize] / unit;
                for k in 0..D {
                    follow[(D * row as usize + k, column)] +=
                        weight * point::dot(link.hessian[k], direction);
                }
            }
        }
        if !slides.is_empty() {
            factor.solve(&mut follow);
        }
        let mut square = follow.transpose() * &follow;
        for k in 0..slides.len() {
            square[(k, k)] += 1.0;
        }
        let mut rows = vec![0.0; follow.nrows() * follow.ncols()];
        for (column, values) in follow.col_iter().enumerate() {
            for (row, value) in values.iter().enumerate() {
                rows[row * slides.len() + column] = *value;
            }
        }
        Some(Self {
            links,
            factor,
            slides,
            follow,
            rows,
            square,
            unit,
        })
    }

    /// V ∇Γ over the unit of the free particles.
    fn gradients(&self, of: &Resting, objective: &Objective<'_, D>) -> Vec<[f64; D]> {
        let volume = &objective.movable.particles.volume;
        let of_one = |&i: &u32| {
            let i = i as usize;
            point::scale(objective.forces.gradient(i), volume[i] / self.unit)
        };
        of.free.iter().map(of_one).collect()
    }

    /// What coordinate `k` of a free particle does with each that slides.
    fn row(&self, free: u32, k: usize) -> &[f64] {
        let count = self.slides.len();
        let row = D * free as usize + k;
        &self.rows[row * count..(row + 1) * count]
    }

    /// −H⁻¹ `gradient`: surface particles stay.
    fn plain(&self, gradient: &[[f64; D]]) -> Mat<f64> {
        let mut right = Mat::from_fn(D * gradient.len(), 1, |row, _| -gradient[row / D][row % D]);
        self.factor.solve(&mut right);
        right
    }

    /// The step of all that moves where surface particles slide by `slid`.
    fn whole(
        &self,
        of: &Resting,
        objective: &Objective<'_, D>,
        plain: &Mat<f64>,
        slid: Option<&Mat<f64>>,
    ) -> Vec<[f64; D]> {
        let mut free = plain.clone();
        let mut step = vec![[0.0; D]; objective.movable.mobile.len()];
        if let Some(slid) = slid {
            free += &self.follow * slid;
            for (column, &(_, place, direction)) in self.slides.iter().enumerate() {
                step[place] = point::add_scaled(step[place], slid[(column, 0)], direction);
            }
        }
        let mut rows = 0..of.free.len();
        for (place, &i) in objective.movable.mobile.iter().enumerate() {
            if of.row[i as usize].is_some()
                && let Some(row) = rows.next()
            {
                step[place] = std::array::from_fn(|k| free[(D * row + k, 0)]);
            }
        }
        step
    }

    /// The shortest step p with J p = −`gradient`.
    fn shortest_step(
        &self,
        of: &Resting,
        objective: &Objective<'_, D>,
        gradient: &[[f64; D]],
    ) -> Option<Vec<[f64; D]>> {
        let plain = self.plain(gradient);
        if self.slides.is_empty() {
            return Some(self.whole(of, objective, &plain, None));
        }
        let mut right = self.follow.transpose() * &plain;
        right *= faer::Scale(-1.0);
        let slid = solve_definite(&self.square, &right)?;
        Some(self.whole(of, objective, &plain, Some(&slid)))
    }

    /// The one of all steps that change ∇Γ as the [plain](Newton::plain) one does that is short and leaves pairs apart; and,
    /// where that is asked for, the density even.
    fn chosen_step(
        &self,
        of: &Resting,
        objective: &Objective<'_, D>,
        plain: &Mat<f64>,
        spacing: f64,
        is_even: bool,
    ) -> Option<Vec<[f64; D]>> {
        if self.slides.is_empty() {
            return Some(self.whole(of, objective, plain, None));
        }
        let short = SHORT / (spacing * spacing);
        let mut square = self.square.clone();
        square *= faer::Scale(short);
        let mut right = self.follow.transpose() * plain;
        right *= faer::Scale(-short);
        let alone = self.whole(of, objective, plain, None);
        if is_even {
            self.add_evenness(of, objective, &alone, (&mut square, &mut right));
        }
        let mut slid: Option<Mat<f64>> = None;
        for _ in 0..ROUNDS {
            let step = self.whole(of, objective, plain, slid.as_ref());
            let (mut all, mut side) = (square.clone(), right.clone());
            let (approaching, least) = objective.approaching(&step);
            for pair in approaching {
                // Its length over d, as what slides changes it.
                let mut row = vec![0.0; self.slides.len()];
                let mut lack = pair.distance - 1.0;
                for (place, sign) in pair.both.into_iter().zip([1.0, -1.0]) {
                    let Some(place) = place.map(|place| place as usize) else {
                        continue;
                    };
                    let direction = point::scale(pair.direction, sign / least);
                    lack += point::dot(direction, alone[place]);
                    if let Some(free) = of.row[objective.movable.mobile[place] as usize] {
                        for k in 0..D {
                            add_to(&mut row, direction[k], self.row(free, k));
                        }
                    }
                    for (entry, (_, own, along)) in row.iter_mut().zip(&self.slides) {
                        if *own == place {
                            *entry += point::dot(direction, *along);
                        }
                    }
                }
                for (a, &first) in row.iter().enumerate() {
                    for (b, &second) in row.iter().enumerate() {
                        all[(a, b)] += APART * first * second;
                    }
                    side[(a, 0)] -= APART * lack * first;
                }
            }
            slid = Some(solve_definite(&all, &side)?);
        }
        Some(self.whole(of, objective, plain, slid.as_ref()))
    }

    /// Adds to the normal equations of what slides by how much each density changes with it, beside what free particles
    /// do `alone`.
    fn add_evenness(
        &self,
        of: &Resting,
        objective: &Objective<'_, D>,
        alone: &[[f64; D]],
        (square, right): (&mut Mat<f64>, &mut Mat<f64>),
    ) {
        let judged: Vec<usize> = objective.judged().collect();
        let count = self.slides.len();
        let mut by_slides = vec![0.0; judged.len() * count];
        let mut level = Mat::<f64>::zeros(judged.len(), 1);
        let (particles, place) = (&*objective.movable.particles, objective.places());
        let moved = |step: &[[f64; D]], i: usize| place[i].map_or([0.0; D], |p| step[p as usize]);
        let mut row_of = vec![None; particles.len()];
        for (row, &i) in judged.iter().enumerate() {
            row_of[i] = Some(row);
            let out = &mut by_slides[row * count..(row + 1) * count];
            let (mut change, mut own) = (0.0, [0.0; D]);
            for link in self.links.of_particle(i) {
                let j = link.other as usize;
                let apart = point::sub(moved(alone, i), moved(alone, j));
                let gradient = point::scale(link.gradient, particles.volume[j]);
                change += point::dot(gradient, apart);
                own = point::add(own, gradient);
                if let Some(free) = of.row[j] {
                    for k in 0..D {
                        add_to(out, -gradient[k], self.row(free, k));
                    }
                }
            }
            if let Some(free) = of.row[i] {
                for k in 0..D {
                    add_to(out, own[k], self.row(free, k));
                }
            }
            level[(row, 0)] = objective.excess(i) + change;
        }
        for (column, &(b, _, direction)) in self.slides.iter().enumerate() {
            let b = b as usize;
            for link in self.links.of_particle(b) {
                let j = link.other as usize;
                let along = point::dot(link.gradient, direction);
                if let Some(row) = row_of[b] {
                    by_slides[row * count + column] += particles.volume[j] * along;
                }
                // The other's own pair has the opposite gradient.
                if let Some(row) = row_of[j] {
                    by_slides[row * count + column] += particles.volume[b] * along;
                }
            }
        }
        let by_slides = MatRef::from_row_major_slice(&by_slides, judged.len(), count);
        *square += by_slides.transpose() * by_slides;
        *right -= by_slides.transpose() * &level;
    }
}

/// a ← a + s b.
fn add_to(a: &mut [f64], s: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += s * b;
    }
}
