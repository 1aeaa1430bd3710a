"""The part that is written in Rust. Lists of points are flat."""

import os
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Path = str | os.PathLike[str]

class Body:
    @staticmethod
    def read(path: _Path) -> Body: ...
    @staticmethod
    def outline(loops: list[_Floats]) -> Body: ...
    @staticmethod
    def mesh(vertices: _Floats, triangles: NDArray[np.uint32]) -> Body: ...
    @property
    def dimension(self) -> int: ...
    @property
    def measure(self) -> float: ...
    @property
    def volume(self) -> float: ...
    @property
    def bounds(self) -> tuple[list[float], list[float]]: ...
    def closest(self, places: _Floats) -> tuple[_Floats, _Floats, _Floats]: ...
    def inside(self, places: _Floats) -> NDArray[np.bool_]: ...
    def sample(self, count: int) -> tuple[_Floats, _Floats]: ...

def check(path: _Path, spacing: float | None = None) -> str: ...
def command(arguments: list[str]) -> int: ...
def kernel_support(name: str) -> float: ...
def kernel_values(name: str, dimension: int, h: float, r: _Floats) -> tuple[_Floats, _Floats]: ...
def neighbors(
    places: _Floats,
    dimension: int,
    radius: float,
    periodic: tuple[list[float], list[float], list[bool]] | None = None,
) -> tuple[NDArray[np.uint32], NDArray[np.uint64]]: ...
def pack(
    text: str,
    path: _Path,
    threads: int | None = None,
    memory: float | None = None,
    progress: Callable[[dict[str, Any]], Any] | None = None,
) -> tuple[dict[str, NDArray[Any]], str, BaseException | None]: ...
def plan(text: str, path: _Path) -> dict[str, Any]: ...
def quality(
    position: _Floats,
    dimension: int,
    spacing: float,
    kernel: str,
    h_over_spacing: float,
    volume: _Floats | None = None,
    frozen: NDArray[np.bool_] | None = None,
) -> str: ...
def save(
    path: _Path,
    force: bool,
    dimension: int,
    stop_reason: str,
    bodies: list[str],
    columns: dict[str, NDArray[Any]],
) -> None: ...
