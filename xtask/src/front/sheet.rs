//! A scene's picture: what its packings take against what they come to.

use std::fmt::Write as _;

use super::errors::Error;
use super::figures::Figures;
use super::panel::{Dot, Panel, SIZE, best};
use super::points::{DEFAULT, Factor, Place, Point};
use super::shapes::{SHAPES, shape};
use crate::drawing;
use crate::power_law::PowerLaw;

/// A surface with less of its particles is not that of the body: a lattice that is cut at it leaves nothing on it and is as even as
/// any lattice.
const ON_SURFACE: f64 = 0.9;

/// Pairs that are nearer than this part of ∆s are no packing.
const APART: f64 = 0.5;

/// A scene, and what its packings came to.
pub(super) struct Sheet {
    pub(super) place: Place,
    pub(super) measured: Vec<(Point, Figures)>,
    /// Names of the others, and why.
    pub(super) left_out: Vec<(String, String)>,
}

/// What a packing takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Price {
    Seconds,
    Evaluations,
}

impl Price {
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Seconds => "time, s",
            Self::Evaluations => "evaluations of density and force",
        }
    }

    pub(super) fn of(self, figures: &Figures) -> f64 {
        match self {
            Self::Seconds => figures.seconds,
            Self::Evaluations => figures.evaluations,
        }
    }
}

/// What is drawn against what, row by row; a last panel has the growth with the number of particles.
const PANELS: [(Price, Error); 5] = [
    (Price::Seconds, Error::Linf),
    (Price::Evaluations, Error::Linf),
    (Price::Seconds, Error::Residual),
    (Price::Seconds, Error::Function),
    (Price::Seconds, Error::Derivative),
];

impl Sheet {
    /// The packings at the scene's own ∆s, which compete, and whether each may be on the front.
    pub(super) fn rivals(&self) -> impl Iterator<Item = (&Point, &Figures, bool)> {
        (self.measured.iter())
            .filter(|(point, _)| point.factor != Factor::Spacing)
            .map(|(point, figures)| (point, figures, is_candidate(figures)))
    }

    /// The default's figures.
    pub(super) fn default(&self) -> Option<&Figures> {
        let found = (self.measured.iter()).find(|(point, _)| point.name == DEFAULT);
        found.map(|(_, figures)| figures)
    }

    fn dots(&self, price: Price, error: Error) -> Vec<Dot> {
        self.rivals()
            .filter_map(|(point, figures, is_candidate)| {
                Some(Dot {
                    name: point.name.clone(),
                    at: [price.of(figures), error.of(figures)?],
                    shape: shape(point),
                    is_candidate,
                })
            })
            .collect()
    }

    /// The packings that nothing else beats, the cheapest first.
    pub(super) fn front(&self, price: Price, error: Error) -> Vec<(String, [f64; 2])> {
        let dots = self.dots(price, error);
        (best(&dots).into_iter())
            .map(|i| (dots[i].name.clone(), dots[i].at))
            .collect()
    }

    /// The default at every ∆s.
    fn finer(&self) -> Vec<Dot> {
        (self.measured.iter())
            .filter(|(point, _)| point.factor == Factor::Spacing || point.name == DEFAULT)
            .map(|(point, figures)| Dot {
                name: format!("∆s = {}", point.scene.spacing),
                at: [figures.particles, figures.seconds],
                shape: 1,
                is_candidate: true,
            })
            .collect()
    }

    /// How the default's seconds grow with the number of particles.
    pub(super) fn growth(&self) -> Option<PowerLaw> {
        let places: Vec<[f64; 2]> = self.finer().iter().map(|dot| dot.at).collect();
        PowerLaw::through(&places)
    }

    /// The picture.
    pub(super) fn svg(&self) -> String {
        let scene = self.place.scene;
        let [width, height] = [2.0 * SIZE[0], HEAD + 3.0 * SIZE[1] + LEGEND];
        let mut out = drawing::begin(width, height);
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "<text x=\"14\" y=\"24\" font-size=\"16\">{scene}, ∆s = {}: the better the farther down to the left; the line joins what nothing beats</text>\n<defs>",
            self.place.spacing
        );
        for (number, shape) in SHAPES.iter().enumerate() {
            let _ = writeln!(
                out,
                "<path id=\"{scene}{number}\" d=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.4\"/>",
                shape.path, shape.fill, shape.colour
            );
        }
        out.push_str("</defs>\n");
        let corner = |k: usize| {
            let (column, row) = (k % 2, k / 2);
            [SIZE[0] * column as f64, HEAD + SIZE[1] * row as f64]
        };
        for (k, (price, error)) in PANELS.into_iter().enumerate() {
            let panel = Panel {
                titles: [price.title(), error.title()],
                dots: self.dots(price, error),
                law: None,
            };
            panel.draw(&mut out, corner(k), scene);
        }
        let growth = Panel {
            titles: ["particles", "time of the default, s"],
            dots: self.finer(),
            law: self.growth(),
        };
        growth.draw(&mut out, corner(PANELS.len()), scene);
        self.legend(&mut out, HEAD + 3.0 * SIZE[1]);
        out.push_str("</svg>\n");
        out
    }

    /// The shapes that occur, in columns.
    fn legend(&self, out: &mut String, top: f64) {
        let occurs = |number: &usize| self.measured.iter().any(|(p, _)| shape(p) == *number);
        for (place, number) in (0..SHAPES.len()).filter(occurs).enumerate() {
            let x = 24.0 + 320.0 * (place % COLUMNS) as f64;
            let y = top + 16.0 + 20.0 * (place / COLUMNS) as f64;
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "<use href=\"#{}{number}\" x=\"{x}\" y=\"{y}\"/><text x=\"{}\" y=\"{}\">{}</text>",
                self.place.scene,
                x + 12.0,
                y + 4.0,
                SHAPES[number].name
            );
        }
    }
}

/// Room for the title, and for the legend.
const HEAD: f64 = 36.0;
const LEGEND: f64 = 120.0;

/// Columns of the legend.
const COLUMNS: usize = 3;

/// Whether a packing has the body's surface and no pair at one place: what has not is drawn, but is on no front.
fn is_candidate(figures: &Figures) -> bool {
    figures.on_surface >= ON_SURFACE && figures.closest_pair >= APART
}

#[cfg(test)]
mod tests {
    use super::super::points::{places, points};
    use super::*;
    use crate::selection::Selection;

    /// The quick form's points with figures that are made up: the further down the list, the slower, and in turn good and bad.
    fn sheet() -> Sheet {
        let selection = Selection {
            quick: true,
            ..Selection::default()
        };
        let place = places(&selection)[0];
        let measured = (points(place, &selection).unwrap().into_iter().enumerate())
            .map(|(i, point)| {
                let i = i as f64;
                let figures = Figures {
                    particles: 1000.0 * (i + 1.0).powi(2),
                    evaluations: 10.0 + i,
                    pairs: 1e4 * (10.0 + i),
                    seconds: 0.01 * (i + 1.0).powi(3),
                    processor_seconds: 0.0,
                    peak_memory_bytes: 1e6,
                    linf: 0.01 * (2.0 + (2.0 * i).sin()),
                    residual: 1e-3 / (i + 1.0),
                    function: (i < 4.0).then_some(2.0 + i),
                    derivative: None,
                    closest_pair: 0.9,
                    on_surface: if point.name == "clipped" { 0.0 } else { 1.0 },
                    stop_reason: "converged".to_owned(),
                    judged: vec![0.1; 4],
                };
                (point, figures)
            })
            .collect();
        Sheet {
            place,
            measured,
            left_out: Vec::new(),
        }
    }

    #[test]
    fn the_picture_is_well_formed_and_has_every_point() {
        let sheet = sheet();
        let svg = sheet.svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let uses = document
            .descendants()
            .filter(|node| node.has_tag_name("use"));
        let ids: Vec<_> = (document.descendants())
            .filter_map(|node| node.attribute("id"))
            .collect();
        let mut count = 0;
        for node in uses {
            count += 1;
            let shape = node.attribute("href").unwrap().trim_start_matches('#');
            assert!(ids.contains(&shape), "{shape}");
            for axis in ["x", "y"] {
                let at: f64 = node.attribute(axis).unwrap().parse().unwrap();
                assert!((0.0..1200.0).contains(&at), "{axis} = {at}");
            }
        }
        // Nine packings compete in three panels, four in one; three spacings; seven shapes in the legend.
        assert_eq!(count, 3 * 9 + 4 + 3 + 7);
    }

    #[test]
    fn what_leaves_the_surface_bare_is_on_no_front() {
        let mut sheet = sheet();
        for (point, figures) in &mut sheet.measured {
            if point.name == "clipped" {
                figures.linf = 1e-9;
            }
        }
        let front = sheet.front(Price::Evaluations, Error::Linf);
        assert!(front.len() > 1, "{front:?}");
        assert!(front.iter().all(|(name, _)| name != "clipped"), "{front:?}");
        assert_eq!(front[0].0, DEFAULT);
    }

    #[test]
    fn the_growth_is_that_of_the_spacings_alone() {
        let sheet = sheet();
        let growth = sheet.growth().unwrap();
        // Seconds go with the cube of what particles go with the square of.
        assert!((growth.exponent - 1.5).abs() < 1e-9, "{growth:?}");
    }
}
