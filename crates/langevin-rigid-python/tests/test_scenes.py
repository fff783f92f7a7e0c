"""Scenes, their runs and ensembles."""

import pickle

import langevin_rigid as lr
import numpy as np
import pytest

BALL = {
    "fluid": {"preset": "water"},
    "body": {"shape": "ellipsoid", "semi_axes": [0.01, 0.01, 0.01], "density": 2000.0, "triangles": 80},
    "release": {"position": [0.0, 1.0, 0.0]},
    "run": {"time_step": 0.002, "ground": 0.0},
}


def test_scenes_are_found_changed_and_written():
    assert "leaf" in lr.Scene.built_in()
    leaf = lr.Scene.find("leaf")
    assert leaf.name == "leaf" and leaf.description
    changed = leaf.changed({"run.seed": np.int64(5), "release.position": np.array([0, 2, 0]), "run.duration": None})
    assert changed.seed == 5 and leaf.seed == 0 and changed != leaf
    assert lr.Scene.parse(changed.to_toml(), name="leaf") == changed
    assert pickle.loads(pickle.dumps(changed)) == changed


def test_a_scene_file_and_its_mesh_are_found_from_anywhere(tmp_path, monkeypatch):
    folder = tmp_path / "scenes"
    folder.mkdir()
    lr.Mesh.shape("disc", radius=0.02, thickness=0.002, triangles=200).save(folder / "disc.obj")
    scene = lr.Scene.of({**BALL, "body": {"mesh": "disc.obj", "unit": "m", "mass": 0.01}})
    (folder / "disc.toml").write_text(scene.text)
    found = lr.Scene.find(folder / "disc.toml")
    assert found.name == "disc"
    monkeypatch.chdir(tmp_path)
    near = pickle.loads(pickle.dumps(lr.Scene.find("scenes/disc.toml")))
    monkeypatch.chdir("/")
    assert near.bake().volume == pytest.approx(found.bake().volume, rel=1e-12)


def test_what_happened_to_a_bake_is_warned_of(tmp_path):
    import warnings

    # A folder cannot be made within a file.
    (tmp_path / "file").write_text("")
    nowhere = tmp_path / "file" / "bakes"
    for call in (lambda: lr.simulate(BALL, cache=nowhere), lambda: lr.Scene.of(BALL).bake(cache=nowhere)):
        with pytest.warns(lr.LangevinRigidWarning, match="the bake was not kept .*give a writable folder as `cache`"):
            call()
    # A kept bake that is damaged is not believed.
    lr.simulate(BALL, cache=tmp_path / "bakes")
    (kept,) = (tmp_path / "bakes").iterdir()
    kept.write_bytes(kept.read_bytes()[:-9])
    with pytest.warns(lr.LangevinRigidWarning, match="was not used .*; the body was baked anew") as told:
        lr.ensemble(BALL, 2, cache=tmp_path / "bakes")
    assert told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        lr.ensemble(BALL, 2, cache=tmp_path / "bakes")
        with pytest.raises(lr.LangevinRigidWarning, match="the kept bake .* was not used"):
            lr.simulate(BALL, cache=nowhere)


def test_what_is_told_of_any_body_of_a_crowd_is_warned_of(tmp_path):
    lr.Mesh.shape("disc", radius=0.02, thickness=0.002, triangles=200).save(tmp_path / "disc.obj")
    (tmp_path / "disc.obj").write_text("\ufeff" + (tmp_path / "disc.obj").read_text(), encoding="utf-8")
    disc = lr.Scene.of({**BALL, "body": {"mesh": "disc.obj", "unit": "m", "mass": 0.01}})
    (tmp_path / "disc.toml").write_text(disc.text)
    crowd = {"count": 2, "over": [1.0, 0.5, 1.0], "kinds": [{"scene": str(tmp_path / "disc.toml")}]}
    run = {"time_step": 0.002, "duration": 0.01}
    with pytest.warns(lr.LangevinRigidWarning, match="passed over the byte order mark"):
        lr.simulate({**BALL, "run": run, "crowd": crowd}, cache=False)


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda: lr.Scene.find("leef"), lr.SceneError, "did you mean `leaf`"),
        (lambda: lr.Scene.parse("run = 1", name="mine"), lr.SceneError, "mine.toml:1:7"),
        (lambda: lr.Scene.of({**BALL, "run": {"time_step": 0.1}}), lr.SceneError, "the run would never end"),
        (lambda: lr.Scene.of({"body": {"shape": object()}}), TypeError, "`shape` is of"),
        (lambda: lr.simulate(3.5), TypeError, "a scene is a Scene"),
        (lambda: lr.simulate(BALL, bodies=0), ValueError, "at least one"),
        (lambda: lr.simulate(BALL, dt=-1.0), ValueError, "dt is"),
        (lambda: lr.simulate(BALL, model="seperated"), ValueError, "did you mean"),
        (lambda: lr.simulate({**BALL, "release": {"position": [0, 0.001, 0]}}), lr.SceneError, "release it higher"),
        (lambda: lr.ensemble(BALL, 0), ValueError, "at least one falls"),
        (lambda: lr.ensemble(BALL, 1, scatter={"weight": 1.0}), lr.SceneError, "weight"),
        (lambda: lr.ensemble(BALL, 1, scatter={"mass": lr.uniform(2, 1)}), lr.SceneError, "in this order"),
    ],
)
def test_mistakes_are_told(make, error, words):
    with pytest.raises(error, match=words):
        make()


def test_a_run_has_its_states_and_is_saved_as_the_command_does(tmp_path):
    run = lr.simulate(BALL)
    assert run.endings == ["ground"] and len(run) == 1
    states = run.states
    assert states.positions[0].tolist() == [0.0, 1.0, 0.0]
    # The ball ends where it touches the ground; the corners of its 80 triangles stand out.
    assert 0.009 < states.positions[-1, 1] < 0.0105
    assert run.summary["steps"] == len(states) - 1
    assert run.body.mass == pytest.approx(run.summary["mass"])
    assert len(run.to_pandas()) == len(states)
    names = run.save(tmp_path / "out", formats=["csv", "npz", "parquet", "glb"])
    assert all((tmp_path / "out" / name).stat().st_size > 0 for name in names)
    import pandas

    table = pandas.read_parquet(tmp_path / "out" / "trajectory.parquet")
    assert np.array_equal(table[["x", "y", "z"]].to_numpy(), states.positions)
    again = lr.simulate(str(tmp_path / "out" / "scene.toml"))
    assert np.array_equal(again.states.positions, states.positions)
    with pytest.raises(ValueError, match="did you mean"):
        run.save(tmp_path, formats=["cvs"])


def test_bodies_side_by_side_and_in_a_world():
    run = lr.simulate("leaf", bodies=3, duration=0.2)
    assert len(run) == len(run.bodies) == 3
    starts = np.array([states.positions[0] for states in run.bodies])
    assert np.ptp(starts[:, 0]) > 0.05
    pond = lr.simulate("coin-toss", duration=1.0)
    assert pond.endings[0] in ("time", "rest")


def test_landings_have_what_was_drawn():
    scatter = {"height": lr.uniform(0.5, 1.0), "mass": [0.01, 0.02], "velocity": lr.normal([0.1, 0, 0], 0.01)}
    falls = lr.ensemble(BALL, 400, scatter=scatter, seed=3)
    landings = falls.landings
    assert len(falls) == len(landings) == 400
    assert landings["height"].min() >= 0.5 and landings["height"].max() <= 1.0
    assert set(landings["mass"]) == {0.01, 0.02}
    assert abs(landings["release_vx"].mean() - 0.1) < 5 * 0.01 / 20
    # A ball sinks to the ground, whatever its height: its centre ends one radius above.
    assert np.allclose(1.0 - landings["depth"], 0.01, atol=3e-3)
    assert falls.statistics["landed"] == 400
    assert falls.path(0).shape[1] == 3
    assert dict(landings)["run"].tolist() == list(range(400))
    # A part of the runs is that part.
    some = lr.ensemble(BALL, 10, scatter=scatter, seed=3, first=20).landings
    for name in landings:
        assert np.array_equal(some[name], landings[name][20:30], equal_nan=name.startswith("lying"))
    with pytest.raises(KeyError, match="there are run, height"):
        landings["hight"]


def test_tables_are_written(tmp_path):
    import pandas

    landings = lr.ensemble(BALL, 50, scatter={"size": lr.uniform(0.5, 2)}).landings
    landings.to_parquet(tmp_path / "landings.parquet")
    landings.to_csv(tmp_path / "landings.csv")
    frame = landings.to_pandas()
    columns = list(frame.columns)
    for table in (pandas.read_parquet(tmp_path / "landings.parquet"), pandas.read_csv(tmp_path / "landings.csv", float_precision="round_trip")):
        assert list(table.columns) == columns
        for name in columns:
            same = (table[name] == frame[name]) | (table[name].isna() & frame[name].isna())
            assert same.all(), name


def test_a_journal_goes_on_where_it_stopped(tmp_path, interrupted_after):
    journal = tmp_path / "falls.journal"
    whole = lr.ensemble(BALL, 60, scatter={"velocity": 0.1}).landings.to_pandas()
    # What a stopped call leaves behind is made by one that is stopped.
    slow = {**BALL, "run": {"time_step": 1e-6, "ground": 0.0}}
    with interrupted_after(0.5):
        lr.ensemble(slow, 100_000, journal=journal)
    assert journal.exists()
    with pytest.raises(lr.SceneError, match="another scene, seed or version"):
        lr.ensemble(BALL, 60, journal=journal)
    journal.unlink()
    again = lr.ensemble(BALL, 60, scatter={"velocity": 0.1}, journal=journal).landings.to_pandas()
    assert again.equals(whole) and not journal.exists()


def test_regimes_are_mapped(tmp_path):
    falls = lr.regimes((3, 4))
    points = falls.points
    assert len(points) == len(falls) == 24
    assert set(points["plate"]) == {"disc", "strip"}
    compared = points["compared"] == 1
    assert falls.agreement["disc"]["compared"] + falls.agreement["strip"]["compared"] == compared.sum()
    same = points["regime"] == points["published"]
    assert np.array_equal(points["agrees"] == 1, same)
    falls.picture(tmp_path / "map.png")
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(ValueError, match="grid is"):
        lr.regimes((0, 3))


def test_a_directed_fall_does_what_it_says():
    best = lr.direct("direct-leaf", falls=2000, best=2)[0]
    assert best.score >= 0 and best.misses
    again = lr.simulate(best.scene)
    assert np.array_equal(again.states[len(again.states) - 1].position, best.end.position)
    with pytest.raises(lr.SceneError, match=r"give it a \[direct\]"):
        lr.direct(BALL)


def test_a_run_is_drawn_and_filmed(tmp_path):
    run = lr.simulate({**BALL, "run": {"time_step": 0.002, "duration": 0.2}})
    pictures = [tmp_path / f"{shown}.png" for shown in ("strobe", "path", "both")]
    for path in pictures:
        run.picture(path, shown=path.stem)
    drawn = {path.read_bytes() for path in pictures}
    assert len(drawn) == 3 and all(png.startswith(b"\x89PNG") for png in drawn)
    run.picture(tmp_path / "top.png", view="top")
    assert (tmp_path / "top.png").read_bytes() not in drawn

    frames = run.film(tmp_path / "film", fps=50)
    assert frames == 11
    names = sorted(path.name for path in (tmp_path / "film").glob("*.png"))
    assert names == [f"frame-{number:05}.png" for number in range(1, 12)]

    with pytest.raises(ValueError, match="`tpo` is no view; did you mean `top`?"):
        run.picture(tmp_path / "none.png", view="tpo")
    with pytest.raises(ValueError, match="way to show a motion"):
        run.film(tmp_path / "none", shown="all")
    with pytest.raises(ValueError):
        run.film(tmp_path / "none", fps=0)
    with pytest.raises(OSError):
        run.picture(tmp_path / "top.png" / "none.png")
    assert not (tmp_path / "none.png").exists()


def test_a_crowd_counts_its_frames():
    import time

    started = time.monotonic()
    crowd = lr.crowd(BALL, 50, seconds=0.2, model="kirchhoff")
    # In real time: the last of 12 frames begins 11 after the first.
    assert time.monotonic() - started > 11 / 60
    assert (crowd.scene, crowd.model, crowd.bodies) == ("scene", "kirchhoff", 50)
    assert len(crowd) == 12 and crowd.time_step == 0.002 and crowd.threads >= 1
    assert (crowd.frame_times > 0).all()
    assert crowd.missed_frames == (crowd.frame_times > 1 / 60).sum()
    assert repr(crowd).startswith("<Crowd: 50 bodies of scene, 12 frames, ")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (dict(bodies=0), "at least one"),
        (dict(seconds=0.0), "the time is 0 s; it must be a positive number"),
        (dict(seconds=float("nan")), "the time is NaN s"),
        (dict(model="kirchoff"), "did you mean `kirchhoff`"),
        (dict(bodies=4_000_000_000), "4000000000 bodies for 10.0 s would take"),
    ],
)
def test_a_crowd_that_cannot_be_is_refused(given, words):
    with pytest.raises(ValueError, match=words):
        lr.crowd(BALL, **given)


def test_the_paper_is_reproduced(tmp_path):
    page = lr.reproduce(tmp_path / "report", parts=["fig2"], seeds=1, cache=False)
    assert page == tmp_path / "report" / "report.html"
    assert "fig2" in page.read_text() and (tmp_path / "report" / "fig2").is_dir()
    with pytest.raises(ValueError, match="`fig22` is no part; did you mean `fig2`?"):
        lr.reproduce(tmp_path / "none", parts=["fig22"])
    with pytest.raises(ValueError, match="at least one"):
        lr.reproduce(tmp_path / "none", parts=["fig2"], seeds=0)
    with pytest.raises(ValueError, match="there are no 2 seeds from 18446744073709551615 on"):
        lr.reproduce(tmp_path / "none", parts=["fig2"], seeds=2, seed=2**64 - 1)
    with pytest.raises(ValueError, match="no part is named"):
        lr.reproduce(tmp_path / "none", parts=[])
    assert not (tmp_path / "none").exists()
