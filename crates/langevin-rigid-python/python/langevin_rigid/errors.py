"""What is raised and warned of. The words are those of the command."""

__all__ = [
    "BakeError",
    "LangevinRigidError",
    "LangevinRigidWarning",
    "MeshError",
    "SceneError",
    "SetupError",
    "StepError",
]


class LangevinRigidError(Exception):
    """Any error of this package that is not about the type or the shape of an argument, or a file of the system."""


class MeshError(LangevinRigidError, ValueError):
    """A mesh is no closed body, or a mesh file cannot be understood."""


class SceneError(LangevinRigidError, ValueError):
    """A scene has a mistake, which is located."""


class BakeError(LangevinRigidError, ValueError):
    """The added mass, a body or its turbulence cannot be computed, or a bake file is damaged."""


class SetupError(LangevinRigidError, ValueError):
    """A body, a fluid, a wind or settings are impossible."""


class StepError(LangevinRigidError):
    """A step was not taken; what was to take it is as it was before the step."""

    bodies: list[int]
    """The numbers of the bodies of a batch that could not take it; empty for a stepper."""

    def __init__(self, message: str, bodies: list[int] | None = None) -> None:
        super().__init__(message)
        self.bodies = bodies or []


class LangevinRigidWarning(UserWarning):
    """A call did what was asked, but its caller should know something: what the reader of a mesh file passed over, that a kept
    bake was damaged and made anew, or that a bake could not be kept.

    `warnings.filterwarnings("error", category=LangevinRigidWarning)` makes errors of them.
    """
