"""Langevin Rigid: light bodies moving through air or water."""

from ._native import __version__

__all__ = ["__version__"]
