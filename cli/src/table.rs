//! Particles as files and pictures see them: plain columns, two and three dimensions alike.

use sphpack_packing::Kind;
use sphpack_separation::Side;

/// One entry per particle in every column.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// 2 or 3.
    pub dimension: usize,
    /// Why the packing stopped ("converged", "interrupted", …); empty where nobody knows.
    pub stop_reason: String,
    /// The bodies' names.
    pub bodies: Vec<String>,
    /// A number that stays with the particle.
    pub id: Vec<u32>,
    /// Positions, scene units; z is 0 in 2-D.
    pub position: Vec<[f64; 3]>,
    /// How each particle may move.
    pub kind: Vec<Kind>,
    /// Solid or fluid.
    pub side: Vec<Side>,
    /// The place of its body in `bodies`.
    pub body: Vec<Option<u16>>,
    /// Volume (area in 2-D).
    pub volume: Vec<f64>,
    /// Density of its body or of the fluid × volume.
    pub mass: Vec<f64>,
    /// Γ.
    pub gamma: Vec<f64>,
    /// h |∇Γ|.
    pub residual: Vec<f64>,
    /// Outward unit normal of the particle surface for boundary and fixed particles, else 0.
    pub normal: Vec<[f64; 3]>,
}

impl Table {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// The particles for which `keep` holds, in the same order.
    #[must_use]
    pub fn filtered(&self, keep: impl Fn(usize) -> bool) -> Self {
        self.in_order(&(0..self.len()).filter(|&i| keep(i)).collect::<Vec<_>>())
    }

    /// The particles with a true entry in `keep`, by ascending id.
    pub(crate) fn kept_by_id(&self, keep: &[bool]) -> Self {
        let mut order: Vec<usize> = (0..self.len()).filter(|&i| keep[i]).collect();
        order.sort_unstable_by_key(|&i| self.id[i]);
        self.in_order(&order)
    }

    fn in_order(&self, order: &[usize]) -> Self {
        fn pick<T: Copy>(column: &[T], order: &[usize]) -> Vec<T> {
            order.iter().map(|&i| column[i]).collect()
        }
        Self {
            dimension: self.dimension,
            stop_reason: self.stop_reason.clone(),
            bodies: self.bodies.clone(),
            id: pick(&self.id, order),
            position: pick(&self.position, order),
            kind: pick(&self.kind, order),
            side: pick(&self.side, order),
            body: pick(&self.body, order),
            volume: pick(&self.volume, order),
            mass: pick(&self.mass, order),
            gamma: pick(&self.gamma, order),
            residual: pick(&self.residual, order),
            normal: pick(&self.normal, order),
        }
    }

    /// Largest |Γ − 1| of the particles inside the domain.
    pub fn linf(&self) -> f64 {
        (self.gamma.iter().zip(&self.kind))
            .filter(|(_, kind)| **kind != Kind::Frozen)
            .fold(0.0, |most, (gamma, _)| f64::max(most, (gamma - 1.0).abs()))
    }

    /// |Γ − 1| that this part (0 … 1) of the particles inside the domain does not exceed; 0 where there are none.
    pub fn error_of_most(&self, part: f64) -> f64 {
        let mut errors: Vec<f64> = (self.gamma.iter().zip(&self.kind))
            .filter(|(_, kind)| **kind != Kind::Frozen)
            .map(|(gamma, _)| (gamma - 1.0).abs())
            .collect();
        errors.sort_by(f64::total_cmp);
        let place = (errors.len() as f64 * part) as usize;
        errors
            .get(place.min(errors.len().saturating_sub(1)))
            .copied()
            .unwrap_or(0.0)
    }
}
