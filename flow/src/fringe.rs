//! A strip that turns a wake back into a uniform stream, so that a periodic box has an inlet and an outlet.

use sphpack_neighbors::{Domain, point};

/// In the strip between `from` and `to` along the first axis the fluid is led to the stream: du/dt += λ (U − u), dp/dt −= λ p with
/// λ = λ₀ sin²(π (x − from)/(to − from)). What leaves it is uniform, and sound ends in it; no particle is made or removed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fringe<const D: usize> {
    /// Where the strip begins.
    pub from: f64,
    /// Where it ends, within the box.
    pub to: f64,
    /// λ₀: ten U/D over 1.75 D leave e⁻⁹ of a wake.
    pub strength: f64,
    /// The stream U.
    pub velocity: [f64; D],
}

impl<const D: usize> Fringe<D> {
    /// λ at a place, which may be that of an image.
    pub(crate) fn rate(&self, domain: &Domain<D>, position: [f64; D]) -> f64 {
        let along = (domain.wrap(position)[0] - self.from) / (self.to - self.from);
        if (0.0..1.0).contains(&along) {
            let sine = (std::f64::consts::PI * along).sin();
            self.strength * sine * sine
        } else {
            0.0
        }
    }

    /// λ (U − u).
    pub(crate) fn acceleration(&self, rate: f64, velocity: [f64; D]) -> [f64; D] {
        point::scale(point::sub(self.velocity, velocity), rate)
    }
}
