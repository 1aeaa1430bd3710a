//! A surface that remembers what is dear to find: insets, and points spread evenly.

use std::sync::{Arc, Mutex, PoisonError};

use sphpack_geometry::{Closest, Features, GeometryError, Moments, Surface};
use sphpack_neighbors::{Bounds, Domain};

/// Answers by what was asked for.
type Answers<K, T> = Mutex<Vec<(K, T)>>;

/// A surface of which every inset and every number of points is found once. Packing one part with hundreds of counts asks
/// for the same ones each time: in a starfish of 3 ∆s (`cargo xtask fuzz --scenes 5000 --seed 1 --number 4060`) that was most of the time.
#[derive(Debug)]
pub(super) struct Remembered<const D: usize> {
    surface: Arc<dyn Surface<D>>,
    insets: Answers<u64, Arc<dyn Surface<D>>>,
    samples: Answers<usize, Vec<Closest<D>>>,
}

impl<const D: usize> Remembered<D> {
    /// The surface, which answers as before.
    pub(super) fn new(surface: Arc<dyn Surface<D>>) -> Self {
        Self {
            surface,
            insets: Mutex::default(),
            samples: Mutex::default(),
        }
    }
}

/// What was found before, or what is found now. Errors are not kept.
fn once<K: PartialEq, T: Clone>(
    known: &Answers<K, T>,
    asked: K,
    find: impl FnOnce() -> Result<T, GeometryError>,
) -> Result<T, GeometryError> {
    // Every push is whole: what a panic elsewhere left behind can be read.
    let of = |known: &[(K, T)]| {
        (known.iter().find(|(key, _)| *key == asked)).map(|(_, answer)| answer.clone())
    };
    if let Some(answer) = of(&known.lock().unwrap_or_else(PoisonError::into_inner)) {
        return Ok(answer);
    }
    // Found without the lock: whoever finds it uses several threads.
    let answer = find()?;
    (known.lock().unwrap_or_else(PoisonError::into_inner)).push((asked, answer.clone()));
    Ok(answer)
}

impl<const D: usize> Surface<D> for Remembered<D> {
    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        once(&self.insets, depth.to_bits(), || {
            let inset: Arc<dyn Surface<D>> = Arc::new(Self::new(self.surface.inset(depth)?));
            Ok(inset)
        })
    }

    fn sample(&self, count: usize) -> Result<Vec<Closest<D>>, GeometryError> {
        once(&self.samples, count, || self.surface.sample(count))
    }

    fn closest(&self, p: [f64; D]) -> Closest<D> {
        self.surface.closest(p)
    }

    fn closest_within(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
        self.surface.closest_within(p, radius)
    }

    fn inside(&self, p: [f64; D]) -> bool {
        self.surface.inside(p)
    }

    fn measure(&self) -> f64 {
        self.surface.measure()
    }

    fn volume(&self) -> f64 {
        self.surface.volume()
    }

    fn moments(&self) -> Option<Moments<D>> {
        self.surface.moments()
    }

    fn bounds(&self) -> Bounds<D> {
        self.surface.bounds()
    }

    fn features(&self) -> Features<D> {
        self.surface.features()
    }

    fn window(&self) -> Option<Domain<D>> {
        self.surface.window()
    }

    fn parts(&self) -> Vec<Arc<dyn Surface<D>>> {
        self.surface.parts()
    }

    fn scatter(&self, count: usize) -> Vec<Closest<D>> {
        self.surface.scatter(count)
    }

    fn closest_batch(&self, points: &[[f64; D]], radius: f64) -> Vec<Option<Closest<D>>> {
        self.surface.closest_batch(points, radius)
    }

    fn inside_batch(&self, points: &[[f64; D]]) -> Vec<bool> {
        self.surface.inside_batch(points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sphpack_geometry::{InsetError, Outline};

    /// A square that is found too thin for every inset after the first.
    #[derive(Debug)]
    struct OnceOnly(Outline, Mutex<usize>);

    impl Surface<2> for OnceOnly {
        fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<2>>, GeometryError> {
            let mut asked = self.1.lock().expect("nobody panics");
            *asked += 1;
            if *asked > 1 {
                return Err(InsetError::Vanished { depth }.into());
            }
            self.0.inset(depth)
        }

        fn closest(&self, p: [f64; 2]) -> Closest<2> {
            self.0.closest(p)
        }

        fn inside(&self, p: [f64; 2]) -> bool {
            self.0.inside(p)
        }

        fn measure(&self) -> f64 {
            self.0.measure()
        }

        fn volume(&self) -> f64 {
            self.0.volume()
        }

        fn bounds(&self) -> Bounds<2> {
            self.0.bounds()
        }

        fn features(&self) -> Features<2> {
            self.0.features()
        }
    }

    #[test]
    fn an_inset_is_found_once_and_errors_every_time() {
        let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]].to_vec();
        let square = Outline::new(vec![square]).expect("a square");
        let remembered = Remembered::new(Arc::new(OnceOnly(square.clone(), Mutex::new(0))));
        for _ in 0..3 {
            let inset = remembered.inset(0.5).expect("remembered");
            assert_eq!(
                inset.volume(),
                square.inset(0.5).expect("an inset").volume()
            );
            for _ in 0..2 {
                let points = inset.sample(8).expect("points");
                assert_eq!(points.len(), 8);
            }
        }
        for _ in 0..2 {
            assert!(remembered.inset(0.6).is_err());
        }
    }
}
