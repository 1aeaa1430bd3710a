//! Bodies that go on beyond the sides of a box.

mod features;
mod mesh;
mod outline;
mod window;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use sphpack_neighbors::{Bounds, Domain, Odometer, point};

use crate::sample::Candidates;
use crate::surface::{Closest, Features, Surface};
use crate::{GeometryError, InsetError};

/// Coordinates within this of a box's side, in parts of the greatest coordinate or size, are on it: single precision.
const FLUSH: f64 = 1e-6;

/// What of a body lies in a box, where the box's sides are no surface of it: whoever asks what is near, or inside, sees the
/// body go on beyond them.
///
/// Beyond an open side it goes on as it is, or, where it has a face on the side, straight on. Beyond a periodic side its
/// images go on, joined with it. Size, box, corners, edges and points (measure, volume, bounds, features, samples) are those
/// of what lies within the box; what passes a side ends there without a corner. A place may lie anywhere beyond a
/// periodic side, and should be within the box else.
///
/// ```
/// use sphpack_geometry::{Outline, Surface};
/// use sphpack_neighbors::Domain;
/// let channel = Domain::new([0.0, 0.0], [4.0, 2.0]).with_periodic([true, false]);
/// let floor = Outline::polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 0.5], [0.0, 0.5]])?;
/// let floor = floor.continued(&channel).expect("has faces on sides of the box");
/// assert!((floor.measure() - 4.0).abs() < 1e-12 && (floor.volume() - 2.0).abs() < 1e-12);
/// assert!(floor.features().corners.is_empty());
/// assert!((floor.closest([0.0, 0.0]).distance + 0.5).abs() < 1e-12);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Continued<const D: usize> {
    whole: Arc<dyn Whole<D>>,
    domain: Domain<D>,
    bounds: Bounds<D>,
    measure: f64,
    volume: f64,
}

/// A body beyond a box too, and what is asked of the part in the box.
pub(crate) trait Whole<const D: usize>: Surface<D> {
    /// Length or area of the surface, and area or volume of the body, within the box.
    fn contents(&self, domain: &Domain<D>) -> (f64, f64);

    /// The surface moved inward.
    fn moved_in(&self, depth: f64) -> Result<Arc<dyn Whole<D>>, GeometryError>;

    /// The connected parts that the box has room for; images of each other are one.
    fn parts_in(&self, domain: &Domain<D>) -> Vec<Arc<dyn Whole<D>>>;

    /// [`Surface::features`] within the box.
    fn features_in(&self, domain: &Domain<D>) -> Features<D>;

    /// [`Surface::scatter`] within the box.
    fn scattered_in(&self, domain: &Domain<D>, count: usize) -> Candidates<D>;

    /// [`Surface::sample`] within the box, of which `surface` is the part.
    fn sample_in(
        &self,
        surface: &Continued<D>,
        count: usize,
    ) -> Result<Vec<Closest<D>>, GeometryError>;
}

impl<const D: usize> Continued<D> {
    pub(crate) fn new(whole: Arc<dyn Whole<D>>, domain: &Domain<D>) -> Self {
        let (measure, volume) = whole.contents(domain);
        let (around, sides) = (whole.bounds(), domain.bounds);
        let bounds = Bounds::new(
            std::array::from_fn(|k| around.min[k].max(sides.min[k])),
            std::array::from_fn(|k| around.max[k].min(sides.max[k])),
        );
        Self {
            whole,
            domain: *domain,
            bounds,
            measure: measure.max(0.0),
            volume: volume.max(0.0),
        }
    }

    /// Whether a body so placed may go on beyond sides of the box: it reaches an open one, or is as long as a period. (One that only
    /// passes a periodic side, and is shorter, may as well be [`Repeated`](crate::Repeated).)
    pub fn may_go_on(bounds: &Bounds<D>, domain: &Domain<D>) -> bool {
        let slack = slack(domain);
        let (_, bounds) = into(*bounds, domain);
        (0..D).any(|axis| {
            if domain.periodic[axis] {
                Reach::of(&bounds, domain, axis).periods > 0
            } else {
                bounds.min[axis] <= domain.bounds.min[axis] + slack
                    || bounds.max[axis] >= domain.bounds.max[axis] - slack
            }
        })
    }

    /// What the whole body answers to a place, carried to it.
    fn carried(
        &self,
        p: [f64; D],
        ask: impl Fn([f64; D]) -> Option<Closest<D>>,
    ) -> Option<Closest<D>> {
        let wrapped = self.domain.wrap(p);
        let back = point::sub(p, wrapped);
        ask(wrapped).map(|hit| Closest {
            point: point::add(hit.point, back),
            ..hit
        })
    }
}

impl<const D: usize> Surface<D> for Continued<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        self.carried(p, |p| Some(self.whole.closest(p)))
            .unwrap_or_else(|| self.whole.closest(p))
    }

    fn closest_within(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
        self.carried(p, |p| self.whole.closest_within(p, radius))
    }

    fn inside(&self, p: [f64; D]) -> bool {
        self.whole.inside(self.domain.wrap(p))
    }

    fn measure(&self) -> f64 {
        self.measure
    }

    fn volume(&self) -> f64 {
        self.volume
    }

    fn bounds(&self) -> Bounds<D> {
        self.bounds
    }

    fn features(&self) -> Features<D> {
        self.whole.features_in(&self.domain)
    }

    fn window(&self) -> Option<Domain<D>> {
        Some(self.domain)
    }

    fn parts(&self) -> Vec<Arc<dyn Surface<D>>> {
        (self.whole.parts_in(&self.domain).into_iter())
            .map(|part| Arc::new(Self::new(part, &self.domain)) as Arc<dyn Surface<D>>)
            .collect()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        let moved = Self::new(self.whole.moved_in(depth)?, &self.domain);
        if moved.volume > 0.0 {
            Ok(Arc::new(moved))
        } else {
            Err(InsetError::Vanished { depth }.into())
        }
    }

    fn sample(&self, count: usize) -> Result<Vec<Closest<D>>, GeometryError> {
        self.whole.sample_in(self, count)
    }

    fn scatter(&self, count: usize) -> Vec<Closest<D>> {
        self.whole.scattered_in(&self.domain, count).hits()
    }
}

/// How often a point is moved along a surface into a box.
const TRIES: usize = 20;

/// The surface's point nearest to `hit` within the open sides of a box beyond which it goes on, or nearly: Newton's method along the
/// surface, one step where it is flat. `hit` itself where it is within, or the surface runs along the side.
pub fn within_window<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    window: &Domain<D>,
    hit: Closest<D>,
) -> Closest<D> {
    let mut found = hit;
    for _ in 0..TRIES {
        let kept = window.clamp(found.point);
        let Some(axis) = (0..D).find(|&k| kept[k] != found.point[k]) else {
            break;
        };
        let across = std::array::from_fn(|k| f64::from(u8::from(k == axis)));
        let along = point::reject(across, found.normal);
        let slope = point::norm_squared(along);
        if slope < 1e-6 {
            break;
        }
        let step = (kept[axis] - found.point[axis]) / slope;
        let mut next = point::add_scaled(found.point, step, along);
        next[axis] = kept[axis];
        let there = surface.closest(next);
        // Rounding must not send it out again for ever.
        let near = point::distance(there.point, next) <= 1e-9 * window.bounds.diagonal();
        found = if near {
            Closest {
                point: next,
                ..there
            }
        } else {
            there
        };
    }
    found
}

/// Images of a body are joined up to so many periods away: one that is longer than twice that is not whole.
const MOST_PERIODS: f64 = 64.0;

/// How a body lies to the two sides of an axis.
#[derive(Debug, Clone, Copy)]
struct Reach {
    /// Whether it passes the lower, the upper side.
    passes: [bool; 2],
    /// How many periods away its images may meet it; 0 where they do not, and on an open axis.
    periods: usize,
}

impl Reach {
    fn of<const D: usize>(bounds: &Bounds<D>, domain: &Domain<D>, axis: usize) -> Self {
        let (slack, sides) = (slack(domain), &domain.bounds);
        let passes = [
            bounds.min[axis] < sides.min[axis] - slack,
            bounds.max[axis] > sides.max[axis] + slack,
        ];
        let (size, period) = (bounds.size()[axis], sides.size()[axis]);
        let meets = domain.periodic[axis] && size > period - slack;
        let periods = if meets {
            // Half a period beyond both sides is covered, wherever in the box the middle is.
            let periods = (0.5 + 0.5 * (size - 2.0 * slack) / period).ceil();
            periods.clamp(1.0, MOST_PERIODS) as usize
        } else {
            0
        };
        Self { passes, periods }
    }
}

/// The whole periods that carry the middle of a body into the box, and its box there.
fn into<const D: usize>(bounds: Bounds<D>, domain: &Domain<D>) -> ([f64; D], Bounds<D>) {
    let slack = slack(domain);
    // One whose middle is on the upper side by rounding stays.
    let middle = bounds.center().map(|x| x + slack);
    let shift = domain.whole_periods(middle);
    let moved = Bounds::new(point::add(bounds.min, shift), point::add(bounds.max, shift));
    (shift, moved)
}

/// How far from a side of the box a coordinate may be to be on it, scene units.
fn slack<const D: usize>(domain: &Domain<D>) -> f64 {
    let Bounds { min, max } = domain.bounds;
    let greatest = (min.iter().chain(&max)).fold(0.0, |most: f64, x| most.max(x.abs()));
    let size = domain.bounds.size();
    FLUSH * size.iter().fold(greatest, |most, x| most.max(*x))
}

/// A place whose coordinates within `slack` of the box's sides are on them.
fn snapped<const D: usize>(mut p: [f64; D], domain: &Domain<D>, slack: f64) -> [f64; D] {
    for k in 0..D {
        for side in [domain.bounds.min[k], domain.bounds.max[k]] {
            if (p[k] - side).abs() <= slack {
                p[k] = side;
            }
        }
    }
    p
}

/// A coordinate moved by so many periods; sides of images that meet meet to the last digit.
fn moved_by(x: f64, step: i32, [min, max]: [f64; 2]) -> f64 {
    let periods = |count: i32| f64::from(count) * (max - min);
    if step > 0 && x == min {
        max + periods(step - 1)
    } else if step < 0 && x == max {
        min + periods(step + 1)
    } else {
        x + periods(step)
    }
}

/// Pieces within the box with less room than this, in parts of the box's, are none.
const NOTHING: f64 = 1e-12;

/// The pieces that the box has room for, and their numbers, images of each other together.
fn parts_by_images<const D: usize, W: Whole<D>>(
    pieces: Vec<W>,
    domain: &Domain<D>,
) -> (Vec<W>, Vec<Vec<usize>>) {
    let nothing = NOTHING * domain.bounds.volume();
    let mut parts = pieces;
    parts.retain(|part| part.contents(domain).1 > nothing);
    let slack = 10.0 * slack(domain);
    let groups = groups_of_images(parts.len(), domain, |a, b, shift| {
        let (a, b) = (&parts[a], &parts[b]);
        is_moved(&a.bounds(), &b.bounds(), shift, slack)
            && (a.volume() - b.volume()).abs() <= slack * (a.measure() + b.measure())
    });
    (parts, groups)
}

/// Numbers of things, those that are images of each other together: `image(a, b, shift)` tells whether `b` is `a` moved by
/// `shift`.
fn groups_of_images<const D: usize>(
    count: usize,
    domain: &Domain<D>,
    image: impl Fn(usize, usize, [f64; D]) -> bool,
) -> Vec<Vec<usize>> {
    let size = domain.bounds.size();
    let steps = domain.periodic.map(i64::from);
    let shifts: Vec<[f64; D]> = Odometer::new(steps.map(|n| -n), steps.map(|n| n + 1))
        .map(|step| std::array::from_fn(|k| step[k] as f64 * size[k]))
        .collect();
    let mut first: Vec<usize> = (0..count).collect();
    for a in 0..count {
        for b in a + 1..count {
            if shifts.iter().any(|&shift| image(a, b, shift)) {
                let (low, high) = (first[a].min(first[b]), first[a].max(first[b]));
                for f in &mut first {
                    if *f == high {
                        *f = low;
                    }
                }
            }
        }
    }
    let mut groups: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (i, f) in first.into_iter().enumerate() {
        groups[f].push(i);
    }
    groups.retain(|group| !group.is_empty());
    groups
}

/// Whether one box is another moved by `shift`, to `slack`.
fn is_moved<const D: usize>(a: &Bounds<D>, b: &Bounds<D>, shift: [f64; D], slack: f64) -> bool {
    (0..D).all(|k| {
        (a.min[k] + shift[k] - b.min[k]).abs() <= slack
            && (a.max[k] + shift[k] - b.max[k]).abs() <= slack
    })
}
