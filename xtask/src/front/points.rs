//! What is packed: every method, and from the default one setting changed at a time.

use sphpack::Scene;
use sphpack::scene::{BandWidth, Finish, Masses, Method};
use sphpack_kernels::KernelKind;
use sphpack_packing::{Lattice, MinimiserKind};

use super::judges::{self, DENSITY, Judge};
use crate::selection::Selection;
use crate::shipped::{iterations_together, load};

/// A scene of the chart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// The scene's file in `scenes`, without extension.
    pub(super) scene: &'static str,
    /// ∆s of all points but those that change it.
    pub(super) spacing: f64,
    /// The others.
    spacings: &'static [f64],
    pub(super) dimension: usize,
}

/// The places of the whole chart.
const PLACES: [Place; 5] = [
    Place {
        scene: "cylinder",
        spacing: 0.05,
        spacings: &[0.2, 0.1, 0.025, 0.0125],
        dimension: 2,
    },
    Place {
        scene: "zigzag",
        spacing: 0.05,
        spacings: &[0.1, 0.025, 0.0125, 0.00625],
        dimension: 2,
    },
    Place {
        scene: "naca0015",
        spacing: 0.02,
        spacings: &[0.04, 0.01, 0.005],
        dimension: 2,
    },
    Place {
        scene: "ellipsoid",
        spacing: 0.1,
        spacings: &[0.2, 0.14, 0.07, 0.05],
        dimension: 3,
    },
    Place {
        scene: BUNNY,
        spacing: 0.05,
        spacings: &[0.1, 0.07, 0.035],
        dimension: 3,
    },
];

/// Its file is not shipped.
const BUNNY: &str = "bunny";

/// The place of the quick form.
const QUICK: Place = Place {
    scene: "cylinder",
    spacing: 0.1,
    spacings: &[0.2, 0.05],
    dimension: 2,
};

/// The points of the quick form.
const QUICK_POINTS: [&str; 11] = [
    "balanced even",
    "balanced consistent",
    "balanced both",
    "hybrid",
    "standard",
    "clipped",
    "fire",
    "tolerance 1e-2",
    "κ = 100",
    "∆s = 0.2",
    "∆s = 0.05",
];

/// What a point changes of the default, which is itself one of the methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Factor {
    Method,
    Minimiser,
    Tolerance,
    Iterations,
    Band,
    Lattice,
    Kernel,
    Masses,
    Levelling,
    Spacing,
}

impl Factor {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Method => "method",
            Self::Minimiser => "minimiser",
            Self::Tolerance => "residual_tolerance",
            Self::Iterations => "max_iterations",
            Self::Band => "band",
            Self::Lattice => "lattice",
            Self::Kernel => "kernel and h_over_spacing",
            Self::Masses => "masses and mass_spread",
            Self::Levelling => "levelling",
            Self::Spacing => "spacing",
        }
    }
}

/// One packing of the chart.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) factor: Factor,
    /// What tells it from the others of its place.
    pub(super) name: String,
    pub(super) scene: Scene,
}

/// The name of the default.
pub(super) const DEFAULT: &str = "balanced even";

/// Iterations in space, where a slow method would take an hour.
const PATIENCE_IN_SPACE: usize = 2000;

/// The places that are asked for.
pub(super) fn places(selection: &Selection) -> Vec<Place> {
    if selection.quick {
        return vec![QUICK];
    }
    PLACES
        .into_iter()
        .filter(|place| place.scene != BUNNY || selection.data.is_some())
        .filter(|place| selection.wants(place.scene, true))
        .collect()
}

/// Every point of a place, the default first; none where its body's file is not there.
pub(super) fn points(place: Place, selection: &Selection) -> Result<Vec<Point>, String> {
    let Some(mut scene) = load(place.scene, selection)? else {
        return Ok(Vec::new());
    };
    scene.spacing = place.spacing;
    if place.dimension == 3 {
        scene.packing.max_iterations = PATIENCE_IN_SPACE;
    }
    // The frozen layer is then as deep as every judge sees.
    let (kernel, h) = judges::widest(place.dimension);
    scene.quality.kernel = Some(kernel);
    scene.quality.h_over_spacing = Some(h);
    let mut all = List {
        scene,
        points: Vec::new(),
    };
    methods(&mut all, place.dimension);
    settings(&mut all, place.dimension);
    for (kernel, h) in PACKING_KERNELS {
        all.push(Factor::Kernel, judges::name((kernel, h)), |scene| {
            scene.packing.kernel = Some(kernel);
            scene.packing.h_over_spacing = Some(h);
        });
    }
    for &spacing in place.spacings {
        all.push(Factor::Spacing, format!("∆s = {spacing}"), |scene| {
            scene.spacing = spacing;
        });
    }
    if selection.quick {
        (all.points).retain(|point| QUICK_POINTS.contains(&point.name.as_str()));
    }
    Ok(all.points)
}

/// Kernels that pack, beside the default's: each as short as it is used, and longer.
const PACKING_KERNELS: [Judge; 12] = [
    (KernelKind::Quintic, 1.0),
    (KernelKind::Quintic, 1.5),
    (KernelKind::Cubic, 1.2),
    (KernelKind::Cubic, 1.5),
    (KernelKind::WendlandC2, 1.3),
    (KernelKind::WendlandC2, 1.5),
    (KernelKind::WendlandC2, 2.0),
    (KernelKind::WendlandC4, 1.3),
    (KernelKind::WendlandC4, 1.7),
    (KernelKind::WendlandC4, 2.0),
    (KernelKind::WendlandC6, 1.5),
    (KernelKind::WendlandC6, 2.0),
];

/// Points of one scene.
struct List {
    /// The default.
    scene: Scene,
    points: Vec<Point>,
}

impl List {
    /// The default, changed.
    fn push(&mut self, factor: Factor, name: String, change: impl FnOnce(&mut Scene)) {
        let mut scene = self.scene.clone();
        change(&mut scene);
        self.points.push(Point {
            factor,
            name,
            scene,
        });
    }
}

/// Every finish of the default method, and every other method that packs a body in so many dimensions.
fn methods(all: &mut List, dimension: usize) {
    for (name, finish) in [
        (DEFAULT, Finish::Even),
        ("balanced consistent", Finish::Consistent),
        ("balanced both", Finish::Both),
        ("balanced calm", Finish::Calm),
    ] {
        all.push(Factor::Method, name.to_owned(), |scene| {
            scene.packing.finish = finish;
        });
    }
    let others = (Method::ALL.into_iter())
        .filter(|method| method.info().dimensions.contains(&dimension))
        // Walls of the one are no particles of a body.
        .filter(|method| !matches!(method, Method::Balanced | Method::Ppa));
    for method in others {
        all.push(Factor::Method, method.name().to_owned(), |scene| {
            let packing = &mut scene.packing;
            packing.method = method;
            packing.max_iterations = iterations_together(method, packing.max_iterations);
        });
    }
}

/// One setting of the default after the other.
fn settings(all: &mut List, dimension: usize) {
    for minimiser in MinimiserKind::ALL {
        if minimiser != MinimiserKind::default() {
            all.push(Factor::Minimiser, minimiser.name().to_owned(), |scene| {
                scene.packing.minimiser = Some(minimiser);
            });
        }
    }
    for tolerance in [3e-2, 1e-2, 3e-3, 3e-4, 1e-4] {
        all.push(
            Factor::Tolerance,
            format!("tolerance {tolerance:e}"),
            |scene| scene.packing.residual_tolerance = Some(tolerance),
        );
    }
    for most in [20, 40] {
        all.push(Factor::Iterations, format!("{most} evaluations"), |scene| {
            scene.packing.max_iterations = most;
        });
    }
    all.push(Factor::Band, "band full".to_owned(), |scene| {
        scene.packing.band = BandWidth::Full;
    });
    for lattice in Lattice::ALL {
        let own = Lattice::auto(dimension, DENSITY.0, DENSITY.1);
        if lattice.dimension() == dimension && lattice != own {
            all.push(Factor::Lattice, lattice.name().to_owned(), |scene| {
                scene.packing.lattice = Some(lattice);
            });
        }
    }
    for spread in [0.005, 0.01, 0.02] {
        all.push(
            Factor::Masses,
            format!("masses ±{} %", 100.0 * spread),
            |scene| {
                scene.packing.masses = Masses::Corrected;
                scene.packing.mass_spread = spread;
                // Masses are corrected for the kernel that judges.
                scene.quality.kernel = Some(DENSITY.0);
                scene.quality.h_over_spacing = Some(DENSITY.1);
            },
        );
    }
    for stiffness in [0.0, 3.0, 30.0, 100.0, 300.0] {
        all.push(Factor::Levelling, format!("κ = {stiffness}"), |scene| {
            scene.packing.levelling = Some(stiffness);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names tell points apart, and all scenes may be asked for.
    #[test]
    fn every_point_is_another_scene_that_can_be_read() {
        let selection = Selection::default();
        for place in places(&selection) {
            let points = points(place, &selection).unwrap();
            assert_eq!(points[0].name, DEFAULT, "{}", place.scene);
            for (i, point) in points.iter().enumerate() {
                for other in &points[..i] {
                    assert_ne!(point.name, other.name, "{}", place.scene);
                    assert_ne!(point.scene, other.scene, "{}", point.name);
                }
                let text = toml::to_string(&point.scene).unwrap();
                let read = Scene::parse(&text, &point.scene.path).unwrap();
                assert_eq!(read, point.scene, "{}", point.name);
            }
        }
    }

    #[test]
    fn the_quick_form_has_all_its_points() {
        let selection = Selection {
            quick: true,
            ..Selection::default()
        };
        let place = places(&selection)[0];
        let points = points(place, &selection).unwrap();
        assert_eq!(points.len(), QUICK_POINTS.len());
    }
}
