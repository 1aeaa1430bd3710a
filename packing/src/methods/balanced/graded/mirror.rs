//! What is beyond open sides of the box: mirror images of what is within.

use std::io::{self, Write};

use sphpack_neighbors::{Domain, point};

use crate::particles::{Kind, Particles};
use crate::resolution::Resolution;
use crate::state::{Damaged, State, Value, values};

/// Images of particles near open sides, mirrored at them. An open box of graded particles has no lattice that could go on beyond
/// it; with its mirror images a particle at a side is as even as one in the middle, and the box's volume its particles' own.
#[derive(Debug)]
pub(super) struct Mirror<const D: usize> {
    domain: Domain<D>,
    resolution: Resolution<D>,
    /// How far a particle sees, in its spacings.
    sight: f64,
    images: Vec<Image<D>>,
    /// Where particles were when images were chosen.
    chosen_at: Vec<[f64; D]>,
}

/// The image of a particle: across no side, the lower (−1) or the upper (1) of every axis.
#[derive(Debug, Clone, Copy)]
struct Image<const D: usize> {
    particle: u32,
    across: [f64; D],
}

values!(Image[const D: usize] { particle: u32, across: [f64; D] });

/// Particles may come nearer to a side by this before images are chosen anew, in their spacings.
const ROOM: f64 = 0.5;

/// Who sees an image may see farther than its particle, or one at the side where it is nearest, by this.
const FARTHER: f64 = 1.1;

impl<const D: usize> Mirror<D> {
    /// At the open sides of a box, for particles that see so many of their spacings.
    pub(super) fn new(domain: Domain<D>, resolution: Resolution<D>, sight: f64) -> Self {
        Self {
            domain,
            resolution,
            sight,
            images: Vec::new(),
            chosen_at: Vec::new(),
        }
    }

    /// How many images there are.
    pub(super) fn len(&self) -> usize {
        self.images.len()
    }

    /// The particle of every image.
    pub(super) fn particles(&self) -> impl Iterator<Item = usize> {
        self.images.iter().map(|image| image.particle as usize)
    }

    /// Where the images are.
    pub(super) fn places(&self, position: &[[f64; D]]) -> impl Iterator<Item = [f64; D]> {
        let bounds = self.domain.bounds;
        self.images.iter().map(move |image| {
            let p = position[image.particle as usize];
            std::array::from_fn(|k| match image.across[k] {
                0.0 => p[k],
                side if side < 0.0 => 2.0 * bounds.min[k] - p[k],
                _ => 2.0 * bounds.max[k] - p[k],
            })
        })
    }

    /// Chooses images anew where particles have moved too far; whether it did.
    pub(super) fn follow(&mut self, particles: &Particles<D>) -> bool {
        let position = &particles.position;
        let is_far = |i: usize| {
            let room = ROOM * particles.sizes.spacing(i);
            point::distance_squared(position[i], self.chosen_at[i]) > room * room
        };
        let holds = self.chosen_at.len() == position.len() && !(0..position.len()).any(is_far);
        if holds {
            return false;
        }
        self.choose(particles);
        true
    }

    fn choose(&mut self, particles: &Particles<D>) {
        self.images.clear();
        self.chosen_at.clear();
        self.chosen_at.extend_from_slice(&particles.position);
        let Domain { bounds, periodic } = self.domain;
        for (i, p) in particles.position.iter().enumerate() {
            let own = particles.sizes.spacing(i);
            // Spacings may grow towards the side.
            let likely = 2.0 * (self.sight * FARTHER + 2.0 * ROOM) * own;
            let sides: [[bool; 2]; D] = std::array::from_fn(|k| {
                [bounds.min[k], bounds.max[k]].map(|side| {
                    let away = (p[k] - side).abs();
                    if periodic[k] || away > likely {
                        return false;
                    }
                    let mut foot = *p;
                    foot[k] = side;
                    let there = self.resolution.at(foot).value;
                    away < self.sight * FARTHER * own.max(there) + 2.0 * ROOM * own
                })
            });
            for code in 1..3_usize.pow(D as u32) {
                let digit = |k: usize| code / 3_usize.pow(k as u32) % 3;
                if (0..D).all(|k| digit(k) == 0 || sides[k][digit(k) - 1]) {
                    self.images.push(Image {
                        particle: i as u32,
                        across: std::array::from_fn(|k| [0.0, -1.0, 1.0][digit(k)]),
                    });
                }
            }
        }
    }

    /// Adds the images to the particles as frozen ones, as far as particles of a kernel see whose support is so many of their
    /// spacings.
    pub(super) fn freeze(mut self, particles: &mut Particles<D>, sight: f64) {
        self.sight = sight - 2.0 * ROOM / FARTHER;
        self.choose(particles);
        let places: Vec<[f64; D]> = self.places(&particles.position).collect();
        let count = particles.len();
        let mut spacing: Vec<f64> = (0..count).map(|i| particles.sizes.spacing(i)).collect();
        for (image, place) in self.images.iter().zip(places) {
            let i = image.particle as usize;
            spacing.push(spacing[i]);
            // Along periodic axes it goes where its particle does in the end.
            let place = self.domain.wrap(place);
            particles.push(place, Kind::Frozen, particles.volume[i], None);
        }
        let h_over_spacing = particles.sizes.h_over_spacing();
        particles.sizes = crate::sizes::Sizes::each(&spacing, h_over_spacing);
    }
}

impl<const D: usize> State for Mirror<D> {
    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.images.save(out)?;
        self.chosen_at.save(out)
    }

    fn load(&mut self, from: &mut &[u8]) -> Result<(), Damaged> {
        self.images = Vec::<Image<D>>::take(from)?;
        self.chosen_at.load(from)?;
        let count = self.chosen_at.len();
        (self.images.iter())
            .all(|image| (image.particle as usize) < count)
            .then_some(())
            .ok_or(Damaged)
    }
}
