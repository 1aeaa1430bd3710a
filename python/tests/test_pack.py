"""Packing: what goes in, and what comes out. Judged by sums of its own."""

import math
import os
import subprocess
import sys
import textwrap
import warnings

import numpy as np
import pytest

import sphpack as sp


def test_a_disc_has_its_mass_and_even_density(disc):
    assert disc.converged and disc.dimension == 2
    assert disc.position.shape == (len(disc), 2)
    solid = disc.select(side="solid")
    assert math.isclose(solid.volume.sum(), math.pi, rel_tol=1e-9)
    assert np.allclose(solid.mass, 2.0 * solid.volume)
    assert np.hypot(*solid.position.T).max() < 1.0 - 0.05 + 1e-9
    assert np.hypot(*disc.select(side="fluid").position.T).min() > 1.0
    assert disc.quality["density"]["linf"] < 5e-3
    # Γ of a particle in the middle, by brute force.
    i = int(np.argmin(np.hypot(*disc.position.T)))
    r = np.hypot(*(disc.position - disc.position[i]).T)
    w = sp.kernels.Quintic(2)
    assert math.isclose((disc.volume * w(r, disc.h[i])).sum(), disc.gamma[i], rel_tol=1e-9)


def test_columns_are_words_numbers_and_views(disc):
    assert set(disc.kind) == {"free", "boundary"}
    assert set(disc.body) == {"disc", ""} and set(disc.side) == {"solid", "fluid"}
    assert np.shares_memory(disc.position, disc._columns["position"])
    surface = disc.kind == "boundary"
    radial = disc.position[surface] / np.hypot(*disc.position[surface].T)[:, None]
    # The particle surface of a circle is a circle; normals are those of the particle surface.
    assert np.allclose(disc.normal[surface], radial, atol=1e-9)
    assert not disc.normal[~surface].any()
    assert np.allclose(disc.h, 1.2 * disc.spacing) and np.allclose(disc.density[disc.side == "solid"], 2.0)
    assert not disc.pressure.any()
    assert len(np.unique(disc.id)) == len(disc)


def test_select_takes_words_masks_and_numbers(disc):
    assert len(disc.select(kind="boundary")) == (disc.kind_code == 1).sum()
    both = disc.select(kind=["boundary", "free"], body="disc")
    assert len(both) == (disc.body == "disc").sum()
    some = disc.select([0, 2, 4])
    assert (some.id == disc.id[[0, 2, 4]]).all() and (some.position == disc.position[[0, 2, 4]]).all()
    with pytest.raises(sp.InputError, match='no "liquid"; there are solid, fluid'):
        disc.select(side="liquid")


def test_the_same_for_arrays_files_and_any_number_of_threads(tmp_path):
    angle = np.linspace(0, 2 * math.pi, 300, endpoint=False)
    outline = np.stack([np.cos(angle), 0.5 * np.sin(angle)], axis=1)
    packed = sp.pack(outline, spacing=0.08, threads=1)
    again = sp.pack(sp.outline([outline]), spacing=0.08, threads=2)
    assert (packed.position == again.position).all()
    path = tmp_path / "ellipse.csv"
    np.savetxt(path, outline, delimiter=",", fmt="%.17g")
    from_file = sp.pack(path, spacing=0.08)
    assert (packed.position == from_file.position).all()


def test_meshes_of_every_kind(cube):
    vertices, faces = cube
    packed = sp.pack((vertices, faces), spacing=0.2, margin=0.8)
    assert math.isclose(packed.select(side="solid").volume.sum(), 1.0, rel_tol=1e-9)

    class Trimesh:
        def __init__(self):
            self.vertices, self.faces = vertices, faces

    class PolyData:
        points = vertices
        faces = np.hstack([np.full((len(cube[1]), 1), 3), cube[1]]).reshape(-1)

        def triangulate(self):
            return self

    class Meshio:
        points = vertices
        cells_dict = {"quad": np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])}

    for mesh in (Trimesh(), PolyData(), Meshio()):
        same = sp.pack(mesh, spacing=0.2, margin=0.8)
        assert math.isclose(same.select(side="solid").volume.sum(), 1.0, rel_tol=1e-9)


def test_scenes_are_texts_dictionaries_and_calls(tmp_path):
    scene = sp.Scene(0.2, domain={"min": [-1.5, -1.0], "max": [1.5, 1.0]})
    scene.body(sp.circle((-0.5, 0.0), 0.4), name="left").body(sp.circle((0.6, 0.0), 0.4), name="right")
    scene.fluid(density=3.0).packing(kernel="wendland-c2", h_over_spacing=1.3, seed=5)
    text = scene.to_toml()
    packed = scene.pack()
    assert packed.bodies == ["left", "right"] and packed.report["kernel"] == "wendland-c2"
    path = tmp_path / "two.toml"
    path.write_text(text, encoding="utf-8")
    sections = {
        "spacing": 0.2,
        "domain": {"min": [-1.5, -1.0], "max": [1.5, 1.0]},
        "body": [
            {"name": "left", "shape": sp.circle((-0.5, 0.0), 0.4)},
            {"name": "right", "shape": sp.circle((0.6, 0.0), 0.4)},
        ],
        "fluid": {"density": 3.0},
        "packing": {"kernel": "wendland-c2", "h_over_spacing": 1.3, "seed": 5},
    }
    for other in (sp.pack(path), sp.Scene.from_toml(text).pack(), sp.Scene.from_dict(sections).pack()):
        assert (other.position == packed.position).all()
    plan = scene.plan()
    assert plan["dimension"] == 2 and math.isclose(plan["particles"], len(packed), rel_tol=0.05)


def test_names_and_words_survive_the_way_through_toml():
    name = 'a "quoted" \\ name, Δs'
    scene = sp.Scene(0.3).body(sp.circle((0, 0), 1), name=name)
    assert scene.pack().bodies == [name]


def test_files_hold_what_arrays_hold(disc, tmp_path):
    path = tmp_path / "disc.npz"
    disc.save(path)
    with pytest.raises(sp.InputError, match="exists"):
        disc.save(path)
    disc.save(path, force=True)
    with np.load(path) as file:
        assert (file["x"] == disc.position[:, 0]).all()
        assert (file["mass"] == disc.mass).all()
        assert (file["kind"].astype(str) == disc.kind).all()
        assert (file["nx"] == disc.normal[:, 0]).all()
    disc.select(side="fluid").save(tmp_path / "fluid.vtu")
    with pytest.raises(sp.InputError, match="step"):
        disc.save(tmp_path / "disc.step")


def test_errors_have_the_words_of_the_command():
    with pytest.raises(sp.InputError, match='unknown key "kernl"; did you mean "kernel"'):
        sp.pack(sp.circle((0, 0), 1), spacing=0.1, kernl="quintic")
    with pytest.raises(sp.InputError, match="there is no such file") as caught:
        sp.pack("nowhere.stl", spacing=0.1)
    assert caught.value.status == 2 and isinstance(caught.value, ValueError)
    with pytest.raises(sp.InputError, match="spacing"):
        sp.pack(sp.circle((0, 0), 1))
    with pytest.raises(sp.InputError, match=r"shape \(n, 2\)"):
        sp.pack(np.zeros((5, 4)), spacing=0.1)
    with pytest.raises(sp.InputError, match="counted from 0"):
        sp.pack((np.zeros((3, 3)), [[0, 1, 3]]), spacing=0.1)
    with pytest.raises(TypeError, match="a body is a path"):
        sp.pack(42, spacing=0.1)
    with pytest.raises(sp.InputError, match="threads is 0"):
        sp.pack(sp.circle((0, 0), 1), spacing=0.1, threads=0)


def test_what_has_not_settled_is_said():
    with pytest.warns(sp.NotSettled, match="do not rely on"):
        packed = sp.pack(sp.circle((0, 0), 1), spacing=0.1, max_iterations=3)
    assert not packed.converged and packed.stop_reason != "converged"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sp.pack(sp.circle((0, 0), 1), spacing=0.1)


def test_progress_is_told_and_its_errors_are_raised():
    news = []
    sp.pack(sp.circle((0, 0), 1), spacing=0.02, progress=news.append)
    assert news and news[-1]["stage"] == "settling" and news[-1]["evaluation"] > 0

    class Enough(Exception):
        pass

    def stop(_):
        raise Enough

    with pytest.raises(Enough):
        sp.pack(sp.circle((0, 0), 1), spacing=0.02, progress=stop)


@pytest.mark.skipif(os.name == "nt", reason="signals are sent in another way there")
def test_ctrl_c_stops_and_keeps_what_there_is():
    # To a tolerance that cannot be met: it would go on for hours.
    code = textwrap.dedent(
        """
        import os, signal, time
        import sphpack as sp

        # Who starts the tests in the background may have it ignored.
        signal.signal(signal.SIGINT, signal.default_int_handler)

        def press(news):
            if news["evaluation"] > 20:
                os.kill(os.getpid(), signal.SIGINT)

        begin = time.monotonic()
        try:
            sp.pack(sp.circle((0, 0), 1), spacing=0.05, method="hybrid", velocity_tolerance=1e-300,
                    max_iterations=1000000000, progress=press)
        except KeyboardInterrupt as stop:
            assert isinstance(stop, sp.Interrupted)
            assert len(stop.particles) > 1000 and stop.particles.stop_reason == "interrupted"
            print("stopped", time.monotonic() - begin)
        """
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False)
    assert done.stdout.startswith("stopped"), done.stderr


def test_the_command_comes_along(tmp_path):
    run = [sys.executable, "-m", "sphpack"]
    listed = subprocess.run([*run, "list", "kernels"], capture_output=True, text=True, check=True)
    assert "quintic" in listed.stdout
    wrong = subprocess.run([*run, "pack", "nowhere.toml"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert wrong.returncode == 2 and "nowhere.toml" in wrong.stderr
