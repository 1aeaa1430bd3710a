"""Measuring: kernels, neighbours, distances and quality against formulas and brute force."""

import json
import math

import numpy as np
import pytest

import sphpack as sp

KERNELS = [sp.kernels.Quintic, sp.kernels.Cubic, sp.kernels.WendlandC2, sp.kernels.WendlandC4, sp.kernels.WendlandC6]


@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("dimension", [2, 3])
def test_kernels_integrate_to_one(kernel, dimension):
    w, h = kernel(dimension), 0.7
    r = (np.arange(20_000) + 0.5) / 20_000 * w.support * h
    shell = 2 * math.pi * r if dimension == 2 else 4 * math.pi * r * r
    assert math.isclose((w(r, h) * shell).sum() * (r[1] - r[0]), 1.0, rel_tol=1e-6)
    slope = (w(r[2:], h) - w(r[:-2], h)) / (r[2:] - r[:-2])
    assert np.allclose(slope, w.slope(r[1:-1], h), atol=1e-4 * abs(slope).max())
    assert w(np.zeros((2, 3)), h).shape == (2, 3)


def test_kernels_refuse_what_makes_no_sense():
    with pytest.raises(ValueError, match="dimension is 4"):
        sp.kernels.Cubic(4)
    with pytest.raises(sp.InputError, match="h is 0"):
        sp.kernels.Cubic(2)(0.1, 0.0)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("is_periodic", [False, True])
def test_neighbors_are_those_of_brute_force(dimension, is_periodic):
    points = np.random.default_rng(3).uniform(size=(300, dimension))
    radius = 0.2
    way = points[:, None] - points[None]
    if is_periodic:
        way -= np.round(way)
    near = np.linalg.norm(way, axis=2) <= radius
    np.fill_diagonal(near, False)
    box = ([0.0] * dimension, [1.0] * dimension)
    indices, starts = sp.neighbors(points, radius, periodic=box if is_periodic else None)
    for i in range(len(points)):
        assert list(indices[starts[i] : starts[i + 1]]) == list(np.flatnonzero(near[i]))
    assert len(sp.neighbors(np.empty((0, 3)), 1.0)[0]) == 0


def test_distances_to_a_cube(cube):
    distance = sp.sdf(cube)
    points = np.random.default_rng(5).uniform(-0.5, 1.5, size=(200, 3))
    beyond = np.maximum(np.abs(points - 0.5) - 0.5, 0.0)
    outside = np.linalg.norm(beyond, axis=1)
    inside = (np.abs(points - 0.5) - 0.5).max(axis=1)
    expected = np.where(outside > 0, outside, inside)
    assert np.allclose(distance(points), expected, atol=1e-12)
    assert (distance.inside(points) == (expected < 0)).all()
    assert math.isclose(distance.volume, 1.0) and math.isclose(distance.measure, 6.0)
    gap, nearest, normal = distance.closest(points.reshape(20, 10, 3))
    assert gap.shape == (20, 10) and nearest.shape == normal.shape == (20, 10, 3)
    where, normals = distance.sample(50)
    assert where.shape == normals.shape == (50, 3) and np.allclose(distance(where), 0.0, atol=1e-9)
    with pytest.raises(sp.InputError, match=r"shape \(…, 3\)"):
        distance(np.zeros((4, 2)))


def test_quality_of_a_lattice_and_of_what_was_packed(disc):
    side = (np.arange(20) + 0.5) * 0.1
    lattice = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    found = sp.quality(lattice, 0.1)
    assert found["audit"]["passed"] and found["density"]["linf"] < 1e-3 and found["residual"]["max"] < 1e-12
    moved = lattice.copy()
    moved[210] += 0.06
    assert sp.quality(moved, 0.1)["density"]["linf"] > 0.05
    again = sp.quality(disc)
    assert math.isclose(again["density"]["linf"], disc.quality["density"]["linf"], rel_tol=1e-6)
    with pytest.raises(sp.InputError, match="spacing"):
        sp.quality(lattice)


def test_check_says_what_is_wrong(tmp_path, cube):
    vertices, faces = cube
    path = tmp_path / "open.obj"
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a} {b} {c}" for a, b, c in faces[:-4] + 1]
    path.write_text("\n".join(lines))
    found = sp.check(path)
    assert not found["can_be_packed"] and found["reason"]
    json.dumps(found)
    path.write_text("\n".join(lines[:8] + [f"f {a} {b} {c}" for a, b, c in faces + 1]))
    assert sp.check(path, spacing=0.1)["can_be_packed"]
