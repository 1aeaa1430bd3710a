//! Parts as a lathe makes them: pipes, flanges, fins, rings, cones and needles, with sharp edges and narrow grooves.

use std::f64::consts::TAU;
use std::path::Path;

use sphpack::Outcome;
use sphpack_packing::Kind;

use super::drawn::{DEEP, Drawn, faults_of, is_deep};
use super::frame::Frame;
use super::shapes::Shape;
use super::space::{self, Triangle};
use crate::scene_fuzz::random::Random;

/// Facets around.
const FACETS: usize = 128;

/// A profile of radius and height, turned about the axis.
#[derive(Debug)]
struct Turned {
    spacing: f64,
    frame: Frame,
    profile: Vec<[f64; 2]>,
}

pub(super) fn draw(number: u64) -> Box<dyn Drawn> {
    let mut random = Random::new(4, number);
    let profile = profile(&mut random);
    let most = |k: usize| profile.iter().map(|p| p[k]).fold(f64::MIN, f64::max);
    let least = profile.iter().map(|p| p[1]).fold(f64::MAX, f64::min);
    let wide = 2.0 * most(0);
    let diagonal = (2.0 * wide * wide + (most(1) - least).powi(2)).sqrt();
    // From a coarse look to a hundredth of the diagonal's half.
    let spacing = diagonal / random.between(25.0, 50.0);
    let frame = if random.chance(0.5) {
        Frame::upright()
    } else {
        Frame::random(&mut random, 3)
    };
    Box::new(Turned {
        spacing,
        frame,
        profile,
    })
}

/// Counter-clockwise, of radius and height, no radius below zero.
fn profile(random: &mut Random) -> Vec<[f64; 2]> {
    let bore = random.between(0.3, 0.5);
    let wall = bore + random.between(0.05, 0.2);
    let high = random.between(0.5, 1.2);
    match random.below(5) {
        // A pipe with a flange at its foot.
        0 => {
            let (rim, thick) = (wall + random.between(0.2, 0.4), random.between(0.03, 0.15));
            vec![
                [bore, 0.0],
                [rim, 0.0],
                [rim, thick],
                [wall, thick],
                [wall, high],
                [bore, high],
            ]
        }
        // Fins around a pipe, thin, with narrow grooves.
        1 => {
            let fins = random.whole(2, 5);
            let (rim, pitch) = (wall + random.between(0.15, 0.35), high / fins as f64);
            let thick = pitch * random.between(0.15, 0.6);
            let mut points = vec![[bore, 0.0]];
            for k in 0..fins {
                let low = k as f64 * pitch;
                points.push([rim, low]);
                points.push([rim, low + thick]);
                points.push([wall, low + thick]);
                points.push([wall, low + pitch]);
            }
            points.push([bore, high]);
            points
        }
        // A cone, blunt or a needle.
        2 => vec![
            [0.0, 0.0],
            [high * random.between(0.05, 0.6), 0.0],
            [0.0, high],
        ],
        // A ring with an edge all around.
        3 => {
            let sharp = random.between(0.1, 0.4);
            vec![
                [bore, -0.5 * sharp],
                [bore + random.between(0.1, 0.4), 0.0],
                [bore, 0.5 * sharp],
            ]
        }
        // A cup: a thin bottom and a thin wall.
        _ => {
            let thin = random.between(0.02, 0.1);
            vec![
                [0.0, 0.0],
                [wall, 0.0],
                [wall, high],
                [wall - thin, high],
                [wall - thin, thin],
                [0.0, thin],
            ]
        }
    }
}

impl Turned {
    fn triangles(&self) -> Vec<Triangle> {
        let at = |k: usize, n: usize| {
            let [radius, high] = self.profile[k % self.profile.len()];
            let angle = TAU * (n % FACETS) as f64 / FACETS as f64;
            [radius * angle.cos(), radius * angle.sin(), high]
        };
        let mut triangles = Vec::new();
        for k in 0..self.profile.len() {
            let [from, to] = [k, (k + 1) % self.profile.len()].map(|k| self.profile[k][0]);
            for n in 0..FACETS {
                let [a, b, c, d] = [at(k, n), at(k, n + 1), at(k + 1, n + 1), at(k + 1, n)];
                // Nothing is turned along the axis.
                if from > 0.0 {
                    triangles.push([a, b, c]);
                }
                if to > 0.0 {
                    triangles.push([a, c, d]);
                }
            }
        }
        triangles
    }

    /// As the smooth body would; facets are cut off by a few thousandths of their edge.
    fn holds(&self, own: [f64; 3]) -> bool {
        let radius = own[0].hypot(own[1]);
        Shape::Polygon(self.profile.clone()).holds([radius, own[2], 0.0])
    }
}

impl Drawn for Turned {
    fn text(&self, folder: &Path, number: u64) -> Result<String, String> {
        let triangles: Vec<Triangle> = (self.triangles().iter())
            .map(|corners| corners.map(|p| self.frame.place(p)))
            .collect();
        let file = format!("turned-parts-{number}.obj");
        space::write(&triangles, &folder.join(&file))?;
        Ok(format!(
            "spacing = {:?}\n[domain]\nmargin = {:?}\n[[body]]\nname = \"part\"\nshape = {{ file = {file:?} }}\n",
            self.spacing,
            5.0 * self.spacing
        ))
    }

    fn faults(&self, outcome: &Outcome) -> Vec<String> {
        let table = &outcome.table;
        let (mut held, mut strayed, mut sunk) = (0.0, 0, 0);
        for i in (0..table.len()).filter(|&i| table.kind[i] != Kind::Frozen) {
            let own = self.frame.own(table.position[i]);
            if table.body[i].is_some() {
                held += table.volume[i];
                strayed += usize::from(!self.holds(own));
            } else {
                let far = DEEP * self.spacing;
                sunk += usize::from(is_deep(3, far, own, |p| self.holds(p)));
            }
        }
        let exact: f64 = space::volume(&self.triangles());
        let counts = [
            (strayed, "particles of the body outside it"),
            (sunk, "particles of fluid in the body"),
        ];
        faults_of(outcome, &counts, [held, exact])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pipe_has_its_volume() {
        let pipe = Turned {
            spacing: 0.1,
            frame: Frame::upright(),
            profile: vec![[0.5, 0.0], [1.0, 0.0], [1.0, 2.0], [0.5, 2.0]],
        };
        // Regular polygons of so many sides in place of circles.
        let angle = TAU / FACETS as f64;
        let exact = 0.5 * FACETS as f64 * angle.sin() * (1.0 - 0.25) * 2.0;
        assert!((space::volume(&pipe.triangles()) - exact).abs() < 1e-12);
        assert!(pipe.holds([0.0, 0.7, 1.0]) && !pipe.holds([0.3, 0.3, 1.0]));
    }

    #[test]
    fn a_cone_closes_at_its_tip() {
        let cone = Turned {
            spacing: 0.1,
            frame: Frame::upright(),
            profile: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        };
        let exact = FACETS as f64 * (TAU / FACETS as f64).sin() / 6.0;
        assert!((space::volume(&cone.triangles()) - exact).abs() < 1e-12);
    }
}
