"""GLB and USD opened by Blender: every body at its place, turned as it should be, at ten frames."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import skip

HERE = Path(__file__).parent
# Metres: what single precision leaves of a few metres, and the rounding of the files.
CLOSE = 1e-4


def opened(file, fps, frames):
    """Blender in a process of its own: it brings another build of USD's library."""
    if importlib.util.find_spec("bpy") is None:
        skip("bpy", "pip did not install it")
    done = subprocess.run(
        [sys.executable, HERE / "blender_vertices.py", file, str(fps), json.dumps(frames)],
        capture_output=True, text=True)
    found = [line for line in done.stdout.splitlines() if line.startswith("FOUND ")]
    assert found, done.stdout[-2000:] + done.stderr[-2000:]
    return json.loads(found[0].removeprefix("FOUND "))


def rotated(q, v):
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1],
            v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]]


def z_up(v):
    return [v[0], -v[2], v[1]]


def y_up(v):
    return [v[0], v[2], -v[1]]


@pytest.mark.parametrize("name, up", [("trajectory.glb", "y"), ("trajectory.usda", "y"),
                                      ("trajectory.usda", "z")])
def test_bodies_are_where_they_were(run, command, tmp_path, name, up):
    folder = run.folder
    if up == "z":
        folder = tmp_path
        command("export", run.folder, "--format", "usd", "--fps", run.fps, "--up", up,
                "--out", folder)
    frames = run.frames(0)
    found = opened(folder / name, run.fps, frames)
    assert found["meshes"] == 1
    assert found["metres"] == 1
    for frame, bodies in zip(frames, found["frames"], strict=True):
        assert len(bodies) == run.bodies
        for shown, vertices in bodies.items():
            body = int(shown.replace("_", ".").split(".")[1]) if run.bodies > 1 else 0
            place, turn = run.pose(body, frame)
            for own, world in vertices:
                # The glTF importer turns meshes to z up as well; the USD importer turns the whole.
                own = y_up(own) if name.endswith(".glb") else own
                wanted = z_up([p + r for p, r in zip(place, rotated(turn, own))])
                assert world == pytest.approx(wanted, abs=CLOSE), (frame, shown)


def test_the_body_itself_arrives(leaf):
    """Chosen vertices are apart, so that a turn that is off moves one of them."""
    vertices = opened(leaf.folder / "trajectory.glb", leaf.fps, [0])["frames"][0]["leaf"]
    a, b, c = (own for own, _ in vertices)
    apart = lambda p, q: sum((x - y) ** 2 for x, y in zip(p, q)) ** 0.5
    assert min(apart(a, b), apart(b, c), apart(c, a)) > 50 * CLOSE
