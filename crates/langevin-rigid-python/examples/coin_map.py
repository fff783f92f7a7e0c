"""Where a coin lands that is dropped into water, over tilt and height: as many drops as wanted, as a data set and a map.

    python coin_map.py out/coin-map --drops 1000000

Interrupted or killed, the same command goes on where it stopped. It prints what the drops cost beside those of an ensemble
in one process. `--scheduler tcp://host:8786` takes the workers of a cluster that is there.
"""

import argparse
import os
import time
from pathlib import Path

import langevin_rigid as lr
import numpy as np

TILTS = np.linspace(0.0, 87.0, 30)
HEIGHTS = np.linspace(0.06, 0.38, 17)


def scene():
    # A coin that its fingers let go, at rest, until it touches the floor.
    coin = lr.Scene.find("coin")
    return coin.changed({"contact": None, "tank": None, "release.velocity": None, "release.carried": None, "scatter": None})


def dataset(folder, drops, client, workers):
    points = len(TILTS) * len(HEIGHTS)
    # Which way it leans is drawn, so that the map is of distances alone.
    coin = scene().changed({"scatter.heading": {"uniform": [0.0, 360.0]}})
    parameters = {
        "release.tilt": TILTS.tolist(),
        "release.position": [[0.0, height, 0.0] for height in HEIGHTS],
    }
    return lr.sweep(coin, folder, runs=max(drops // points, 1), parameters=parameters, client=client, workers=workers)


def cores():
    return len(os.sched_getaffinity(0))


def native_rate(seconds=20.0):
    """Drops of an ensemble in a second on all cores, for each core, over tilts and heights like those of the map."""
    least, most = float(HEIGHTS[0]), float(HEIGHTS[-1])
    coin = scene()
    scatter = {"tilt": lr.uniform(0.0, 87.0), "heading": lr.uniform(0.0, 360.0), "height": lr.uniform(least, most)}
    lr.ensemble(coin, 64, scatter=scatter)
    runs, started = 0, time.perf_counter()
    while time.perf_counter() - started < seconds:
        lr.ensemble(coin, 16384, scatter=scatter, first=runs)
        runs += 16384
    return runs / (time.perf_counter() - started) / cores()


def draw(data, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    columns = ["release_tilt", "height", "x", "z", "up"]
    table = data.to_pandas(columns)
    table["distance"] = 100 * np.hypot(table["x"], table["z"])
    table["face_up"] = 100 * (table["up"] > 0)
    cells = table.groupby(["height", "release_tilt"])[["distance", "face_up"]].mean().unstack()
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    names = [("distance", "mean distance of the landing (cm)", "viridis"), ("face_up", "landed face up (%)", "coolwarm")]
    for axis, (name, label, colours) in zip(axes, names):
        shown = axis.pcolormesh(TILTS, 100 * HEIGHTS, cells[name], cmap=colours, shading="nearest")
        figure.colorbar(shown, ax=axis, label=label)
        axis.set(xlabel="tilt at release (degrees)", ylabel="depth of the water (cm)")
    figure.suptitle(f"A coin let go at rest in water: {len(table):,} drops")
    figure.savefig(path, dpi=120)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("folder", type=Path)
    options.add_argument("--drops", type=int, default=100_000)
    options.add_argument("--workers", type=int, help="processes of a cluster that is started here [default: one a core]")
    options.add_argument("--scheduler", help="address of a cluster")
    options.add_argument("--rate", action="store_true", help="measure the rate of an ensemble as well")
    given = options.parse_args()
    client = None
    if given.scheduler:
        from dask.distributed import Client

        client = Client(given.scheduler)
    started = time.perf_counter()
    data = dataset(given.folder, given.drops, client, given.workers)
    seconds = time.perf_counter() - started
    size = sum(file.stat().st_size for file in data.files)
    print(f"{data.sweep}: {seconds:.1f} s, {size / data.sweep.total:.0f} bytes a drop")
    if given.rate:
        swept, native = data.sweep.total / seconds / (given.workers or cores()), native_rate()
        print(f"{swept:.0f} drops a second and core, {native:.0f} of an ensemble in one process: {100 * swept / native:.0f} %")
    draw(data, given.folder / "map.png")
    print(f"wrote {given.folder / 'map.png'}")


if __name__ == "__main__":
    main()
