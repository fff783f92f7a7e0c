"""The package itself: examples, stubs, exceptions, what it prints."""

import doctest
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import langevin_rigid as lr
from langevin_rigid import _native


def examples():
    """The docstrings with examples of the package, its compiled part included, which doctest does not find by itself."""
    finder, parser = doctest.DocTestFinder(), doctest.DocTestParser()
    yield from finder.find(lr, "langevin_rigid")
    for name, thing in vars(_native).items():
        parts = [(name, thing)]
        if inspect.isclass(thing):
            parts += [(f"{name}.{part}", member) for part, member in vars(thing).items()]
        for where, part in parts:
            text = inspect.getdoc(part) or ""
            if ">>>" in text:
                yield parser.get_doctest(text, dict(vars(lr)), where, None, None)


@pytest.mark.parametrize("example", list(examples()), ids=lambda example: example.name)
def test_examples_run(example, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert doctest.DocTestRunner().run(example).failed == 0


def test_the_start_of_the_readme_runs():
    readme = (Path(__file__).parents[1] / "README.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    assert blocks
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})


def test_everything_public_is_documented():
    for name in lr.__all__:
        if name == "__version__":
            continue
        thing = getattr(lr, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and thing.__module__ == "langevin_rigid":
            for part, member in vars(thing).items():
                if not part.startswith("_"):
                    assert inspect.getdoc(member), f"{name}.{part}"


def test_stubs_are_those_of_the_package():
    pytest.importorskip("mypy")
    settings = Path(__file__).parents[1] / "pyproject.toml"
    command = [sys.executable, "-m", "mypy.stubtest", "--mypy-config-file", settings, "langevin_rigid"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_errors_are_of_one_family():
    for name in ("MeshError", "SceneError", "BakeError", "SetupError"):
        error = getattr(lr, name)
        assert issubclass(error, lr.LangevinRigidError) and issubclass(error, ValueError)
    assert issubclass(lr.StepError, lr.LangevinRigidError)
    assert issubclass(lr.LangevinRigidWarning, UserWarning)


def test_what_is_printed_says_something(leaf, stepper, cube):
    assert repr(leaf).startswith("<Body: 3.6000e-4 kg, 8.0000e-7 m^3")
    assert repr(cube) == "<Mesh box: 300 triangles over 152 vertices, 0.1000 x 0.1000 x 0.1000 m>"
    assert repr(lr.check(cube)) == "<Check of box: ready>"
    assert repr(lr.repair(cube)) == "<Repaired box: nothing to mend>"
    assert "model separated" in repr(stepper)
    assert repr(lr.Batch(stepper, count=3)) == "<Batch: 3 bodies, seed 0>"
    assert eval(repr(lr.Fluid.air()), vars(lr)) == lr.Fluid.air()
    state = lr.State(position=[1, 2, 3], velocity=[0.1, 0, 0], time=2.5)
    assert eval(repr(state), vars(lr)) == state
