"""Capytaine: added mass of an ellipsoid in unbounded fluid, direct method.

Arguments: mesh files. For each the milliseconds of the six motions and the diagonal, per density.
"""

import json
import sys
import time

import capytaine
import numpy

# The first warms up: it compiles and reads tables.
REPEATS = 4
DOFS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")


def read(path):
    vertices, faces = [], []
    for line in open(path):
        kind, *numbers = line.split()
        if kind == "v":
            vertices.append([float(x) for x in numbers])
        else:
            a, b, c = (int(x) - 1 for x in numbers)
            faces.append([a, b, c, a])
    return capytaine.Mesh(numpy.array(vertices), numpy.array(faces))


def solved(path):
    body = capytaine.FloatingBody(
        mesh=read(path), dofs=capytaine.rigid_body_dofs(rotation_center=(0, 0, 0)))
    problems = [
        capytaine.RadiationProblem(
            body=body, radiating_dof=dof, omega=1.0, free_surface=numpy.inf, rho=1.0)
        for dof in DOFS
    ]
    times = []
    for _ in range(REPEATS):
        # A solver of its own each time: no matrix is left over from the last one.
        solver = capytaine.BEMSolver(method="direct")
        started = time.perf_counter()
        results = solver.solve_all(problems, progress_bar=False)
        times.append(1e3 * (time.perf_counter() - started))
    masses = {result.radiating_dof: result.added_masses[result.radiating_dof] for result in results}
    return {"ms": float(numpy.median(times[1:])), "diagonal": [float(masses[dof]) for dof in DOFS]}


capytaine.set_logging("ERROR")
print(json.dumps({
    "version": capytaine.__version__,
    "figures": [solved(path) for path in sys.argv[1:]],
}))
