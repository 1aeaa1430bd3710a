//! What came of the packings of a case or a kind.

/// What a packing should keep: |Γ − 1| below, and pairs apart by, in ∆s.
pub(super) const LINF: f64 = 5e-3;
pub(super) const CLOSEST: f64 = 0.8;

/// What came of a case.
#[derive(Debug, Clone, Default)]
pub(super) struct Row {
    pub(super) name: String,
    pub(super) scenes: usize,
    /// Done, all parts right.
    pub(super) right: usize,
    /// Of these, with density and pairs as they should be.
    pub(super) even: usize,
    /// Not settled, or found unsound, and said so.
    pub(super) said: usize,
    pub(super) refused: usize,
    /// Done, with a part whose mass is off.
    pub(super) wrong: Vec<String>,
    /// Of what is done: the worst mass in allowances, L∞, closest pair.
    pub(super) worst: [f64; 3],
}

impl Row {
    pub(super) fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            worst: [0.0, 0.0, f64::INFINITY],
            ..Self::default()
        }
    }
}
