"""Bodies in, particles out: evenly spread SPH particles that conform to bodies::

    import sphpack as sp
    particles = sp.pack("bunny.stl", spacing=0.02, scale=10, surface="exact")
    particles.position, particles.mass, particles.h, particles.normal
    particles.select(side="fluid").save("fluid.vtu")
"""

from importlib.metadata import PackageNotFoundError, version

from . import kernels
from ._errors import Error, InputError, Interrupted, NotSettled
from ._measure import check, neighbors, quality
from ._particles import Particles
from ._scene import Scene, pack
from ._sdf import Body, sdf
from ._shapes import (
    box,
    circle,
    cylinder,
    ellipse,
    ellipsoid,
    file,
    mesh,
    naca,
    outline,
    polygon,
    sphere,
    starfish,
    torus,
    zigzag,
)

try:
    __version__ = version("sphpack")
except PackageNotFoundError:
    __version__ = "unknown"

__all__ = [
    "Body",
    "Error",
    "InputError",
    "Interrupted",
    "NotSettled",
    "Particles",
    "Scene",
    "box",
    "check",
    "circle",
    "cylinder",
    "ellipse",
    "ellipsoid",
    "file",
    "kernels",
    "mesh",
    "naca",
    "neighbors",
    "outline",
    "pack",
    "polygon",
    "quality",
    "sdf",
    "sphere",
    "starfish",
    "torus",
    "zigzag",
]
