"""What the runs of an ensemble are drawn from."""

from collections.abc import Sequence

__all__ = ["normal", "uniform"]

Components = float | Sequence[float]
"""A number, or one for each of x, y and z."""


def uniform(least: Components, most: Components) -> dict[str, list[Components]]:
    """Anything between `least` and `most`, each as likely as any other.

    >>> uniform(0.5, 1.0)
    {'uniform': [0.5, 1.0]}
    """
    return {"uniform": [least, most]}


def normal(mean: Components, deviation: Components) -> dict[str, list[Components]]:
    """A normal distribution of this mean and standard deviation; what is impossible is drawn again.

    >>> normal([0, -0.3, 0], 0.05)
    {'normal': [[0, -0.3, 0], 0.05]}
    """
    return {"normal": [mean, deviation]}
