//! Outlines given by a formula.

use std::f64::consts::{PI, TAU};

use super::Outline;
use super::naca::NacaSection;
use crate::sampling::{extent, nodes};
use crate::{GeometryError, ParameterError};

impl Outline {
    /// r(θ) = `radius` (1 + `amplitude` cos(`arms` θ)) about `center`: the starfish of Negi & Ramachandran (2021), fig. 17
    /// (the papers give no formula; this one matches their pictures with amplitude 0.25 and 5 arms). Sampled within
    /// [`SAGITTA_OVER_SIZE`](crate::SAGITTA_OVER_SIZE) of its size.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless radius > 0, 0 ≤ amplitude < 1 and 1 ≤ arms ≤ 1000.
    pub fn starfish(
        center: [f64; 2],
        radius: f64,
        amplitude: f64,
        arms: u32,
    ) -> Result<Self, GeometryError> {
        ParameterError::check_finite("starfish", "center", center)?;
        ParameterError::check_positive("starfish", "radius", radius)?;
        if !(0.0..1.0).contains(&amplitude) {
            return Err(ParameterError::OutOfRange {
                of: "starfish",
                name: "amplitude",
                value: amplitude,
                needs: "at least 0 and below 1",
            }
            .into());
        }
        if !(1..=1000).contains(&arms) {
            return Err(ParameterError::OutOfRange {
                of: "starfish",
                name: "arms",
                value: f64::from(arms),
                needs: "1 to 1000",
            }
            .into());
        }
        let at = |angle: f64| {
            let r = radius * (1.0 + amplitude * (f64::from(arms) * angle).cos());
            [center[0] + r * angle.cos(), center[1] + r * angle.sin()]
        };
        // One arm at a time, so that every tip is a node.
        let mut points = Vec::new();
        for arm in 0..arms {
            let turn = |k: u32| TAU * f64::from(k) / f64::from(arms);
            points.extend(nodes(at, turn(arm), turn(arm + 1), 2.0 * radius));
            points.pop();
        }
        Self::polygon(&points)
    }

    /// The ellipse with `semi_axes` along the axes about `center`, scene units. Sampled within
    /// [`SAGITTA_OVER_SIZE`](crate::SAGITTA_OVER_SIZE) of its size; [`Ellipsoid`](crate::Ellipsoid) and
    /// [`Ball`](crate::Ball) are exact, but cannot be cut.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless the semi-axes are positive and finite and the centre is finite.
    pub fn ellipse(center: [f64; 2], semi_axes: [f64; 2]) -> Result<Self, GeometryError> {
        ParameterError::check_finite("ellipse", "center", center)?;
        for length in semi_axes {
            ParameterError::check_positive("ellipse", "semi_axes", length)?;
        }
        let at = |angle: f64| {
            [
                center[0] + semi_axes[0] * angle.cos(),
                center[1] + semi_axes[1] * angle.sin(),
            ]
        };
        let mut points = nodes(at, 0.0, TAU, 2.0 * semi_axes[0].max(semi_axes[1]));
        points.pop();
        Self::polygon(&points)
    }

    /// The NACA airfoil `digits` with its leading edge at the origin and its chord of length `chord` (scene units)
    /// along +x: of four digits ("0015", "2412"), of five ("23012"; "23112" with a reflexed mean line), each of them also
    /// with a modified thickness ("0012-64": 6 for the nose's radius, of 0 to 9, and 4 for the place of the greatest
    /// thickness, of 2 to 6 tenths). The trailing edge is closed (last coefficient −0.1036) and its only corner. Sampled
    /// within [`SAGITTA_OVER_SIZE`](crate::SAGITTA_OVER_SIZE) of the chord.
    ///
    /// ```
    /// use sphpack_geometry::{Outline, Surface};
    /// let thickest = |name: &str| Outline::naca(name, 1.0).map(|wing| wing.bounds().max[1]);
    /// assert!((thickest("0012-64")? - 0.06).abs() < 1e-6);
    /// assert!(thickest("23012")? > 0.06);
    /// # Ok::<(), sphpack_geometry::GeometryError>(())
    /// ```
    ///
    /// # Errors
    /// [`ParameterError::BadNaca`] for any other name, [`GeometryError::Parameter`] for a bad chord.
    pub fn naca(digits: &str, chord: f64) -> Result<Self, GeometryError> {
        ParameterError::check_positive("naca", "chord", chord)?;
        let foil = NacaSection::named(digits)?;
        let at = |angle: f64| {
            let [x, y] = foil.at(angle);
            [chord * x, chord * y]
        };
        let mut points = nodes(at, 0.0, PI, chord);
        points.pop();
        points.extend(nodes(at, PI, TAU, chord));
        points.pop();
        Self::polygon(&points)
    }

    /// A wall whose upper side is a triangular wave: the zig-zag of Negi & Ramachandran (2021), figs. 14–16. The body fills
    /// −`width`/2 ≤ x ≤ `width`/2 from y = −`height` up to the wave, which swings by ±`amplitude` about y = 0 in
    /// `teeth` whole periods, rising first from the right; all scene units. `zigzag(2.0, 1.0, 0.25, 2)` has right
    /// angles at its teeth both ways.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless the lengths are positive, amplitude < height, and 1 ≤ teeth ≤ 10⁶.
    pub fn zigzag(
        width: f64,
        height: f64,
        amplitude: f64,
        teeth: u32,
    ) -> Result<Self, GeometryError> {
        ParameterError::check_positive("zigzag", "width", width)?;
        ParameterError::check_positive("zigzag", "height", height)?;
        ParameterError::check_positive("zigzag", "amplitude", amplitude)?;
        if amplitude >= height {
            return Err(ParameterError::OutOfRange {
                of: "zigzag",
                name: "amplitude",
                value: amplitude,
                needs: "smaller than the height",
            }
            .into());
        }
        if !(1..=1_000_000).contains(&teeth) {
            return Err(ParameterError::OutOfRange {
                of: "zigzag",
                name: "teeth",
                value: f64::from(teeth),
                needs: "1 to 1000000",
            }
            .into());
        }
        let right = 0.5 * width;
        let mut points = vec![[-right, -height], [right, -height], [right, 0.0]];
        let period = width / f64::from(teeth);
        for tooth in 0..teeth {
            let start = right - f64::from(tooth) * period;
            points.push([start - 0.25 * period, amplitude]);
            points.push([start - 0.75 * period, -amplitude]);
        }
        points.push([-right, 0.0]);
        Self::polygon(&points)
    }
}

impl Outline {
    /// The larger side of the box around it.
    pub(super) fn extent(&self) -> f64 {
        extent(&self.points)
    }
}
