//! Flows with known answers, sums against all pairs, and what must hold in any flow.

mod all_pairs;
mod channel;
mod drop;
mod invariants;
mod rest;
mod taylor_green;
