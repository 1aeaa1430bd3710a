"""Particles as arrays."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._errors import InputError

KINDS = ("free", "boundary", "fixed", "frozen")
SIDES = ("solid", "fluid")

_LISTS = ("position", "normal")


class Particles:
    """Packed particles: an array for every column, one entry for each particle.

    The arrays are what the packing computed, not copies. ``kind``, ``side`` and ``body`` are words; ``kind_code``, ``side_code``
    and ``body_code`` the small numbers behind them.
    """

    def __init__(
        self,
        columns: dict[str, NDArray[Any]],
        report: dict[str, Any],
        dimension: int,
        bodies: list[str],
        stop_reason: str,
    ) -> None:
        self._columns = columns
        self.report = report
        """Everything that was measured, as a dictionary: the command's report."""
        self.dimension = dimension
        self.bodies = list(bodies)
        """The bodies' names."""
        self.stop_reason = stop_reason
        """Why the packing ended: "converged", or what kept it from that."""

    def __len__(self) -> int:
        return len(self._columns["id"])

    def __repr__(self) -> str:
        parts = [f"{len(self)} particles", f"{self.dimension}-D", self.stop_reason]
        density = self.report.get("density") if self.report else None
        if density:
            parts.append(f"max |Γ − 1| = {100 * density['linf']:.2g} %")
        return f"<sphpack.Particles: {', '.join(parts)}>"

    def _points(self, name: str) -> NDArray[np.float64]:
        flat = self._columns.get(name)
        if flat is None:
            return np.zeros((len(self), self.dimension))
        return flat.reshape(-1, 3)[:, : self.dimension]

    @property
    def id(self) -> NDArray[np.uint32]:
        """A number that stays with the particle."""
        return self._columns["id"]

    @property
    def position(self) -> NDArray[np.float64]:
        """Shape (n, dimension), scene units."""
        return self._points("position")

    @property
    def normal(self) -> NDArray[np.float64]:
        """Outward unit normals of the body's surface at its particles, shape (n, dimension); 0 elsewhere."""
        return self._points("normal")

    @property
    def volume(self) -> NDArray[np.float64]:
        """Areas in 2-D."""
        return self._columns["volume"]

    @property
    def mass(self) -> NDArray[np.float64]:
        """Volume × density of the body or the fluid."""
        return self._columns["mass"]

    @property
    def density(self) -> NDArray[np.float64]:
        """What a particle's material has, under hydrostatic pressure where the scene asks for that."""
        return self._columns["density"]

    @property
    def spacing(self) -> NDArray[np.float64]:
        """Of each particle, scene units."""
        return self._columns["spacing"]

    @property
    def h(self) -> NDArray[np.float64]:
        """Smoothing lengths, scene units."""
        return self._columns["h"]

    @property
    def pressure(self) -> NDArray[np.float64]:
        """Hydrostatic, where the scene asks for it; else 0."""
        pressure = self._columns.get("pressure")
        return np.zeros(len(self)) if pressure is None else pressure

    @property
    def distance(self) -> NDArray[np.float64]:
        """Of walls in layers: signed distance to the true surface, negative in the wall, scene units. NaN for all others."""
        distance = self._columns.get("distance")
        return np.full(len(self), np.nan) if distance is None else distance

    @property
    def gamma(self) -> NDArray[np.float64]:
        """Γ, the kernel's sum over all neighbours: 1 in an even packing. NaN for frozen particles, which are not judged."""
        return self._columns["gamma"]

    @property
    def residual(self) -> NDArray[np.float64]:
        """h |∇Γ|: 0 where a constant pressure pushes nobody."""
        return self._columns["residual"]

    @property
    def kind_code(self) -> NDArray[np.uint8]:
        """0 free, 1 boundary (on a surface), 2 fixed (at a corner), 3 frozen (outside the box)."""
        return self._columns["kind"]

    @property
    def side_code(self) -> NDArray[np.uint8]:
        """0 solid, 1 fluid."""
        return self._columns["side"]

    @property
    def body_code(self) -> NDArray[np.int32]:
        """The place of the particle's body in ``bodies``; −1 in the fluid."""
        return self._columns["body"]

    @property
    def kind(self) -> NDArray[np.str_]:
        """As words."""
        return np.asarray(KINDS)[self.kind_code]

    @property
    def side(self) -> NDArray[np.str_]:
        """As words."""
        return np.asarray(SIDES)[self.side_code]

    @property
    def body(self) -> NDArray[np.str_]:
        """As names; empty in the fluid."""
        return np.asarray([*self.bodies, ""])[self.body_code]

    @property
    def converged(self) -> bool:
        """Whether the packing has settled and the audit has passed."""
        return self.stop_reason == "converged"

    @property
    def quality(self) -> dict[str, Any]:
        """The figures by which a packing is judged: density, residual, closest pair and audit of the report."""
        names = ("density", "residual", "closest_pair_over_spacing", "audit", "converged")
        return {name: self.report[name] for name in names}

    def select(
        self,
        mask: ArrayLike | None = None,
        *,
        kind: str | Iterable[str] | None = None,
        side: str | Iterable[str] | None = None,
        body: str | Iterable[str] | None = None,
    ) -> Particles:
        """Those particles for which all that is given holds: a mask, and words or lists of words."""
        keep = np.ones(len(self), dtype=bool) if mask is None else np.asarray(mask)
        if keep.dtype != bool:
            keep = np.isin(np.arange(len(self)), keep)
        for what, known, words in (
            (self.kind_code, KINDS, kind),
            (self.side_code, SIDES, side),
            (self.body_code, self.bodies, body),
        ):
            if words is None:
                continue
            words = [words] if isinstance(words, str) else list(words)
            for word in words:
                if word not in known:
                    raise InputError(f'there is no "{word}"; there are {", ".join(known)}')
            keep &= np.isin(what, [known.index(word) for word in words])
        columns = {
            name: column.reshape(-1, 3)[keep].reshape(-1) if name in _LISTS else column[keep]
            for name, column in self._columns.items()
        }
        return Particles(columns, self.report, self.dimension, self.bodies, self.stop_reason)

    def save(self, path: str | os.PathLike[str], force: bool = False) -> None:
        """Writes a file whose ending says the format: vtu, csv, npz, vtp, vtk or ply; for solvers
        data (LAMMPS), xml (SPHinXsys), bgeo or bi4 (DualSPHysics). One that exists only with ``force``.
        """
        columns = {name: np.ascontiguousarray(column) for name, column in self._columns.items()}
        _native.save(
            os.fspath(path), force, self.dimension, self.stop_reason, self.bodies, columns
        )

    def plot(self, by: str = "gamma", ax: Any = None, **style: Any) -> Any:
        """Draws the particles, coloured by a column, and gives the axes. In the plane with matplotlib; in space with pyvista
        where it is installed, and else a slice of one spacing through the middle."""
        values = getattr(self, by)
        if values.dtype.kind == "U":
            values = {"kind": self.kind_code, "side": self.side_code, "body": self.body_code}[by]
        if self.dimension == 3 and ax is None:
            try:
                import pyvista
            except ImportError:
                pass
            else:
                cloud = pyvista.PolyData(np.ascontiguousarray(self.position))
                cloud[by] = values
                plotter = pyvista.Plotter()
                plotter.add_mesh(cloud, scalars=by, render_points_as_spheres=True, **style)
                return plotter
        try:
            import matplotlib.pyplot as plt
        except ImportError:
            raise ImportError("a plot needs matplotlib: pip install matplotlib") from None
        if ax is None:
            _, ax = plt.subplots(layout="constrained")
        position = self.position
        shown = np.ones(len(self), dtype=bool)
        if self.dimension == 3:
            middle = 0.5 * (position[:, 2].min() + position[:, 2].max())
            shown = np.abs(position[:, 2] - middle) <= 0.5 * self.spacing
        style.setdefault("s", 4)
        if by == "gamma" and not {"vmin", "vmax", "norm"} & set(style):
            most = float(np.nanmax(np.abs(values - 1.0), initial=0.0))
            style = {"cmap": "RdBu_r", "vmin": 1.0 - most, "vmax": 1.0 + most, **style}
        drawn = ax.scatter(position[shown, 0], position[shown, 1], c=values[shown], **style)
        ax.set_aspect("equal")
        ax.set(xlabel="x", ylabel="y")
        ax.figure.colorbar(drawn, ax=ax, label={"gamma": "Γ", "residual": "h |∇Γ|"}.get(by, by))
        return ax
