"""The command, its runs, and clients that may be missing."""

import csv
import importlib
import os
import subprocess

import pytest

SKIPPED = []


def client(name):
    """The module of a client; without it the test is skipped, and the end of the report says so."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        skip(name, error)


def skip(name, why):
    SKIPPED.append(name)
    pytest.skip(f"{name} is missing ({why}): NOT CHECKED")


def pytest_terminal_summary(terminalreporter):
    for name in sorted(set(SKIPPED)):
        terminalreporter.section(f"SKIPPED: {name} could not be had; nothing was checked with it",
                                 sep="!", red=True)


@pytest.fixture(scope="session")
def command():
    """Runs langevin-rigid, which has to succeed."""
    def run(*arguments):
        done = subprocess.run([os.environ["LANGEVIN_RIGID"], *map(str, arguments)],
                              capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done
    return run


class Run:
    """A folder that `simulate` wrote, and its table."""

    def __init__(self, folder, bodies, fps):
        self.folder, self.bodies, self.fps = folder, bodies, fps
        with open(folder / "trajectory.csv") as file:
            rows = csv.reader(file)
            self.columns = next(rows)
            self.rows = [[int(row[0]), *map(float, row[1:])] for row in rows]

    def of(self, body):
        """Rows of one body: t, x, y, z, qx, qy, qz, qw, ..."""
        return [row[1:] for row in self.rows if row[0] == body]

    def pose(self, body, frame):
        """Position and quaternion x, y, z, w at a frame, on the chord between the steps beside it."""
        time, rows = frame / self.fps, self.of(body)
        after = next((k for k, row in enumerate(rows) if row[0] >= time), len(rows) - 1)
        a, b = rows[max(after - 1, 0)], rows[after]
        part = min((time - a[0]) / (b[0] - a[0]), 1) if b[0] > a[0] else 0
        sign = 1 if sum(x * y for x, y in zip(a[4:8], b[4:8])) >= 0 else -1
        turn = [x + part * (sign * y - x) for x, y in zip(a[4:8], b[4:8])]
        size = sum(x * x for x in turn) ** 0.5
        place = [x + part * (y - x) for x, y in zip(a[1:4], b[1:4])]
        return place, [x / size for x in turn]

    def frames(self, body, count=10):
        """Whole frames from the first to the last of a body."""
        last = int(self.of(body)[-1][0] * self.fps)
        return [round(k * last / (count - 1)) for k in range(count)]


@pytest.fixture(scope="session")
def leaf(command, tmp_path_factory):
    folder = tmp_path_factory.mktemp("leaf")
    command("simulate", "leaf", "--format", "csv,npz,parquet,glb,usd", "--out", folder)
    return Run(folder, 1, 60)


@pytest.fixture(scope="session")
def leaves(command, tmp_path_factory):
    folder = tmp_path_factory.mktemp("leaves")
    command("simulate", "leaf", "--bodies", 12, "--fps", 48, "--seed", 5,
            "--format", "csv,npz,parquet,glb,usd", "--out", folder)
    return Run(folder, 12, 48)


@pytest.fixture(scope="session", params=["leaf", "leaves"])
def run(request):
    """One body, and several."""
    return request.getfixturevalue(request.param)
