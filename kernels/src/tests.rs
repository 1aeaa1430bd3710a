//! Properties that every smoothing kernel has, over random smoothing lengths.

use proptest::prelude::*;
use sphpack_neighbors::gauss;

use crate::{
    Cohesion, CohesionPotential, CohesionProfile, Cubic, Kernel, KernelKind, Profile, Quintic,
    WendlandC2, WendlandC4, WendlandC6, WithKernel,
};

/// Surface of the unit sphere in D dimensions.
fn unit_sphere(dimension: usize) -> f64 {
    use std::f64::consts::PI;
    [2.0, 2.0 * PI, 4.0 * PI][dimension - 1]
}

/// ∫ f(r) dr over [0, end] by composite Gauss–Legendre (5 points), exact for polynomials of degree 9 on each panel.
/// `panels` is chosen so that the kernels' joins fall on panel ends.
fn integral(end: f64, panels: usize, f: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * end / panels as f64;
    (0..panels)
        .flat_map(|panel| {
            let middle = half * (2 * panel + 1) as f64;
            gauss::FIVE.map(|(x, weight)| weight * half * f(middle + half * x))
        })
        .sum()
}

struct Properties {
    dimension: usize,
    at: f64,
}

impl<const D: usize> WithKernel<D> for Properties {
    type Output = Result<(), TestCaseError>;

    fn call<K: Kernel<D>>(self, w: K) -> Self::Output {
        assert_eq!(self.dimension, D, "the caller passes its dimension");
        let (h, end) = (w.smoothing_length(), w.support());
        let volume = |r: f64| unit_sphere(D) * r.powi(D as i32 - 1);

        let one = integral(end, 60, |r| volume(r) * w.value(r));
        prop_assert!((one - 1.0).abs() < 1e-11, "integral {one}");
        // ∫ x·∇W dx = −D: the slope belongs to the value, moment for moment.
        let moment = integral(end, 60, |r| volume(r) * r * w.slope(r));
        prop_assert!((moment + D as f64).abs() < 1e-10, "slope moment {moment}");

        let r = self.at * end;
        prop_assert!(
            w.value(r) > 0.0 && w.slope(r) <= 0.0,
            "positive and falling at {r}"
        );
        prop_assert_eq!(w.value(1.0001 * end), 0.0);
        prop_assert_eq!(w.slope(1.0001 * end), 0.0);
        prop_assert_eq!(w.slope(0.0), 0.0);

        // Monotone: a little farther is never more.
        prop_assert!(w.value(r + 1e-3 * end) <= w.value(r));

        // slope = derivative of value, also straight across the joins.
        let step = 1e-5 * h;
        for r in [r, h, 2.0 * h, 3.0 * h, 0.5 * end, end] {
            if r > step {
                let difference = (w.value(r + step) - w.value(r - step)) / (2.0 * step);
                let bound = 1e-8 * w.value_at_origin() / h;
                prop_assert!(
                    (difference - w.slope(r)).abs() < bound,
                    "slope at {r}: {difference} {}",
                    w.slope(r)
                );
            }
        }
        // Value and slope continue across every join.
        for join in [0.5 * end, h, 2.0 * h, end] {
            let gap = 1e-9 * h;
            let scale = w.value_at_origin();
            prop_assert!((w.value(join + gap) - w.value(join - gap)).abs() < 1e-7 * scale);
            prop_assert!((w.slope(join + gap) - w.slope(join - gap)).abs() < 1e-6 * scale / h);
        }

        // gradient = finite difference of the value; zero at the origin.
        let direction: [f64; D] = std::array::from_fn(|k| [0.6, -0.64, 0.48][k]);
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let x = direction.map(|d| d / length * r);
        let gradient = w.gradient(x);
        for k in 0..D {
            let at = |shift: f64| {
                let mut y = x;
                y[k] += shift;
                w.value(y.iter().map(|v| v * v).sum::<f64>().sqrt())
            };
            let difference = (at(step) - at(-step)) / (2.0 * step);
            prop_assert!((difference - gradient[k]).abs() < 1e-8 * w.value_at_origin() / h);
        }
        prop_assert_eq!(w.gradient([0.0; D]), [0.0; D]);

        // hessian = finite difference of the gradient, away from joins; isotropic at the origin.
        let hessian = w.hessian(x);
        let joins = [0.5 * end, h, 2.0 * h, end];
        let far_from_joins = joins.iter().all(|join| (r - join).abs() > 3.0 * step);
        for k in 0..D {
            let at = |shift: f64| {
                let mut y = x;
                y[k] += shift;
                w.gradient(y)
            };
            let (up, down) = (at(step), at(-step));
            for l in 0..D {
                let difference = (up[l] - down[l]) / (2.0 * step);
                let scale = w.value_at_origin() / (h * h);
                prop_assert!(!far_from_joins || (difference - hessian[k][l]).abs() < 1e-4 * scale);
            }
        }
        prop_assert!(w.hessian([0.0; D])[0][0] <= 0.0);
        // curvature = finite difference of the slope, there too; nothing beyond the support.
        if r > step {
            let difference = (w.slope(r + step) - w.slope(r - step)) / (2.0 * step);
            let scale = w.value_at_origin() / (h * h);
            let off = (difference - w.curvature(r)).abs();
            prop_assert!(!far_from_joins || off < 1e-7 * scale, "curvature at {r}");
        }
        prop_assert_eq!(w.curvature(end + step), 0.0);

        // The pair form says the same as value and slope.
        let (value, slope_over_r) = w.value_and_slope_over_r(r * r);
        prop_assert!((value - w.value(r)).abs() <= 1e-13 * w.value_at_origin());
        prop_assert!((slope_over_r * r - w.slope(r)).abs() <= 1e-12 * w.value_at_origin() / h);
        prop_assert!(w.value_and_slope_over_r(0.0).1.is_finite());

        // Close to the centre slope/r is what it runs to from farther out.
        let over_r = |q: f64| w.value_and_slope_over_r((q * h).powi(2)).1;
        let limit = 2.0 * over_r(3e-4) - over_r(6e-4);
        for q in [1e-12, 1e-8, 1e-6] {
            let off = over_r(q) / limit - 1.0;
            prop_assert!(off.abs() < 2e-5, "slope/r at {q} h is off by {off}");
        }

        // What pair loops take: the scale times the profile.
        let (value, slope) = K::Profile::value_and_slope::<f64, 0>(r, 1.0 / h);
        let slope = K::Profile::SLOPE * slope / h;
        prop_assert!((w.scale() * value - w.value(r)).abs() <= 1e-13 * w.value_at_origin());
        prop_assert!((w.scale() * slope - w.slope(r)).abs() <= 1e-12 * w.value_at_origin() / h);
        later_pieces_are_exact::<K::Profile, D>(r / h)
    }
}

/// Each piece from where it begins, against the first, which is exact everywhere.
fn later_pieces_are_exact<P: Profile<D>, const D: usize>(q: f64) -> Result<(), TestCaseError> {
    let (value, slope) = P::value_and_slope::<f64, 0>(q, 1.0);
    let pieces = [
        (P::STARTS[1], P::value_and_slope::<f64, 1>(q, 1.0)),
        (P::STARTS[2], P::value_and_slope::<f64, 2>(q, 1.0)),
    ];
    for (start, of_piece) in pieces {
        if q >= start {
            prop_assert_eq!(
                of_piece,
                (value, slope),
                "the piece from {} on at {}",
                start,
                q
            );
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn every_kernel_in_every_dimension(h in 1e-6..1e6_f64, at in 0.001..0.999_f64) {
        for kind in KernelKind::ALL {
            kind.with::<1, _>(h, Properties { dimension: 1, at })?;
            kind.with::<2, _>(h, Properties { dimension: 2, at })?;
            kind.with::<3, _>(h, Properties { dimension: 3, at })?;
        }
    }

    /// On fine lattices that no kernel's centre is a symmetric place of.
    #[test]
    fn sums_over_a_lattice_are_the_integrals(
        h in 0.1..10.0_f64,
        shift in proptest::array::uniform3(0.05..0.45_f64),
    ) {
        for kind in KernelKind::ALL {
            kind.with::<1, _>(h, LatticeSums { kind, shift })?;
            kind.with::<2, _>(h, LatticeSums { kind, shift })?;
            kind.with::<3, _>(h, LatticeSums { kind, shift })?;
        }
    }

    #[test]
    fn scaling(h in 1e-3..1e3_f64, q in 0.0..3.0_f64) {
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs().max(1e-9);
        prop_assert!(close(Quintic::<1>::new(h).value(q * h) * h, Quintic::<1>::new(1.0).value(q)));
        prop_assert!(close(Cubic::<2>::new(h).value(q * h) * h * h, Cubic::<2>::new(1.0).value(q)));
        prop_assert!(close(WendlandC2::<3>::new(h).value(q * h) * h.powi(3), WendlandC2::<3>::new(1.0).value(q)));
        prop_assert!(close(WendlandC4::<3>::new(h).value(q * h) * h.powi(3), WendlandC4::<3>::new(1.0).value(q)));
        prop_assert!(close(WendlandC6::<2>::new(h).value(q * h) * h * h, WendlandC6::<2>::new(1.0).value(q)));
    }

    #[test]
    fn cohesion_is_the_slope_of_its_potential(support in 1e-3..1e3_f64, at in 0.01..1.2_f64) {
        let (c, potential) = (Cohesion::<3>::new(support), CohesionPotential::<3>::new(support));
        let r = at * support;
        let scale = 32.0 / std::f64::consts::PI / support.powi(3);
        prop_assert!((support * potential.slope(r) - c.value(r)).abs() < 1e-13 * scale);
        let step = 1e-5 * support;
        let difference = (potential.value(r + step) - potential.value(r - step)) / (2.0 * step);
        prop_assert!((support * difference - c.value(r)).abs() < 1e-6 * scale);
        prop_assert_eq!(potential.value(1.1 * support), 0.0);
        later_pieces_are_exact::<CohesionProfile, 3>(at)?;
    }

    /// Within the support and beyond it.
    #[test]
    fn the_gradient_of_cohesion_is_its_slope_along_the_way(
        support in 1e-3..1e3_f64,
        at in proptest::array::uniform3(-0.9..-0.05_f64),
    ) {
        cohesion_gradient::<1>(support, at)?;
        cohesion_gradient::<2>(support, at)?;
        cohesion_gradient::<3>(support, at)?;
    }

    #[test]
    fn cohesion_has_its_joins_zeros_and_sign_change(support in 1e-3..1e3_f64, at in 0.0..1.0_f64) {
        let c = Cohesion::<3>::new(support);
        let peak = 0.5 / std::f64::consts::PI / support.powi(3);
        // Peak 32/64/π at half the support, the join of the two branches.
        prop_assert!((c.value(0.5 * support) / peak - 1.0).abs() < 1e-12);
        prop_assert!((c.value(0.500_000_1 * support) / peak - 1.0).abs() < 1e-6);
        prop_assert!((c.value(0.0) / -peak - 1.0).abs() < 1e-12);
        prop_assert_eq!(c.value(support), 0.0);
        prop_assert_eq!(c.value(1.5 * support), 0.0);
        prop_assert_eq!(c.slope(1.5 * support), 0.0);
        prop_assert_eq!(c.gradient([0.0; 3]), [0.0; 3]);
        // 128 ((1−s)s)³ = 1 where the sign changes: (1−s)s = 128^(−1/3).
        let root = 0.5 - (0.25 - 128.0_f64.powf(-1.0 / 3.0)).sqrt();
        prop_assert!(c.value((root - 1e-3) * support) < 0.0 && c.value((root + 1e-3) * support) > 0.0);
        let step = 1e-6 * support;
        let r = at * support;
        if r > step && (at - 0.5).abs() > 1e-5 && at < 0.99999 {
            let difference = (c.value(r + step) - c.value(r - step)) / (2.0 * step);
            prop_assert!((difference - c.slope(r)).abs() < 1e-6 * peak / support);
        }
    }
}

/// The gradient of C against its values a little to either side, in every coordinate.
fn cohesion_gradient<const D: usize>(support: f64, at: [f64; 3]) -> Result<(), TestCaseError> {
    let c = Cohesion::<D>::new(support);
    prop_assert_eq!(c.support(), support);
    let x: [f64; D] = std::array::from_fn(|k| at[k] * support);
    let step = 1e-6 * support;
    let gradient = c.gradient(x);
    for k in 0..D {
        let at = |shift: f64| {
            let mut y = x;
            y[k] += shift;
            c.value(y.iter().map(|v| v * v).sum::<f64>().sqrt())
        };
        let difference = (at(step) - at(-step)) / (2.0 * step);
        let scale = 32.0 / std::f64::consts::PI / support.powi(D as i32 + 1);
        prop_assert!(
            (difference - gradient[k]).abs() < 1e-5 * scale,
            "axis {k} of {D}: {difference} {}",
            gradient[k]
        );
    }
    Ok(())
}

/// Σ W V = 1, Σ x W V = 0, Σ ∇W V = 0 and Σ x ∇W V = −1: what density, interpolation and gradients of SPH need.
struct LatticeSums {
    kind: KernelKind,
    /// Of the lattice against the kernel's centre, in cells.
    shift: [f64; 3],
}

impl<const D: usize> WithKernel<D> for LatticeSums {
    type Output = Result<(), TestCaseError>;

    fn call<K: Kernel<D>>(self, w: K) -> Self::Output {
        // To either side; the wider the kernel, the finer. Errors fall with the smoothness of the kernel.
        let cells = if D == 3 { 10 } else { 20_i32 };
        let most = if D == 3 { 4e-3 } else { 4e-4 };
        let cell = w.support() / f64::from(cells);
        let across = 2 * cells as usize;
        let (mut one, mut first) = (0.0, [0.0; D]);
        let (mut slope, mut linear) = ([0.0; D], [[0.0; D]; D]);
        for number in 0..across.pow(D as u32) {
            let x: [f64; D] = std::array::from_fn(|k| {
                let place = number / across.pow(k as u32) % across;
                cell * (place as f64 - f64::from(cells) + self.shift[k])
            });
            let volume = cell.powi(D as i32);
            let r = x.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (value, gradient) = (w.value(r), w.gradient(x));
            one += value * volume;
            for k in 0..D {
                first[k] += x[k] / cell * value * volume;
                slope[k] += cell * gradient[k] * volume;
                for l in 0..D {
                    linear[k][l] += x[k] * gradient[l] * volume;
                }
            }
        }
        let kind = self.kind;
        prop_assert_eq!(w.support(), kind.support_over_h() * w.smoothing_length());
        prop_assert!((one - 1.0).abs() < most, "{kind} in {D}-D: {one}");
        for k in 0..D {
            prop_assert!(first[k].abs() < most, "{kind} in {D}-D: {first:?}");
            prop_assert!(slope[k].abs() < most, "{kind} in {D}-D: {slope:?}");
            for l in 0..D {
                let exact = if k == l { -1.0 } else { 0.0 };
                let off = (linear[k][l] - exact).abs();
                prop_assert!(off < most, "{kind} in {D}-D: {linear:?}");
            }
        }
        Ok(())
    }
}

/// W(0) and W(h) by hand, from the formulas of the documentation.
#[test]
fn values_by_hand() {
    use std::f64::consts::PI;
    // w(0), w(1) and σ in one, two and three dimensions.
    type ByHand = [(f64, f64, f64); 3];
    let quintic: ByHand = [
        (66.0, 26.0, 1.0 / 120.0),
        (66.0, 26.0, 7.0 / (478.0 * PI)),
        (66.0, 26.0, 1.0 / (120.0 * PI)),
    ];
    let cubic: ByHand = [
        (1.0, 0.25, 2.0 / 3.0),
        (1.0, 0.25, 10.0 / (7.0 * PI)),
        (1.0, 0.25, 1.0 / PI),
    ];
    let c2: ByHand = [
        (1.0, 0.3125, 0.625),
        (1.0, 0.1875, 7.0 / (4.0 * PI)),
        (1.0, 0.1875, 21.0 / (16.0 * PI)),
    ];
    let c4: ByHand = [
        (1.0, 5.5 / 32.0, 0.75),
        (1.0, 83.0 / 768.0, 9.0 / (4.0 * PI)),
        (1.0, 83.0 / 768.0, 495.0 / (256.0 * PI)),
    ];
    let c6: ByHand = [
        (1.0, 11.875 / 128.0, 55.0 / 64.0),
        (1.0, 15.25 / 256.0, 39.0 / (14.0 * PI)),
        (1.0, 15.25 / 256.0, 1365.0 / (512.0 * PI)),
    ];
    let h = 0.7;
    for (kind, by_hand) in KernelKind::ALL
        .into_iter()
        .zip([quintic, cubic, c2, c4, c6])
    {
        let found = [
            kind.with::<1, _>(h, OriginAndH),
            kind.with::<2, _>(h, OriginAndH),
            kind.with::<3, _>(h, OriginAndH),
        ];
        for (dimension, (found, (origin, at_h, sigma))) in (1..).zip(found.into_iter().zip(by_hand))
        {
            let scale = sigma / h.powi(dimension);
            for (found, exact) in found.into_iter().zip([origin, at_h]) {
                let off = found / (scale * exact) - 1.0;
                assert!(off.abs() < 1e-13, "{kind} in {dimension}-D: {off}");
            }
        }
    }
}

struct OriginAndH;

impl<const D: usize> WithKernel<D> for OriginAndH {
    type Output = [f64; 2];

    fn call<K: Kernel<D>>(self, w: K) -> [f64; 2] {
        [w.value_at_origin(), w.value(w.smoothing_length())]
    }
}

#[test]
fn names_round_trip() {
    for kind in KernelKind::ALL {
        assert_eq!(kind.name().parse(), Ok(kind));
        assert_eq!(kind.to_string(), kind.name());
    }
    let error = "gauss".parse::<KernelKind>().expect_err("no such kernel");
    assert!(error.to_string().contains("wendland-c2"), "{error}");
}

#[cfg(feature = "serde")]
#[test]
fn serde_has_the_same_names() {
    for kind in KernelKind::ALL {
        let written = serde_json::to_value(kind).expect("a name");
        assert_eq!(written, kind.name());
        assert_eq!(
            serde_json::from_value::<KernelKind>(written).ok(),
            Some(kind)
        );
    }
}
