//! Rows of a table, one body's after the other's.

use crate::table::Table;

/// The place of the body of particle `i`: bodies in their order, then what belongs to none.
pub(super) fn place_of_body(table: &Table, i: usize) -> usize {
    let body = table.body[i].map_or(usize::MAX, usize::from);
    body.min(table.bodies.len())
}

/// The rows in the order of their bodies, those of one body in their own.
pub(super) fn by_body(table: &Table) -> Vec<u32> {
    let mut order: Vec<u32> = (0..table.len() as u32).collect();
    order.sort_by_key(|&i| place_of_body(table, i as usize));
    order
}
