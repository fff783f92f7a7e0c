"""MuJoCo: free ellipsoids under its ellipsoid fluid model, nanoseconds a body-step."""

import json
import time

import mujoco
import numpy

STEPS = 2000
REPEATS = 9


def model(bodies, integrator):
    body = """
      <body pos="{} 0 0"><freejoint/>
        <geom type="ellipsoid" size="0.01 0.02 0.04" density="1200" fluidshape="ellipsoid"/>
      </body>"""
    return mujoco.MjModel.from_xml_string(f"""
      <mujoco>
        <option timestep="0.005" density="1000" viscosity="0.001" integrator="{integrator}">
          <flag contact="disable"/>
        </option>
        <worldbody>{"".join(body.format(i) for i in range(bodies))}</worldbody>
      </mujoco>""")


def nanoseconds(bodies, integrator):
    ready = model(bodies, integrator)
    steps = max(STEPS // bodies, 50)
    times = []
    for _ in range(REPEATS):
        data = mujoco.MjData(ready)
        data.qvel[:] = 0.1
        started = time.perf_counter()
        mujoco.mj_step(ready, data, nstep=steps)
        times.append((time.perf_counter() - started) / (steps * bodies))
        assert numpy.isfinite(data.qpos).all(), "the run diverged"
    return 1e9 * float(numpy.median(times))


print(json.dumps({
    "version": mujoco.__version__,
    "figures": {
        f"{name}_{bodies}": nanoseconds(bodies, integrator)
        for bodies in (1, 100)
        for name, integrator in (("rk4", "RK4"), ("euler", "Euler"), ("implicitfast", "implicitfast"))
    },
}))
