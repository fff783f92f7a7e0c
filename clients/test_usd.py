"""USD layers under usd-core: its validators, and what Pixar's reader makes of them."""

import json

import pytest
from conftest import client


@pytest.fixture(params=["y", "z"])
def stage(request, run, command, tmp_path):
    command("export", run.folder, "--format", "usd", "--fps", run.fps, "--up", request.param,
            "--out", tmp_path)
    usd = client("pxr.Usd")
    return usd.Stage.Open(str(tmp_path / "trajectory.usda"))


def problems(stage):
    validation = client("pxr.UsdValidation")
    validators = validation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) >= 25
    return [error.GetMessage() for error in validation.ValidationContext(validators).Validate(stage)]


def test_the_validators_report_nothing(stage):
    assert problems(stage) == []


def test_the_validators_would_report_something(stage):
    stage.ClearMetadata("upAxis")
    assert problems(stage) != []


def test_time_and_scale(stage, run):
    geometry = client("pxr.UsdGeom")
    last = max(row[1] for row in run.rows)
    assert geometry.GetStageMetersPerUnit(stage) == 1
    assert stage.GetTimeCodesPerSecond() == stage.GetFramesPerSecond() == run.fps
    assert stage.GetStartTimeCode() == 0
    assert stage.GetEndTimeCode() == pytest.approx(last * run.fps, abs=1e-6)
    assert stage.GetDefaultPrim().GetPath() == "/World"


def test_the_samples_are_the_trajectory(stage, run):
    """The transform of every body, at frames and as usd-core interpolates between them."""
    geometry, gf = client("pxr.UsdGeom"), client("pxr.Gf")
    summary = json.loads((run.folder / "summary.json").read_text())["deviation"]["usd"]
    up = geometry.GetStageUpAxis(stage)
    for body in range(run.bodies):
        prim = stage.GetPrimAtPath(f"/World/leaf_{body}")
        worst_frame = worst_between = 0
        for row in run.of(body):
            frame = row[0] * run.fps
            place = geometry.Xformable(prim).ComputeLocalToWorldTransform(frame)
            wanted = gf.Matrix4d().SetTransform(
                gf.Rotation(gf.Quatd(row[7], *row[4:7])), gf.Vec3d(*row[1:4]))
            if up == "Z":
                wanted *= gf.Matrix4d().SetRotate(gf.Rotation(gf.Vec3d(1, 0, 0), 90))
            away = (place.ExtractTranslation() - wanted.ExtractTranslation()).GetLength()
            if abs(frame - round(frame)) < 1e-9:
                worst_frame = max(worst_frame, away)
                turn = place.ExtractRotationQuat() * wanted.ExtractRotationQuat().GetInverse()
                assert abs(turn.GetReal()) > 1 - 1e-12
            worst_between = max(worst_between, away)
        assert worst_frame < 1e-6
        assert worst_between <= summary["position"] * (1 + 1e-6) + 1e-9


def test_bodies_share_one_mesh(stage, run):
    usd = client("pxr.Usd")
    bodies = [p for p in stage.GetDefaultPrim().GetChildren() if not p.IsAbstract()]
    assert len(bodies) == run.bodies
    if run.bodies > 1:
        assert len(stage.GetPrototypes()) == 1
        assert all(p.IsInstance() for p in bodies)
    meshes = [p for p in usd.PrimRange.Stage(stage, usd.TraverseInstanceProxies())
              if p.GetTypeName() == "Mesh"]
    assert len(meshes) == run.bodies


def test_our_parameters_come_along(stage, run):
    summary = json.loads((run.folder / "summary.json").read_text())
    data = stage.GetDefaultPrim().GetCustomDataByKey("langevin_rigid")
    assert data["model"] == summary["model"]
    gravity = [0, -9.81, 0] if client("pxr.UsdGeom").GetStageUpAxis(stage) == "Y" else [0, 0, -9.81]
    assert list(data["gravity_m_s2"]) == pytest.approx(gravity)
    shape = stage.GetPrimAtPath("/World/Shape").GetCustomDataByKey("langevin_rigid")
    assert shape["mass_kg"] == summary["mass"] and len(shape["added_mass_kg"]) == 36
