"""Free motion and Munk's moment against MuJoCo.

In vacuum a free body is one of MuJoCo's own problems. In fluid MuJoCo applies Kirchhoff's terms of the velocities with
a diagonal added mass, `geom_fluid[6:12]`, per unit density of the fluid; it does not apply those of the accelerations,
so that there only the loads can be compared, not the motion.
"""

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation
from scipy.special import elliprd

import langevin_rigid as lr

SIZE = np.array([0.3, 0.2, 0.1])
SPIN = np.array([0.3, 5.0, 0.2])
SEMI_AXES = np.array([0.3, 0.2, 0.1])
DENSITY = 1000.0
# MuJoCo integrates Lamb's coefficients by a rule of 15 points; 4.5e-7 is its largest error for this ellipsoid.
QUADRATURE = 1e-6


def tumbling(dt, seconds):
    """A cuboid in MuJoCo's vacuum, let go near the axis about which its spin is unstable: orientation, spin."""
    half = " ".join(map(str, SIZE / 2))
    model = mujoco.MjModel.from_xml_string(f"""
      <mujoco><option gravity="0 0 0" integrator="RK4" timestep="{dt}"/><worldbody><body><freejoint/>
        <geom type="box" size="{half}" density="{DENSITY}"/>
      </body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    data.qvel[3:] = SPIN
    for _ in range(round(seconds / dt)):
        mujoco.mj_step(model, data)
    return Rotation.from_quat(data.qpos[3:], scalar_first=True), data.qvel[3:].copy()


def in_near_vacuum():
    cuboid = lr.Body.cuboid(size=SIZE, density=DENSITY)
    fluid = lr.Fluid(density=1e-12, viscosity=1e-12)
    return lr.Stepper(cuboid, fluid, model="kirchhoff", gravity=[0, 0, 0])


def test_a_cuboid_tumbles_as_in_mujoco():
    seconds, differences, ours = 4.0, [], in_near_vacuum()
    inertia = DENSITY * SIZE.prod() / 12 * (np.sum(SIZE**2) - SIZE**2)
    assert np.allclose(np.diag(ours.total_mass)[3:], inertia, rtol=1e-12)
    for dt in (4e-3, 2e-3):
        state = lr.State(angular_velocity=SPIN)
        energy, momentum = ours.kinetic_energy(state), ours.angular_impulse(state)
        path = ours.steps(state, dt, round(seconds / dt))
        theirs, spin = tumbling(dt, seconds)
        turn = (Rotation.from_quat(state.orientation).inv() * theirs).magnitude()
        differences.append([turn, np.abs(state.angular_velocity - spin).max()])
        kept = [
            abs(ours.kinetic_energy(state) / energy - 1),
            np.abs(ours.angular_impulse(state) - momentum).max() / np.linalg.norm(momentum),
        ]
        flips = np.count_nonzero(np.diff(np.sign(path.angular_velocities[:, 1])))
        flips = np.count_nonzero(np.diff(np.sign(path.angular_velocities[:, 1])))
        print(f"dt {dt}: angle {turn:.1e}, spin {differences[-1][1]:.1e}, energy {kept[0]:.1e}, momentum {kept[1]:.1e}")
        assert flips > 0, "it must turn over, or the motion tells little"
        assert kept[0] < 1e-10 and kept[1] < 1e-12
    # Both schemes are of fourth order; what is left is their own error.
    coarse, fine = np.array(differences)
    assert np.all(coarse / fine > 2**3.8)
    assert np.all(fine < 1e-9)


def immersed(semi_axes):
    """An ellipsoid in MuJoCo's fluid, without drag and lift."""
    size = " ".join(map(str, semi_axes))
    return mujoco.MjModel.from_xml_string(f"""
      <mujoco><option gravity="0 0 0" density="{DENSITY}" viscosity="0"/><worldbody><body><freejoint/>
        <geom type="ellipsoid" size="{size}" density="700" fluidshape="ellipsoid" fluidcoef="0 0 0 0 0"/>
      </body></worldbody></mujoco>""")


def in_water(semi_axes):
    body = lr.Body.ellipsoid(semi_axes=semi_axes, density=700.0)
    fluid = lr.Fluid(density=DENSITY, viscosity=1e-3)
    return lr.Stepper(body, fluid, model="kirchhoff", gravity=[0, 0, 0])


def lamb(semi_axes):
    """Added mass of an ellipsoid in translation per unit density: Lamb 1932, article 114."""
    alpha = [semi_axes.prod() * 2 / 3 * elliprd(*np.roll(semi_axes**2, -i - 1)) for i in range(3)]
    return np.array([a / (2 - a) for a in alpha]) * 4 / 3 * np.pi * semi_axes.prod()


def test_mujoco_has_the_added_mass_of_our_ellipsoids():
    theirs = immersed(SEMI_AXES).geom_fluid[0, 6:]
    ours = np.diag(lr.Body.ellipsoid(semi_axes=SEMI_AXES, density=700.0).added_mass)
    print("MuJoCo / ours - 1:", theirs / ours - 1, "ours / Lamb - 1:", ours[:3] / lamb(SEMI_AXES) - 1)
    assert np.allclose(ours[:3], lamb(SEMI_AXES), rtol=1e-14)
    assert np.allclose(theirs, ours, rtol=QUADRATURE)


def test_munks_moment():
    stepper, model = in_water(SEMI_AXES), immersed(SEMI_AXES)
    data, mass = mujoco.MjData(model), DENSITY * lamb(SEMI_AXES)
    rng = np.random.default_rng(11)
    worst = np.zeros(2)
    for _ in range(20):
        turn, velocity = Rotation.random(rng=rng), rng.normal(size=3)
        state = lr.State(orientation=turn.as_quat(), world_velocity=velocity)
        loads = stepper.loads(state)
        data.qpos[3:], data.qvel[:] = turn.as_quat(scalar_first=True), [*velocity, 0, 0, 0]
        mujoco.mj_forward(model, data)
        v = turn.inv().apply(velocity)
        munk = turn.apply(np.cross(mass * v, v))
        size = np.linalg.norm(munk)
        theirs = turn.apply(data.qfrc_fluid[3:])
        ours = loads["added_mass"].torque
        worst = np.maximum(worst, [np.abs(ours - munk).max() / size, np.abs(theirs - munk).max() / size])
        # D'Alembert: no force.
        assert np.abs(loads.sum.force).max() == 0 and np.abs(data.qfrc_fluid[:3]).max() == 0
        assert np.array_equal(loads.sum.torque, ours)
    print(f"Munk's moment: ours {worst[0]:.1e}, MuJoCo's {worst[1]:.1e} from the closed form")
    assert worst[0] < 1e-14
    assert worst[1] < QUADRATURE
