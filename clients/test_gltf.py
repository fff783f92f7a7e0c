"""GLB files under the Khronos validator."""

import json
import os
import shutil
import subprocess
from pathlib import Path

from conftest import skip

HERE = Path(__file__).parent
SCENES = ["coin", "business-card", "maple-seed", "feather", "airplane", "ellipsoid-water"]


def reports(files):
    if shutil.which("node") is None:
        skip("node", "it is not on the path")
    if not (Path(os.environ["CLIENTS_NODE_MODULES"]) / "gltf-validator").is_dir():
        skip("gltf-validator", "npm did not install it")
    done = subprocess.run(["node", HERE / "validate.mjs", *files], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_validator_finds_nothing(run, command, tmp_path):
    files = [run.folder / "trajectory.glb"]
    for scene in SCENES:
        command("simulate", scene, "--duration", 1.01, "--format", "glb", "--out", tmp_path / scene)
        files.append(tmp_path / scene / "trajectory.glb")
    for file, report in zip(files, reports(files), strict=True):
        found = [report[f"num{kind}"] for kind in ("Errors", "Warnings", "Infos", "Hints")]
        assert found == [0, 0, 0, 0], (file, report["messages"])
        assert report["info"]["animationCount"] == 1


def test_the_validator_would_find_something(leaf, tmp_path):
    damaged = bytearray((leaf.folder / "trajectory.glb").read_bytes())
    # The last number is of a rotation, which then is no unit quaternion.
    damaged[-4:] = b"\x00\x00\x00\x40"
    file = tmp_path / "damaged.glb"
    file.write_bytes(damaged)
    assert reports([file])[0]["numErrors"] > 0


def test_our_parameters_come_along(leaf):
    glb = (leaf.folder / "trajectory.glb").read_bytes()
    document = json.loads(glb[20:20 + int.from_bytes(glb[12:16], "little")])
    run = document["scenes"][0]["extras"]["langevin_rigid"]
    body = document["meshes"][0]["extras"]["langevin_rigid"]
    summary = json.loads((leaf.folder / "summary.json").read_text())
    assert run["model"] == summary["model"] and run["fluid_density_kg_m3"] == 1.204
    assert body["mass_kg"] == summary["mass"] and len(body["added_mass_kg"]) == 36
    assert run["largest_position_error_m"] == summary["deviation"]["glb"]["position"]
