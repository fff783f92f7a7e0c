"""Many bodies at once, to the bits of one."""

import numpy as np
import pytest

import langevin_rigid as lr

COUNT = 600


def released(rng):
    return {
        "positions": rng.normal(size=(COUNT, 3)),
        "orientations": rng.normal(size=(COUNT, 4)),
        "velocities": rng.normal(size=(COUNT, 3)),
        "angular_velocities": rng.normal(size=(COUNT, 3)),
    }


@pytest.mark.parametrize("wind", [None, lr.Wind.gusts(rms=0.5, length=1.0) + lr.Wind.uniform([1, 0, 0])])
@pytest.mark.parametrize("pushed", [False, True])
@pytest.mark.parametrize("choices", [{}, {"model": "consistent", "integrator": "rk4"}], ids=["lanes", "one by one"])
def test_each_body_has_the_bits_of_a_stepper(leaf, rng, wind, pushed, choices):
    stepper = lr.Stepper(leaf, lr.Fluid.air(velocity=[0, 0, 0.3]), **choices)
    start = released(rng)
    batch = lr.Batch(stepper, **start, seed=9)
    push = {}
    if pushed:
        for name in ("force", "torque", "flow_velocity"):
            push[name] = 1e-6 * rng.normal(size=(COUNT, 3))
    dt, steps = 1e-4, 7
    assert batch.step(dt, n=steps, wind=wind, **push).size == 0
    for body in (0, 1, 17, 300, COUNT - 1):
        alone = lr.State(
            position=start["positions"][body],
            orientation=start["orientations"][body],
            velocity=start["velocities"][body],
            angular_velocity=start["angular_velocities"][body],
        )
        mine = {name.removesuffix("_velocity"): rows[body] for name, rows in push.items()}
        stepper.steps(alone, dt, steps, wind=wind, seed=9, body=body, **mine)
        assert batch.state(body) == alone
        assert np.array_equal(batch.positions[body], alone.position)
        assert np.array_equal(batch.world_velocities[body], alone.world_velocity)


def test_arrays_have_a_row_a_body(stepper):
    batch = lr.Batch(stepper, count=5, seed=1)
    batch.step(0.01, n=3)
    assert len(batch) == 5 and len(batch.states()) == 5
    assert batch.positions.shape == batch.velocities.shape == batch.angular_velocities.shape == (5, 3)
    assert batch.orientations.shape == (5, 4)
    assert batch.times == pytest.approx([0.03] * 5)
    assert batch.positions.flags.c_contiguous
    # Each has noise of its own.
    assert len(np.unique(batch.positions[:, 0])) == 5


def test_single_bodies_are_put_into_other_states(stepper, rng):
    batch = lr.Batch(stepper, positions=rng.normal(size=(40, 3)))
    batch.step(0.01, n=10)
    before = batch.states()
    batch.set([3, 7, -1], positions=[[1, 2, 3], [4, 5, 6], [7, 8, 9]], times=[0, 0, 0], steps=[0, 1, 2])
    assert batch.positions[[3, 7, 39]].tolist() == [[1, 2, 3], [4, 5, 6], [7, 8, 9]]
    assert batch.state(7).step == 1 and batch.state(7).time == 0
    assert np.array_equal(batch.velocities, before.velocities)
    assert batch.state(3).fluctuation.tolist() == [0] * 6
    assert all(batch.state(body) == before[body] for body in range(40) if body not in (3, 7, 39))
    batch.set_state(0, lr.State(position=[0, 1, 0]))
    assert batch.state(0) == lr.State(position=[0, 1, 0])
    with pytest.raises(IndexError, match="there is no body 40 in a batch of 40"):
        batch.set([40], positions=[[0, 0, 0]])
    with pytest.raises(ValueError, match="positions has 2 rows; it must have 1"):
        batch.set([0], positions=[[0, 0, 0]] * 2)
    with pytest.raises(ValueError, match="times has 2 numbers; it must have 1"):
        batch.set([0], times=[0, 0])
    with pytest.raises(ValueError, match="row 0 of positions is .*must be finite"):
        batch.set([0], positions=[[np.inf, 0, 0]])


def test_bodies_that_fail_are_named_and_the_others_go_on(stepper):
    def batch():
        made = lr.Batch(stepper, count=COUNT, seed=2)
        for body in (5, 555):
            broken = lr.State()
            broken.time = np.nan
            made.set_state(body, broken)
        return made

    quiet = batch()
    assert quiet.step(0.01, n=4, raises=False).tolist() == [5, 555]
    loud = batch()
    with pytest.raises(lr.StepError, match="2 of the bodies could not take a step, the first is body 5") as raised:
        loud.step(0.01, n=4)
    assert raised.value.bodies == [5, 555]
    sound = lr.Batch(stepper, count=COUNT, seed=2)
    sound.step(0.01, n=4)
    others = [body for body in range(COUNT) if body not in (5, 555)]
    for made in (quiet, loud):
        assert np.array_equal(made.positions[others], sound.positions[others])
        assert made.state(5).step == 0 and made.positions[5].tolist() == [0, 0, 0]


def test_what_does_not_fit_is_named(stepper):
    batch = lr.Batch(stepper, count=4)
    with pytest.raises(ValueError, match="force has 3 rows; it must have 4, one for each body"):
        batch.step(0.01, force=np.zeros((3, 3)))
    with pytest.raises(ValueError, match=r"torque has shape \(4, 2\); it must be \(4, 3\)"):
        batch.step(0.01, torque=np.zeros((4, 2)))
    with pytest.raises(ValueError, match="velocities has 2 rows; it must have 3"):
        lr.Batch(stepper, np.zeros((3, 3)), velocities=np.zeros((2, 3)))
    with pytest.raises(ValueError, match="row 1 of orientations is .* no direction"):
        lr.Batch(stepper, orientations=[[0, 0, 0, 1], [0, 0, 0, 0]])
    with pytest.raises(ValueError, match="give the positions of the bodies"):
        lr.Batch(stepper)
    with pytest.raises(lr.StepError, match="the time step is NaN s"):
        batch.step(np.nan)
