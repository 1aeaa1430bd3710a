//! What finishes other than the energy's are to come to.

use crate::finish::{Among, Goal};
use crate::minimise::{Finish, Settling};

/// Of the finish that makes both small: the largest |Γ − Γ₀| and h|∇Γ| to come to, and the steps that may take; evenness
/// counts twice as much as consistency. Cylinder, ∆s = 0.1, 0.05, 0.025, after 200 … 280 products: 0.043 %, 0.047 %,
/// 0.047 % and 5.6, 4.8, 4.9 · 10⁻⁴; at 1 : 1 the density takes half as many again. The density's promise is 0.05 %: a fiftieth is
/// left for what the last step does to the particles around those that move.
const BOTH: (f64, f64, usize) = (4.9e-4, 6e-4, 16);
const EVENNESS: f64 = 1.0;

/// Steps to a place of rest, at most, and the largest |Γ − Γ₀| there that is worth going on for.
const REST_STEPS: usize = 60;
const REST_LEVEL: f64 = 1.8e-3;

/// Where an even finish is not: the largest |Γ − Γ₀| and the closest pair, in ∆s, to come to, and the steps that may take. Kernel
/// gradient sums count a little: over 24 such packings their largest is 0.025 in the mean, 0.038 without, and evenness no worse.
const EVEN: (f64, f64, usize) = (3e-3, 0.83, 48);
const CALMNESS: f64 = 0.01;

/// What the last stages are to come to, one after the other.
pub(super) fn of(settling: &Settling) -> Vec<Goal> {
    let Settling {
        finish, balance, ..
    } = *settling;
    let (level, calm, steps) = BOTH;
    let both = Goal {
        weights: [EVENNESS, 1.0],
        level,
        calm,
        apart: 0.0,
        steps,
        among: Among::Band,
    };
    match finish {
        Finish::Even => {
            let (level, apart, steps) = EVEN;
            vec![Goal {
                weights: [1.0, CALMNESS],
                level,
                calm: f64::INFINITY,
                apart,
                steps,
                among: Among::Uneven,
            }]
        }
        Finish::Consistent => Vec::new(),
        Finish::Both => {
            // What counts less need not be as small.
            let lax = (balance / (1.0 - balance)).clamp(1e-3, 1e3);
            let calm = settling.residual_tolerance.unwrap_or(calm * lax);
            vec![Goal {
                weights: [2.0 * EVENNESS * balance, 2.0 * (1.0 - balance)],
                level: level / lax,
                calm,
                ..both
            }]
        }
        Finish::Calm => {
            vec![Goal {
                level: REST_LEVEL,
                calm: settling.tolerance(),
                steps: REST_STEPS,
                among: Among::All,
                ..both
            }]
        }
    }
}
