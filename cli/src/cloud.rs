//! Anybody's particles, and how even they are.

use std::path::{Path, PathBuf};

use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Bounds, Domain, point};
use sphpack_packing::{DensityQuality, Fields, Kind, Lattice, ResidualQuality, Sizes};

use crate::Error;
use crate::dimension::in_dimension;
use crate::files::Columns;
use crate::places::{check_memory, places};
use crate::plan::available_bytes;

/// Particles from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Cloud {
    /// The file.
    pub path: PathBuf,
    /// 2 or 3.
    pub dimension: usize,
    /// Scene units; z is 0 in 2-D.
    pub position: Vec<[f64; 3]>,
    /// Volume (area in 2-D).
    pub volume: Vec<f64>,
    /// How each may move; free where the file does not say.
    pub kind: Vec<Kind>,
    /// Numbers that stay with the particles, where the file has them.
    pub id: Option<Vec<f64>>,
    /// Γ as the file says, where it does.
    pub gamma: Option<Vec<f64>>,
    /// Distance of wall particles in layers from the true surface, where the file has it; NaN of all others.
    pub distance: Option<Vec<f64>>,
    /// The smoothing length, where the file has the same for all.
    pub smoothing_length: Option<f64>,
    /// The spacing and the smoothing length of each, where the file says that they differ; one of them may be missing.
    pub sizes: Option<CloudSizes>,
    /// Outward unit normals of boundary particles, where the file has them.
    pub normal: Option<Vec<[f64; 3]>>,
}

/// What a file says of particles that differ in size.
#[derive(Debug, Clone, PartialEq)]
pub struct CloudSizes {
    /// Spacings, scene units; the roots of the volumes where the file has none.
    pub spacing: Vec<f64>,
    /// Smoothing lengths over spacings, where that is one number.
    pub h_over_spacing: Option<f64>,
}

impl CloudSizes {
    /// From columns: where neither spacings nor smoothing lengths differ, none. Lengths of no sense are passed over.
    fn of(columns: &Columns, volume: &[f64], dimension: usize) -> Option<Self> {
        let differing = |name: &str| {
            let column = columns.numbers.get(name)?;
            let is_length = |length: &f64| *length > 0.0 && length.is_finite();
            (column.iter().all(is_length) && common(column).is_none()).then_some(column)
        };
        let (spacing, h) = (differing("spacing"), differing("h"));
        if spacing.is_none() && h.is_none() {
            return None;
        }
        let spacing = spacing.cloned().unwrap_or_else(|| {
            let root = 1.0 / dimension as f64;
            volume.iter().map(|volume| volume.powf(root)).collect()
        });
        let h_over_spacing = h.and_then(|h| {
            let ratios: Vec<f64> = h.iter().zip(&spacing).map(|(h, s)| h / s).collect();
            common(&ratios)
        });
        let spacing = match (h, h_over_spacing) {
            // The file's own h, whatever it is of the volumes.
            (Some(h), None) => h.iter().map(|h| h / H_OVER_SPACING).collect(),
            _ => spacing,
        };
        Some(Self {
            spacing,
            h_over_spacing: h.map(|_| h_over_spacing.unwrap_or(H_OVER_SPACING)),
        })
    }
}

/// h over the spacing where nothing says it.
pub(crate) const H_OVER_SPACING: f64 = 1.2;

/// The figures of somebody's particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloudQuality {
    /// Γ of the measured particles.
    pub density: DensityQuality,
    /// h |∇Γ| of the free ones among them.
    pub residual: ResidualQuality,
    /// The largest difference from the file's own Γ, where it has one.
    pub gamma_differs: Option<f64>,
    /// How many were measured.
    pub measured: usize,
    /// How many were not, because they are near the edge of a set without frozen particles.
    pub left_out: usize,
}

impl Cloud {
    /// Reads particles (see [`Columns::read`]). Where the file has no volumes, they are masses over densities (`m` and `rho`,
    /// or `mass` and `density`); where it has not both, each is `spacing`^dimension.
    ///
    /// # Errors
    /// [`Error::Input`] where the file cannot be used.
    pub fn read(path: &Path, spacing: f64) -> Result<Self, Error> {
        check_memory(path, "measuring")?;
        let columns = Columns::read(path)?;
        let (dimension, position) = places(&columns, path)?;
        let column = |name: &str| columns.numbers.get(name);
        let volume = volumes(&columns, path)?
            .unwrap_or_else(|| vec![spacing.powi(dimension as i32); position.len()]);
        let kind = match columns.words.get("kind") {
            None => vec![Kind::Free; position.len()],
            Some(words) => words
                .iter()
                .map(|word| {
                    let word = word.trim();
                    word.parse().map_err(|_| {
                        let known = Kind::ALL.map(Kind::name);
                        Error::input(
                            path,
                            format!(
                                "no kind of particles is called \"{word}\"; {}",
                                crate::scene::advice(word, &known)
                            ),
                        )
                    })
                })
                .collect::<Result<_, _>>()?,
        };
        let normal = match (column("nx"), column("ny"), column("nz")) {
            (Some(nx), Some(ny), nz) => Some(
                (0..nx.len())
                    .map(|i| [nx[i], ny[i], nz.map_or(0.0, |nz| nz[i])])
                    .collect(),
            ),
            _ => None,
        };
        let sizes = CloudSizes::of(&columns, &volume, dimension);
        Ok(Self {
            sizes,
            path: path.to_owned(),
            dimension,
            position,
            volume,
            kind,
            id: column("id").cloned(),
            gamma: column("gamma").cloned(),
            distance: column("distance").cloned(),
            smoothing_length: column("h").and_then(|h| common(h)),
            normal,
        })
    }

    /// How many are frozen.
    pub fn frozen_count(&self) -> usize {
        self.kind
            .iter()
            .filter(|&&kind| kind == Kind::Frozen)
            .count()
    }

    /// Γ and h |∇Γ| of all but the frozen particles, and walls in layers; where none is frozen, of those farther than a support radius from
    /// the edge of the box around them all.
    ///
    /// # Errors
    /// [`Error::Input`] where nothing is left to measure, or the spacing cannot be that of the particles.
    pub fn measure(
        &self,
        spacing: f64,
        kernel: KernelKind,
        h_over_spacing: f64,
    ) -> Result<CloudQuality, Error> {
        in_dimension!(self.dimension, D => self.measure_in::<D>(spacing, kernel, h_over_spacing))
    }

    fn measure_in<const D: usize>(
        &self,
        spacing: f64,
        kernel: KernelKind,
        h_over_spacing: f64,
    ) -> Result<CloudQuality, Error> {
        let positions: Vec<[f64; D]> = (self.position.iter()).map(|p| point::of_slice(p)).collect();
        let bounds = Bounds::of(&positions);
        let sizes = match &self.sizes {
            Some(each) => Sizes::each(&each.spacing, h_over_spacing),
            None => Sizes::uniform(spacing, h_over_spacing),
        };
        let coarsest =
            (0..positions.len()).fold(0.0, |most: f64, i| most.max(sizes.over_finest(i)));
        let support = kernel.support_over_h() * sizes.smallest_smoothing_length() * coarsest;
        self.check_spacing(&bounds, support, spacing)?;
        let has_frozen = self.frozen_count() > 0;
        let inner = bounds.grown(-support);
        // Walls in layers are there for the fluid to have neighbours; they have none on their far side.
        let is_judged = |i: usize| {
            let wall = self.distance.as_ref().map(|distance| distance[i]);
            self.kind[i] != Kind::Frozen && wall.is_none_or(f64::is_nan)
        };
        let is_measured = |i: usize| is_judged(i) && (has_frozen || inner.contains(positions[i]));
        let measured: Vec<usize> = (0..positions.len()).filter(|&i| is_measured(i)).collect();
        if measured.is_empty() {
            return Err(Error::input(
                &self.path,
                format!(
                    "every particle is within a support radius ({support:.3e}) of the edge, where nothing can be measured; add rows of kind frozen around them, or give a smaller --spacing"
                ),
            ));
        }
        let domain = Domain {
            bounds,
            periodic: [false; D],
        };
        let fields = Fields::measure_each(
            &domain,
            &positions,
            &self.volume,
            sizes,
            is_measured,
            kernel,
        );
        let gamma: Vec<f64> = measured.iter().map(|&i| fields.gamma[i]).collect();
        let free: Vec<f64> = measured
            .iter()
            .filter(|&&i| self.kind[i] == Kind::Free)
            .map(|&i| fields.residual(i))
            .collect();
        let tangential = self.normal.iter().flat_map(|normals| {
            measured
                .iter()
                .filter(|&&i| self.kind[i] == Kind::Boundary)
                .map(|&i| {
                    (
                        i,
                        point::reject(fields.gradient[i], point::of_slice(&normals[i])),
                    )
                })
                .map(|(i, along)| fields.sizes.smoothing_length(i) * point::norm(along))
        });
        let lattice = Lattice::auto(D, kernel, h_over_spacing).gamma(kernel, h_over_spacing);
        Ok(CloudQuality {
            density: DensityQuality::of(&gamma, lattice),
            residual: ResidualQuality::of(&free, tangential.fold(0.0, f64::max)),
            gamma_differs: self.gamma.as_ref().map(|own| {
                (measured.iter().zip(&gamma))
                    .map(|(&i, gamma)| (own[i] - gamma).abs())
                    .fold(0.0, f64::max)
            }),
            measured: measured.len(),
            left_out: positions.len() - self.frozen_count() - measured.len(),
        })
    }

    /// Refuses a spacing so large that every particle would be everybody's neighbour, beyond any memory.
    fn check_spacing<const D: usize>(
        &self,
        bounds: &Bounds<D>,
        support: f64,
        spacing: f64,
    ) -> Result<(), Error> {
        let number = self.position.len() as f64;
        let share: f64 = bounds
            .size()
            .into_iter()
            .map(|edge| (2.0 * support / edge.max(f64::MIN_POSITIVE)).min(1.0))
            .product();
        let bytes = number * ((number * share).max(1.0) * 4.0 + MEASURED_BYTES);
        if bytes <= available_bytes() {
            return Ok(());
        }
        Err(Error::input(
            &self.path,
            format!(
                "{number} particles at --spacing {spacing} would have about {:.0} neighbours each, more than fit into memory; is the spacing right?",
                number * share
            ),
        ))
    }
}

/// How far the smoothing lengths of one set may differ and still be one, as a part of it: numbers of 32 bits do.
const SAME_LENGTH: f64 = 1e-6;

/// The length that all are, if it is one.
fn common(lengths: &[f64]) -> Option<f64> {
    let first = *lengths.first()?;
    let is_same = |h: &f64| (h - first).abs() <= SAME_LENGTH * first;
    (first > 0.0 && first.is_finite() && lengths.iter().all(is_same)).then_some(first)
}

/// The particles' volumes, as far as the file says.
fn volumes(columns: &Columns, path: &Path) -> Result<Option<Vec<f64>>, Error> {
    let column = |name: &str| columns.numbers.get(name);
    if let Some(volume) = column("volume") {
        let bad = volume.iter().position(|&v| !(v > 0.0 && v.is_finite()));
        return match bad {
            None => Ok(Some(volume.clone())),
            Some(bad) => Err(Error::input(
                path,
                format!(
                    "particle {bad} has the volume {}; volumes must be positive, finite numbers",
                    volume[bad]
                ),
            )),
        };
    }
    // PySPH has zeros throughout where nothing was set.
    let given = |names: [&'static str; 2]| {
        (names.into_iter())
            .filter_map(|name| Some((name, column(name)?)))
            .find(|(_, values)| values.iter().any(|&value| value != 0.0))
    };
    let (Some((m, mass)), Some((rho, density))) = (given(["m", "mass"]), given(["rho", "density"]))
    else {
        return Ok(None);
    };
    let volume: Vec<f64> = mass.iter().zip(density).map(|(m, rho)| m / rho).collect();
    match volume.iter().position(|&v| !(v > 0.0 && v.is_finite())) {
        None => Ok(Some(volume)),
        Some(bad) => Err(Error::input(
            path,
            format!(
                "particle {bad} has {m} = {} and {rho} = {}, no volume: both must be positive, finite numbers; correct them, or add a column volume",
                mass[bad], density[bad]
            ),
        )),
    }
}

/// What one particle takes while it is measured, its neighbours left out, bytes.
const MEASURED_BYTES: f64 = 150.0;
