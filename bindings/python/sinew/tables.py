"""Tables of a run: pandas frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

import numpy as np

from ._numbers import duration
from .errors import ArgumentError
from .parts import Particle, Particles
from .records import Report

if TYPE_CHECKING:
    import pandas

    from .simulation import Simulation

quantities_of_report = ("energy", "stretch", *Report._fields)


def _steps(simulation: Simulation, seconds: float, every: int) -> list[int]:
    """Numbers of steps between two notes."""
    if every < 1:
        raise ArgumentError(f"a number of steps is at least 1: {every}")
    count = round(duration(seconds) * simulation.rate)
    return [every] * (count // every) + [count % every] * (count % every > 0)


def _particles(simulation: Simulation, of: str | Sequence[str] | None) -> Particles:
    """The particles named, in the order given; each once."""
    if of is None:
        named = [bool(name) for name in simulation.names]
        return Particles(simulation, simulation.ids[np.array(named, bool)])
    ids: list[int] = []
    for name in [of] if isinstance(of, str) else of:
        part = simulation[name]
        ids += [part.id] if isinstance(part, Particle) else part.ids.tolist()
    return Particles(simulation, np.array(list(dict.fromkeys(ids)), np.uint64))


def trace(simulation: Simulation, seconds: float, of: str | Sequence[str] | None, every: int) -> pandas.DataFrame:
    import pandas

    particles = _particles(simulation, of)
    names = particles.names
    steps = _steps(simulation, seconds, every)
    times, places, speeds = [], [], []
    for count in [0, *steps]:
        simulation.step(count)
        # Nine digits: a scene that counts frames has whole ones.
        times.append(round(simulation.seconds * simulation.per_second, 9) if simulation.per_second != 1 else simulation.seconds)
        places.append(np.array(particles.positions))
        speeds.append(np.array(particles.velocities))
    axes = "xyz"[: simulation.dimension]
    columns = {"time": np.repeat(times, len(names)), "name": names * len(times)}
    for values, prefix in ((places, ""), (speeds, "v")):
        columns.update(zip((prefix + axis for axis in axes), np.concatenate(values).T))
    return pandas.DataFrame(columns)


def history(simulation: Simulation, seconds: float, quantities: Sequence[str], every: int) -> pandas.DataFrame:
    import pandas

    chosen = quantities or [name for name in quantities_of_report if name != "seconds"]
    for name in chosen:
        if name not in quantities_of_report:
            raise ArgumentError(f"no quantity is called {name!r}; there are {', '.join(quantities_of_report)}")
    rows, times = [], []
    for count in [0, *_steps(simulation, seconds, every)]:
        simulation.step(count)
        report = simulation.report()
        values = {**report._asdict(), "energy": report.energy, "stretch": report.stretch_max}
        times.append(report.seconds)
        rows.append([values[name] for name in chosen])
    return pandas.DataFrame(rows, index=pandas.Index(times, name="seconds"), columns=list(chosen))
