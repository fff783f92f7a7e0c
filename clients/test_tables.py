"""NPZ in numpy and Parquet in pyarrow: names, types and values of the CSV table, to the last bit."""

from conftest import client

POSITION, ORIENTATION, VELOCITY, SPIN = slice(2, 5), slice(5, 9), slice(9, 12), slice(12, 15)


def test_arrays_in_numpy(run):
    numpy = client("numpy")
    table = numpy.array(run.rows)
    with numpy.load(run.folder / "trajectory.npz") as arrays:
        types = {name: str(arrays[name].dtype) for name in arrays}
        assert types == {"body": "uint32", "t": "float64", "position": "float64",
                         "orientation": "float64", "velocity": "float64",
                         "angular_velocity": "float64"}
        for name, columns in [("body", 0), ("t", 1), ("position", POSITION),
                              ("orientation", ORIENTATION), ("velocity", VELOCITY),
                              ("angular_velocity", SPIN)]:
            assert numpy.array_equal(arrays[name], table[:, columns]), name


def test_columns_in_pyarrow(run):
    parquet = client("pyarrow.parquet")
    table = parquet.read_table(run.folder / "trajectory.parquet")
    assert table.column_names == run.columns
    assert [str(t) for t in table.schema.types] == ["uint32"] + ["double"] * 14
    assert not any(field.nullable for field in table.schema)
    for number, name in enumerate(run.columns):
        assert table[name].to_pylist() == [row[number] for row in run.rows], name
    assert b"SI units" in table.schema.metadata[b"langevin_rigid"]


def test_another_axis_up(leaf, command, tmp_path):
    numpy = client("numpy")
    command("export", leaf.folder, "--format", "npz", "--up", "z", "--out", tmp_path)
    table = numpy.array(leaf.rows)
    with numpy.load(tmp_path / "trajectory.npz") as arrays:
        x, y, z = table[:, POSITION].T
        assert numpy.array_equal(arrays["position"], numpy.stack([x, -z, y], axis=1))
        assert arrays["position"][0, 2] == 3
