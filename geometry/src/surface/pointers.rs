//! What points to a surface is one: `&T`, `Box<T>`, `Arc<T>`, of one kind or `dyn`.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, Domain};

use super::{Closest, Features, Surface};
use crate::{GeometryError, Moments};

macro_rules! passed_on {
    ($($pointer:ty)*) => {
        $(
            impl<S: Surface<D> + ?Sized, const D: usize> Surface<D> for $pointer {
                fn closest(&self, p: [f64; D]) -> Closest<D> {
                    (**self).closest(p)
                }

                fn closest_within(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
                    (**self).closest_within(p, radius)
                }

                fn inside(&self, p: [f64; D]) -> bool {
                    (**self).inside(p)
                }

                fn measure(&self) -> f64 {
                    (**self).measure()
                }

                fn volume(&self) -> f64 {
                    (**self).volume()
                }

                fn moments(&self) -> Option<Moments<D>> {
                    (**self).moments()
                }

                fn bounds(&self) -> Bounds<D> {
                    (**self).bounds()
                }

                fn features(&self) -> Features<D> {
                    (**self).features()
                }

                fn window(&self) -> Option<Domain<D>> {
                    (**self).window()
                }

                fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
                    (**self).inset(depth)
                }

                fn parts(&self) -> Vec<Arc<dyn Surface<D>>> {
                    (**self).parts()
                }

                fn sample(&self, count: usize) -> Result<Vec<Closest<D>>, GeometryError> {
                    (**self).sample(count)
                }

                fn scatter(&self, count: usize) -> Vec<Closest<D>> {
                    (**self).scatter(count)
                }

                fn closest_batch(&self, points: &[[f64; D]], radius: f64) -> Vec<Option<Closest<D>>> {
                    (**self).closest_batch(points, radius)
                }

                fn inside_batch(&self, points: &[[f64; D]]) -> Vec<bool> {
                    (**self).inside_batch(points)
                }
            }
        )*
    };
}

passed_on! { &S Box<S> Arc<S> }

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Feature;
    use crate::InsetError;

    /// A surface whose every answer is its own: none is what an interface without it would say.
    #[derive(Debug)]
    struct Odd;

    const HIT: Closest<2> = Closest {
        point: [1.0, 2.0],
        normal: [0.6, 0.8],
        distance: 7.0,
        feature: Feature::Corner,
    };

    impl Surface<2> for Odd {
        fn closest(&self, _: [f64; 2]) -> Closest<2> {
            HIT
        }

        fn closest_within(&self, _: [f64; 2], radius: f64) -> Option<Closest<2>> {
            (radius < 1.0).then_some(HIT)
        }

        fn inside(&self, p: [f64; 2]) -> bool {
            p[0] > 3.0
        }

        fn measure(&self) -> f64 {
            11.0
        }

        fn volume(&self) -> f64 {
            13.0
        }

        fn bounds(&self) -> Bounds<2> {
            Bounds::new([-1.0, -2.0], [3.0, 4.0])
        }

        fn features(&self) -> Features<2> {
            Features {
                corners: vec![[5.0, 6.0]],
                edges: Vec::new(),
            }
        }

        fn window(&self) -> Option<Domain<2>> {
            Some(Domain::new([0.0; 2], [8.0; 2]))
        }

        fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<2>>, GeometryError> {
            Err(InsetError::Vanished { depth }.into())
        }

        fn parts(&self) -> Vec<Arc<dyn Surface<2>>> {
            vec![Arc::new(Self), Arc::new(Self)]
        }

        fn sample(&self, count: usize) -> Result<Vec<Closest<2>>, GeometryError> {
            Ok(vec![HIT; count + 1])
        }

        fn scatter(&self, count: usize) -> Vec<Closest<2>> {
            vec![HIT; count + 2]
        }

        fn closest_batch(&self, points: &[[f64; 2]], _: f64) -> Vec<Option<Closest<2>>> {
            vec![Some(HIT); points.len() + 3]
        }

        fn moments(&self) -> Option<Moments<2>> {
            Some(Moments::along_axes(13.0, [0.5, 0.0], [3.0, 4.0]))
        }

        fn inside_batch(&self, points: &[[f64; 2]]) -> Vec<bool> {
            vec![true; points.len() + 4]
        }
    }

    fn check(surface: impl Surface<2>) {
        assert_eq!(surface.closest([0.0; 2]), HIT);
        assert_eq!(surface.closest_within([0.0; 2], 0.5), Some(HIT));
        assert_eq!(surface.closest_within([0.0; 2], 50.0), None);
        assert!(surface.inside([4.0, 0.0]) && !surface.inside([2.0, 0.0]));
        assert_eq!([surface.measure(), surface.volume()], [11.0, 13.0]);
        assert_eq!(surface.bounds(), Odd.bounds());
        assert_eq!(surface.moments(), Odd.moments());
        assert_eq!(surface.features(), Odd.features());
        assert_eq!(surface.window(), Odd.window());
        let inset = surface.inset(0.5).map(|_| ());
        assert_eq!(
            inset,
            Err(GeometryError::Inset(InsetError::Vanished { depth: 0.5 }))
        );
        assert_eq!(surface.parts().len(), 2);
        assert_eq!(surface.sample(20), Ok(vec![HIT; 21]));
        assert_eq!(surface.scatter(20), vec![HIT; 22]);
        assert_eq!(surface.closest_batch(&[[0.0; 2]; 5], 1.0).len(), 8);
        assert_eq!(surface.inside_batch(&[[0.0; 2]; 5]).len(), 9);
    }

    #[test]
    fn pointers_pass_every_question_on() {
        check(Odd);
        check(&Odd);
        check(Box::new(Odd));
        check(Arc::new(Odd));
        let shared: Arc<dyn Surface<2>> = Arc::new(Odd);
        check(shared.as_ref());
        check(&shared);
        check(shared);
        let boxed: Box<dyn Surface<2>> = Box::new(Odd);
        check(boxed);
    }
}
