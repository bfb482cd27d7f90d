"""What a study measures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from ..errors import ArgumentError
from ..parts import Particle
from ..tables import quantities_of_report
from .located import nearest

if TYPE_CHECKING:
    from ..simulation import Simulation

overs: dict[str, Callable[[list[float]], float]] = {
    "max": max, "min": min, "mean": lambda values: math.fsum(values) / len(values)}
_axes = ("x", "y", "z", "vx", "vy", "vz", "speed")
_states = ("tension", "strain", "measure", "error")

class UnknownQuantity(ArgumentError):
    """A word that names no quantity."""

    def __init__(self, message: str, help: str):
        super().__init__(f"{message}; {help}")
        self.message, self.help = message, help


Quantity = Callable[["Simulation"], float]


def quantity(name: str, simulation: Simulation) -> Quantity:
    """Reads a number of a simulation: a field of the report ("energy"), or a part's ("bob/head.y", "bob/rod.tension").
    Raises UnknownQuantity or NotFoundError for what the simulation has not."""
    if name in quantities_of_report:
        return lambda sim: float({**(report := sim.report())._asdict(), "energy": report.energy, "stretch": report.stretch_max}[name])
    part, _, field = name.rpartition(".")
    if not part:
        raise UnknownQuantity(f"no quantity is called \"{name}\"", nearest(name, quantities_of_report))
    if field in _states:
        simulation.constraint(part)
        return lambda sim: float(getattr(sim.constraint(part), field))
    axes = [axis for axis in _axes if axis[-1] != "z" or simulation.dimension == 3]
    if field not in axes:
        raise UnknownQuantity(f"\"{field}\" is no number of a part in {simulation.dimension}D", nearest(field, (*axes, *_states)))
    simulation[part]
    return lambda sim: _number_of(sim, part, field)


def _number_of(sim: Simulation, name: str, field: str) -> float:
    part = sim[name]
    if field[0] == "v" or field == "speed":
        velocity = part.velocity if isinstance(part, Particle) else part.velocities.mean(axis=0)
        return float(np.linalg.norm(velocity)) if field == "speed" else float(velocity["xyz".index(field[1])])
    place = part.position if isinstance(part, Particle) else part.center
    return float(place["xyz".index(field)])


class Measures:
    """The measures of a study while a case runs. `given` are the measures of the file, `functions` those of Python."""

    def __init__(self, given: dict[str, Any], functions: dict[str, Quantity], simulation: Simulation):
        self._given, self._functions = given, functions
        self._overs: dict[str, tuple[str, Quantity, list[float]]] = {}
        for name, measure in given.items():
            over = next((word for word in overs if isinstance(measure, dict) and word in measure), None)
            if over:
                self._overs[name] = (over, quantity(measure[over], simulation), [])

    @classmethod
    def none(cls, simulation: Simulation) -> Measures:
        return cls({}, {}, simulation)

    @property
    def wants_steps(self) -> bool:
        return bool(self._overs)

    def note(self, simulation: Simulation) -> None:
        """Notes what is measured over time."""
        for _, read, values in self._overs.values():
            values.append(read(simulation))

    def results(self, simulation: Simulation) -> dict[str, float | None]:
        return {name: self._result(name, measure, simulation) for name, measure in self._given.items()}

    def _result(self, name: str, measure: Any, simulation: Simulation) -> float | None:
        if name in self._overs:
            over, _, values = self._overs[name]
            return overs[over](values)
        if isinstance(measure, str):
            return quantity(measure, simulation)(simulation)
        if "function" in measure:
            found = self._functions[measure["function"]](simulation)
            return None if found is None else float(found)
        word = "first" if "first" in measure else "count"
        times = [event.seconds for event in simulation.events() if event.what == measure[word]
                 and measure.get("where", event.where) in (event.where, event.where.split("/")[0])]
        return len(times) if word == "count" else times[0] if times else None


__all__ = ["Measures", "UnknownQuantity", "overs", "quantity"]
