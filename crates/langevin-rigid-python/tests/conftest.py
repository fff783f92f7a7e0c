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
def rng() -> np.random.Generator:
    return np.random.default_rng(5)
