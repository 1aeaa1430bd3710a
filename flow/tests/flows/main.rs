//! Flows with known answers, sums against all pairs, and what must hold in any flow.

mod all_pairs;
mod channel;
mod drop;
mod fixed_particles;
mod invariants;
mod plate;
mod rest;
mod sound;
mod taylor_green;
