//! The repulsion itself.

use proptest::prelude::*;
use sphpack_pairs::Repulsion;

proptest! {
    #[test]
    fn force_is_the_slope_of_the_potential(q in 0.01..1.1_f64, spacing in 1e-3..1e3_f64) {
        let repulsion = Repulsion::new(spacing, Repulsion::STRENGTH);
        let (r, step) = (q * spacing, 1e-6 * spacing);
        let slope = (repulsion.potential(r + step) - repulsion.potential(r - step)) / (2.0 * step);
        let scale = repulsion.force(0.0);
        prop_assert!((slope + repulsion.force(r)).abs() < 1e-4 * scale, "{slope} {}", repulsion.force(r));
        prop_assert!(repulsion.force(r) >= 0.0);
        // Scene units do not matter: k_r/p_b ∝ ∆s makes accelerations scale as 1/∆s, like the background pressure's.
        let other = Repulsion::new(1.0, Repulsion::STRENGTH).force(q) / spacing;
        prop_assert!((repulsion.force(r) - other).abs() <= 1e-12 * scale);
    }
}

#[test]
fn the_printed_constant_below_half_the_spacing() {
    // Negi & Ramachandran (2021), eq. 16, first line, with ∆s = 1: 192 k_r (3c² − c).
    let c = 2.0 * 0.95 / 3.0;
    let printed = 192.0 * Repulsion::STRENGTH * (3.0 * c * c - c);
    let ours = Repulsion::new(1.0, Repulsion::STRENGTH);
    assert!((ours.force(0.3) / printed - 1.0).abs() < 1e-12);
    assert!((ours.force(0.5) / printed - 1.0).abs() < 1e-12);
    assert!(ours.force(0.95 - 1e-9) < 1e-9 && ours.force(0.95) == 0.0);
    assert_eq!(Repulsion::none().force(0.0), 0.0);
    assert_eq!(Repulsion::none().potential(0.0), 0.0);
}
