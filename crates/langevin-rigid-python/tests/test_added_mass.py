"""Added mass against closed forms, and its files."""

import json
import pickle

import numpy as np
import pytest
import trimesh

import langevin_rigid as lr

RADIUS = 0.1


@pytest.fixture(scope="module")
def ball() -> lr.AddedMass:
    sphere = trimesh.creation.icosphere(subdivisions=3, radius=RADIUS)
    return lr.added_mass(sphere, density=1000.0)


def test_a_sphere_of_arrays_has_half_the_fluid_it_displaces(ball):
    exact = 2 / 3 * np.pi * 1000.0 * RADIUS**3
    # The polyhedron is inside the sphere, by 0.6 % of the volume.
    assert np.diag(ball.matrix)[:3] == pytest.approx([exact] * 3, rel=1e-2)
    assert np.diag(ball.matrix)[:3] == pytest.approx([0.5 * 1000.0 * ball.volume] * 3, rel=2e-3)
    assert np.array_equal(ball.matrix, ball.matrix.T)
    assert ball.matrix.shape == (6, 6) and ball.matrix.flags.c_contiguous
    assert np.allclose(ball.centroid, 0, atol=1e-12)
    assert 0 < ball.error_estimate < 0.02
    assert ball.triangles == 1280 and ball.seconds > 0


def test_the_density_scales_it(ball):
    sphere = trimesh.creation.icosphere(subdivisions=3, radius=RADIUS)
    unit = lr.added_mass(lr.Mesh.of(sphere))
    assert np.allclose(1000.0 * unit.matrix, ball.matrix, rtol=1e-12, atol=1e-12)


def test_another_reference_point_moves_it_by_the_adjoint(ball):
    offset = np.array([0.0, 0.0, 2.0])
    moved = ball.about(offset)
    mass = ball.matrix[0, 0]
    assert moved.matrix[3, 3] == pytest.approx(ball.matrix[3, 3] + 4 * mass, rel=1e-3)
    assert np.allclose(moved.about(ball.centroid).matrix, ball.matrix, rtol=1e-9, atol=1e-9)
    assert np.array_equal(moved.reference, offset)


def test_files_for_other_programs(ball, tmp_path):
    for name in ("table", "json", "csv", "sdf", "uuv", "mujoco", "capytaine"):
        path = tmp_path / name
        ball.save(path, format=name)
        assert path.read_text() == ball.text(name) != ""
    read = json.loads(ball.text("json"))
    assert read["added_mass"] == ball.matrix.tolist()
    assert "<fluid_added_mass>" in ball.text("sdf")
    # These are about the point that their program wants, whatever the report's.
    for name in ("sdf", "uuv", "mujoco"):
        assert ball.about([0, 0, 0]).text(name) == ball.about([0, 0, 0]).about([0, 0, 0]).text(name)
    with pytest.raises(ValueError, match="`sfd` is no format of added mass; did you mean `sdf`"):
        ball.text("sfd")


def test_a_proxy_is_estimated_too(ball):
    sphere = trimesh.creation.icosphere(subdivisions=4, radius=RADIUS)
    proxy = lr.added_mass(sphere, density=1000.0, proxy=700)
    assert proxy.triangles == 5120 and proxy.triangles_solved < 5120
    assert proxy.matrix[0, 0] == pytest.approx(ball.matrix[0, 0], rel=0.02)


def test_what_is_impossible_is_named(cube):
    for density in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="density is .*must be a positive number"):
            lr.added_mass(cube, density=density)
    with pytest.raises(lr.BakeError, match="triangles .* are allowed"):
        lr.added_mass(cube, max_triangles=50)


def test_pickles_keep_it(ball):
    again = pickle.loads(pickle.dumps(ball))
    assert np.array_equal(again.matrix, ball.matrix)
    assert again.text("json") == ball.text("json")
