//! Static confinement (Zhao et al. 2025, §2.1.4): what lies beyond a surface, as a particle before it sees it.

use std::collections::HashMap;
use std::f64::consts::PI;
use std::ops::Range;

use rayon::prelude::*;
use sphpack_geometry::Surface;
use sphpack_kernels::{Kernel, KernelKind, WithKernel};
use sphpack_neighbors::{Bounds, Domain, Odometer, gauss, point};

mod facets;
#[cfg(test)]
mod tests;

use facets::{Facet, Patch, facets, finer_by_bends};

/// Edge of the cells that cut the surface into patches, in ∆s: one patch is one term of the gradient's sum.
const CELL_OVER_SPACING: [f64; 2] = [1.0 / 12.0, 1.0 / 4.0];

/// Patches on a ∆s^(D−1) of flat surface: 1.5 for each face of a cell.
fn patches_over_spacing(dimension: usize) -> f64 {
    1.5 * CELL_OVER_SPACING[dimension - 2].powi(1 - dimension as i32)
}

/// About how many patches a surface will have on either side, those along sharp edges not among them.
pub(crate) fn expected_patches<const D: usize>(surface: &dyn Surface<D>, spacing: f64) -> f64 {
    let finer = finer_by_bends(surface, CELL_OVER_SPACING[D - 2] * spacing);
    surface.measure() / spacing.powi(D as i32 - 1) * patches_over_spacing(D) * finer
}

/// Patches along a ∆s of a sharp edge in space, where cells are a quarter as large: by the memory of two boxes.
pub(crate) const PATCHES_ALONG_EDGE: f64 = 130.0;

/// What the exterior of a domain adds to Γ and ∇Γ of a particle inside, as if it were full of matter of density 1.
///
/// Zhao et al. (2025), eq. 10 sums cells of a background mesh beyond the surface, at the mesh's nodes, and
/// interpolates between nodes. Here the divergence theorem turns both integrals into sums over the surface itself,
///
/// - ∇I(x) = ∮ W(|y − x|) n dA,
/// - I(x) = ∮ (M₀ − N(r)) (y − x)·n / r^D dA with N(r) = ∫₀^r W s^(D−1) ds and M₀ = N(∞),
///
/// n out of the domain. So there is neither a mesh nor an interpolation: cost and memory grow with the surface, and
/// places nearer to it are no less accurate than others. In I the term M₀, singular, is the angle under which a facet
/// is seen, known exactly; what is left is smooth.
#[derive(Debug, Clone)]
pub struct Confinement<const D: usize> {
    kernel: KernelKind,
    smoothing_length: f64,
    domain: Domain<D>,
    /// Middles of the patches, and their areas, outward and as long as they are large: the gradient's loop reads these
    /// alone.
    centers: Vec<[f64; D]>,
    areas: Vec<[f64; D]>,
    /// The facets of every patch, and how far it is moved.
    seen: Vec<(Range<usize>, [f64; D])>,
    facets: Vec<Facet<D>>,
    blocks: Vec<Block<D>>,
    /// Edge of a bin, the kernel's support.
    bin: f64,
    /// For every bin that a patch is near to, the blocks of patches in it and in the bins around it.
    near: HashMap<[i64; D], Vec<Range<usize>>>,
}

/// Some patches of one bin, that are passed by together where all are out of reach: of what is in the bins around a
/// place two thirds are.
#[derive(Debug, Clone)]
struct Block<const D: usize> {
    bounds: Bounds<D>,
    patches: Range<usize>,
}

/// Patches of a block.
const BLOCK: usize = 32;

/// A patch, or a periodic image of one, while they are put in order.
#[derive(Debug, Clone)]
struct Element<const D: usize> {
    center: [f64; D],
    area: [f64; D],
    shift: [f64; D],
    facets: Range<usize>,
}

impl<const D: usize> Confinement<D> {
    /// Of the inside of a body: everything outside confines. Lengths in scene units; `spacing`, ∆s, sets how finely the
    /// surface is cut.
    pub fn inside(
        surface: &dyn Surface<D>,
        domain: &Domain<D>,
        kernel: KernelKind,
        smoothing_length: f64,
        spacing: f64,
    ) -> Self {
        let size = CELL_OVER_SPACING[D - 2] * spacing;
        Self::of(facets(surface, size), domain, kernel, smoothing_length)
    }

    /// Of the outside of some bodies (Zhao et al. 2025, eq. 11): the bodies confine. What one body has of its surface
    /// within another is left out.
    pub fn outside(
        bodies: &[&dyn Surface<D>],
        domain: &Domain<D>,
        kernel: KernelKind,
        smoothing_length: f64,
        spacing: f64,
    ) -> Self {
        let size = CELL_OVER_SPACING[D - 2] * spacing;
        let mut all = Vec::new();
        for (number, body) in bodies.iter().enumerate() {
            for patch in facets(*body, size) {
                let kept: Patch<D> = (patch.into_iter())
                    .filter(|facet| {
                        let others = bodies.iter().enumerate().filter(|(b, _)| *b != number);
                        !others.into_iter().any(|(_, b)| b.inside(facet.center()))
                    })
                    .map(Facet::turned)
                    .collect();
                all.push(kept);
            }
        }
        Self::of(all, domain, kernel, smoothing_length)
    }

    fn of(
        patches: Vec<Patch<D>>,
        domain: &Domain<D>,
        kernel: KernelKind,
        smoothing_length: f64,
    ) -> Self {
        let bin = kernel.support_over_h() * smoothing_length;
        let mut facets = Vec::new();
        let mut elements = Vec::new();
        for patch in patches {
            let begin = facets.len();
            let (mut center, mut area, mut size) = ([0.0; D], [0.0; D], 0.0);
            for facet in &patch {
                let part = point::norm(facet.area);
                size += part;
                center = point::add_scaled(center, part, facet.center());
                area = point::add(area, facet.area);
            }
            if size > 0.0 {
                facets.extend(patch);
                elements.push(Element {
                    center: point::scale(center, 1.0 / size),
                    area,
                    shift: [0.0; D],
                    facets: begin..facets.len(),
                });
            }
        }
        images(&mut elements, domain, bin);
        let key = |p: [f64; D]| p.map(|x| (x / bin).floor() as i64);
        elements.sort_by_key(|element| key(element.center));
        let mut near: HashMap<[i64; D], Vec<Range<usize>>> = HashMap::new();
        let mut blocks = Vec::new();
        let mut begin = 0;
        for bin in elements.chunk_by(|a, b| key(a.center) == key(b.center)) {
            let middle = key(bin[0].center);
            let first = blocks.len();
            for block in bin.chunks(BLOCK) {
                let mut bounds = Bounds::EMPTY;
                block.iter().for_each(|patch| bounds.include(patch.center));
                blocks.push(Block {
                    bounds,
                    patches: begin..begin + block.len(),
                });
                begin += block.len();
            }
            for step in Odometer::new([-1; D], [2; D]) {
                let around = std::array::from_fn(|k| middle[k] + step[k]);
                near.entry(around).or_default().push(first..blocks.len());
            }
        }
        Self {
            kernel,
            smoothing_length,
            domain: *domain,
            centers: elements.iter().map(|element| element.center).collect(),
            areas: elements.iter().map(|element| element.area).collect(),
            seen: (elements.into_iter())
                .map(|element| (element.facets, element.shift))
                .collect(),
            facets,
            blocks,
            bin,
            near,
        }
    }

    /// How many patches there are, periodic images included.
    pub fn patches(&self) -> usize {
        self.centers.len()
    }

    /// Blocks of the patches whose middle may be within the support of a place.
    fn around(&self, p: [f64; D]) -> impl Iterator<Item = &Block<D>> {
        let key = p.map(|x| (x / self.bin).floor() as i64);
        let bins = self.near.get(&key).map_or(&[][..], Vec::as_slice);
        bins.iter().flat_map(|bin| &self.blocks[bin.clone()])
    }

    /// Adds ∇I to the vector of every place; `None` for places that are not asked for. Per scene unit. In parallel, the
    /// same bits for any number of threads; a place takes as long as there are patches near it.
    pub fn add_gradients(
        &self,
        places: &[[f64; D]],
        is_asked: impl Fn(usize) -> bool + Sync,
        sums: &mut [[f64; D]],
    ) {
        let work = Gradients {
            confinement: self,
            places,
            is_asked,
            sums,
        };
        self.kernel.with(self.smoothing_length, work);
    }

    /// I, the part of Γ that lies beyond the surface, seen from a place before it. Dimensionless.
    pub fn gamma(&self, place: [f64; D]) -> f64 {
        let work = Gamma {
            confinement: self,
            place: self.domain.wrap(place),
        };
        self.kernel.with(self.smoothing_length, work)
    }
}

/// Adds the images of patches across the periodic sides, as far as they reach into the box.
fn images<const D: usize>(elements: &mut Vec<Element<D>>, domain: &Domain<D>, reach: f64) {
    let size = domain.bounds.size();
    let box_and_reach = domain.bounds.grown(reach);
    for k in (0..D).filter(|&k| domain.periodic[k]) {
        for i in 0..elements.len() {
            for step in [-size[k], size[k]] {
                let mut image = elements[i].clone();
                image.center[k] += step;
                image.shift[k] += step;
                if box_and_reach.contains(image.center) {
                    elements.push(image);
                }
            }
        }
    }
}

struct Gradients<'a, const D: usize, F> {
    confinement: &'a Confinement<D>,
    places: &'a [[f64; D]],
    is_asked: F,
    sums: &'a mut [[f64; D]],
}

impl<const D: usize, F: Fn(usize) -> bool + Sync> WithKernel<D> for Gradients<'_, D, F> {
    type Output = ();

    fn call<K: Kernel<D>>(self, kernel: K) {
        let reach = kernel.support() * kernel.support();
        (self.sums.par_iter_mut().zip(self.places).enumerate())
            .with_min_len(256)
            .filter(|(i, _)| (self.is_asked)(*i))
            .for_each(|(_, (sum, &place))| {
                let place = self.confinement.domain.wrap(place);
                let mut gradient = [0.0; D];
                for block in self.confinement.around(place) {
                    if block.bounds.distance_squared(place) >= reach {
                        continue;
                    }
                    let patches = block.patches.clone();
                    let centers = &self.confinement.centers[patches.clone()];
                    for (&center, &area) in centers.iter().zip(&self.confinement.areas[patches]) {
                        let r_squared = point::distance_squared(place, center);
                        if r_squared < reach {
                            let (value, _) = kernel.value_and_slope_over_r(r_squared);
                            gradient = point::add_scaled(gradient, value, area);
                        }
                    }
                }
                *sum = point::add(*sum, gradient);
            });
    }
}

struct Gamma<'a, const D: usize> {
    confinement: &'a Confinement<D>,
    place: [f64; D],
}

impl<const D: usize> WithKernel<D> for Gamma<'_, D> {
    type Output = f64;

    fn call<K: Kernel<D>>(self, kernel: K) -> f64 {
        let whole = 1.0 / [2.0 * PI, 4.0 * PI][D - 2];
        let reach = kernel.support();
        let mut sum = 0.0;
        let patches = (self.confinement.around(self.place)).flat_map(|block| block.patches.clone());
        for (facets, shift) in patches.map(|patch| &self.confinement.seen[patch]) {
            for facet in &self.confinement.facets[facets.clone()] {
                let seen = point::sub(*shift, self.place);
                let corners = facet.corners.map(|corner| point::add(corner, seen));
                if corners.iter().all(|&corner| point::norm(corner) > reach) {
                    continue;
                }
                sum += whole * angle(&corners);
                // Gauss points of a segment, middles of a triangle's sides: exact for quadratic functions at least.
                for k in 0..D {
                    let next = corners[(k + 1) % D];
                    let (a, b) = if D == 2 {
                        (0.5 + 0.75_f64.sqrt() / 3.0, 0.5 - 0.75_f64.sqrt() / 3.0)
                    } else {
                        (0.5, 0.5)
                    };
                    let y = point::add_scaled(point::scale(corners[k], a), b, next);
                    let r = point::norm(y).max(1e-6 * reach);
                    let within = mass_within(&kernel, r);
                    sum -= within / r.powi(D as i32) * point::dot(y, facet.area) / D as f64;
                }
            }
        }
        sum
    }
}

/// ∫₀^r W s^(D−1) ds, by Gauss's rule of five points on four parts: twelve digits for polynomials of degree nine.
fn mass_within<const D: usize, K: Kernel<D>>(kernel: &K, r: f64) -> f64 {
    let end = r.min(kernel.support());
    let half = end / 8.0;
    let mut sum = 0.0;
    for part in 0..4 {
        for (node, weight) in gauss::FIVE {
            let s = half * (f64::from(2 * part + 1) + node);
            sum += weight * half * kernel.value(s) * s.powi(D as i32 - 1);
        }
    }
    sum
}

/// The angle (in space: the solid angle) under which the origin sees a facet, positive where it looks at its inner side.
/// In space by van Oosterom and Strackee (1983).
fn angle<const D: usize>(corners: &[[f64; D]; D]) -> f64 {
    let [a, b] = [corners[0], corners[1]];
    if D == 2 {
        return (a[0] * b[1] - a[1] * b[0]).atan2(point::dot(a, b));
    }
    let c = corners[2];
    let lengths = [point::norm(a), point::norm(b), point::norm(c)];
    let triple = a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    let below = lengths[0] * lengths[1] * lengths[2]
        + point::dot(a, b) * lengths[2]
        + point::dot(b, c) * lengths[0]
        + point::dot(c, a) * lengths[1];
    2.0 * triple.atan2(below)
}
