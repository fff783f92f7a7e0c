"""PhiFlow: steps of a flow on a staggered grid of 32^3 cells: advection and projection, no turbulence.

On 64^3 cells version 3.4.0 fails: the places in its pressure matrix pass 2^31.
"""

import json
import time

import numpy
import phi
from phi.jax.flow import (
    Box, CenteredGrid, Solve, StaggeredGrid, advect, extrapolation, fluid, jit_compile, math, vec)

CELLS = 32
REPEATS = 5

velocity = StaggeredGrid(
    lambda x: vec(x=0.3 * math.sin(3.14159 * x.vector["x"]) * math.cos(3.14159 * x.vector["y"]),
                  y=1 - 0.3 * math.cos(3.14159 * x.vector["x"]) * math.sin(3.14159 * x.vector["y"]),
                  z=0 * x.vector["x"]),
    extrapolation.ZERO, x=CELLS, y=CELLS, z=CELLS, bounds=Box(x=1, y=1, z=1))


@jit_compile
def step(velocity, pressure):
    velocity = advect.semi_lagrangian(velocity, velocity, 1 / CELLS)
    return fluid.make_incompressible(
        velocity, solve=Solve("CG", rel_tol=1e-3, abs_tol=1e-3, max_iterations=500, x0=pressure))


pressure = CenteredGrid(0, x=CELLS, y=CELLS, z=CELLS, bounds=Box(x=1, y=1, z=1))
velocity, pressure = step(velocity, pressure)
times = []
for _ in range(REPEATS):
    started = time.perf_counter()
    velocity, pressure = step(velocity, pressure)
    float(math.max(math.abs(velocity.values)))
    times.append(time.perf_counter() - started)
print(json.dumps({
    "version": phi.__version__,
    "figures": {"cells_per_s": CELLS ** 3 / float(numpy.median(times))},
}))
