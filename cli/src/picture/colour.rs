//! Γ as a colour.

/// Red, green, blue.
pub(crate) type Colour = [u8; 3];

/// Paper.
pub(crate) const WHITE: Colour = [255, 255, 255];
/// Letters and lines.
pub(crate) const INK: Colour = [26, 28, 32];
/// Frozen particles.
pub(crate) const GREY: Colour = [186, 190, 196];

/// A diverging scale about Γ = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    /// From 1 to either end.
    pub(crate) half: f64,
}

impl Scale {
    /// The scale that just holds |Γ − 1| ≤ `linf`, rounded up to 1, 2 or 5 in the leading digit.
    pub(crate) fn holding(linf: f64) -> Self {
        if !(linf > 1e-12 && linf.is_finite()) {
            return Self { half: 1e-3 };
        }
        let unit = 10_f64.powf(linf.log10().floor());
        let half = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|step| step * unit)
            .find(|half| *half >= linf * (1.0 - 1e-9))
            .unwrap_or(10.0 * unit);
        Self { half }
    }

    /// The colour of Γ: blue below 1, red above.
    pub(crate) fn colour(self, gamma: f64) -> Colour {
        diverging((gamma - 1.0) / self.half)
    }
}

/// The colour at −1 … 1: straight lines in the perceptual space OKLab from a blue over a light grey to a red, so that
/// equal steps look equal.
pub(crate) fn diverging(t: f64) -> Colour {
    const LOW: [f64; 3] = [0.40, -0.03, -0.155];
    const MIDDLE: [f64; 3] = [0.94, 0.0, 0.0];
    const HIGH: [f64; 3] = [0.43, 0.15, 0.075];
    let t = if t.is_finite() {
        t.clamp(-1.0, 1.0)
    } else {
        0.0
    };
    let end = if t < 0.0 { LOW } else { HIGH };
    from_oklab(std::array::from_fn(|k| {
        MIDDLE[k] + t.abs() * (end[k] - MIDDLE[k])
    }))
}

/// The colour at 0 … 1: from the same blue over a green to a yellow, ever lighter by equal steps, so that it is read without seeing
/// red or green, too.
pub(crate) fn sequential(t: f64) -> Colour {
    const STOPS: [[f64; 3]; 3] = [
        [0.40, -0.03, -0.155],
        [0.67, -0.11, -0.01],
        [0.94, -0.05, 0.15],
    ];
    let t = if t.is_finite() {
        t.clamp(0.0, 1.0)
    } else {
        0.0
    };
    let place = usize::from(t >= 0.5);
    let share = 2.0 * t - place as f64;
    let [from, to] = [STOPS[place], STOPS[place + 1]];
    from_oklab(std::array::from_fn(|k| from[k] + share * (to[k] - from[k])))
}

/// OKLab (Ottosson 2020) to sRGB.
fn from_oklab([l, a, b]: [f64; 3]) -> Colour {
    let cube = |x: f64| x * x * x;
    let l_ = cube(l + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let m_ = cube(l - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let s_ = cube(l - 0.089_484_177_5 * a - 1.291_485_548_0 * b);
    [
        4.076_741_662_1 * l_ - 3.307_711_591_3 * m_ + 0.230_969_929_2 * s_,
        -1.268_438_004_6 * l_ + 2.609_757_401_1 * m_ - 0.341_319_396_5 * s_,
        -0.004_196_086_3 * l_ - 0.703_418_614_7 * m_ + 1.707_614_701_0 * s_,
    ]
    .map(|linear| {
        let x = linear.clamp(0.0, 1.0);
        let encoded = if x <= 0.003_130_8 {
            12.92 * x
        } else {
            1.055 * x.powf(1.0 / 2.4) - 0.055
        };
        (255.0 * encoded).round() as u8
    })
}

/// `colour` with a share of `other`.
pub(crate) fn mixed(colour: Colour, other: Colour, share: f64) -> Colour {
    std::array::from_fn(|k| {
        (f64::from(colour[k]) + share * (f64::from(other[k]) - f64::from(colour[k])))
            .round()
            .clamp(0.0, 255.0) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_round() {
        for (linf, half) in [
            (0.0043, 0.005),
            (0.001, 0.001),
            (0.0051, 0.01),
            (0.0, 0.001),
            (3.0, 5.0),
        ] {
            assert!(
                (Scale::holding(linf).half / half - 1.0).abs() < 1e-12,
                "{linf}"
            );
        }
        assert_eq!(Scale::holding(f64::NAN).half, 1e-3);
    }

    #[test]
    fn what_is_more_is_lighter() {
        let light = |step: u32| {
            let [red, green, blue] = sequential(f64::from(step) / 20.0).map(f64::from);
            0.2126 * red + 0.7152 * green + 0.0722 * blue
        };
        for step in 0..20 {
            assert!(light(step) + 4.0 < light(step + 1), "{step}");
        }
        assert_eq!(sequential(0.0), diverging(-1.0));
    }

    #[test]
    fn the_middle_is_light_and_the_ends_differ() {
        let scale = Scale { half: 0.01 };
        let [low, middle, high] = [0.99, 1.0, 1.01].map(|gamma| scale.colour(gamma));
        assert!(middle.iter().all(|&c| c > 225));
        assert!(low[2] > low[0] && high[0] > high[2]);
        assert_eq!(scale.colour(0.5), low);
        assert_eq!(scale.colour(f64::NAN), middle);
    }
}
