//! Scaling, rotating and moving bodies.

use sphpack_neighbors::point;

use crate::{GeometryError, ParameterError};

/// `x → R (s x) + t`: uniform scaling by `s`, then rotation `R`, then translation `t`, about the origin.
///
/// ```
/// use sphpack_geometry::Similarity;
/// let turn = Similarity::<2>::new(2.0, 90.0, [1.0, 0.0])?;
/// assert_eq!(turn.point([1.0, 0.0]), [1.0, 2.0]);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity<const D: usize> {
    scale: f64,
    /// Rows of the rotation.
    rotation: [[f64; D]; D],
    translation: [f64; D],
}

impl<const D: usize> Similarity<D> {
    /// Leaves everything where it is.
    #[must_use]
    pub fn identity() -> Self {
        Self {
            scale: 1.0,
            rotation: std::array::from_fn(|i| {
                std::array::from_fn(|k| if i == k { 1.0 } else { 0.0 })
            }),
            translation: [0.0; D],
        }
    }

    /// Scaling about the origin.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless `scale` is positive and finite.
    pub fn scaling(scale: f64) -> Result<Self, GeometryError> {
        ParameterError::check_positive("scale", "factor", scale)?;
        Ok(Self {
            scale,
            ..Self::identity()
        })
    }

    /// Translation by `shift`, scene units.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless `shift` is finite.
    pub fn translation(shift: [f64; D]) -> Result<Self, GeometryError> {
        ParameterError::check_finite("translate", "shift", shift)?;
        Ok(Self {
            translation: shift,
            ..Self::identity()
        })
    }

    /// The factor by which lengths grow.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Where the point `x` goes.
    #[inline]
    pub fn point(&self, x: [f64; D]) -> [f64; D] {
        point::add(
            self.direction(point::scale(x, self.scale)),
            self.translation,
        )
    }

    /// Where the point `x` came from.
    #[inline]
    pub fn point_back(&self, x: [f64; D]) -> [f64; D] {
        point::scale(
            self.direction_back(point::sub(x, self.translation)),
            1.0 / self.scale,
        )
    }

    /// The direction `v` rotated; its length stays.
    #[inline]
    pub fn direction(&self, v: [f64; D]) -> [f64; D] {
        std::array::from_fn(|i| point::dot(self.rotation[i], v))
    }

    /// The direction `v` rotated back.
    #[inline]
    pub fn direction_back(&self, v: [f64; D]) -> [f64; D] {
        std::array::from_fn(|k| {
            let mut sum = 0.0;
            for i in 0..D {
                sum += self.rotation[i][k] * v[i];
            }
            sum
        })
    }

    fn checked(
        scale: f64,
        degrees: f64,
        rotation: [[f64; D]; D],
        translation: [f64; D],
    ) -> Result<Self, GeometryError> {
        ParameterError::check_positive("scale", "factor", scale)?;
        ParameterError::check_finite("rotate", "degrees", [degrees])?;
        ParameterError::check_finite("translate", "shift", translation)?;
        Ok(Self {
            scale,
            rotation,
            translation,
        })
    }
}

impl Similarity<2> {
    /// Scale, then rotate counter-clockwise by `degrees`, then translate (scene units).
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] where a number is not finite or the scale not positive.
    pub fn new(scale: f64, degrees: f64, translation: [f64; 2]) -> Result<Self, GeometryError> {
        let (sin, cos) = sin_cos_degrees(degrees);
        Self::checked(scale, degrees, [[cos, -sin], [sin, cos]], translation)
    }
}

impl Similarity<3> {
    /// Scale, then rotate about `axis` by `degrees` (right-hand rule), then translate (scene units).
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] where a number is not finite, the scale not positive, or the axis zero.
    pub fn new(
        scale: f64,
        axis: [f64; 3],
        degrees: f64,
        translation: [f64; 3],
    ) -> Result<Self, GeometryError> {
        let Some([x, y, z]) = point::unit(axis) else {
            return Err(ParameterError::OutOfRange {
                of: "rotate",
                name: "length of axis",
                value: point::norm(axis),
                needs: "positive and finite",
            }
            .into());
        };
        let (s, c) = sin_cos_degrees(degrees);
        let v = 1.0 - c;
        // Rodrigues' formula.
        let rotation = [
            [c + x * x * v, x * y * v - z * s, x * z * v + y * s],
            [y * x * v + z * s, c + y * y * v, y * z * v - x * s],
            [z * x * v - y * s, z * y * v + x * s, c + z * z * v],
        ];
        Self::checked(scale, degrees, rotation, translation)
    }
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90°.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let turn = degrees.rem_euclid(360.0);
    let quarter = (turn / 90.0).round();
    let (s, c) = (turn - 90.0 * quarter).to_radians().sin_cos();
    match quarter as i64 % 4 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}
