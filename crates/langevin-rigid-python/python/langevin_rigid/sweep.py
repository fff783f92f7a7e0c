"""Sweeps: ensembles of many scenes as one data set of Parquet files, on one core or a thousand.

A sweep has points, each a scene with parameters of its own, and so many runs of each. All runs are numbered one after the
other, those of a point together, and divided into partitions. A partition is a pure function of its number: whoever computes
it, whenever and beside whatever, its file has the same bytes. It is written whole or not at all, so what is there need not be
made again. A cluster of dask is asked for partitions that are missing; it holds no results.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ._native import Scene, __version__, _sweep_part
from .errors import SceneError

__all__ = ["DataSet", "Sweep", "sweep"]

PARTITION = 16384
"""Runs of a partition, unless said otherwise: seconds of work, some megabytes."""

_DESCRIPTION = "sweep.json"


class Sweep:
    """What is swept: scenes, parameters, seeds and runs.

    `scenes` is one or several, each as `simulate` takes it. `parameters` are values by their names in the scene file
    (`"release.tilt"`, `"body.mass"`, `"scatter.height"`); every combination of them is a point, with every scene and every
    seed of `seeds`, if given. `runs` is the number of runs of each point.

    In the table a parameter has a column, its name with underscores for dots: of numbers, of lists of numbers where all its
    values are such lists, else of words.

    >>> falls = Sweep("coin", runs=1000, parameters={"release.tilt": [0, 30, 60], "body.mass": [0.005, 0.01]})
    >>> falls.points, falls.total, falls.partitions
    (6, 6000, 1)
    """

    def __init__(
        self,
        scenes: Any,
        *,
        runs: int,
        parameters: Mapping[str, Sequence[Any]] | None = None,
        seeds: Sequence[int] | None = None,
        partition: int = PARTITION,
    ) -> None:
        if isinstance(scenes, (str, os.PathLike, Mapping, Scene)):
            scenes = [scenes]
        self.scenes = [_scene(scene) for scene in scenes]
        axes = {name: list(values) for name, values in (parameters or {}).items()}
        if seeds is not None:
            axes["run.seed"] = list(seeds)
        self.parameters = axes
        self._told = {name: _told(values) for name, values in axes.items()}
        self.runs = _positive("runs", runs)
        self.partition = _positive("partition", partition)
        empty = [name for name, values in axes.items() if not values]
        if not self.scenes or empty:
            raise SceneError(f"a sweep needs at least one {'value of `' + empty[0] + '`' if empty else 'scene'}")
        names = [_column(name) for name in axes]
        twice = [name for name in names if names.count(name) > 1 or name in _OTHER_COLUMNS]
        if twice:
            raise SceneError(f"the column `{twice[0]}` would come twice: rename or leave out a parameter")
        # A mistake shows here and not on some worker: every value is tried once, and the last of all together.
        for scene in self.scenes:
            for name, values in axes.items():
                for value in values:
                    scene.changed({name: value})
        self.scene(self.points - 1)

    @property
    def points(self) -> int:
        """How many points there are."""
        count = len(self.scenes)
        for values in self.parameters.values():
            count *= len(values)
        return count

    @property
    def total(self) -> int:
        """How many runs there are in all."""
        return self.points * self.runs

    @property
    def partitions(self) -> int:
        """How many partitions there are."""
        return -(-self.total // self.partition)

    def values(self, point: int) -> dict[str, Any]:
        """The parameters of a point, by their names in the scene file; the last one changes fastest."""
        return {name: self.parameters[name][place] for name, place in self._places(point).items()}

    def _places(self, point: int) -> dict[str, int]:
        """Where among its values each parameter of a point is."""
        places = {}
        for name, choices in reversed(self.parameters.items()):
            point, places[name] = divmod(point, len(choices))
        return dict(reversed(places.items()))

    def scene(self, point: int) -> Scene:
        """The scene of a point."""
        scene = self.scenes[point // (self.points // len(self.scenes))]
        return scene.changed(self.values(point))

    @property
    def fingerprint(self) -> str:
        """What decides about every number of the data set."""
        content = {
            "version": __version__,
            "scenes": [scene.to_toml() for scene in self.scenes],
            "texts": [scene.text for scene in self.scenes],
            "parameters": [[name, [_plain(value) for value in values]] for name, values in self.parameters.items()],
            "runs": self.runs,
            "partition": self.partition,
        }
        return hashlib.sha256(json.dumps(content).encode()).hexdigest()

    def pieces(self, number: int) -> Iterator[tuple[int, Scene, dict[str, Any], int, int]]:
        """What a partition is made of: points with some of their runs."""
        first = number * self.partition
        last = min(first + self.partition, self.total)
        for point in range(first // self.runs, -(-last // self.runs)):
            start = point * self.runs
            scene = self.scene(point)
            places = self._places(point).items()
            parameters = {_column(name): self._told[name][place] for name, place in places if name != "run.seed"}
            if len(self.scenes) > 1:
                parameters = {"scene": scene.name, **parameters}
            yield point, scene, parameters, max(first - start, 0), min(last - start, self.runs)

    def compute(self, number: int, path: str | os.PathLike[str], *, cache: bool | str | os.PathLike[str] = True) -> None:
        """Computes a partition on this thread and writes its file."""
        _sweep_part(list(self.pieces(number)), os.fspath(path), cache)

    def __repr__(self) -> str:
        return f"<Sweep: {self.points} points, {self.total} runs, {self.partitions} partitions>"


class DataSet:
    """The partitions of a sweep in a folder."""

    def __init__(self, folder: str | os.PathLike[str], sweep: Sweep) -> None:
        self.folder = Path(folder)
        self.sweep = sweep

    def file(self, number: int) -> Path:
        """The file of a partition."""
        return self.folder / f"part-{number:08}.parquet"

    @property
    def files(self) -> list[Path]:
        """The files of all partitions, in their order."""
        return [self.file(number) for number in range(self.sweep.partitions)]

    @property
    def missing(self) -> list[int]:
        """The partitions that are not there yet."""
        there = set(os.listdir(self.folder)) if self.folder.exists() else set()
        return [number for number in range(self.sweep.partitions) if self.file(number).name not in there]

    def claim(self) -> None:
        """Makes the folder that of this sweep, or makes sure that it is.

        Raises SceneError where it is that of another.
        """
        self.folder.mkdir(parents=True, exist_ok=True)
        place = self.folder / _DESCRIPTION
        wanted = {"fingerprint": self.sweep.fingerprint, "points": self.sweep.points, "runs": self.sweep.runs,
                  "partition": self.sweep.partition, "partitions": self.sweep.partitions}
        try:
            found = json.loads(place.read_text())
        except FileNotFoundError:
            if any(self.folder.glob("part-*.parquet")):
                raise SceneError(f"`{self.folder}` has partitions, but no {_DESCRIPTION}: choose an empty folder") from None
            temporary = place.with_suffix(f".{os.getpid()}")
            temporary.write_text(json.dumps(wanted, indent=2) + "\n")
            temporary.replace(place)
            return
        except ValueError as error:
            raise SceneError(f"`{place}` is damaged ({error}): choose an empty folder") from None
        if not isinstance(found, dict) or found.get("fingerprint") != wanted["fingerprint"]:
            raise SceneError(f"`{self.folder}` is of another sweep, or of another version: choose an empty folder")

    def to_pandas(self, columns: Sequence[str] | None = None) -> Any:
        """All partitions as one pandas.DataFrame. Needs pandas and pyarrow."""
        import pandas

        tables = [pandas.read_parquet(file, columns=columns) for file in self.files]
        return pandas.concat(tables, ignore_index=True)

    def __repr__(self) -> str:
        return f"<DataSet of {self.sweep.partitions} partitions in {self.folder}>"


def sweep(
    scenes: Any,
    folder: str | os.PathLike[str],
    *,
    runs: int,
    parameters: Mapping[str, Sequence[Any]] | None = None,
    seeds: Sequence[int] | None = None,
    partition: int = PARTITION,
    client: Any = None,
    workers: int | None = None,
    cache: bool | str | os.PathLike[str] = True,
) -> DataSet:
    """Computes a sweep into a folder: see `Sweep` for what it is, and `DataSet` for what comes.

    The partitions go to the workers of `client`, a `dask.distributed.Client`, which write them into `folder`: all of them
    must see it. Without a client a cluster of `workers` processes is started here, one for each core by default; with
    `workers=0` this process does the work alone. What is in the folder is not made again: start the same sweep again and it
    goes on where it stopped.

    Raises SceneError where the folder has another sweep.
    """
    data = DataSet(folder, Sweep(scenes, runs=runs, parameters=parameters, seeds=seeds, partition=partition))
    data.claim()
    missing = data.missing
    if not missing:
        return data
    # Bodies are baked before the workers ask for them all at once.
    for scene in data.sweep.scenes:
        scene.bake(cache=cache)
    if client is not None:
        _distribute(data, missing, client, cache)
    elif workers == 0:
        for number in missing:
            _compute(data, number, cache)
    else:
        from dask.distributed import Client, LocalCluster

        with LocalCluster(n_workers=workers or _cores(), threads_per_worker=1, dashboard_address=None) as cluster:
            with Client(cluster) as here:
                _distribute(data, missing, here, cache)
    return data


def _distribute(data: DataSet, missing: list[int], client: Any, cache: Any) -> None:
    """Has the workers compute what is missing, some ahead of what they do: millions of tasks would drown the scheduler."""
    from dask.distributed import as_completed

    shared = client.scatter(data, broadcast=True, hash=False)
    waiting = iter(missing)

    def submit(number: int) -> Any:
        return client.submit(_compute, shared, number, cache, key=f"part-{number}-{data.sweep.fingerprint[:16]}", pure=False)

    ahead = max(4 * sum(client.nthreads().values()), 8)
    done = as_completed([submit(number) for number in itertools.islice(waiting, ahead)])
    for future in done:
        future.result()
        future.release()
        for number in itertools.islice(waiting, 1):
            done.add(submit(number))


def _compute(data: DataSet, number: int, cache: Any) -> int:
    """Makes a partition, unless a worker that was lost had made it."""
    path = data.file(number)
    if not path.exists():
        data.sweep.compute(number, path, cache=cache)
    return number


_OTHER_COLUMNS = {"point", "scene", "seed", "run"}


def _column(name: str) -> str:
    """The column of a parameter: its name without dots, which Parquet would take for parts of a structure."""
    return name.replace(".", "_")


def _told(values: list[Any]) -> list[Any]:
    """The values of a parameter as its column has them: numbers, lists of numbers, or words where they are of other kinds or
    of several."""
    plain = [_plain(value) for value in values]
    if all(map(_is_number, plain)):
        return plain
    lists = [[_plain(part) for part in value] if isinstance(value, (list, tuple)) else None for value in plain]
    if all(numbers is not None and all(map(_is_number, numbers)) for numbers in lists):
        return lists
    return [str(value) for value in plain]


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float))


def _plain(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else value


def _scene(given: Any) -> Scene:
    match given:
        case Scene():
            return given
        case Mapping():
            return Scene.of(dict(given))
        case _:
            return Scene.find(given)


def _cores() -> int:
    """Cores that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def _positive(name: str, number: int) -> int:
    if not isinstance(number, int) or number < 1:
        raise ValueError(f"{name} is {number!r}; it must be a whole number of at least 1")
    return number
