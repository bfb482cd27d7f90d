"""Curves of a run, by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

if TYPE_CHECKING:
    from .simulation import Simulation


def plot(simulation: Simulation, quantities: Sequence[str], seconds: float, axes: Any) -> Any:
    from matplotlib import pyplot

    frame = simulation.history(seconds, *(quantities or ("energy",)))
    if axes is None:
        _, axes = pyplot.subplots(len(frame.columns), 1, sharex=True, squeeze=False, figsize=(7, 1 + 2 * len(frame.columns)))
        axes = axes[:, 0]
    rows = axes if hasattr(axes, "__len__") else [axes] * len(frame.columns)
    for row, name in zip(rows, frame.columns):
        row.plot(frame.index, frame[name], label=name)
        row.set_ylabel(name.replace("_", " "))
    rows[-1].set_xlabel("seconds")
    return axes
