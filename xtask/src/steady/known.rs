//! Rows that are known to miss their bars.

/// By their names.
pub(super) const MISSES: [&str; 12] = [
    "0012",
    "0006",
    "2412",
    "6409",
    "ball quintic 1",
    "ball quintic 1.2",
    "ball cubic 1",
    "ball wendland-c2 1",
    "ball wendland-c2 1.2",
    "ball wendland-c4 1.2",
    "ball wendland-c6 1",
    "ball wendland-c6 1.4",
];
