"""Steps of one body, its loads, fluids and winds."""

import pickle

import numpy as np
import pytest

import langevin_rigid as lr


def test_the_same_seed_gives_the_same_bits(stepper):
    falls = []
    for seed in (3, 3, 4):
        state = lr.State(position=[0, 2, 0], orientation=[0.1, 0, 0, 1])
        falls.append(stepper.steps(state, 1 / 60, 60, seed=seed))
    assert np.array_equal(falls[0].positions, falls[1].positions)
    assert not np.array_equal(falls[0].positions, falls[2].positions)
    one = lr.State(position=[0, 2, 0], orientation=[0.1, 0, 0, 1])
    for _ in range(60):
        stepper.step(one, 1 / 60, seed=3)
    assert one == falls[0][-1]


def test_states_come_as_arrays(stepper):
    state = lr.State(position=[0, 2, 0])
    fall = stepper.steps(state, 0.01, 100, every=10, seed=1)
    assert len(fall) == 10 and fall[9] == fall[-1] == state
    assert fall.times == pytest.approx(0.1 * np.arange(1, 11))
    assert fall.steps.tolist() == list(range(10, 101, 10))
    assert fall.positions.shape == (10, 3) and fall.orientations.shape == (10, 4)
    for array in (fall.positions, fall.velocities, fall.world_velocities, fall.angular_velocities):
        assert array.dtype == np.float64 and array.flags.c_contiguous and array.shape == (10, 3)
    assert np.linalg.norm(fall.orientations, axis=1) == pytest.approx(1.0)
    last = fall[-1]
    assert np.allclose(last.rotation @ last.velocity, last.world_velocity, rtol=0, atol=1e-12)
    assert np.allclose(fall.world_velocities[-1], last.world_velocity)
    with pytest.raises(IndexError, match="there is no state 10 of 10"):
        fall[10]
    assert [s.step for s in fall] == fall.steps.tolist()


def test_a_table_of_states(stepper):
    pandas = pytest.importorskip("pandas")
    fall = stepper.steps(lr.State(), 0.01, 5)
    frame = fall.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == 5
    assert np.array_equal(frame[["x", "y", "z"]], fall.positions)
    assert np.array_equal(frame[["vx", "vy", "vz"]], fall.world_velocities)


def test_both_frames_of_a_velocity_are_one_motion():
    quarter = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]
    state = lr.State(orientation=quarter, world_velocity=[0, 1, 0], world_angular_velocity=[0, 0, 2])
    assert state.velocity == pytest.approx([1, 0, 0], abs=1e-12)
    state.velocity = [0, 1, 0]
    assert state.world_velocity == pytest.approx([-1, 0, 0], abs=1e-12)
    assert state.angular_velocity == pytest.approx([0, 0, 2])
    state.world_angular_velocity = [0, 3, 0]
    assert state.angular_velocity == pytest.approx([3, 0, 0], abs=1e-12)
    assert state.velocity.tolist() == [0, 1, 0]
    state.orientation = [0, 0, 0, 2]
    assert state.orientation.tolist() == [0, 0, 0, 1]
    with pytest.raises(TypeError, match="either velocity .* or world_velocity"):
        lr.State(velocity=[0, 0, 0], world_velocity=[0, 0, 0])
    assert pickle.loads(pickle.dumps(state)) == state
    other = state.copy()
    other.position = [1, 2, 3]
    assert other != state


def test_loads_sum_to_the_change_of_momentum(leaf):
    stepper = lr.Stepper(leaf, lr.Fluid.air(), separated={"turbulence_intensity": 0.0})
    push = {"force": [1e-4, 0, 2e-4], "torque": [1e-6, 2e-6, 0]}
    state = lr.State(
        position=[0, 2, 0], orientation=[0.2, 0.1, 0, 1], velocity=[0.4, -0.5, 0.1], angular_velocity=[1, 2, 3]
    )
    loads = stepper.loads(state, **push)
    dt = 1e-6
    after = state.copy()
    stepper.step(after, dt, **push)
    force = (stepper.linear_impulse(after) - stepper.linear_impulse(state)) / dt
    assert np.allclose(force, loads.sum.force, rtol=1e-3, atol=1e-4 * np.abs(force).max())
    torque = (stepper.angular_impulse(after) - stepper.angular_impulse(state)) / dt
    about_origin = loads.sum.torque + np.cross(state.position, loads.sum.force)
    about_origin += np.cross(state.world_velocity, stepper.linear_impulse(state))
    assert np.allclose(torque, about_origin, rtol=1e-3, atol=1e-4 * np.abs(torque).max())
    assert np.allclose(sum(w.force for w in loads.values()), loads.sum.force)
    assert loads["weight"].force == pytest.approx([0, -9.81 * leaf.mass, 0])
    assert loads["outside"].torque.tolist() == push["torque"]
    assert dict(loads).keys() == set(loads.keys()) and len(loads) == 12 and "drag" in loads
    with pytest.raises(KeyError, match="`lift` is no cause of loads"):
        loads["lift"]


def test_a_sphere_accelerates_with_half_the_fluid_it_displaces():
    ball = lr.Body.sphere(radius=0.05, density=600.0)
    stepper = lr.Stepper(ball, lr.Fluid.water(), model="kirchhoff")
    state = lr.State()
    stepper.steps(state, 1e-3, 100)
    displaced = 998.2 * ball.volume
    acceleration = 9.81 * (displaced - ball.mass) / (ball.mass + 0.5 * displaced)
    assert state.world_velocity[1] == pytest.approx(0.1 * acceleration, rel=1e-9)
    assert stepper.total_mass[0, 0] == pytest.approx(ball.mass + 0.5 * displaced)
    energy = 0.5 * (ball.mass + 0.5 * displaced) * state.world_velocity[1] ** 2
    assert stepper.kinetic_energy(state) == pytest.approx(energy)


def test_wind_and_flow_add_up(stepper):
    wind = lr.Wind.uniform([1, 0, 0]) + lr.Wind.uniform([0, 0, 2])
    assert wind.at([5, 5, 5], 3.0).tolist() == [1, 0, 2]
    assert wind.at(np.zeros((4, 3)), 0.0).tolist() == [[1, 0, 2]] * 4
    states = []
    for acting in (
        {"wind": wind},
        {"flow": [1, 0, 2]},
        {"flow": lr.Flow(velocity=[1, 0, 2])},
        {"wind": lr.Wind.uniform([1, 0, 0]), "flow": [0, 0, 2]},
    ):
        state = lr.State(position=[0, 2, 0])
        stepper.steps(state, 0.01, 50, **acting)
        states.append(state)
    assert all(state == states[0] for state in states)
    assert states[0].world_velocity[2] > 0.5


def test_every_field_blows():
    shear = lr.Wind.shear(velocity=[3, 0, 0], height=10.0, roughness=0.03)
    assert shear.at([0, 10, 0], 0.0) == pytest.approx([3, 0, 0])
    assert shear.flow([0, 2, 0], 0.0).gradient[0, 1] > 0
    power = lr.Wind.shear(velocity=[3, 0, 0], height=10.0, exponent=1 / 7)
    assert power.at([0, 5, 0], 0.0) == pytest.approx([3 * 0.5 ** (1 / 7), 0, 0])
    gusts = lr.Wind.gusts(rms=0.6, length=5.0, carried=[3, 0, 0], seed=1)
    assert not np.array_equal(gusts.at([0, 0, 0], 0), lr.Wind.gusts(rms=0.6, length=5.0, seed=2).at([0, 0, 0], 0))
    places = np.random.default_rng(0).uniform(-500, 500, (20000, 3))
    assert gusts.at(places, 0.0).std() == pytest.approx(0.6, rel=0.05)
    vortex = lr.Wind.vortex(centre=[0, 0, 0], axis=[0, 1, 0], circulation=2 * np.pi, core=0.01)
    assert vortex.at([2, 0, 0], 0.0) == pytest.approx([0, 0, -0.5])
    jet = lr.Wind.jet(centre=[0, 1, 0], axis=[1, 0, 0], speed=4.0, diameter=0.5)
    assert jet.at([0, 1, 0], 0.0)[0] == pytest.approx(4.0)
    values = np.zeros((2, 1, 1, 3))
    values[1, 0, 0] = [2, 0, 0]
    table = lr.Wind.table(origin=[0, 0, 0], spacing=[1, 1, 1], velocities=values)
    assert table.at([0.25, 0, 0], 0.0).tolist() == [0.5, 0, 0]
    times = lr.Wind.table(
        origin=[0, 0, 0], spacing=[1, 1, 1], velocities=np.stack([values, 3 * values]), times=[0, 1]
    )
    assert times.at([1, 0, 0], 0.5).tolist() == [4, 0, 0]
    box = lr.Wind.uniform([1, 0, 0]).within_box(centre=[0, 0, 0], size=[2, 2, 2], edge=0.1)
    assert box.at([0, 0, 0], 0.0).tolist() == [1, 0, 0]
    assert box.at([3, 0, 0], 0.0).tolist() == [0, 0, 0]
    assert lr.Wind().at([0, 0, 0], 0.0).tolist() == [0, 0, 0]
    assert "uniform within a region + jet" in repr(box + jet)


def test_a_wind_of_a_file(tmp_path):
    path = tmp_path / "wind.npz"
    velocity = np.zeros((2, 2, 2, 3))
    velocity[..., 0] = 5.0
    np.savez(path, origin=np.zeros(3), spacing=np.ones(3), velocity=velocity)
    assert lr.Wind.read(path).at([0.5, 0.5, 0.5], 0.0).tolist() == [5, 0, 0]
    with pytest.raises(lr.SetupError, match="none.npz"):
        lr.Wind.read(tmp_path / "none.npz")


def test_what_is_impossible_is_named(leaf, stepper):
    air = lr.Fluid.air()
    with pytest.raises(ValueError, match="`separate` is no model; did you mean `separated`"):
        lr.Stepper(leaf, air, model="separate")
    with pytest.raises(lr.SetupError, match="the fluid's density is -1; it must be a positive number"):
        lr.Stepper(leaf, lr.Fluid(density=-1.0, viscosity=1.0))
    with pytest.raises(lr.SetupError, match="rk4"):
        lr.Stepper(leaf, air, model="published", integrator="strang")
    lr.Stepper(leaf, air, model="published")
    with pytest.raises(TypeError, match="the model `separated` has no `atachment`; it has attachment"):
        lr.Stepper(leaf, air, separated={"atachment": 0.5})
    with pytest.raises(lr.SetupError, match="circulation of the vortex must be finite, not NaN"):
        lr.Wind.vortex(centre=[0, 0, 0], axis=[0, 1, 0], circulation=np.nan, core=0.01)
    with pytest.raises(lr.SetupError, match="the axis of the jet has no length"):
        lr.Wind.jet(centre=[0, 0, 0], axis=[0, 0, 0], speed=1.0, diameter=1.0)
    state = lr.State()
    with pytest.raises(ValueError, match="force is .*NaN.*must be finite"):
        stepper.step(state, 0.01, force=[np.nan, 0, 0])
    with pytest.raises(ValueError, match=r"flow has shape \(2,\)"):
        stepper.step(state, 0.01, flow=[1, 0])
    with pytest.raises(lr.StepError, match="the time step is -1 s"):
        stepper.step(state, -1.0)
    with pytest.raises(ValueError, match="orientation is .* no direction"):
        state.orientation = [0, 0, 0, 0]
    assert state == lr.State()


def test_a_step_that_cannot_be_taken_leaves_the_state(leaf):
    stepper = lr.Stepper(leaf, lr.Fluid.air(), model="published")
    state = lr.State(velocity=[3, 1, 2], angular_velocity=[30, 50, 70])
    with pytest.raises(lr.StepError, match="the state diverged at t = .*model `published`") as raised:
        stepper.steps(state, 0.1, 1000)
    assert raised.value.bodies == []
    assert np.isfinite(state.position).all() and state.step < 1000


def test_pickles_keep_steppers(leaf):
    history = lr.turbulence(inflow_speed=0.81, cell=0.01)
    stepper = lr.Stepper(
        leaf,
        lr.Fluid.air(velocity=[0.1, 0, 0]),
        turbulence="wake-age=16",
        history=history,
        gravity=[0, -1.6, 0],
        separated={"attachment": 0.5},
    )
    again = pickle.loads(pickle.dumps(stepper))
    assert repr(again) == repr(stepper)
    assert again.body == leaf and again.fluid == stepper.fluid
    ends = []
    for each in (stepper, again, lr.Stepper(leaf, lr.Fluid.air())):
        state = lr.State(position=[0, 2, 0], orientation=[0.3, 0, 0, 1])
        each.steps(state, 0.01, 50, seed=2)
        ends.append(state)
    assert ends[0] == ends[1] != ends[2]
