//! What is measured of packings and trials.

/// A figure of a packing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Measure {
    /// max Γ − min Γ.
    Variation,
    /// The same over the particles outside the bodies or within ∆s of their surfaces.
    VariationNear,
    /// max |Γ − 1|.
    Linf,
    /// Largest h |∇Γ| of a free particle.
    Residual,
    /// Largest distance of a surface particle from the surface, in ∆s.
    OffSurface,
    /// Smallest distance of two particles, in ∆s.
    ClosestPair,
    /// Particles on the surface over N_s.
    OnSurface,
    /// Iterations until rest.
    Iterations,
    /// Seconds, from scene to figures.
    Seconds,
    /// The farthest that a particle ends from the nearest site of its lattice, in ∆s.
    FromSite,
    /// max |Γ − Γ of the perfect lattice| at the end.
    DensityLeft,
    /// The same over what it was at the start.
    DensityLeftOverStart,
    /// The same over the largest error while an agitator ran.
    DensityLeftOverStirred,
    /// Largest distance from a place near a surface to the nearest particle, in ∆s.
    LargestHole,
    /// Smallest Γ at such places.
    LeastGamma,
    /// Largest h |∇Γ| of the fluid's particles, the bodies' among their neighbours.
    FluidResidual,
    /// Root mean square of h |∇Γ| over the free particles.
    ResidualRms,
    /// Surface particles that ∇·r < d − 0.625 does not find, over all of them.
    SurfaceMissed,
    /// Other particles that it finds, over the surface particles.
    SurfaceFalse,
    /// Points that the library's inside test puts on the wrong side.
    WrongByTest,
    /// The same by the flood.
    WrongByFlood,
    /// The same by the sum of signed angles.
    WrongByAngles,
    /// The same by the number of triangles that a ray passes.
    WrongByRays,
    /// Points of which tree and cells count other neighbours.
    NeighboursDiffer,
    /// Seconds of all inside tests.
    SecondsByTest,
    /// Seconds of the flood.
    SecondsByFlood,
    /// Seconds of all signed angles.
    SecondsByAngles,
    /// Seconds of all rays.
    SecondsByRays,
    /// Seconds to build a kd-tree and find everybody's neighbours in it.
    SecondsByTree,
    /// The same with a cell list.
    SecondsByCells,
    /// The distance at which a repulsion begins, in ∆s.
    Begins,
    /// The largest repulsion, for p_b = 1 and ∆s = 1.
    LargestForce,
    /// The repulsion of two particles at one place over the largest.
    ForceTogether,
    /// How far it is off the printed formula, over the largest.
    OffPrinted,
    /// The largest attraction.
    Pulls,
    /// The force of Lennard-Jones's kind at ∆s/2 over the largest repulsion.
    LennardJonesOverOurs,
    /// Error of an interpolated function, as Negi & Ramachandran (2021) judge: eq. 33, beside a regular mesh's sum at its own
    /// sites.
    FunctionAsPrinted,
    /// The same of its derivative.
    DerivativeAsPrinted,
    /// Error of the interpolated function off the sites, against the function itself, over that of the moved lattice.
    FunctionOffSites,
    /// The same of its derivative.
    DerivativeOffSites,
    /// Error of the interpolated function at the particles, against the function itself.
    FunctionAtParticles,
    /// The same of its derivative.
    DerivativeAtParticles,
}

impl Measure {
    pub(crate) const ALL: [Self; 42] = [
        Self::Variation,
        Self::VariationNear,
        Self::Linf,
        Self::Residual,
        Self::OffSurface,
        Self::ClosestPair,
        Self::OnSurface,
        Self::Iterations,
        Self::Seconds,
        Self::FromSite,
        Self::DensityLeft,
        Self::DensityLeftOverStart,
        Self::DensityLeftOverStirred,
        Self::LargestHole,
        Self::LeastGamma,
        Self::FluidResidual,
        Self::ResidualRms,
        Self::SurfaceMissed,
        Self::SurfaceFalse,
        Self::WrongByTest,
        Self::WrongByFlood,
        Self::WrongByAngles,
        Self::WrongByRays,
        Self::NeighboursDiffer,
        Self::SecondsByTest,
        Self::SecondsByFlood,
        Self::SecondsByAngles,
        Self::SecondsByRays,
        Self::SecondsByTree,
        Self::SecondsByCells,
        Self::Begins,
        Self::LargestForce,
        Self::ForceTogether,
        Self::OffPrinted,
        Self::Pulls,
        Self::LennardJonesOverOurs,
        Self::FunctionAsPrinted,
        Self::DerivativeAsPrinted,
        Self::FunctionOffSites,
        Self::DerivativeOffSites,
        Self::FunctionAtParticles,
        Self::DerivativeAtParticles,
    ];

    /// As tables and files call it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Variation => "total variation of Γ",
            Self::VariationNear => "total variation of Γ, outside and to ∆s inside",
            Self::Linf => "L∞(Γ − 1)",
            Self::Residual => "largest h|∇Γ|",
            Self::OffSurface => "distance from the surface / ∆s",
            Self::ClosestPair => "closest pair / ∆s",
            Self::OnSurface => "particles on the surface / N_s",
            Self::Iterations => "iterations",
            Self::Seconds => "seconds",
            Self::FromSite => "farthest from a site at the end / ∆s",
            Self::DensityLeft => "L∞(Γ − the lattice's) at the end",
            Self::DensityLeftOverStart => "L∞(Γ − the lattice's), end / start",
            Self::DensityLeftOverStirred => {
                "L∞(Γ − the lattice's) at the end / largest L∞ while stirred"
            }
            Self::LargestHole => "largest hole near the surface / ∆s",
            Self::LeastGamma => "least Γ near the surface",
            Self::FluidResidual => "largest h|∇Γ| of the fluid",
            Self::ResidualRms => "rms of h|∇Γ|",
            Self::SurfaceMissed => "surface particles not found by ∇·r < d − 0.625, part",
            Self::SurfaceFalse => "others found by ∇·r < d − 0.625, per surface particle",
            Self::WrongByTest => "points on the wrong side: inside test",
            Self::WrongByFlood => "points on the wrong side: flood",
            Self::WrongByAngles => "points on the wrong side: signed angles",
            Self::WrongByRays => "points on the wrong side: rays",
            Self::NeighboursDiffer => "points with other neighbours by kd-tree than by cells",
            Self::SecondsByTest => "seconds: inside test",
            Self::SecondsByFlood => "seconds: flood",
            Self::SecondsByAngles => "seconds: signed angles",
            Self::SecondsByRays => "seconds: rays",
            Self::SecondsByTree => "seconds: kd-tree, all neighbours",
            Self::SecondsByCells => "seconds: cell list, all neighbours",
            Self::Begins => "where the repulsion begins / ∆s",
            Self::LargestForce => "largest repulsion (p_b = ∆s = 1)",
            Self::ForceTogether => "repulsion at r = 0 / largest",
            Self::OffPrinted => "off the printed formula / largest",
            Self::Pulls => "largest attraction",
            Self::LennardJonesOverOurs => "Lennard-Jones's kind at ∆s/2 / our largest",
            Self::FunctionAsPrinted => "L2 of the function, as printed",
            Self::DerivativeAsPrinted => "L2 of the derivative, as printed",
            Self::FunctionOffSites => "L2 of the function off the sites / lattice's",
            Self::DerivativeOffSites => "L2 of the derivative off the sites / lattice's",
            Self::FunctionAtParticles => "L2 of the function at the particles",
            Self::DerivativeAtParticles => "L2 of the derivative at the particles",
        }
    }

    /// Whether it needs the interpolation of a function, which takes some seconds.
    pub(crate) fn interpolates(self) -> bool {
        self >= Self::FunctionAsPrinted
    }
}
