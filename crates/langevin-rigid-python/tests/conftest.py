import contextlib
import signal

import numpy as np
import pytest

import langevin_rigid as lr


@pytest.fixture
def leaf() -> lr.Body:
    return lr.Body.plate(length=0.08, width=0.05, thickness=2e-4, density=450.0)


@pytest.fixture
def stepper(leaf: lr.Body) -> lr.Stepper:
    return lr.Stepper(leaf, lr.Fluid.air())


@pytest.fixture
def cube() -> lr.Mesh:
    return lr.Mesh.shape("box", size=[0.1, 0.1, 0.1], triangles=300)


@pytest.fixture
def interrupted_after():
    """Interrupts what runs in it after some seconds, as Ctrl-C does, which programs in the background may not hear."""
    if not hasattr(signal, "setitimer"):
        pytest.skip("sends itself a signal by a timer of Unix")

    def interrupt(*_):
        raise KeyboardInterrupt

    @contextlib.contextmanager
    def interrupted(seconds: float):
        before = signal.signal(signal.SIGALRM, interrupt)
        signal.setitimer(signal.ITIMER_REAL, seconds)
        try:
            with pytest.raises(KeyboardInterrupt):
                yield
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)

    return interrupted


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(5)
