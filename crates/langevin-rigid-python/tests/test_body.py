"""Bodies: of simple form, baked, loaded."""

import pickle

import numpy as np
import pytest

import langevin_rigid as lr


@pytest.fixture(scope="module")
def coin() -> lr.Body:
    mesh = lr.Mesh.shape("coin", diameter=0.022, thickness=1.6e-3, hole=0.005, triangles=300)
    return lr.Body.bake(mesh, mass=5e-3)


def test_simple_forms_have_their_closed_forms():
    ball = lr.Body.sphere(radius=0.05, density=600.0)
    volume = 4 / 3 * np.pi * 0.05**3
    assert ball.volume == pytest.approx(volume, rel=1e-12)
    assert ball.mass == pytest.approx(600 * volume, rel=1e-12)
    assert ball.density == pytest.approx(600, rel=1e-12)
    assert np.diag(ball.inertia) == pytest.approx([0.4 * ball.mass * 0.05**2] * 3, rel=1e-12)
    assert np.diag(ball.added_mass)[:3] == pytest.approx([0.5 * volume] * 3, rel=1e-9)
    assert ball.half_extents == pytest.approx([0.05] * 3)
    assert ball.error_estimate is None and ball.warnings == []
    total = ball.total_mass(1000.0)
    assert total[0, 0] == pytest.approx(ball.mass + 500 * volume)
    for body in (
        lr.Body.ellipsoid(semi_axes=[0.1, 0.02, 0.05], density=500.0),
        lr.Body.disc(radius=0.05, thickness=0.001, density=500.0),
        lr.Body.plate(length=0.1, width=0.05, thickness=0.001, density=500.0),
        lr.Body.cylinder(radius=0.01, length=0.1, density=500.0),
        lr.Body.cuboid(size=[0.1, 0.02, 0.05], density=500.0),
    ):
        assert body.density == pytest.approx(500.0)
        assert body.thickness > 0 and body.length > 0
        assert np.linalg.eigvalsh(body.added_mass).min() >= -1e-12


def test_impossible_forms_are_named():
    with pytest.raises(lr.SetupError, match="the body's radius is -1; it must be a positive number"):
        lr.Body.sphere(radius=-1.0, density=1.0)
    with pytest.raises(lr.SetupError, match="the body's density is NaN"):
        lr.Body.sphere(radius=1.0, density=np.nan)
    with pytest.raises(ValueError, match=r"semi_axes has shape \(2,\); it must be \(3,\)"):
        lr.Body.ellipsoid(semi_axes=[1, 2], density=1.0)


def test_a_baked_ellipsoid_is_the_closed_form():
    mesh = lr.Mesh.shape("ellipsoid", semi_axes=[0.1, 0.02, 0.05], triangles=1280)
    baked = lr.Body.bake(mesh, density=500.0)
    form = lr.Body.ellipsoid(semi_axes=[0.1, 0.02, 0.05], density=500.0)
    largest = form.added_mass[:3, :3].max()
    assert np.allclose(baked.added_mass[:3, :3], form.added_mass[:3, :3], rtol=0, atol=3e-3 * largest)
    assert np.allclose(baked.drag_area, form.drag_area, rtol=0, atol=3e-3 * form.drag_area.max())
    assert 0 < baked.error_estimate < 0.02


def test_what_a_body_is_made_of(cube):
    heavy = lr.Body.bake(cube, density=500.0, ballast=[(0.5, [0.02, 0, 0], 0.0)])
    assert heavy.mass == pytest.approx(1.0)
    # The body frame is at the centre of mass, 1 cm from the middle.
    assert heavy.centre_of_buoyancy == pytest.approx([-0.01, 0, 0], abs=1e-9)
    half = lr.Body.bake(cube, density=500.0, regions=[([0, -1, -1], [1, 1, 1], 1500.0)])
    assert half.mass == pytest.approx(1.0)
    low = lr.Body.bake(cube, mass=0.7, centre_of_mass=[0, -0.01, 0], inertia=np.diag([1e-3] * 3))
    assert low.centre_of_buoyancy == pytest.approx([0, 0.01, 0], abs=1e-9)
    assert low.inertia.tolist() == np.diag([1e-3] * 3).tolist()
    with pytest.raises(lr.BakeError, match="neither a density nor a mass"):
        lr.Body.bake(cube)
    with pytest.raises(lr.BakeError, match="`inertia` beside regions or ballast"):
        lr.Body.bake(cube, density=1.0, inertia=np.eye(3), ballast=[(1.0, [0, 0, 0], 0.0)])
    with pytest.raises(ValueError, match=r"inertia has shape \(3,\); it must be \(3, 3\)"):
        lr.Body.bake(cube, density=1.0, inertia=[1, 1, 1])


def test_other_contents_move_the_frame():
    ball = lr.Body.sphere(radius=0.062, density=500.0)
    weighted = ball.with_mass_properties(mass=0.9, centre_of_mass=[0, -0.02, 0])
    assert weighted.mass == 0.9
    assert weighted.centre_of_buoyancy.tolist() == [0, 0.02, 0]
    assert np.array_equal(weighted.inertia, ball.inertia)
    with pytest.raises(lr.SetupError, match="inertia is not a symmetric positive definite matrix"):
        ball.with_mass_properties(inertia=-np.eye(3))
    grown = ball.scaled(2.0)
    assert grown.mass == pytest.approx(8 * ball.mass)


def test_bake_files_are_written_and_read(coin, tmp_path):
    path = tmp_path / "coin.lrbake"
    coin.save(path)
    again = lr.Body.load(path)
    assert again == coin and again.error_estimate == coin.error_estimate
    assert again.surface.volume == pytest.approx(coin.volume, rel=1e-9)
    assert np.array_equal(again.added_mass, coin.added_mass)
    path.write_bytes(coin.to_bytes()[:-9])
    with pytest.raises(lr.BakeError, match="it was cut off or added to"):
        lr.Body.load(path)
    with pytest.raises(FileNotFoundError, match="cannot read"):
        lr.Body.load(tmp_path / "none")


def test_pickles_keep_bodies(coin, leaf):
    assert pickle.loads(pickle.dumps(coin)) == coin
    assert pickle.loads(pickle.dumps(leaf)).error_estimate is None
    fluid = lr.Fluid(density=1.2, viscosity=1.5e-5, velocity=[1, 0, 0])
    assert pickle.loads(pickle.dumps(fluid)) == fluid


def test_turbulence_starts_as_equation_18_says_and_reaches_a_plateau(leaf):
    history = lr.turbulence(inflow_speed=0.81, cell=0.01)
    assert history.t.shape == history.k.shape == history.epsilon.shape == (33,)
    assert history.k[0] == pytest.approx(1.5 * 0.81**2)
    assert history.chi == pytest.approx(history.epsilon / history.k)
    assert history.chi[-1] == pytest.approx(history.chi[20], rel=1e-9)
    assert history.chi[-1] < history.chi[0]
    again = pickle.loads(pickle.dumps(history))
    assert np.array_equal(again.k, history.k) and again.interval == history.interval
    with_it = lr.Body.from_bytes(leaf.with_history(history).to_bytes())
    assert np.array_equal(with_it.history.epsilon, history.epsilon)
    with pytest.raises(lr.BakeError, match="inflow speed 0 m/s"):
        lr.turbulence(inflow_speed=0.0, cell=0.01)
    with pytest.raises(lr.SetupError, match="samples a precomputed history and there is none"):
        lr.Stepper(leaf, lr.Fluid.air(), turbulence="history")
    lr.Stepper(with_it, lr.Fluid.air(), turbulence="history")
