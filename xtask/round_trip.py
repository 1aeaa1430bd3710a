"""Reads particle files by other programs' readers and compares every array with the CSV file, bit for bit."""

import csv
import sys
import zipfile
from pathlib import Path

import meshio
import numpy as np
import pyvista

WORDS = ["kind", "side", "body"]


def expected(path):
    """The columns of the CSV file: numbers as 64-bit floats, words as text."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    columns = dict(zip(rows[0], zip(*rows[1:])))
    return {
        name: np.array(values, dtype=str if name in WORDS else np.float64)
        for name, values in columns.items()
    }


def words(codes, names):
    """Names for whole numbers; an empty one for -1."""
    return np.array([names[int(code)] if code >= 0 else "" for code in codes])


def fields(data):
    """Names by column and number, from fields of one number each: `kind:free` is 0."""
    names = {}
    for field, code in data.items():
        column, _, name = field.partition(":")
        names.setdefault(column, {})[int(np.ravel(code)[0])] = name
    return names


def apart(columns):
    """Normals by axis; velocities, which are 0, are dropped."""
    for k, name in enumerate(["nx", "ny", "nz"]):
        columns[name] = columns["normal"][:, k]
    assert columns["velocity"].shape == columns["normal"].shape and not columns["velocity"].any()
    return {name: column for name, column in columns.items() if name not in ("normal", "velocity")}


def by_numpy(path):
    with np.load(path, allow_pickle=False) as archive:
        columns = {name: archive[name] for name in archive.files}
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        assert archive.comment.startswith(b"stop_reason "), archive.comment
    for name, column in columns.items():
        assert column.dtype.kind == ("U" if name in WORDS else "i" if name == "id" else "f"), name
    return columns


def by_pyvista(path):
    grid = pyvista.read(path)
    columns = {name: np.asarray(grid.point_data[name]) for name in grid.point_data.keys()}
    columns |= {name: np.asarray(grid.points)[:, k] for k, name in enumerate("xyz")}
    assert grid.n_cells == grid.n_points, "one cell for each particle"
    if path.suffix == ".vtk":
        names = {name: list(grid.field_data[f"{name}_names"]) for name in WORDS}
        assert list(grid.field_data["stop_reason"]) == ["converged"]
    else:
        names = fields(grid.field_data)
        assert names["stop_reason"] == {0: "converged"}
    for name in WORDS:
        columns[name] = words(columns[name], names[name])
    return apart(columns)


def points_by_pyvista(path):
    """VTK's reader of PLY knows coordinates, in 32 bits, and nothing else of ours."""
    return {name: np.asarray(pyvista.read(path).points)[:, k] for k, name in enumerate("xyz")}


def by_meshio(path):
    mesh = meshio.read(path)
    columns = {name: np.asarray(column) for name, column in mesh.point_data.items()}
    columns |= {name: mesh.points[:, k] for k, name in enumerate("xyz")}
    if path.suffix == ".vtu":
        names = fields(mesh.field_data)
        for name in WORDS:
            columns[name] = words(columns[name], names[name])
        columns = apart(columns)
    return columns


def ply_by_meshio(path):
    columns = by_meshio(path)
    names = {name: {} for name in WORDS}
    with open(path, "rb") as file:
        for line in iter(file.readline, b"end_header\n"):
            parts = line.decode("utf-8").rstrip("\n").split(" ", 3)
            if parts[0] == "comment" and parts[1] in WORDS:
                names[parts[1]][int(parts[2])] = parts[3]
    for name in WORDS:
        columns[name] = words(columns[name], names[name])
    return columns


def compare(found, wanted, padded, digits=64):
    """Every wanted array must be there, and nothing else but zeros for a third coordinate."""
    for name, values in wanted.items():
        assert name in found, f"{name} is missing"
        column = found[name]
        assert len(column) == len(values), f"{name} has {len(column)} of {len(values)} entries"
        if name in WORDS:
            same = column == values
        elif digits == 32:
            same = column.astype(np.float32).view(np.uint32) == values.astype(np.float32).view(np.uint32)
        else:
            same = column.astype(np.float64).view(np.uint64) == values.view(np.uint64)
        assert np.all(same), f"{name} differs in {np.count_nonzero(~same)} entries"
    for name in set(found) - set(wanted):
        assert name in padded and not np.any(found[name]), f"{name} should not be there"


def main(folder):
    failures = 0
    for name in ["plane", "space"]:
        wanted = expected(folder / f"{name}.csv")
        points = {key: column for key, column in wanted.items() if key in "xyz"}
        readers = [
            ("npz", "numpy", by_numpy, wanted, [], 64),
            ("vtu", "pyvista", by_pyvista, wanted, ["z", "nz"], 64),
            ("vtu", "meshio", by_meshio, wanted, ["z", "nz"], 64),
            ("vtp", "pyvista", by_pyvista, wanted, ["z", "nz"], 64),
            ("vtk", "pyvista", by_pyvista, wanted, ["z", "nz"], 64),
            ("ply", "meshio", ply_by_meshio, wanted, ["z", "nz"], 64),
            ("ply", "pyvista", points_by_pyvista, points, ["z"], 32),
        ]
        for ending, reader, read, which, padded, digits in readers:
            try:
                compare(read(folder / f"{name}.{ending}"), which, padded, digits)
                verdict = f"{len(which)} arrays agree" + (" in 32 bits" if digits == 32 else "")
            except Exception as error:
                verdict = f"FAIL: {type(error).__name__}: {error}"
                failures += 1
            print(f"{name}.{ending:4} {reader:8} {verdict}")
    versions = f"numpy {np.__version__}, pyvista {pyvista.__version__}, VTK {pyvista.vtk_version_info}, meshio {meshio.__version__}"
    print(versions)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
