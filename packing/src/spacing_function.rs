//! A field of spacings given as a function.

use std::fmt;

use crate::resolution::{Spacing, SpacingField};

/// A function that says the spacing of every place and its gradient, held within a range.
///
/// ```
/// use sphpack_packing::{Balanced, Problem, Spacing, SpacingFunction};
/// use sphpack_geometry::Ball;
///
/// // Four times finer in the middle: ln s is a cosine of the distance.
/// let field = SpacingFunction::new([0.05, 0.2], |p: [f64; 2]| {
///     let r = p[0].hypot(p[1]);
///     let angle = std::f64::consts::PI * r.min(1.0);
///     let value = 0.1 * (-(2.0_f64.ln()) * angle.cos()).exp();
///     let slope = value * 2.0_f64.ln() * angle.sin() * std::f64::consts::PI / r.max(1e-9);
///     Spacing { value, gradient: p.map(|x| slope * x) }
/// });
/// let packed = Problem::around(&Ball::new([0.0; 2], 0.5)?, field).pack(&Balanced::default())?;
/// assert!(packed.quality().density.linf < 0.003);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct SpacingFunction<F> {
    range: [f64; 2],
    of: F,
}

impl<F> SpacingFunction<F> {
    /// What `of` says, no finer and no coarser than `range` (scene units); its gradient there is zero where it is held.
    pub fn new(range: [f64; 2], of: F) -> Self {
        Self { range, of }
    }
}

impl<F> fmt::Debug for SpacingFunction<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [least, most] = self.range;
        write!(f, "SpacingFunction({least} … {most})")
    }
}

impl<const D: usize, F: Fn([f64; D]) -> Spacing<D> + Send + Sync> SpacingField<D>
    for SpacingFunction<F>
{
    fn at(&self, place: [f64; D]) -> Spacing<D> {
        let said = (self.of)(place);
        let [least, most] = self.range;
        if said.value < least || said.value > most {
            Spacing {
                value: said.value.clamp(least, most),
                gradient: [0.0; D],
            }
        } else {
            said
        }
    }

    fn range(&self) -> [f64; 2] {
        self.range
    }
}
