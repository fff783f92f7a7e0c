"""Meshes in and out, what is wrong with them, and what mends them."""

import pickle

import numpy as np
import pytest
import trimesh

import langevin_rigid as lr


def test_a_trimesh_comes_in_and_goes_out_as_it_is():
    ball = trimesh.creation.icosphere(subdivisions=2, radius=0.1)
    mesh = lr.Mesh.of(ball)
    assert np.array_equal(mesh.vertices, ball.vertices)
    assert np.array_equal(mesh.faces, ball.faces)
    assert mesh.volume == pytest.approx(ball.volume, rel=1e-12)
    assert mesh.area == pytest.approx(ball.area, rel=1e-12)
    assert np.allclose(mesh.bounds, ball.bounds, rtol=0, atol=1e-15)
    back = trimesh.Trimesh(mesh.vertices, mesh.faces)
    assert back.is_watertight


@pytest.mark.parametrize("dtype", [np.int16, np.int32, np.int64, np.uint8, np.uint32, np.uint64])
def test_numbers_of_vertices_may_be_of_any_integer_type(cube, dtype):
    few = lr.Mesh.shape("box", size=[0.1, 0.1, 0.1], triangles=12)
    assert lr.Mesh(few.vertices, few.triangles.astype(dtype)) == few


def test_arrays_of_any_layout_are_read(cube):
    flipped = np.asfortranarray(cube.vertices)
    strided = np.zeros((len(cube.vertices), 6), dtype=np.float64)[:, ::2]
    strided[:] = cube.vertices
    for vertices in (flipped, strided, cube.vertices.tolist()):
        assert lr.Mesh(vertices, cube.triangles) == cube
    single = lr.Mesh(cube.vertices.astype(np.float32), cube.triangles)
    assert np.allclose(single.vertices, cube.vertices, rtol=1e-7)
    assert cube.vertices.flags.c_contiguous and cube.vertices.dtype == np.float64


def test_what_is_no_mesh_is_named(cube):
    vertices, triangles = cube.vertices, cube.triangles
    with pytest.raises(ValueError, match=r"vertices has shape \(2, 2\); it must be \(n, 3\)"):
        lr.Mesh([[0, 1], [2, 3]], triangles)
    with pytest.raises(ValueError, match=r"triangles has shape \(4,\); it must be \(m, 3\)"):
        lr.Mesh(vertices, [0, 1, 2, 3])
    with pytest.raises(TypeError, match="triangles is an array of float64; it must be one of integers"):
        lr.Mesh(vertices, triangles.astype(float))
    with pytest.raises(TypeError, match="vertices is an array of <U1; it must be one of numbers"):
        lr.Mesh([["a", "b", "c"]], triangles)
    bad = vertices.copy()
    bad[3, 1] = np.nan
    with pytest.raises(lr.MeshError, match="row 3 of vertices is .*NaN.*must be finite"):
        lr.Mesh(bad, triangles)
    for wrong in (-1, len(vertices)):
        bad = triangles.astype(int)
        bad[7, 2] = wrong
        with pytest.raises(lr.MeshError, match="row 7 of triangles is .*those of the .* vertices"):
            lr.Mesh(vertices, bad)
    with pytest.raises(TypeError, match="has no `vertices`"):
        lr.Mesh.of(object())


def test_a_broken_mesh_says_what_is_wrong_in_the_words_of_the_command(cube):
    broken = lr.Mesh(cube.vertices, cube.triangles[1:], name="cube")
    assert not broken.is_body
    assert "open" in broken.fault
    with pytest.raises(lr.MeshError) as raised:
        lr.added_mass(broken)
    assert str(raised.value) == f"cube: {broken.fault}"
    assert isinstance(raised.value, ValueError)
    result = lr.check(broken)
    assert not result
    assert result.fault == broken.fault
    assert result.holes.tolist() == [3]
    assert result.volume is None
    assert len(result.findings) == 1 and result.findings[0].startswith("hole: 3 edges")


def test_all_findings_are_listed(cube):
    triangles = cube.triangles.astype(int)
    triangles[4] = triangles[4][::-1]
    triangles = np.vstack([triangles, triangles[9]])
    result = lr.check(lr.Mesh(cube.vertices, triangles))
    assert (result.flipped, result.duplicates) == (1, 1)
    assert "flipped: 1 triangles wind unlike their neighbours" in result.findings
    assert "duplicate: 1 triangles that repeat another" in result.findings


def test_a_sound_mesh_is_ready(cube):
    result = lr.check(cube)
    assert result and result.ready and result.findings == []
    assert result.volume == pytest.approx(1e-3, rel=1e-12)
    assert 0 < result.expected_error < 0.1 and result.expected_seconds > 0
    assert result.repair is result.repair_of_sheet is result.left is None and result.repair_steps == []


def test_what_a_check_proposes_mends():
    def proposed(mesh):
        result = lr.check(mesh)
        assert not result.ready
        return result, lr.repair(mesh, **result.repair)

    cube = lr.Mesh.shape("box", size=[0.1, 0.1, 0.1], triangles=300)
    result, mended = proposed(lr.Mesh(cube.vertices, cube.triangles[1:]))
    assert result.repair == {} and result.repair_of_sheet is None
    assert result.repair_steps == mended.steps and result.repair_warnings == mended.warnings
    assert result.expected_error == pytest.approx(lr.check(mended.mesh).expected_error)
    # A box without its lid is a solid with a wide hole, or a sheet.
    box = lr.Mesh.shape("box", size=[0.1, 0.05, 0.1], triangles=12)
    lid = (box.vertices[box.triangles][:, :, 1] > 0.02).all(axis=1)
    tray = lr.Mesh(box.vertices, box.triangles[~lid])
    result, mended = proposed(tray)
    assert result.repair == {"fill": result.holes[0]}
    assert mended.mesh.volume == pytest.approx(5e-4)
    assert result.repair_warnings == mended.warnings and result.repair_warnings
    sheet = lr.repair(tray, **result.repair_of_sheet | {"thickness": 1e-3}).mesh
    assert sheet.volume < 1e-4
    # A speck beside the body, which no repair closes.
    speck = 1.0 + 1e-3 * np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]])
    both = lr.Mesh(
        np.vstack([cube.vertices, speck]),
        np.vstack([cube.triangles, np.array([[0, 2, 1], [0, 3, 2]]) + len(cube.vertices)]),
    )
    result, mended = proposed(both)
    assert result.repair["largest"] and mended.mesh.volume == pytest.approx(1e-3)


def test_a_check_says_what_no_repair_mends():
    nothing = lr.check(lr.Mesh([[0, 0, 0], [0, 0, 0], [0, 0, 0]], [[0, 1, 2]]))
    assert nothing.repair is None and nothing.repair_of_sheet is None and nothing.expected_error is None
    assert nothing.left


def test_repair_mends_and_tells_what_it_did(cube):
    triangles = cube.triangles[1:].astype(int)
    triangles[20] = triangles[20][::-1]
    mended = lr.repair(lr.Mesh(cube.vertices, triangles))
    assert mended.counts == [("turn", 1), ("fill", 1)]
    assert len(mended.steps) == 2
    assert mended.mesh.volume == pytest.approx(cube.volume, rel=1e-12)
    assert 0 < mended.made_share < 0.01 and mended.lost_share == 0
    assert mended.hull_share == pytest.approx(1.0)
    assert lr.repair(cube).steps == []


def test_what_repair_cannot_know_it_says():
    square = lr.Mesh([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], [[0, 2, 1], [0, 3, 2]], name="sheet")
    with pytest.raises(lr.MeshError, match="sheet: 1 holes are left.*thickness"):
        lr.repair(square)
    thick = lr.repair(square, thickness=0.01).mesh
    assert thick.volume == pytest.approx(0.01, rel=1e-12)
    assert square.sheet(0.01).volume == pytest.approx(0.01, rel=1e-12)


def test_files_are_written_and_read(cube, tmp_path):
    for name in ("cube.obj", "cube.stl"):
        path = tmp_path / name
        cube.save(path)
        read = lr.Mesh.read(path)
        assert read.name == name
        assert read.volume == pytest.approx(1e-3, rel=1e-6)
        assert lr.Mesh.read(str(path), unit="mm").volume == pytest.approx(1e-12, rel=1e-6)
        assert lr.check(path).ready
    with pytest.raises(lr.MeshError, match="must end in .obj or .stl"):
        cube.save(tmp_path / "cube.ply")
    with pytest.raises(FileNotFoundError, match="there is no mesh file"):
        lr.Mesh.read(tmp_path / "none.stl")
    with pytest.raises(ValueError, match="`furlong` is no unit of length"):
        lr.Mesh.read(tmp_path / "cube.stl", unit="furlong")
    (tmp_path / "junk.stl").write_bytes(b"junk")
    with pytest.raises(lr.MeshError, match="junk.stl"):
        lr.Mesh.read(tmp_path / "junk.stl")


def test_what_a_reader_passed_over_is_told(cube, tmp_path):
    path = tmp_path / "cube.obj"
    cube.save(path)
    path.write_text("\ufeff" + path.read_text(), encoding="utf-8")
    words = "passed over the byte order mark"
    # Who reads the mesh has its notices; who names its file is warned.
    assert words in lr.Mesh.read(path).notices[0]
    for call in (lr.check, lr.repair, lr.added_mass, lambda mesh: lr.Body.bake(mesh, density=500.0)):
        with pytest.warns(lr.LangevinRigidWarning, match=f"cube.obj: {words}"):
            call(path)


def test_shapes_have_the_names_and_dimensions_of_scenes():
    disc = lr.Mesh.shape("disc", radius=0.05, thickness=0.001, triangles=600)
    assert disc.volume == pytest.approx(np.pi * 0.05**2 * 0.001, rel=1e-9)
    with pytest.raises(ValueError, match="`disk` is no shape; did you mean `disc`"):
        lr.Mesh.shape("disk", radius=1.0, thickness=1.0)
    with pytest.raises(TypeError, match="the shape `disc` needs `thickness`"):
        lr.Mesh.shape("disc", radius=1.0)
    with pytest.raises(TypeError, match="the shape `disc` has no `size`; it has radius, thickness"):
        lr.Mesh.shape("disc", radius=1.0, thickness=1.0, size=2.0)
    with pytest.raises(lr.MeshError):
        lr.Mesh.shape("disc", radius=-1.0, thickness=1.0)


def test_simplified_keeps_the_volume():
    fine = lr.Mesh.shape("ellipsoid", semi_axes=[0.1, 0.1, 0.1], triangles=5120)
    coarse = fine.simplified(500)
    assert len(coarse.triangles) < 700
    assert coarse.volume == pytest.approx(fine.volume, rel=1e-6)


def test_pickles_keep_meshes(cube):
    for mesh in (cube, lr.Mesh(cube.vertices, cube.triangles[1:], name="open")):
        again = pickle.loads(pickle.dumps(mesh))
        assert again == mesh and again.name == mesh.name
