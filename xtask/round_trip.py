"""Reads particle files by other programs' readers and compares every array with the CSV file, bit for bit."""

import csv
import gzip
import struct
import sys
import tempfile
import xml.etree.ElementTree as xml
import zipfile
from pathlib import Path

import meshio
import numpy as np
import pysplashsurf  # noqa: F401: it has meshio read BGEO
import pyvista
from ovito.io import import_file

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


def lammps_by_ovito(path):
    """OVITO reads decimals to the last bit but one."""
    particles = import_file(str(path), atom_style="sph").compute().particles
    columns = {"id": np.asarray(particles["Particle Identifier"]) - 1.0}
    columns |= {name: np.asarray(particles.positions)[:, k] for k, name in enumerate("xyz")}
    columns["density"] = np.asarray(particles["Density"])
    columns["mass"] = np.asarray(particles["Mass"])
    return columns


def bgeo_by_splashsurf(path):
    """Its part for meshio reads compressed files alone; of the rest it says what type they are."""
    with tempfile.NamedTemporaryFile(suffix=".bgeo") as packed:
        packed.write(gzip.compress(path.read_bytes()))
        packed.flush()
        mesh = meshio.read(packed.name)
    columns = {name: np.asarray(column, np.float64) for name, column in mesh.point_data.items()}
    columns |= {name: np.asarray(mesh.points, np.float64)[:, k] for k, name in enumerate("xyz")}
    assert not columns.pop("velocity").any()
    columns["spacing"] = 2 * columns.pop("pscale")
    return columns


def particles_of(element):
    rows = [particle.attrib for particle in element.findall("particle")]
    assert [int(row["OriginalID"]) for row in rows] == list(range(len(rows)))
    places = np.array([[float(x) for x in row["Position"].split(", ")] for row in rows])
    columns = {name: places[:, k] for k, name in zip(range(places.shape[1]), "xyz")}
    columns["volume"] = np.array([float(row["VolumetricMeasure"]) for row in rows])
    return columns


def reload_by_etree(path):
    root = xml.parse(path).getroot()
    assert root.tag == "reload_data"
    parts = [(body.attrib["name"], particles_of(body)) for body in root.findall("body")]
    columns = {name: np.concatenate([part[name] for _, part in parts]) for name in parts[0][1]}
    names = [["" if name == "fluid" else name] * len(part["x"]) for name, part in parts]
    return columns | {"body": np.concatenate(names)}


def reload_body_by_etree(path):
    root = xml.parse(path).getroot()
    assert root.tag == "particles"
    return particles_of(root)


def bi4(path):
    """By the description of JBinaryData, with names and counts of the file beside it."""
    data = path.read_bytes()
    assert data[:58].rstrip() == b"#FileJBD JPartDataBi4" and data[58:64] == b"\n\0\0\0\0\0"
    at = 64

    def take(form):
        nonlocal at
        values = struct.unpack_from("<" + form, data, at)
        at += struct.calcsize("<" + form)
        return values[0] if len(values) == 1 else values

    def text():
        return take(f"{take('I')}s").decode("utf-8") if data[at : at + 4] != bytes(4) else take("I") and ""

    values, arrays = {}, {}

    def item():
        nonlocal at
        end = take("I") + at
        assert text() == "\nITEM\n"
        text(), take("2i"), text(), text()
        n_arrays, n_items, size = take("3I")
        assert at == end
        end = at + size
        assert text() == "\nVALUES"
        for _ in range(take("I")):
            name, kind = text(), take("i")
            values[name] = text() if kind == 1 else take({2: "i", 7: "i", 8: "I", 10: "Q", 12: "d", 23: "3d"}[kind])
        assert at == end
        for _ in range(n_arrays):
            end = take("I") + at
            assert text() == "\nARRAY"
            name, (_, kind, count, size) = text(), take("iiII")
            assert at == end
            dtype, width = {8: ("<u4", 1), 11: ("<f4", 1), 22: ("<f4", 3), 23: ("<f8", 3)}[kind]
            column = np.frombuffer(data, dtype, count * width, at).reshape(count, width)
            assert column.nbytes == size
            arrays[name], at = column, at + size
        for _ in range(n_items):
            item()

    item()
    assert at == len(data)
    particles = xml.parse(path.with_suffix(".xml")).getroot().find("execution/particles")
    assert [int(particles.attrib[key]) for key in ("np", "nb")] == [
        values["CaseNp"],
        values["CaseNp"] - values["CaseNfluid"],
    ]
    words_of = []
    for block in particles:
        assert int(block.attrib["begin"]) == len(words_of)
        words_of += [block.attrib.get("comment", "")] * int(block.attrib["count"])
    assert len(words_of) == values["CaseNp"]
    assert (arrays["Idp"][:, 0] == np.arange(len(words_of))).all() and not arrays["Vel"].any()
    x, y, z = arrays["Posd"].T
    if values["Data2d"]:
        y, z = z, y
    return {"x": x, "y": y, "z": z, "body": np.array(words_of)}


def by_body(wanted, names):
    """Some columns, bodies in the order of their names' list, the fluid last."""
    bodies = [name for name in dict.fromkeys(wanted["body"]) if name]
    places = [SCENES.index(body) if body in SCENES else len(SCENES) for body in wanted["body"]]
    assert all(body in SCENES for body in bodies)
    order = np.argsort(places, kind="stable")
    return {name: wanted[name][order] for name in names if name in wanted}


# The bodies of all scenes in their order there.
SCENES = ["left; 'wing', \"öl\" & <Ω> 翼, which is more than sixty-four bytes long", "second", " kugel #1 "]


def compare(found, wanted, padded, digits=64):
    """Every wanted array must be there, and nothing else but zeros for a third coordinate."""
    for name, values in wanted.items():
        assert name in found, f"{name} is missing"
        column = found[name]
        assert len(column) == len(values), f"{name} has {len(column)} of {len(values)} entries"
        if name in WORDS:
            same = column == values
        elif digits == 50:
            same = np.isclose(column, values, rtol=1e-15, atol=1e-15)
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
        some = lambda names: {key: wanted[key] for key in names.split() if key in wanted}
        reloaded = by_body(wanted, ["x", "y", "z", "volume", "body"])
        of_fluid = wanted["body"] == ""
        fluid = {key: column[of_fluid] for key, column in some("x y z volume").items()}
        placed = by_body(wanted, ["x", "y", "z", "body"])
        readers = [
            ("npz", "numpy", by_numpy, wanted, [], 64),
            ("vtu", "pyvista", by_pyvista, wanted, ["z", "nz"], 64),
            ("vtu", "meshio", by_meshio, wanted, ["z", "nz"], 64),
            ("vtp", "pyvista", by_pyvista, wanted, ["z", "nz"], 64),
            ("vtk", "pyvista", by_pyvista, wanted, ["z", "nz"], 64),
            ("ply", "meshio", ply_by_meshio, wanted, ["z", "nz"], 64),
            ("ply", "pyvista", points_by_pyvista, points, ["z"], 32),
            ("data", "ovito", lammps_by_ovito, some("id x y z mass density"), ["z"], 50),
            ("bgeo", "splashsurf", bgeo_by_splashsurf, some("id x y z mass density spacing"), ["z"], 32),
            ("-reload.xml", "etree", reload_by_etree, reloaded, [], 64),
            ("/fluid_rld.xml", "etree", reload_body_by_etree, fluid, [], 64),
            ("bi4", "struct", bi4, placed, ["z"], 64),
        ]
        for ending, reader, read, which, padded, digits in readers:
            try:
                file = f"{name}{ending}" if ending[0] in "-/" else f"{name}.{ending}"
                compare(read(folder / file), which, padded, digits)
                verdict = f"{len(which)} arrays agree" + (f" in {digits} bits" if digits < 64 else "")
            except Exception as error:
                verdict = f"FAIL: {type(error).__name__}: {error}"
                failures += 1
            print(f"{file:20} {reader:10} {verdict}")
    versions = f"numpy {np.__version__}, pyvista {pyvista.__version__}, VTK {pyvista.vtk_version_info}, meshio {meshio.__version__}"
    print(versions)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
