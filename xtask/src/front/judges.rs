//! Kernels that judge a packing, whatever packed it.

use sphpack_kernels::KernelKind;

/// A kernel and its h/∆s.
pub(super) type Judge = (KernelKind, f64);

/// The judge of all figures that name none.
pub(super) const DENSITY: Judge = (KernelKind::Quintic, 1.2);

/// Ours, paper 004's, and what solvers use: C2 with a longer h, in the plane up to twice the spacing.
const PLANE: [Judge; 4] = [
    DENSITY,
    (KernelKind::WendlandC2, 1.3),
    (KernelKind::WendlandC2, 1.5),
    (KernelKind::WendlandC2, 2.0),
];

/// The same in space, where a longer h costs more.
const SPACE: [Judge; 4] = [
    DENSITY,
    (KernelKind::WendlandC2, 1.3),
    (KernelKind::WendlandC2, 1.5),
    (KernelKind::WendlandC2, 1.7),
];

/// Those of a dimension.
pub(super) fn judges(dimension: usize) -> &'static [Judge] {
    if dimension == 2 { &PLANE } else { &SPACE }
}

/// The one of them that sees farthest.
pub(super) fn widest(dimension: usize) -> Judge {
    let reach = |(kernel, h): Judge| kernel.support_over_h() * h;
    (judges(dimension).iter().copied())
        .max_by(|&a, &b| reach(a).total_cmp(&reach(b)))
        .unwrap_or(DENSITY)
}

/// "quintic 1.2".
pub(super) fn name((kernel, h): Judge) -> String {
    format!("{} {h:.1}", kernel.name())
}
