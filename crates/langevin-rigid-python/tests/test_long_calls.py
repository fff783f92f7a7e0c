"""Long calls let other threads run and end at Ctrl-C."""

import multiprocessing
import threading
import time

import pytest

import langevin_rigid as lr


def fine_ball() -> lr.Mesh:
    return lr.Mesh.shape("ellipsoid", semi_axes=[0.1, 0.07, 0.05], triangles=20_000)


def long_calls():
    plate = lr.Body.plate(length=0.08, width=0.05, thickness=2e-4, density=450.0)
    stepper = lr.Stepper(plate, lr.Fluid.air())
    ball = fine_ball()
    # Its bake is kept for the call.
    lr.Scene.find("paper-75").bake()
    return {
        "added_mass": lambda: lr.added_mass(ball),
        "bake": lambda: lr.Body.bake(ball, density=500.0),
        "turbulence": lambda: lr.turbulence(inflow_speed=1.0, cell=0.01, cells=(64, 64, 64), duration=1e3),
        "steps": lambda: stepper.steps(lr.State(), 1e-3, 1_000_000_000, every=1_000_000),
        "crowd": lambda: lr.crowd("paper-75", 5000, seconds=600.0),
        "batch": lambda: lr.Batch(stepper, count=5000).step(1e-3, n=1_000_000),
    }


@pytest.mark.parametrize("name", ["added_mass", "bake", "turbulence", "steps", "batch", "crowd"])
def test_ctrl_c_ends_a_long_call(name, interrupted_after):
    call = long_calls()[name]
    with interrupted_after(0.3):
        call()


def test_other_threads_run_meanwhile():
    mesh = lr.Mesh.shape("ellipsoid", semi_axes=[0.1, 0.07, 0.05], triangles=5120)
    done = threading.Event()
    beats = []

    def beat():
        while not done.wait(0.005):
            beats.append(time.monotonic())

    other = threading.Thread(target=beat)
    other.start()
    started = time.monotonic()
    lr.added_mass(mesh)
    ended = time.monotonic()
    done.set()
    other.join()
    assert ended - started > 0.2, "too short to tell"
    during = [started] + [beat for beat in beats if started < beat < ended] + [ended]
    longest = max(b - a for a, b in zip(during, during[1:]))
    assert longest < 0.5 * (ended - started)


def added_mass_of(triangles: int) -> float:
    mesh = lr.Mesh.shape("ellipsoid", semi_axes=[0.1, 0.07, 0.05], triangles=triangles)
    return float(lr.added_mass(mesh).matrix[0, 0])


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="there is no fork here")
@pytest.mark.filterwarnings("ignore:.*multi-threaded.*fork:DeprecationWarning")
def test_a_forked_process_has_threads_of_its_own():
    here = added_mass_of(320)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.map_async(added_mass_of, [320]).get(timeout=60) == [here]
