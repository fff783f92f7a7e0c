"""Steers a falling sheet of paper towards a target on the ground, as an environment of Gymnasium.

    pip install . "gymnasium>=1.2,<2"
    python examples/steer_a_sheet.py

The sheet flutters and glides where it will; the force that may act on it is a tenth of its weight at most. Random
actions and a proportional controller have the same 20 releases; it says how far from the target the sheets land.
"""

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.utils.env_checker import check_env

import langevin_rigid as lr

GRAVITY = 9.81


class SteerASheet(gymnasium.Env):
    """A sheet of paper that falls from four metres; the ground is at y = 0.

    Observation (13,): position relative to the target (m), orientation as a quaternion x, y, z, w, velocity (m/s) and
    angular velocity (rad/s) relative to the target, which is at rest; world frame, +Y up.
    Action (3,): force in the world frame, as a share of the largest; what is longer than 1 is shortened to it.
    Reward: by how much the horizontal distance from the target has become less (m).
    """

    metadata = {"render_modes": []}
    HEIGHT = 4.0
    # Horizontal distance of the target from the release, in each direction, at most (m).
    FARTHEST = 0.5
    LARGEST_FORCE = 0.1
    STEP = 1 / 60
    STEPS_PER_ACTION = 2
    LONGEST = 10.0

    def __init__(self):
        sheet = lr.Body.plate(length=0.1, width=0.07, thickness=1e-4, density=750.0)
        self.stepper = lr.Stepper(sheet, lr.Fluid.air(), gravity=[0, -GRAVITY, 0])
        self.largest = self.LARGEST_FORCE * sheet.mass * GRAVITY
        # Farther and faster than a sheet gets in ten seconds.
        bounds = np.repeat([100.0, 1.0, 100.0, 1e4], [3, 4, 3, 3])
        self.observation_space = spaces.Box(-bounds, bounds, dtype=np.float64)
        self.action_space = spaces.Box(-1.0, 1.0, (3,), np.float32)
        self.state = lr.State()
        self.target = np.zeros(3)
        self.noise = 0

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        # The turbulence of the episode, the target, and an attitude at random.
        self.noise = int(self.np_random.integers(2**32))
        x, z = self.np_random.uniform(-self.FARTHEST, self.FARTHEST, 2)
        self.target = np.array([x, 0.0, z])
        self.state = lr.State(position=[0, self.HEIGHT, 0], orientation=self.np_random.normal(size=4))
        return self._observation(), {"distance": self._distance()}

    def step(self, action):
        share = np.asarray(action, dtype=np.float64)
        force = self.largest * share / max(1.0, np.linalg.norm(share))
        before = self._distance()
        for _ in range(self.STEPS_PER_ACTION):
            self.stepper.step(self.state, self.STEP, force=force, seed=self.noise)
            landed = bool(self.state.position[1] <= 0.0)
            if landed:
                break
        late = self.state.time >= self.LONGEST
        distance = self._distance()
        return self._observation(), before - distance, landed, late and not landed, {"distance": distance}

    def _distance(self):
        return float(np.hypot(*(self.state.position - self.target)[[0, 2]]))

    def _observation(self):
        state = self.state
        return np.concatenate(
            [state.position - self.target, state.orientation, state.world_velocity, state.world_angular_velocity]
        )


def random_actions(env):
    return lambda observation: env.action_space.sample()


def proportional(env, gain=4.0):
    """Pushes towards the target, in proportion to the horizontal distance: `gain` largest forces a metre."""

    def act(observation):
        x, _, z = -gain * observation[:3]
        return (np.array([x, 0.0, z]) / max(1.0, np.hypot(x, z))).astype(np.float32)

    return act


def landing_distances(policy, episodes):
    env = SteerASheet()
    env.action_space.seed(0)
    act = policy(env)
    distances = []
    for episode in range(episodes):
        observation, info = env.reset(seed=episode)
        over = False
        while not over:
            observation, _, terminated, truncated, info = env.step(act(observation))
            over = terminated or truncated
        distances.append(info["distance"])
    return np.array(distances)


def main():
    gymnasium.register("SteerASheet-v0", entry_point=SteerASheet)
    check_env(gymnasium.make("SteerASheet-v0").unwrapped)
    print("landing distance from the target, 20 episodes, mean and standard error (m)")
    for policy in (random_actions, proportional):
        distances = landing_distances(policy, 20)
        error = distances.std(ddof=1) / np.sqrt(len(distances))
        print(f"  {policy.__name__.replace('_', ' '):15} {distances.mean():.3f} +- {error:.3f}")


if __name__ == "__main__":
    main()
