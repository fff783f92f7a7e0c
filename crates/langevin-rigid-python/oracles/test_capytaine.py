"""Added mass against Capytaine, whose boundary elements are another method and another program.

Both solve on the same flat triangles, so the shape is no part of the difference. Capytaine's panels have constant
values and their centres are collocated: its error falls with the square of their size on smooth surfaces, more slowly
where there are edges. Ours is a Galerkin method, refined at edges and extrapolated. So the difference is measured on
meshes of several sizes; what is left at panels of no size is what the two programs differ by.

Measured with Capytaine 3.0, the largest of the 36 entries, each over the root of its two diagonal entries:

    sphere, 1280 triangles           0.39 %    at no size 0.08 %
    ellipsoid 3:2:1, 1280 triangles  0.44 %    at no size 0.04 %
    torpedo, 4320 triangles          0.37 %    at no size 0.08 %
"""

import capytaine
import numpy as np
import pytest
import trimesh

import langevin_rigid as lr

SEMI_AXES = 0.3, 0.2, 0.1


def sphere(level):
    return trimesh.creation.icosphere(subdivisions=1 + level, radius=0.2)


def ellipsoid(level):
    return sphere(level).apply_scale(np.array(SEMI_AXES) / 0.2)


def torpedo(level):
    """A hull of revolution about z: a round nose, a cylinder and a cone."""
    n = 3 + level
    nose = [(0.5 + 0.1 * np.cos(t), 0.1 * np.sin(t)) for t in np.linspace(0, np.pi / 2, 2 * n + 1)]
    middle = [(z, 0.1) for z in np.linspace(0.5, 0.0, 6 * n + 1)[1:]]
    tail = [(z, 0.1 + 0.5 * z) for z in np.linspace(0.0, -0.2, 3 * n + 1)[1:]]
    outline = np.array([(r, z) for z, r in reversed(nose + middle + tail)])
    outline[[0, -1], 0] = 0.0
    return trimesh.creation.revolve(outline, sections=8 * n)


def baked(mesh):
    """A body of it, ballasted so that its centre of mass is not its centroid."""
    keel = mesh.centroid - 0.3 * np.array([0.1, 0.1, 0.05])
    return lr.Body.bake(mesh, density=600.0, ballast=[(2.0, keel, 0.01)])


def of_capytaine(surface):
    """Added mass per unit density about the origin, in the order of our tensor."""
    body = capytaine.FloatingBody(
        # A triangle is a quadrangle that has its last corner twice.
        mesh=capytaine.Mesh(vertices=surface.vertices, faces=surface.triangles[:, [0, 1, 2, 2]].astype(int)),
        dofs=capytaine.rigid_body_dofs(rotation_center=(0, 0, 0)),
    )
    names = ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]
    problems = [
        capytaine.RadiationProblem(
            body=body, radiating_dof=name, omega=1.0, rho=1.0, free_surface=np.inf, water_depth=np.inf
        )
        for name in names
    ]
    results = capytaine.BEMSolver(method="direct").solve_all(problems, progress_bar=False)
    return np.array([[result.added_masses[name] for result in results] for name in names])


def difference(mesh):
    """Capytaine's tensor less ours, each entry over the root of its two diagonal entries."""
    body = baked(mesh)
    surface = body.surface
    assert len(surface.triangles) == len(mesh.faces)
    size = np.diag(body.added_mass).copy()
    # About an axis of revolution there is next to none: rotations count from a tenth of V l^2 on.
    size[3:] = np.maximum(size[3:], 0.1 * body.volume * body.half_extents.max() ** 2)
    return (of_capytaine(surface) - body.added_mass) / np.sqrt(np.outer(size, size))


# The sizes of the panels, and the powers of them that the difference has: with edges the first and the second both
# count, three sizes are needed, and the powers between, which edges also have, are left in the extrapolation.
@pytest.mark.parametrize(
    "shape, sizes, powers, least_order, limit",
    [
        (sphere, {1: 2, 2: 1}, [2], 1.7, 1e-3),
        (ellipsoid, {1: 2, 2: 1}, [2], 1.9, 1e-3),
        (torpedo, {0: 5 / 3, 1: 5 / 4, 2: 1}, [1, 2], 1.5, 1e-3),
    ],
    ids=["sphere", "ellipsoid", "torpedo"],
)
def test_capytaine_converges_to_our_tensor(shape, sizes, powers, least_order, limit):
    differences = [difference(shape(level)) for level in sizes]
    rows = [[1.0, *(size**power for power in powers)] for size in sizes.values()]
    left = np.abs(np.linalg.solve(rows, np.reshape(differences, (-1, 36)))[0]).max()
    *_, coarse, finest = (np.abs(d).max() for d in differences)
    order = np.log(coarse / finest) / np.log(list(sizes.values())[-2])
    print(f"{shape.__name__}: {coarse:.2%}, {finest:.2%}, order {order:.2f}, at no size {left:.3%}")
    assert order > least_order
    assert left < limit


def test_sphere_of_both_is_lambs():
    """Half the fluid displaced, of the polyhedron, which has the volume to within its own error."""
    result = lr.added_mass(sphere(2))
    theirs = of_capytaine(lr.Body.bake(sphere(2), density=1.0).surface)
    ours, theirs = (np.diag(matrix)[:3] / (0.5 * result.volume) - 1 for matrix in (result.matrix, theirs))
    print(f"sphere: ours {ours}, theirs {theirs}")
    assert np.abs(ours).max() < 0.1 * np.abs(theirs).max()
