//! What is to be packed.

use std::sync::Arc;

use sphpack_geometry::{GeometryError, Repeated, Surface, Thin};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Bounds, Domain, words};

use crate::lattice::{Filling, Lattice};
use crate::resolution::Resolution;
use crate::sizes::Sizes;
use crate::state::Damaged;

/// How deep inside the true surface the boundary particles sit, unless a body says otherwise: ∆s/2 (Negi &
/// Ramachandran 2021, eq. 11).
pub const DEFAULT_INSET_OVER_SPACING: f64 = 0.5;

/// A body and how its surface is placed.
#[derive(Debug, Clone)]
pub struct Body<const D: usize> {
    /// The name that files and reports use.
    pub name: String,
    /// The true surface.
    pub surface: Arc<dyn Surface<D>>,
    /// How far inside the true surface the boundary particles sit, in ∆s: ½ puts the true surface between the last
    /// solid and the first fluid particle, 0 puts particles on it.
    pub inset_over_spacing: f64,
    /// How many particles parts get that are thinner than one; the balanced method asks for it.
    pub thin: Thin,
}

impl<const D: usize> Body<D> {
    /// The part of a surface particle that counts as inside: half where it sits on the true surface, the whole where
    /// it sits ∆s/2 or more inside.
    pub fn inner_share(&self) -> f64 {
        (0.5 + self.inset_over_spacing).min(1.0)
    }
}

/// How the frozen particles outside the domain are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum FrozenLayout {
    /// The lattice of the inside, continued.
    #[default]
    Lattice,
    /// A square or simple cubic ring, as Negi & Ramachandran (2021), fig. 1 draws it.
    Square,
}

/// Bodies in a box, and how to fill it with particles.
#[derive(Debug, Clone)]
pub struct Problem<const D: usize> {
    /// The box.
    pub domain: Domain<D>,
    /// How far particles are apart.
    pub resolution: Resolution<D>,
    /// The bodies; a particle belongs to the first that holds it. [`Problem::placed_body`] adds one so that its images
    /// across periodic sides are seen.
    pub bodies: Vec<Body<D>>,
    /// The smoothing kernel.
    pub kernel: KernelKind,
    /// Smoothing length over ∆s.
    pub h_over_spacing: f64,
    /// The starting lattice; `None` chooses.
    pub lattice: Option<Lattice>,
    /// The frozen particles' arrangement.
    pub frozen: FrozenLayout,
    /// Frozen particles reach at least as far as a kernel of this support (scene units) sees, for whoever judges with a
    /// longer kernel than packs; 0 where nobody does.
    pub judging_reach: f64,
    /// Where a search for the lattice's phase begins; another seed gives another, equally good packing.
    pub seed: u64,
}

/// Why a problem cannot be packed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PackingError {
    /// What an observer's [`Keeper`](crate::Keeper) had to go on from is no state of this packing.
    #[error("the state to go on from cannot be used: {0}; begin anew without it")]
    Earlier(#[from] Damaged),
    /// A number that must be positive and finite is not.
    #[error("{name} is {value}; it must be a positive, finite number")]
    NotPositive {
        /// What the number is.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// Spacings differ from place to place.
    #[error(
        "spacings from {least} to {greatest} were asked for; the method \"balanced\" alone places particles of different sizes: use it, or one spacing"
    )]
    Graded {
        /// The least, scene units.
        least: f64,
        /// The greatest.
        greatest: f64,
    },
    /// A finish is for fewer particles.
    #[error(
        "the finish \"calm\" is for at most {most:.0} particles here, not for {particles:.0}: its equations are solved directly; use the finish \"both\" or \"consistent\", a larger spacing or a smaller box"
    )]
    TooManyAtRest {
        /// About as many as fill the box.
        particles: f64,
        /// The most.
        most: f64,
    },
    /// The spacing does not fit into the box.
    #[error(
        "the spacing {spacing} is larger than the domain, which is only {} wide; use a smaller spacing",
        words::length(*.size)
    )]
    SpacingLargerThanDomain {
        /// ∆s.
        spacing: f64,
        /// The box's shortest edge.
        size: f64,
    },
    /// The spacing is larger than a body.
    #[error("the spacing {spacing} is larger than body \"{body}\", which is only {} across; use a spacing below {}", words::length(*.size), words::length(.size / 4.0))]
    SpacingLargerThanBody {
        /// The body's name.
        body: String,
        /// ∆s.
        spacing: f64,
        /// The longest edge of the body's box.
        size: f64,
    },
    /// A body sticks out of the domain.
    #[error(
        "body \"{body}\" reaches outside the domain (body from {}); enlarge the domain",
        words::corners(body_min, body_max)
    )]
    OutsideDomain {
        /// The body's name.
        body: String,
        /// Lower corner of its box.
        body_min: Vec<f64>,
        /// Upper corner of its box.
        body_max: Vec<f64>,
    },
    /// A body's surface is folded more finely than a spacing.
    #[error("the surface of body \"{body}\" is folded more finely than a spacing: for its length or area of {measure:.4} there is room for {room:.4} at {spacing}; use a spacing below {:.1e}, or a plainer body", .spacing * .room / .measure)]
    TooFolded {
        /// The body's name.
        body: String,
        /// Its length (2-D) or area.
        measure: f64,
        /// The most that the box around it has room for.
        room: f64,
        /// ∆s.
        spacing: f64,
    },
    /// A periodic axis is too short for the kernel.
    #[error(
        "axis {axis} is periodic but only {size} long, less than twice the reach {reach} of the kernel; make it longer, or the spacing smaller"
    )]
    PeriodTooShort {
        /// 0, 1, 2.
        axis: usize,
        /// The edge.
        size: f64,
        /// Support radius and skin.
        reach: f64,
    },
    /// An open axis is too short for particles of many sizes.
    #[error(
        "axis {axis} of the domain is only {size} long, less than particles of the coarsest spacing {coarsest} see, {reach}; make the coarsest finer, or the domain larger"
    )]
    NarrowDomain {
        /// 0, 1, 2.
        axis: usize,
        /// The edge.
        size: f64,
        /// The coarsest spacing.
        coarsest: f64,
        /// How far a particle of it sees.
        reach: f64,
    },
    /// A lattice of the wrong dimension.
    #[error("lattice \"{lattice}\" is {}-dimensional, the scene is {dimension}-dimensional", .lattice.dimension())]
    WrongLattice {
        /// The lattice.
        lattice: Lattice,
        /// The scene's dimension.
        dimension: usize,
    },
    /// A method for the plane was asked to pack space.
    #[error(
        "the method \"{method}\" works in the plane only; use \"balanced\", \"hybrid\" or \"coupled\" in 3-D"
    )]
    OnlyPlane {
        /// The method's name.
        method: &'static str,
    },
    /// More particles than fit.
    #[error("about {particles:.3e} particles would need {} of memory, more than the {} allowed; use a larger spacing or a smaller domain{}", size(*.needed_bytes), size(*.allowed_bytes), little(*.allowed_bytes))]
    TooLarge {
        /// Particles, frozen included.
        particles: f64,
        /// What they need.
        needed_bytes: f64,
        /// What may be used.
        allowed_bytes: f64,
    },
    /// A body's particle surface cannot be built.
    #[error("body \"{body}\": {error}")]
    Surface {
        /// The body's name.
        body: String,
        /// What is wrong.
        error: GeometryError,
    },
}

const GIBIBYTE: f64 = 1_073_741_824.0;

/// An amount of memory in words.
pub fn size(bytes: f64) -> String {
    if bytes < GIBIBYTE {
        format!("{:.0} MiB", bytes / 1_048_576.0)
    } else {
        format!("{:.1} GiB", bytes / GIBIBYTE)
    }
}

/// What else may help where there is so little memory that a limit must be the reason.
fn little(bytes: f64) -> &'static str {
    if bytes < GIBIBYTE {
        ", or fewer threads where ulimit -v is the limit"
    } else {
        ""
    }
}

impl<const D: usize> Problem<D> {
    /// An empty box to be filled at spacing ∆s, or at those of a field, with the quintic kernel at h/∆s = 1.2.
    pub fn new(domain: Domain<D>, resolution: impl Into<Resolution<D>>) -> Self {
        Self {
            domain,
            resolution: resolution.into(),
            bodies: Vec::new(),
            kernel: KernelKind::Quintic,
            h_over_spacing: 1.2,
            lattice: None,
            frozen: FrozenLayout::default(),
            judging_reach: 0.0,
            seed: 0,
        }
    }

    /// The body in a box that is as much larger as the body's longest edge to every side ([`Problem::margin`] gives it
    /// another), otherwise as [`Problem::new`]. The body's name is "body".
    ///
    /// ```
    /// use sphpack_geometry::Outline;
    /// use sphpack_packing::{Balanced, Problem};
    ///
    /// let wing = Outline::naca("0015", 1.0)?;
    /// let packed = Problem::around(&wing, 0.05).margin(0.3).pack(&Balanced::default())?;
    /// assert!(packed.quality().density.linf < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn around<S>(body: &S, resolution: impl Into<Resolution<D>>) -> Self
    where
        S: Surface<D> + Clone + 'static,
    {
        let edge = (body.bounds().size().into_iter()).fold(0.0, f64::max);
        let domain = Domain {
            bounds: body.bounds().grown(edge),
            periodic: [false; D],
        };
        Self::new(domain, resolution).body("body", body.clone())
    }

    /// The box becomes that of the bodies, larger by `margin` (scene units) to every side.
    #[must_use]
    pub fn margin(mut self, margin: f64) -> Self {
        self.domain.bounds = (self.bodies.iter())
            .fold(Bounds::EMPTY, |all, body| all.union(body.surface.bounds()))
            .grown(margin);
        self
    }

    /// Adds a body by its true surface; its boundary particles will sit ∆s/2 inside.
    #[must_use]
    pub fn body(self, name: &str, surface: impl Surface<D> + 'static) -> Self {
        self.placed_body(Body {
            name: name.to_owned(),
            surface: Arc::new(surface),
            inset_over_spacing: DEFAULT_INSET_OVER_SPACING,
            thin: Thin::Mass,
        })
    }

    /// Adds a body. On periodic axes everything that asks where it is sees its images too. One that meets its images, or
    /// passes an open side, must be [`Continued`](sphpack_geometry::Continued) beyond the same box.
    #[must_use]
    pub fn placed_body(mut self, mut body: Body<D>) -> Self {
        body.surface = self.placed(body.surface);
        self.resolution = self.resolution.beside(&body.surface);
        self.bodies.push(body);
        self
    }

    /// A surface that sees its images across periodic sides, where there are any.
    pub fn placed(&self, surface: Arc<dyn Surface<D>>) -> Arc<dyn Surface<D>> {
        if self.domain.is_periodic() && surface.window().is_none() {
            Arc::new(Repeated::new(surface, &self.domain))
        } else {
            surface
        }
    }

    /// ∆s, scene units: the D-th root of a particle's volume; the least where spacings differ.
    pub fn spacing(&self) -> f64 {
        self.resolution.finest()
    }

    /// The sizes of particles that all have the least spacing.
    pub fn sizes(&self) -> Sizes {
        Sizes::uniform(self.spacing(), self.h_over_spacing)
    }

    /// Smoothing length, scene units.
    pub fn smoothing_length(&self) -> f64 {
        self.h_over_spacing * self.spacing()
    }

    /// Support radius of the kernel, scene units.
    pub fn support(&self) -> f64 {
        self.kernel.support_over_h() * self.smoothing_length()
    }

    /// The lattice that the packing starts from.
    pub fn chosen_lattice(&self) -> Lattice {
        self.lattice
            .unwrap_or_else(|| Lattice::auto(D, self.kernel, self.h_over_spacing))
    }

    /// Γ of that lattice, undisturbed, where it fills the box. The problem must have passed [`Problem::check`].
    pub fn perfect_gamma(&self) -> f64 {
        self.filling().gamma(self.kernel, self.smoothing_length())
    }

    /// The lattice fitted to the box. The problem must have passed [`Problem::check`].
    pub fn filling(&self) -> Filling<D> {
        self.chosen_lattice()
            .fill(self.domain.bounds, self.spacing())
    }

    /// How deep the frozen layer is, scene units: the longer of [`Problem::reach`] and [`Problem::judging_reach`].
    pub fn frozen_depth(&self) -> f64 {
        self.reach().max(self.judging_reach)
    }

    /// What the neighbour lists hold, scene units: the support and their skin.
    pub fn reach(&self) -> f64 {
        self.support() + self.skin()
    }

    /// The skin of the neighbour lists, scene units.
    pub fn skin(&self) -> f64 {
        SKIN_OVER_SPACING * self.spacing()
    }

    /// [`Problem::check`], and whether there is one spacing.
    ///
    /// # Errors
    /// The first [`PackingError`] found.
    pub fn check_uniform(&self) -> Result<(), PackingError> {
        self.check()?;
        if self.resolution.uniform().is_none() {
            let [least, greatest] = self.resolution.range();
            return Err(PackingError::Graded { least, greatest });
        }
        Ok(())
    }

    /// Whether the problem makes sense, before anything large is allocated.
    ///
    /// # Errors
    /// The first [`PackingError`] found.
    pub fn check(&self) -> Result<(), PackingError> {
        for (name, value) in [
            ("the spacing", self.spacing()),
            ("the coarsest spacing", self.resolution.range()[1]),
            ("h_over_spacing", self.h_over_spacing),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(PackingError::NotPositive { name, value });
            }
        }
        let size = self.domain.bounds.size();
        for &edge in &size {
            if !(edge > 0.0 && edge.is_finite()) {
                return Err(PackingError::NotPositive {
                    name: "an edge of the domain",
                    value: edge,
                });
            }
        }
        let shortest = size.iter().copied().fold(f64::INFINITY, f64::min);
        if self.spacing() > shortest {
            return Err(PackingError::SpacingLargerThanDomain {
                spacing: self.spacing(),
                size: shortest,
            });
        }
        let lattice = self.chosen_lattice();
        if lattice.dimension() != D {
            return Err(PackingError::WrongLattice {
                lattice,
                dimension: D,
            });
        }
        let coarsest = self.resolution.greatest_in(&self.domain.bounds);
        let reach = self.frozen_depth() * (coarsest / self.spacing());
        for axis in 0..D {
            if self.domain.periodic[axis] && size[axis] < 2.0 * reach {
                return Err(PackingError::PeriodTooShort {
                    axis,
                    size: size[axis],
                    reach,
                });
            }
        }
        if self.resolution.uniform().is_none() {
            // Beyond open sides are mirror images, once.
            let axis = (0..D).find(|&k| !self.domain.periodic[k] && size[k] < reach);
            if let Some(axis) = axis {
                return Err(PackingError::NarrowDomain {
                    axis,
                    size: size[axis],
                    coarsest,
                    reach,
                });
            }
        }
        for body in &self.bodies {
            let bounds = body.surface.bounds();
            let across = bounds.size().into_iter().fold(0.0, f64::max);
            if self.spacing() > across {
                return Err(PackingError::SpacingLargerThanBody {
                    body: body.name.clone(),
                    spacing: self.spacing(),
                    size: across,
                });
            }
            if !self
                .domain
                .bounds
                .grown(1e-9 * self.spacing())
                .contains_box(&bounds)
            {
                return Err(PackingError::OutsideDomain {
                    body: body.name.clone(),
                    body_min: bounds.min.to_vec(),
                    body_max: bounds.max.to_vec(),
                });
            }
            // Twice the volume over ∆s has surfaces ∆s apart all over the box; a flat body has the box's two sides.
            let size = bounds.size();
            let sides: f64 = 2.0
                * (0..D)
                    .map(|k| (0..D).filter(|&a| a != k).map(|a| size[a]).product::<f64>())
                    .sum::<f64>();
            let room = FOLDED * (sides + bounds.volume() / self.spacing());
            let measure = body.surface.measure();
            if measure > room {
                return Err(PackingError::TooFolded {
                    body: body.name.clone(),
                    measure,
                    room,
                    spacing: self.spacing(),
                });
            }
            if !(body.inset_over_spacing >= 0.0 && body.inset_over_spacing.is_finite()) {
                return Err(PackingError::NotPositive {
                    name: "the inset of a surface",
                    value: body.inset_over_spacing,
                });
            }
        }
        Ok(())
    }
}

/// A surface larger than so many times the sides of the box around the body and its volume over ∆s is folded more finely
/// than particles can follow. What samples it takes time and memory by its size: a zigzag of 10,000 teeth in the room of 150
/// particles took minutes and gigabytes.
const FOLDED: f64 = 4.0;

/// Skin of the neighbour lists in units of ∆s: how far two particles may approach before a list must be built anew.
pub(crate) const SKIN_OVER_SPACING: f64 = 0.3;
