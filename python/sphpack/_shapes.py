"""Shapes of bodies, as scenes name them; and bodies that a program has in memory."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._errors import InputError

Numbers = Sequence[float]

Shape = dict[str, Any]
"""A shape as scenes write it."""


def circle(center: Numbers, radius: float) -> Shape:
    """2-D."""
    return {"circle": {"center": center, "radius": radius}}


def ellipse(center: Numbers, semi_axes: Numbers) -> Shape:
    """2-D, axes along x and y."""
    return {"ellipse": {"center": center, "semi_axes": semi_axes}}


def box(min: Numbers, max: Numbers) -> Shape:
    """2-D or 3-D, from one corner to the opposite one."""
    return {"box": {"min": min, "max": max}}


def polygon(points: ArrayLike) -> Shape:
    """2-D, one closed loop in either order."""
    return {"polygon": {"points": points}}


def starfish(center: Numbers, radius: float, amplitude: float, arms: int) -> Shape:
    """2-D, r = radius (1 + amplitude cos(arms θ))."""
    return {"starfish": {"center": center, "radius": radius, "amplitude": amplitude, "arms": arms}}


def zigzag(width: float, height: float, amplitude: float, teeth: int) -> Shape:
    """2-D, a wall with a triangular wave on top."""
    return {"zigzag": {"width": width, "height": height, "amplitude": amplitude, "teeth": teeth}}


def naca(digits: str | int, chord: float = 1.0) -> Shape:
    """2-D, leading edge at the origin, chord along +x."""
    return {"naca": {"digits": str(digits), "chord": chord}}


def sphere(center: Numbers, radius: float) -> Shape:
    """3-D."""
    return {"sphere": {"center": center, "radius": radius}}


def ellipsoid(center: Numbers, semi_axes: Numbers) -> Shape:
    """3-D, axes along x, y and z."""
    return {"ellipsoid": {"center": center, "semi_axes": semi_axes}}


def cylinder(start: Numbers, end: Numbers, radius: float) -> Shape:
    """3-D, with flat ends."""
    return {"cylinder": {"start": start, "end": end, "radius": radius}}


def torus(center: Numbers, axis: Numbers, major: float, minor: float) -> Shape:
    """3-D, a tube of radius ``minor`` around a circle of radius ``major``."""
    return {"torus": {"center": center, "axis": axis, "major": major, "minor": minor}}


class Outline:
    """Closed loops of points in memory, 2-D: one array of shape (n, 2), or several."""

    suffix = ".csv"

    def __init__(self, loops: Any) -> None:
        if np.ndim(loops) == 2 if isinstance(loops, np.ndarray) else _is_one_loop(loops):
            loops = [loops]
        self.loops = [np.ascontiguousarray(loop, dtype=np.float64) for loop in loops]
        for loop in self.loops:
            if loop.ndim != 2 or loop.shape[1] != 2:
                raise InputError(f"an outline is an array of shape (n, 2), not {loop.shape}")

    def write(self, path: str) -> None:
        with open(path, "w", encoding="ascii") as file:
            for number, loop in enumerate(self.loops):
                if number:
                    file.write("\n")
                file.writelines(f"{x!r},{y!r}\n" for x, y in loop.tolist())


def _is_one_loop(loops: Any) -> bool:
    first = loops[0] if len(loops) else ()
    return np.ndim(first) == 1


class Triangles:
    """A triangle mesh in memory, 3-D: vertices of shape (n, 3), and faces of three of their numbers, or more, each."""

    suffix = ".ply"

    def __init__(self, vertices: ArrayLike, faces: ArrayLike) -> None:
        self.vertices = np.ascontiguousarray(vertices, dtype=np.float64)
        self.faces = np.ascontiguousarray(faces, dtype=np.int64)
        if self.vertices.ndim != 2 or self.vertices.shape[1] != 3:
            raise InputError(f"the vertices of a mesh are an array of shape (n, 3), not {self.vertices.shape}")
        if self.faces.ndim != 2 or self.faces.shape[1] != 3:
            raise InputError(f"the faces of a mesh are an array of shape (m, 3), not {self.faces.shape}")
        if len(self.faces) and not (0 <= self.faces.min() and self.faces.max() < len(self.vertices)):
            raise InputError("a face has a vertex that there is not; they are counted from 0")

    def write(self, path: str) -> None:
        faces = np.empty(len(self.faces), dtype=[("count", "u1"), ("corners", "<i4", (3,))])
        faces["count"] = 3
        faces["corners"] = self.faces
        head = (
            "ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(self.vertices)}\n"
            "property double x\nproperty double y\nproperty double z\n"
            f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
        )
        with open(path, "wb") as file:
            file.write(head.encode("ascii"))
            file.write(self.vertices.astype("<f8").tobytes())
            file.write(faces.tobytes())


def mesh(vertices: ArrayLike, faces: ArrayLike) -> Triangles:
    """3-D, from arrays: vertices of shape (n, 3), triangles of shape (m, 3)."""
    return Triangles(vertices, faces)


def outline(loops: Any) -> Outline:
    """2-D, from arrays: one closed loop of shape (n, 2), or a list of them."""
    return Outline(loops)


def file(path: str | os.PathLike[str]) -> Shape:
    """A mesh (STL, OBJ, PLY) or an outline (rows of x,y, an airfoil, SVG)."""
    return {"file": os.fspath(path)}


def as_shape(body: Any) -> Shape | Outline | Triangles:
    """What a scene, or this package, takes as a shape: a path, arrays, or a mesh of trimesh, pyvista or meshio."""
    if isinstance(body, (dict, Outline, Triangles)):
        return body
    if isinstance(body, (str, os.PathLike)):
        return file(body)
    # trimesh.
    if hasattr(body, "vertices") and hasattr(body, "faces"):
        return Triangles(body.vertices, body.faces)
    # pyvista: faces of any number of corners behind their counts.
    if hasattr(body, "points") and hasattr(body, "faces") and hasattr(body, "triangulate"):
        triangles = body.triangulate()
        return Triangles(triangles.points, np.asarray(triangles.faces).reshape(-1, 4)[:, 1:])
    # meshio.
    if hasattr(body, "points") and hasattr(body, "cells_dict"):
        return _of_meshio(body)
    if isinstance(body, tuple) and len(body) == 2 and np.ndim(body[0]) == 2 and np.shape(body[0])[1] == 3:
        return Triangles(*body)
    if isinstance(body, (np.ndarray, list, tuple)):
        return Outline(body)
    raise TypeError(
        f"a body is a path, (vertices, faces), an outline of shape (n, 2), a shape as sphpack.circle(…), or a mesh of "
        f"trimesh, pyvista or meshio; not {type(body).__name__}"
    )


def _of_meshio(body: Any) -> Triangles:
    triangles = body.cells_dict.get("triangle", np.empty((0, 3), dtype=np.int64))
    quads = body.cells_dict.get("quad", np.empty((0, 4), dtype=np.int64))
    faces = np.concatenate([triangles, quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    if not len(faces):
        raise InputError("the mesh has no triangles: its surface is asked for, not its volume")
    points = np.asarray(body.points, dtype=np.float64)
    return Triangles(points, faces)
