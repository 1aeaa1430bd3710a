//! Ellipses and ellipsoids.

mod scatter;

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use sphpack_neighbors::{Bounds, gauss, point};

use crate::level_inset::LevelInset;
use crate::surface::{Closest, Feature, Features, Surface};
use crate::{GeometryError, InsetError, Moments, ParameterError};

/// Most steps of the root search; seven or so are used.
const MAX_STEPS: usize = 100;

/// An ellipse (`D` = 2) or ellipsoid (`D` = 3) along the axes; [`Placed`](crate::Placed) turns it. The closest point
/// is exact to rounding and costs some ten iterations.
///
/// ```
/// use sphpack_geometry::{Ellipsoid, Surface};
///
/// let egg = Ellipsoid::new([0.0; 3], [3.0, 2.0, 1.0])?;
/// assert!((egg.closest([0.0, 0.0, 4.0]).distance - 3.0).abs() < 1e-12);
/// assert!((egg.volume() - 8.0 * std::f64::consts::PI).abs() < 1e-12);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid<const D: usize> {
    center: [f64; D],
    semi_axes: [f64; D],
    /// Length or area, and the integral of the mean curvature over the surface (3-D).
    measure: f64,
    mean_curvature: f64,
}

impl<const D: usize> Ellipsoid<D> {
    /// The ellipsoid around `center` with the given half lengths along the axes, scene units.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless the centre is finite and every semi-axis positive.
    pub fn new(center: [f64; D], semi_axes: [f64; D]) -> Result<Self, GeometryError> {
        ParameterError::check_finite("ellipsoid", "center", center)?;
        for axis in semi_axes {
            ParameterError::check_positive("ellipsoid", "semi-axis", axis)?;
        }
        let (measure, mean_curvature) = integrals(semi_axes);
        Ok(Self {
            center,
            semi_axes,
            measure,
            mean_curvature,
        })
    }

    fn smallest(&self) -> f64 {
        self.semi_axes.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn largest(&self) -> f64 {
        self.semi_axes.iter().copied().fold(0.0, f64::max)
    }

    /// Closest point for a `y ≥ 0` relative to the centre.
    ///
    /// It is x_i = e_i² y_i / (t + e_i²), e the semi-axes, with the one t > −e_min² that puts it on the surface. With
    /// s = t / e_min², r_i = (e_i/e_min)² and F(s) = Σ (r_i z_i / (s + r_i))², z_i = y_i / e_i, that is F = 1.
    /// F is convex and falls; Newton on 1/√F, which is nearly straight, climbs to the root from below, held in a
    /// bracket by bisection.
    fn closest_in_corner(&self, y: [f64; D]) -> [f64; D] {
        let e = self.semi_axes;
        let smallest = self.smallest();
        // Of equally short axes, the one along which `y` is farthest.
        let short = (0..D).fold(None::<usize>, |found, k| match found {
            _ if e[k] > smallest => found,
            Some(other) if y[other] >= y[k] => found,
            _ => Some(k),
        });
        let short = short.unwrap_or(0);
        let r: [f64; D] = std::array::from_fn(|k| (e[k] / smallest) * (e[k] / smallest));
        let rz: [f64; D] = std::array::from_fn(|k| r[k] * (y[k] / e[k]));
        let sums = |s: f64| {
            let (mut f, mut slope) = (0.0, 0.0);
            for k in 0..D {
                if rz[k] > 0.0 {
                    let part = rz[k] / (s + r[k]);
                    f += part * part;
                    slope += part * part / (s + r[k]);
                }
            }
            (f, slope)
        };
        let mut low = -1.0 + rz[short];
        if rz[short] == 0.0 && sums(-1.0).0 <= 1.0 {
            // On the far side of the focal curve: the closest point leaves the plane of symmetry.
            let mut x: [f64; D] = std::array::from_fn(|k| {
                if rz[k] > 0.0 {
                    e[k] * rz[k] / (r[k] - 1.0)
                } else {
                    0.0
                }
            });
            let mut rest = 1.0;
            for k in 0..D {
                rest -= (x[k] / e[k]) * (x[k] / e[k]);
            }
            x[short] = smallest * rest.max(0.0).sqrt();
            return x;
        }
        let mut high = -1.0 + point::norm(rz).max(rz[short]);
        let mut s = low;
        for _ in 0..MAX_STEPS {
            let (f, slope) = sums(s);
            if f >= 1.0 {
                low = s;
            } else {
                high = s;
            }
            let root = f.sqrt();
            let mut next = s + (root - 1.0) * f / slope;
            if !(next > low && next < high) {
                next = 0.5 * (low + high);
            }
            if (next - s).abs() <= f64::EPSILON * (1.0 + s).abs() || next == low || next == high {
                break;
            }
            s = next;
        }
        std::array::from_fn(|k| {
            if rz[k] > 0.0 {
                e[k] * rz[k] / (s + r[k])
            } else {
                0.0
            }
        })
    }
}

impl<const D: usize> Surface<D> for Ellipsoid<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        let from = point::sub(p, self.center);
        let x = self.closest_in_corner(from.map(f64::abs));
        let x: [f64; D] = std::array::from_fn(|k| x[k].copysign(from[k]));
        let gradient: [f64; D] =
            std::array::from_fn(|k| x[k] / self.semi_axes[k] / self.semi_axes[k]);
        let distance = point::distance(from, x);
        Closest {
            point: point::add(self.center, x),
            normal: point::unit(gradient).unwrap_or(gradient),
            distance: if self.inside(p) { -distance } else { distance },
            feature: Feature::Smooth,
        }
    }

    fn inside(&self, p: [f64; D]) -> bool {
        let from = point::sub(p, self.center);
        let mut sum = 0.0;
        for k in 0..D {
            sum += (from[k] / self.semi_axes[k]) * (from[k] / self.semi_axes[k]);
        }
        sum < 1.0
    }

    fn measure(&self) -> f64 {
        self.measure
    }

    fn volume(&self) -> f64 {
        let unit = if D == 2 { PI } else { 4.0 * PI / 3.0 };
        unit * self.semi_axes.iter().product::<f64>()
    }

    fn moments(&self) -> Option<Moments<D>> {
        let volume = self.volume();
        let along = self.semi_axes.map(|a| volume * a * a / (D as f64 + 2.0));
        Some(Moments::along_axes(volume, self.center, along))
    }

    fn bounds(&self) -> Bounds<D> {
        Bounds::new(
            point::sub(self.center, self.semi_axes),
            point::add(self.center, self.semi_axes),
        )
    }

    fn features(&self) -> Features<D> {
        Features {
            corners: Vec::new(),
            edges: Vec::new(),
        }
    }

    fn scatter(&self, count: usize) -> Vec<Closest<D>> {
        self.scattered(count)
    }

    /// The level set φ = −`depth`. Its length or area and its content follow Steiner's formulas, exact while the
    /// depth stays below the smallest radius of curvature, and are integrated numerically beyond.
    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        let (smallest, largest) = (self.smallest(), self.largest());
        if depth >= smallest {
            return Err(InsetError::Vanished { depth }.into());
        }
        let body: Arc<dyn Surface<D>> = Arc::new(*self);
        if depth > smallest * smallest / largest {
            return Ok(Arc::new(LevelInset::new(body, depth)?));
        }
        let (l, v, m) = (self.measure, self.volume(), self.mean_curvature);
        let (measure, volume) = if D == 2 {
            (l - TAU * depth, v - depth * (l - PI * depth))
        } else {
            let k = 4.0 * PI;
            (
                l - depth * (2.0 * m - k * depth),
                v - depth * (l - depth * (m - k * depth / 3.0)),
            )
        };
        Ok(Arc::new(LevelInset::with_contents(
            body, depth, measure, volume,
        )?))
    }
}

/// Length or area of the ellipsoid and, in 3-D, the integral of its mean curvature, which is that of its support
/// function h(u) = |(e_1 u_1, …)| over the unit sphere (Minkowski); in 2-D that integral is the length (Cauchy). The
/// trapezoidal rule converges exponentially around the period, Gauss's rule with 5 nodes in 64 strips across.
fn integrals<const D: usize>(e: [f64; D]) -> (f64, f64) {
    const AROUND: usize = 1024;
    if D == 2 {
        let mut sum = 0.0;
        for i in 0..4 * AROUND {
            let (sin, cos) = (TAU * i as f64 / (4 * AROUND) as f64).sin_cos();
            sum += (e[0] * cos).hypot(e[1] * sin);
        }
        return (sum * TAU / (4 * AROUND) as f64, 0.0);
    }
    if D != 3 {
        return (f64::NAN, f64::NAN);
    }
    const STRIPS: usize = 32;
    // A quarter turn, both ends at half weight, by symmetry.
    const QUARTER: usize = 64;
    let (mut area, mut support) = (0.0, 0.0);
    for strip in 0..STRIPS {
        for (node, weight) in gauss::FIVE {
            // From the equator to the pole, by symmetry.
            let angle = 0.25 * PI * (2.0 * strip as f64 + 1.0 + node) / STRIPS as f64;
            let (z, r) = angle.sin_cos();
            for i in 0..=QUARTER {
                let end = if i == 0 || i == QUARTER { 0.5 } else { 1.0 };
                let (sin, cos) = (0.5 * PI * i as f64 / QUARTER as f64).sin_cos();
                let u = [r * cos, r * sin, z];
                let w = weight * end * r;
                area += w
                    * (e[1] * e[2] * u[0])
                        .hypot(e[0] * e[2] * u[1])
                        .hypot(e[0] * e[1] * u[2]);
                support += w * (e[0] * u[0]).hypot(e[1] * u[1]).hypot(e[2] * u[2]);
            }
        }
    }
    // Eight octants; steps of (π/4 / STRIPS per unit node) and (π/2 / QUARTER).
    let step = 8.0 * (0.25 * PI / STRIPS as f64) * (0.5 * PI / QUARTER as f64);
    (area * step, support * step)
}
