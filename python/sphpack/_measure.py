"""Anybody's particles: how even they are, and who is near whom."""

from __future__ import annotations

import json
import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import InputError
from ._particles import Particles


def _flat(points: ArrayLike) -> tuple[NDArray[np.float64], int]:
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InputError(f"points are an array of shape (n, 2) or (n, 3), not {points.shape}")
    return np.ascontiguousarray(points).reshape(-1), points.shape[1]


def quality(
    particles: ArrayLike | Particles,
    spacing: float | None = None,
    *,
    kernel: str | None = None,
    h_over_spacing: float | None = None,
    volume: ArrayLike | None = None,
    frozen: ArrayLike | None = None,
) -> dict[str, Any]:
    """How even particles are, as ``sphpack quality`` says it: Γ, residual, closest pair, audit.

    ``particles``: an array of positions, shape (n, 2) or (n, 3), or what :func:`pack` gives. Those that are ``frozen`` are
    neighbours and not measured; where there are none, all but those near the edge are measured. ``volume``: of each; one of
    ``spacing`` for all where left out. ``kernel`` and ``h_over_spacing`` are those that packed, the quintic and 1.2 where nobody knows.
    """
    if isinstance(particles, Particles):
        report = particles.report
        spacing = report["spacing"] if spacing is None else spacing
        kernel = report["kernel"] if kernel is None else kernel
        h_over_spacing = report["h_over_spacing"] if h_over_spacing is None else h_over_spacing
        volume = particles.volume if volume is None else volume
        frozen = particles.kind_code == 3 if frozen is None and (particles.kind_code == 3).any() else frozen
        particles = particles.position
    if spacing is None:
        raise InputError("say how far particles are apart: spacing=…")
    flat, dimension = _flat(particles)
    position = np.zeros((len(flat) // dimension, 3))
    position[:, :dimension] = flat.reshape(-1, dimension)
    return json.loads(
        _native.quality(
            position.reshape(-1),
            dimension,
            spacing,
            "quintic" if kernel is None else kernel,
            1.2 if h_over_spacing is None else h_over_spacing,
            None if volume is None else np.ascontiguousarray(volume, dtype=np.float64),
            None if frozen is None else np.ascontiguousarray(frozen, dtype=bool),
        )
    )


def neighbors(
    points: ArrayLike, radius: float, *, periodic: Any = None
) -> tuple[NDArray[np.uint32], NDArray[np.uint64]]:
    """Who is at most ``radius`` away: ``(indices, starts)``, where those near point i, itself left out, are
    ``indices[starts[i]:starts[i + 1]]``.

    ``periodic``: a box that wraps around, ``(min, max)`` or, where only some axes do, ``(min, max, axes)``.
    """
    flat, dimension = _flat(points)
    if periodic is not None:
        low, high, *axes = periodic
        axes = axes[0] if axes else [True] * dimension
        periodic = ([float(x) for x in low], [float(x) for x in high], [bool(x) for x in axes])
    return _native.neighbors(flat, dimension, float(radius), periodic)


def check(path: str | os.PathLike[str], spacing: float | None = None) -> dict[str, Any]:
    """What can be said of a body's file before it is packed: whether it can be, what is wrong with it, what would be mended;
    with a ``spacing`` also what is thinner."""
    return json.loads(_native.check(os.fspath(path), spacing))
