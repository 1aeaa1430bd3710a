"""Scenes: bodies in a box, and how to pack them."""

from __future__ import annotations

import copy
import json
import os
import pathlib
import tempfile
import warnings
from collections.abc import Mapping
from typing import Any, Union

from . import _native
from ._errors import InputError, Interrupted, NotSettled
from ._particles import Particles
from ._progress import Listener, listener
from ._shapes import as_shape
from ._toml import to_toml

Path = Union[str, "os.PathLike[str]"]

# The margin around bodies where nobody says the box, in spacings.
_MARGIN = 8.0


class Scene:
    """Bodies in a box. What its methods take are the keys of scene files (``sphpack init`` shows a whole one)::

        scene = sp.Scene(spacing=0.05, domain={"min": [-2, -2], "max": [2, 2]})
        scene.body(sp.circle((0, 0), 1), name="cylinder").packing(kernel="wendland-c2")
        particles = scene.pack()
    """

    def __init__(
        self,
        spacing: float | None = None,
        *,
        domain: Mapping[str, Any] | None = None,
        margin: float | None = None,
        **sections: Any,
    ) -> None:
        self._text: str | None = None
        self._path = "scene.toml"
        self._sections: dict[str, Any] = {"spacing": spacing, "domain": dict(domain or {}), "body": []}
        if margin is not None:
            self._sections["domain"]["margin"] = margin
        for name, section in sections.items():
            if name == "body":
                for body in section:
                    body = dict(body)
                    self.body(body.pop("shape"), **body)
            else:
                self._sections[name] = dict(section) if isinstance(section, dict) else section

    @classmethod
    def read(cls, path: Path) -> Scene:
        """A scene file."""
        path = pathlib.Path(path)
        try:
            text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"{path}: cannot be read ({error})") from None
        return cls.from_toml(text, path)

    @classmethod
    def from_toml(cls, text: str, path: Path = "scene.toml") -> Scene:
        """A scene's text; files are relative to the folder of ``path``."""
        scene = cls()
        scene._text, scene._path = text, os.fspath(path)
        return scene

    @classmethod
    def from_dict(cls, sections: Mapping[str, Any]) -> Scene:
        """A scene as a dictionary, in the form of scene files."""
        return cls(**sections)

    def _set(self, name: str, keys: Mapping[str, Any]) -> Scene:
        if self._text is not None:
            raise InputError("this scene is text; change that, or begin with Scene(spacing=…)")
        self._sections.setdefault(name, {}).update(keys)
        return self

    def body(self, shape: Any, name: str | None = None, **keys: Any) -> Scene:
        """Adds a body: a path, arrays, a mesh, or a shape such as ``sphpack.circle``; keys as in ``[[body]]``."""
        if self._text is not None:
            raise InputError("this scene is text; change that, or begin with Scene(spacing=…)")
        self._sections["body"].append({"name": name, "shape": as_shape(shape), **keys})
        return self

    def fluid(self, **keys: Any) -> Scene:
        """What is between the bodies: ``density``, ``fill``, ``hydrostatic``."""
        return self._set("fluid", keys)

    def packing(self, **keys: Any) -> Scene:
        """How to pack: ``method``, ``kernel``, ``h_over_spacing``, ``seed``, …"""
        return self._set("packing", keys)

    def quality(self, **keys: Any) -> Scene:
        """How the result is judged: ``kernel`` and ``h_over_spacing``; as packed where left out."""
        return self._set("quality", keys)

    def refinement(self, **keys: Any) -> Scene:
        """Particles that grow away from the bodies: ``coarsest``, ``growth``, …"""
        return self._set("refinement", keys)

    def output(self, **keys: Any) -> Scene:
        """What of the particles is kept: ``include``, ``surroundings``."""
        return self._set("output", keys)

    def _on_disk(self, folder: str) -> tuple[str, str]:
        """Text and path, with bodies of arrays in files in a folder."""
        if self._text is not None:
            return self._text, self._path
        sections = copy.copy(self._sections)
        sections["body"] = []
        for number, body in enumerate(self._sections["body"]):
            shape = body["shape"]
            if hasattr(shape, "write"):
                path = os.path.join(folder, f"body-{number}{shape.suffix}")
                shape.write(path)
                shape = {"file": path}
            elif "file" in shape:
                shape = {"file": os.path.abspath(shape["file"])}
            sections["body"].append({**body, "shape": shape})
        if not sections["domain"] and sections["spacing"]:
            sections["domain"] = {"margin": _MARGIN * sections["spacing"]}
        if sections["spacing"] is None:
            raise InputError("say how fine to pack: spacing=…")
        return to_toml(sections), "scene.toml"

    def to_toml(self) -> str:
        """The text of the scene, for ``sphpack pack``. Bodies that are arrays have no place in it."""
        if any(hasattr(body["shape"], "write") for body in self._sections["body"]):
            raise InputError("a body of this scene is an array; write it to a file, and give that")
        return self._on_disk("")[0]

    def plan(self) -> dict[str, Any]:
        """What packing would take, without doing it: particles, memory, evaluations."""
        with tempfile.TemporaryDirectory(prefix="sphpack-") as folder:
            return _native.plan(*self._on_disk(folder))

    def pack(
        self,
        *,
        progress: bool | Listener | None = None,
        threads: int | None = None,
        memory_bytes: float | None = None,
    ) -> Particles:
        """Packs the scene.

        ``progress``: ``True`` for a bar, or a function that is given a dictionary now and then. ``threads``: one for each
        core where left out; the particles are the same for any number. Ctrl-C raises :class:`Interrupted`, a
        ``KeyboardInterrupt`` with what there is.
        """
        told = listener(progress)
        try:
            with tempfile.TemporaryDirectory(prefix="sphpack-") as folder:
                columns, report, interrupted = _native.pack(
                    *self._on_disk(folder), threads, memory_bytes, told
                )
        finally:
            close = getattr(told, "close", None)
            if close is not None:
                close()
        report = json.loads(report)
        particles = _particles(columns, report)
        if isinstance(interrupted, KeyboardInterrupt):
            raise Interrupted(particles)
        if interrupted is not None:
            raise interrupted
        for words in report.get("warnings", ()):
            warnings.warn(words, UserWarning, stacklevel=2)
        if not particles.converged:
            warnings.warn(_unsettled(report, particles.stop_reason), NotSettled, stacklevel=2)
        return particles


def _particles(columns: dict[str, Any], report: dict[str, Any]) -> Particles:
    stop_reason = report["stop_reason"]
    if stop_reason == "converged" and not report["audit"]["passed"]:
        stop_reason = "unsound"
    bodies = [body["name"] for body in report["bodies"]]
    return Particles(columns, report, report["dimension"], bodies, stop_reason)


def _unsettled(report: dict[str, Any], stop_reason: str) -> str:
    messages = report["audit"]["messages"]
    what = "; ".join(messages) if messages else f"it has not settled ({stop_reason})"
    return f"do not rely on this packing: {what}"


def pack(
    body: Any,
    spacing: float | None = None,
    *,
    progress: bool | Listener | None = None,
    threads: int | None = None,
    memory_bytes: float | None = None,
    margin: float | None = None,
    **keys: Any,
) -> Particles:
    """Packs a body, or a scene file, and gives its particles::

        particles = sp.pack("bunny.stl", spacing=0.02, scale=10, surface="exact")

    ``body``: a path, ``(vertices, faces)``, an outline of shape (n, 2), a shape such as ``sphpack.circle``, a mesh of trimesh,
    pyvista or meshio, a :class:`Scene`, or a path that ends in ``.toml``. Around it is a box ``margin`` wide (eight spacings where
    left out). Other keys are those of ``[[body]]`` and ``[packing]`` of scene files.
    """
    scene = body
    if isinstance(body, (str, os.PathLike)) and os.fspath(body).lower().endswith(".toml"):
        scene = Scene.read(body)
    if isinstance(scene, Scene):
        if spacing is not None or margin is not None or keys:
            raise InputError("a scene says its spacing and all else itself; change it there")
    else:
        of_body = {key: keys.pop(key) for key in list(keys) if key in _BODY_KEYS}
        scene = Scene(spacing, margin=margin).body(body, **of_body)
        if keys:
            scene.packing(**keys)
    return scene.pack(progress=progress, threads=threads, memory_bytes=memory_bytes)


_BODY_KEYS = frozenset(
    "name scale rotate rotate_degrees translate role precedence density surface thin curvature".split()
)
