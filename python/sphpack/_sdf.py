"""Signed distances."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import InputError
from ._shapes import Outline, Triangles, as_shape

Floats = NDArray[np.float64]


class Body:
    """A closed outline or mesh that answers where it is. Distances are negative inside."""

    def __init__(self, body: Any) -> None:
        shape = as_shape(body)
        if isinstance(shape, Outline):
            self._body = _native.Body.outline([loop.reshape(-1) for loop in shape.loops])
        elif isinstance(shape, Triangles):
            self._body = _native.Body.mesh(shape.vertices.reshape(-1), shape.faces.astype(np.uint32).reshape(-1))
        elif "file" in shape:
            self._body = _native.Body.read(os.fspath(shape["file"]))
        else:
            raise InputError("give a file, a mesh or an outline; shapes by formula have their distance by formula")

    @property
    def dimension(self) -> int:
        return self._body.dimension

    @property
    def volume(self) -> float:
        """Area in 2-D."""
        return self._body.volume

    @property
    def measure(self) -> float:
        """Surface area; length of the outline in 2-D."""
        return self._body.measure

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Lower and upper corner."""
        low, high = self._body.bounds
        return np.asarray(low), np.asarray(high)

    def _places(self, points: ArrayLike) -> tuple[tuple[int, ...], Floats]:
        points = np.asarray(points, dtype=np.float64)
        if points.shape[-1:] != (self.dimension,):
            raise InputError(f"points are an array of shape (…, {self.dimension}), not {points.shape}")
        return points.shape, np.ascontiguousarray(points).reshape(-1)

    def closest(self, points: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Signed distances, nearest points of the surface, and outward normals there."""
        shape, flat = self._places(points)
        distance, point, normal = self._body.closest(flat)
        return distance.reshape(shape[:-1]), point.reshape(shape), normal.reshape(shape)

    def __call__(self, points: ArrayLike) -> Floats:
        """Signed distances."""
        return self.closest(points)[0]

    def inside(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Which of the points are inside."""
        shape, flat = self._places(points)
        return self._body.inside(flat).reshape(shape[:-1])

    def sample(self, count: int) -> tuple[Floats, Floats]:
        """So many points spread evenly over the surface, corners and edges first; and the normals there."""
        points, normals = self._body.sample(count)
        return points.reshape(-1, self.dimension), normals.reshape(-1, self.dimension)


def sdf(body: Any) -> Body:
    """The signed distance of a body, a function of points: ``sphpack.sdf("bunny.stl")(points)``."""
    return Body(body)
