"""Sweeps: the same data set whoever computes it, and nothing lost."""

import hashlib
import os
import signal
import threading
import time

import langevin_rigid as lr
import numpy as np
import pytest

BALL = {
    "fluid": {"preset": "water"},
    "body": {"shape": "ellipsoid", "semi_axes": [0.01, 0.01, 0.01], "density": 2000.0, "triangles": 80},
    "release": {"position": [0.0, 1.0, 0.0]},
    "run": {"time_step": 0.002, "ground": 0.0},
    "scatter": {"velocity": 0.1},
}
# Enough partitions that a worker is lost between them, points that end within a partition, and a last one that is short.
WHOLE = dict(runs=300, parameters={"body.density": [1500.0, 3000.0, 8000.0], "scatter.height": [[0.5], [1.0]]}, partition=130)


def hashes(data):
    return [hashlib.sha256(file.read_bytes()).hexdigest() for file in data.files]


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    return lr.sweep(BALL, tmp_path_factory.mktemp("alone"), workers=0, **WHOLE)


def test_all_runs_are_there_once_with_their_parameters(alone):
    table = alone.to_pandas()
    assert len(table) == alone.sweep.total == 1800
    assert alone.sweep.points == 6 and len(alone.files) == 14
    points = table.groupby("point")
    assert (points["run"].apply(list).apply(lambda runs: runs == list(range(300)))).all()
    for point, values in ((p, alone.sweep.values(p)) for p in range(6)):
        rows = table[table["point"] == point]
        assert (rows["body_density"] == values["body.density"]).all()
        assert (rows["height"] == values["scatter.height"][0]).all()
        assert all(list(row) == values["scatter.height"] for row in rows["scatter_height"])
    # A denser ball sinks faster.
    times = points["t"].mean()
    assert times[0] > times[2] > times[4]


def test_the_rows_are_those_of_ensembles(alone):
    table = alone.to_pandas()
    scene = alone.sweep.scene(3)
    landings = lr.ensemble(scene, 300).landings.to_pandas()
    rows = table[table["point"] == 3].reset_index(drop=True)
    for column in landings.columns:
        same = (rows[column] == landings[column]) | (rows[column].isna() & landings[column].isna())
        assert same.all(), column


def test_one_worker_or_three_make_the_same_bytes(alone, tmp_path):
    for workers in (1, 3):
        data = lr.sweep(BALL, tmp_path / str(workers), workers=workers, **WHOLE)
        assert hashes(data) == hashes(alone)


def test_what_is_there_is_not_made_again(alone, tmp_path):
    data = lr.sweep(BALL, tmp_path, workers=0, **WHOLE)
    for number in (0, 7, 13):
        data.file(number).unlink()
    kept = {file: file.stat().st_mtime_ns for file in data.files if file.exists()}
    assert data.missing == [0, 7, 13]
    again = lr.sweep(BALL, tmp_path, workers=0, **WHOLE)
    assert again.missing == [] and hashes(again) == hashes(alone)
    assert {file: file.stat().st_mtime_ns for file in kept} == kept


@pytest.mark.skipif(os.name == "nt", reason="kills by signal")
def test_a_worker_that_is_killed_loses_nothing(alone, tmp_path):
    from dask.distributed import Client, LocalCluster

    killed = []

    def kill(client):
        # As soon as there is a partition, in the middle of others.
        while not list(tmp_path.glob("part-*.parquet")):
            time.sleep(0.001)
        victim = client.run(os.getpid)
        os.kill(next(iter(victim.values())), signal.SIGKILL)
        killed.append(True)

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        killer = threading.Thread(target=kill, args=(Client(cluster),))
        killer.start()
        data = lr.sweep(BALL, tmp_path, client=client, **WHOLE)
        killer.join()
    assert killed and hashes(data) == hashes(alone)
    # What the killed worker was writing is gone or whole, and nothing else is there.
    names = {file.name for file in data.files} | {"sweep.json"}
    strays = [name for name in os.listdir(tmp_path) if name not in names]
    assert not [name for name in strays if name.endswith(".parquet")], strays


def test_the_folder_of_another_sweep_is_left_alone(alone):
    before = hashes(alone)
    for other in (dict(runs=301), dict(partition=131), dict(parameters={"body.density": [1500.0]}), dict(seeds=[1])):
        with pytest.raises(lr.SceneError, match="is of another sweep"):
            lr.sweep(BALL, alone.folder, workers=0, **{**WHOLE, **other})
    with pytest.raises(lr.SceneError, match="is of another sweep"):
        lr.sweep({**BALL, "fluid": {"preset": "air"}}, alone.folder, workers=0, **WHOLE)
    assert hashes(alone) == before


def test_a_damaged_description_is_told(tmp_path):
    (tmp_path / "sweep.json").write_text("{")
    with pytest.raises(lr.SceneError, match="is damaged"):
        lr.sweep(BALL, tmp_path, workers=0, **WHOLE)
    (tmp_path / "sweep.json").unlink()
    (tmp_path / "part-00000000.parquet").write_text("")
    with pytest.raises(lr.SceneError, match="choose an empty folder"):
        lr.sweep(BALL, tmp_path, workers=0, **WHOLE)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (dict(parameters={"body.density": []}), "at least one value of `body.density`"),
        (dict(parameters={"body.density": [1.0, -1.0]}), "density"),
        (dict(parameters={"body.colour": ["red"]}), "colour"),
        (dict(parameters={"fluid": [1]}), "fluid"),
        (dict(seeds=[1], parameters={"run.seed": [2], "run_seed": [1]}), "run_seed"),
        (dict(runs=0), "runs is 0"),
        (dict(partition=1.5), "partition is 1.5"),
    ],
)
def test_a_mistake_shows_before_the_work(tmp_path, wrong, words):
    with pytest.raises(ValueError, match=words):
        lr.sweep(BALL, tmp_path / "data", workers=0, **{**WHOLE, **wrong})
    assert not (tmp_path / "data").exists()


def test_parameters_are_told_as_what_they_are(tmp_path):
    import pyarrow.parquet

    parameters = {
        "release.position": [[0, 1, 0], np.array([0.0, 2.0, 0.0])],
        "scatter.size": [[1.0], [0.5, 1.0, 2.0]],
        "scatter.velocity": [0.1, lr.normal([0.1, 0, 0], 0.01), [0.1, 0.2, 0.3]],
        "body.density": np.array([2000, 3000]),
        "run.model": ["separated", "kirchhoff"],
    }
    # Points of all kinds in one partition.
    data = lr.sweep(BALL, tmp_path, workers=0, runs=2, parameters=parameters)
    schema = pyarrow.parquet.read_schema(data.files[0])
    kinds = {name: str(kind) for name, kind in zip(schema.names, schema.types)}
    assert kinds["release_position"] == "list<element: double not null>"
    assert kinds["scatter_size"] == "list<element: double not null>"
    assert kinds["scatter_velocity"] == kinds["run_model"] == "string"
    assert kinds["body_density"] == "double"
    table = data.to_pandas()
    for point in range(data.sweep.points):
        rows, values = table[table["point"] == point], data.sweep.values(point)
        assert len(rows) == 2
        assert all(list(row) == list(values["release.position"]) for row in rows["release_position"])
        assert all(list(row) == values["scatter.size"] for row in rows["scatter_size"])
        assert (rows["scatter_velocity"] == str(values["scatter.velocity"])).all()
        assert (rows["run_model"] == values["run.model"]).all()
        assert (rows["height"] == values["release.position"][1]).all()


def test_scenes_and_seeds_are_swept_too(tmp_path):
    other = {**BALL, "fluid": {"preset": "air"}}
    scenes = [lr.Scene.of(BALL, name="in water"), lr.Scene.of(other, name="in air")]
    table = lr.sweep(scenes, tmp_path, workers=0, runs=5, seeds=[1, 2]).to_pandas()
    assert len(table) == 20
    assert list(table["scene"].unique()) == ["in water", "in air"]
    assert sorted(table["seed"].unique()) == [1, 2]
    assert table.loc[table["scene"] == "in air", "t"].mean() < table.loc[table["scene"] == "in water", "t"].mean()
