//! How the surface passes through a cell, told from the signs at its eight corners.
//!
//! Corner `c` has bit k of `c` as its place along axis k. Edge `4 k + u + 2 v` runs along axis k, at the places u and v
//! along the next two axes. Face `2 k + s` is the one at place s along axis k.

use std::sync::OnceLock;

/// No edge, no patch.
pub(super) const NONE: u8 = u8::MAX;

/// The patches of one pattern of signs. An edge whose ends have different signs is crossed; on every face crossed edges
/// are partners in pairs, around each corner inside where there are two pairs; edges that hang together by partners
/// bound a patch.
#[derive(Debug, Clone)]
pub(super) struct Case {
    /// How many patches there are.
    pub(super) count: u8,
    /// Per edge, its patch.
    pub(super) patch: [u8; 12],
    /// Per face and edge, the edge's partner there.
    pub(super) partner: [[u8; 12]; 6],
    /// Per face, whether two pairs of partners are on it.
    pub(super) is_twofold: [bool; 6],
}

/// The lower and upper corner of an edge.
fn ends(edge: usize) -> [usize; 2] {
    let (k, place) = (edge / 4, edge % 4);
    let lower = (place & 1) << ((k + 1) % 3) | (place >> 1) << ((k + 2) % 3);
    [lower, lower | 1 << k]
}

/// The edges of a face.
fn edges_on(face: usize) -> impl Iterator<Item = usize> {
    let (k, s) = (face / 2, face % 2);
    (0..12).filter(move |&e| e / 4 != k && ends(e)[0] >> k & 1 == s)
}

impl Case {
    /// The case of the signs in `code`: bit c is set where corner c is inside.
    fn new(code: u8) -> Self {
        let inside = |c: usize| code >> c & 1 == 1;
        let is_crossed = |e: usize| ends(e).map(inside)[0] != ends(e).map(inside)[1];
        let mut partner = [[NONE; 12]; 6];
        let mut is_twofold = [false; 6];
        for (face, row) in partner.iter_mut().enumerate() {
            let crossed: Vec<usize> = edges_on(face).filter(|&e| is_crossed(e)).collect();
            is_twofold[face] = crossed.len() == 4;
            for &e in &crossed {
                let mate = crossed.iter().copied().find(|&other| {
                    let common = |&c: &usize| ends(other).contains(&c) && inside(c);
                    other != e && (crossed.len() == 2 || ends(e).iter().any(common))
                });
                row[e] = mate.map_or(NONE, |m| m as u8);
            }
        }
        let mut patch = [NONE; 12];
        let mut count = 0;
        for start in 0..12 {
            if !is_crossed(start) || patch[start] != NONE {
                continue;
            }
            let mut rest = vec![start];
            while let Some(e) = rest.pop() {
                if patch[e] == NONE {
                    patch[e] = count;
                    let mates = partner.iter().map(|row| row[e]).filter(|&m| m != NONE);
                    rest.extend(mates.map(usize::from));
                }
            }
            count += 1;
        }
        Self {
            count,
            patch,
            partner,
            is_twofold,
        }
    }

    /// The case of the signs in `code`.
    pub(super) fn of(code: u8) -> &'static Self {
        static ALL: OnceLock<Vec<Case>> = OnceLock::new();
        let all = ALL.get_or_init(|| (0..=u8::MAX).map(Self::new).collect());
        &all[usize::from(code)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_have_partners_on_both_their_faces() {
        for code in 0..=u8::MAX {
            let case = Case::of(code);
            for e in 0..12 {
                let mates: Vec<(usize, u8)> = (0..6)
                    .map(|f| (f, case.partner[f][e]))
                    .filter(|&(_, m)| m != NONE)
                    .collect();
                let is_crossed = case.patch[e] != NONE;
                assert_eq!(mates.len(), if is_crossed { 2 } else { 0 }, "{code} {e}");
                for (f, m) in mates {
                    assert_eq!(usize::from(case.partner[f][usize::from(m)]), e);
                    assert_eq!(case.patch[usize::from(m)], case.patch[e]);
                }
            }
            // Each inside corner apart, each outside pair joined.
            assert!(case.count <= 4);
        }
        assert_eq!(Case::of(0).count, 0);
        assert_eq!(Case::of(1).count, 1);
        assert_eq!(Case::of(0b1000_0001).count, 2);
        assert_eq!(Case::of(0b0110_1001).count, 4);
        assert_eq!(Case::of(0b0111_1110).count, 2);
    }
}
