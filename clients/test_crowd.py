"""A crowd of kinds, sizes and looks in Blender, under the Khronos validator and in usd-core."""

import base64
import csv
import json
import struct
import zlib

import pytest
from conftest import client
from test_blender import opened, rotated, y_up, z_up
from test_gltf import reports

FPS = 24
# One pixel of red.
PNG = b"\x89PNG\r\n\x1a\n"


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def picture():
    header = chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0))
    return PNG + header + chunk(b"IDAT", zlib.compress(b"\0\xff\0\0")) + chunk(b"IEND", b"")


def textured_square(path):
    """A square of 8 cm with a texture, as an artist's leaf might be."""
    corners = [(-0.04, 0, -0.025), (-0.04, 0, 0.025), (0.04, 0, 0.025), (0.04, 0, -0.025)]
    data = b"".join(struct.pack("<3f", *corner) for corner in corners)
    data += struct.pack("<12f", *(0, 1, 0) * 4)
    data += struct.pack("<8f", 0, 0, 0, 1, 1, 1, 1, 0)
    data += struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    views = [(0, 48), (48, 48), (96, 32), (128, 12)]
    accessor = lambda view, kind, count, **more: {
        "bufferView": view, "componentType": 5126, "type": kind, "count": count, **more}
    path.write_text(json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "look"}],
        "meshes": [{"primitives": [{
            "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}],
        "materials": [{"name": "painted", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": "data:image/png;base64," + base64.b64encode(picture()).decode()}],
        "accessors": [
            accessor(0, "VEC3", 4, min=[-0.04, 0, -0.025], max=[0.04, 0, 0.025]),
            accessor(1, "VEC3", 4), accessor(2, "VEC2", 4),
            {"bufferView": 3, "componentType": 5123, "type": "SCALAR", "count": 6}],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in views],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    }))


SCENE = """
fluid.preset = "air"
release = { position = [0.0, 0.6, 0.0] }
run = { time_step = 0.004, duration = 6.0, ground = 0.0 }

[body]
shape = "leaf"
length = 0.08
width = 0.05
thickness = 6e-4
triangles = 320
density = 400.0
visual = "look.gltf"

[crowd]
count = 12
over = [0.5, 0.1, 0.5]
during = 1.0
orientation = "any"
sizes = [0.7, 1.4]
kinds = [{ scene = "coin", share = 0.5 }]
"""


@pytest.fixture(scope="module")
def crowd(command, tmp_path_factory):
    folder = tmp_path_factory.mktemp("crowd")
    textured_square(folder / "look.gltf")
    (folder / "garden.toml").write_text(SCENE)
    command("simulate", folder / "garden.toml", "--fps", FPS, "--format", "csv,glb,usd",
            "--out", folder / "out")
    return folder / "out"


@pytest.fixture(scope="module")
def bodies(crowd):
    """Kind and size of each body, when it appears, where it comes to lie."""
    with open(crowd / "bodies.csv") as file:
        rows = list(csv.DictReader(file))
    poses = {int(row["body"]): [] for row in rows}
    with open(crowd / "trajectory.csv") as file:
        for row in csv.DictReader(file):
            poses[int(row["body"])].append([float(row[key]) for key in ("t", "x", "y", "z", "qx", "qy", "qz", "qw")])
    return {int(row["body"]): (row["kind"], float(row["scale"]), poses[int(row["body"])]) for row in rows}


def test_sizes_and_kinds_are_those_asked_for(bodies):
    kinds = {kind for kind, _, _ in bodies.values()}
    assert kinds == {"garden", "coin"}
    assert len(bodies) == 12
    assert all(0.7 <= scale <= 1.4 for _, scale, _ in bodies.values())


def test_the_validator_finds_nothing(crowd):
    report = reports([crowd / "trajectory.glb"])[0]
    found = [report[f"num{kind}"] for kind in ("Errors", "Warnings")]
    assert found == [0, 0], report["messages"]


def test_blender_shows_each_at_its_size_when_it_is_there(crowd, bodies):
    end = max(poses[-1][0] for _, _, poses in bodies.values())
    last = int(end * FPS)
    first, final = opened(crowd / "trajectory.glb", FPS, [0, last])["frames"]
    coins = {body: of for body, of in bodies.items() if of[0] == "coin"}
    # An artist's objects have names of their own.
    assert sum(name.startswith("look") for name in final) == len(bodies) - len(coins)
    hidden = 0
    for body, (_, scale, poses) in coins.items():
        name = f"coin.{body:04}"
        place, turn = poses[-1][1:4], poses[-1][4:]
        for own, world in final[name]:
            grown = [scale * x for x in y_up(own)]
            wanted = z_up([p + r for p, r in zip(place, rotated(turn, grown))])
            assert world == pytest.approx(wanted, abs=2e-4)
        (own, shown), (other_own, other_shown) = first[name][:2]
        apart = lambda p, q: sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5
        size, there = apart(shown, other_shown), apart(own, other_own)
        if poses[0][0] > 1 / FPS:
            assert size < 1e-6, (body, size)
            hidden += 1
        else:
            assert size == pytest.approx(scale * there, rel=1e-3)
    assert hidden > 0


def test_the_artists_texture_comes_along(crowd):
    glb = (crowd / "trajectory.glb").read_bytes()
    document = json.loads(glb[20:20 + int.from_bytes(glb[12:16], "little")])
    assert "painted" in [material["name"] for material in document["materials"]]
    assert len(document["images"]) == 1


def test_usd_hides_a_body_until_it_is_let_go(crowd, bodies):
    usd, geometry = client("pxr.Usd"), client("pxr.UsdGeom")
    stage = usd.Stage.Open(str(crowd / "trajectory.usda"))
    for body, (kind, _, poses) in bodies.items():
        prim = geometry.Imageable(stage.GetPrimAtPath(f"/World/{kind}_{body}"))
        start = poses[0][0] * FPS
        assert prim.ComputeVisibility(stage.GetEndTimeCode()) == "inherited"
        if start > 1:
            assert prim.ComputeVisibility(0) == "invisible"


def test_export_makes_the_same_files_again(crowd, command, tmp_path):
    command("export", crowd, "--format", "glb,usd", "--fps", FPS, "--out", tmp_path)
    for name in ("trajectory.glb", "trajectory.usda"):
        assert (tmp_path / name).read_bytes() == (crowd / name).read_bytes()
