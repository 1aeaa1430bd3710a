//! How random scenes are packed, judged and written.

use super::super::case::{AUTO, Case, Refinement};
use super::super::kernel::Kernel;
use super::super::random::Random;

/// The method: mostly the default.
pub(super) fn method(random: &mut Random, dimension: usize) -> Option<&'static str> {
    if random.chance(0.6) {
        return None;
    }
    let all = [
        "balanced",
        "hybrid",
        "coupled",
        "agitated",
        "ppa",
        "clipped",
        "relaxation",
        "complex",
        "standard",
        "triangulated",
    ];
    // The last two are for the plane only.
    Some(all[random.below(if dimension == 2 { 10 } else { 8 })])
}

/// Everything but the method.
pub(super) fn settle(random: &mut Random, case: &mut Case) {
    let is_default = case.method() == "balanced";
    if random.chance(if is_default { 0.4 } else { 0.25 }) {
        case.kernel = Some(random.pick(&Kernel::ALL));
        case.h_over_spacing = Some(match random.below(3) {
            0 => random.pick(&[1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6]),
            _ => random.between(1.0, 1.6),
        });
    } else if random.chance(0.1) {
        case.h_over_spacing = Some(random.between(1.0, 1.6));
    }
    let mut keys = Vec::new();
    if random.chance(0.25) {
        let lattices: &[&str] = if case.dimension == 2 {
            &["auto", "square", "hexagonal"]
        } else {
            &["auto", "simple-cubic", "bcc", "fcc", "hcp"]
        };
        keys.push(format!("lattice = {:?}", random.pick(lattices)));
    }
    if is_default {
        if random.chance(0.1) {
            keys.push("finish = \"consistent\"".to_owned());
        }
        if random.chance(0.08) {
            keys.push(format!(
                "minimiser = {:?}",
                random.pick(&["lbfgs", "fire", "damped"])
            ));
        }
        if random.chance(0.08) {
            keys.push("band = \"full\"".to_owned());
        }
        if random.chance(0.06) {
            keys.push(format!(
                "levelling = {}",
                random.pick(&["0", "1", "30", "200"])
            ));
        }
    } else {
        keys.push(format!("max_iterations = {}", random.whole(200, 2000)));
    }
    if random.chance(0.12) {
        keys.push("masses = \"corrected\"".to_owned());
    }
    if random.chance(0.06) {
        keys.push("frozen = \"square\"".to_owned());
    }
    if random.chance(0.2) {
        keys.push(format!("seed = {}", random.below(1 << 40)));
    }
    case.packing = keys;
    if random.chance(0.15) {
        case.quality = Some((random.pick(&Kernel::ALL), random.between(1.0, 1.6)));
    }
    let kinds = ["free", "boundary", "fixed", "frozen"];
    case.include = match random.below(10) {
        0 => None,
        1 => Some(kinds.into_iter().filter(|_| random.chance(0.6)).collect()),
        _ => Some(kinds.to_vec()),
    };
}

/// Sites of a box in which particles are brought to rest, at most, in the plane and in space: it takes seconds for some
/// thousand, and too many are refused.
const MOST_AT_REST: [f64; 2] = [1500.0, 700.0];

/// The dearer finishes of the default method, of a scene whose box has so many sites. Drawn last, so that all else of a scene is
/// the same with and without.
pub(super) fn finish(random: &mut Random, case: &mut Case, sites: f64) {
    let is_taken = case.packing.iter().any(|key| key.starts_with("finish"));
    if case.method() != "balanced" || is_taken {
        return;
    }
    let is_small = sites <= MOST_AT_REST[case.dimension - 2];
    let balance = random.pick(&[None, Some(0.0), Some(0.2), Some(0.8), Some(1.0)]);
    match random.below(25) {
        0 | 1 => {
            case.packing.push("finish = \"both\"".to_owned());
            let line = |balance: f64| format!("balance = {balance:?}");
            case.packing.extend(balance.map(line));
        }
        // Now and then one that is refused.
        2 if is_small || random.chance(0.05) => {
            case.packing.push("finish = \"calm\"".to_owned());
        }
        _ => {}
    }
}

/// Particles that differ in size, in some scenes of the default method. Drawn after all else, as [`finish`].
pub(super) fn refine(random: &mut Random, case: &mut Case, size: &[f64]) {
    let is_for_one_size = (case.packing.iter()).any(|key| {
        ["finish", "masses", "frozen"]
            .iter()
            .any(|name| key.starts_with(name))
    });
    if case.method() != "balanced" || !random.chance(0.12) {
        return;
    }
    // Now and then one that is refused.
    if is_for_one_size && !random.chance(0.05) {
        return;
    }
    let growth = match random.below(3) {
        0 => random.pick(&[1.02, 1.05, 1.08, 1.1, 1.2, 1.3]),
        _ => random.between(1.02, 1.3),
    };
    let regions = (0..[0, 0, 0, 1, 1, 2][random.below(6)])
        .map(|_| {
            let ends = |length: &f64| {
                let [a, b] = [
                    random.between(-1.0, *length),
                    random.between(0.0, length + 1.0),
                ];
                (a.min(b), a.max(b) + 0.5)
            };
            let (min, max) = size.iter().map(ends).unzip();
            (min, max, random.between(0.7, 2.0))
        })
        .collect();
    case.refinement = Some(Refinement {
        coarsest: random.pick(&[1.0, 1.5, 2.0, 2.0, 3.0, 5.0]),
        finest: random.chance(0.1).then(|| random.between(0.6, 1.0)),
        growth,
        regions,
    });
    for body in &mut case.bodies {
        if random.chance(0.2) {
            body.spacing = Some(random.between(0.6, 1.5));
        }
    }
}

/// Settings picked for an accuracy, in some scenes of the default method. Drawn after all else, as [`finish`].
pub(super) fn accuracy(random: &mut Random, case: &mut Case) {
    if case.method() != "balanced" || !random.chance(0.06) {
        return;
    }
    case.method = Some(AUTO);
    let measures = ["linf", "linf", "residual", "interpolation", "derivative"];
    let (measure, most) = (
        random.pick(&measures),
        random.pick(&[1.0, 0.03, 0.003, 3e-4]),
    );
    if random.chance(0.9) {
        case.packing
            .push(format!("accuracy = {{ {measure} = {most:?} }}"));
    }
}
