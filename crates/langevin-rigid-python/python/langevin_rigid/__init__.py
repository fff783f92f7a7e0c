"""Light bodies moving through air or water: leaves, paper, coins in a pool, the hull of a drone.

A mesh is checked (`check`), mended (`repair`), and has an added mass (`added_mass`). A `Body`, of simple form or baked from a
mesh, moves in a `Fluid`: a `Stepper` advances its `State`, or that of many bodies in a `Batch`, in a `Wind` or not.

A `Scene` says all of it: `simulate` drops its body, `ensemble` drops it again and again, `sweep` does so for many scenes, on as
many machines as there are, and `crowd` tells how many bodies of it keep up with real time.

SI units, radians. The world is right-handed with +Y up; the body frame has its origin at the centre of mass and the axes of
the mesh. Six-vectors and 6x6 matrices have their linear part first, quaternions are x, y, z, w. Arrays that come out are
C-contiguous and belong to the caller. Long calls let other threads run, and Ctrl-C ends them.

>>> import langevin_rigid as lr
>>> leaf = lr.Body.plate(length=0.08, width=0.05, thickness=2e-4, density=450.0)
>>> fall = lr.Stepper(leaf, lr.Fluid.air()).steps(lr.State(position=[0, 2, 0]), 1 / 60, 60, seed=1)
>>> fall.positions.shape
(60, 3)
"""

from ._native import (
    AddedMass,
    Batch,
    Body,
    Check,
    Crowd,
    Directed,
    Ensemble,
    Flow,
    Fluid,
    Loads,
    Mesh,
    Regimes,
    Repaired,
    Run,
    Scene,
    State,
    States,
    Stepper,
    Table,
    TurbulenceHistory,
    Wind,
    Wrench,
    __version__,
    added_mass,
    check,
    crowd,
    direct,
    ensemble,
    regimes,
    repair,
    reproduce,
    simulate,
    turbulence,
)
from .errors import (
    BakeError,
    LangevinRigidError,
    LangevinRigidWarning,
    MeshError,
    SceneError,
    SetupError,
    StepError,
)
from .scatter import normal, uniform
from .sweep import DataSet, Sweep, sweep

__all__ = [
    "AddedMass",
    "BakeError",
    "Batch",
    "Body",
    "Check",
    "Crowd",
    "DataSet",
    "Directed",
    "Ensemble",
    "Flow",
    "Fluid",
    "LangevinRigidError",
    "LangevinRigidWarning",
    "Loads",
    "Mesh",
    "MeshError",
    "Regimes",
    "Repaired",
    "Run",
    "Scene",
    "SceneError",
    "SetupError",
    "State",
    "States",
    "StepError",
    "Stepper",
    "Sweep",
    "Table",
    "TurbulenceHistory",
    "Wind",
    "Wrench",
    "__version__",
    "added_mass",
    "check",
    "crowd",
    "direct",
    "ensemble",
    "normal",
    "regimes",
    "repair",
    "reproduce",
    "simulate",
    "sweep",
    "turbulence",
    "uniform",
]
