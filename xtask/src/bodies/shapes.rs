//! Bodies by formula: what holds a place, and how a scene names it.

/// A shape as formulas know it; in the plane z counts for nothing.
#[derive(Debug, Clone)]
pub(super) enum Shape {
    /// Its corners.
    Polygon(Vec<[f64; 2]>),
    /// Centre and radius.
    Ball([f64; 3], f64),
    /// Lower and upper corner.
    Block([f64; 3], [f64; 3]),
    /// From, to, radius.
    Rod([f64; 3], [f64; 3], f64),
}

impl Shape {
    pub(super) fn holds(&self, p: [f64; 3]) -> bool {
        match self {
            Self::Polygon(points) => {
                let mut is_in = false;
                for (k, [x, y]) in points.iter().enumerate() {
                    let [u, v] = points[(k + 1) % points.len()];
                    if (*y > p[1]) != (v > p[1]) && p[0] < x + (p[1] - y) / (v - y) * (u - x) {
                        is_in = !is_in;
                    }
                }
                is_in
            }
            Self::Ball(c, r) => (0..3).map(|k| (p[k] - c[k]).powi(2)).sum::<f64>() < r * r,
            Self::Block(low, high) => (0..3).all(|k| p[k] > low[k] && p[k] < high[k]),
            Self::Rod(a, b, r) => {
                let along: [f64; 3] = std::array::from_fn(|k| b[k] - a[k]);
                let from: [f64; 3] = std::array::from_fn(|k| p[k] - a[k]);
                let square: f64 = along.iter().map(|x| x * x).sum();
                let t = (0..3).map(|k| from[k] * along[k]).sum::<f64>() / square;
                let away: f64 = (0..3).map(|k| (from[k] - t * along[k]).powi(2)).sum();
                t > 0.0 && t < 1.0 && away < r * r
            }
        }
    }

    /// The corners of a box around it.
    pub(super) fn ends(&self) -> [[f64; 3]; 2] {
        match self {
            Self::Polygon(points) => [f64::min, f64::max].map(|of| {
                let end = |k: usize| points.iter().map(|p| p[k]).reduce(of).unwrap_or(0.0);
                [end(0), end(1), 0.0]
            }),
            Self::Ball(c, r) => [c.map(|x| x - r), c.map(|x| x + r)],
            Self::Block(low, high) => [*low, *high],
            Self::Rod(a, b, r) => [
                std::array::from_fn(|k| a[k].min(b[k]) - r),
                std::array::from_fn(|k| a[k].max(b[k]) + r),
            ],
        }
    }

    pub(super) fn words(&self, dimension: usize) -> String {
        let list = |p: &[f64]| format!("{:?}", &p[..dimension.min(p.len())]);
        match self {
            Self::Polygon(points) => {
                let all: Vec<String> = points.iter().map(|p| list(p)).collect();
                format!("polygon = {{ points = [{}] }}", all.join(", "))
            }
            Self::Ball(c, r) if dimension == 2 => {
                format!("circle = {{ center = {}, radius = {r:?} }}", list(c))
            }
            Self::Ball(c, r) => format!("sphere = {{ center = {}, radius = {r:?} }}", list(c)),
            Self::Block(low, high) => {
                format!("box = {{ min = {}, max = {} }}", list(low), list(high))
            }
            Self::Rod(a, b, r) => {
                format!(
                    "cylinder = {{ start = {}, end = {}, radius = {r:?} }}",
                    list(a),
                    list(b)
                )
            }
        }
    }
}
