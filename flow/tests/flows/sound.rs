//! A pulse of sound that runs into the fringe.

use sphpack_flow::{COURANT, Edac, EdacSettings, Fringe, Medium, Particles};
use sphpack_neighbors::Domain;

const SPACING: f64 = 0.05;
const LENGTH: f64 = 8.0;
const SOUND_SPEED: f64 = 10.0;
const FRINGE: Fringe<2> = Fringe {
    from: 3.5,
    to: 7.0,
    strength: 5.0,
    velocity: [0.0; 2],
};
/// Where the pulse begins, and how wide it is.
const BEGINS: f64 = 1.5;
const WIDE: f64 = 0.4;
/// Of ρc².
const HIGH: f64 = 1e-3;

/// The largest wave that runs right, and left, once the pulse has run through the fringe and out of the box's other side.
fn waves(fringe: Option<Fringe<2>>) -> [f64; 2] {
    let mut particles = Particles::default();
    for i in 0..(LENGTH / SPACING).round() as usize {
        for j in 0..8 {
            let at = [i, j].map(|n| (n as f64 + 0.5) * SPACING);
            let pulse = HIGH * (-((at[0] - BEGINS) / WIDE).powi(2)).exp();
            let velocity = [pulse * SOUND_SPEED, 0.0];
            let pressure = pulse * SOUND_SPEED * SOUND_SPEED;
            particles.add_fluid(at, velocity, SPACING * SPACING, pressure);
        }
    }
    let domain = Domain::new([0.0; 2], [LENGTH, 8.0 * SPACING]).with_periodic([true; 2]);
    let medium = Medium {
        smoothing_length: 1.2 * SPACING,
        density: 1.0,
        sound_speed: SOUND_SPEED,
        force: [0.0; 2],
    };
    let mut settings = EdacSettings::new(medium, 1e-3);
    settings.fringe = fringe;
    let mut flow = Edac::new(&domain, particles, settings);
    let step = medium.time_step(COURANT, 0.0, 1e-3);
    flow.run((0.8 / step).round() as usize, step)
        .expect("a stable run");
    let of = flow.particles();
    let wave = |sign: f64| {
        (of.pressure.iter().zip(&of.velocity))
            .map(|(p, u)| (0.5 * (p + sign * SOUND_SPEED * u[0])).abs())
            .fold(0.0, f64::max)
    };
    [wave(1.0), wave(-1.0)]
}

#[test]
fn the_fringe_damps_sound_and_sends_none_back() {
    let (with, without) = (waves(Some(FRINGE)), waves(None));
    let reflected = with[1] / without[0];
    assert!(reflected < 0.01, "{reflected}");
    // Both p and u go down by λ on the way through: e^−∫λ dt is left.
    let left = (-0.5 * FRINGE.strength * (FRINGE.to - FRINGE.from) / SOUND_SPEED).exp();
    let passed = with[0] / without[0];
    assert!((passed / left - 1.0).abs() < 0.02, "{passed} {left}");
}
