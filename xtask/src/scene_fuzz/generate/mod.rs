//! Random scenes.

mod blobs;
mod plane;
mod settings;
mod solids;
mod space;

use super::case::{Body, Case, Sides};
use super::random::Random;

/// How numbers of a scene look.
#[derive(Debug, Clone, Copy)]
struct Digits(Option<f64>);

impl Digits {
    fn any(random: &mut Random) -> Self {
        Self(match random.below(4) {
            0 => Some(2.0),
            1 | 2 => Some(100.0),
            _ => None,
        })
    }

    fn of(self, x: f64) -> f64 {
        self.0.map_or(x, |steps| (x * steps).round() / steps)
    }
}

/// Room for bodies: a box at the origin, lengths in ∆s.
struct Room {
    size: Vec<f64>,
    digits: Digits,
}

/// What the bodies of a scene are to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Arrangement {
    Alone,
    AtWall,
    Apart,
    Touching,
    Overlapping,
    Nested,
    Thin,
    Nothing,
}

/// Scene `number` of a seed.
pub(super) fn case(seed: u64, number: u64) -> Case {
    let random = &mut Random::new(seed, number);
    let dimension = if random.chance(0.6) { 2 } else { 3 };
    let digits = Digits::any(random);
    let method = settings::method(random, dimension);
    // Other methods take many more evaluations.
    let most = if method.is_none() { 2600.0 } else { 1000.0 };
    let (shortest, longest) = if dimension == 2 {
        (7.0, 60.0)
    } else {
        (6.0, 18.0)
    };
    let mut size: Vec<f64> = (0..dimension)
        .map(|_| random.between(shortest, longest))
        .collect();
    let volume: f64 = size.iter().product();
    let target = random.between(220.0, most);
    if volume > target {
        let factor = (target / volume).powf(1.0 / dimension as f64);
        size.iter_mut().for_each(|x| *x = (*x * factor).max(5.0));
    }
    size.iter_mut().for_each(|x| *x = digits.of(*x));
    let mut case = Case {
        dimension,
        spacing: 1.0,
        origin: vec![0.0; dimension],
        sides: Sides::Corners(vec![0.0; dimension], size.clone()),
        periodic: vec![false; dimension],
        bodies: Vec::new(),
        fill: !random.chance(0.06),
        refinement: None,
        method,
        kernel: None,
        h_over_spacing: None,
        packing: Vec::new(),
        quality: None,
        include: None,
        prefix: String::new(),
    };
    settings::settle(random, &mut case);
    if random.chance(0.3) {
        let (kernel, h) = case.packs();
        let reach = kernel.support() * h + 0.5;
        for (is_periodic, size) in case.periodic.iter_mut().zip(&size) {
            // Seldom also where the axis is too short.
            *is_periodic = random.chance(0.6) && (*size > 2.0 * reach || random.chance(0.05));
        }
    }
    let room = Room { size, digits };
    let arrangement = [
        Arrangement::Alone,
        Arrangement::AtWall,
        Arrangement::Apart,
        Arrangement::Touching,
        Arrangement::Overlapping,
        Arrangement::Nested,
        Arrangement::Thin,
        Arrangement::Nothing,
    ][random.weighted(&[27.0, 13.0, 14.0, 10.0, 14.0, 11.0, 10.0, 1.0])];
    case.bodies = match dimension {
        2 => plane::bodies(random, &room, arrangement),
        _ => space::bodies(random, &room, arrangement),
    };
    for (k, body) in case.bodies.iter_mut().enumerate() {
        body.name = format!("b{k}");
    }
    surfaces(random, &mut case.bodies);
    let fits_margin = matches!(arrangement, Arrangement::Alone | Arrangement::Thin);
    if fits_margin && random.chance(0.2) {
        case.sides = Sides::Margin(digits.of(random.between(1.0, 5.0)).max(0.5));
    }
    if random.chance(0.3) {
        case.spacing = match random.below(3) {
            0 => random.pick(&[0.1, 0.01, 10.0, 1e-3, 1e3]),
            1 => random.magnitude(1e-3, 1e3),
            _ => random.between(0.5, 2.0),
        };
    }
    if random.chance(0.25) {
        let far = if random.chance(0.3) { 1e3 } else { 40.0 };
        for x in &mut case.origin {
            *x = digits.of(random.between(-far, far)) * case.spacing;
        }
    }
    settings::finish(random, &mut case, room.size.iter().product());
    settings::refine(random, &mut case, &room.size);
    settings::accuracy(random, &mut case);
    // Now and then with a solid body, which is refused.
    if case.method() == "ppa" && random.chance(0.9) {
        case = case.emptied();
    }
    case
}

/// Where the bodies' particles sit; mostly the same for all.
fn surfaces(random: &mut Random, bodies: &mut [Body]) {
    let any = |random: &mut Random| match random.below(10) {
        0..=5 => None,
        6 | 7 => Some(0.0),
        8 => Some(0.5),
        _ => Some((random.between(0.0, 1.5) * 20.0).round() / 20.0),
    };
    let shared = any(random);
    let differ = random.chance(0.2);
    for body in bodies {
        body.surface = if differ { any(random) } else { shared };
        if random.chance(0.1) {
            body.density = random.pick(&[2.0, 0.5, 1000.0, 7850.0]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::case::AUTO;
    use super::*;

    #[test]
    fn scenes_are_toml_and_the_same_again() {
        for number in 0..500 {
            let one = case(7, number).placed();
            let text = one.toml();
            assert!(text.parse::<toml::Table>().is_ok(), "{text}");
            assert_eq!(text, case(7, number).placed().toml());
            for body in &one.bodies {
                assert_eq!(body.shape.dimension(), one.dimension);
                assert_eq!(body.shape.file().is_some(), body.shape.ending().is_some());
            }
        }
        assert_ne!(case(7, 1), case(8, 1));
    }

    #[test]
    fn every_kind_of_scene_comes_up() {
        let all: Vec<Case> = (0..2000).map(|number| case(0, number)).collect();
        let share = |is: &dyn Fn(&Case) -> bool| {
            all.iter().filter(|case| is(case)).count() as f64 / all.len() as f64
        };
        let default = share(&|case| case.method() == "balanced");
        assert!((0.58..0.7).contains(&default), "{default}");
        let plane = share(&|case| case.dimension == 2);
        assert!((0.55..0.65).contains(&plane), "{plane}");
        for method in ["hybrid", "standard", "complex", "triangulated"] {
            let own = share(&|case| case.method() == method);
            assert!((0.01..0.08).contains(&own), "{method}: {own}");
        }
        let periodic = share(&|case| case.periodic.contains(&true));
        assert!((0.1..0.3).contains(&periodic), "{periodic}");
        for (finish, least) in [("both", 0.035), ("calm", 0.01)] {
            let line = format!("finish = {finish:?}");
            let own = share(&|case| case.packing.contains(&line));
            assert!((least..2.0 * least).contains(&own), "{finish}: {own}");
            let default =
                share(&|case| case.packing.contains(&line) && case.method() != "balanced");
            assert_eq!(default, 0.0);
        }
        let picked = share(&|case| case.method == Some(AUTO));
        assert!((0.02..0.06).contains(&picked), "{picked}");
        let graded = share(&|case| case.refinement.is_some());
        assert!((0.04..0.09).contains(&graded), "{graded}");
        let files = share(&|case| case.bodies.iter().any(|body| body.shape.file().is_some()));
        assert!((0.1..0.4).contains(&files), "{files}");
    }
}
