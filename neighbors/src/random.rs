//! Numbers that look random and are the same on every machine.
//!
//! Results rest on both streams, so neither algorithm may change. For everything new take [`SplitMix64`].

/// Steele, Lea and Flood's generator ("Fast splittable pseudorandom number generators", OOPSLA 2014), as `splitmix64.c` of
/// Vigna has it. Seeds that follow each other give streams that have nothing to do with each other.
///
/// ```
/// use sphpack_neighbors::random::SplitMix64;
/// let mut random = SplitMix64::new(7);
/// let first = random.unit();
/// assert!((0.0..1.0).contains(&first));
/// assert_eq!(SplitMix64::new(7).unit(), first);
/// ```
#[derive(Debug, Clone, Default)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// The stream of this seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// 64 random bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        scrambled(self.state)
    }

    /// A number of 0 … 1, 1 never.
    #[inline]
    pub fn unit(&mut self) -> f64 {
        unit(self.bits())
    }
}

/// A one-to-one scramble of 64 bits: what [`SplitMix64`] does to its state, for whoever wants an order without a pattern.
#[inline]
pub fn scrambled(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Knuth's linear congruential generator (MMIX; The Art of Computer Programming, volume 2, section 3.3.4). Neighbouring seeds
/// begin alike and low bits repeat soon: for shaking things about.
#[derive(Debug, Clone)]
pub struct Congruential {
    state: u64,
}

impl Congruential {
    /// The stream of this seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// 64 bits, the high ones random.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        self.state = (self.state)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.state
    }

    /// A number of 0 … 1, 1 never.
    #[inline]
    pub fn unit(&mut self) -> f64 {
        unit(self.bits())
    }
}

/// The high 53 bits as a number of 0 … 1, 1 never.
#[inline]
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_those_of_the_published_algorithms() {
        // What splitmix64.c prints for the seed 1234567.
        let mut random = SplitMix64::new(1_234_567);
        let published = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(published.map(|_| random.bits()), published);
        // 2⁶⁴ is left away.
        let step =
            |x: u128| (x * 6_364_136_223_846_793_005 + 1_442_695_040_888_963_407) % (1 << 64);
        let mut random = Congruential::new(12_345);
        let mut expected = 12_345;
        for _ in 0..10 {
            expected = step(expected);
            assert_eq!(u128::from(random.bits()), expected);
        }
    }

    #[test]
    fn units_fill_their_range_evenly() {
        let (mut a, mut b) = (SplitMix64::new(0), Congruential::new(0));
        for next in [&mut || a.unit(), &mut || b.unit()] as [&mut dyn FnMut() -> f64; 2] {
            let mut tenths = [0; 10];
            for _ in 0..10_000 {
                tenths[(10.0 * next()) as usize] += 1;
            }
            assert!(
                tenths.iter().all(|count| (850..1150).contains(count)),
                "{tenths:?}"
            );
        }
    }
}
