import numpy as np
import pytest

import sphpack as sp


@pytest.fixture(scope="session")
def disc():
    """A disc of radius 1 in a box, packed once."""
    return sp.pack(sp.circle((0.0, 0.0), 1.0), spacing=0.1, name="disc", density=2.0)


@pytest.fixture(scope="session")
def cube():
    """Vertices and faces of a cube from 0 to 1."""
    vertices = np.array([[k >> axis & 1 for axis in range(3)] for k in range(8)], dtype=float)
    faces = np.array(
        [
            [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
            [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
        ]
    )
    return vertices, faces
