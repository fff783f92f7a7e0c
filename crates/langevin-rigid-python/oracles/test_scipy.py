"""Motion and turbulence against SciPy: its integrators, matrix exponential and solver of Lyapunov's equation."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm, solve_continuous_lyapunov
from scipy.spatial.transform import Rotation

import langevin_rigid as lr

WATER = 998.2
GRAVITY = np.array([0.0, -9.81, 0.0])


def weighted_ellipsoid():
    """An ellipsoid of three axes whose centre of mass is off its centre, so that its tensors are full."""
    body = lr.Body.ellipsoid(semi_axes=[0.15, 0.1, 0.05], density=900.0)
    return body.with_mass_properties(centre_of_mass=[0.01, -0.02, 0.005])


def neutral_ellipsoid():
    """One as heavy as the water, with its centre of mass off its centre."""
    body = lr.Body.ellipsoid(semi_axes=[0.15, 0.1, 0.05], density=WATER)
    return body.with_mass_properties(centre_of_mass=[0.01, -0.02, 0.005])


def kirchhoff(body, gravity):
    """Rates of position, quaternion and the impulses in the body frame, d/dt(p, l) = (p x w + f, l x w + p x v + t)."""
    inverse = np.linalg.inv(body.total_mass(WATER))
    displaced = WATER * body.volume

    def rates(_, y):
        p, l = y[7:10], y[10:]
        xi = inverse @ y[7:]
        v, w = xi[:3], xi[3:]
        turn = Rotation.from_quat(y[3:7])
        down = turn.inv().apply(gravity)
        vector, scalar = y[3:6], y[6]
        quaternion = 0.5 * np.append(scalar * w + np.cross(vector, w), -vector @ w)
        force = np.cross(p, w) + (body.mass - displaced) * down
        torque = np.cross(l, w) + np.cross(p, v) + np.cross(body.centre_of_buoyancy, -displaced * down)
        return np.concatenate([turn.apply(v), quaternion, force, torque])

    return rates


def errors_of_steps(gravity, seconds, counts):
    """Largest difference of the state after that time, steps from solve_ivp, for numbers of steps."""
    body = weighted_ellipsoid()
    fluid = lr.Fluid(density=WATER, viscosity=1e-3)
    stepper = lr.Stepper(body, fluid, model="kirchhoff", gravity=gravity)
    start = {
        "orientation": Rotation.from_rotvec([0.4, -0.3, 0.5]).as_quat(),
        "velocity": [0.5, 0.3, -0.2],
        "angular_velocity": [1.0, -2.0, 1.5],
    }
    xi = np.concatenate([start["velocity"], start["angular_velocity"]])
    y = np.concatenate([np.zeros(3), start["orientation"], body.total_mass(WATER) @ xi])
    rates = kirchhoff(body, gravity)
    theirs = solve_ivp(rates, (0, seconds), y, method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
    turn = Rotation.from_quat(theirs[3:7])
    xi = np.linalg.solve(body.total_mass(WATER), theirs[7:])
    errors = []
    for count in counts:
        state = lr.State(**start)
        stepper.steps(state, seconds / count, count)
        angle = (Rotation.from_quat(state.orientation).inv() * turn).magnitude()
        ours = np.concatenate([state.position, state.velocity, state.angular_velocity])
        errors.append(max(angle, np.abs(ours - np.concatenate([theirs[:3], xi])).max()))
    return np.array(errors)


def orders(errors):
    print("errors", errors, "orders", np.log2(errors[:-1] / errors[1:]))
    return np.log2(errors[:-1] / errors[1:])


def test_a_free_body_moves_as_kirchhoffs_equations():
    errors = errors_of_steps(np.zeros(3), 2.0, (200, 400, 800, 1600))
    assert np.all(orders(errors)[1:] > 3.7)
    assert errors[-1] < 1e-8


def test_kirchhoffs_pendulum():
    errors = errors_of_steps(GRAVITY, 2.0, (200, 400, 800, 1600))
    assert np.all(orders(errors)[1:] > 3.7)
    assert errors[-1] < 1e-5


# Turbulence that stays as it is; so weak that Kirchhoff's terms, quadratic in the velocities, are nothing.
K, FREQUENCY, REYNOLDS = 1e-10, 2.0, 1e4
C0 = 6.5 * (1 + 140 * REYNOLDS ** (-4 / 3)) ** -0.75
ALPHA = (0.5 + 0.75 * C0) * FREQUENCY
BETA = np.sqrt(C0 * K * FREQUENCY)
BODIES = 40_000


def batch_in_turbulence(body, model, seed):
    history = lr.TurbulenceHistory(interval=1.0, inflow_speed=1.0, length=0.1, k=[K], epsilon=[K * FREQUENCY])
    stepper = lr.Stepper(
        body,
        lr.Fluid(density=WATER, viscosity=1e-9),
        model=model,
        turbulence="history",
        history=history,
        reynolds=REYNOLDS,
        gravity=[0, 0, 0],
    )
    return lr.Batch(stepper, count=BODIES, seed=seed)


def motions(batch):
    return np.hstack([batch.velocities, batch.angular_velocities])


def worst_in_standard_errors(a, b, variances, covariance):
    """Largest difference of the sample covariance of normal a and b, of zero mean, from what it should be."""
    sample = a.T @ b / len(a)
    # Isserlis: the variance of a product of normals.
    error = np.sqrt((np.outer(variances, variances) + covariance**2) / len(a))
    return np.abs((sample - covariance) / error).max()


def test_langevin_loads_are_an_ornstein_uhlenbeck_process():
    """d xi = T^-1 A (-alpha xi dt + B dW): covariance by Lyapunov's equation, correlation by the matrix exponential."""
    body = neutral_ellipsoid()
    share = WATER * np.linalg.solve(body.total_mass(WATER), body.added_mass)
    # The angular noise is B's over the mean of the two largest half-extents.
    angular = 1.0 / np.sort(body.half_extents)[1:].mean()
    drift, kick = -ALPHA * share, share * BETA * np.repeat([1.0, angular], 3)
    stationary = solve_continuous_lyapunov(drift, -kick @ kick.T)
    memory = -1.0 / np.linalg.eigvals(drift).real.max()
    batch = batch_in_turbulence(body, "consistent", seed=17)

    # While it grows from rest, ...
    batch.step(0.02, n=10)
    gone = expm(0.2 * drift)
    grown = stationary - gone @ stationary @ gone.T
    growing = motions(batch)
    worst = [worst_in_standard_errors(growing, growing, np.diag(grown), grown)]
    # ... when it has settled, to exp(-28), at steps that resolve nothing, ...
    batch.step(0.5, n=int(14 * memory / 0.5))
    before = motions(batch)
    worst.append(worst_in_standard_errors(before, before, np.diag(stationary), stationary))
    # ... and over a lag.
    batch.step(0.02, n=15)
    lagged = expm(0.3 * drift) @ stationary
    worst.append(worst_in_standard_errors(motions(batch), before, np.diag(stationary), lagged))
    print(f"memory {memory:.2f} s; growing, settled, lagged: {np.round(worst, 2)} standard errors")
    assert max(worst) < 5


def test_the_fluid_seen_is_an_ornstein_uhlenbeck_process():
    """z <- e z + (1 - e^2)^(1/2) N(0, 1), e = exp(-alpha h), in six components that know nothing of each other."""
    batch = batch_in_turbulence(neutral_ellipsoid(), "separated", seed=23)
    batch.step(0.5, n=20)
    before = batch.states().fluctuations
    batch.step(0.02, n=5)
    after = batch.states().fluctuations
    one = np.ones(6)
    worst = [
        worst_in_standard_errors(before, before, one, np.eye(6)),
        worst_in_standard_errors(after, before, one, np.exp(-0.1 * ALPHA) * np.eye(6)),
    ]
    print(f"settled, lagged: {np.round(worst, 2)} standard errors")
    assert max(worst) < 5
