"""Smoothing kernels::

    w = sphpack.kernels.Quintic(2)
    w(r, h), w.slope(r, h)
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native


class Kernel:
    """A smoothing kernel in 1, 2 or 3 dimensions, normalised there."""

    name = ""

    def __init__(self, dimension: int) -> None:
        if dimension not in (1, 2, 3):
            raise ValueError(f"dimension is {dimension}; it must be 1, 2 or 3")
        self.dimension = dimension

    def __repr__(self) -> str:
        return f"sphpack.kernels.{type(self).__name__}({self.dimension})"

    @property
    def support(self) -> float:
        """Where it ends, in units of h."""
        return _native.kernel_support(self.name)

    def _both(self, r: ArrayLike, h: float) -> Iterator[NDArray[np.float64]]:
        r = np.asarray(r, dtype=np.float64)
        flat = np.ascontiguousarray(r).reshape(-1)
        return (array.reshape(r.shape) for array in _native.kernel_values(self.name, self.dimension, h, flat))

    def __call__(self, r: ArrayLike, h: float) -> NDArray[np.float64]:
        """W(r, h)."""
        return next(self._both(r, h))

    def slope(self, r: ArrayLike, h: float) -> NDArray[np.float64]:
        """dW/dr."""
        _, slope = self._both(r, h)
        return slope


class Quintic(Kernel):
    """The quintic spline, to 3 h."""

    name = "quintic"


class Cubic(Kernel):
    """The cubic spline, to 2 h."""

    name = "cubic"


class WendlandC2(Kernel):
    """Wendland's C2, to 2 h."""

    name = "wendland-c2"


class WendlandC4(Kernel):
    """Wendland's C4, to 2 h."""

    name = "wendland-c4"


class WendlandC6(Kernel):
    """Wendland's C6, to 2 h."""

    name = "wendland-c6"
