"""`added-mass` in the programs that its formats are for: MuJoCo, Capytaine, DART, XML and CSV readers."""

import json
import xml.etree.ElementTree

import numpy as np
import pytest
from conftest import client

DENSITY = 1000.0
HALF_SIZE = 0.3, 0.2, 0.1
# Where the meshes are in their files: turned about an axis, and off the origin.
AXIS, ANGLE, PLACE = np.array([1, 2, 3]) / 14**0.5, 0.7, np.array([0.5, -0.2, 0.3])


def cross_matrix(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def posed(points):
    k = cross_matrix(AXIS)
    rotation = np.eye(3) + np.sin(ANGLE) * k + (1 - np.cos(ANGLE)) * k @ k
    return points @ rotation.T + PLACE


def box(n):
    """A box of 12 n^2 triangles."""
    points, faces = cube(n)
    return points * HALF_SIZE, faces


def ellipsoid(n):
    """The same triangles on an ellipsoid."""
    points, faces = cube(n)
    points = np.tan(np.pi / 4 * points)
    return points / np.linalg.norm(points, axis=1, keepdims=True) * HALF_SIZE, faces


def cube(n):
    points, faces = [], []
    for axis in range(3):
        for side in (1, -1):
            for i, j in grid(faces, len(points), n, n, side < 0):
                point = np.full(3, float(side))
                point[[(axis + 1) % 3, (axis + 2) % 3]] = 2 * i / n - 1, 2 * j / n - 1
                points.append(point)
    return welded(points, faces)


def torus(n):
    """A torus of 6 n^2 triangles."""
    points, faces = [], []
    for i, j in grid(faces, 0, 3 * n, n, False):
        around, across = 2 * np.pi * i / (3 * n), 2 * np.pi * j / n
        radius = 0.3 + 0.1 * np.cos(across)
        points.append((radius * np.cos(around), radius * np.sin(around), 0.1 * np.sin(across)))
    return welded(points, faces)


def tetrahedron():
    """A body without any symmetry."""
    points = np.array([(0, 0, 0), (0.4, 0, 0.05), (0.1, 0.3, 0), (0, 0.1, 0.2)])
    return points, np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])


def grid(faces, start, n, m, reverse):
    """Adds the triangles of n x m squares to the faces; returns the places of their points."""
    for i in range(n):
        for j in range(m):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)][:: -1 if reverse else 1]
            square = [start + a * (m + 1) + b for a, b in corners]
            faces += [square[:3], [square[0], *square[2:]]]
    return [(i, j) for i in range(n + 1) for j in range(m + 1)]


def welded(points, faces):
    unique, place = np.unique(np.round(points, 9) + 0.0, axis=0, return_inverse=True)
    return unique, place.ravel()[np.array(faces)]


def written(folder, mesh):
    points, faces = mesh
    path = folder / "mesh.obj"
    lines = ["v {:.17g} {:.17g} {:.17g}".format(*p) for p in posed(points)]
    path.write_text("\n".join(lines + ["f {} {} {}".format(*f + 1) for f in faces]) + "\n")
    return path


def report(command, path, *options):
    return json.loads(command("added-mass", path, "--format", "json", *options).stdout)


def run(text):
    """The names that a printed Python program defines."""
    names = {}
    exec(compile(text, "printed", "exec"), names)
    return names


# MuJoCo


class Immersed:
    """A MuJoCo body with the mesh as a geom, a ballast that moves its centre of mass, and no drag."""

    def __init__(self, command, path, density=700, integrator="Euler", ballast=True):
        self.mujoco = client("mujoco")
        weight = '<geom type="sphere" size="0.02" pos="0.3 0.1 -0.2" density="8000"/>' if ballast else ""
        self.model = self.mujoco.MjModel.from_xml_string(f"""
          <mujoco>
            <option density="{DENSITY}" integrator="{integrator}"><flag contact="disable"/></option>
            <asset><mesh name="hull" file="{path}"/></asset>
            <worldbody><body gravcomp="1" pos="1 2 3" quat="0.5 0.5 -0.1 0.3"><freejoint/>
              <geom name="hull" type="mesh" mesh="hull" density="{density}" fluidshape="ellipsoid"
                    fluidcoef="0 0 0 0 0"/>{weight}
            </body></worldbody>
          </mujoco>""")
        self.data = self.mujoco.MjData(self.model)
        self.printed = run(command("added-mass", path, "--format", "mujoco").stdout)
        self.left_out = self.printed["set_added_mass"](self.model, "hull")

    def forces(self, velocity):
        """MuJoCo's fluid forces on the free joint: in the world, and about the body's origin in its axes."""
        self.data.qvel[:] = velocity
        self.mujoco.mj_forward(self.model, self.data)
        return self.data.qfrc_fluid.copy()

    def matrix(self, quaternion):
        axes = np.zeros(9)
        self.mujoco.mju_quat2Mat(axes, quaternion)
        return axes.reshape(3, 3)


def kirchhoff(tensor, place, body, velocity):
    """Kirchhoff's velocity terms of a tensor about a place, as forces on the free joint."""
    turn, omega = body.matrix(body.data.qpos[3:]), velocity[3:]
    v = turn.T @ velocity[:3] + np.cross(omega, place)
    momentum = tensor @ np.concatenate([v, omega])
    force = np.cross(momentum[:3], omega)
    torque = np.cross(momentum[:3], v) + np.cross(momentum[3:], omega)
    return np.concatenate([turn @ force, torque + np.cross(place, force)])


def diagonal_in(tensor, axes):
    """A tensor without the terms that are off its diagonal in other axes."""
    motion = np.kron(np.eye(2), axes)
    return motion @ np.diag(np.diag(motion.T @ tensor @ motion)) @ motion.T


@pytest.mark.parametrize(
    "mesh, symmetric", [(ellipsoid(8), True), (box(4), True), (tetrahedron(), False)],
    ids=["ellipsoid", "box", "tetrahedron"])
def test_mujoco_applies_kirchhoffs_velocity_terms(command, tmp_path, mesh, symmetric):
    path = written(tmp_path, mesh)
    body = Immersed(command, path)
    ours = report(command, path)
    centroid, full = np.array(ours["centroid"]), np.array(ours["added_mass"])
    # The geom in the body, whose frame is that of the mesh file.
    axes = body.matrix(body.model.geom_quat[0])
    assert np.allclose(body.model.geom_pos[0], centroid, atol=1e-6)
    velocities = np.random.default_rng(7).normal(size=(20, 6))

    def worst(tensor):
        pairs = [(body.forces(v), kirchhoff(tensor, centroid, body, v)) for v in velocities]
        return max(np.abs(theirs - ours).max() / np.abs(ours).max() for theirs, ours in pairs)

    kept, all_terms = worst(diagonal_in(full, axes)), worst(full)
    print(f"kept terms {kept:.1e}, all terms {all_terms:.1e}, left out {body.left_out:.1e}")
    # MuJoCo's meshes, and so their places and axes, are of single precision.
    assert kept < 3e-7
    # The triangles break the symmetry of the ellipsoid a little.
    assert body.left_out < 1e-3 if symmetric else body.left_out > 0.01
    assert all_terms < 1e-3 if symmetric else all_terms > 0.01


def test_mujoco_primitive_geom_at_the_centroid(command, tmp_path):
    path = written(tmp_path, box(4))
    body = Immersed(command, path)
    place = " ".join(map(str, body.printed["CENTROID"]))
    model = body.mujoco.MjModel.from_xml_string(f"""
      <mujoco><option density="{DENSITY}"/><worldbody><body gravcomp="1"><freejoint/>
        <geom name="hull" type="ellipsoid" size="0.3 0.2 0.1" pos="{place}" fluidshape="ellipsoid"/>
      </body></worldbody></mujoco>""")
    left_out = body.printed["set_added_mass"](model, "hull")
    assert np.allclose(model.geom_fluid[0, 6:], np.diag(body.printed["ADDED_MASS"]), rtol=1e-12)
    assert left_out > 0.1, "the box is oblique in these axes"


@pytest.mark.parametrize("integrator", ["Euler", "RK4", "implicit", "implicitfast", "discrete"])
def test_mujoco_leaves_out_the_acceleration_part(command, tmp_path, integrator):
    body = Immersed(command, written(tmp_path, box(4)), integrator=integrator)
    body.model.opt.gravity[:] = 0

    def velocity_after_a_push(density):
        body.model.opt.density = density
        body.mujoco.mj_resetData(body.model, body.data)
        body.data.xfrc_applied[1] = [10, 20, 30, 1, -2, 3]
        body.mujoco.mj_step(body.model, body.data)
        return body.data.qvel.copy()

    dry, wet = velocity_after_a_push(0), velocity_after_a_push(DENSITY)
    assert np.abs(dry).min() > 1e-5
    assert np.allclose(wet, dry, rtol=1e-3)


def test_mujoco_buoyancy(command, tmp_path):
    path = written(tmp_path, ellipsoid(8))
    neutral = Immersed(command, path, density=DENSITY, ballast=False)
    start = neutral.data.qpos.copy()
    neutral.mujoco.mj_step(neutral.model, neutral.data, nstep=1000)
    assert np.abs(neutral.data.qpos - start).max() < 1e-5
    light = Immersed(command, path, density=DENSITY / 4, ballast=False)
    light.mujoco.mj_forward(light.model, light.data)
    assert np.allclose(light.data.qacc[:3], (0, 0, 3 * 9.81), atol=1e-4)


def test_mujoco_program_says_what_the_model_lacks(command, tmp_path):
    body = Immersed(command, written(tmp_path, box(4)))
    set_numbers = body.model.geom_fluid[0, 6:].copy()
    body.mujoco.mj_setConst(body.model, body.data)
    assert not np.allclose(body.model.geom_fluid[0, 6:], set_numbers), "mj_setConst undoes it, as documented"
    body.model.geom_fluid[0, 0] = 0
    with pytest.raises(ValueError, match="fluidshape"):
        body.printed["set_added_mass"](body.model, "hull")


# Capytaine


def theirs(points, faces, centre):
    capytaine = client("capytaine")
    capytaine.set_logging("ERROR")
    body = capytaine.FloatingBody(
        mesh=capytaine.Mesh(points, np.c_[faces, faces[:, :1]]),
        dofs=capytaine.rigid_body_dofs(rotation_center=centre))
    problems = [
        capytaine.RadiationProblem(body=body, radiating_dof=dof, omega=1.0, free_surface=np.inf,
                                   water_depth=np.inf, rho=DENSITY)
        for dof in body.dofs
    ]
    results = capytaine.BEMSolver(method="direct").solve_all(problems, progress_bar=False)
    columns = {result.radiating_dof: result.added_masses for result in results}
    matrix = [[columns[radiating][influenced] for radiating in body.dofs] for influenced in body.dofs]
    return np.array(matrix), list(body.dofs)


def difference(command, folder, mesh):
    """Capytaine's matrix less ours, entry by entry over the root of the two diagonal entries."""
    path = written(folder, mesh)
    array = run(command("added-mass", path, "--format", "capytaine").stdout)["added_mass"]
    matrix, dofs = theirs(posed(mesh[0]), mesh[1], array.attrs["rotation_center"])
    assert array.dims == ("influenced_dof", "radiating_dof")
    assert all(list(array.coords[dim].values) == dofs for dim in array.dims)
    scale = np.sqrt(np.diag(array))
    return (matrix - array.values) / np.outer(scale, scale)


# Constant panels are of second order in their size on smooth bodies, of about first where edges make the
# flow singular. Halving them shows the order; the extrapolation of their values is the oracle.
@pytest.mark.parametrize(
    "shape, sizes, order, fine, limit",
    [(ellipsoid, (6, 12), 2, 0.006, 0.001), (torus, (11, 22), 2, 0.01, 0.002), (box, (8, 16), 1, 0.05, 0.01)],
    ids=["ellipsoid", "torus", "box"])
def test_capytaine_converges_to_our_matrix(command, tmp_path, shape, sizes, order, fine, limit):
    differences = [difference(command, tmp_path, shape(n)) for n in sizes]
    coarse_error, fine_error = (np.abs(d).max() for d in differences)
    extrapolated = np.abs(differences[1] + (differences[1] - differences[0]) / (2**order - 1)).max()
    print(f"{shape.__name__}: {coarse_error:.4f}, {fine_error:.4f}, extrapolated {extrapolated:.4f}")
    assert fine_error < fine
    assert fine_error < coarse_error * 2**-order * 1.15
    assert extrapolated < limit


# Gazebo: its DART engine adds the tensor as a body welded to the link, angular part first.


def sdf_tensor(text):
    """The tensor of `<fluid_added_mass>`, linear part first."""
    tensor = np.zeros((6, 6))
    for child in xml.etree.ElementTree.fromstring(text):
        i, j = ("xyzpqr".index(letter) for letter in child.tag)
        tensor[i, j] = tensor[j, i] = float(child.text)
    return tensor


def momentum_rate(tensor, v, omega, dv, domega):
    """Rate of the momenta that a tensor gives a motion about its own point, in body axes: force, torque."""
    momentum = tensor @ np.concatenate([v, omega])
    rate = tensor @ np.concatenate([dv, domega])
    force = rate[:3] + np.cross(omega, momentum[:3])
    return force, rate[3:] + np.cross(omega, momentum[3:]) + np.cross(v, momentum[:3])


def test_dart_moves_as_kirchhoff_says_by_the_sdf_tensor(command, tmp_path):
    dart = client("dartpy")
    path = written(tmp_path, tetrahedron())
    printed = sdf_tensor(command("added-mass", path, "--format", "sdf").stdout)
    mass, centre, inertia = 2.0, np.array([0.1, 0.2, 0.3]), np.diag([0.2, 0.3, 0.4])
    skeleton = dart.dynamics.Skeleton()
    _, link = skeleton.createFreeJointAndBodyNodePair()
    link.setInertia(dart.dynamics.Inertia(mass, centre, inertia))
    _, fluid = skeleton.createWeldJointAndBodyNodePair(link)
    added = dart.dynamics.Inertia()
    added.setSpatialTensor(np.roll(printed, 3, axis=(0, 1)))
    fluid.setInertia(added)
    for body in (link, fluid):
        body.setGravityMode(False)
    skeleton.setPositions(np.array([0.3, 0.5, -0.2, 1, 2, 3]))
    skeleton.setVelocities(np.random.default_rng(3).normal(size=6))
    skeleton.computeForwardDynamics()
    omega, v = np.split(link.getSpatialVelocity(), 2)
    domega, dv = np.split(link.getSpatialAcceleration(), 2)

    def about(place, tensor):
        """Force, and torque about the link's origin, of a tensor about another place."""
        carried = v + np.cross(omega, place), omega, dv + np.cross(domega, place), domega
        force, torque = momentum_rate(tensor, *carried)
        return np.concatenate([force, torque + np.cross(place, force)])

    ours = report(command, path)
    wet = about(np.array(ours["centroid"]), np.array(ours["added_mass"]))
    dry = about(centre, np.block([[mass * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), inertia]]))
    assert np.abs(wet).max() > 1
    assert np.abs(wet + dry).max() < 1e-8 * np.abs(wet).max()


# Text formats


def test_text_formats_parse_to_the_same_tensor(command, tmp_path):
    pandas = client("pandas")
    path = written(tmp_path, tetrahedron())
    origin = np.array(report(command, path, "--about", "origin")["added_mass"])
    (tmp_path / "matrix.csv").write_text(
        command("added-mass", path, "--about", "origin", "--format", "csv").stdout)
    table = pandas.read_csv(tmp_path / "matrix.csv", comment="#")
    assert list(table) == ["x", "y", "z", "rot_x", "rot_y", "rot_z"]
    assert np.allclose(table.to_numpy(), origin, rtol=1e-9, atol=0)
    numbers = np.genfromtxt(tmp_path / "matrix.csv", delimiter=",", skip_header=7)
    assert np.allclose(numbers, origin, rtol=1e-9)

    text = command("added-mass", path, "--format", "sdf").stdout
    sdf = xml.etree.ElementTree.fromstring(text)
    names = "xx xy xz xp xq xr yy yz yp yq yr zz zp zq zr pp pq pr qq qr rr".split()
    assert sdf.tag == "fluid_added_mass" and [child.tag for child in sdf] == names
    assert np.allclose(sdf_tensor(text), origin, rtol=1e-9, atol=0)

    uuv = xml.etree.ElementTree.fromstring(command("added-mass", path, "--format", "uuv").stdout)
    assert uuv.tag == "hydrodynamic_model" and uuv.find("type").text == "fossen"
    matrix = np.array(uuv.find("added_mass").text.split(), float).reshape(6, 6)
    # The plugin's force: velocities to y right and z down, times the matrix, and back.
    turn = np.diag([1, -1, -1, 1, -1, -1])
    assert np.allclose(turn @ matrix @ turn, origin, rtol=1e-9)
