"""A thousand falling sheets at once, each pushed towards a target of its own: what a vectorised environment steps.

    pip install . "gymnasium>=1.2,<2"
    python examples/many_sheets.py

The sheets, their releases and their largest force are those of steer_a_sheet.py.
"""

import time

import numpy as np
from steer_a_sheet import SteerASheet

import langevin_rigid as lr


def landing_distances(gain, count=1000, seed=0):
    """Horizontal distances from the target (count,) at which the sheets land, and the steps of bodies taken."""
    env = SteerASheet()
    rng = np.random.default_rng(seed)
    targets = rng.uniform(-env.FARTHEST, env.FARTHEST, (count, 2))
    orientations = rng.normal(size=(count, 4))
    batch = lr.Batch(env.stepper, np.tile([0, env.HEIGHT, 0], (count, 1)), orientations, seed=seed)
    distances = np.full(count, np.nan)
    force = np.zeros((count, 3))
    actions = round(env.LONGEST / (env.STEPS_PER_ACTION * env.STEP))
    for taken in range(1, actions + 1):
        share = gain * (targets - batch.positions[:, [0, 2]])
        share /= np.maximum(1.0, np.linalg.norm(share, axis=1, keepdims=True))
        force[:, [0, 2]] = env.largest * share
        batch.step(env.STEP, n=env.STEPS_PER_ACTION, force=force)
        # Those that have landed fall on, out of sight.
        new = np.isnan(distances) & (batch.positions[:, 1] <= 0.0)
        distances[new] = np.linalg.norm(batch.positions[new][:, [0, 2]] - targets[new], axis=1)
        if not np.isnan(distances).any():
            break
    return distances, taken * env.STEPS_PER_ACTION * count


def main():
    for name, gain in (("no force", 0.0), ("proportional", 4.0)):
        start = time.perf_counter()
        distances, steps = landing_distances(gain)
        seconds = time.perf_counter() - start
        landed = distances[~np.isnan(distances)]
        error = landed.std(ddof=1) / np.sqrt(len(landed))
        speed = f"{len(landed)} landed, {steps / seconds:.2g} steps a second"
        print(f"{name:13} {landed.mean():.3f} +- {error:.3f} m, {speed}")


if __name__ == "__main__":
    main()
